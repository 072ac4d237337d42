// W614: an axis of the world that a base of two freedoms is to stand still along, beside another that it is
// to move or press along. A point on its axle goes only where the base heads,
//
//   v_y = v sin psi,  so that  v_y = 0  asks for  v = 0
//
// as soon as the base is askew by psi, however little. The row then takes as much force as it needs to hold
// all motion. So it holds the other axis, too, and the push of its force driver.
#include <algorithm>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

bool shifts_the_base(const PlannedAxis& axis) {
  return axis.driver && axis.text != nullptr && axis.is_placed && !axis.is_soft && axis.move.body == 0 &&
         !axis.is_feature() && !axis.turns();
}

bool is_held_up(const PlannedAxis& axis, const PlannedAxis& still, Probe& probe) {
  return shifts_the_base(axis) && !axis.stands_still() && still.level <= axis.level &&
         probe.kinematic_rank({&axis, &still}) == 2 && probe.rank({&axis, &still}) == 1;
}

}  // namespace

void ask_askew(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  if (probe.base_mobility() != 2) return;
  for (const PlannedAxis& still : plan.axes) {
    if (!shifts_the_base(still) || !still.stands_still() || !still.in_world) continue;
    const auto other = std::find_if(plan.axes.begin(), plan.axes.end(),
                                    [&](const PlannedAxis& axis) { return is_held_up(axis, still, probe); });
    if (other == plan.axes.end()) continue;
    const std::string own_axis = "`{move: " + still.move_name + ", in: " + probe.robot().base_frame + ", " +
                                 still.text->name.text + ": {velocity: 0 m/s}}`";
    remarks.add(wording::holds_all_askew(still.driver_span(), still.path, still.in_name, own_axis,
                                         std::min(other->level + 1, 9), other->path, other->driver_span()));
  }
}

}  // namespace zwang::lang
