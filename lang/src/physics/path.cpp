// W615: a fillet of radius r at v needs v^2/r towards its centre. Where `plane` allows less, the base leaves
// the path, or slows down. A push of m v^2/r takes it around. A force of `plane` bounds that push. On driven
// casters the swivels that turn into the fillet weigh, too: M v^2/r for a moment. It counts where the base
// comes off the path by more than 1 mm while they turn (swivel_lag.hpp).
//
// N622: on a base of two freedoms x and y of a point ahead of the axle take both. The heading r against a
// straight path is left over. With the point l ahead, dr/dx = -sin(r)/l, so r decays with exp(-x/l).
#include <cmath>

#include "diagnostic/wordings_paths.hpp"
#include "physics/questions.hpp"
#include "physics/swivel_lag.hpp"

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

constexpr double exact = 1e-3;  // [m] a path without the norm is as exact on every base that ships

/// What the base weighs across its way; nullopt where its wheels hold it.
std::optional<Rounding> rounding_of(double speed, double radius, double most_push, Probe& probe) {
  PlannedAxis base;
  base.move = base.in = {0, {}, {}};
  base.axis = Axis::y;
  const AxisFigures* figures = probe.figures(base);
  if (figures == nullptr || !std::isfinite(figures->most_mass)) return std::nullopt;
  return Rounding{
      speed,    radius, figures->least_mass, figures->most_mass, trail_of_swivels(probe.robot().model),
      most_push};
}

/// Along all of the fillet, not just while casters swivel.
bool is_off_for_good(const Rounding& r) {
  const double mass = r.trail > 0.0 ? r.least_mass : r.most_mass;
  return mass * r.speed * r.speed / r.radius > r.most_push * rounding;
}

/// Off by more than is exact, or for good.
bool leaves(const Rounding& r) {
  const double a = r.speed * r.speed / r.radius;
  return is_off_for_good(r) || (r.most_mass * a > r.most_push && off_the_path(r) > exact);
}

/// The value between both at which the base just does not leave the path. `bad` leaves it, `good` does not.
template <typename Set>
double just_stays(const Rounding& r, double bad, double good, const Set& set) {
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (bad + good);
    Rounding tried = r;
    set(tried, middle);
    (leaves(tried) ? bad : good) = middle;
  }
  return good;
}

void ask_push(const PlannedAxis& axis, const Path& path, double speed, const PlannedNorm& norm, Probe& probe,
              Remarks& remarks) {
  const std::optional<Rounding> r = rounding_of(speed, path.least_radius(), norm.most, probe);
  if (!r || !leaves(*r)) return;
  const double needed = r->most_mass * speed * speed;
  const double slow = just_stays(*r, speed, std::sqrt(norm.most * r->radius / r->most_mass),
                                 [](Rounding& tried, double value) { tried.speed = value; });
  const double wide = just_stays(*r, r->radius, needed / norm.most,
                                 [](Rounding& tried, double value) { tried.radius = value; });
  const double strong = just_stays(*r, norm.most, needed / r->radius,
                                   [](Rounding& tried, double value) { tried.most_push = value; });
  remarks.add(wording::fillet_beyond_push(
      axis.driver_span(), {path.name, r->radius, speed, norm.path, norm.most},
      {r->most_mass, is_off_for_good(*r) ? 0.0 : off_the_path(*r), slow, wide, strong}, norm.span,
      path.span));
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
      ask_push(axis, *path, speed, norm, probe, remarks);
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
