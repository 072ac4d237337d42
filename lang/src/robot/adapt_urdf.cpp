#include "robot/adapt_urdf.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "diagnostic/wordings.hpp"
#include "robot/dropped_wheels.hpp"
#include "robot/inertias.hpp"

namespace zwang::lang {

namespace {

/// X_PC of a joint at the position nearest to 0 that it can take.
solver::Pose at_rest(const UrdfJoint& joint) {
  const double q = std::clamp(0.0, joint.joint.lower, joint.joint.upper);
  solver::Pose moved;
  if (joint.joint.type == solver::JointType::prismatic) {
    moved.position = q * joint.joint.axis;
  } else {
    moved.rotation = Eigen::AngleAxisd(q, joint.joint.axis).toRotationMatrix();
  }
  return joint.origin * moved;
}

void hold_joints(const std::vector<Word>& fixed, Urdf& urdf, Diagnostics& diagnostics) {
  for (const Word& name : fixed) {
    if (!name.exists()) continue;
    const auto joint = std::find_if(urdf.joints.begin(), urdf.joints.end(),
                                    [&](const UrdfJoint& j) { return j.joint.name == name.text; });
    if (joint == urdf.joints.end()) {
      const std::vector<std::string>& above = urdf.above_base.joints;  // they are not there, and do not move
      if (std::find(above.begin(), above.end(), name.text) != above.end()) continue;
      diagnostics.add(wording::unknown_name(name.span, "joint", name.text, urdf.joint_names()));
      continue;
    }
    if (joint->joint.type == solver::JointType::fixed) continue;
    hold(*joint);
    joint->span = name.span;  // where a wheel or a motor on it finds out
  }
}

/// Every joint and link that the file names elsewhere.
std::vector<Word> used_parts(const RobotFile& file) {
  std::vector<Word> parts{file.base};
  parts.insert(parts.end(), file.turning.begin(), file.turning.end());
  for (const WheelText& wheel : file.wheels) parts.push_back(wheel.joint);
  for (const ActuatorText& actuator : file.actuators) parts.push_back(actuator.joint);
  for (const PostureText& posture : file.posture) parts.push_back(posture.joint);
  for (const FrictionText& friction : file.friction) parts.push_back(friction.joint);
  for (const FrameText& frame : file.frames) parts.push_back(frame.parent);
  for (const InertiaText& inertia : file.inertias) parts.push_back(inertia.link);
  parts.insert(parts.end(), file.supports.begin(), file.supports.end());
  return parts;
}

void check_left_out(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics) {
  std::map<std::string, Span> ignored;
  for (const Word& link : file.ignored) {
    if (link.exists()) ignored.emplace(link.text, link.span);
    if (link.exists() && !urdf.left_out.contains(link.text))
      diagnostics.add(wording::unknown_name(link.span, "link", link.text, urdf.link_names()));
  }
  for (const Word& part : used_parts(file)) {
    const auto gone = urdf.left_out.find(part.text);
    if (gone == urdf.left_out.end()) continue;
    diagnostics.add(wording::ignored_part(part.span, part.text, gone->second, ignored.at(gone->second)));
  }
}

}  // namespace

void hold(UrdfJoint& joint) {
  joint.origin = at_rest(joint);
  const std::string name = joint.joint.name;
  joint.joint = solver::Joint{};
  joint.joint.name = name;
  joint.mimic.reset();
}

void adapt_urdf(const RobotFile& file, Urdf& urdf, Diagnostics& diagnostics) {
  apply_inertias(file, urdf, diagnostics);
  hold_joints(file.fixed, urdf, diagnostics);
  check_left_out(file, urdf, diagnostics);
  drop_wheels(file, urdf);
}

}  // namespace zwang::lang
