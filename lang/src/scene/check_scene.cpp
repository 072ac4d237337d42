#include "scene/check_scene.hpp"

#include <algorithm>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "scene/check_start.hpp"
#include "words/nearest.hpp"
#include "zwang/lang/fault_word.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

namespace {

void check_rollers(const Scene& scene, const Robot& robot, Diagnostics& diagnostics) {
  const auto& wheels = robot.model.wheels();
  const auto rolls = [](const solver::Wheel& wheel) { return wheel.roller_angle.has_value(); };
  if (scene.real_rollers && std::none_of(wheels.begin(), wheels.end(), rolls))
    diagnostics.add(wording::no_rollers(scene.real_rollers_span, robot.name));
}

void check_hook(const std::optional<Dock>& dock, const Robot& robot, Diagnostics& diagnostics) {
  if (!dock || dock->hook.empty() || robot.model.find_frame(dock->hook)) return;
  std::vector<std::string> frames;
  for (const solver::Frame& frame : robot.model.frames()) frames.push_back(frame.name);
  diagnostics.add(wording::unknown_hook(dock->hook_span, dock->hook, nearest(dock->hook, frames)));
}

/// A frame of the robot, by its name; an empty one is the base's.
void check_frame_of(const Robot& robot, const std::string& frame, const Span& span,
                    Diagnostics& diagnostics) {
  if (frame.empty() || robot.model.find_frame(frame)) return;
  std::vector<std::string> frames;
  for (const solver::Frame& each : robot.model.frames()) frames.push_back(each.name);
  diagnostics.add(wording::unknown_name(span, "frame of the robot", frame, frames));
}

/// The frames at which sensors sit.
void check_sensors(const std::vector<SceneSignal>& signals, const Robot& robot, Diagnostics& diagnostics) {
  for (const SceneSignal& signal : signals) {
    if (signal.kind == SceneSignalKind::wrench)
      check_frame_of(robot, signal.frame, signal.source_span, diagnostics);
  }
}

/// Names of the joints that a motor turns.
std::vector<std::string> motors_of(const solver::Model& model) {
  std::vector<std::string> names;
  for (int j = 0; j < model.joint_count(); ++j) {
    if (model.joint(j).actuated) names.push_back(model.joint(j).name);
  }
  return names;
}

void check_motor(const Fault& fault, const Robot& robot, Diagnostics& diagnostics) {
  const std::vector<std::string> motors = motors_of(robot.model);
  const bool is_known = std::find(motors.begin(), motors.end(), fault.joint) != motors.end();
  if (is_known) return;
  if (robot.model.find_joint(fault.joint)) {
    diagnostics.add(wording::fault_without_motor(fault.joint_span, fault.joint));
  } else {
    diagnostics.add(wording::unknown_name(fault.joint_span, "joint with a motor", fault.joint, motors));
  }
}

/// The floor is slippery under a wheel, whether a motor turns it or not.
void check_wheel(const Fault& fault, const Robot& robot, Diagnostics& diagnostics) {
  std::vector<std::string> wheels;
  for (const solver::Wheel& wheel : robot.model.wheels())
    wheels.push_back(robot.model.joint(wheel.body - 1).name);
  const bool is_known = std::find(wheels.begin(), wheels.end(), fault.joint) != wheels.end();
  if (!is_known) diagnostics.add(wording::unknown_name(fault.joint_span, "wheel", fault.joint, wheels));
}

void check_payload(const Fault& fault, const Robot& robot, Diagnostics& diagnostics) {
  const double mass = robot.model.bodies().front().inertia.mass;
  if (fault.value < -most_payload_less * mass)
    diagnostics.add(wording::too_light(fault.span, most_payload_less * mass));
}

void check_fault(const Fault& fault, const Robot& robot, Diagnostics& diagnostics) {
  if (fault.kind == FaultKind::payload) check_payload(fault, robot, diagnostics);
  if (fault.joint.empty()) return;
  if (fault.kind == FaultKind::floor_friction) {
    check_wheel(fault, robot, diagnostics);
  } else {
    check_motor(fault, robot, diagnostics);
  }
}

}  // namespace

void check_faults_for(const std::vector<Fault>& faults, const Robot& robot, Diagnostics& diagnostics) {
  for (const Fault& fault : faults) {
    if (fault.robot.empty()) check_fault(fault, robot, diagnostics);
  }
}

void check_faults_of_partners(const std::vector<Fault>& faults, const Scene& scene,
                              Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const SceneRobot& robot : scene.robots) names.push_back(robot.name);
  for (const Fault& fault : faults) {
    if (fault.robot.empty()) continue;
    const auto named = std::find(names.begin(), names.end(), fault.robot);
    if (named == names.end()) {
      diagnostics.add(wording::unknown_name(fault.robot_span, "robot", fault.robot, names));
      continue;
    }
    const SceneRobot& robot = scene.robots[static_cast<std::size_t>(named - names.begin())];
    if (robot.program) check_fault(fault, robot.program->robot, diagnostics);
  }
}

void check_leaving_objects(const std::vector<Fault>& faults, const Scene& scene, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const SceneObject& object : scene.objects) {
    if (!object.guide && !object.leans()) names.push_back(object.name);
  }
  for (const Fault& fault : faults) {
    if (fault.kind != FaultKind::object_leaves || std::ranges::find(names, fault.object) != names.end())
      continue;
    diagnostics.add(wording::unknown_name(fault.object_span, "object that can leave", fault.object, names));
  }
}

void check_partners(const Scene& scene, Diagnostics& diagnostics) {
  for (const SceneRobot& other : scene.robots) {
    if (!other.program) continue;
    check_sensors(other.signals, other.program->robot, diagnostics);
    for (const ScenePush& push : scene.pushes) {
      if (push.robot == other.name)
        check_frame_of(other.program->robot, push.frame, push.frame_span, diagnostics);
    }
  }
}

void check_scene_for(const Scene& scene, const Robot& robot, Diagnostics& diagnostics) {
  check_rollers(scene, robot, diagnostics);
  for (const SceneObject& object : scene.objects) check_hook(object.dock, robot, diagnostics);
  for (const SceneRobot& other : scene.robots) check_hook(other.dock, robot, diagnostics);
  for (const ScenePush& push : scene.pushes) {
    if (push.object.empty() && push.robot.empty())
      check_frame_of(robot, push.frame, push.frame_span, diagnostics);
  }
  check_sensors(scene.signals, robot, diagnostics);
  check_faults_for(scene.faults, robot, diagnostics);
  check_start(scene, robot, diagnostics);
}

}  // namespace zwang::lang
