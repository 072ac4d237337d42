#include "drive/torque_box.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "schedule/acceleration_of.hpp"

namespace zwang::runtime {

namespace {

/// Of a bound's largest share: rounding, no share of a joint.
constexpr double negligible = 1e-9;
/// Of a row's length: what is left of it beside others, and it depends on them.
constexpr double dependent = 1e-3;

using solver::infinity;
using solver::Row;
using solver::RowKind;

bool drives(const Row& row) noexcept {
  return row.kind == RowKind::driver || row.kind == RowKind::force;
}

/// Of its force.
solver::Range bounds_of(const Row& row) noexcept {
  switch (row.kind) {
    case RowKind::force:
      if (row.force == 0.0) return {0.0, 0.0};
      return row.force > 0.0 ? solver::Range{-infinity, row.force} : solver::Range{row.force, infinity};
    case RowKind::driver:
    case RowKind::sum:
      return {row.lo, row.hi};
    case RowKind::upper:
    case RowKind::lower:
      break;
  }
  return {};
}

}  // namespace

void put_box(const TorqueBounds& bounds, const Eigen::VectorXd& torque, const Eigen::VectorXd& limit,
             Eigen::VectorXd& lower, Eigen::VectorXd& upper) noexcept {
  lower = -limit;
  upper = limit;
  for (int k = 0; k < bounds.count; ++k) {
    const auto g = bounds.per_torque.col(k);
    const double sum = (limit.array() > 0.0).select(g, 0.0).template lpNorm<1>();
    if (!(sum > 0.0)) continue;
    const double now = g.dot(torque);
    const double more = std::max(0.0, bounds.high(k) - now) / sum;
    const double less = std::max(0.0, now - bounds.low(k)) / sum;
    for (Eigen::Index i = 0; i < torque.size(); ++i) {
      if (std::abs(g(i)) <= negligible * sum) continue;
      const bool pushes_ahead = g(i) > 0.0;
      upper(i) = std::min(upper(i), torque(i) + (pushes_ahead ? more : less));
      lower(i) = std::max(lower(i), torque(i) - (pushes_ahead ? less : more));
    }
  }
  // A torque beyond its motor's limit is not sent.
  lower = lower.cwiseMin(limit);
  upper = upper.cwiseMax(-limit).cwiseMax(lower);
}

RowBounds::RowBounds(const solver::Model& model, int row_capacity)
    : motions_(model),
      bounds_(model.joint_count(), row_capacity),
      p_(Eigen::VectorXd::Zero(motions_.joint.cols())),
      P_(Eigen::MatrixXd::Zero(p_.size(), most_independent)),
      orthonormal_(P_),
      dual_(P_) {
  independent_.reserve(most_independent);
  length_.reserve(most_independent);
}

/// By Gram and Schmidt, in the order of the rows.
void RowBounds::choose_independent(const solver::Solver& solver, const std::vector<Row>& rows,
                                   int first) noexcept {
  const int m = motions_.count;
  independent_.clear();
  length_.clear();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto count = static_cast<Eigen::Index>(independent_.size());
    if (count == std::min(m, most_independent)) return;
    if (!drives(rows[k])) continue;
    solver.force_on_motions(first + static_cast<int>(k), p_);
    const double length = p_.head(m).norm();
    if (length == 0.0) continue;
    P_.col(count).head(m) = p_.head(m) / length;
    auto left = orthonormal_.col(count).head(m);
    left = P_.col(count).head(m);
    for (Eigen::Index i = 0; i < count; ++i)
      left -= orthonormal_.col(i).head(m).dot(left) * orthonormal_.col(i).head(m);
    const double rest = left.norm();
    if (rest < dependent) continue;
    left /= rest;
    independent_.push_back(static_cast<int>(k));
    length_.push_back(length);
  }
}

/// `per_force`: in the coordinates of solver::FreeMotions, 1 N m of joint j adds its row of T to p.
void RowBounds::add(const solver::Range& range, const Eigen::Ref<const Eigen::VectorXd>& per_force) noexcept {
  if (std::isinf(range.low) && std::isinf(range.high)) return;
  if (bounds_.count == bounds_.low.size()) return;
  const int k = bounds_.count++;
  for (Eigen::Index j = 0; j < bounds_.per_torque.rows(); ++j)
    bounds_.per_torque(j, k) = motions_.joint.row(j).head(per_force.size()).dot(per_force);
  bounds_.low(k) = range.low;
  bounds_.high(k) = range.high;
}

/// `p_` is that of the row. The solution leaves it b - a . Xdd.
void RowBounds::add_limit(const Row& row, const solver::Solution& solution) noexcept {
  const double left = row.b - acceleration_of(row, solution, 0.0);
  const int k = bounds_.count;
  add(row.kind == RowKind::upper ? solver::Range{-infinity, left} : solver::Range{left, infinity},
      p_.head(motions_.count));
  if (bounds_.count == k) return;
  const double now = bounds_.per_torque.col(k).dot(solution.tau);
  bounds_.low(k) += now;
  bounds_.high(k) += now;
}

const TorqueBounds& RowBounds::look(const solver::Solver& solver, const Scheduler& scheduler,
                                    const solver::Solution& solution) noexcept {
  solver.free_motions(motions_);
  bounds_.count = 0;
  int first = 0;
  for (int set = 0; set < scheduler.set_count(); ++set) {
    const std::vector<Row>& rows = scheduler.constraints(set).rows();
    look_at_set(solver, rows, first, solution);
    first += static_cast<int>(rows.size());
  }
  return bounds_;
}

void RowBounds::look_at_set(const solver::Solver& solver, const std::vector<Row>& rows, int first,
                            const solver::Solution& solution) noexcept {
  const int m = motions_.count;
  choose_independent(solver, rows, first);
  const auto r = static_cast<Eigen::Index>(independent_.size());
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_independent, most_independent>;
  Small gram(r, r);
  for (Eigen::Index a = 0; a < r; ++a) {
    for (Eigen::Index b = 0; b < r; ++b) gram(a, b) = P_.col(a).head(m).dot(P_.col(b).head(m));
  }
  const Small inverse = gram.llt().solve(Small::Identity(r, r));
  for (Eigen::Index a = 0; a < r; ++a) {
    dual_.col(a).head(m).setZero();
    for (Eigen::Index b = 0; b < r; ++b) dual_.col(a).head(m) += inverse(b, a) * P_.col(b).head(m);
    dual_.col(a).head(m) /= length_[static_cast<std::size_t>(a)];
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row& row = rows[k];
    const auto found = std::find(independent_.begin(), independent_.end(), static_cast<int>(k));
    if (found != independent_.end()) {
      add(bounds_of(row), dual_.col(found - independent_.begin()).head(m));
      continue;
    }
    solver.force_on_motions(first + static_cast<int>(k), p_);
    const double square = p_.head(m).squaredNorm();
    if (square == 0.0) continue;
    if (is_limit(row.kind)) {
      add_limit(row, solution);
      continue;
    }
    p_.head(m) /= square;
    add(bounds_of(row), p_.head(m));
  }
}

}  // namespace zwang::runtime
