#include "robot/load_robot.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "diagnostic/wordings_standing.hpp"
#include "diagnostic/wordings_statics.hpp"
#include "robot/adapt_urdf.hpp"
#include "robot/assemble_robot.hpp"
#include "robot/based_on.hpp"
#include "robot/check_joints.hpp"
#include "robot/check_push.hpp"
#include "robot/drive_entry.hpp"
#include "robot/each_wheel.hpp"
#include "robot/exact_wheels.hpp"
#include "robot/feels_entry.hpp"
#include "robot/joint_axes.hpp"
#include "robot/pads_entry.hpp"
#include "robot/possible_bodies.hpp"
#include "robot/robot_file.hpp"
#include "robot/supports.hpp"
#include "robot/turned_joints.hpp"
#include "robot/urdf.hpp"
#include "robot/wheel_speed.hpp"
#include "spec/parse_task.hpp"
#include "tree/file.hpp"
#include "zwang/lang/footing.hpp"
#include "zwang/lang/plane.hpp"

namespace zwang::lang {

namespace {

/// Checks a robot file against its URDF before and after both become a robot.
class RobotBuilder {
 public:
  RobotBuilder(const RobotFile& file, Urdf urdf, int errors_before, Diagnostics& diagnostics)
      : file_(file), urdf_(std::move(urdf)), errors_before_(errors_before), diagnostics_(diagnostics) {}

  std::optional<Robot> build() {
    adapt_urdf(file_, urdf_, diagnostics_);
    if (diagnostics_.error_count() > errors_before_) return std::nullopt;
    check_base();
    apply_actuators();
    check_couplings(file_, urdf_, diagnostics_);
    check_posture();
    check_friction();
    check_starts(file_, urdf_, diagnostics_);
    check_wheels();
    check_supports(file_, urdf_, diagnostics_);
    check_frames();
    check_footprint();
    check_drive(file_, diagnostics_);
    if (diagnostics_.error_count() > errors_before_) return std::nullopt;
    check_bodies(file_, urdf_, diagnostics_);
    if (diagnostics_.error_count() > errors_before_) return std::nullopt;
    try {
      stand_wheels_exactly(model_of(file_, urdf_), file_, urdf_, diagnostics_);
      Robot robot = assemble_robot(file_, urdf_);
      if (!stands(robot)) return std::nullopt;
      check_twist(file_, robot.model, diagnostics_);
      check_feels(file_, robot.model, diagnostics_);
      check_pads(file_, robot.model, diagnostics_);
      lead_by_contact(robot.drive, robot.model.total_mass(), file_.feels_span, diagnostics_);
      if (diagnostics_.error_count() > errors_before_) return std::nullopt;
      return robot;
    } catch (const std::invalid_argument& error) {
      complain(error.what());
      return std::nullopt;
    }
  }

 private:
  /// The URDF's joint, or the complaint that there is none.
  UrdfJoint* moving_joint(const Word& name) {
    if (!name.exists() || !good_name(name.text)) return nullptr;
    std::vector<std::string> moving;
    for (UrdfJoint& joint : urdf_.joints) {
      if (joint.joint.type != solver::JointType::fixed) moving.push_back(joint.joint.name);
      if (joint.joint.name != name.text) continue;
      if (joint.joint.type != solver::JointType::fixed) return &joint;
      bad_names_.insert(name.text);
      diagnostics_.add(wording::fixed_joint(name.span, name.text, joint.span));
      return nullptr;
    }
    const UrdfJoint* above = urdf_.joint_above(name.text);
    diagnostics_.add(above != nullptr ? wording::link_for_a_joint(name.span, name.text, above->joint.name)
                                      : wording::unknown_name(name.span, "joint", name.text, moving));
    return nullptr;
  }

  /// False once the name was complained of: a joint is named as a wheel and as an actuator.
  bool good_name(const std::string& name) const { return !bad_names_.contains(name); }

  /// The base floats: everything above it, up to the URDF's root, must be fixed to it.
  void check_base() {
    if (file_.base.exists() && urdf_.find_link(file_.base.text) == nullptr)
      diagnostics_.add(
          wording::unknown_base(file_.base.span, file_.base.text, urdf_.link_names(), urdf_.root));
    for (const UrdfJoint* above = urdf_.joint_above(file_.base.text); above != nullptr;
         above = urdf_.joint_above(above->parent)) {
      if (above->joint.type != solver::JointType::fixed) {
        diagnostics_.add(wording::base_below_joint(file_.base.span, file_.base.text, above->joint.name));
        return;
      }
    }
  }

