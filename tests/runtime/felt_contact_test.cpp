// A robot that feels, on a drive with torque limits of its own. A force moves its virtual robot by Newton's
// law. A wall of the plant squares the robot up.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "constants.hpp"
#include "drive/contact_response.hpp"
#include "drive/led_program.hpp"
#include "recorded_run.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

/// qdd of a robot at rest that no row holds, after `samples` of what the sensor tells.
Eigen::VectorXd accelerated(const lang::Program& led, const solver::ForceVector& wrench, int samples) {
  const lang::Robot& robot = led.robot;
  solver::Solver solver(robot.model, {.base_motion = true});
  solver::Solution solution(robot.model);
  solver::State state(robot.model);
  EXPECT_EQ(solver.project_velocity(state), solver::Status::ok);
  EXPECT_EQ(solver.solve(state, std::vector<solver::Row>{}, solution), solver::Status::ok);
  ContactResponse response(robot, 1 * ms);
  Sensed sensed(led);
  sensed.contact_wrench = wrench;
  for (int i = 0; i < samples; ++i) response.feel(sensed, i / robot.drive.rate);
  Eigen::VectorXd qdd = solution.qdd;
  response.accelerate(solver, solution, state, Eigen::VectorXd::Constant(qdd.size(), solver::infinity), qdd);
  return qdd - solution.qdd;
}

/// [kg] of wheels that all roll ahead, with the rotors' share, as the URDF and the robot file say.
double driven_mass(const lang::Robot& robot) {
  double mass = 0.0;
  for (const solver::Body& body : robot.model.bodies()) mass += body.inertia.mass;
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const solver::Body& body = robot.model.bodies()[static_cast<std::size_t>(wheel.body)];
    mass += (body.joint.axis.dot(body.inertia.rotational * body.joint.axis) + body.joint.rotor_inertia) /
            (wheel.radius * wheel.radius);
  }
  return mass;
}

/// F = alpha M a.
TEST(FeltContact, APushAcceleratesTheVirtualRobotByItsMass) {
  const lang::Program program =
      zwang::test::feeling_program("wall_align", "mecanum_wrench_50_hz", "wall_far");
  const lang::Program led = led_program(program);
  const double push = -30.0;
  const Eigen::VectorXd qdd = accelerated(led, {{0.0, 0.0, 0.0}, {push, 0.0, 0.0}}, 1);
  const double expected = push / (program.robot.drive.mass_factor * driven_mass(program.robot));
  for (const solver::Wheel& wheel : led.robot.model.wheels())
    EXPECT_NEAR(qdd(wheel.body - 1) * wheel.radius, expected, 1e-6 * std::abs(expected));
}

/// w after a second of constant torques `t` [N m] at all wheels, which gain `gain` [rad/s^2].
solver::Vector3 felt_by_effort(const lang::Program& led, double t, double gain) {
  const lang::Robot& robot = led.robot;
  solver::Solver solver(robot.model, {.base_motion = true});
  solver::Solution solution(robot.model);
  solver::State state(robot.model);
  EXPECT_EQ(solver.project_velocity(state), solver::Status::ok);
  EXPECT_EQ(solver.solve(state, std::vector<solver::Row>{}, solution), solver::Status::ok);
  ContactResponse response(robot, 1 * ms);
  Eigen::VectorXd qdd = solution.qdd;
  response.accelerate(solver, solution, state, Eigen::VectorXd::Constant(qdd.size(), solver::infinity), qdd);
  Sensed sensed(led);
  sensed.effort = Eigen::VectorXd::Constant(robot.model.joint_count(), t);
  const double cycle = 1.0 / robot.drive.rate;
  for (double time = 0.0; time < 1.0; time += cycle) {
    sensed.state.qd.setConstant(gain * time);
    EXPECT_TRUE(response.can_feel(sensed));
    response.feel(sensed, time);
  }
  return response.force();
}

/// 0 = sum t/R + w at rest. In free motion the torques accelerate m, and w is 0.
TEST(FeltContact, TorquesThatTheMotionDoesNotNeedArePressedAgainst) {
  const lang::Program program =
      zwang::test::feeling_program("wall_align", "mecanum_effort_50_hz", "wall_far");
  const lang::Program led = led_program(program);
  const double R = program.robot.model.wheels()[0].radius;
  EXPECT_NEAR(felt_by_effort(led, 0.5, 0.0).x(), -4.0 * 0.5 / R, 1e-6);
  const double a = 0.3;
  const double t = driven_mass(program.robot) * a * R / 4.0;
  EXPECT_LT(felt_by_effort(led, t, a / R).norm(), 1e-3);
}

