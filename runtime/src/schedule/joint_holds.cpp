#include "schedule/joint_holds.hpp"

#include <algorithm>

#include "zwang/solver/wheels.hpp"

namespace zwang::runtime {

namespace {

using lang::AxisStatements;
using solver::Axis;
using solver::Quantity;

/// Above every level that a task file can name. Forces and accelerations of the base are then those of a
/// robot whose arm is stiff, and a push keeps its newtons. Below those levels, the push would be computed for
/// an arm that hangs loose.
constexpr int hold_level = -1;
/// A short time: a contact bends a held joint by T^2 times the missing acceleration. [s]
constexpr double hold_time_constant = 0.05;

/// The body that a frame rides on; -1: none of the robot's.
int body_of(const std::vector<lang::FrameDeclaration>& frames, int frame) {
  const lang::FrameDeclaration* f = &frames[static_cast<std::size_t>(frame)];
  while (f->parent == lang::FrameParent::frame) f = &frames[static_cast<std::size_t>(f->parent_index)];
  return f->parent == lang::FrameParent::body ? f->parent_index : -1;
}

bool carries(const solver::Model& model, int joint_body, int body) {
  for (int b = body; b > 0; b = model.bodies()[static_cast<std::size_t>(b)].parent) {
    if (b == joint_body) return true;
  }
  return false;
}

/// Motion between two bodies is that of the joints between them; of a body in axes that it carries itself, it
/// is motion against the world.
bool uses(const lang::Group& group, const HeldJoint& joint, const std::vector<lang::FrameDeclaration>& frames,
          const solver::Model& model) {
  if (group.kind == lang::GroupKind::inside) return false;
  const bool drives = std::any_of(group.axes.begin(), group.axes.end(),
                                  [](const AxisStatements& a) { return a.driver.has_value(); });
  if (!drives) return false;
  const int moved = body_of(frames, group.move), axes = body_of(frames, group.in);
  const bool moves_it = carries(model, joint.body, moved);
  return moved == axes ? moves_it : moves_it != carries(model, joint.body, axes);
}

int add_frame(std::vector<lang::FrameDeclaration>& frames, const std::string& name, int body,
              const solver::Pose& pose) {
  lang::FrameDeclaration frame;
  frame.name = name;
  frame.parent = lang::FrameParent::body;
  frame.parent_index = body;
  frame.pose = pose;
  frames.push_back(frame);
  return static_cast<int>(frames.size()) - 1;
}

}  // namespace

std::vector<HeldJoint> find_held_joints(std::vector<lang::FrameDeclaration>& frames,
                                        const solver::Model& model) {
  std::vector<HeldJoint> joints;
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    if (!joint.actuated || turns_wheel(model, j + 1)) continue;
    const solver::Body& body = model.bodies()[static_cast<std::size_t>(j) + 1];
    const solver::Pose along{solver::rotation_between(solver::Vector3::UnitZ(), joint.axis),
                             solver::Vector3::Zero()};
    HeldJoint held;
    held.name = joint.name;
    held.body = j + 1;
    held.slides = joint.type == solver::JointType::prismatic;
    held.moves = add_frame(frames, joint.name, j + 1, along);
    held.measured = add_frame(frames, joint.name, body.parent, body.pose_in_parent * along);
    joints.push_back(held);
  }
  return joints;
}

void add_holds(lang::Task& task, const lang::Always& always, const std::vector<HeldJoint>& joints,
               const std::vector<lang::FrameDeclaration>& frames, const solver::Model& model) {
  const std::size_t before = task.groups.size();
  for (const HeldJoint& joint : joints) {
    const auto uses_it = [&](const lang::Group& group) { return uses(group, joint, frames, model); };
    if (std::any_of(task.groups.begin(), task.groups.begin() + static_cast<std::ptrdiff_t>(before), uses_it))
      continue;
    if (std::any_of(always.groups.begin(), always.groups.end(), uses_it)) continue;
    lang::Group group;
    group.name = "hold";
    group.move = joint.moves;
    group.in = joint.measured;
    AxisStatements axis;
    axis.name = group.name + "." + joint.name;
    axis.axis = joint.slides ? Axis::z : Axis::rz;
    axis.driver = Quantity::position;
    axis.here = true;
    axis.time_constant.constant = hold_time_constant;
    axis.level = hold_level;
    group.axes.push_back(axis);
    task.groups.push_back(group);
  }
}

}  // namespace zwang::runtime
