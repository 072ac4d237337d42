// The protective stop of drives with torque limits of their own, where a motor turns the wrong way. The test
// has a loop of its own with a delay; the plant judges a base.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "constants.hpp"
#include "drive/led_program.hpp"
#include "drive/loop_gain.hpp"
#include "drive/velocity_drive.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

lang::Program with_wrench(const std::string& robot) {
  return zwang::test::feeling_program("wall_align", robot, "wall_far");
}

struct CounteredWheel {
  double gain = 0.0;     ///< [rad/s^2] by its motor's limit
  double late = 0.0;     ///< [s] from a sample to what its command does
  double fastest = 0.0;  ///< [rad/s]
  double last = 0.0;     ///< [rad/s] the largest of the last second
  double most_told = 0.0;
};

/// A wheel that was told 1 rad/s and turns with `rate` when the stop begins. v' = sign (V - v)/T_c, up to the
/// motor's limit; `sign` is -1 of a reversed motor, and 0 where something holds the wheel.
CounteredWheel stop_with(const std::string& robot, double rate, double sign) {
  const lang::Robot real = with_wrench(robot).robot;
  const lang::Robot led = led_program(with_wrench(robot)).robot;
  const lang::Drive& d = led.drive;
  VelocityDrive drive(led, ms, 1);
  Command command(led.model.joint_count());
  solver::State state(led.model);
  const int joint = *led.model.find_joint("left_wheel");
  const double R = 130e-3;
  CounteredWheel wheel;
  wheel.gain = real.model.joint(joint).max_effort / (0.5 * driven_mass(real) * R * R);
  wheel.late = d.delay + 2.0 / d.rate;
  const auto on_way = static_cast<std::size_t>(std::lround(0.5 * d.delay / ms)) + 1;
  const long cycle = std::lround(1.0 / (d.rate * ms));
  std::vector<double> rates(on_way, rate), told(on_way, 1.0);
  double v = rate, V = 1.0;
  command.velocity(joint) = command.twist.x() = 1.0;
  drive.brake(nullptr, -1, command);  // remembers that it is told to move
  for (long i = 0; i < 3000; ++i) {
    const auto k = static_cast<std::size_t>(i) % on_way;
    if (i % cycle == 0) {
      state.qd(joint) = rates[k];
      drive.look(state, static_cast<double>(i) * ms);
    }
    drive.brake(&state.qd, joint, command);
    wheel.most_told = std::max(wheel.most_told, std::abs(command.velocity(joint)));
    if (i % cycle == 0) V = told[k];
    told[k] = command.velocity(joint);
    rates[k] = v;
    v += ms * std::clamp(sign * (V - v) / d.time_constant, -wheel.gain, wheel.gain);
    wheel.fastest = std::max(wheel.fastest, std::abs(v));
    if (i >= 2000) wheel.last = std::max(wheel.last, std::abs(v));
  }
  return wheel;
}

/// It swings by what its motor gives it until a command acts, both ways. Told 0, it would gain for 3 s.
TEST(CounteredWheel, AReversedMotorIsHeld) {
  for (const char* robot : {"diff_wrench_1_khz", "diff_wrench_100_hz", "diff_wrench_50_hz"}) {
    const CounteredWheel wheel = stop_with(robot, 5.0, -1.0);
    std::printf("%s: %.2f rad/s, then %.3f rad/s\n", robot, wheel.fastest, wheel.last);
    EXPECT_LT(wheel.fastest, 5.0 + wheel.gain * wheel.late) << robot;
    EXPECT_LT(wheel.last, 2.0 * wheel.gain * wheel.late) << robot;
  }
}

/// A sound motor that something turned gains until that is seen, and is told 0.
TEST(CounteredWheel, ASoundMotorIsToldToStandAgain) {
  for (const char* robot : {"diff_wrench_1_khz", "diff_wrench_50_hz"}) {
    const CounteredWheel wheel = stop_with(robot, 5.0, 1.0);
    const double seen = wheel.late + 20 * ms + 2.0 * wheel.late;
    EXPECT_LT(wheel.fastest, 5.0 + wheel.gain * seen + VelocityDrive::gained / 130e-3) << robot;
    EXPECT_LT(wheel.last, 1e-3) << robot;
  }
}

/// A wheel that a wall holds is slower than told when the stop begins. Nothing counters it: that would press
/// on the wall, or go along with a hand that turns it later.
TEST(CounteredWheel, AWheelThatIsHeldIsOnlyToldLess) {
  for (const double rate : {0.0, 0.3}) {
    const CounteredWheel wheel = stop_with("diff_wrench_50_hz", rate, 0.0);
    EXPECT_LE(wheel.most_told, 1.0) << rate;
  }
}

/// A reversed motor drives half of the base for 0.3 s, until it is told and the command acts.
TEST(CounteredWheel, ABaseWithAReversedMotorIsHeldInTheStop) {
  const lang::Program program = with_wrench("diff_wrench_50_hz");
  ScenePlantOptions options;
  options.faults.push_back({.kind = lang::FaultKind::torque_flipped, .at = 2.5, .joint = "left_wheel"});
  ScenePlant plant(program, options);
  Runner runner(program);
  Sensed sensed(program);
  double fastest = 0.0;
  while (plant.truth().time < 8.0) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    runner.step(sensed);
    ASSERT_EQ(plant.follow(runner.command()), PlantStatus::ok);
    fastest = std::max(fastest, plant.truth().velocity.head<2>().norm());
  }
  const lang::Drive& drive = program.robot.drive;
  const double gain = 10.3 / 0.13 / driven_mass(program.robot);  // [m/s^2]
  std::printf("%.2f m/s\n", fastest);
  EXPECT_EQ(runner.guard().reason(), EventCode::not_followed);
  EXPECT_LT(fastest, 0.08 + gain * (0.3 + drive.delay + 3.0 / drive.rate));
}

}  // namespace
}  // namespace zwang::runtime
