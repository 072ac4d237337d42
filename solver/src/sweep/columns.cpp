#include "sweep/columns.hpp"

#include <algorithm>

#include "pairs.hpp"
#include "sweep/sweeps.hpp"

namespace zwang::solver {

namespace {

/// Bodies in an order in which every branch is one piece: a parent, then each child with all it carries.
std::vector<int> walk_by_branches(const std::vector<int>& parents) {
  const std::size_t count = parents.size();
  std::vector<int> carried(count, 1);  // bodies of the branch that starts at a body
  for (std::size_t i = count - 1; i > 0; --i) carried[static_cast<std::size_t>(parents[i])] += carried[i];
  std::vector<int> next(count, 1);  // the place of the next child, counted from its parent's
  std::vector<int> place(count, 0), walk(count, 0);
  for (std::size_t i = 1; i < count; ++i) {
    const auto parent = static_cast<std::size_t>(parents[i]);
    place[i] = place[parent] + next[parent];
    next[parent] += carried[i];
    walk[static_cast<std::size_t>(place[i])] = static_cast<int>(i);
  }
  return walk;
}

/// More than `columns`, and an odd multiple of 8: lines of that length start on different sets of the cache.
int spaced(int columns) {
  return 8 * ((columns + 8) / 8 | 1);
}

/// L += SA' D^-1 SA, the lower triangle of lines [first, last): two lines and two columns at a time. What
/// that writes above the diagonal nobody reads.
void add_square(int first, int last, double D_inverse, const double* SA, RowMajorMatrix& L) {
  int k = first;
  for (; k + 2 <= last; k += 2) {
    const double upper = SA[k] * D_inverse;
    const double lower = SA[k + 1] * D_inverse;
    double* const upper_line = &L(k, 0);
    double* const lower_line = &L(k + 1, 0);
    for (int l = first; l <= k; l += 2) {
      const Eigen::Array2d pair = ConstPair(SA + l);
      Pair(upper_line + l) += upper * pair;
      Pair(lower_line + l) += lower * pair;
    }
  }
  if (k == last) return;
  const double factor = SA[k] * D_inverse;
  double* const line = &L(k, 0);
  for (int l = first; l <= k; l += 2) Pair(line + l) += factor * ConstPair(SA + l);
}

}  // namespace

Columns::Columns(const Model& model, int row_capacity)
    : L(RowMajorMatrix::Zero(row_capacity, spaced(row_capacity))),
      g(Eigen::VectorXd::Zero(row_capacity)),
      ranges_(index(model.body_count())),
      row_of_(index(2 * row_capacity)),
      A_(Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 2 * row_capacity)),
      SA_(RowMajorMatrix::Zero(model.body_count(), spaced(2 * row_capacity))),
      L_(RowMajorMatrix::Zero(2 * row_capacity, spaced(2 * row_capacity))),
      g_(Eigen::VectorXd::Zero(2 * row_capacity)),
      nu_(Eigen::VectorXd::Zero(2 * row_capacity)) {
  for (const Body& body : model.bodies()) parents_.push_back(body.parent);
  walk_ = walk_by_branches(parents_);
  added_.reserve(index(2 * row_capacity));
}

void Columns::clear() noexcept {
  rows_ = 0;
  added_.clear();
}

int Columns::add_row(int body, const Vector6& a) noexcept {
  added_.push_back({a, body, rows_, false});
  return rows_++;
}

void Columns::extend_last_row(int body, const Vector6& a) noexcept {
  added_.push_back({a, body, rows_ - 1, false});
}

int Columns::add_joint_row(int joint) noexcept {
  added_.push_back({Vector6::Zero(), joint + 1, rows_, true});
  return rows_++;
}