  void apply_actuators() {
    for (const ActuatorText& actuator : file_.actuators) {
      UrdfJoint* joint = moving_joint(actuator.joint);
      if (joint == nullptr) continue;
      const bool slides = joint->joint.type == solver::JointType::prismatic;
      const Dimension expected = slides ? dimension::force : dimension::torque;
      const std::string whose = "actuator `" + actuator.joint.text + "`'s ";
      joint->joint.actuated = true;
      const double gear = actuator.gear.value_or(1.0);
      joint->joint.rotor_inertia = gear * gear * actuator.rotor_inertia.value_or(0.0);
      if (actuator.slew_text)
        require_positive(*actuator.slew_text, expected / dimension::time, whose + "slew", false,
                         diagnostics_);
      if (actuator.effort_text) {
        if (require_positive(*actuator.effort_text, expected, whose + "effort", false, diagnostics_))
          joint->joint.max_effort = actuator.effort_text->quantity.value;
      } else if (const ValueText* each = effort_of_each_joint(file_, *joint, expected)) {
        joint->joint.max_effort = each->quantity.value;
      } else if (!std::isfinite(joint->joint.max_effort)) {
        diagnostics_.add(wording::no_effort(actuator.joint.span, actuator.joint.text, joint->span));
      }
    }
  }

  /// N and m of a joint that slides, N m and an angle of one that turns.
  void check_friction() {
    for (const FrictionText& friction : file_.friction) {
      const UrdfJoint* joint = moving_joint(friction.joint);
      if (joint == nullptr) continue;
      const bool slides = joint->joint.type == solver::JointType::prismatic;
      const auto check = [&](const char* key, const std::optional<ValueText>& value,
                             const Dimension& expected, bool zero_allowed) {
        if (!value) return;
        const std::string what = std::string("`") + key + "` of the " + (slides ? "sliding" : "turning") +
                                 " joint `" + friction.joint.text + "`";
        require_positive(*value, expected, what, zero_allowed, diagnostics_);
      };
      check("coulomb", friction.coulomb, slides ? dimension::force : dimension::torque, true);
      check("presliding", friction.presliding, slides ? dimension::length : dimension::angle, false);
      check("viscous", friction.viscous, slides ? dimension::damping : dimension::angular_damping, true);
    }
  }

  void check_posture() {
    for (const PostureText& posture : file_.posture) {
      const UrdfJoint* joint = moving_joint(posture.joint);
      if (joint == nullptr) continue;
      const bool slides = joint->joint.type == solver::JointType::prismatic;
      const std::string what = posture_name(posture.joint.text);
      if (!require_quantity(posture.value, slides ? dimension::length : dimension::angle, what, diagnostics_))
        continue;
      const double q = posture.value.quantity.value;
      if (q < joint->joint.lower || q > joint->joint.upper) {
        diagnostics_.add(wording::posture_outside(posture.value.span, what, joint->span));
      }
    }
  }

  void check_wheels() {
    std::set<std::string> seen;
    for (const WheelText& wheel : file_.wheels) {
      const UrdfJoint* joint = moving_joint(wheel.joint);
      if (joint == nullptr) continue;
      if (joint->joint.type == solver::JointType::prismatic) {
        diagnostics_.add(wording::sliding_wheel(wheel.joint.span, wheel.joint.text, joint->span));
      }
      if (!seen.insert(wheel.joint.text).second) {
        diagnostics_.add(wording::doubled_wheel(wheel.joint.span, wheel.joint.text));
      }
    }
  }

  void check_frames() {
    std::vector<std::string> known = urdf_.link_names();
    for (const FrameText& frame : file_.frames) {
      if (frame.parent.exists() && std::find(known.begin(), known.end(), frame.parent.text) == known.end()) {
        diagnostics_.add(wording::unknown_frame(frame.parent.span, "link or earlier frame", frame.parent.text,
                                                known, file_.base.text));
      }
      if (!frame.name.exists()) continue;
      if (frame.name.text == "world" || urdf_.find_link(frame.name.text) != nullptr) {
        diagnostics_.add(wording::name_taken(frame.name.span, frame.name.text, "a link of the URDF"));
      }
      known.push_back(frame.name.text);
    }
    if (file_.lead.exists() && std::find(known.begin(), known.end(), file_.lead.text) == known.end())
      diagnostics_.add(
          wording::unknown_frame(file_.lead.span, "link or frame", file_.lead.text, known, file_.base.text));
  }

  void check_footprint() {
    const auto& corners = file_.footprint;
    if (corners.size() >= 3 && std::abs(plane::signed_area(corners)) < 1e-6) {
      diagnostics_.add(wording::flat_polygon(file_.footprint_span, "footprint"));
    } else if (plane::crosses_itself(corners)) {
      diagnostics_.add(wording::crossing_edges("E807", file_.footprint_span, "the footprint"));
    }
  }

