// Steps 8 and 9 of the tick: the sides of a plane's norm, and which of them are in force.
//
// Two of them always are, at right angles: what the solution makes along them tells what it makes along any
// direction n = (c, s). With the accelerations a_x and a_y, the presses S_x and S_y, and W_ij = B_i . B_j
//
//   a_n = c a_x + s a_y        S_n = (c S_x W_xx + s S_y W_yy) / (c^2 W_xx + 2 c s W_xy + s^2 W_yy)
//
// A side that this breaks comes into force, and the rows are solved again. A limit that is not met does not
// change a solution: so it is the one with all sides. But a drive that takes velocities chooses among
// torques: for it all sides are in force.
#include <algorithm>
#include <cmath>

#include "schedule/acceleration_of.hpp"
#include "schedule/parts.hpp"

namespace zwang::runtime {

namespace {

using solver::Range;

bool is_same_frame(const solver::AttachedFrame& one, const solver::AttachedFrame& other) {
  return one.body == other.body && one.pose.rotation == other.pose.rotation &&
         one.pose.position == other.pose.position && one.twist.angular == other.twist.angular &&
         one.twist.linear == other.twist.linear;
}

constexpr double broken = 1.0 + 1e-9;  // of what a side allows
constexpr double near = 0.8;           // the same: comes into force with one that is broken
constexpr double let_go = 0.7;         // the same: goes out of force

/// A bound of the share that any side takes, whatever its direction n. With the least eigenvalue w of W:
///   |a_n| <= |a|        |S_n| <= |(S_x W_xx, S_y W_yy)| / w
double most_share(const solver::AxisConstraint& side, const PlaneReading& r) {
  double share = 0.0;
  if (side.acceleration)
    share = std::sqrt(r.acceleration[0] * r.acceleration[0] + r.acceleration[1] * r.acceleration[1]) /
            side.acceleration->high;
  if (side.force) {
    const double mean = 0.5 * (r.W_xx + r.W_yy), half = 0.5 * (r.W_xx - r.W_yy);
    const double least = mean - std::sqrt(half * half + r.W_xy * r.W_xy);
    const double x = r.press[0] * r.W_xx, y = r.press[1] * r.W_yy;
    if (!(least > 0.0)) return solver::infinity;
    share = std::max(share, std::sqrt(x * x + y * y) / (least * side.force->high));
  }
  return share;
}

/// 0 and 1: the sides that are always in force; -1: another one.
int place_of(const solver::AxisConstraint& c, int part) {
  if (c.measure != solver::Measure::side) return -1;
  return part == 0 ? 0 : part == PlaneNorm::across ? 1 : -1;
}

}  // namespace

void Scheduler::Parts::list_plane(const ActiveAxis& a) noexcept {
  const PlaneNorm& norm = planes[static_cast<std::size_t>(a.plane)];
  for (int i = 0; i < norm.count(); ++i) {
    const std::size_t index = a.wanted + 1 + static_cast<std::size_t>(i);
    const bool is_new = index == wanted.size();
    if (is_new) wanted.emplace_back();
    const Wanted& speed = wanted[a.wanted];
    Wanted& w = wanted[index];
    w.origin = speed.origin;
    w.origin.part = i;
    w.move = speed.move;
    w.in = speed.in;
    w.always = speed.always;
    w.measured = speed.measured;
    w.lost = speed.lost;
    w.far = false;  // until one set is in force: each set keeps its own solution within the norm
    const solver::AxisConstraint& along = speed.constraint;
    if (!is_new && is_same_frame(w.constraint.move, along.move) && is_same_frame(w.constraint.in, along.in))
      continue;
    w.constraint = norm.constraint(i, along.move, along.in);
    w.constraint.level = a.says->level;
  }
}

/// The norm's own constraints stand behind that of the speed.
void Scheduler::Parts::want_plane(const ActiveAxis& a) noexcept {
  const lang::AxisStatements& s = *a.says;
  const PlaneNorm& norm = planes[static_cast<std::size_t>(a.plane)];
  for (int i = 0; i < norm.count(); ++i) {
    solver::AxisConstraint& c = wanted[a.wanted + 1 + static_cast<std::size_t>(i)].constraint;
    if (a.hangs_on_signal) {
      c.move = frames.attached(a.group->move);
      c.in = axes_frame(*a.group, &a);
    }
    if (s.weight) c.weight = s.weight->evaluate(parameters);
    const bool is_turn = c.measure == solver::Measure::turn;
    if (s.force && !is_turn) {
      const double most = norm.share_of_force() * s.force->high.evaluate(parameters);
      c.force = Range{-most, most};
    }
    if (!s.acceleration) continue;
    const double most = s.acceleration->high.evaluate(parameters);
    if (is_turn) {
      c.velocity = Range{-most, most};
    } else if (norm.rolls) {
      solver::AxisConstraint turn = norm.constraint(1, c.move, c.in);
      c.acceleration = ahead_of(most, solver::coordinate_of(turn, frames.motions()).velocity);
    } else {
      c.acceleration = Range{-most * PlaneNorm::apothem, most * PlaneNorm::apothem};
    }
  }
}

void Scheduler::Parts::read_planes(const solver::Solution& solution) noexcept {
  for (PlaneReading& reading : plane_readings) reading = {};
  std::size_t row = 0;
  for (std::size_t set = 0; set < blend->sets().size(); ++set) {
    const BlendedSet& blended = blend->sets()[set];
    int before = -1, place = -1;
    for (const solver::Row& asked : blended.constraints.rows()) {
      if (row == solution.rows.size()) return;
      const auto i = static_cast<std::size_t>(asked.constraint);
      const bool is_first = asked.constraint != before;  // the others act along the same axis
      if (is_first) {
        before = asked.constraint;
        const InForce& force = blended.in_force[i];
        place = force.active ? place_of(blended.constraints.constraints()[i], force.origin.part) : -1;
      }
      if (place >= 0) {
        const solver::RowSolution& answer = solution.rows[row];
        const Origin& origin = blended.in_force[i].origin;
        const auto at = static_cast<std::size_t>(place);
        PlaneReading& reading = plane_readings[static_cast<std::size_t>(
            plane_of[static_cast<std::size_t>(origin.task)][static_cast<std::size_t>(origin.group)])];
        if (asked.kind == solver::RowKind::sum) reading.press[at] += blended.share * answer.nu;
        if (set == 0) {
          reading.row[at] = static_cast<int>(row);
          const double bias = blended.constraints.coordinates()[i].acceleration_bias;
          if (is_first) reading.acceleration[at] = acceleration_of(asked, solution, bias);
        }
      }
      ++row;
    }
  }
}

/// Of what side `i` allows, the share that the solution takes.
double Scheduler::Parts::share_of_side(const solver::AxisConstraint& side,
                                       const PlaneReading& reading) const noexcept {
  const double c = side.coefficients[0], s = side.coefficients[1];
  double share = 0.0;
  if (side.acceleration)
    share = std::abs(c * reading.acceleration[0] + s * reading.acceleration[1]) / side.acceleration->high;
  if (side.force) {
    const double along = c * reading.press[0] * reading.W_xx + s * reading.press[1] * reading.W_yy;
    const double W = c * c * reading.W_xx + 2.0 * c * s * reading.W_xy + s * s * reading.W_yy;
    if (W > 0.0) share = std::max(share, std::abs(along / W) / side.force->high);
  }
  return share;
}

/// True: a side came into force.
bool Scheduler::Parts::choose_sides(const ActiveAxis& a, const PlaneReading& reading) noexcept {
  const auto side = [&](int i) -> Wanted& { return wanted[a.wanted + 1 + static_cast<std::size_t>(i)]; };
  std::array<double, PlaneNorm::most_sides> shares{};
  bool is_broken = false;
  const bool is_calm = most_share(side(0).constraint, reading) < let_go;
  for (int i = 0; i < PlaneNorm::most_sides && !is_calm; ++i) {
    double& share = shares[static_cast<std::size_t>(i)];
    share = share_of_side(side(i).constraint, reading);
    is_broken = is_broken || (side(i).far && share > broken);
  }
  for (int i = 0; i < PlaneNorm::most_sides; ++i) {
    if (i == 0 || i == PlaneNorm::across) continue;
    Wanted& w = side(i);
    const double share = shares[static_cast<std::size_t>(i)];
    const bool was_far = w.far;
    const bool may_leave = !is_broken && blend->sets().size() == 1 && !keeps_all_sides;
    w.far = may_leave ? w.far || share < let_go : w.far && (!is_broken || share <= near);
    reach_changed = reach_changed || w.far != was_far;
  }
  return is_broken;
}

bool Scheduler::Parts::pose_broken_sides(const solver::Solver& solver,
                                         const solver::Solution& solution) noexcept {
  if (planes.empty()) return false;
  read_planes(solution);
  bool is_broken = false;
  for (const ActiveAxis& a : axes) {
    if (a.plane < 0 || planes[static_cast<std::size_t>(a.plane)].rolls) continue;
    PlaneReading& reading = plane_readings[static_cast<std::size_t>(a.plane)];
    if (reading.row[0] < 0 || reading.row[1] < 0) continue;
    if (a.says->force) {
      solver.force_on_motions(reading.row[0], press_x);
      solver.force_on_motions(reading.row[1], press_y);
      const Eigen::Index m = solution.mobility;
      reading.W_xx = press_x.head(m).squaredNorm();
      reading.W_xy = press_x.head(m).dot(press_y.head(m));
      reading.W_yy = press_y.head(m).squaredNorm();
    }
    is_broken = choose_sides(a, reading) || is_broken;
  }
  if (is_broken) put();
  return is_broken;
}

}  // namespace zwang::runtime
