#include "sweep/columns.hpp"

#include <algorithm>

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

/// L = FA'FA for columns of length six that stand side by side, the lower triangle.
void square(const RowMajorMatrix& FA, int columns, RowMajorMatrix& L) {
  const Eigen::Index stride = FA.outerStride();
  for (int k = 0; k < columns; ++k) {
    double factor[6];
    for (int r = 0; r < 6; ++r) factor[r] = FA(r, k);
    double* const line = &L(k, 0);
    for (int l = 0; l <= k; l += 2) {
      const double* const column = FA.data() + l;
      Eigen::Array2d sum = factor[0] * ConstPair(column);
      for (int r = 1; r < 6; ++r) sum += factor[r] * ConstPair(column + r * stride);
      Pair(line + l) = sum;
    }
  }
}

}  // namespace

Columns::Columns(const Model& model, int row_capacity)
    : L(RowMajorMatrix::Zero(row_capacity, spaced(row_capacity))),
      g(Eigen::VectorXd::Zero(row_capacity)),
      columns_(index(2 * row_capacity)),
      own_(Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 2 * row_capacity)),
      has_fixed_base_(model.has_fixed_base()),
      ranges_(index(model.body_count())),
      row_of_(index(2 * row_capacity)),
      A_(Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 2 * row_capacity)),
      SA_(RowMajorMatrix::Zero(model.body_count(), spaced(2 * row_capacity))),
      L_(RowMajorMatrix::Zero(2 * row_capacity, spaced(2 * row_capacity))),
      g_(Eigen::VectorXd::Zero(2 * row_capacity)),
      nu_(Eigen::VectorXd::Zero(2 * row_capacity)),
      FA_(RowMajorMatrix::Zero(6, spaced(row_capacity))) {
  for (const Body& body : model.bodies()) parents_.push_back(body.parent);
  walk_ = walk_by_branches(parents_);
  for (int i = 1; i < model.body_count(); ++i) {
    if (parents_[index(i)] == 0) branches_.push_back(i);
  }
}

void Columns::clear() noexcept {
  rows_ = 0;
  count_ = 0;
}

void Columns::add(int body, int row, bool of_joint, const Vector6& a) noexcept {
  own_.col(count_) = a;
  Column& column = columns_[index(count_++)];
  if (column.body == body && column.row == row && column.of_joint == of_joint) return;
  column = {body, row, of_joint};
  laid_out_ = -1;
}

int Columns::add_row(int body, const Vector6& a) noexcept {
  add(body, rows_, false, a);
  return rows_++;
}

void Columns::extend_last_row(int body, const Vector6& a) noexcept {
  add(body, rows_ - 1, false, a);
}

int Columns::add_joint_row(int joint) noexcept {
  add(joint + 1, rows_, true, Vector6::Zero());
  return rows_++;
}

void Columns::lay_out() noexcept {
  laid_out_ = count_;
  for (Range& range : ranges_) range = Range{};
  for (int k = 0; k < count_; ++k) ++ranges_[index(columns_[index(k)].body)].last;
  int place = 0;
  for (const int i : walk_) {
    Range& range = ranges_[index(i)];
    const int own = range.last;
    range.first = range.last = place;
    place += own;
  }
  is_sorted_ = has_fixed_base_ && count_ == rows_;
  for (int k = 0; k < count_; ++k) {
    Column& column = columns_[index(k)];
    Range& range = ranges_[index(column.body)];
    column.place = range.last++;
    row_of_[index(column.place)] = column.row;
    if (column.of_joint) range.joint = column.place;
    is_sorted_ = is_sorted_ && column.place == k;
  }
  for (std::size_t i = parents_.size() - 1; i > 0; --i) {
    Range& parent = ranges_[index(parents_[i])];
    parent.last = std::max(parent.last, ranges_[i].last);
  }
}

