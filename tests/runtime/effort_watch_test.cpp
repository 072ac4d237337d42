// The measured torques of motors behind velocity loops. A loop that the test computes by itself, at a wheel
// with friction and a wall, is never missed. A motor that gives nothing, keeps its torque or gives the
// contrary is.
#include "drive/effort_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "constants.hpp"
#include "drive/led_program.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

lang::Program with_efforts(const std::string& robot) {
  return zwang::test::feeling_program("wall_align", robot, "wall_far");
}

/// A quarter of a base behind a loop. It starts with 0.3 m/s^2, keeps 0.1 m/s, and meets a wall of 10 kN/m.
struct BenchWheel {
  double mass = 14.0, radius = 75.9e-3;         // [kg], [m]
  double time_constant = 0.0, integral = 0.0;   // [s]
  double hold_from = 0.0;                       // [s] the drive takes its first command
  std::function<double(double, double)> fault;  // of the time and the loop's torque

  static constexpr double touches = 1.5;  // [s]
  static double told(double t) {          // [rad/s]
    const double v = std::min(0.3 * t, 0.1);
    return (t < touches + 0.1 ? v : v * std::exp(-(t - touches - 0.1) / 0.1)) / 75.9e-3;
  }

  /// When the watch finds it; -1: never, in 5 s.
  double found_at(const lang::Robot& led) const {
    constexpr double step = 0.25 * ms;
    const lang::Drive& drive = led.drive;
    const double k_p = mass * radius * radius / time_constant;
    EffortWatch watch(led, ms);
    Sensed sensed(led.model);
    sensed.effort = Eigen::VectorXd::Zero(led.model.joint_count());
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, drive.feels.noise);
    const int joint = *led.model.find_joint("front_left_wheel");
    Eigen::VectorXd command = Eigen::VectorXd::Zero(led.model.joint_count());
    double v = 0.0, q = 0.0, sum = 0.0, filtered = 0.0, measured_at = 0.0, from = 0.0;
    const auto cycle = std::lround(1.0 / (drive.rate * step));
    for (long i = 0; i < 20000; ++i) {
      const double t = static_cast<double>(i) * step;
      if (i % 4 == 0) {
        if (t >= measured_at + 0.5 * drive.delay && from != measured_at) {
          from = measured_at;
          if (watch.look(sensed, measured_at)) return t;
        }
        command(joint) = told(t);
        watch.tell(command, t);
      }
      if (i % cycle == 0 && t >= 1.0 / drive.rate) {
        measured_at = t;
        sensed.state.q(joint) = q;
        sensed.state.qd(joint) = v;
        sensed.effort(joint) = filtered + noise(random);
      }
      // The command of the last tick before the cycle, and delay/2 on its way.
      const double cycles = std::floor((t - 0.5 * drive.delay - hold_from) * drive.rate);
      const double taken = std::floor((hold_from + cycles / drive.rate) / ms) * ms;
      const double error = told(std::max(0.0, taken)) - v;
      const double torque = std::clamp(k_p * error + sum, -1.9, 1.9);
      sum += std::abs(torque) < 1.9 ? k_p / integral * error * step : 0.0;
      const double given = fault ? fault(t, torque) : torque;
      filtered += step / drive.feels.filter * (given - filtered);
      const double friction = 0.1 * std::tanh(v / 0.01);
      const double wall = std::max(0.0, 10e3 / 4.0 * radius * radius * (q - way_to_the_wall()));
      // Where the motor fails, the other wheels of the base turn this one.
      v += step * (torque - friction - wall - 0.05 * wall * v) / (mass * radius * radius);
      q += step * v;
    }
    return -1.0;
  }
  double way_to_the_wall() const { return (0.1 * touches - 0.1 * 0.1 / 0.6) / radius; }
};

/// The robot's own mass is not in the robot file's T_c alone: loops of half and of twice the gains are sound.
TEST(EffortWatch, ASoundLoopIsNeverMissed) {
  for (const char* name : {"mecanum_effort_1_khz", "mecanum_effort_100_hz", "mecanum_effort_50_hz"}) {
    const lang::Program led = led_program(with_efforts(name));
    const double cycle = 1.0 / led.robot.drive.rate;
    for (const double gain : {0.5, 1.0, 2.0}) {
      for (const double phase : {0.0, 0.4, 0.8}) {
        const BenchWheel wheel{
            .time_constant = 20 * ms / gain, .integral = 100 * ms, .hold_from = phase * cycle};
        EXPECT_EQ(wheel.found_at(led.robot), -1.0) << name << ", " << gain << ", " << phase;
      }
    }
  }
}

