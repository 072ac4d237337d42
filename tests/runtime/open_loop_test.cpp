// Model against plant: the accelerations that the solver promises are those that the plant makes, with no
// feedback at all.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "constants.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {
namespace {

constexpr double frequency = 1.0;  // [Hz]

/// Error and demand over two periods of a sine along the axes of `amplitude`, as root mean squares of their
/// sum of squares.
double relative_error(const Eigen::Vector3d& amplitude) {
  lang::Diagnostics diagnostics;
  const auto robot = lang::load_robot(ZWANG_SOURCE_DIR "/specs/robots/mecanum_base.yaml", diagnostics);
  if (!robot) throw std::runtime_error("the robot does not load");
  MujocoPlant plant(*robot, lang::Scene{}, {.period = period});
  Sensed sensed(robot->model);
  solver::Solver solver(robot->model);
  solver::Solution solution(robot->model);
  solver::ConstraintSet set;
  constexpr std::array axes{solver::Axis::x, solver::Axis::y, solver::Axis::rz};
  double error = 0.0;
  double demand = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double phase = std::sin(2.0 * std::numbers::pi * frequency * i * period);
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    EXPECT_EQ(solver.project_velocity(sensed.state), solver::Status::ok);
    set.clear();
    for (std::size_t k = 0; k < axes.size(); ++k) {
      solver::AxisConstraint constraint;
      constraint.move.body = constraint.in.body = 0;
      constraint.axis = axes[k];
      constraint.driver = solver::Driver{.quantity = solver::Quantity::acceleration,
                                         .target = amplitude(static_cast<Eigen::Index>(k)) * phase};
      EXPECT_TRUE(set.add(constraint));
    }
    EXPECT_TRUE(set.fill(robot->model, sensed.state));
    EXPECT_EQ(solver.solve(sensed.state, set.rows(), solution), solver::Status::ok);
    EXPECT_EQ(plant.apply(solution.tau), PlantStatus::ok);
    if (i < 50) continue;  // the contacts under the wheels settle to their first load
    error += (plant.truth().acceleration - amplitude * phase).squaredNorm();
    demand += (amplitude * phase).squaredNorm();
  }
  return std::sqrt(error / demand);
}

TEST(OpenLoop, TheMecanumPlantAcceleratesAsDemanded) {
  const struct {
    const char* name;
    Eigen::Vector3d amplitude;
  } demands[] = {{"x 0.5 m/s^2", {0.5, 0.0, 0.0}},
                 {"y 0.5 m/s^2", {0.0, 0.5, 0.0}},
                 {"yaw 1 rad/s^2", {0.0, 0.0, 1.0}},
                 {"all three at once", {0.5, 0.5, 1.0}}};
  for (const auto& demand : demands) {
    const double error = relative_error(demand.amplitude);
    std::printf("open loop, %s: rms error %.4f %% of the demand\n", demand.name, 100.0 * error);
    EXPECT_LE(error, 0.002) << demand.name;
  }
}

/// The error of the plant's acceleration against the demand, a sine along one axis. Both are means over 20
/// ms, because the contacts of real rollers jump from one to the next. The velocity feedback is 20 1/s.
double error_on_rollers(int along, double amplitude) {
  lang::Diagnostics diagnostics;
  const auto robot = lang::load_robot(ZWANG_SOURCE_DIR "/specs/robots/mecanum_base.yaml", diagnostics);
  if (!robot) throw std::runtime_error("the robot does not load");
  MujocoPlant plant(*robot, lang::Scene{}, {.period = period, .real_rollers = true});
  Sensed sensed(robot->model);
  solver::Solver solver(robot->model);
  solver::Solution solution(robot->model);
  solver::ConstraintSet set;
  constexpr std::array axes{solver::Axis::x, solver::Axis::y, solver::Axis::rz};
  constexpr double feedback = 20.0;  // [1/s]
  constexpr int window = 20;
  const double turn = 2.0 * std::numbers::pi * frequency;
  double error = 0.0, demand = 0.0, made_in_window = 0.0, asked_in_window = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double asked = amplitude * std::sin(turn * i * period);
    const double speed = amplitude * (1.0 - std::cos(turn * i * period)) / turn;
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    EXPECT_EQ(solver.project_velocity(sensed.state), solver::Status::ok);
    set.clear();
    const solver::MotionVector& twist = sensed.state.base_twist;
    const std::array<double, 3> now{twist.linear.x(), twist.linear.y(), twist.angular.z()};
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      solver::AxisConstraint constraint;
      constraint.move.body = constraint.in.body = 0;
      constraint.axis = axes[axis];
      const double wanted = k == along ? asked + feedback * (speed - now[axis]) : -feedback * now[axis];
      constraint.driver = solver::Driver{.quantity = solver::Quantity::acceleration, .target = wanted};
      EXPECT_TRUE(set.add(constraint));
    }
    EXPECT_TRUE(set.fill(robot->model, sensed.state));
    EXPECT_EQ(solver.solve(sensed.state, set.rows(), solution), solver::Status::ok);
    EXPECT_EQ(plant.apply(solution.tau), PlantStatus::ok);
    made_in_window += plant.truth().acceleration(along) / window;
    asked_in_window += asked / window;
    if ((i + 1) % window != 0) continue;
    if (i >= 50) {
      error += (made_in_window - asked_in_window) * (made_in_window - asked_in_window);
      demand += asked_in_window * asked_in_window;
    }
    made_in_window = asked_in_window = 0.0;
  }
  return std::sqrt(error / demand);
}

TEST(RealRollers, AccelerateWithVelocityFeedbackWithinATenthAndYawWithinThreeTenths) {
  const struct {
    const char* name;
    int along;
    double amplitude, most;
  } demands[] = {{"x 0.5 m/s^2", 0, 0.5, 0.1}, {"y 0.5 m/s^2", 1, 0.5, 0.1}, {"yaw 1 rad/s^2", 2, 1.0, 0.3}};
  for (const auto& demand : demands) {
    const double error = error_on_rollers(demand.along, demand.amplitude);
    std::printf("real rollers, %s: rms error of 20 ms means %.2f %%\n", demand.name, 100.0 * error);
    EXPECT_LE(error, demand.most) << demand.name;
  }
}

}  // namespace
}  // namespace zwang::runtime
