// W868: rollers that are mirrored. W869: a wheel whose axis lies across its own cylinder. W870: one with more
// inertia than its mass has on the rim, m R^2.
//
//   sum |p_i x u_i|      p_i: a wheel's place from the middle of all, u_i: along its roller on the ground
//
// is the lever with which the wheels turn the base. Mirrored rollers, u_i turned the other way from the
// wheel's axis, would have another one: a base is mounted so that its own is the longer.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_standing.hpp"
#include "robot/check_joints.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {

namespace {

/// Levers nearer to each other than this are alike: omni wheels mirror into themselves.
constexpr double alike = 0.99;
/// Of the angle between a wheel's axis and its cylinder's, its cosine: 45 deg.
constexpr double across = 0.7;

double lever(const solver::Model& model, double sign) {
  solver::Vector3 middle = solver::Vector3::Zero();
  const auto count = static_cast<double>(model.wheels().size());
  for (const solver::Wheel& wheel : model.wheels())
    middle += pose_in_base(model, wheel.body).position / count;
  double sum = 0.0;
  for (const solver::Wheel& wheel : model.wheels()) {
    if (!wheel.roller_angle) continue;
    const solver::Pose pose = pose_in_base(model, wheel.body);
    const solver::Vector3 axle = pose.rotation * model.joint(wheel.body - 1).axis;
    const solver::Vector3 roller =
        Eigen::AngleAxisd(sign * *wheel.roller_angle, solver::Vector3::UnitZ()) * axle;
    sum += std::abs((pose.position - middle).cross(roller).z()) / count;
  }
  return sum;
}

}  // namespace

void check_rollers(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics) {
  const double own = lever(robot.model, 1.0), mirrored = lever(robot.model, -1.0);
  if (own >= alike * mirrored) return;
  const auto with_roller = std::find_if(file.wheels.begin(), file.wheels.end(),
                                        [](const WheelText& w) { return w.roller.has_value(); });
  if (with_roller == file.wheels.end()) return;
  diagnostics.add(wording::mirrored_rollers(with_roller->joint.span, own, mirrored));
}

void check_wheel_shapes(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics) {
  for (const WheelText& wheel : file.wheels) {
    const UrdfJoint* joint = urdf.find_joint(wheel.joint.text);
    const UrdfLink* link = joint != nullptr ? urdf.find_link(joint->child) : nullptr;
    if (link == nullptr || !link->cylinder_axis) continue;
    if (std::abs(joint->joint.axis.dot(*link->cylinder_axis)) >= across) continue;
    diagnostics.add(wording::wheel_across(wheel.joint.span, wheel.joint.text, joint->span));
  }
}

void check_wheel_inertias(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics) {
  std::vector<wording::HeavyWheel> heavy;
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const solver::Body& body = robot.model.bodies()[static_cast<std::size_t>(wheel.body)];
    const double about_axle = body.joint.axis.dot(body.inertia.rotational * body.joint.axis);
    const double on_the_rim = body.inertia.mass * wheel.radius * wheel.radius;
    if (about_axle <= on_the_rim) continue;
    const auto text = std::find_if(file.wheels.begin(), file.wheels.end(),
                                   [&](const WheelText& w) { return w.joint.text == body.joint.name; });
    heavy.push_back({text->joint.span, body.joint.name, about_axle, on_the_rim});
  }
  if (!heavy.empty()) diagnostics.add(wording::wheel_inertia_beyond_rim(heavy));
}

}  // namespace zwang::lang
