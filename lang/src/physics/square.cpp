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
// A hit at the speed v turns a scrubbed base from the angle of the scene by m v^2 / 2 / (mu g .. - F b) at
// most.
//
// A row that keeps the heading still asks for a speed, and the wall turns the base with w = F b T / I against
// it. An exit at w_0 is true of a base that turns more slowly: below I w_0 / T, and below the row's own
// force.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_square.hpp"
#include "physics/push.hpp"
#include "physics/questions.hpp"
#include "physics/resting.hpp"
#include "zwang/lang/task_draft.hpp"

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

/// [N m] A row keeps the axis still while a wall turns the base. Below this moment an exit takes the axis to
/// rest. nullopt: no such row, or its force has no bound.
std::optional<double> slowed_by(const CheckContext& context, const PlannedTask& plan,
                                const std::vector<Condition>& conditions, const PlannedAxis& axis,
                                Probe& probe) {
  const auto& range = axis[Quantity::force];
  const AxisFigures* figures = probe.figures(axis);
  if (!axis.stands_still() || !range || axis.text == nullptr || figures == nullptr) return std::nullopt;
  double fastest = 0.0;  // [rad/s]
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const bool is_asked = plan.task->exits[i].target.text != "failed" && !conditions[i].nodes.empty();
    if (is_asked) fastest = std::max(fastest, turn_at_rest(context, plan, conditions[i], axis).value_or(0.0));
  }
  const double moment = fastest > 0.0 ? figures->mass * fastest / axis.time_constant : 0.0;
  return std::min(std::max(range->high, -range->low), moment);
}

/// Whether a hit may turn a scrubbed base square.
bool is_struck_square(const PushedToWall& pushed, double wall, const AxisFigures& ahead) {
  if (!pushed.wall) return false;
  const double turned = 0.5 * ahead.mass * pushed.speed * pushed.speed / (pushed.floor - wall);  // [rad]
  return std::abs(pushed.wall->askew) <= turned + round_ahead;
}

/// `row`: below this moment a row makes the base seem to rest.
void ask_heading(const PlannedTask& plan, const PlannedAxis& axis, const std::optional<double>& row,
                 const std::vector<int>& held_steerings, const std::optional<Scene>& scene, bool is_start,
                 Probe& probe, Remarks& remarks) {
  const bool is_heading = axis.move.body == 0 && axis.is_placed && !axis.is_feature() && axis.turns() &&
                          !probe.is_out_of_plane(axis);
  const Push push = is_heading ? push_of(plan, probe) : Push{};
  const AxisFigures* figures = push.axis != nullptr ? probe.figures(axis) : nullptr;
  const AxisFigures* ahead = figures != nullptr ? probe.figures(*push.axis) : nullptr;
  if (ahead == nullptr) return;
  const bool is_held = std::isinf(figures->mass) && (figures->is_held || !held_steerings.empty());
  const double wall = push.force * longest_lever(push, probe);
  const double floor = scrub(probe.robot(), scene.value_or(Scene{}).floor_friction);
  const double speed = std::min(plan.speed_limit(*push.axis), most_speed(plan, {0, {}, {}}, probe).most);
  const PushedToWall pushed{push, floor, row.value_or(0.0), speed,
                            is_start ? wall_ahead(scene, push, probe) : std::nullopt};
  const std::optional<Span> exit = asked_by(*plan.task, axis);
  if (!is_held && floor <= wall) {
    if (exit) ask_rest(axis, pushed, *exit, probe, remarks);
    return;
  }
  if ((is_held || row) && !exit) return;  // W609, or a row that is meant to hold
  const bool is_doubtful = !is_held && is_struck_square(pushed, wall, *ahead);
  remarks.add(wording::cannot_square(axis.text->name.span, axis.path, is_held ? 0.0 : floor, wall,
                                     exit.value_or(Span{}), is_doubtful));
}

}  // namespace

void ask_square(const CheckContext& context, const PlannedTask& plan,
                const std::vector<Condition>& conditions, const std::vector<int>& held_steerings,
                const std::optional<Scene>& scene, bool is_start, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.free)
    ask_heading(plan, axis, std::nullopt, held_steerings, scene, is_start, probe, remarks);
  for (const PlannedAxis& axis : plan.axes) {
    if (const std::optional<double> row = slowed_by(context, plan, conditions, axis, probe))
      ask_heading(plan, axis, row, held_steerings, scene, is_start, probe, remarks);
  }
}

}  // namespace zwang::lang
