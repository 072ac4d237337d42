/// The arguments of `zwang drive` and `zwang simulate` for the programs behind them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "zwang/lang/connection.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/log_parts.hpp"

namespace zwang::connect {

enum ExitCode { exit_good = 0, exit_bad = 1, exit_impossible = 2 };

struct Arguments {
  std::string task, connection;
  lang::LoadOptions options;
  std::optional<std::string> log;  ///< an .mcap file
  std::optional<double> log_rate;  ///< [1/s] most records
  runtime::LogRotation rotation;
  std::optional<double> observe;  ///< [s]: only look, for so long
  double wait = 10.0;             ///< [s] for the other side to be there
  std::uint64_t seed = 0;
  /// Of `simulate`, for tests: [s] of the world after which the odometry repeats its pose and twist.
  std::optional<double> stuck_odometry;
  double stamps_ahead = 0.0;  ///< [s] of `simulate`, for tests: of all stamps before this computer's clock
};

/// TASK --over CONNECTION [--robot F] [--scene F] [-p NAME=VALUE]... [--log F] [--log-rate HZ]
/// [--log-rotate LIMIT]... [--observe S] [--wait S] [--seed N] [--stuck-odometry S] [--stamps-ahead S].
/// Throws std::invalid_argument; people are answered by `zwang`, which calls this.
Arguments parse_arguments(int argc, char** argv);

struct Loaded {
  lang::Program program;
  lang::Connection connection;
};
/// Prints what is wrong; nothing if that is an error.
std::optional<Loaded> load(const Arguments& arguments, lang::Diagnostics& diagnostics);

/// SCHED_FIFO for all threads and those that they start, memory locked; says so where it may not. With 0
/// it does nothing.
void become_punctual(int priority);

}  // namespace zwang::connect
