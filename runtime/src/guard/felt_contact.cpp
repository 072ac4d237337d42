#include "guard/felt_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zwang::runtime {

namespace {

constexpr int rounds = 20;       // of projecting on one wrench after the other: they hardly differ
constexpr double tiny = 1e-12;   // of a norm
constexpr double little = 1e-3;  // of an acceleration: what rounding leaves of it

void add(double low_pass, double gap, const Eigen::VectorXd& value, Eigen::VectorXd& mean) {
  mean += (1.0 - std::exp(-gap / low_pass)) * (value - mean);
}

}  // namespace

FeltContact::FeltContact(const BlindMotion& motion) {
  w_ = w_mean_ = w_told_ = w_now_ = w_found_ = Eigen::VectorXd::Zero(motion.wrench_size());
  first_ = second_ = rest_ = force_ = Eigen::VectorXd::Zero(motion.most_freedoms());
}

void FeltContact::forget() noexcept {
  w_.setZero();
  w_mean_.setZero();
  w_told_.setZero();
  weight_ = rate_error_ = older_error_ = 0.0;
  is_felt_ = is_found_ = false;
}

void FeltContact::find(BlindMotion& motion, const Eigen::VectorXd& p) noexcept {
  motion.to_wrench(p, w_found_);
  is_found_ = w_found_.allFinite();
}

void FeltContact::tie(double x, double y) noexcept {
  is_tied_ = true;
  hook_x_ = x;
  hook_y_ = y;
}

double FeltContact::least_force(const BlindMotion& motion) const noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < motion.joints().size(); ++i) {
    const double effort = motion.joints()[i].effort;
    if (effort > 0.0) least = std::min(least, smallest * effort * motion.norm_of_row(i));
  }
  return least;
}

/// A rate over `gap` has an error e <= step / gap. The low pass of the error's differences is
///   w = (1 - b) w + b (e - e_last) / gap,   b = 1 - exp(-gap / quick).
/// It equals c e + older with c = b / gap and older = (1 - b) older_last + ((1 - b) c_last - c) e_last. Each
/// error comes in once with either sign, so even counts add up to little.
double FeltContact::force_of_steps(const BlindMotion& motion, double gap, double step) noexcept {
  const double b = 1.0 - std::exp(-gap / quick), c = b / gap;
  older_error_ = (1.0 - b) * older_error_ + std::abs((1.0 - b) * weight_ - c) * rate_error_;
  weight_ = c;
  rate_error_ = step / gap;
  const double acceleration = c * rate_error_ + older_error_;
  double force = 0.0;
  for (std::size_t i = 0; i < motion.joints().size(); ++i) {
    const double radius = motion.joints()[i].radius, row = motion.norm_of_row(i);
    if (radius > 0.0 && row > 0.0) force = std::max(force, acceleration / (radius * row));
  }
  return force;
}

void FeltContact::learn(BlindMotion& motion, const Eigen::VectorXd& p, const Eigen::VectorXd& told,
                        double gap, double step) noexcept {
  const int m = motion.freedoms();
  const double of_steps = force_of_steps(motion, gap, step);
  motion.to_wrench(p, w_now_);
  if (!w_now_.allFinite()) return forget();
  add(quick, gap, w_now_, w_);
  add(slow, gap, w_now_, w_mean_);
  motion.to_wrench(told, w_now_);
  add(quick, gap, w_now_, w_told_);
  motion.to_force(w_, force_);
  const double felt = force_.head(m).norm();
  motion.to_force(w_told_, force_);
  is_felt_ = felt > share * force_.head(m).norm() && felt > least_force(motion) && felt > of_steps;
}

/// Reduces `y` to the motion that is left when the world pushes along `first_` and `second_` as needed.
void FeltContact::hold(int m, Eigen::VectorXd& y) noexcept {
  double first = 0.0, second = 0.0;
  for (int i = 0; i < rounds; ++i) {
    const double more = std::max(-first, -dot(y.data(), first_.data(), m));
    first += more;
    y.head(m) += more * first_.head(m);
    const double again = std::max(-second, -dot(y.data(), second_.data(), m));
    second += again;
    y.head(m) += again * second_.head(m);
  }
}

/// Less what moves the hook: y - J' (J J')^-1 J y.
void FeltContact::hold_hook(const BlindMotion& motion, Eigen::VectorXd& y) noexcept {
  const int m = motion.freedoms();
  const Eigen::MatrixXd& B = motion.base();
  first_.head(m) = (B.row(0).head(m) - hook_y_ * B.row(2).head(m)).transpose();
  second_.head(m) = (B.row(1).head(m) + hook_x_ * B.row(2).head(m)).transpose();
  // Orthonormal, the longer one first.
  if (second_.head(m).norm() > first_.head(m).norm()) first_.swap(second_);
  const double longest = first_.head(m).norm();
  if (longest < tiny) return;
  first_.head(m) /= longest;
  second_.head(m) -= dot(second_.data(), first_.data(), m) * first_.head(m);
  const double other = second_.head(m).norm();
  y.head(m) -= dot(y.data(), first_.data(), m) * first_.head(m);
  if (other < little * longest) return;
  second_.head(m) /= other;
  y.head(m) -= dot(y.data(), second_.data(), m) * second_.head(m);
}

void FeltContact::step(const BlindMotion& motion, double dt, Eigen::VectorXd& y) noexcept {
  const int m = motion.freedoms();
  const Eigen::VectorXd& a = motion.acceleration();
  if (!is_tied_ && !is_felt_ && !is_found_) {
    y.head(m) += dt * a.head(m);
    return;
  }
  rest_.head(m) = a.head(m);
  if (is_tied_) {
    hold_hook(motion, rest_);
    hold_hook(motion, y);
  } else {
    motion.to_force(is_felt_ ? w_ : w_found_, first_);
    motion.to_force(is_found_ ? w_found_ : w_mean_, second_);
    first_.head(m) /= std::max(tiny, first_.head(m).norm());
    second_.head(m) /= std::max(tiny, second_.head(m).norm());
    hold(m, rest_);
  }
  const double left = rest_.head(m).norm();
  const double held = (a.head(m) - rest_.head(m)).norm();
  if (left > little * a.head(m).norm())
    y.head(m) += std::max(0.0, 1.0 - widening * held / left) * dt * rest_.head(m);
  if (!is_tied_) hold(m, y);
}

}  // namespace zwang::runtime
