#include "schedule/braking.hpp"

#include <algorithm>
#include <limits>

#include "zwang/solver/base_analysis.hpp"

namespace zwang::runtime {

namespace {

using lang::AxisStatements;
using solver::Axis;
using solver::Quantity;

// Short against the time any stop takes, so that the deceleration, not the time constant, shapes it.
constexpr double brake_time_constant = 0.05;      // [s]
constexpr double brake_blend = 0.1;               // [s]
constexpr double radius_without_footprint = 0.3;  // [m]

const char* word(Axis axis) {
  constexpr const char* words[] = {"x", "y", "z", "rx", "ry", "rz"};
  return words[static_cast<std::size_t>(axis)];
}

bool is_rotation(Axis axis) {
  return axis >= Axis::rx;
}

lang::ValueRange plus_minus(double bound) {
  return {{.constant = -bound}, {.constant = bound}};
}

std::optional<lang::ValueRange>& range_of(AxisStatements& axis, Quantity quantity) {
  switch (quantity) {
    case Quantity::position:
      return axis.position;
    case Quantity::velocity:
      return axis.velocity;
    case Quantity::acceleration:
      return axis.acceleration;
    case Quantity::force:
      break;
  }
  return axis.force;
}

/// The level of the first driver: it may break a range of a later one.
int first_driven_level(const std::vector<lang::Group>& groups) {
  int first = std::numeric_limits<int>::max();
  for (const lang::Group& group : groups) {
    for (const AxisStatements& axis : group.axes) {
      if (axis.driver) first = std::min(first, axis.level);
    }
  }
  return first;
}

/// Whether one of their ranges takes the place of the limit: one that no driver breaks. `driven` is the level
/// of the first one.
bool gives(const std::vector<lang::Group>& groups, const lang::BaseLimit& limit,
           const std::vector<lang::FrameDeclaration>& frames, int driven) {
  for (const lang::Group& group : groups) {
    if (group.kind != lang::GroupKind::axes) continue;
    if (!is_base(frames, group.move) || !is_base(frames, group.in)) continue;
    for (AxisStatements axis : group.axes) {
      const bool holds = !axis.weight && axis.level <= driven;
      if (holds && !axis.is_planar && axis.axis == limit.axis && range_of(axis, limit.quantity)) return true;
    }
  }
  return false;
}

AxisStatements& axis_of(lang::Group& group, Axis axis, const lang::Span& span) {
  for (AxisStatements& a : group.axes) {
    if (a.axis == axis) return a;
  }
  AxisStatements added;
  added.name = group.name + "." + word(axis);
  added.axis = axis;
  added.level = 0;
  added.span = span;
  group.axes.push_back(added);
  return group.axes.back();
}

void limit_axis(lang::Group& group, const lang::BaseLimit& limit) {
  AxisStatements& axis = axis_of(group, limit.axis, limit.span);
  range_of(axis, limit.quantity) =
      lang::ValueRange{{.constant = limit.range.low}, {.constant = limit.range.high}};
  axis.statement_spans[static_cast<std::size_t>(limit.quantity)] = limit.span;
}

}  // namespace

bool is_base(const std::vector<lang::FrameDeclaration>& frames, int frame) {
  const lang::FrameDeclaration& f = frames[static_cast<std::size_t>(frame)];
  return f.parent == lang::FrameParent::body && f.parent_index == 0 && f.pose.position.isZero() &&
         f.pose.rotation.isIdentity();
}

solver::Vector3 effective_mass_of(const lang::Robot& robot) {
  solver::Vector3 mass = solver::Vector3::Constant(robot.model.total_mass());
  if (robot.model.has_fixed_base()) return mass;
  const solver::BaseAnalysis base = solver::analyse_base(robot.model, solver::State(robot.model));
  for (int i = 0; i < 3; ++i) {
    const solver::AxisAnalysis& axis = base.axes[static_cast<std::size_t>(i)];
    if (axis.reachable) mass(i) = axis.effective_mass;
  }
  return mass;
}

double footprint_radius(const lang::Robot& robot) {
  double radius = 0.0;
  for (const solver::Vector3& corner : robot.footprint) radius = std::max(radius, corner.head<2>().norm());
  return radius > 0.0 ? radius : radius_without_footprint;
}

int base_frame(std::vector<lang::FrameDeclaration>& frames, const lang::Robot& robot) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (is_base(frames, static_cast<int>(i))) return static_cast<int>(i);
  }
  lang::FrameDeclaration base;
  base.name = robot.base_frame;
  base.parent = lang::FrameParent::body;
  base.parent_index = 0;
  frames.push_back(base);
  return static_cast<int>(frames.size()) - 1;
}

namespace {

lang::Group group_on_base(const char* name, int base) {
  lang::Group group;
  group.name = name;
  group.move = group.in = base;
  return group;
}

/// The stop's deceleration as ranges that win against every other range of level 0.
lang::Group deceleration_of(const lang::Group& brake) {
  lang::Group group = group_on_base("stop", brake.move);
  for (const AxisStatements& braked : brake.axes) {
    AxisStatements& a = axis_of(group, braked.axis, {});
    a.acceleration = braked.acceleration;
  }
  return group;
}

/// The robot file's limits but for its accelerations: those of an end are the stop's.
lang::Group limits_at_end(const lang::Robot& robot, int base) {
  lang::Group group = group_on_base("limits", base);
  for (const lang::BaseLimit& limit : robot.limits) {
    if (limit.quantity != Quantity::acceleration) limit_axis(group, limit);
  }
  return group;
}

lang::Group brake_of(const lang::Robot& robot, int base) {
  lang::Group group = group_on_base("stop", base);
  const double radius = footprint_radius(robot);
  for (const Axis axis : {Axis::x, Axis::y, Axis::rz}) {
    const bool turns = is_rotation(axis);
    AxisStatements a;
    a.name = group.name + "." + word(axis);
    a.axis = axis;
    a.driver = Quantity::velocity;
    a.time_constant.constant = brake_time_constant;
    a.force = plus_minus(turns ? robot.stop.force * radius : robot.stop.force);
    a.acceleration = plus_minus(turns ? robot.stop.deceleration / radius : robot.stop.deceleration);
    group.axes.push_back(a);
  }
  return group;
}

}  // namespace

lang::Task brake_task(const char* name, const lang::Robot& robot, int base) {
  lang::Task task;
  task.name = name;
  task.blend.constant = brake_blend;
  if (robot.model.has_fixed_base()) return task;
  task.groups = {brake_of(robot, base)};
  task.groups.push_back(deceleration_of(task.groups.front()));
  const lang::Group limits = limits_at_end(robot, base);
  if (!limits.axes.empty()) task.groups.push_back(limits);
  return task;
}

void add_limits(lang::Task& task, const lang::Always& always, const lang::Robot& robot, int base,
                const std::vector<lang::FrameDeclaration>& frames) {
  if (robot.model.has_fixed_base()) return;
  lang::Group group = group_on_base("limits", base);
  const int driven = std::min(first_driven_level(task.groups), first_driven_level(always.groups));
  for (const lang::BaseLimit& limit : robot.limits) {
    if (!gives(task.groups, limit, frames, driven) && !gives(always.groups, limit, frames, driven))
      limit_axis(group, limit);
  }
  if (!group.axes.empty()) task.groups.push_back(group);
}

}  // namespace zwang::runtime
