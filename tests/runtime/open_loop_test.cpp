// Model against plant: the accelerations that the solver promises are those that the plant makes, with no
// feedback at all.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "zwang/lang/robot.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {
namespace {

constexpr double period = 1e-3;
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

}  // namespace
}  // namespace zwang::runtime
