// E621, W621: a base that is to be turned square by what it presses on, and that no wall turns.
//
//   held      the wheels hold the heading as they are steered, and nothing turns the steering
//   scrubbed  mu g sum m_i |x_i - x| > F b
//   askew     the outline rests on another edge than the one ahead, or stays as it came: resting.cpp
//
// The right side is the moment of the wall: the push F at a corner of the footprint, b beside the line of the
// push. The left side holds against it. It is the friction of wheels that slide sideways, each with its share
// m_i of the mass, at x_i. x is the middle of all wheels. E621: an exit asks for the rest of the heading. A
// base that is stuck rests, too. W621: the heading is free, and no exit asks for it.
//
// A heading that a row keeps still within a force range is turned, too, once the wall is stronger than both.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_square.hpp"
#include "physics/push.hpp"
#include "physics/questions.hpp"
#include "physics/resting.hpp"

namespace zwang::lang {

namespace {

using solver::Quantity;

/// The moment [N m] of the floor's friction on a base whose wheels slide sideways when it turns. 0: no wheel
/// slides.
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

/// The moment [N m] above which a row that keeps the axis still gives way. nullopt: it never gives way.
std::optional<double> holds_back(const PlannedAxis& axis) {
  const auto& range = axis[Quantity::force];
  if (!axis.stands_still() || !range || axis.text == nullptr) return std::nullopt;
  return std::max(range->high, -range->low);
}

void ask_heading(const PlannedTask& plan, const PlannedAxis& axis, double own,
                 const std::vector<int>& held_steerings, const std::optional<Scene>& scene, bool is_start,
                 Probe& probe, Remarks& remarks) {
  const bool is_heading = axis.move.body == 0 && axis.is_placed && !axis.is_feature() && axis.turns() &&
                          !probe.is_out_of_plane(axis);
  const Push push = is_heading ? push_of(plan, probe) : Push{};
  const AxisFigures* figures = push.axis != nullptr ? probe.figures(axis) : nullptr;
  if (figures == nullptr) return;
  const bool is_held = std::isinf(figures->mass) && (figures->is_held || !held_steerings.empty());
  const double wall = push.force * longest_lever(push, probe);
  const double floor = scrub(probe.robot(), scene.value_or(Scene{}).floor_friction) + own;
  const std::optional<Span> exit = asked_by(*plan.task, axis);
  if (!is_held && floor <= wall) {
    if (exit)
      ask_rest(axis, {push, floor, is_start ? wall_ahead(scene, push, probe) : std::nullopt}, *exit, probe,
               remarks);
    return;
  }
  if ((is_held || own > 0.0) && !exit) return;  // W609, or a row that is meant to hold
  remarks.add(wording::cannot_square(axis.text->name.span, axis.path, is_held ? 0.0 : floor, wall,
                                     exit.value_or(Span{})));
}

}  // namespace

void ask_square(const PlannedTask& plan, const std::vector<int>& held_steerings,
                const std::optional<Scene>& scene, bool is_start, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.free)
    ask_heading(plan, axis, 0.0, held_steerings, scene, is_start, probe, remarks);
  for (const PlannedAxis& axis : plan.axes) {
    if (const std::optional<double> own = holds_back(axis))
      ask_heading(plan, axis, *own, held_steerings, scene, is_start, probe, remarks);
  }
}

}  // namespace zwang::lang
