#include "physics/kept_heading.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::lang {

namespace {

/// Whether a row keeps the base's heading as it is at the start.
bool keeps_heading(const PlannedTask& plan, const Probe& probe) {
  return std::any_of(plan.axes.begin(), plan.axes.end(), [&](const PlannedAxis& axis) {
    if (!axis.turns() || axis.is_feature() || axis.move.body != 0 || axis.is_soft || axis.is_spring)
      return false;
    if (axis.stands_still()) return true;
    const bool is_place = axis.driver == solver::Quantity::position && axis.is_placed && !axis.is_set;
    return is_place && (!axis.target || std::abs(*axis.target - probe.position_at_start(axis)) < 1e-3);
  });
}

}  // namespace

int aligned_at_start(const PlannedTask& plan, const PlannedAxis& axis, const PlannedAxis& other,
                     const Probe& probe) {
  const auto is_asked = [](const PlannedAxis& one) {
    return one.move.body == 0 && !one.turns() && !one.is_feature();
  };
  if (!is_asked(axis) || !is_asked(other) || !keeps_heading(plan, probe)) return 0;
  const double cosine = probe.direction(axis).dot(probe.direction(other));
  return cosine > 1.0 - 1e-9 ? 1 : cosine < -1.0 + 1e-9 ? -1 : 0;
}

}  // namespace zwang::lang
