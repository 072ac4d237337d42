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

}  // namespace

Columns::Columns(const Model& model, int row_capacity)
    : drift(Eigen::VectorXd::Zero(row_capacity)),
      dimension_of_(index(model.body_count())),
      columns_(index(2 * row_capacity)),
      own_(Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 2 * row_capacity)),
      ranges_(index(model.body_count())),
      row_of_(index(2 * row_capacity)),
      A_(Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 2 * row_capacity)) {
  for (const Body& body : model.bodies()) parents_.push_back(body.parent);
  walk_ = walk_by_branches(parents_);
  number_dimensions(model);
  W = RowMajorMatrix::Zero(row_capacity, spaced(dimensions_));
}

/// The base, the joints that carry wheels, the others.
void Columns::number_dimensions(const Model& model) {
  std::vector<bool> carries_wheel(parents_.size(), false);
  for (const Wheel& wheel : model.wheels()) {
    for (int body = wheel.body; body > 0; body = parents_[index(body)]) carries_wheel[index(body)] = true;
  }
  dimensions_ = model.has_fixed_base() ? 0 : 6;
  held_ = model.base_type() == BaseType::ground ? 3 : 0;
  for (const bool wanted : {true, false}) {
    for (std::size_t i = 1; i < parents_.size(); ++i) {
      if (carries_wheel[i] == wanted) dimension_of_[i] = dimensions_++;
    }
    if (wanted) ground_end_ = dimensions_;
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
  for (int k = 0; k < count_; ++k) {
    Column& column = columns_[index(k)];
    Range& range = ranges_[index(column.body)];
    column.place = range.last++;
    row_of_[index(column.place)] = column.row;
    if (column.of_joint) range.joint = column.place;
  }
  for (std::size_t i = parents_.size() - 1; i > 0; --i) {
    Range& parent = ranges_[index(parents_[i])];
    parent.last = std::max(parent.last, ranges_[i].last);
  }
}

void Columns::sweep_inward(const std::vector<BodySweep>& bodies,
                           const Matrix6* base_inverse_factor) noexcept {
  if (rows_ == 0) return;
  arrange();
  for (std::size_t i = bodies.size() - 1; i > 0; --i) carry(i, bodies[i]);
  if (base_inverse_factor != nullptr) finish(*base_inverse_factor);
}

/// In the order of the walk.
void Columns::arrange() noexcept {
  if (laid_out_ != count_) lay_out();
  for (int i = 0; i < rows_; ++i) set_zero(dimensions_, &W(i, 0));
  for (int k = 0; k < count_; ++k) A_.col(columns_[index(k)].place) = own_.col(k);
}

void Columns::find_drift(const std::vector<BodySweep>& bodies) noexcept {
  set_zero(rows_, drift.data());
  const double* A = own_.data();
  for (int k = 0; k < count_; ++k, A += 6) {
    const Column& column = columns_[index(k)];
    if (!column.of_joint) drift(column.row) += dot<6>(A, bodies[index(column.body)].c.data());
  }
}

/// Takes the columns of body i through its joint: (8) and (9).
void Columns::carry(std::size_t i, const BodySweep& sweep) noexcept {
  const Range& range = ranges_[i];
  if (range.first == range.last) return;
  const double root = sweep.root_D_inverse;
  double* const axis = W.data() + dimension_of_[i];
  const Eigen::Index stride = W.outerStride();
  Eigen::Array2d S[3], factor[3];
  for (int r = 0; r < 3; ++r) {
    S[r] = ConstPair(sweep.S.data() + 2 * r);
    factor[r] = ConstPair(sweep.UD.data() + 2 * r);
  }
  double* A = A_.data() + 6 * range.first;
  for (int k = range.first; k < range.last; ++k, A += 6) {
    const int row = row_of_[index(k)];
    const Eigen::Array2d sum = S[0] * ConstPair(A) + S[1] * ConstPair(A + 2) + S[2] * ConstPair(A + 4);
    const double along = sum(0) + sum(1);
    for (int r = 0; r < 3; ++r) Pair(A + 2 * r) -= along * factor[r];
    axis[row * stride] += root * along;
  }
  if (range.joint >= 0) {
    const int row = row_of_[index(range.joint)];
    A_.col(range.joint) = -sweep.UD;
    axis[row * stride] = root;
  }
}

/// A floating base, (12), with IA_0^-1 = F'F: its dimensions of W are F's lines.
void Columns::finish(const Matrix6& F) noexcept {
  const double* A = A_.data();
  for (int k = 0; k < count_; ++k, A += 6) {
    Eigen::Array2d FA[3];
    for (int r = 0; r < 3; ++r) FA[r] = A[0] * ConstPair(F.data() + 2 * r);
    for (int c = 1; c < 6; ++c) {
      for (int r = 0; r < 3; ++r) FA[r] += A[c] * ConstPair(F.data() + 6 * c + 2 * r);
    }
    double* const base = &W(row_of_[index(k)], 0);
    for (int r = 0; r < 3; ++r) Pair(base + 2 * r) += FA[r];
  }
}

}  // namespace zwang::solver
