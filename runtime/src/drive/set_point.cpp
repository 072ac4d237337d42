#include "drive/set_point.hpp"

#include <algorithm>
#include <cmath>

#include "schedule/acceleration_of.hpp"

namespace zwang::runtime {

namespace {

using solver::AxisConstraint;

/// The allowed range of V along the constraint; `v` is the present velocity.
solver::Range allowed(const AxisConstraint& constraint, const solver::RowSolution& row, double v) noexcept {
  solver::Range range;
  if (constraint.velocity) range = *constraint.velocity;
  const bool is_met = row.status == solver::RowStatus::held;
  if (constraint.driver && constraint.driver->quantity == solver::Quantity::velocity && is_met) {
    const double target = constraint.driver->target;
    if (v <= target) range.high = std::min(range.high, target);
    if (v >= target) range.low = std::max(range.low, target);
  }
  return range;
}

/// [s] What the speeds lack of the age of T_c.
double more_age(const lang::Drive& drive) noexcept {
  return drive.integral_time ? std::max(0.0, drive.time_constant - drive.delay - 1.0 / drive.rate) : 0.0;
}

}  // namespace

SetPoint::SetPoint(const lang::Drive& drive, const solver::Model& model, double period)
    : lead_(drive.time_constant + 0.5 * drive.delay + 0.5 / drive.rate + more_age(drive)),
      part_(period / (more_age(drive) + period)),
      older_(Eigen::VectorXd::Zero(model.joint_count())),
      p_(Eigen::VectorXd::Zero(solver::FreeMotions(model).joint.cols())),
      change_(p_) {}

void SetPoint::put(const solver::Solver& solver, const solver::ConstraintSet& set,
                   const solver::Solution& solution, const solver::FreeMotions& motions,
                   const Eigen::VectorXd& qd, Eigen::VectorXd& velocity) noexcept {
  const int m = motions.count;
  if (!has_older_) older_ = qd;
  has_older_ = true;
  older_ += part_ * (qd - older_);
  change_.setZero();
  const std::vector<solver::Row>& rows = set.rows();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    int last = -1;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const int of = rows[r].constraint;
      if (of == last || of < 0 || rows[r].kind == solver::RowKind::sum) continue;
      last = of;
      const AxisConstraint& constraint = set.constraints()[static_cast<std::size_t>(of)];
      const solver::Coordinate& now = set.coordinates()[static_cast<std::size_t>(of)];
      const solver::Range range = allowed(constraint, solution.rows[r], now.velocity);
      if (std::isinf(range.low) && std::isinf(range.high)) continue;
      solver.force_on_motions(static_cast<int>(r), p_);
      const double square = p_.head(m).squaredNorm();
      if (square == 0.0) continue;
      const double a = acceleration_of(rows[r], solution, now.acceleration_bias);
      const double V = now.velocity + lead_ * (a + p_.head(m).dot(change_.head(m)));
      const double excess = V - std::clamp(V, range.low, std::max(range.low, range.high));
      change_.head(m) -= excess / (lead_ * square) * p_.head(m);
    }
  }
  for (Eigen::Index j = 0; j < velocity.size(); ++j)
    velocity(j) = older_(j) + lead_ * (solution.qdd(j) + motions.joint.row(j).head(m).dot(change_.head(m)));
}

}  // namespace zwang::runtime