void Columns::arrange(const std::vector<BodySweep>& bodies) noexcept {
  for (Range& range : ranges_) range = Range{};
  for (const Added& column : added_) ++ranges_[index(column.body)].last;
  int place = 0;
  for (const int i : walk_) {
    Range& range = ranges_[index(i)];
    const int own = range.last;
    range.first = range.last = place;
    place += own;
  }
  is_sorted_ = static_cast<int>(added_.size()) == rows_;
  int number = 0;
  for (const Added& column : added_) {
    Range& range = ranges_[index(column.body)];
    const int k = range.last++;
    row_of_[index(k)] = column.row;
    is_sorted_ = is_sorted_ && k == number++;
    A_.col(k) = column.a;
    if (column.of_joint) range.joint = k;
    g_(k) = column.of_joint ? 0.0 : column.a.dot(bodies[index(column.body)].c);
  }
  for (std::size_t i = parents_.size() - 1; i > 0; --i) {
    Range& parent = ranges_[index(parents_[i])];
    parent.last = std::max(parent.last, ranges_[i].last);
  }
  RowMajorMatrix& by_column = is_sorted_ ? L : L_;
  const int count = static_cast<int>(added_.size());
  for (int k = 0; k < count; ++k) set_zero(k + 1, &by_column(k, 0));
}

void Columns::carry(std::size_t i, const BodySweep& sweep, const Vector6& UD) noexcept {
  const Range& range = ranges_[i];
  if (range.first == range.last) return;
  const int first = range.first;
  const int last = range.last;
  double* const SA = &SA_(static_cast<Eigen::Index>(i), 0);
  double* const A = A_.data();
  const Vector6 S = sweep.S;
  for (int k = first; k < last; ++k) {
    Eigen::Map<Vector6, Eigen::Aligned16> column(A + 6 * k);
    const Vector6 before = column;
    const double along = S.dot(before);
    column = before - UD * along;
    SA[k] = along;
  }
  if (range.joint >= 0) {
    SA[range.joint] = 1.0;
    A_.col(range.joint) = -UD;
  }
  add_multiple(last - first, sweep.u * sweep.D_inverse, SA + first, g_.data() + first);
  add_square(first, last, sweep.D_inverse, SA, is_sorted_ ? L : L_);
}

void Columns::finish() noexcept {
  if (is_sorted_) {
    g.head(rows_) = g_.head(rows_);
  } else {
    sort_into_rows();
  }
}

void Columns::finish(const Matrix6& F, const Vector6& pA) noexcept {
  const auto count = static_cast<Eigen::Index>(added_.size());
  RowMajorMatrix& by_column = is_sorted_ ? L : L_;
  const Vector6 Fp = F * pA;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Vector6 FA = F * A_.col(k);
    A_.col(k) = FA;
    g_(k) -= FA.dot(Fp);
    for (Eigen::Index l = 0; l <= k; ++l) by_column(k, l) += FA.dot(A_.col(l));
  }
  finish();
}

/// Adds up the entries of L and g that belong to the same rows.
void Columns::sort_into_rows() noexcept {
  g.head(rows_).setZero();
  for (int i = 0; i < rows_; ++i) set_zero(i + 1, &L(i, 0));
  const int count = static_cast<int>(added_.size());
  for (int k = 0; k < count; ++k) {
    const int row = row_of_[index(k)];
    g(row) += g_(k);
    for (int l = 0; l < k; ++l) {
      const int other = row_of_[index(l)];
      // The two columns of one row meet twice on its diagonal.
      L(std::max(row, other), std::min(row, other)) += row == other ? 2.0 * L_(k, l) : L_(k, l);
    }
    L(row, row) += L_(k, k);
  }
}

void Columns::set_multipliers(const Eigen::VectorXd& nu) noexcept {
  for (std::size_t k = 0; k < added_.size(); ++k) nu_(static_cast<Eigen::Index>(k)) = nu(row_of_[k]);
}

double Columns::joint_force(std::size_t i) const noexcept {
  const Range& range = ranges_[i];
  const double* const SA = &SA_(static_cast<Eigen::Index>(i), 0);
  return dot(range.last - range.first, SA + range.first, nu_.data() + range.first);
}

Vector6 Columns::base_force() const noexcept {
  Vector6 force = Vector6::Zero();
  for (std::size_t k = 0; k < added_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    force += A_.col(column) * nu_(column);
  }
  return force;
}

}  // namespace zwang::solver
