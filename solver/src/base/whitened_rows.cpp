#include "base/whitened_rows.hpp"

#include <cmath>
#include <utility>

#include "pairs.hpp"

namespace zwang::solver {

WhitenedRows::WhitenedRows(const Columns& robot)
    : reflections_(RowMajorMatrix::Zero(robot.ground_end(), spaced(robot.ground_end()))),
      scale_(Eigen::VectorXd::Zero(robot.ground_end())),
      left_(Eigen::VectorXd::Zero(robot.drift.size())),
      size_(Eigen::VectorXd::Zero(robot.drift.size())),
      held_motion_(Eigen::VectorXd::Zero(robot.dimensions() + 1)),
      pivots_(static_cast<std::size_t>(robot.drift.size())),
      dimensions_(robot.dimensions()),
      ground_end_(robot.ground_end()),
      base_(robot.held_dimensions()) {}

void WhitenedRows::factorise(Columns& robot, int ground) noexcept {
  robot_ = &robot;
  rank_ = 0;
  for (int i = 0; i < ground; ++i) {
    const double* const line = &robot.W(i, 0);
    pivots_[static_cast<std::size_t>(i)] = i;
    left_(i) = dot(ground_end_ - base_, line + base_, line + base_);
    size_(i) = left_(i) + dot(base_, line, line);
  }
  while (base_ + rank_ < ground_end_) {
    const int k = next_pivot(ground);
    if (k < 0) break;
    std::swap(pivots_[static_cast<std::size_t>(rank_)], pivots_[static_cast<std::size_t>(k)]);
    reflect(pivots_[static_cast<std::size_t>(rank_)], base_ + rank_, ground);
    ++rank_;
  }
  held_ = base_ + rank_;
  turn_from(ground, robot);
}

void WhitenedRows::turn(Columns& task) noexcept {
  task_ = &task;
  turn_from(0, task);
}

/// The lines of this row and those behind it. One reflection after the other, as a line has to wait for each.
void WhitenedRows::turn_from(int row, Columns& rows) noexcept {
  const int count = rows.rows();
  for (int k = 0; k < rank_; ++k) {
    int i = row;
    for (; i + 2 <= count; i += 2) turn_two(k, &rows.W(i, 0), &rows.W(i + 1, 0));
    if (i < count) turn(k, &rows.W(i, 0));
  }
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
void WhitenedRows::reflect(int pivot, int first, int ground) noexcept {
  double* const v = &reflections_(rank_, 0);
  double* const x = &robot_->W(pivot, 0);
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
    double* const y = &robot_->W(row, 0);
    turn(rank_, y);
    left_(row) -= y[first] * y[first];
  }
}

/// Line y, or any vector by dimension, under a reflection.
void WhitenedRows::turn(int reflection, double* y) const noexcept {
  const double* const v = &reflections_(reflection, 0);
  const int first = (base_ + reflection) & ~1;
  Two sum = {};
  for (int k = first; k < ground_end_; k += 2) sum += two(v + k) * two(y + k);
  add_to_line(-scale_(reflection) * (sum[0] + sum[1]), v, first, ground_end_, y);
}

/// The same of two.
void WhitenedRows::turn_two(int reflection, double* one, double* other) const noexcept {
  const double* const v = &reflections_(reflection, 0);
  const double scale = -scale_(reflection);
  const int first = (base_ + reflection) & ~1;
  Two sum = {}, other_sum = {};
  for (int k = first; k < ground_end_; k += 2) {
    const Two pair = two(v + k);
    sum += pair * two(one + k);
    other_sum += pair * two(other + k);
  }
  add_to_two_lines(scale * (sum[0] + sum[1]), scale * (other_sum[0] + other_sum[1]), v, first, ground_end_,
                   one, other);
}

double WhitenedRows::free_share(int row) const noexcept {
  const double square = free_square(row);
  return square > 0.0 ? motion(row).squaredNorm() / square : 0.0;
}

void WhitenedRows::hold_ground(const Eigen::VectorXd& free_motion, const Eigen::VectorXd& bias,
                               const Vector3& base_motion) noexcept {
  copy(dimensions_, free_motion.data(), held_motion_.data());
  for (int k = 0; k < rank_; ++k) turn(k, held_motion_.data());
  hold(bias, base_motion);
}

void WhitenedRows::hold_ground_at_rest(const Eigen::VectorXd& bias, const Vector3& base_motion) noexcept {
  set_zero(dimensions_, held_motion_.data());
  hold(bias, base_motion);
}

/// The triangle, dimension by dimension.
void WhitenedRows::hold(const Eigen::VectorXd& bias, const Vector3& base_motion) noexcept {
  double* const x = held_motion_.data();
  for (int c = 0; c < base_; ++c) x[c] = base_motion(c);
  for (int c = base_; c < held_; ++c) {
    const int row = pivots_[static_cast<std::size_t>(c - base_)];
    const double* const line = &robot_->W(row, 0);
    double rest = bias(row);
    for (int k = 0; k < c; ++k) rest -= line[k] * x[k];
    x[c] = rest / line[c];
  }
}

/// Up to four sums at a time, in registers: in memory each addition would wait for the one before.
void WhitenedRows::add_up(const double* f, double* p) const noexcept {
  const int rows = task_->rows();
  const Eigen::Index stride = task_->W.outerStride();
  const int count = mobility();
  int k = 0;
  for (; k + 2 < count; k += 4) {
    const double* B = &task_->W(0, held_ + k);
    Eigen::Array2d sum = Eigen::Array2d::Zero(), next = Eigen::Array2d::Zero();
    for (int i = 0; i < rows; ++i, B += stride) {
      sum += f[i] * ConstPair(B);
      next += f[i] * ConstPair(B + 2);
    }
    Pair(p + k) = sum;
    Pair(p + k + 2) = next;
  }
  if (k >= count) return;
  const double* B = &task_->W(0, held_ + k);
  Eigen::Array2d sum = Eigen::Array2d::Zero();
  for (int i = 0; i < rows; ++i, B += stride) sum += f[i] * ConstPair(B);
  Pair(p + k) = sum;
}

/// The reflections backward.
void WhitenedRows::motion(const double* p, Eigen::VectorXd& motion) const noexcept {
  double* const x = motion.data();
  copy(dimensions_, held_motion_.data(), x);
  if (p != nullptr) add_multiple(mobility(), 1.0, p, x + held_);
  for (int k = rank_ - 1; k >= 0; --k) turn(k, x);
}

}  // namespace zwang::solver
