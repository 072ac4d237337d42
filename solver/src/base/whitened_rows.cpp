#include "base/whitened_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linear/pairs.hpp"

namespace zwang::solver {

WhitenedRows::WhitenedRows(const Columns& robot, const Columns& task, const LeastShares& least)
    : task_(&task),
      least_(least),
      N_(RowMajorMatrix::Zero(robot.ground_end(), robot.ground_end())),
      Q_held_(RowMajorMatrix::Zero(robot.ground_end(), spaced(robot.ground_end()))),
      B_(RowMajorMatrix::Zero(task.W.rows(), task.W.cols())),
      reflections_(RowMajorMatrix::Zero(robot.ground_end(), spaced(robot.ground_end()))),
      scale_(Eigen::VectorXd::Zero(robot.ground_end())),
      left_(Eigen::VectorXd::Zero(robot.drift.size())),
      size_(Eigen::VectorXd::Zero(robot.drift.size())),
      held_motion_(Eigen::VectorXd::Zero(robot.dimensions() + 1)),
      unit_(held_motion_),
      free_part_(held_motion_),
      solution_(held_motion_),
      inverse_pivots_(held_motion_),
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
  turn_robot_from(ground);
  find_Q();
}

/// The lines of this row and those behind it. One reflection after the other, as a line has to wait for each.
void WhitenedRows::turn_robot_from(int row) noexcept {
  const int count = robot_->rows();
  for (int k = 0; k < rank_; ++k) {
    int i = row;
    for (; i + 2 <= count; i += 2) turn_two(k, &robot_->W(i, 0), &robot_->W(i + 1, 0));
    if (i < count) turn(k, &robot_->W(i, 0));
  }
}

/// The turned axes in the dimensions, Q = [ Q_held, N ]: a unit along each, turned back by the reflections
/// that reach it.
void WhitenedRows::find_Q() noexcept {
  for (int c = 0; c < rank_; ++c) {
    double* const q = &Q_held_(c, 0);
    set_zero(static_cast<int>(Q_held_.cols()), q);
    q[base_ + c] = 1.0;
    for (int k = c; k >= 0; --k) turn(k, q);
    const int row = pivots_[static_cast<std::size_t>(c)];
    inverse_pivots_(c) = 1.0 / robot_->W(row, base_ + c);
  }
  for (int c = 0; rank_ > 0 && c < free_of_ground(); ++c) {
    unit_.setZero();
    unit_(held_ + c) = 1.0;
    for (int k = rank_ - 1; k >= 0; --k) turn(k, unit_.data());
    for (int k = 0; k < ground_end_; ++k) N_(k, c) = unit_(k);
  }
}

/// B_i = W_i N. (N is 0 in the dimensions of the base that the ground holds; W_i mostly in those of the
/// wheels.)
void WhitenedRows::project_task() noexcept {
  if (rank_ == 0) {
    first_B_ = task_->W.data() + held_;
    B_stride_ = task_->W.outerStride();
    return;
  }
  first_B_ = B_.data();
  B_stride_ = B_.outerStride();
  const int free = free_of_ground();
  for (int i = 0; i < task_->rows(); ++i) {
    const double* const W = line(i);
    double* const B = &B_(i, 0);
    int last = ground_end_;
    while (last > base_ && W[last - 1] == 0.0) --last;
    combine_lines(last - base_, W + base_, &N_(base_, 0), N_.outerStride(), free, B);
    copy(mobility() - free, W + ground_end_, B + free);
    B[mobility()] = 0.0;
  }
}

/// The next row if the pivots so far leave an ample share of it; else the one of which they leave the
/// largest, and -1 when none has one.
int WhitenedRows::next_pivot(int ground) const noexcept {
  constexpr double ample = 0.1;
  int pivot = -1;
  double best = least_.of_ground;
  for (int k = rank_; k < ground; ++k) {
    const int row = pivots_[static_cast<std::size_t>(k)];
    if (!(left_(row) > best * size_(row))) continue;
    best = left_(row) / size_(row);
    pivot = k;
    if (k == rank_ && best > ample) return k;
  }
  return pivot;
}

/// Turns the axes from `first` to the ground's end, so that x, the pivot's line, lies on the first of them:
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

/// Two lines, or two vectors by dimension, under a reflection.
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
  const double* const h = free_motion.data();
  double* const x = held_motion_.data();
  hold(bias, base_motion);
  copy(dimensions_ - ground_end_, h + ground_end_, x + ground_end_);
  const int free = free_of_ground();
  if (rank_ == 0) {
    copy(free, h + held_, x + held_);
    return;
  }
  const int turned = ground_end_ - base_;
  double* const along = free_part_.data();  // N'h
  combine_lines(turned, h + base_, &N_(base_, 0), N_.outerStride(), free, along);
  for (int k = base_; k < ground_end_; ++k) x[k] += dot(free, &N_(k, 0), along);
}

void WhitenedRows::hold_ground_at_rest(const Eigen::VectorXd& bias, const Vector3& base_motion) noexcept {
  hold(bias, base_motion);
  set_zero(dimensions_ - ground_end_, held_motion_.data() + ground_end_);
}

/// The held part of the motion: the base's own, and Q_held x. x is the solution of the triangle for the
/// biases.
void WhitenedRows::hold(const Eigen::VectorXd& bias, const Vector3& base_motion) noexcept {
  double* const solution = solution_.data();
  for (int c = 0; c < base_; ++c) solution[c] = base_motion(c);
  for (int c = 0; c < rank_; ++c) {
    const int row = pivots_[static_cast<std::size_t>(c)];
    const double rest = bias(row) - dot(base_ + c, &robot_->W(row, 0), solution);
    solution[base_ + c] = rest * inverse_pivots_(c);
  }
  double* const x = held_motion_.data();
  combine_lines(rank_, solution + base_, Q_held_.data(), Q_held_.outerStride(), ground_end_, x);
  copy(base_, solution, x);
}

void WhitenedRows::add_up(const double* f, double* p) const noexcept {
  combine_lines(task_->rows(), f, first_B_, B_stride_, mobility(), p);
}

/// held motion + N p
void WhitenedRows::motion(const double* p, Eigen::VectorXd& motion) const noexcept {
  double* const x = motion.data();
  copy(dimensions_, held_motion_.data(), x);
  if (p == nullptr) return;
  const int free = rank_ > 0 ? free_of_ground() : 0;
  if (free > 0) {
    for (int k = base_; k < ground_end_; ++k) x[k] += dot(free, &N_(k, 0), p);
  }
  add_multiple(mobility() - free, 1.0, p + free, x + held_ + free);
}

}  // namespace zwang::solver
