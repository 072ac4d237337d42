#include "simulated_object.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

using solver::Matrix3;
using solver::Vector3;

namespace {

Matrix3 turned_by(double yaw) {
  return solver::rotation_from_rpy(0.0, 0.0, yaw);
}

}  // namespace

Vector3 scripted_centre(const SimulatedObject& object, const ScriptedPose& now) noexcept {
  return Vector3(now.at[0], now.at[1], object.geometry.centre.z()) +
         turned_by(now.yaw) * object.geometry.shift;
}

void let_go(SimulatedObject& object, double time) noexcept {
  std::vector<lang::Waypoint>& motion = object.described.motion;
  const bool is_on_the_floor = object.friction || object.casters;
  if (is_on_the_floor && !motion.empty() && time >= motion.back().time) motion.clear();
}

void follow_script(const SimulatedObject& object, double time, double* qpos, double* qvel) noexcept {
  if (object.described.motion.empty()) return;
  const ScriptedPose now = scripted_pose(object.described.motion, time);
  const Matrix3 written = turned_by(object.described.yaw);
  const Vector3 arm = turned_by(now.yaw) * object.geometry.shift;
  const Vector3 centre = scripted_centre(object, now);
  const Vector3 velocity =
      Vector3(now.velocity[0], now.velocity[1], 0.0) + now.turn * Vector3::UnitZ().cross(arm);
  const Vector3 moved = written.transpose() * (centre - object.geometry.centre);
  const Vector3 rate = written.transpose() * velocity;
  const double position[] = {moved.x(), moved.y(), now.yaw - object.described.yaw};
  const double rates[] = {rate.x(), rate.y(), now.turn};
  std::copy(std::begin(position), std::end(position), qpos + object.position);
  std::copy(std::begin(rates), std::end(rates), qvel + object.velocity);
}

void add_resistance(SimulatedObject& object, double period, const double* qpos, const double* qvel,
                    double* force) noexcept {
  if (object.guide) {
    force[object.velocity] = object.guide->step(qpos[object.position], qvel[object.velocity], period);
    return;
  }
  if (!object.friction && !object.casters) return;
  const double* v = qvel + object.velocity;
  Vector3 resistance;
  if (object.casters) {
    // The joints x and y keep their axes while the object turns.
    const Matrix3 turned = turned_by(qpos[object.position + 2]);
    resistance = turned * object.casters->step(turned.transpose() * Vector3(v[0], v[1], v[2]), period);
  } else {
    resistance = object.friction->step({v[0], v[1], v[2]}, period);
  }
  std::copy(resistance.data(), resistance.data() + 3, force + object.velocity);
}

void place_truth(const SimulatedObject& object, const Vector3& centre, const Matrix3& rotation,
                 ObjectTruth& truth) noexcept {
  const Vector3 at = centre - rotation * object.geometry.shift;  // its z means nothing
  truth.x = at.x();
  truth.y = at.y();
  truth.yaw = std::atan2(rotation(1, 0), rotation(0, 0));
}

bool is_in_reach(const lang::Dock& dock, const ObjectTruth& truth, const Vector3& hook) noexcept {
  const Vector3 socket =
      Vector3(truth.x, truth.y, 0.0) + turned_by(truth.yaw) * Vector3(dock.at[0], dock.at[1], 0.0);
  return (hook - socket).head<2>().norm() <= dock.reach;
}

}  // namespace zwang::runtime
