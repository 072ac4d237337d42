// The program behind `zwang simulate`: the scene's robot behind the topics of a connection, at the pace of
// real time. The world begins to move with the first command.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>

#include "../cli/interruption.hpp"
#include "arguments.hpp"
#include "inbox.hpp"
#include "lateness.hpp"
#include "robot_side.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace {

using namespace zwang;
using namespace zwang::connect;

constexpr double most_behind = 0.1;     // [s] a world that is farther behind goes on from where it is
constexpr double silent_for = 0.5;      // [s] without a command, at rest: the other side has ended
constexpr double longest_silent = 5.0;  // [s] without a command, while the world still moves
constexpr double at_rest = 1e-3;        // [m/s]
constexpr double longest_wait = 0.5;    // [s] of this computer, for a command that is due
constexpr double look_again = 0.2e-3;   // [s]

struct World {
  runtime::ScenePlant plant;
  runtime::SimulationSteps steps;
  runtime::Sensed sensed;
  double measured_at = -1.0;  ///< [s] of the sample that was published last

  World(const lang::Program& program, std::uint64_t seed)
      : plant(program, {.simulation = {}, .seed = seed, .faults = {}}),
        steps(program.robot.control_period),
        sensed(program) {}
};

struct Happenings {
  Lateness lateness;
  bool has_begun = false;     ///< a command has come
  double moved_last = 0.0;    ///< [s] of the world: when the base was last seen to move
  double silent_since = 0.0;  ///< [s] of the world: when the last command had come
};

/// One step of the world; `shift` is the stamps' clock less the world's.
runtime::PlantStatus step(const lang::Connection& connection, RobotSide& side, World& world, double shift) {
  const runtime::PlantStatus sensed = world.plant.sense(world.sensed);
  if (sensed == runtime::PlantStatus::diverged) return sensed;
  const double measured = world.sensed.measured_at.value_or(world.sensed.time);
  const bool is_due = world.steps.tick_is_due();
  if (is_due) side.tell_time(world.plant.truth().time + shift);
  // A drive that takes velocities tells of its samples as seldom as it has them.
  const bool is_new = world.sensed.measured_at ? measured != world.measured_at : is_due;
  if (sensed == runtime::PlantStatus::ok && is_new) {
    world.measured_at = measured;
    if (connection.base && !world.sensed.base_measured) {
      runtime::Sensed with_base = world.sensed;
      with_base.state.base_pose = world.plant.true_state().base_pose;
      with_base.state.base_twist = world.plant.true_state().base_twist;
      side.publish(with_base, measured + shift, shift);
    } else {
      side.publish(world.sensed, measured + shift, shift);
    }
  }
  return world.plant.follow(side.command(world.sensed.time + shift));
}

/// Stands still, and says so, until a command comes. A peer may be found at any moment, so each sample
/// repeats the values that have not changed. A clock of its own runs before the world does, in steps of any
/// size, so that the other side can tick.
void wait_for_command(RobotSide& side, World& world, const lang::Robot& robot, Happenings& happenings) {
  if (world.plant.sense(world.sensed) != runtime::PlantStatus::ok) return;
  const double period = robot.control_period;
  const double sample_period = robot.drive.takes_velocity ? 1.0 / robot.drive.rate : period;
  const double begin = now();
  double sample_due = begin;
  for (double due = begin; !cli::is_interrupted() && !happenings.has_begun; due += period) {
    sleep_until(due);
    side.tell_time(due - begin);
    if (due > sample_due - 0.5 * period) {
      side.tell_again();
      side.publish(world.sensed, side.time(), side.time());
      sample_due += sample_period;
    }
    side.command(side.time());
    happenings.has_begun = side.newest().has_come;
  }
}

/// With a clock of its own the world stands while a command or a tick of the other side is due. A busy
/// machine is slow then, and not late. A message that was lost may have both sides wait for each other. The
/// world makes one step before the other side takes the robot for dead. A controller that is silent for
/// `longest_wait` is not waited for until its next command.
class InStep {
 public:
  InStep(const lang::Connection& connection, double period)
      : is_on_(connection.clock.has_value()),
        most_(1.5 * std::max(period, 1.0 / connection.command.rate.value_or(1.0 / period))),
        most_ticks_(1.5 * period),
        longest_step_(0.5 * connection.joints.stale_after) {}

  void wait(RobotSide& side) {
    if (!is_on_) return;
    const double begin = now();
    for (side.command(side.time()); !is_served(side, begin); side.command(side.time()))
      sleep_until(now() + look_again);
  }

