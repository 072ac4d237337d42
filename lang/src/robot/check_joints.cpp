#include "robot/check_joints.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_standing.hpp"
#include "robot/placed_urdf.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {

namespace {

/// Of a wheel's axis: the sine of its slope from which it counts as pointing up, 80 deg.
constexpr double steepest_axis = 0.985;

/// The link, and the joints above it that move, up to the base.
void add_movers_above(const Urdf& urdf, const std::string& joint, std::set<std::string>& names) {
  const UrdfJoint* above = urdf.find_joint(joint);
  for (std::size_t i = 0; above != nullptr && i < most_links; ++i) {
    names.insert(above->joint.name);
    above = urdf.joint_above(above->parent);
  }
}

wording::Coupling coupling_of(const UrdfJoint& joint, const Urdf& urdf) {
  const std::string& leader = joint.mimic->joint;
  return {joint.joint.name, leader, urdf.find_joint(leader) != nullptr, joint.mimic->span};
}

/// The rate of a wheel that stands on the base, as a row of (v_x, v_y, w_z). Let a be its axle and d = a x z.
/// If the wheel rolls without slip, r w = d (v + w_z x p).
std::optional<Eigen::RowVector3d> rate_of_wheel(const Robot& robot, const std::string& joint) {
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const solver::Body& body = robot.model.bodies()[static_cast<std::size_t>(wheel.body)];
    if (robot.model.joint(wheel.body - 1).name != joint) continue;
    if (body.parent != 0 || wheel.roller_angle || !wheel.holds_rolling) return std::nullopt;
    const solver::Pose pose = pose_in_base(robot.model, wheel.body);
    const solver::Vector3 ahead =
        (pose.rotation * robot.model.joint(wheel.body - 1).axis).cross(solver::Vector3::UnitZ());
    const solver::Vector3& p = pose.position;
    return Eigen::RowVector3d(ahead.x(), ahead.y(), ahead.y() * p.x() - ahead.x() * p.y()) / wheel.radius;
  }
  return std::nullopt;
}

void check_mimic_names(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics) {
  std::vector<std::string> following;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.mimic) following.push_back(joint.joint.name);
  }
  for (const MimicText& mimic : file.mimics) {
    if (std::find(following.begin(), following.end(), mimic.joint.text) == following.end())
      diagnostics.add(wording::no_mimic(mimic.joint.span, mimic.joint.text, following));
  }
}

}  // namespace

void check_couplings(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics) {
  std::set<std::string> carry_wheels;
  for (const WheelText& wheel : file.wheels) add_movers_above(urdf, wheel.joint.text, carry_wheels);
  const auto named_at = [&](const std::string& joint) -> std::optional<Span> {
    for (const WheelText& wheel : file.wheels) {
      if (wheel.joint.text == joint) return wheel.joint.span;
    }
    for (const ActuatorText& actuator : file.actuators) {
      if (actuator.joint.text == joint) return actuator.joint.span;
    }
    if (carry_wheels.contains(joint)) return file.urdf.span;
    return std::nullopt;
  };
  const auto said_of = [&](const std::string& joint) -> const MimicText* {
    const auto said = std::find_if(file.mimics.begin(), file.mimics.end(),
                                   [&](const MimicText& mimic) { return mimic.joint.text == joint; });
    return said == file.mimics.end() ? nullptr : &*said;
  };
  const auto has_motor = [&](const std::string& joint) {
    return std::any_of(file.actuators.begin(), file.actuators.end(),
                       [&](const ActuatorText& actuator) { return actuator.joint.text == joint; });
  };
  check_mimic_names(file, urdf, diagnostics);
  std::vector<wording::Coupling> loose;
  for (const UrdfJoint& joint : urdf.joints) {
    if (!joint.mimic || joint.joint.type == solver::JointType::fixed) continue;
    const wording::Coupling coupling = coupling_of(joint, urdf);
    if (const MimicText* said = said_of(joint.joint.name)) {
      if (said->is_coupled && has_motor(joint.joint.name))
        diagnostics.add(wording::coupled_motor(said->joint.span, coupling));
      continue;
    }
    if (const std::optional<Span> span = named_at(joint.joint.name)) {
      diagnostics.add(wording::coupled_joint(*span, coupling));
    } else {
      loose.push_back(coupling);
    }
  }
  if (!loose.empty()) diagnostics.add(wording::loose_couplings(file.urdf.span, loose));
}

