// Step 8 of the tick: the constraints of the active task, of `always`, and of the tasks before while a switch
// blends.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "schedule/braking.hpp"
#include "schedule/parts.hpp"

namespace zwang::runtime {

namespace {

using lang::AxisStatements;
using solver::Axis;
using solver::Quantity;
using solver::Range;

bool is_rotation(Axis axis) {
  return axis >= Axis::rx;
}

bool says_something(const AxisStatements& axis) {
  return axis.driver || axis.position || axis.velocity || axis.acceleration || axis.force;
}

constexpr double least_braking = 1e-3;  // [m/s^2] or [rad/s^2]
// Nearer than what can brake in time by this much speed, a pair of features is near.
constexpr double near_speed = 0.3;    // [m/s]
constexpr double lost_speed = 0.001;  // [m/s] inside a region whose place is unknown

}  // namespace

const solver::AttachedFrame& Scheduler::Parts::axes_frame(const lang::Group& group,
                                                          const ActiveAxis* a) const noexcept {
  if (a != nullptr && a->entry_axes) return *a->entry_axes;
  return frames.attached(group.in);
}

Range Scheduler::Parts::value(const lang::ValueRange& range) const noexcept {
  return {range.low.evaluate(parameters), range.high.evaluate(parameters)};
}

/// The braking that the acceleration and force ranges in force leave along the base's x, y and rz.
void Scheduler::Parts::find_braking() noexcept {
  braking.setConstant(solver::infinity);
  const auto tighten = [&](int i, double most) { braking(i) = std::min(braking(i), most); };
  const auto tighten_by = [&](const AxisStatements& says, int i, double share) {
    if (says.acceleration) {
      const Range range = value(*says.acceleration);
      tighten(i, share * (says.is_planar ? range.high : std::min(-range.low, range.high)));
    }
    if (says.force && !says.driver) {
      const Range range = value(*says.force);
      tighten(i,
              share * (says.is_planar ? range.high : std::min(-range.low, range.high)) / effective_mass(i));
    }
  };
  // The box inside a norm: what brakes along both axes at once stays below it.
  constexpr double share_of_norm = PlaneNorm::apothem / std::numbers::sqrt2;
  for (const ActiveAxis& a : axes) {
    if (a.brakes == both_axes) {
      for (const int i : {0, 1}) tighten_by(*a.says, i, share_of_norm);
    } else if (a.brakes >= 0) {
      tighten_by(*a.says, a.brakes, 1.0);
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(braking(i))) braking(i) = i < 2 ? stop.deceleration : stop.deceleration / radius;
    braking(i) = std::max(braking(i), least_braking);
  }
}

/// a_brk along a direction in the world: straight along it, without leaving either range.
double Scheduler::Parts::braking_along(const solver::Vector3& direction) const noexcept {
  const solver::Vector3 n = state->base_pose.rotation.transpose() * direction;
  double most = solver::infinity;
  for (int i = 0; i < 2; ++i) {
    if (std::abs(n(i)) > 1e-9) most = std::min(most, braking(i) / std::abs(n(i)));
  }
  return std::isfinite(most) ? most : braking.head<2>().minCoeff();
}

/// a_brk of a position range: the limit of the axis's own acceleration range, else of those in force on the
/// base. It is never more than the force range can do to the robot's mass.
double Scheduler::Parts::braking_of(const solver::AxisConstraint& c, const AxisStatements& s) const noexcept {
  const bool turns = is_rotation(s.axis);
  double most = turns ? braking(2) : braking.head<2>().minCoeff();
  if (!turns && c.measure == solver::Measure::axis) {
    const solver::Matrix3 R = frames.motions().of(c.in).pose.rotation;
    most = braking_along(R.col(static_cast<int>(s.axis)));
  }
  if (c.acceleration) most = std::min(-c.acceleration->low, c.acceleration->high);
  if (s.force) {
    const Range force = value(*s.force);
    const double mass = turns ? effective_mass(2) : effective_mass.head<2>().maxCoeff();
    most = std::min({most, -force.low / mass, force.high / mass});
  }
  return std::max(most, least_braking);
}

/// An entry of `wanted` that says nothing yet: one more, or in the place of one that was listed before.
Wanted& Scheduler::Parts::new_wanted(std::size_t index) noexcept {
  return index < wanted.size() ? wanted[index] = {} : wanted.emplace_back();
}

/// The constant part of the axis's constraint until the next switch.
void Scheduler::Parts::list_axis(const ActiveAxis& a) noexcept {
  const lang::Group& g = *a.group;
  Wanted& w = new_wanted(a.wanted);
  w.origin = a.origin;
  w.always = a.origin.task == tasks.always();
  w.measured = a.says->target.signal >= 0;
  w.lost = a.lost;
  w.move = {g.move, frames.settings_of(g.move)};
  w.in = a.entry_axes ? FrameKey{} : FrameKey{g.in, frames.settings_of(g.in)};
  w.constraint = measured(g, *a.says, &a);
  w.constraint.level = a.says->level;
}

/// The present values of the axis's constraint.
void Scheduler::Parts::want_axis(ActiveAxis& a) noexcept {
  const AxisStatements& s = *a.says;
  const lang::Group& g = *a.group;
  solver::AxisConstraint& c = wanted[a.wanted].constraint;
  if (a.hangs_on_signal) {
    c.move = frames.attached(g.move);
    c.in = axes_frame(g, &a);
  }
  if (a.is_along_path) measure_along(g, c);
  if (s.weight) c.weight = s.weight->evaluate(parameters);
  if (a.plane >= 0) want_plane(a);
  if (s.is_planar) {
    if (s.velocity) want_motion_ranges(a, c);
    return;
  }
  if (s.acceleration) c.acceleration = with_what_pushes(value(*s.acceleration), a.brakes);
  c.driver.reset();
  if (s.driver && !is_left_to_the_end(a)) c.driver = driver_of(a);
  if (s.force && !s.driver) c.force = value(*s.force);
  if (s.position || s.velocity) want_motion_ranges(a, c);
  if (is_at_end()) only_hold_back(c);
}

void Scheduler::Parts::want_motion_ranges(const ActiveAxis& a, solver::AxisConstraint& c) const noexcept {
  const AxisStatements& s = *a.says;
  const lang::Group& g = *a.group;
  // In axes that are unknown, a range of places or of speeds allows no motion.
  const bool blind = !is_known(g.in) || !is_known(g.move) || is_off_path(g);
  const bool stands_by_driver = c.driver && !c.driver->makes_force();
  c.position.reset();
  c.velocity.reset();
  if (s.position && !blind) c.position = value(*s.position);
  if (s.velocity && !blind) c.velocity = value(*s.velocity);
  if (blind && !stands_by_driver) c.velocity = Range{0.0, 0.0};
  if (!c.position) return;
  c.braking = braking_of(c, s);
  c.return_speed = s.return_speed.evaluate(parameters);
}

/// Places for the pairs of features that are in force at once: the k-th of these, by their order, has the
/// k-th place.
void Scheduler::Parts::list_fence(const ActiveAxis& a) noexcept {
  const auto fence = static_cast<std::size_t>(a.fence);
  const std::size_t most = RegionFence::most_near;
  for (std::size_t k = 0; k < std::min(most, fences[fence].pair_count()); ++k) {
    const std::size_t index = a.wanted + k;
    Wanted& w = index < wanted.size() ? wanted[index] : wanted.emplace_back();
    w.origin = a.origin;
    w.always = a.origin.task == tasks.always();
    w.fence = true;
    w.lost = a.lost;
    w.far = true;
  }
  in_reach[fence] = {};
}

void Scheduler::Parts::want_fence(const ActiveAxis& a, RegionFence& fence) noexcept {
  if (a.lost) {
    keep_in_reach(a, {.count = 1});
    want_standstill(a);
    renewed.push_back(static_cast<int>(a.wanted));
  } else {
    put_in_reach(a, fence, find_nearest(a, fence));
  }
}

/// The constraint inside a region whose place is unknown: that of the first pair.
void Scheduler::Parts::want_standstill(const ActiveAxis& a) noexcept {
  const lang::Group& g = *a.group;
  solver::AxisConstraint& c = wanted[a.wanted].constraint = {};
  c.move = frames.attached(g.move);
  c.in = frames.attached(g.in);
  c.measure = solver::Measure::speed;
  c.velocity = Range{0.0, lost_speed};
  c.level = g.level;
}

/// The nearest of the pairs of features that the braking in force now could not keep apart much faster.
InReach Scheduler::Parts::find_nearest(const ActiveAxis& a, RegionFence& fence) noexcept {
  const lang::Group& g = *a.group;
  solver::FrameMotion move_place, in_place;
  fence.update(frames.motions().of(frames.attached(g.move), move_place),
               frames.motions().of(frames.attached(g.in), in_place), g.margin.evaluate(parameters));
  const auto is_far = [this](const RegionFence::Approach& approach, double a_brk) {
    const double allowed = solver::braking_speed(approach.left, a_brk, horizon);
    return !(allowed < approach.speed + near_speed);
  };
  const Eigen::Vector2d box = braking.head<2>();
  const solver::Matrix3 to_base = state->base_pose.rotation.transpose();
  const double turning = state->base_twist.angular.z();
  // From there even the fastest could brake in time, with the weakest brake: most pairs are done by that.
  const auto out_of_reach = [&](double brake) {
    return solver::braking_distance(fence.fastest() + near_speed, brake, horizon);
  };
  const double edge_brake = fence.weakest_braking(box), vertex_brake = RegionFence::least_alone(box);
  fence.find_facing(out_of_reach(edge_brake), out_of_reach(vertex_brake));
  InReach nearest;
  for (const std::size_t i : fence.facing()) {
    const RegionFence::Approach& approach = fence.approach(i);
    if (is_far(approach, fence.is_braked_for_alone(i) ? vertex_brake : edge_brake)) continue;
    const double a_brk = std::max(fence.braking(i, to_base, box, turning), least_braking);
    if (is_far(approach, a_brk)) continue;
    // Sorted by what is left; the farthest gives way.
    std::size_t at = nearest.count;
    while (at > 0 && nearest.pairs[at - 1].left > approach.left) --at;
    if (nearest.count < nearest.pairs.size()) ++nearest.count;
    for (std::size_t j = nearest.count; j-- > at + 1;) nearest.pairs[j] = nearest.pairs[j - 1];
    if (at < nearest.count) nearest.pairs[at] = {i, approach.left, a_brk};
  }
  return nearest;
}

/// These pairs have the places, in their order, and no others. True where the places had other ones.
bool Scheduler::Parts::keep_in_reach(const ActiveAxis& a, const InReach& nearest) noexcept {
  InReach& last = in_reach[static_cast<std::size_t>(a.fence)];
  bool is_other = last.count != nearest.count;
  for (std::size_t k = 0; k < nearest.count && !is_other; ++k)
    is_other = last.pairs[k].index != nearest.pairs[k].index;
  last = nearest;
  if (!is_other) return false;
  const std::size_t most = RegionFence::most_near;
  const std::size_t places = std::min(most, fences[static_cast<std::size_t>(a.fence)].pair_count());
  for (std::size_t k = 0; k < places; ++k) {
    Wanted& w = wanted[a.wanted + k];
    w.far = k >= nearest.count;
    w.origin.part = w.far ? -1 : static_cast<int>(nearest.pairs[k].index);
  }
  reach_changed = true;
  return true;
}

/// Of a pair that has its place already, mostly nothing but its braking is new: a distance is measured at the
/// corner's height.
void Scheduler::Parts::put_in_reach(const ActiveAxis& a, const RegionFence& fence, InReach nearest) noexcept {
  const lang::Group& g = *a.group;
  std::ranges::sort(nearest.pairs.begin(), nearest.pairs.begin() + static_cast<std::ptrdiff_t>(nearest.count),
                    {}, &InReach::Pair::index);
  const bool is_other = keep_in_reach(a, nearest);
  for (std::size_t k = 0; k < nearest.count; ++k) {
    solver::AxisConstraint& c = wanted[a.wanted + k].constraint;
    const bool is_new =
        is_other || values_are_due || a.hangs_on_signal || c.measure == solver::Measure::distance;
    if (is_new) {
      c = fence.constraint(nearest.pairs[k].index, frames.attached(g.move), frames.attached(g.in));
      c.return_speed = g.return_speed.evaluate(parameters);
    }
    if (is_new || c.braking != nearest.pairs[k].braking) renewed.push_back(static_cast<int>(a.wanted + k));
    c.level = g.level;
    c.braking = nearest.pairs[k].braking;
  }
}

/// The constraints of `always` and of the active task. As many, and in the same order, until the next switch.
/// The constraints of `always` keep their places.
void Scheduler::Parts::list_wanted() noexcept {
  wanted.resize(always_wanted);
  values_are_due = true;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    ActiveAxis& a = axes[i];
    const bool is_listed = i < always_axes && always_wanted > 0;
    if (!is_listed) a.wanted = wanted.size();
    if (a.fence >= 0) {
      list_fence(a);
    } else if (says_something(*a.says)) {
      list_axis(a);
      if (a.plane >= 0) list_plane(a);
    }
    if (!is_listed && i + 1 == always_axes) always_wanted = wanted.size();
  }
}

