// How the robots sink into their wheels' contacts before t = 0.
//
// At rest and without torque the floor carries a base where it has no acceleration:
//   a(x) = 0,  x = (height, roll, pitch),  a = (vertical, about the base's x, about its y).
// Newton's method finds x in a few evaluations of MuJoCo. Its slope A = da/dx is -M^-1 K with the mass M and
// the stiffness K of the floor less that of gravity, so the eigenvalues of -A are real, and positive where
// the base stands firmly. A base that falls has no such x near: it falls, by steps.
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "plant_simulation.hpp"
#include "refuse.hpp"

namespace zwang::runtime {

namespace {

using solver::Matrix3;
using solver::Vector3;

constexpr double settling_time = 0.5;  ///< [s] of a base that falls
/// [m] of wheels in the floor, where the search begins. Bases rest 3 to 10 um deep; one whose wheels end at
/// unequal heights needs them all in the floor, to be firm.
constexpr double first_depths[] = {1e-5, 1e-4, 1e-3, 1e-2};
constexpr double difference = 1e-8;  ///< [m] and [rad] for slopes: a thousandth of the least of these
constexpr double found = 1e-12;      ///< [m] and [rad] of a step that ends the search
constexpr int most_steps = 30;
constexpr double farthest = 0.02;  ///< [m] and [rad] from the drawn pose: farther, it falls

/// The trace, the sum of the principal minors and the determinant of a matrix with real eigenvalues are all
/// positive just if its eigenvalues are.
bool has_positive_eigenvalues(const Matrix3& k) {
  const double minors = 0.5 * (k.trace() * k.trace() - (k * k).trace());
  return k.trace() > 0.0 && minors > 0.0 && k.determinant() > 0.0;
}

}  // namespace

void MujocoPlant::Simulation::lean(const std::vector<Start>& starts,
                                   const std::vector<Lean>& leans) noexcept {
  for (std::size_t r = 0; r < robots.size(); ++r) {
    if (!robots[r].is_on_ground()) continue;
    const Vector3 turn(leans[r][1], leans[r][2], 0.0);
    const Matrix3 tilted = Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix();
    robots[r].stand(*data, starts[r].yaw, leans[r][0], tilted);
  }
}

std::optional<std::vector<Vector3>> MujocoPlant::Simulation::accelerations(const std::vector<Start>& starts,
                                                                           const std::vector<Lean>& leans) {
  lean(starts, leans);
  // The joints bear what hangs on them in this very pose, which is known before the forces are.
  for (const auto stage : {mj_fwdPosition, mj_fwdVelocity}) {
    if (!guarded(stage, model.get(), data.get())) return std::nullopt;
  }
  for (const MovingRobot& robot : robots) robot.hold_joints(*data);
  for (const auto stage : {mj_fwdActuation, mj_fwdAcceleration, mj_fwdConstraint}) {
    if (!guarded(stage, model.get(), data.get())) return std::nullopt;
  }
  std::vector<Lean> result;
  for (const MovingRobot& robot : robots) {
    result.push_back(robot.is_on_ground() ? robot.sinking(*data) : Vector3::Zero());
    if (!result.back().allFinite()) return std::nullopt;
  }
  return result;
}

std::optional<std::vector<Vector3>> MujocoPlant::Simulation::find_rest(const std::vector<Start>& starts,
                                                                       std::vector<Lean> at) {
  // Robots that do not touch each other do not feel each other: their slopes are found together.
  const std::vector<Lean> drawn = at;
  for (int step = 0; step < most_steps; ++step) {
    const auto now = accelerations(starts, at);
    if (!now) return std::nullopt;
    std::vector<Matrix3> slopes(robots.size());
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Lean> beside = at;
      for (Lean& one : beside) one[axis] += difference;
      const auto there = accelerations(starts, beside);
      if (!there) return std::nullopt;
      for (std::size_t r = 0; r < robots.size(); ++r)
        slopes[r].col(axis) = ((*there)[r] - (*now)[r]) / difference;
    }
    double longest = 0.0;
    for (std::size_t r = 0; r < robots.size(); ++r) {
      if (!robots[r].is_on_ground()) continue;
      if (!has_positive_eigenvalues(-slopes[r])) return std::nullopt;
      const Vector3 way = -slopes[r].inverse() * (*now)[r];
      at[r] += way;
      if (!((at[r] - drawn[r]).cwiseAbs().maxCoeff() < farthest)) return std::nullopt;
      longest = std::max(longest, way.cwiseAbs().maxCoeff());
    }
    if (longest < found) return at;
  }
  return std::nullopt;
}

/// By time that passes. Height and tilt are kept, and nothing else.
void MujocoPlant::Simulation::drop(const std::vector<Start>& starts) {
  const std::vector<mjtNum> standing(data->qpos, data->qpos + model->nq);
  const int steps = static_cast<int>(settling_time / model->opt.timestep);
  for (int i = 0; i < steps; ++i) {
    if (!step()) refuse("the simulation diverges while the robot settles on the floor");
    for (const MovingRobot& robot : robots) robot.hold_joints(*data);
  }
  std::vector<std::pair<double, Matrix3>> settled;
  for (MovingRobot& robot : robots) {
    robot.forget_bristles();
    settled.emplace_back(robot.base_position(*model, *data).z(), robot.base_rotation(*model, *data));
  }
  std::copy(standing.begin(), standing.end(), data->qpos);
  for (std::size_t r = 0; r < robots.size(); ++r) {
    if (robots[r].is_on_ground()) robots[r].stand(*data, starts[r].yaw, settled[r].first, settled[r].second);
  }
}

void MujocoPlant::Simulation::settle(const std::vector<Start>& starts) {
  for (const SimulatedObject& object : objects) {
    if (object.position < 0) place_fixed(object);
  }
  const std::vector<mjtNum> placed(data->qpos, data->qpos + model->nq);
  std::optional<std::vector<Lean>> rest;
  for (const double depth : first_depths) {
    std::vector<Lean> drawn;
    for (const MovingRobot& robot : robots)
      drawn.emplace_back(robot.base_position(*model, *data).z() - depth, 0.0, 0.0);
    rest = find_rest(starts, std::move(drawn));
    std::copy(placed.begin(), placed.end(), data->qpos);
    if (rest) break;
  }
  std::fill(data->qfrc_applied, data->qfrc_applied + model->nv, 0.0);
  rest ? lean(starts, *rest) : drop(starts);
  std::fill(data->qfrc_applied, data->qfrc_applied + model->nv, 0.0);
  std::fill(data->qvel, data->qvel + model->nv, 0.0);
  data->time = 0.0;
  if (!guarded(mj_forward, model.get(), data.get())) refuse("MuJoCo fails at the start pose");
}

}  // namespace zwang::runtime
