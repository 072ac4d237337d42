// W877: a free swivel right above its wheel.
//
// A wheel that holds sideways turns its swivel by the lever at which it stands behind the swivel's axis, its
// trail. Without one nothing turns the swivel, and the base is held as by a stiff wheel.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_standing.hpp"
#include "robot/check_joints.hpp"
#include "robot/placed_urdf.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {

namespace {

constexpr double least_trail_of_wheel = 0.01;  ///< of the radius: a shorter trail is a rounding

/// A swivel without a motor, and without a driven wheel that turns it.
bool is_free_swivel(const solver::Model& model, int body) {
  if (body == 0 || model.joint(body - 1).actuated) return false;
  const solver::Vector3 axis = pose_in_base(model, body).rotation * model.joint(body - 1).axis;
  const auto drives = [&](const solver::Wheel& wheel) {
    return model.bodies()[static_cast<std::size_t>(wheel.body)].parent == body &&
           model.joint(wheel.body - 1).actuated;
  };
  return std::abs(axis.z()) > PlacedUrdf::upright &&
         std::none_of(model.wheels().begin(), model.wheels().end(), drives);
}

}  // namespace

void check_trails(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics) {
  const solver::Model& model = robot.model;
  for (const solver::Wheel& wheel : model.wheels()) {
    const int carrier = model.bodies()[static_cast<std::size_t>(wheel.body)].parent;
    if (wheel.roller_angle || !wheel.holds_sideways || !is_free_swivel(model, carrier)) continue;
    const solver::Pose pose = pose_in_base(model, wheel.body);
    const solver::Vector3 axle = pose.rotation * model.joint(wheel.body - 1).axis;
    const solver::Vector3 behind = pose.position - pose_in_base(model, carrier).position;
    if (std::abs(behind.cross(axle).z()) > least_trail_of_wheel * wheel.radius) continue;
    const std::string& name = model.joint(wheel.body - 1).name;
    const auto text = std::find_if(file.wheels.begin(), file.wheels.end(),
                                   [&](const WheelText& other) { return other.joint.text == name; });
    diagnostics.add(wording::wheel_without_trail(
        text == file.wheels.end() ? file.base.span : text->joint.span, name, model.joint(carrier - 1).name));
  }
}

}  // namespace zwang::lang