/// A push to the left at the bumper turns the base as its moment about the origin does.
TEST(FeltContact, AForceAtTheSensorHasItsMomentAboutTheBase) {
  const lang::Program led =
      led_program(zwang::test::feeling_program("wall_align", "mecanum_wrench_50_hz", "wall_far"));
  const Eigen::VectorXd at_bumper = accelerated(led, {{0.0, 0.0, 0.0}, {0.0, 10.0, 0.0}}, 1);
  lang::Program at_origin = led;
  at_origin.robot.drive.feels.frame = led.robot.base_frame;
  const Eigen::VectorXd about_origin = accelerated(at_origin, {{0.0, 0.0, 4.0}, {0.0, 10.0, 0.0}}, 1);
  EXPECT_LT((at_bumper - about_origin).norm(), 1e-9 * at_bumper.norm());
}

TEST(FeltContact, FramesJointsAndWheelsOfTheLedRobotKeepTheirNumbers) {
  const lang::Program program = zwang::test::feeling_program("wall_align", "diff_wrench_50_hz", "wall_far");
  const solver::Model& real = program.robot.model;
  const solver::Model led = led_program(program).robot.model;
  ASSERT_EQ(led.frames().size(), real.frames().size());
  ASSERT_EQ(led.bodies().size(), real.bodies().size());
  ASSERT_EQ(led.wheels().size(), real.wheels().size());
  for (std::size_t f = 0; f < real.frames().size(); ++f) {
    EXPECT_EQ(led.frames()[f].name, real.frames()[f].name);
    EXPECT_EQ(led.frames()[f].body, real.frames()[f].body);
  }
  const double factor = program.robot.drive.mass_factor;
  EXPECT_NEAR(led.total_mass(), factor * real.total_mass(), 1e-9 * led.total_mass());
  for (std::size_t w = 0; w < real.wheels().size(); ++w)
    EXPECT_EQ(led.wheels()[w].body, real.wheels()[w].body);
}

struct Aligned {
  RunState state = RunState::running;
  double force = 0.0;  ///< [N] at the end
  double after = 0.0;  ///< [s] from contact to 0.1 deg
};

Aligned align(const std::string& robot, double stiffness) {
  lang::Program program = zwang::test::feeling_program("wall_align", robot, "wall_far");
  program.scene->objects[0].stiffness = stiffness;
  program.scene->start_at = {0.6, 0.0};
  program.robot.drive.feels.noise = 0.0;
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program);
  Aligned result;
  while (!runner.finished() && plant.truth().time < 60.0) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    runner.step(sensed);
    EXPECT_EQ(plant.follow(runner.command()), PlantStatus::ok);
    const Truth& truth = plant.truth();
    if (std::abs(truth.yaw) > 0.1 * std::numbers::pi / 180.0) result.after = truth.time;
    if (runner.state() == RunState::running) result.force = truth.objects[0].force;
  }
  EXPECT_LT(std::abs(plant.truth().yaw), 0.1 * std::numbers::pi / 180.0) << robot;
  result.after -= plant.truth().objects[0].touched.value_or(0.0);
  result.state = runner.state();
  return result;
}

/// J' tau = -w at rest: the force is the row's. Other rates and bases: specs/scenarios/felt_*.
TEST(FeltContact, TheWallSquaresTheBaseUpWithTheForceOfTheRow) {
  const Aligned aligned = align("mecanum_wrench_1_khz", 1e6);
  std::printf("%.3f N, square %.2f s after contact\n", aligned.force, aligned.after);
  EXPECT_EQ(aligned.state, RunState::done);
  EXPECT_NEAR(aligned.force, 20.0, 0.02);
  EXPECT_LT(aligned.after, 5.5);
}

TEST(FeltContact, ReplaysBitByBitAndAllocatesNothing) {
  lang::Program program = zwang::test::feeling_program("wall_align", "mecanum_wrench_100_hz", "wall_far");
  program.scene->start_at = {0.72, 0.0};
  test::expect_replay_without_heap_calls(program, 3000);
}

}  // namespace
}  // namespace zwang::runtime
