// E621, W621: a base that is to be turned square by what it presses on, and that no wall turns.
//
//   held      the wheels hold the heading as they are steered, and nothing turns the steering
//   scrubbed  mu g sum m_i |x_i - x| > F b
//
// The right side is what a wall turns with: the push F at a corner of the footprint, b beside the line of the
// push. The left side holds against it: wheels that slide sideways, each with its share m_i of the mass, x_i
// ahead of the middle x of them all. E621: an exit asks for the rest of the heading, and a base that is stuck
// rests as well as one that stands square. W621: the heading is free, and no exit asks for it.
//
// A heading that a row keeps still within a force range is turned, too, once the wall is stronger than both.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_never.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

using solver::Quantity;

/// What presses ahead or sideways, and how hard at most. [N]
struct Push {
  const PlannedAxis* axis = nullptr;
  double force = 0.0;
};

Push push_of(const PlannedTask& plan, Probe& probe) {
  Push push;
  for (const PlannedAxis& axis : plan.axes) {
    const bool is_asked = axis.driver && axis.text != nullptr && axis.move.body == 0 && !axis.turns() &&
                          !axis.is_feature() && !axis.stands_still() && axis.is_placed;
    if (!is_asked) continue;
    const auto& range = axis[Quantity::force];
    double force = 0.0;
    if (axis.driver == Quantity::force) {
      force = std::abs(axis.target.value_or(0.0));
    } else if (range) {
      force = std::max(range->high, -range->low);
    } else if (const AxisFigures* figures = probe.figures(axis)) {
      force = figures->force;
    }
    if (force > push.force) push = {&axis, force};
  }
  return push;
}

/// Beside the line of the push through the base's origin, the farthest corner of the footprint. [m]
double lever(const Push& push, Probe& probe) {
  const solver::Vector3 along = probe.direction(*push.axis);
  double most = 0.0;
  for (const solver::Vector3& corner : probe.robot().footprint)
    most = std::max(most, std::abs(along.x() * corner.y() - along.y() * corner.x()));
  return most;
}

/// What the floor holds a base with whose wheels slide sideways when it turns; 0 where none does. [N m]
double scrub(const Robot& robot, double friction) {
  const solver::Model& model = robot.model;
  std::vector<double> ahead;
  for (const solver::Wheel& wheel : model.wheels()) {
    const bool slides = wheel.holds_rolling && !wheel.holds_sideways && !wheel.roller_angle;
    const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
    if (slides && body.parent == 0) ahead.push_back(body.pose_in_parent.position.x());
  }
  if (ahead.empty()) return 0.0;
  double middle = 0.0, arms = 0.0;
  for (const double x : ahead) middle += x / static_cast<double>(ahead.size());
  for (const double x : ahead) arms += std::abs(x - middle) / static_cast<double>(model.wheels().size());
  return friction * model.total_mass() * std::abs(model.gravity().z()) * arms;
}

/// Whether an exit of the task, other than to `failed`, asks how the axis turns.
std::optional<Span> asked_by(const TaskText& task, const PlannedAxis& axis) {
  const std::string path = axis.group + "." + axis.text->name.text;
  for (const ExitText& exit : task.exits) {
    if (exit.target.text == "failed") continue;
    for (const ExpressionText& node : exit.when.nodes) {
      const bool names_it = node.kind == ExpressionKind::name &&
                            (node.word == path + ".velocity" || node.word == path + ".position");
      if (names_it) return node.span;
    }
  }
  return std::nullopt;
}

/// What a row that keeps the axis still gives way to; none where it gives way to nothing. [N m]
std::optional<double> holds_back(const PlannedAxis& axis) {
  const auto& range = axis[Quantity::force];
  if (!axis.stands_still() || !range || axis.text == nullptr) return std::nullopt;
  return std::max(range->high, -range->low);
}

void ask_heading(const PlannedTask& plan, const PlannedAxis& axis, double own,
                 const std::vector<int>& held_steerings, double floor_friction, Probe& probe,
                 Remarks& remarks) {
  const bool is_heading = axis.move.body == 0 && axis.is_placed && !axis.is_feature() && axis.turns() &&
                          !probe.is_out_of_plane(axis);
  const Push push = is_heading ? push_of(plan, probe) : Push{};
  const AxisFigures* figures = push.axis != nullptr ? probe.figures(axis) : nullptr;
  if (figures == nullptr) return;
  const bool is_held = std::isinf(figures->mass) && (figures->is_held || !held_steerings.empty());
  const double wall = push.force * lever(push, probe);
  const double floor = scrub(probe.robot(), floor_friction) + own;
  if (!is_held && floor <= wall) return;
  const std::optional<Span> exit = asked_by(*plan.task, axis);
  if ((is_held || own > 0.0) && !exit) return;  // W609, or a row that is meant to hold
  remarks.add(wording::cannot_square(axis.text->name.span, axis.path, is_held ? 0.0 : floor, wall,
                                     exit.value_or(Span{})));
}

}  // namespace

void ask_square(const PlannedTask& plan, const std::vector<int>& held_steerings, double floor_friction,
                Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.free)
    ask_heading(plan, axis, 0.0, held_steerings, floor_friction, probe, remarks);
  for (const PlannedAxis& axis : plan.axes) {
    if (const std::optional<double> own = holds_back(axis))
      ask_heading(plan, axis, *own, held_steerings, floor_friction, probe, remarks);
  }
}

}  // namespace zwang::lang
