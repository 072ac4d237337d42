// Step 8 of the tick: the way back into a range or a region, and the constraints of a task that ends.
//
// Outside of a position range a point of the moved frame comes back along the inward normal n with
// min(v_brk(|d|), v_n). `return` bounds the speed of the frame's origin. Two other motions take from it. One
// is the origin's velocity across n: two edges are left at once, or wheels hold the base to its heading. The
// other is a turn that moves the point outwards. With v the velocity of the origin and v_p that of the point
//
//   v_n = sqrt(v_ret^2 - |v - (n . v) n|^2) + min(0, n . (v_p - v)), but half of v_ret at least.
#include <algorithm>
#include <cmath>

#include "schedule/kinetic_energy.hpp"
#include "schedule/parts.hpp"

namespace zwang::runtime {

namespace {

using solver::Range;
using solver::Vector3;

// Ten times what the braking curve lets a base through that is a third heavier than its model.
constexpr double told_distance = 0.01;  // [m]
// Two edges see each other a tick late, and casters swing: up to 1.1 % of speed, where 1 % is allowed.
constexpr double share_of_return = 0.997;
constexpr double told_angle = 0.0174532925199;  // [rad] 1 deg
// The speed that a base may gain while its last forces fade: half of the speed that counts as rest.
constexpr double gained_speed = 0.005;  // [m/s]

/// So that a base at rest may stay at rest.
void let_rest(std::optional<Range>& velocity) {
  if (velocity) velocity = Range{std::min(velocity->low, 0.0), std::max(velocity->high, 0.0)};
}

/// So that a base may brake both ways.
void let_brake(std::optional<Range>& acceleration) {
  if (!acceleration || (acceleration->low < 0.0 && acceleration->high > 0.0)) return;
  const double most = std::max(-acceleration->low, acceleration->high);
  acceleration = Range{-most, most};
}

/// How far `s` is inside of the range; negative: outside of its upper or of its lower end.
double inside_of(const Range& range, double s) {
  return std::min(range.high - s, s - range.low);
}

}  // namespace

/// Where a row's frame stands outside, the row leads it back; in an end it does not.
void Scheduler::Parts::lead_back() noexcept {
  for (ActiveAxis& a : axes) find_way_back(a);
}

void Scheduler::Parts::lead_back(const ActiveAxis& a, std::size_t index, const WayBack& way) noexcept {
  const double share = way.inwards.isZero() ? 1.0 : share_of_return;  // an angle has no second edge
  const double most = share * std::max(0.0, a.says->return_speed.evaluate(parameters));
  const Vector3 v = frames.motions().of(frames.attached(a.group->move)).linear;
  const Vector3& n = way.inwards;
  const double along = v.dot(n);
  const double across = n.isZero() ? 0.0 : (v - along * n).norm();
  const double ahead = std::sqrt(std::max(0.0, most * most - across * across));
  const double turned_outwards = way.speed ? std::min(0.0, *way.speed - along) : 0.0;
  solver::AxisConstraint& c = wanted[index].constraint;
  const double speed = is_at_end() ? 0.0 : std::max(0.5 * most, ahead + turned_outwards);
  if (c.return_speed == speed) return;
  c.return_speed = speed;
  if (renewed.size() < renewed.capacity()) renewed.push_back(static_cast<int>(index));
}

void Scheduler::Parts::find_way_back(ActiveAxis& a) noexcept {
  const lang::AxisStatements& s = *a.says;
  if (!s.position || a.lost) return;
  if (a.fence >= 0) {
    const auto index = static_cast<std::size_t>(a.fence);
    const RegionFence& fence = fences[index];
    double inside = solver::infinity;
    for (std::size_t k = 0; k < in_reach[index].count; ++k) {
      const std::size_t pair = in_reach[index].pairs[k].index;
      const double margin = fence.approach(pair).left;
      inside = std::min(inside, margin);
      if (margin < 0.0) lead_back(a, a.wanted + k, {fence.normal(pair), -fence.approach(pair).speed});
    }
    return note_excursion(a, -inside);
  }
  const solver::AxisConstraint& c = wanted[a.wanted].constraint;
  if (!c.position) return;
  const double position = position_of(*a.group, s, &a);
  const double inside = inside_of(*c.position, position);
  note_excursion(a, -inside);
  if (inside >= 0.0) return;
  Vector3 along = Vector3::Zero();
  if (c.measure == solver::Measure::axis && s.axis < solver::Axis::rx)
    along = frames.motions().of(c.in).pose.rotation.col(static_cast<int>(s.axis));
  if (c.measure == solver::Measure::distance) {
    along = frames.motions().of(c.move).pose.position;
    along -= frames.motions().of(c.in).pose.position;
    along.normalize();
  }
  const bool is_above = position > c.position->high;
  lead_back(a, a.wanted, {is_above ? Vector3(-along) : along, std::nullopt});
}

void Scheduler::Parts::note_excursion(ActiveAxis& a, double outside) noexcept {
  const bool turns = a.fence < 0 && wanted[a.wanted].constraint.is_angle();
  if (outside <= 0.0) a.is_outside = false;
  if (a.is_outside || outside < (turns ? told_angle : told_distance)) return;
  a.is_outside = true;
  if (!excursion && !is_at_end()) excursion = Excursion{a.origin, outside};
}

/// Nothing of `always` drives in an end: the brake does.
bool Scheduler::Parts::is_left_to_the_end(const ActiveAxis& a) const noexcept {
  return is_at_end() && a.origin.task == tasks.always();
}

/// A range that a base at rest breaks would set it in motion.
void Scheduler::Parts::only_hold_back(solver::AxisConstraint& c) const noexcept {
  let_rest(c.velocity);
  let_brake(c.acceleration);
  c.return_speed = 0.0;
}

/// Leaving constraints fade for as long as the robot gets no faster by it.
void Scheduler::Parts::keep_energy_from_rising() noexcept {
  if (!(blend_time > 0.0)) return;
  const double gained = kinetic_energy(model, *state, frames.motions()) - energy_at_end;
  if (gained > 0.5 * model.total_mass() * gained_speed * gained_speed) blend_time = 0.0;
}

}  // namespace zwang::runtime
