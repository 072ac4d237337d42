#include "schedule/task_list.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "schedule/braking.hpp"
#include "schedule/plane_norm.hpp"
#include "schedule/region_fence.hpp"
#include "schedule/wait_course.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::runtime {

namespace {

void require_index(int index, std::size_t size, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= size) {
    throw std::invalid_argument(std::string("scheduler: ") + what + " is out of range");
  }
}

/// One task, or `always`, against the program that it stands in.
class TaskCheck {
 public:
  TaskCheck(const lang::Program& program, std::size_t frames, const lang::Task& task)
      : program_(program), frames_(frames), task_(task) {}

  void check() const {
    for (const lang::Group& group : task_.groups) check_group(group);
    for (const lang::Exit& exit : task_.exits) {
      check_condition(exit.when);
      check_target(exit.target);
      for (const lang::SetAction& action : exit.set) check_set(action);
    }
    for (const lang::SetAction& action : task_.set_on_entry) check_set(action);
    if (task_.require) check_condition(*task_.require);
    if (task_.timeout) check_target(task_.timeout->target);
    if (task_.attempts) check_target(task_.attempts->target);
  }

 private:
  void check_group(const lang::Group& group) const {
    require_index(group.move, frames_, "a moved frame");
    require_index(group.in, frames_, "an axes frame");
    for (const lang::AxisStatements& axis : group.axes) {
      if (axis.target.signal >= 0)
        require_index(axis.target.signal, program_.signals.size(), "a value's signal");
      if (axis.yield) check_condition(axis.yield->force);
    }
  }

  void check_target(const lang::Target& target) const {
    if (target.kind == lang::TargetKind::task) {
      require_index(target.task, program_.tasks.size(), "an exit's target");
    }
  }

  void check_set(const lang::SetAction& action) const {
    switch (action.kind) {
      case lang::SetKind::frame:
        require_index(action.index, frames_, "a frame to set");
        require_index(action.source, frames_, "a frame to copy");
        return;
      case lang::SetKind::parameter:
        return require_index(action.index, program_.parameters.size(), "a parameter to set");
      case lang::SetKind::output:
        return require_index(action.index, program_.outputs.size(), "an output to set");
    }
  }

  void check_condition(const lang::Condition& condition) const {
    for (std::size_t i = 0; i < condition.nodes.size(); ++i) {
      const lang::ExpressionNode& node = condition.nodes[i];
      if (node.left >= static_cast<int>(i) || node.right >= static_cast<int>(i)) {
        throw std::invalid_argument("scheduler: an operand stands behind its operator");
      }
      check_name(node);
    }
  }

  void check_name(const lang::ExpressionNode& node) const {
    switch (node.op) {
      case lang::Op::parameter:
        return require_index(node.index, program_.parameters.size(), "a condition's parameter");
      case lang::Op::of_frame:
        require_index(node.function, lang::condition_functions().size(), "a condition's function");
        return require_index(node.index, frames_, "a condition's frame");
      case lang::Op::of_task:
        require_index(node.function, lang::condition_functions().size(), "a condition's function");
        return require_index(node.index, program_.tasks.size(), "a condition's task");
      case lang::Op::output:
        return require_index(node.index, program_.outputs.size(), "a condition's output");
      case lang::Op::estimated_wrench:
        return require_index(node.index, frames_, "a condition's frame");
      case lang::Op::signal:
      case lang::Op::valid:
        return require_index(node.index, program_.signals.size(), "a condition's signal");
      case lang::Op::feature:
        return require_index(node.index, program_.features.size(), "a condition's feature");
      case lang::Op::estimated_force:
        return require_index(node.axis, 3, "an axis of the estimated force");
      case lang::Op::coordinate: {
        const std::vector<lang::Group>& groups = node.in_always ? program_.always.groups : task_.groups;
        require_index(node.index, groups.size(), "a condition's group");
        return require_index(node.axis, groups[static_cast<std::size_t>(node.index)].axes.size(),
                             "a condition's axis");
      }
      default:
        return;
    }
  }

  const lang::Program& program_;
  std::size_t frames_;
  const lang::Task& task_;
};

std::size_t axis_count(const lang::Task& task) {
  std::size_t count = 0;
  for (const lang::Group& group : task.groups) count += group.axes.size();
  return count;
}

int row_count(const lang::Task& task) {
  int rows = 0;
  for (const lang::Group& group : task.groups) {
    if (group.kind == lang::GroupKind::inside) {
      rows += RegionFence::most_near;
      continue;
    }
    for (const lang::AxisStatements& a : group.axes) {
      if (limits_a_plane(a)) rows += PlaneNorm::most_sides * ((a.acceleration ? 2 : 0) + (a.force ? 1 : 0));
      rows += (a.driver || a.force ? 1 : 0) +
              2 * ((a.position ? 1 : 0) + (a.velocity ? 1 : 0) + (a.acceleration ? 1 : 0));
    }
  }
  return rows;
}

/// Whether the frame rides on a part of the robot.
bool is_on_robot(const std::vector<lang::FrameDeclaration>& frames, int frame) {
  const lang::FrameDeclaration* f = &frames[static_cast<std::size_t>(frame)];
  while (f->parent == lang::FrameParent::frame) f = &frames[static_cast<std::size_t>(f->parent_index)];
  return f->parent == lang::FrameParent::body;
}