/// Their present values, as parameters, signals and distances have them: of those that have other ones than
/// before.
void Scheduler::Parts::want() noexcept {
  renewed.clear();
  if (values_are_due) find_braking();
  const bool is_pushed = find_pushes();
  for (ActiveAxis& a : axes) {
    if (a.fence >= 0) {
      want_fence(a, fences[static_cast<std::size_t>(a.fence)]);
      continue;
    }
    const bool varies = a.varies || (is_pushed && a.brakes >= 0 && a.says->acceleration);
    if ((values_are_due || varies) && says_something(*a.says)) {
      want_axis(a);
      const int count = 1 + (a.plane < 0 ? 0 : planes[static_cast<std::size_t>(a.plane)].count());
      for (int i = 0; i < count; ++i) renewed.push_back(static_cast<int>(a.wanted) + i);
    }
  }
  values_are_due = false;
  lead_back();
}

bool Scheduler::Parts::is_lost(const ActiveAxis& a) const noexcept {
  const lang::Group& g = *a.group;
  const int value_signal = a.says->target.signal;
  if (!is_known(g.in) || !is_known(g.move) || is_off_path(g)) return true;
  if (a.says->yield) return std::isnan(pushed_with(a));
  return value_signal >= 0 && !signals.known(value_signal);
}