  /// E640 where the mass lies outside of what carries it, on its edge, or beside points on a line. W640 where
  /// it lies next to the edge.
  bool stands(const Robot& robot) {
    const std::optional<Footing> footing = footing_of(robot);
    if (!footing || !footing->is_on_edge()) return true;
    const Span& span = file_.supports.empty() ? file_.base.span : file_.supports.front().span;
    const bool falls = footing->inside <= rounding_of_places;
    const double outside = footing->inside < -rounding_of_places ? -footing->inside : 0.0;
    diagnostics_.add(
        falls ? wording::falls_over(span, robot.name, outside, !file_.supports.empty())
              : wording::stands_on_edge(span, robot.name, footing->inside, footing->height, footing->lean()));
    return !falls;
  }

  /// Adds the model builder's complaint at the first part that it names.
  void complain(const std::string& complaint) {
    const std::size_t open = complaint.find('`');
    const std::size_t close = complaint.find('`', open + 1);
    std::string name;
    if (close != std::string::npos) name = complaint.substr(open + 1, close - open - 1);
    diagnostics_.add(wording::impossible_model(span_of(name), complaint));
  }

  /// The link that the model builder names in its complaint, else the robot file's base.
  Span span_of(const std::string& name) const {
    if (const UrdfLink* link = urdf_.find_link(name)) return link->span;
    if (const UrdfJoint* joint = urdf_.find_joint(name)) return joint->span;
    for (const FrameText& frame : file_.frames) {
      if (frame.name.text == name) return frame.name.span;
    }
    return file_.base.span;
  }

  const RobotFile& file_;
  Urdf urdf_;
  int errors_before_;  ///< of other files
  Diagnostics& diagnostics_;
  std::set<std::string> bad_names_;
};

}  // namespace

std::optional<Robot> build_robot(const RobotFile& file, Urdf urdf, int errors_before,
                                 Diagnostics& diagnostics) {
  return RobotBuilder(file, std::move(urdf), errors_before, diagnostics).build();
}

std::optional<Robot> load_robot_below(const std::filesystem::path& path, const std::filesystem::path& root,
                                      const Span& cause, Diagnostics& diagnostics) {
  const int errors_before = diagnostics.error_count();
  const std::optional<int> source = read_file(path, yaml_size_limit, cause, diagnostics);
  if (!source) return std::nullopt;
  if (diagnostics.source(*source).text.starts_with("<")) {
    diagnostics.add(wording::urdf_for_robot_file({*source, {1, 1}, {1, 2}}));
    return std::nullopt;
  }
  std::optional<Document> document = read(*source, diagnostics);
  if (!document) return std::nullopt;
  const auto urdf_from = add_based_on(*document, path, root, diagnostics);
  if (!urdf_from) return std::nullopt;
  std::optional<RobotFile> file = parse_robot_file(*document, diagnostics);
  if (!file || !file->urdf.exists()) return std::nullopt;
  const auto urdf_path = resolve_path(file->urdf.text, *urdf_from, root, file->urdf.span, diagnostics);
  if (!urdf_path) return std::nullopt;
  UrdfChanges changes;
  for (const Word& link : file->ignored) changes.ignored.push_back(link.text);
  for (const Word& joint : file->turning) changes.turning.push_back(joint.text);
  std::optional<Urdf> urdf = read_urdf(*urdf_path, file->urdf.span, diagnostics, changes);
  if (!urdf) return std::nullopt;
  check_turning(*file, *urdf, diagnostics);
  apply_axes(*file, *urdf, diagnostics);
  place_rollers(*file, *urdf);
  std::optional<Robot> robot = build_robot(*file, *urdf, errors_before, diagnostics);
  if (!robot) return std::nullopt;
  check_wheels_stand(*file, *urdf, *robot, diagnostics);
  check_steps(*file, *urdf, *robot, diagnostics);
  check_rollers(*file, *robot, diagnostics);
  check_trails(*file, *robot, diagnostics);
  check_wheel_shapes(*file, *urdf, diagnostics);
  check_wheel_inertias(*file, *robot, diagnostics);
  check_push(*file, *robot, diagnostics);
  check_arms(*file, *robot, diagnostics);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  check_speed_limits(*robot, diagnostics);
  return robot;
}

solver::State start_state(const Robot& robot) {
  solver::State state(robot.model);
  if (robot.posture.size() == state.q.size()) state.q = robot.posture;
  return state;
}

std::optional<Robot> load_robot(const std::filesystem::path& path, Diagnostics& diagnostics) {
  std::optional<Robot> robot = load_robot_below(path, root_of(path), {}, diagnostics);
  diagnostics.settle();
  return robot;
}

}  // namespace zwang::lang
