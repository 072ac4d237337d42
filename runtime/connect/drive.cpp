// The program behind `zwang drive`: a task on a robot that speaks ROS 2.
#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <thread>

#include "../cli/interruption.hpp"
#include "arguments.hpp"
#include "goals.hpp"
#include "observe.hpp"
#include "task_run.hpp"

namespace {

using namespace zwang;
using namespace zwang::connect;

void pause() {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

std::optional<std::string> what_is_missing(const lang::Connection& connection, const Inbox& inbox,
                                           const Outbox& outbox, bool feels_by_effort) {
  if (!inbox.clock().has_come()) return "no time on " + connection.clock->name + ", or it stands,";
  if (!inbox.has_joints())
    return "no sample of every motor's joint" + std::string(feels_by_effort ? ", with its effort," : "") +
           " on " + connection.joints.topic.name;
  if (!inbox.has_base()) return "no odometry on " + connection.base->name;
  if (!inbox.has_wrench()) return "no wrench on " + connection.wrench->name;
  if (outbox.readers() <= 0) return "nobody listens to " + connection.command.topic.name;
  return std::nullopt;
}

/// A signal's publisher may be found later than that of the joints, and the first task may require it. A
/// signal that is silent for so long is unknown: a switch may speak only when it is pressed.
void wait_for_signals(Inbox& inbox, runtime::Sensed& sensed) {
  constexpr double longest = 1.0;  // [s]
  for (const double until = now() + longest; !inbox.has_signals() && now() < until && !cli::is_interrupted();
       pause())
    inbox.fill(sensed);
}

/// Waits for samples and for a reader of the commands. Reports the missing part when it gives up.
bool wait_for_robot(const lang::Connection& connection, const lang::Drive& drive, Inbox& inbox,
                    const Outbox& outbox, double most, runtime::Sensed& sensed) {
  const bool feels_by_effort = drive.feels.by == lang::Feels::By::effort;
  const double until = now() + most;
  std::optional<std::string> missing = what_is_missing(connection, inbox, outbox, feels_by_effort);
  for (; missing && now() < until && !cli::is_interrupted(); pause()) {
    inbox.fill(sensed);
    missing = what_is_missing(connection, inbox, outbox, feels_by_effort);
  }
  if (!missing) {
    wait_for_signals(inbox, sensed);
    return true;
  }
  std::fprintf(stderr, "zwang drive: %s in domain %d within %g s; nothing was sent\n", missing->c_str(),
               connection.domain, most);
  return false;
}

/// Waits for a call of the service `start`. False: the run was ended before.
bool wait_for_start(const lang::Connection& connection, Inbox& inbox, Control& control,
                    runtime::Sensed& sensed) {
  control.enter(Phase::ready);
  if (connection.begin != lang::Begin::service) return true;
  std::printf("the robot is there: waiting for the service %s/start\n", connection.name.c_str());
  std::fflush(stdout);
  for (; !control.take_start(); pause()) {
    inbox.fill(sensed);
    if (cli::is_interrupted() || control.wants_stop()) return false;
  }
  inbox.fill(sensed);
  return true;
}

bool is_clock_good(const Robot& robot, const lang::Program& program) {
  const std::string trouble = clock_trouble(robot.connection, program, robot.inbox);
  if (!trouble.empty()) std::fprintf(stderr, "zwang drive: %s; nothing was sent\n", trouble.c_str());
  return trouble.empty();
}

/// Behind the protective stop, until the service `reset` is called. False: somebody ended it before.
bool wait_for_reset(Robot& robot, runtime::Sensed& sensed) {
  robot.control.enter(Phase::latched);
  std::printf("latched: waiting for the service %s/reset\n", robot.connection.name.c_str());
  std::fflush(stdout);
  for (; robot.control.is_latched(); pause()) {
    robot.inbox.fill(sensed);
    if (cli::is_interrupted() || robot.control.wants_stop()) return false;
  }
  return true;
}

/// With `start: wait` a protective stop ends the run and not the process: `reset` and `start` begin it anew.
ExitCode drive_task(Robot& robot, const Arguments& arguments, const lang::Program& program,
                    const lang::Diagnostics& diagnostics) {
  runtime::Sensed sensed(program);
  std::optional<std::string> log = arguments.log;
  for (int number = 2;; ++number) {
    const GoalOutcome outcome =
        run_task(robot, program, diagnostics, {log, arguments.log_rate, arguments.rotation}).outcome;
    if (outcome == GoalOutcome::done) return exit_good;
    if (outcome != GoalOutcome::stopped || robot.connection.begin != lang::Begin::service) return exit_bad;
    if (cli::is_interrupted() || robot.control.wants_stop() || !wait_for_reset(robot, sensed))
      return exit_bad;
    robot.control.speak_of(program);
    robot.inbox.read_for(program);
    robot.outbox.write_for(program);
    if (!wait_for_start(robot.connection, robot.inbox, robot.control, sensed) ||
        !is_clock_good(robot, program))
      return exit_bad;
    log = numbered(arguments.log, number);
  }
}

int drive(const Arguments& arguments) {
  lang::Diagnostics diagnostics;
  const std::optional<Loaded> loaded = load(arguments, diagnostics);
  if (!loaded) return exit_bad;
  const lang::Connection& connection = loaded->connection;
  if (!check_goals(connection, arguments, loaded->program)) return exit_bad;
  cli::catch_interruption();
  Inbox inbox(connection, loaded->program);
  Participant participant(connection, "zwang");
  inbox.subscribe(participant);
  // Behind joining DDS: in front of it, another robot's drive on this computer was 25 ms late.
  become_punctual(connection.priority);
  if (arguments.observe) return observe(connection, loaded->program, inbox, *arguments.observe);

  Outbox outbox(connection, loaded->program, participant);
  runtime::Sensed sensed(loaded->program);
  Control control(connection, loaded->program, participant,
                  [&] { return inbox.silence() < connection.joints.stale_after; });
  const bool is_ready =
      wait_for_robot(connection, loaded->program.robot.drive, inbox, outbox, arguments.wait, sensed) &&
      wait_for_start(connection, inbox, control, sensed);
  Robot robot{connection, inbox, outbox, control, {}};
  if (!is_ready || !is_clock_good(robot, loaded->program)) return exit_impossible;
  if (arguments.options.robot) robot.named_robot = arguments.options.robot->string();
  const ExitCode code = connection.begin == lang::Begin::goals
                            ? drive_goals(robot, arguments, loaded->program)
                            : drive_task(robot, arguments, loaded->program, diagnostics);
  control.enter(Phase::ended);
  if (participant.foreign() > 0)
    std::printf("%llu messages of other machines were not taken\n",
                static_cast<unsigned long long>(participant.foreign()));
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return drive(parse_arguments(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "zwang drive: %s\n", error.what());
    return exit_impossible;
  }
}
