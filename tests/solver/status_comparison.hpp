/// The status of a row by the oracle's numbers: what each word means, without the solver's bookkeeping.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/lexicographic.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::oracle {

/// Statuses that a row may have; most of the time one.
struct Statuses {
  unsigned bits = 0;
  void add(solver::RowStatus status) { bits |= 1u << static_cast<unsigned>(status); }
  bool has(solver::RowStatus status) const { return (bits >> static_cast<unsigned>(status) & 1u) != 0; }
  bool is_single() const { return bits != 0 && (bits & (bits - 1)) == 0; }
};

/// A status that the numbers cannot decide, because it is within their tolerance, stays open.
class StatusOracle {
 public:
  StatusOracle(const solver::Model& model, const std::vector<solver::Row>& rows, const OracleSolution& want)
      : rows_(rows), want_(want) {
    for (const solver::Row& row : rows) lowest_ = std::max(lowest_, row.level);
    for (int j = 0; j < model.joint_count(); ++j) {
      const solver::Joint& joint = model.joint(j);
      if (!joint.actuated || !std::isfinite(joint.max_effort)) continue;
      has_limits_ = true;
      const auto torque = static_cast<double>(std::abs(want.tau[j]));
      motor_ = std::max(motor_, reached(torque, joint.max_effort, joint.max_effort));
    }
  }

  Statuses of(std::size_t i) const {
    switch (rows_[i].kind) {
      case solver::RowKind::sum:
        return of_sum(i);
      case solver::RowKind::force:
        return of_force(i);
      default:
        return of_motion(i);
    }
  }

 private:
  using Status = solver::RowStatus;
  enum class Bound { free, perhaps, reached };

  static Bound reached(double value, double bound, double size) {
    const double left = (bound - value) / (1.0 + std::abs(size));
    return left < 1e-11 ? Bound::reached : left < 1e-6 ? Bound::perhaps : Bound::free;
  }
  Bound bound(std::size_t i, double low, double high) const {
    const auto nu = static_cast<double>(want_.rows[i].nu);
    const double size = std::max(-low, high);
    return std::max(high > 0.0 ? reached(nu, high, size) : Bound::free,
                    low < 0.0 ? reached(-nu, -low, size) : Bound::free);
  }
  Bound bound_of_sum(std::size_t i) const {
    if (want_.rows[i].unreachable) return Bound::free;
    return bound(i, rows_[i].lo, rows_[i].hi);
  }
  bool is_below_limits(int level) const {
    return std::any_of(rows_.begin(), rows_.end(), [&](const solver::Row& row) {
      return solver::is_limit(row.kind) && row.level < level;
    });
  }
  bool has_sum(int level) const {
    return std::any_of(rows_.begin(), rows_.end(), [&](const solver::Row& row) {
      return row.kind == solver::RowKind::sum && row.level <= level;
    });
  }
  /// Whether a sum that the row adds to may be at its bound, or may have been when the row's level was
  /// solved. A lower level may have moved it away since, which the final torques do not show.
  bool may_sum_hold(int level) const {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const bool counts = rows_[k].kind == solver::RowKind::sum && rows_[k].level <= level;
      if (counts && (level < lowest_ || bound_of_sum(k) != Bound::free)) return true;
    }
    return false;
  }
  /// Whether a motor may be at its limit, or may have been when the row's level was solved.
  bool may_motor_hold(int level) const { return motor_ != Bound::free || (level < lowest_ && has_limits_); }

  Statuses of_sum(std::size_t i) const {
    Statuses out;
    const Bound at = bound_of_sum(i);
    if (at != Bound::reached) out.add(Status::held);
    if (at != Bound::free) out.add(Status::force_limited);
    return out;
  }

  Statuses of_force(std::size_t i) const {
    Statuses out;
    const OracleRow& w = want_.rows[i];
    const auto missing = static_cast<double>(1 - w.phi);
    if (missing < 1e-6) out.add(Status::held);
    if (missing < 1e-11) return out;
    if (w.idle) {
      out.add(w.unreachable ? Status::unreachable : Status::blocked);
      return out;
    }
    // The motion of its own level comes after it and may move motors and sums away from their bounds.
    if (has_limits_) out.add(Status::torque_limited);
    if (has_sum(rows_[i].level) || !want_.motors_reach_all) out.add(Status::force_limited);
    return out;
  }

  Statuses of_motion(std::size_t i) const {
    Statuses out;
    const OracleRow& w = want_.rows[i];
    const solver::Row& row = rows_[i];
    const bool is_one_sided = row.kind != solver::RowKind::driver;
    const auto s = static_cast<double>(w.residual);
    const double missed = row.kind == solver::RowKind::upper   ? std::max(s, 0.0)
                          : row.kind == solver::RowKind::lower ? std::max(-s, 0.0)
                                                               : std::abs(s);
    const double share = missed / (1.0 + static_cast<double>(std::abs(w.demand)));
    if (share < 1e-6) out.add(Status::held);
    if (share < 1e-10) return out;
    if (w.unreachable) {
      out.add(Status::unreachable);
      return out;
    }
    const bool by_sum = may_sum_hold(row.level);
    if (by_sum) out.add(Status::force_limited);
    if (w.idle) {
      out.add(Status::blocked);
      return out;
    }
    // The oracle tells the force of the row's own level; a limit's may be another one below it.
    const bool is_known = !is_one_sided || row.level == lowest_;
    const Bound at = is_known ? bound(i, row.lo, row.hi) : Bound::perhaps;
    if (at != Bound::free) out.add(is_one_sided ? Status::conflict : Status::force_limited);
    if (at == Bound::reached) return out;
    if (std::isfinite(row.weight)) {
      out.add(Status::held);  // with its share of what it asks
    } else {
      if (may_motor_hold(row.level)) out.add(Status::torque_limited);
      // A force that the motors make only together with others is left over, too.
      // The force of a sum that acts through a limit above is left over likewise.
      const bool is_left_over =
          !is_known || !want_.motors_reach_all || (by_sum && is_below_limits(row.level));
      if (is_left_over) out.add(Status::conflict);
    }
    return out;
  }

  const std::vector<solver::Row>& rows_;
  const OracleSolution& want_;
  int lowest_ = 0;
  bool has_limits_ = false;    ///< of torques
  Bound motor_ = Bound::free;  ///< the one nearest to its limit
};

}  // namespace zwang::oracle