 private:
  bool is_served(const RobotSide& side, double begin) {
    const double time = now(), arrival = side.newest().arrival;
    const std::optional<double> ticked = side.ticked();
    if (arrival != last_arrival_ || ticked != last_tick_)
      last_arrival_ = arrival, last_tick_ = ticked, silent_since_ = time;
    const bool is_in_step =
        side.time() - arrival <= most_ && (!ticked || side.time() - *ticked <= most_ticks_);
    return is_in_step || time - begin > longest_step_ || time - silent_since_ > longest_wait ||
           cli::is_interrupted();
  }

  bool is_on_;
  double most_;                 // [s] of the world, between two commands
  double most_ticks_;           // [s] of the world, between two ticks of the other side
  double longest_step_;         // [s] of this computer
  double last_arrival_ = -1.0;  // [s] of the world
  std::optional<double> last_tick_;
  double silent_since_ = 0.0;  // [s] of this computer
};

runtime::PlantStatus run(const lang::Connection& connection, const lang::Program& program, RobotSide& side,
                         World& world, const std::optional<double>& stuck_odometry, Happenings& happenings) {
  double shift = side.time() - world.plant.truth().time;
  InStep in_step(connection, program.robot.control_period);
  for (double due = now(); !cli::is_interrupted(); due += world.steps.period()) {
    in_step.wait(side);
    sleep_until(due);
    happenings.lateness.add(std::max(0.0, now() - due));
    if (now() - due > most_behind) {
      // With a clock of its own the world may be slower than real time.
      if (!connection.clock) shift += now() - due;
      due = now();
    }
    const runtime::PlantStatus status = step(connection, side, world, shift);
    if (status != runtime::PlantStatus::ok || world.plant.truth().base.fallen) return status;
    const solver::MotionVector& twist = world.plant.true_state().base_twist;
    const double time = world.plant.truth().time;
    if (stuck_odometry && time >= *stuck_odometry) side.hold_odometry();
    if (std::hypot(twist.linear.x(), twist.linear.y()) > at_rest || std::abs(twist.angular.z()) > at_rest)
      happenings.moved_last = time;
    happenings.silent_since = side.newest().arrival - shift;
    const double silence = time - happenings.silent_since;
    // Between two runs no commands come.
    if (connection.begin != lang::Begin::at_once && side.is_heard()) continue;
    if (silence > longest_silent || (silence > silent_for && time - happenings.moved_last > silent_for))
      break;
  }
  return runtime::PlantStatus::ok;
}

void print_report(const World& world, const Happenings& happenings) {
  const runtime::Truth& truth = world.plant.truth();
  constexpr double degrees = 57.29577951308232;
  std::printf("simulated %.2f s: base at %.4f m, %.4f m, yaw %.3f deg\n", truth.time, truth.x, truth.y,
              truth.yaw * degrees);
  for (const runtime::ObjectTruth& object : truth.objects)
    std::printf("%s: force %.2f N, peak %.2f N\n", object.name.c_str(), object.force, object.peak_force);
  std::printf("last command at %.3f s, moved last at %.3f s\n", happenings.silent_since,
              happenings.moved_last);
  const Lateness& l = happenings.lateness;
  std::printf("steps %llu: late by median %.2f, p99 %.2f, most %.2f ms\n",
              static_cast<unsigned long long>(l.ticks()), 1e3 * l.quantile(0.5), 1e3 * l.quantile(0.99),
              1e3 * l.most());
  std::fflush(stdout);
}

int simulate(const Arguments& arguments) {
  lang::Diagnostics diagnostics;
  const std::optional<Loaded> loaded = load(arguments, diagnostics);
  if (!loaded) return exit_bad;
  if (!loaded->program.scene) {
    std::fprintf(stderr, "zwang simulate: the task names no scene; give one with --scene FILE\n");
    return exit_impossible;
  }
  cli::catch_interruption();
  become_punctual(loaded->connection.priority);
  World world(loaded->program, arguments.seed);
  RobotSide side(loaded->connection, loaded->program, arguments.stamps_ahead);
  Participant participant(loaded->connection, "zwang_simulated_robot");
  side.join(participant);
  Happenings happenings;
  wait_for_command(side, world, loaded->program.robot, happenings);
  runtime::PlantStatus status = runtime::PlantStatus::ok;
  if (!cli::is_interrupted()) {
    status = run(loaded->connection, loaded->program, side, world, arguments.stuck_odometry, happenings);
  }
  side.leave();
  participant.close();
  print_report(world, happenings);
  if (world.plant.truth().base.fallen) std::printf("the robot fell over\n");
  if (status != runtime::PlantStatus::ok) std::printf("the simulation %s\n", runtime::to_string(status));
  return status == runtime::PlantStatus::ok && !world.plant.truth().base.fallen ? exit_good : exit_bad;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return simulate(parse_arguments(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "zwang simulate: %s\n", error.what());
    return exit_impossible;
  }
}