void Columns::arrange(const std::vector<BodySweep>& bodies) noexcept {
  if (laid_out_ != count_) lay_out();
  for (int k = 0; k < count_; ++k) {
    const Column& column = columns_[index(k)];
    A_.col(column.place) = own_.col(k);
    g_(column.place) = own_.col(k).dot(bodies[index(column.body)].c);
  }
  if (is_sorted_) {
    for (int k = 0; k < rows_; ++k) set_zero(k + 1, &L(k, 0));
    return;
  }
  for (const int body : branches_) {
    const Range& branch = ranges_[index(body)];
    for (int k = branch.first; k < branch.last; ++k) set_zero(k + 1 - branch.first, &L_(k, branch.first));
  }
}

void Columns::carry(std::size_t i, const BodySweep& sweep, const Vector6& UD) noexcept {
  const Range& range = ranges_[i];
  if (range.first == range.last) return;
  const int first = range.first;
  const int last = range.last;
  double* const SA = &SA_(static_cast<Eigen::Index>(i), 0);
  double* const A = A_.data();
  double* const free = g_.data();
  const Vector6 S = sweep.S;
  const Vector6 factor = UD;
  const double free_acceleration = sweep.u * sweep.D_inverse;
  for (int k = first; k < last; ++k) {
    Eigen::Map<Vector6, Eigen::Aligned16> column(A + 6 * k);
    const Vector6 before = column;
    const double along = S.dot(before);
    column = before - factor * along;
    SA[k] = along;
    free[k] += free_acceleration * along;
  }
  if (range.joint >= 0) {
    SA[range.joint] = 1.0;
    A_.col(range.joint) = -factor;
    free[range.joint] += free_acceleration;
  }
  RowMajorMatrix& by_place = is_sorted_ ? L : L_;
  add_square(first, last, sweep.D_inverse, SA, by_place.data(), by_place.outerStride());
}

void Columns::finish() noexcept {
  if (is_sorted_) {
    g.head(rows_) = g_.head(rows_);
    return;
  }
  g.head(rows_).setZero();
  for (int i = 0; i < rows_; ++i) set_zero(i + 1, &L(i, 0));
  for (int k = 0; k < count_; ++k) g(row_of_[index(k)]) += g_(k);
  sort_into_rows();
}

void Columns::finish(const Matrix6& F, const Vector6& pA) noexcept {
  g.head(rows_).setZero();
  for (int r = 0; r < 6; ++r) set_zero(rows_, &FA_(r, 0));
  const Vector6 Fp = F * pA;
  for (int k = 0; k < count_; ++k) {
    const Vector6 FA = F * A_.col(k);
    const int row = row_of_[index(k)];
    for (int r = 0; r < 6; ++r) FA_(r, row) += FA(r);
    g(row) += g_(k) - FA.dot(Fp);
  }
  square(FA_, rows_, L);
  sort_into_rows();
}

/// Adds L by place to the entries of the same rows. Columns of different branches of the base have not met,
/// and the base's own have gone through no joint.
void Columns::sort_into_rows() noexcept {
  for (const int body : branches_) {
    const Range& branch = ranges_[index(body)];
    for (int k = branch.first; k < branch.last; ++k) {
      const int row = row_of_[index(k)];
      for (int l = branch.first; l < k; ++l) {
        const int other = row_of_[index(l)];
        // The two columns of one row meet twice on its diagonal.
        L(std::max(row, other), std::min(row, other)) += row == other ? 2.0 * L_(k, l) : L_(k, l);
      }
      L(row, row) += L_(k, k);
    }
  }
}

void Columns::set_multipliers(const Eigen::VectorXd& nu) noexcept {
  for (int k = 0; k < count_; ++k) nu_(k) = nu(row_of_[index(k)]);
}

Vector6 Columns::base_force(const Eigen::VectorXd& nu) const noexcept {
  Vector6 force;
  for (int r = 0; r < 6; ++r) force(r) = dot(rows_, &FA_(r, 0), nu.data());
  return force;
}

}  // namespace zwang::solver
