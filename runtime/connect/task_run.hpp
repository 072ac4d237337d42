/// One run of a task on the robot, from its first tick to its report.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "action.hpp"
#include "control.hpp"
#include "inbox.hpp"
#include "outbox.hpp"
#include "zwang/runtime/log_parts.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::connect {

/// The parts that all runs of a process share.
struct Robot {
  const lang::Connection& connection;
  Inbox& inbox;
  Outbox& outbox;
  Control& control;
  std::optional<std::string> named_robot;  ///< --robot
};

/// Stamps of another clock would make every sample old, or of the future. The guard takes a clock in long
/// steps for a pause. Returns the error, or nothing.
std::string clock_trouble(const lang::Connection& connection, const lang::Program& program,
                          const Inbox& inbox);

/// The log of a run, where one is wanted.
struct LogOrder {
  std::optional<std::string> file;  ///< an .mcap file
  std::optional<double> rate;       ///< [1/s] most records
  runtime::LogRotation rotation;
};

/// `run.mcap` -> `run_2.mcap`: each run of a process has a log of its own.
std::optional<std::string> numbered(const std::optional<std::string>& log, int number);

/// Drives until the run is finished, and prints its report. The samples of the robot come, and the inbox
/// reads for the program.
RunTaskResult run_task(const Robot& robot, const lang::Program& program, const lang::Diagnostics& diagnostics,
                       const LogOrder& log);

}  // namespace zwang::connect
