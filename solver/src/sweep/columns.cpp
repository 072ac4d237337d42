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

/// Columns in the order of the walk.
void Columns::start_sweep() noexcept {
  if (rows_ == 0) return;
  is_single_ = count_ == rows_;
  if (laid_out_ != count_) {
    lay_out();
    W.topRows(rows_).setZero();
  }
  // Where rows have two columns the sweep adds. Else it writes, the same places as the last time; the others
  // are 0 but for those that the ground turns.
  const int last = is_single_ ? ground_end_ : dimensions_;
  for (int i = 0; i < rows_; ++i) {
    double* const line = &W(i, 0);
    for (int k = 0; k < last; ++k) line[k] = 0.0;
  }
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

namespace {

/// S, or what else a joint does to columns: three pairs in registers.
struct Factor {
  explicit Factor(const Vector6& x)
      : first(*aligned_two(x.data())),
        second(*aligned_two(x.data() + 2)),
        third(*aligned_two(x.data() + 4)) {}
  Two first, second, third;
};

/// Terms of the product with a column: two, to be added.
inline Two terms(const Factor& S, const double* A) {
  return S.first * *aligned_two(A) + S.second * *aligned_two(A + 2) + S.third * *aligned_two(A + 4);
}

/// A += factor along
inline void add(const Factor& factor, double along, double* A) {
  *aligned_two(A) += factor.first * along;
  *aligned_two(A + 2) += factor.second * along;
  *aligned_two(A + 4) += factor.third * along;
}

}  // namespace

/// Takes the columns of body i through its joint, (8) and (9), two at a time; where nothing inboard moves,
/// (9) alone.
template <bool is_single>
void Columns::carry_range(std::size_t i, const BodySweep& sweep, bool goes_on) noexcept {
  const Range& range = ranges_[i];
  const double root = sweep.root_D_inverse;
  double* const axis = W.data() + dimension_of_[i];
  const Eigen::Index stride = W.outerStride();
  const auto write = [&](int place, double number) {
    double& entry = axis[row_of_[index(place)] * stride];
    entry = is_single ? number : entry + number;
  };
  const Factor S(sweep.S), factor(sweep.UD);
  double* A = A_.data() + 6 * range.first;
  int k = range.first;
  for (; k + 2 <= range.last; k += 2, A += 12) {
    const Two one = terms(S, A), other = terms(S, A + 6);
    const Two along = Two{one[0], other[0]} + Two{one[1], other[1]};
    const Two whitened = along * root, less = -along;
    write(k, whitened[0]);
    write(k + 1, whitened[1]);
    if (!goes_on) continue;
    solver::add(factor, less[0], A);
    solver::add(factor, less[1], A + 6);
  }
  if (k < range.last) {
    const Two both = terms(S, A);
    const double along = both[0] + both[1];
    write(k, root * along);
    if (goes_on) solver::add(factor, -along, A);
  }
  if (range.joint >= 0) {
    A_.col(range.joint) = -sweep.UD;
    axis[row_of_[index(range.joint)] * stride] = root;
  }
}

void Columns::carry(std::size_t i, const BodySweep& sweep, bool goes_on) noexcept {
  if (rows_ == 0 || ranges_[i].first == ranges_[i].last) return;
  is_single_ ? carry_range<true>(i, sweep, goes_on) : carry_range<false>(i, sweep, goes_on);
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