void Scheduler::Parts::start_blend() noexcept {
  for (ActiveAxis& a : axes) a.lost = is_lost(a);
  list_wanted();
  want();
  switched = now;
  blend_time = active().blend.evaluate(parameters);
  blend->start(wanted, blend_time);
}

/// A signal that is lost or found changes what drives an axis. That is a switch like any other.
void Scheduler::Parts::track_losses() noexcept {
  bool changed = false;
  for (ActiveAxis& a : axes) {
    if (!a.hangs_on_signal && !a.is_along_path) continue;
    const bool lost = is_lost(a);
    changed = changed || lost != a.lost;
    if (!lost) capture_here(a);
  }
  if (changed) start_blend();
}

void Scheduler::Parts::put_constraints() noexcept {
  want();
  put();
}

void Scheduler::Parts::put() noexcept {
  const bool is_same_list = !std::exchange(reach_changed, false);
  const bool is_blending = blend->sets().size() > 1;
  if (is_blending && is_at_end()) keep_energy_from_rising();
  // The tick of the switch already goes one tick's way, so that no share is ever 0.
  double progress = blend_time > 0.0 ? (now - switched + period) / blend_time : 1.0;
  if ((1.0 - progress) * blend_time < clock_rounding * period) progress = 1.0;
  if (is_same_list && blend->stays_put(progress)) {
    blend->renew(wanted, renewed, progress);
    for (std::size_t i = 0; i < blend->sets().size(); ++i) row_sets[i].share = blend->sets()[i].share;
    return;
  }
  blend->put(wanted, progress);
  sources.clear();
  for (std::size_t i = 0; i < blend->sets().size(); ++i) {
    const BlendedSet& set = blend->sets()[i];
    for (const InForce& f : set.in_force) sources.push_back(f.active ? find(f.origin) : nullptr);
    row_sets[i] = {&set.constraints.rows(), set.share};
  }
}

}  // namespace zwang::runtime
