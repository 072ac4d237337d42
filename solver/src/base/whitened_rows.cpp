#include "base/whitened_rows.hpp"

#include <cmath>
#include <utility>

#include "pairs.hpp"

namespace zwang::solver {

WhitenedRows::WhitenedRows(const Columns& columns)
    : reflections_(RowMajorMatrix::Zero(columns.ground_end(), spaced(columns.ground_end()))),
      scale_(Eigen::VectorXd::Zero(columns.ground_end())),
      left_(Eigen::VectorXd::Zero(columns.g.size())),
      size_(Eigen::VectorXd::Zero(columns.g.size())),
      held_force_(Eigen::VectorXd::Zero(columns.dimensions())),
      pivots_(static_cast<std::size_t>(columns.g.size())),
      dimensions_(columns.dimensions()),
      ground_end_(columns.ground_end()),
      base_(columns.held_dimensions()) {}

void WhitenedRows::factorise(Columns& columns, int ground) noexcept {
  W_ = &columns.W;
  rank_ = 0;
  for (int i = 0; i < ground; ++i) {
    pivots_[static_cast<std::size_t>(i)] = i;
    left_(i) = dot(ground_end_ - base_, line(i) + base_, line(i) + base_);
    size_(i) = left_(i) + dot(base_, line(i), line(i));
  }
  while (base_ + rank_ < ground_end_) {
    const int k = next_pivot(ground);
    if (k < 0) break;
    std::swap(pivots_[static_cast<std::size_t>(rank_)], pivots_[static_cast<std::size_t>(k)]);
    reflect(columns, pivots_[static_cast<std::size_t>(rank_)], base_ + rank_, ground);
    ++rank_;
  }
  held_ = base_ + rank_;
}

/// The next row if the pivots so far leave an ample share of it; else the one of which they leave the
/// largest, and -1 when none has one.
int WhitenedRows::next_pivot(int ground) const noexcept {
  constexpr double ample = 0.1;
  int pivot = -1;
  double best = ground_tolerance;
  for (int k = rank_; k < ground; ++k) {
    const int row = pivots_[static_cast<std::size_t>(k)];
    if (!(left_(row) > best * size_(row))) continue;
    best = left_(row) / size_(row);
    pivot = k;
    if (k == rank_ && best > ample) return k;
  }
  return pivot;
}

/// Turns the axes from `first` to the ground's end so that x, the pivot's line there, lies on the first of
/// them:
///   v = x + sign(x_0) |x| e_0        y -= (v.y) 2 / v.v  v        for the lines y of the other rows
/// v has zeros around it, so that every loop goes over whole pairs.
void WhitenedRows::reflect(Columns& columns, int pivot, int first, int ground) noexcept {
  double* const v = &reflections_(rank_, 0);
  double* const x = &columns.W(pivot, 0);
  set_zero(first, v);
  for (int k = first; k < ground_end_; ++k) {
    v[k] = x[k];
    x[k] = 0.0;
  }
  const double length = std::sqrt(dot(ground_end_ - first, v + first, v + first));
  x[first] = v[first] > 0.0 ? -length : length;
  scale_(rank_) = 1.0 / (length * (length + std::abs(v[first])));
  v[first] -= x[first];
  for (int k = rank_ + 1; k < ground; ++k) {
    const int row = pivots_[static_cast<std::size_t>(k)];
    double* const y = &columns.W(row, 0);
    turn(rank_, y);
    left_(row) -= y[first] * y[first];
  }
  int row = ground;
  for (; row + 2 <= columns.rows(); row += 2) turn_two(rank_, &columns.W(row, 0), &columns.W(row + 1, 0));
  if (row < columns.rows()) turn(rank_, &columns.W(row, 0));
}

/// Line y, or any vector by dimension, under a reflection.
void WhitenedRows::turn(int reflection, double* y) const noexcept {
  const double* const v = &reflections_(reflection, 0);
  const int first = (base_ + reflection) & ~1;
  Eigen::Array2d sum = Eigen::Array2d::Zero();
  for (int k = first; k < ground_end_; k += 2) sum += ConstPair(v + k) * ConstPair(y + k);
  add_to_line(-scale_(reflection) * (sum(0) + sum(1)), v, first, ground_end_, y);
}

/// The same of two.
void WhitenedRows::turn_two(int reflection, double* one, double* other) const noexcept {
  const double* const v = &reflections_(reflection, 0);
  const double scale = -scale_(reflection);
  const int first = (base_ + reflection) & ~1;
  Eigen::Array2d sum = Eigen::Array2d::Zero(), other_sum = Eigen::Array2d::Zero();
  for (int k = first; k < ground_end_; k += 2) {
    const Eigen::Array2d pair = ConstPair(v + k);
    sum += pair * ConstPair(one + k);
    other_sum += pair * ConstPair(other + k);
  }
  add_to_two_lines(scale * (sum(0) + sum(1)), scale * (other_sum(0) + other_sum(1)), v, first, ground_end_,
                   one, other);
}

double WhitenedRows::free_share(int row) const noexcept {
  const double square = free_square(row);
  return square > 0.0 ? motion(row).squaredNorm() / square : 0.0;
}

void WhitenedRows::hold_ground(const Eigen::VectorXd& bias) noexcept {
  hold_ground(bias, Vector3::Zero());
}

void WhitenedRows::hold_ground(const Eigen::VectorXd& bias, const Vector3& base_force) noexcept {
  double* const y = held_force_.data();
  for (int c = 0; c < base_; ++c) y[c] = base_force(c);
  for (int c = base_; c < held_; ++c) {
    const int row = pivots_[static_cast<std::size_t>(c - base_)];
    double rest = bias(row);
    for (int k = 0; k < c; ++k) rest -= line(row)[k] * y[k];
    y[c] = rest / line(row)[c];
  }
}

/// The reflections backward. (`force` has a number to spare.)
void WhitenedRows::forces(const double* p, Eigen::VectorXd& force) const noexcept {
  double* const x = force.data();
  copy(held_, held_force_.data(), x);
  copy(mobility(), p, x + held_);
  for (int k = rank_ - 1; k >= 0; --k) turn(k, x);
}

}  // namespace zwang::solver
