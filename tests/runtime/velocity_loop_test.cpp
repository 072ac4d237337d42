// The simulated drive that takes velocities: its loop by its closed form, its line by its sampling.
#include "plant/velocity_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "constants.hpp"
#include "shipped_program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

lang::Program aligning(const std::string& robot) {
  lang::Program program = zwang::test::shipped_files("wall_align.yaml", "robots/limited/" + robot + ".yaml");
  program.scene->start_yaw = 0.0;
  return program;
}

/// All wheels at the rate of the base's speed `v` [m/s] ahead, with `most` [N m] each way.
Command ahead(const lang::Robot& robot, double v, double most) {
  Command command(robot.model.joint_count());
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    command.velocity(wheel.body - 1) = v / wheel.radius;
    command.lower(wheel.body - 1) = -most;
    command.upper(wheel.body - 1) = most;
  }
  return command;
}

/// m v' = m/T_c ((V - v) + 1/T_i integral of (V - v)). So the error e = V - v has e'' + e'/T_c + e/(T_c T_i)
/// = 0 from e = V and e' = -V/T_c.
double speed_after(double t, double V, const lang::Drive& drive) {
  const double a = 1.0 / drive.time_constant;
  if (!drive.integral_time) return V * (1.0 - std::exp(-a * t));
  const double root = std::sqrt(a * a - 4.0 * a / *drive.integral_time);
  const double fast = 0.5 * (-a - root), slow = 0.5 * (-a + root);
  const double of_fast = (-a - slow) / (fast - slow);
  return V * (1.0 - of_fast * std::exp(fast * t) - (1.0 - of_fast) * std::exp(slow * t));
}

TEST(VelocityLoop, AFreeBaseFollowsAStepByItsClosedForm) {
  for (const bool has_integral : {true, false}) {
    lang::Program program = aligning("mecanum_1_khz");
    if (!has_integral) program.robot.drive.integral_time.reset();
    ScenePlantOptions options;
    options.simulation.period = 0.25 * ms;
    ScenePlant plant(program, options);
    const double V = 0.02;  // the motors can follow: m V/T_c is 57 N of 101 N
    const Command command = ahead(program.robot, V, 20.0);
    for (int i = 0; i < 1200; ++i) {
      ASSERT_EQ(plant.follow(command), PlantStatus::ok);
      const double t = plant.truth().time;
      // A step of the simulation is 1/80 of T_c: explicit Euler is off by half of that, and by a step at
      // first.
      ASSERT_NEAR(plant.truth().velocity.x(), speed_after(t, V, program.robot.drive), V / 80.0) << t;
    }
  }
}

// Of three omni wheels each turns for half of a way, in the mean of its directions.
TEST(VelocityLoop, ABaseOnOmniWheelsFollowsAStepAsSoon) {
  lang::Program program = aligning("omni_1_khz");
  program.robot.drive.takes_twist = program.robot.drive.limit_is_fixed = true;
  ScenePlantOptions options;
  options.simulation.period = 0.25 * ms;
  for (const int axis : {0, 1}) {
    ScenePlant plant(program, options);
    const double V = 5e-3;
    Command command(program.robot.model.joint_count());
    command.twist(axis) = V;
    for (int i = 0; i < 600; ++i) {
      ASSERT_EQ(plant.follow(command), PlantStatus::ok);
      const double speed = plant.truth().velocity(axis);
      ASSERT_NEAR(speed, speed_after(plant.truth().time, V, program.robot.drive), V / 80.0) << axis;
    }
  }
}

TEST(VelocityLoop, AtABlockedWheelTheTorqueRestsOnItsLimit) {
  const lang::Program program = aligning("mecanum_1_khz");
  VelocityLoop loop(program.robot);
  const Command command = ahead(program.robot, 0.05, 0.5);
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(program.robot.model.joint_count());
  Eigen::VectorXd torque;
  for (int i = 0; i < 10000; ++i) torque = loop.step(command, still, ms);
  for (const solver::Wheel& wheel : program.robot.model.wheels()) EXPECT_EQ(torque(wheel.body - 1), 0.5);
  // The integral did not wind up: told to roll back, the loop lets go at once.
  torque = loop.step(ahead(program.robot, -0.05, 0.5), still, ms);
  for (const solver::Wheel& wheel : program.robot.model.wheels()) EXPECT_LT(torque(wheel.body - 1), 0.5);
  // And no bound is wider than the motor's own limit.
  for (int i = 0; i < 100000; ++i) torque = loop.step(ahead(program.robot, 1.0, 1e3), still, ms);
  for (const solver::Wheel& wheel : program.robot.model.wheels())
    EXPECT_EQ(torque(wheel.body - 1), program.robot.model.joint(wheel.body - 1).max_effort);
}

TEST(VelocityLoop, ItsTorqueLimitIsWhatThePlantPressesWith) {
  lang::Program program = aligning("mecanum_50_hz");
  ScenePlant plant(program);
  const double most = 0.4;  // [N m]
  const Command command = ahead(program.robot, 0.1, most);
  while (plant.truth().time < 8.0) ASSERT_EQ(plant.follow(command), PlantStatus::ok);
  const double radius = program.robot.model.wheels().front().radius;
  ASSERT_TRUE(plant.truth().objects[0].touched);
  EXPECT_NEAR(plant.truth().objects[0].force, 4.0 * most / radius, 0.02);
}

/// A value that arrives at t was taken at the last multiple of the cycle before t - delay.
TEST(SampledLine, HandsOnWhatWasTakenACycleAndADelayAgo) {
  for (const double delay : {0.0, 3 * ms, 25 * ms}) {
    const double cycle = 10 * ms;
    SampledLine<double> line(cycle, delay, -1.0);
    for (int i = 0; i < 500; ++i) {
      const double t = i * ms;
      const double taken = std::floor((t - delay) / cycle + 1e-6) * cycle;
      EXPECT_NEAR(line.pass(t, t), taken < 0.0 ? -1.0 : taken, 1e-9) << t << ", " << delay;
    }
  }
}

TEST(ScenePlant, ADriveThatTakesVelocitiesRefusesTorques) {
  const lang::Program program = aligning("mecanum_50_hz");
  ScenePlant plant(program);
  EXPECT_EQ(plant.apply(Eigen::VectorXd::Zero(4)), PlantStatus::unreachable);
}

}  // namespace
}  // namespace zwang::runtime
