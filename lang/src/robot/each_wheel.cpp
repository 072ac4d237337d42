#include "robot/each_wheel.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "diagnostic/wordings.hpp"
#include "spec/shape.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

namespace {

const ActuatorText* motor_of(const RobotFile& file, const WheelText& wheel) {
  const auto motor = std::find_if(file.actuators.begin(), file.actuators.end(),
                                  [&](const ActuatorText& a) { return a.joint.text == wheel.joint.text; });
  return motor == file.actuators.end() ? nullptr : &*motor;
}

bool is_wheel(const RobotFile& file, const ActuatorText& motor) {
  return std::any_of(file.wheels.begin(), file.wheels.end(),
                     [&](const WheelText& wheel) { return wheel.joint.text == motor.joint.text; });
}

/// Of a link in the URDF's root at q = 0.
solver::Pose pose_in_root(const Urdf& urdf, const std::string& link) {
  solver::Pose pose;
  const UrdfJoint* above = urdf.joint_above(link);
  for (std::size_t i = 0; above != nullptr && i < most_links; ++i) {
    pose = above->origin * pose;
    above = urdf.joint_above(above->parent);
  }
  return pose;
}

}  // namespace

EachWheel parse_each_wheel(const Node& node, Diagnostics& diagnostics) {
  EachWheel each;
  MapReader map(node, "`each_wheel`", diagnostics, "{effort: 2 N m}");
  if (const Node* kind = map.optional("kind")) {
    const Word word = parse_word(*kind, "each_wheel.kind", diagnostics);
    if (word.text == "skid") {
      each.kind = WheelKind::skid;
    } else if (word.text == "mecanum") {
      each.kind = WheelKind::mecanum;
    } else if (word.exists() && word.text != "plain") {
      diagnostics.add(
          wording::unknown_name(word.span, "kind of wheel", word.text, {"plain", "skid", "mecanum"}));
    }
  }
  const auto positive = [&](const char* key, const Dimension& dimension, bool zero_allowed) {
    const Node* value = map.optional(key);
    if (value == nullptr) return std::optional<double>{};
    return parse_positive(*value, dimension, std::string("each_wheel.") + key, zero_allowed, diagnostics);
  };
  each.gives_radius = map.node().find("radius") != nullptr;
  each.radius = positive("radius", dimension::length, false);
  if (const Node* effort = map.optional("effort"))
    each.effort = parse_value(*effort, "each_wheel.effort", diagnostics);
  each.gear = positive("gear", dimension::none, false);
  each.rotor_inertia = positive("rotor_inertia", dimension::inertia, true);
  each.mass = positive("mass", dimension::mass, false);
  map.finish();
  return each;
}

EachJoint parse_each_joint(const Node& node, Diagnostics& diagnostics) {
  EachJoint each;
  MapReader map(node, "`each_joint`", diagnostics, "{effort: 2 N m}");
  if (const Node* effort = map.optional("effort")) {
    each.effort = parse_value(*effort, "each_joint.effort", diagnostics);
    const bool is_force = each.effort->quantity.dimension == dimension::force;
    require_positive(*each.effort, is_force ? dimension::force : dimension::torque, "each_joint.effort",
                     false, diagnostics);
  }
  if (const Node* gear = map.optional("gear"))
    each.gear = parse_positive(*gear, dimension::none, "each_joint.gear", false, diagnostics);
  if (const Node* inertia = map.optional("rotor_inertia"))
    each.rotor_inertia =
        parse_positive(*inertia, dimension::inertia, "each_joint.rotor_inertia", true, diagnostics);
  map.finish();
  return each;
}

void complete_wheels(RobotFile& file, Diagnostics& diagnostics) {
  const EachWheel& each = file.each_wheel;
  for (WheelText& wheel : file.wheels) {
    const bool is_driven = motor_of(file, wheel) != nullptr;
    if (!wheel.gives_radius && is_driven) wheel.radius = each.radius;
    if (!wheel.gives_radius && !is_driven && each.gives_radius && wheel.joint.exists())
      diagnostics.add(wording::missing_key(wheel.span, "wheel `" + wheel.joint.text + "`", "radius"));
    const bool says_nothing = !wheel.roller && !wheel.gives_holds;
    if (each.kind == WheelKind::skid && is_driven && says_nothing) wheel.holds_sideways = false;
  }
  for (ActuatorText& motor : file.actuators) {
    if (!is_wheel(file, motor)) {
      if (!motor.gear) motor.gear = file.each_joint.gear;
      if (!motor.rotor_inertia) motor.rotor_inertia = file.each_joint.rotor_inertia;
      continue;
    }
    if (!motor.effort_text) motor.effort_text = each.effort;
    if (!motor.gear) motor.gear = each.gear;
    if (!motor.rotor_inertia) motor.rotor_inertia = each.rotor_inertia;
  }
}

const ValueText* effort_of_each_joint(const RobotFile& file, const UrdfJoint& joint,
                                      const Dimension& expected) {
  const std::optional<ValueText>& effort = file.each_joint.effort;
  const bool is_wheel = std::any_of(file.wheels.begin(), file.wheels.end(), [&](const WheelText& wheel) {
    return wheel.joint.text == joint.joint.name;
  });
  if (!effort || is_wheel || std::isfinite(joint.joint.max_effort)) return nullptr;
  // What is neither was told.
  const Dimension& other = expected == dimension::force ? dimension::torque : dimension::force;
  return effort->quantity.dimension == other ? nullptr : &*effort;
}

// From above, the rollers of a usual mecanum base form an X. At the ground, front left and rear right are
// turned by 45 deg from the wheel's axis, the others by -45 deg. Front is where the wheels roll to, forward
// or back: both ways the same wheels lie on one diagonal.
void place_rollers(RobotFile& file, const Urdf& urdf) {
  if (file.each_wheel.kind != WheelKind::mecanum) return;
  const solver::Pose to_base = pose_in_root(urdf, file.base.text).inverse();
  std::map<std::size_t, Eigen::Vector2d> places;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero(), left = Eigen::Vector2d::UnitY();
  for (std::size_t i = 0; i < file.wheels.size(); ++i) {
    const WheelText& wheel = file.wheels[i];
    const UrdfJoint* joint = urdf.find_joint(wheel.joint.text);
    if (joint == nullptr || wheel.roller || wheel.gives_holds || motor_of(file, wheel) == nullptr) continue;
    const solver::Pose pose = to_base * pose_in_root(urdf, joint->child);
    const Eigen::Vector2d axle = (pose.rotation * joint->joint.axis).head<2>();
    if (places.empty() && axle.norm() > 0.5) left = axle.normalized();
    places[i] = pose.position.head<2>();
    middle += places[i];
  }
  if (!places.empty()) middle /= static_cast<double>(places.size());
  const Eigen::Vector2d ahead(left.y(), -left.x());
  for (const auto& [i, at] : places) {
    const bool is_diagonal = ((at - middle).dot(ahead) > 0.0) == ((at - middle).dot(left) > 0.0);
    file.wheels[i].roller = (is_diagonal ? 1.0 : -1.0) * std::numbers::pi / 4.0;
  }
}

}  // namespace zwang::lang
