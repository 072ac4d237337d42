#include "robot/assemble_robot.hpp"

#include <algorithm>
#include <set>

#include "diagnostic/wheel_places.hpp"
#include "robot/supports.hpp"
#include "spec/parse_task.hpp"
#include "zwang/lang/plane.hpp"

namespace zwang::lang {

namespace {

class RobotAssembly {
 public:
  RobotAssembly(const RobotFile& file, const Urdf& urdf) : file_(file), urdf_(urdf) {}

  solver::Model model() const {
    solver::ModelBuilder builder = add_links();
    for (const FrameText& frame : file_.frames) {
      builder.add_frame(frame.name.text, frame.parent.text, pose_of(frame));
    }
    for (const auto& [name, same_as] : implied_frames()) builder.add_frame(name, same_as, {});
    for (const SupportFrame& support : support_frames(file_, urdf_)) {
      if (support.is_new())
        builder.add_frame(support.name, support.link, {solver::Matrix3::Identity(), support.at});
    }
    for (const WheelText& wheel : file_.wheels) {
      builder.add_wheel(wheel.joint.text, {.body = 0,
                                           .radius = *wheel.radius,
                                           .holds_rolling = wheel.holds_rolling,
                                           .holds_sideways = wheel.holds_sideways,
                                           .roller_angle = wheel.roller});
    }
    return builder.build();
  }

  Robot robot() const {
    Robot robot;
    robot.name = urdf_.name;
    robot.model = model();
    robot.base_frame = file_.base.text;
    for (const auto& [name, same_as] : implied_frames()) robot.implied_frames.push_back(name);
    robot.limits = file_.limits;
    robot.stop = file_.stop;
    robot.footprint = file_.footprint;
    if (plane::signed_area(robot.footprint) < 0.0)
      std::reverse(robot.footprint.begin(), robot.footprint.end());
    for (const SupportFrame& support : support_frames(file_, urdf_)) robot.supports.push_back(support.name);
    robot.bumper_height_said = file_.bumper_height.has_value();
    if (file_.bumper_height) robot.bumper_height = *file_.bumper_height;
    if (file_.bumper_stiffness) robot.bumper_stiffness = *file_.bumper_stiffness;
    if (file_.control_period) robot.control_period = *file_.control_period;
    if (file_.encoder_step) robot.encoder_step = *file_.encoder_step;
    robot.drive = file_.drive;
    for (const PadText& pad : file_.pads) robot.pads.push_back({pad.frame.text, pad.width, pad.height});
    add_joint_facts(robot);
    return robot;
  }

 private:
  /// Links outward from the base, whatever the URDF's root is.
  solver::ModelBuilder add_links() const {
    const UrdfLink& base = *urdf_.find_link(file_.base.text);
    solver::ModelBuilder builder(solver::BaseType::ground, base.name, base.inertia);
    builder.set_steering_error(steering_error);
    std::set<std::string> added{base.name};
    const solver::Joint fixed;
    for (const UrdfJoint* above = urdf_.joint_above(base.name); above != nullptr;
         above = urdf_.joint_above(above->parent)) {
      const UrdfLink& parent = *urdf_.find_link(above->parent);
      builder.add_link(parent.name, above->child, above->origin.inverse(), fixed, parent.inertia);
      added.insert(parent.name);
    }
    for (bool is_growing = true; is_growing;) {
      is_growing = false;
      for (const UrdfJoint& joint : urdf_.joints) {
        if (!added.contains(joint.parent) || added.contains(joint.child)) continue;
        builder.add_link(joint.child, joint.parent, joint.origin, joint.joint,
                         urdf_.find_link(joint.child)->inertia);
        added.insert(joint.child);
        is_growing = true;
      }
    }
    return builder;
  }

  bool has_link_or_frame(const std::string& name) const {
    return urdf_.find_link(name) != nullptr ||
           std::any_of(file_.frames.begin(), file_.frames.end(),
                       [&](const FrameText& frame) { return frame.name.text == name; });
  }

  /// Names under which a task finds the base, and the point to drive, of any robot.
  std::vector<std::pair<std::string, std::string>> implied_frames() const {
    const std::string lead = file_.lead.exists() ? file_.lead.text : file_.base.text;
    std::vector<std::pair<std::string, std::string>> frames = {{"base", file_.base.text}, {"lead", lead}};
    std::erase_if(frames, [&](const auto& frame) { return has_link_or_frame(frame.first); });
    return frames;
  }

  void add_joint_facts(Robot& robot) const {
    robot.posture = Eigen::VectorXd::Zero(robot.model.joint_count());
    for (const PostureText& posture : file_.posture) {
      robot.posture(*robot.model.find_joint(posture.joint.text)) = posture.value.quantity.value;
    }
    robot.slew = Eigen::VectorXd::Constant(robot.model.joint_count(), solver::infinity);
    for (int j = 0; j < robot.model.joint_count(); ++j) {
      const std::string& name = robot.model.joint(j).name;
      if (robot.model.joint(j).actuated) robot.slew(j) = robot.model.joint(j).max_effort / full_torque_within;
      Span span = urdf_.find_joint(name)->span;
      for (const ActuatorText& actuator : file_.actuators) {
        if (actuator.joint.text != name) continue;
        span = actuator.joint.span;
        if (actuator.slew_text) robot.slew(j) = actuator.slew_text->quantity.value;
      }
      robot.joint_spans.push_back(span);
      robot.friction.push_back(friction_of(name));
    }
  }

  JointFriction friction_of(const std::string& joint) const {
    const auto text = std::find_if(file_.friction.begin(), file_.friction.end(),
                                   [&](const FrictionText& f) { return f.joint.text == joint; });
    if (text == file_.friction.end()) return {};
    const auto number = [](const std::optional<ValueText>& value) {
      return value ? value->quantity.value : 0.0;
    };
    return {number(text->coulomb), number(text->presliding), number(text->viscous), text->compensate};
  }

  const RobotFile& file_;
  const Urdf& urdf_;
};

}  // namespace

solver::Model model_of(const RobotFile& file, const Urdf& urdf) {
  return RobotAssembly(file, urdf).model();
}

Robot assemble_robot(const RobotFile& file, const Urdf& urdf) {
  return RobotAssembly(file, urdf).robot();
}

}  // namespace zwang::lang
