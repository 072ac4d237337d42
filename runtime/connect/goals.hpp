/// Tasks that goals of the action `run` begin, one after the other.
#pragma once

#include "arguments.hpp"
#include "task_run.hpp"

namespace zwang::connect {

/// Loads and checks every task that a goal can name, as far as that goes before its parameters are known.
/// False, and what is wrong is printed.
bool check_goals(const lang::Connection& connection, const Arguments& arguments, const lang::Program& first);

/// Until the service `stop` or a signal ends it, which is no failure. `first` is the task of the command
/// line, for whose joints the robot's inbox and outbox were made.
ExitCode drive_goals(const Robot& robot, const Arguments& arguments, const lang::Program& first);

}  // namespace zwang::connect
