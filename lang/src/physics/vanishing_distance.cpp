// W613: a distance that is to become less than it can be while it has a direction.
//
//   s^2 = d^2 + h^2      d in the plane, h between the heights of two points that keep them
//   ds  = d/s v          v along d; across it v^2/d is needed to stay at s
//
// So at d = 0 the distance has no direction, and below s = h it does not exist. A base that is drawn to there
// circles about the point, or swings across it, and does not come to rest.
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

/// In the plane: a mecanum base holds 0.1 mm and circles at 0.01 mm, with a control period of 1 ms. [m]
constexpr double least_in_plane = 5e-5;

/// The distance that is to be reached, and its place in the file.
struct AskedDistance {
  double most;  ///< [m]
  Span span;
};

std::optional<AskedDistance> asked_of(const PlannedAxis& axis) {
  const bool drives = axis.driver == solver::Quantity::position;
  if (drives && axis.target) return AskedDistance{*axis.target, axis.driver_span()};
  const auto& range = axis[solver::Quantity::position];
  if (!drives && range) return AskedDistance{range->high, axis.span(solver::Quantity::position)};
  return std::nullopt;
}

}  // namespace

void ask_distance(const PlannedTask& plan, const Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    if (axis.measure != solver::Measure::distance || axis.text == nullptr || axis.is_spring) continue;
    const std::optional<AskedDistance> asked = asked_of(axis);
    if (!asked || asked->most < 0.0) continue;  // E413
    const double height = probe.kept_height(axis);
    if (asked->most >= std::hypot(height, least_in_plane)) continue;
    remarks.add(wording::vanishing_distance(asked->span, axis.path, asked->most, height));
  }
}

}  // namespace zwang::lang
