// W643: motion that the wheels hold as they are steered at the start, where nothing turns the steering.
//
//   rank [ground; rows at rest; axis] = rank [ground; rows at rest]      at the start pose
//
// A joint with a motor that no driver moves is held where it is. So no driver of the base's own axes steers:
// the axis stays held. `rows at rest` are those of the task that keep an own axis of the base still.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_never.hpp"
#include "physics/questions.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::lang {

namespace {

bool hangs_on(const solver::Model& model, int joint_body, int body) {
  while (body > joint_body) body = model.bodies()[static_cast<std::size_t>(body)].parent;
  return body == joint_body;
}

/// Motion between two bodies is that of the joints between them.
bool turns(const PlannedAxis& axis, int joint_body, const solver::Model& model) {
  if (!axis.driver) return false;
  const bool moves_it = hangs_on(model, joint_body, axis.move.body);
  return axis.move.body == axis.in.body ? moves_it : moves_it != hangs_on(model, joint_body, axis.in.body);
}

bool is_own_rest(const PlannedAxis& axis, int level) {
  return axis.stands_still() && !axis.is_soft && axis.move.body == 0 && axis.in.body == 0 &&
         axis.level <= level;
}

/// A position that the axis has at the start already asks for nothing, unless its path turns away from there.
bool asks_for_motion(const CheckContext& context, const PlannedAxis& axis, Probe& probe) {
  const bool is_asked = axis.driver && axis.text != nullptr && !axis.is_soft && axis.move.body == 0 &&
                        axis.is_placed && !probe.is_out_of_plane(axis);
  if (!is_asked) return false;
  if (axis.is_yield) return true;
  const Path* path = path_of(context, axis);
  if (path != nullptr && std::isfinite(path->least_radius())) return !axis.stands_still();
  const StatementText& statement = *(*axis.text)[*axis.driver];
  if (statement.value.kind == ValueKind::here) return false;
  if (!axis.target || (axis.driver == solver::Quantity::position && axis.is_set)) return !axis.is_set;
  const double from = axis.driver == solver::Quantity::position ? probe.position_at_start(axis) : 0.0;
  return std::abs(*axis.target - from) > 1e-3;
}

}  // namespace

std::vector<int> held_steerings(const CheckContext& context, const solver::Model& model) {
  std::vector<int> steerings;
  for (int j = 0; j < model.joint_count(); ++j) {
    const bool steers =
        model.joint(j).actuated && !solver::turns_wheel(model, j + 1) && solver::carries_wheel(model, j + 1);
    if (steers) steerings.push_back(j);
  }
  if (steerings.empty()) return steerings;
  for (const TaskText& task : context.file.tasks) {
    const PlannedTask plan = plan_task(context, task);
    std::erase_if(steerings, [&](int joint) {
      return std::any_of(plan.axes.begin(), plan.axes.end(),
                         [&](const PlannedAxis& axis) { return turns(axis, joint + 1, model); });
    });
  }
  return steerings;
}

void ask_steering(const CheckContext& context, const PlannedTask& plan, const std::vector<int>& held,
                  Probe& probe, Remarks& remarks) {
  if (held.empty()) return;
  const solver::Body& steered = probe.robot().model.bodies()[static_cast<std::size_t>(held.front()) + 1];
  for (const PlannedAxis& axis : plan.axes) {
    if (!asks_for_motion(context, axis, probe)) continue;
    std::vector<const PlannedAxis*> rows;
    for (const PlannedAxis& other : plan.axes) {
      if (&other != &axis && is_own_rest(other, axis.level)) rows.push_back(&other);
    }
    const int at_rest = probe.rank_at_start(rows);
    rows.push_back(&axis);
    if (probe.is_exhausted() || probe.rank_at_start(rows) > at_rest) continue;
    remarks.add(wording::steering_stands(axis.driver_span(), axis.path,
                                         probe.robot().model.joint(held.front()).name, steered.name,
                                         probe.robot().base_frame));
  }
}

}  // namespace zwang::lang
