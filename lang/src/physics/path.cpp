// W615: a fillet of radius r at v needs v^2/r towards its centre. Where `plane` allows less, the base leaves
// the path, or slows down. A push of M v^2/r takes it around. M is the most that the base weighs across its
// way: on driven casters the swivels count that turn into the fillet. A force of `plane` bounds that push.
//
// N622: on a base of two freedoms x and y of a point ahead of the axle take both. The heading r against a
// straight path is left over. With the point l ahead, dr/dx = -sin(r)/l, so r decays with exp(-x/l).
#include <cmath>

#include "diagnostic/wordings_paths.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

using solver::Axis;
using solver::Quantity;

constexpr double rounding = 1.0 + 1e-9;

/// [m/s] that is driven along the path; of a position what its range allows.
double driven_along(const PlannedTask& plan, const PlannedAxis& axis) {
  if (axis.driver == Quantity::velocity) return std::abs(axis.target.value_or(0.0));
  const double most = axis.driver == Quantity::position ? plan.speed_limit(axis) : 0.0;
  return std::isfinite(most) ? most : 0.0;
}

bool drives_along_axis(const PlannedAxis& axis, Axis which) {
  return axis.is_on_path && axis.axis == which && axis.drives_motion();
}

/// Another row of the group drives `which` at a level above.
bool is_taken_above(const PlannedTask& plan, const PlannedAxis& axis, Axis which) {
  for (const PlannedAxis& other : plan.axes) {
    const bool is_beside = other.group == axis.group && other.in_name == axis.in_name;
    if (is_beside && drives_along_axis(other, which) && other.level < axis.level) return true;
  }
  return false;
}

}  // namespace

const Path* path_of(const CheckContext& context, const PlannedAxis& axis) {
  const std::optional<int> frame = axis.is_on_path ? context.symbols.find_frame(axis.in_name) : std::nullopt;
  const int path = frame ? context.symbols.frames[static_cast<std::size_t>(*frame)].path : -1;
  return path < 0 ? nullptr : &context.file.paths[static_cast<std::size_t>(path)];
}

namespace {

/// The most that the base weighs in the plane; infinite where its wheels hold it. [kg]
double most_mass_across(Probe& probe) {
  PlannedAxis base;
  base.move = base.in = {0, {}, {}};
  base.axis = Axis::y;
  const AxisFigures* figures = probe.figures(base);
  return figures == nullptr ? solver::infinity : figures->most_mass;
}

}  // namespace

void ask_path(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    const Path* path = axis.axis == Axis::x && axis.driver ? path_of(context, axis) : nullptr;
    const double radius = path == nullptr ? solver::infinity : path->least_radius();
    const double speed = std::isfinite(radius) ? driven_along(plan, axis) : 0.0;
    for (const PlannedNorm& norm : plan.norms) {
      const bool is_beyond = speed * speed / radius > norm.most * rounding;
      if (norm.move.body != axis.move.body || !(norm.most > 0.0) || !is_beyond) continue;
      remarks.add(wording::fillet_beyond_norm(
          axis.driver_span(), {path->name, radius, speed, norm.path, norm.most}, norm.span, path->span));
    }
    for (const PlannedNorm& norm : plan.force_norms) {
      if (norm.move.body != axis.move.body || axis.move.body != 0 || !(norm.most > 0.0) || speed == 0.0)
        continue;
      const double mass = most_mass_across(probe);
      if (!std::isfinite(mass) || mass * speed * speed / radius <= norm.most * rounding) continue;
      remarks.add(wording::fillet_beyond_push(axis.driver_span(),
                                              {path->name, radius, speed, norm.path, norm.most}, mass,
                                              norm.span, path->span));
    }
  }
}

void ask_heading(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  if (probe.base_mobility() != 2) return;
  for (const PlannedAxis& axis : plan.axes) {
    const bool is_heading =
        drives_along_axis(axis, Axis::rz) && axis.move.body == 0 && path_of(context, axis) != nullptr;
    if (!is_heading || !is_taken_above(plan, axis, Axis::x) || !is_taken_above(plan, axis, Axis::y)) continue;
    remarks.add(wording::heading_left_over(axis.driver_span(), axis.path, axis.move_name,
                                           std::max(0.0, axis.move.pose.position.x())));
  }
}

}  // namespace zwang::lang
