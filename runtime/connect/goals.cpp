#include "goals.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <thread>

#include "../cli/interruption.hpp"

namespace zwang::connect {

namespace {

RunTaskResult refused(const std::string& reason) {
  return {GoalOutcome::refused, reason};
}

/// The file behind a goal's name; nullopt for a name that is unknown.
std::optional<std::filesystem::path> file_of(const std::string& task, const lang::Connection& connection,
                                             const Arguments& arguments) {
  if (task.empty()) return arguments.task;
  for (const lang::NamedTask& named : connection.tasks) {
    if (named.name == task) return named.file;
  }
  return std::nullopt;
}

std::string known_tasks(const lang::Connection& connection) {
  std::string names;
  for (const lang::NamedTask& named : connection.tasks)
    names += (names.empty() ? "" : ", ") + ("`" + named.name + "`");
  return names.empty() ? "the connection file names no `tasks`" : "the connection file has " + names;
}

/// The first error, in one line.
std::string first_error(const lang::Diagnostics& diagnostics) {
  const auto d = diagnostics.first_error();
  if (!d) return "it cannot be loaded";
  if (!d->span.exists()) return d->code + ": " + d->message;
  return diagnostics.source(d->span.source).path + ":" + std::to_string(d->span.begin.line) + ": " + d->code +
         ": " + d->message;
}

/// A task for the joints of `first`; else a reason, and what is wrong with the files is printed.
std::optional<lang::Program> load_for(const std::filesystem::path& file, const lang::LoadOptions& options,
                                      const lang::Connection& connection, const lang::Program& first,
                                      lang::Diagnostics& diagnostics, std::string& reason) {
  auto program = lang::load(file, options, diagnostics);
  const bool is_good = program && lang::check_connection(connection, *program, diagnostics);
  if (!is_good) {
    lang::render_human(diagnostics, std::cerr);
    reason = first_error(diagnostics);
    return std::nullopt;
  }
  if (!program->robot.model.has_joints_of(first.robot.model)) {
    reason = file.string() + " is for a robot with other joints than " + first.path;
    return std::nullopt;
  }
  return program;
}

class Goals {
 public:
  Goals(const Robot& robot, const Arguments& arguments, const lang::Program& first)
      : robot_(robot), arguments_(arguments), first_(first), sensed_(first) {}

  void drive() {
    while (!is_over()) {
      robot_.inbox.fill(sensed_);
      const std::optional<RunTaskGoal> goal = robot_.control.goals().take_goal();
      if (goal) {
        drive(*goal);
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    }
    if (robot_.control.goals().take_goal()) robot_.control.goals().finish(refused("zwang drive has ended"));
  }

 private:
  bool is_over() const { return cli::is_interrupted() || robot_.control.wants_stop(); }

  void drive(const RunTaskGoal& goal) {
    ++number_;
    const RunTaskResult result = run(goal);
    const bool is_latched = result.outcome == GoalOutcome::stopped;
    if (!result.reason.empty()) std::printf("goal %d: %s\n", number_, result.reason.c_str());
    std::fflush(stdout);
    robot_.control.speak_of(first_);
    robot_.inbox.read_for(first_);
    robot_.outbox.write_for(first_);
    // Before the goal is over: a client that hears of its end may send the next one.
    robot_.control.enter(is_latched ? Phase::latched : Phase::ready);
    robot_.control.goals().finish(result);
  }

  RunTaskResult run(const RunTaskGoal& goal) {
    const auto file = file_of(goal.task, robot_.connection, arguments_);
    if (!file) return refused("task `" + goal.task + "` is unknown: " + known_tasks(robot_.connection));
    lang::LoadOptions options = arguments_.options;
    if (!goal.task.empty()) options.parameters.clear();  // those of the command line are the first task's
    for (const std::string& word : goal.parameters) {
      const std::size_t equals = word.find('=');
      if (equals == std::string::npos) return refused("`" + word + "` is no parameter: write `push=30 N`");
      options.parameters[word.substr(0, equals)] = word.substr(equals + 1);
    }
    lang::Diagnostics diagnostics;
    std::string reason;
    const auto program = load_for(*file, options, robot_.connection, first_, diagnostics, reason);
    if (!program) return refused(reason);
    if (robot_.control.wants_cancel()) return {GoalOutcome::canceled, "cancelled before it began"};
    runtime::Sensed sensed(*program);
    robot_.inbox.fill(sensed);
    if (const std::string trouble = clock_trouble(robot_.connection, *program, robot_.inbox);
        !trouble.empty())
      return refused(trouble);
    robot_.inbox.read_for(*program);
    robot_.outbox.write_for(*program);
    robot_.control.speak_of(*program);
    return run_task(robot_, *program, diagnostics,
                    {numbered(arguments_.log, number_), arguments_.log_rate, arguments_.rotation});
  }

  const Robot& robot_;
  const Arguments& arguments_;
  const lang::Program& first_;
  runtime::Sensed sensed_;
  int number_ = 0;
};

}  // namespace

bool check_goals(const lang::Connection& connection, const Arguments& arguments, const lang::Program& first) {
  bool is_good = true;
  for (const lang::NamedTask& named : connection.tasks) {
    lang::Diagnostics diagnostics;
    std::string reason;
    // The parameters of the command line are the first task's.
    lang::LoadOptions options = arguments.options;
    options.parameters.clear();
    if (load_for(named.file, options, connection, first, diagnostics, reason)) {
      lang::render_human(diagnostics, std::cerr);  // warnings are told here alone, not with each goal
      continue;
    }
    is_good = false;
    std::fprintf(stderr, "zwang drive: task `%s`: %s\n", named.name.c_str(), reason.c_str());
  }
  return is_good;
}

ExitCode drive_goals(const Robot& robot, const Arguments& arguments, const lang::Program& first) {
  robot.control.enter(Phase::ready);
  std::printf("the robot is there: waiting for goals of the action %s/run\n", robot.connection.name.c_str());
  std::fflush(stdout);
  Goals(robot, arguments, first).drive();
  return exit_good;
}

}  // namespace zwang::connect