void check_steps(const RobotFile& file, const Urdf& urdf, const Robot& robot, Diagnostics& diagnostics) {
  constexpr double rounding = 1e-3;  // of a wheel's rate
  for (const MimicText& mimic : file.mimics) {
    const UrdfJoint* joint = urdf.find_joint(mimic.joint.text);
    if (!mimic.is_coupled || joint == nullptr || !joint->mimic) continue;
    const auto rate = rate_of_wheel(robot, joint->joint.name),
               leads = rate_of_wheel(robot, joint->mimic->joint);
    if (rate && leads && (*rate - joint->mimic->multiplier * *leads).norm() <= rounding * rate->norm())
      continue;
    diagnostics.add(wording::out_of_step(mimic.joint.span, coupling_of(*joint, urdf)));
  }
}

void check_starts(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics) {
  std::set<std::string> named;
  for (const PostureText& posture : file.posture) named.insert(posture.joint.text);
  for (const UrdfJoint& joint : urdf.joints) {
    const solver::Joint& j = joint.joint;
    if (j.type == solver::JointType::fixed || named.contains(j.name)) continue;
    if (j.lower <= 0.0 && j.upper >= 0.0) continue;
    Span span = file.urdf.span;
    for (const ActuatorText& actuator : file.actuators) {
      if (actuator.joint.text == j.name) span = actuator.joint.span;
    }
    diagnostics.add(wording::start_outside(span, j.name, j.type == solver::JointType::prismatic, j.lower,
                                           j.upper, joint.span));
  }
}

void check_wheels_stand(const RobotFile& file, const Urdf& urdf, const Robot& robot,
                        Diagnostics& diagnostics) {
  const auto text_of = [&](const solver::Wheel& wheel) {
    const std::string& joint = robot.model.joint(wheel.body - 1).name;
    return std::find_if(file.wheels.begin(), file.wheels.end(),
                        [&](const WheelText& w) { return w.joint.text == joint; });
  };
  const std::vector<solver::Wheel>& wheels = robot.model.wheels();
  for (const solver::Wheel& wheel : wheels) {
    const solver::Joint& joint = robot.model.joint(wheel.body - 1);
    const solver::Pose pose = pose_in_base(robot.model, wheel.body);
    if (std::abs((pose.rotation * joint.axis).z()) > steepest_axis) {
      diagnostics.add(
          wording::upright_wheel(text_of(wheel)->joint.span, joint.name, urdf.find_joint(joint.name)->span));
    }
  }
  for (const solver::Wheel& wheel : wheels) {
    const int carrier = robot.model.bodies()[static_cast<std::size_t>(wheel.body)].parent;
    if (carrier == 0 || wheel.roller_angle || wheel.holds_sideways) continue;
    const Word& named = text_of(wheel)->joint;
    const std::string& steering = robot.model.joint(carrier - 1).name;
    diagnostics.add(wording::steered_skid(named.span, named.text, steering, urdf.find_joint(steering)->span));
  }
  std::set<int> told;  // bodies: a rocker carries two wheels
  for (const solver::Wheel& wheel : wheels) {
    const auto& bodies = robot.model.bodies();
    for (int b = bodies[static_cast<std::size_t>(wheel.body)].parent; b > 0;
         b = bodies[static_cast<std::size_t>(b)].parent) {
      const solver::Joint& carrier = robot.model.joint(b - 1);
      const double slope = (pose_in_base(robot.model, b).rotation * carrier.axis).z();
      const bool steers =
          carrier.type != solver::JointType::prismatic && std::abs(slope) >= PlacedUrdf::upright;
      if (steers || !told.insert(b).second) continue;
      const Word& named = text_of(wheel)->joint;
      diagnostics.add(
          wording::loose_wheel(named.span, named.text, carrier.name, urdf.find_joint(carrier.name)->span));
    }
  }
  if (wheels.empty()) return;
  const WheelLevel level = wheel_level(robot.model);
  if (level.is_level()) return;
  const Word& highest = text_of(wheels[level.highest])->joint;
  const Word& lowest = text_of(wheels[level.lowest])->joint;
  constexpr double rounding = 1e-4;  // [m]
  std::vector<std::pair<std::string, double>> drops;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const double above = level.ends[i] - level.ends[level.lowest];
    if (above > rounding) drops.emplace_back(text_of(wheels[i])->joint.text, above);
  }
  diagnostics.add(
      wording::uneven_wheels(highest.span, highest.text, lowest.text, level.spread(), lowest.span, drops));
}

}  // namespace zwang::lang