/// A motor that fails while it stands does no harm before the wall. There it is missed once the press is
/// built up: 0.2 s, and the time of both low passes, of which three time constants count.
TEST(EffortWatch, AMotorThatFailsIsFoundAtTheWall) {
  const auto lost = [](double, double) { return 0.0; };
  const auto stuck = [](double, double) { return 0.03; };
  const auto contrary = [](double, double torque) { return -0.5 * torque; };
  for (const char* name : {"mecanum_effort_1_khz", "mecanum_effort_100_hz", "mecanum_effort_50_hz"}) {
    const lang::Program led = led_program(with_efforts(name));
    const double latest = BenchWheel::touches + 0.1 + EffortWatch::lasts + 3.0 * EffortWatch::smoothing;
    for (const auto& fault :
         {std::function<double(double, double)>(lost), std::function<double(double, double)>(stuck),
          std::function<double(double, double)>(contrary)}) {
      const BenchWheel wheel{.time_constant = 20 * ms, .integral = 100 * ms, .fault = fault};
      const double found = wheel.found_at(led.robot);
      EXPECT_GT(found, 0.0) << name;
      EXPECT_LT(found, latest) << name;
    }
  }
}

/// Told once for each time at the limit, and not below it.
TEST(EffortWatch, AMotorAtItsLimitIsToldOnce) {
  const lang::Program led = led_program(with_efforts("mecanum_effort_50_hz"));
  const double limit = led.robot.model.joint(0).max_effort / led.robot.drive.mass_factor;
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(led.robot.model.joint_count());
  for (const double share : {0.8, 1.0}) {
    EffortWatch watch(led.robot, 20 * ms);
    Sensed sensed(led.robot.model);
    sensed.effort = nothing;
    int told = 0;
    double first = 0.0;
    const int joint = *led.robot.model.find_joint("rear_left_wheel");
    for (int i = 0; i < 200; ++i) {
      const double t = 20 * ms * i;
      sensed.effort(joint) = (t > 0.99 && t < 1.99) || t > 2.99 ? -share * limit : 0.0;
      watch.look(sensed, t);
      if (const auto found = watch.look_at_limits(t)) {
        EXPECT_EQ(found->code, EventCode::drive_at_limit);
        EXPECT_EQ(event_signal::joint_of(found->signal), joint);
        if (told++ == 0) first = t;
      }
      watch.tell(nothing, t);
    }
    EXPECT_EQ(told, share < 1.0 ? 0 : 2) << share;
    // |effort| passes 0.9 after ln(10) of the low pass.
    if (told == 0) continue;
    EXPECT_NEAR(first, 1.0 + EffortWatch::lasts + std::log(10.0) * EffortWatch::smoothing, 30 * ms);
  }
}

struct FoundFault {
  EventCode reason = EventCode::none;
  double stopped = 0.0, touched = 0.0;  ///< [s]
  bool is_limit_told = false;
};

FoundFault align_with(const std::string& robot, lang::FaultKind kind, const std::string& wheel, double from,
                      double at) {
  lang::Program program = with_efforts(robot);
  program.scene->start_at = {from, 0.0};
  ScenePlantOptions options;
  options.faults.push_back({.kind = kind, .at = at, .joint = wheel});
  ScenePlant plant(program, options);
  Runner runner(program);
  Sensed sensed(program);
  while (!runner.guard().stopped() && !runner.finished() && plant.truth().time < 10.0) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    runner.step(sensed);
    EXPECT_EQ(plant.follow(runner.command()), PlantStatus::ok);
  }
  FoundFault result{.reason = runner.guard().reason(), .stopped = plant.truth().time};
  result.touched = plant.truth().objects[0].touched.value_or(-1.0);
  result.is_limit_told = std::ranges::count(runner.events(), EventCode::drive_at_limit, &Event::code) > 0;
  return result;
}

/// Before, a mecanum base whose motor was lost squared up and was `done`. Others:
/// specs/scenarios/faults_felt.yaml.
TEST(EffortWatch, ALostOrStuckMotorIsFoundOnceTheBaseLeansOnTheWall) {
  for (const lang::FaultKind kind : {lang::FaultKind::torque_lost, lang::FaultKind::torque_stuck}) {
    const FoundFault fault = align_with("mecanum_effort_50_hz", kind, "front_left_wheel", 0.72, 0.2);
    std::printf("%s %.2f s after contact\n", to_string(fault.reason), fault.stopped - fault.touched);
    EXPECT_EQ(fault.reason, EventCode::effort_lost);
    EXPECT_GT(fault.touched, 0.0);
    EXPECT_LT(fault.stopped - fault.touched, 0.6);
  }
}

/// A reversed motor's loop runs away up to its limit.
TEST(EffortWatch, AReversedMotorIsAtItsLimit) {
  const FoundFault fault =
      align_with("diff_effort_100_hz", lang::FaultKind::torque_flipped, "left_wheel", 0.4, 2.5);
  EXPECT_NE(fault.reason, EventCode::none);
  EXPECT_TRUE(fault.is_limit_told);
}

}  // namespace
}  // namespace zwang::runtime
