/// Computes the torques of a logged run again, from what the log says was sensed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/log_reader.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

/// The program of the run: the files, as the log holds them, and the parameters. On an error nullopt, and the
/// diagnostics say why. Throws std::runtime_error when the log says too little. Writes the files to a
/// temporary folder, which is gone when it returns.
ZWANG_EXPORT std::optional<lang::Program> logged_program(const LogContext& context,
                                                         lang::Diagnostics& diagnostics);

/// How the runner of the log was set, as `Runner::facts` said it. Throws std::runtime_error when the log says
/// too little.
ZWANG_EXPORT RunnerSettings logged_settings(const LogContext& context);

/// The first torque that is not the same. [N m] or [N]
struct ReplayDifference {
  double time = 0.0;  ///< [s]
  std::string column;
  double logged = 0.0;
  double computed = 0.0;
};

/// The number of records that give the same torques again.
struct ReplayResult {
  std::uint64_t records = 0;  ///< that were compared
  std::uint64_t equal = 0;    ///< of them: every torque to the last bit
  std::optional<ReplayDifference> first;
};

/// Every torque that was sent, compared bit by bit. Stops from outside are taken from the log's events, a
/// host's resets from the ends of the stops, and its parameters from their columns. Throws std::runtime_error
/// when the log cannot be opened, or does not hold the inputs of each tick.
ZWANG_EXPORT ReplayResult replay(const std::filesystem::path& log, const lang::Program& program,
                                 const RunnerSettings& settings);

/// A log and the program of it.
struct ReplayPart {
  std::filesystem::path log;
  lang::Program program;
  bool has_program_of_before = false;  ///< the log was only cut into files
};
/// Replays a run whose log is in several files, or whose program was swapped under way. Each log starts where
/// its predecessor ends. Throws std::runtime_error, too, when a program does not fit the robot of the program
/// before it.
ZWANG_EXPORT ReplayResult replay(const std::vector<ReplayPart>& parts, const RunnerSettings& settings);

}  // namespace zwang::runtime