void shape(lang::Group& group, const lang::Program& program,
           const std::vector<lang::FrameDeclaration>& frames) {
  if (group.path >= 0) {
    require_index(group.path, program.paths.size(), "a path");
    group.in = program.paths[static_cast<std::size_t>(group.path)].frame;
    if (program.paths[static_cast<std::size_t>(group.path)].pieces.empty())
      throw std::invalid_argument("scheduler: a path has no pieces");
  }
  if (group.kind == lang::GroupKind::inside) {
    require_index(group.region, program.regions.size(), "a region");
    group.in = program.regions[static_cast<std::size_t>(group.region)].parent;
    lang::AxisStatements rows;
    rows.name = group.name;
    rows.level = group.level;
    rows.span = group.span;
    rows.position = lang::ValueRange{group.margin, {.constant = solver::infinity}};
    rows.return_speed = group.return_speed;
    group.axes = {rows};
  }
  if (group.kind == lang::GroupKind::feature) {
    require_index(group.feature, program.features.size(), "a feature");
    const lang::Feature& feature = program.features[static_cast<std::size_t>(group.feature)];
    require_index(feature.first, frames.size(), "a feature's frame");
    require_index(feature.second, frames.size(), "a feature's frame");
    group.move = feature.first;
    group.in = feature.second;
    // A quantity between two frames is the same either way.
    const bool both_ways =
        feature.kind == lang::FeatureKind::distance || feature.kind == lang::FeatureKind::angle;
    if (both_ways && !is_on_robot(frames, group.move)) std::swap(group.move, group.in);
    for (lang::AxisStatements& axis : group.axes) {
      axis.axis = feature.turns ? solver::Axis::rz : solver::Axis::x;
    }
  }
}

std::size_t longest_condition(const lang::Task& task) {
  std::size_t nodes = task.require ? task.require->nodes.size() : 0;
  for (const lang::Exit& exit : task.exits) nodes = std::max(nodes, exit.when.nodes.size());
  for (const lang::Group& group : task.groups) {
    for (const lang::AxisStatements& axis : group.axes)
      nodes = std::max(nodes, axis.yield ? axis.yield->force.nodes.size() : 0);
  }
  return nodes;
}

/// Whether one of the ways out of the task, but for its `require`, is `wanted`.
template <typename Wanted>
bool has_way(const lang::Task& task, const Wanted& wanted) {
  if (task.timeout && wanted(task.timeout->target)) return true;
  if (task.attempts && wanted(task.attempts->target)) return true;
  return std::any_of(task.exits.begin(), task.exits.end(),
                     [&](const lang::Exit& exit) { return wanted(exit.target); });
}

bool leads_back(const lang::Target& target, const std::vector<bool>& known) {
  if (target.kind == lang::TargetKind::back) return true;
  return target.kind == lang::TargetKind::task && known[static_cast<std::size_t>(target.task)];
}

bool reaches_done(const lang::Target& target, const std::vector<bool>& known) {
  return target.kind == lang::TargetKind::done || leads_back(target, known);
}

}  // namespace

TaskList::TaskList(const lang::Program& program, const std::vector<lang::FrameDeclaration>& frames, int base,
                   const std::vector<HeldJoint>& joints)
    : tasks(program.tasks), program_tasks(static_cast<int>(program.tasks.size())) {
  require_index(program.start, tasks.size(), "the start task");
  for (lang::Task& task : tasks) {
    for (lang::Group& group : task.groups) shape(group, program, frames);
    add_limits(task, program.always, program.robot, base, frames);
  }
  tasks.push_back(brake_task("done", program.robot, base));
  tasks.push_back(brake_task("failed", program.robot, base));
  // Nothing of `always` drives in an end: every joint is held there.
  for (int t = 0; t <= failed(); ++t) {
    add_holds(tasks[static_cast<std::size_t>(t)], ends(t) ? lang::Always{} : program.always, joints, frames,
              program.robot.model);
  }
  lang::Task always;
  always.name = "always";
  always.groups = program.always.groups;
  always.exits = program.always.exits;
  for (lang::Group& group : always.groups) shape(group, program, frames);
  tasks.push_back(always);

  for (const lang::Task& task : tasks) {
    TaskCheck(program, frames.size(), task).check();
    most_axes = std::max(most_axes, axis_count(task));
    most_exits = std::max(most_exits, task.exits.size());
    most_rows = std::max(most_rows, row_count(task));
    most_nodes = std::max(most_nodes, longest_condition(task));
    most_compared = std::max(most_compared, comparisons(task.exits).size());
  }
  most_axes += axis_count(always);
  most_rows += row_count(always);

  // An exit of `always` leads back from wherever it is.
  leads_back.assign(tasks.size(), std::any_of(always.exits.begin(), always.exits.end(), [](const auto& exit) {
                      return exit.target.kind == lang::TargetKind::back;
                    }));
  reaches_done.assign(tasks.size(), false);
  reaches_done[static_cast<std::size_t>(done())] = true;
  for (std::size_t pass = 0; pass < tasks.size(); ++pass) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const auto back = [&](const lang::Target& to) { return runtime::leads_back(to, leads_back); };
      const auto to_done = [&](const lang::Target& to) { return runtime::reaches_done(to, reaches_done); };
      if (has_way(tasks[i], back)) leads_back[i] = true;
      if (has_way(tasks[i], to_done)) reaches_done[i] = true;
    }
  }
}

}  // namespace zwang::runtime
