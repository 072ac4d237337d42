// The torques of least norm that make a motion, for BoundedProblem.
#include <algorithm>

#include "base/bounded_problem.hpp"

namespace zwang::solver {

/// Into candidate_; false beyond a limit.
inline bool BoundedProblem::take_torque(int motor, double torque) noexcept {
  const double lowest = tau_lo_(motor), highest = tau_hi_(motor), slack = tau_slack_(motor);
  if (torque < lowest - slack || torque > highest + slack) return false;
  candidate_(motor) = std::clamp(torque, lowest, highest);
  return true;
}

/// Least-norm torques for p into candidate_: those of the sole motors one after the other, then tau = T
/// (T'T)^-1 p. False when the motors do not reach p or a limit is in the way.
bool BoundedProblem::torques_for(const Vector& p) noexcept {
  if (!motors_reach_all_) return false;
  solver::copy(dimension_, p.data(), solved_.data());
  double* const rest = solved_.data();
  int open = dimension_;
  for (const Sole& sole : soles_) {
    const double torque = rest[--open] * sole.inverse;
    if (!take_torque(sole.motor, torque)) return false;
    add_multiple(open, -torque, T(sole.motor), rest);
  }
  return shared_dimensions_ == 3 ? share_three(rest) : share(rest);
}

/// tau = T (W' D^-1 W) p of the shared motors, no sum waiting for another one. Writes over p.
bool BoundedProblem::share(double* rest) noexcept {
  for (int k = shared_dimensions_ - 1; k >= 0; --k) {
    double sum = rest[k];
    for (int c = 0; c < k; ++c) sum += gram_(k, c) * rest[c];
    rest[k] = sum * inverse_pivots_(k);
  }
  for (int c = 0; c < shared_dimensions_; ++c) {
    for (int k = c + 1; k < shared_dimensions_; ++k) rest[c] += gram_(k, c) * rest[k];
  }
  for (const int j : shared_motors_) {
    const double* const own = T(j);
    const int extent = motor_extents_[static_cast<std::size_t>(j)];
    double torque = 0.0;  // number by number, as they were written
    for (int k = 0; k < extent; ++k) torque += own[k] * rest[k];
    if (!take_torque(j, torque)) return false;
  }
  return true;
}

/// The torques of least norm for the three motions of a base that goes everywhere.
bool BoundedProblem::share_three(const double* p) noexcept {
  const double W10 = gram_(1, 0), W20 = gram_(2, 0), W21 = gram_(2, 1);
  const double y = (p[1] + W10 * p[0]) * inverse_pivots_(1);
  const double z = (p[2] + W20 * p[0] + W21 * p[1]) * inverse_pivots_(2);
  const double x0 = p[0] * inverse_pivots_(0) + W10 * y + W20 * z;
  const double x1 = y + W21 * z;
  for (const int j : shared_motors_) {
    const double* const own = T(j);
    if (!take_torque(j, own[0] * x0 + own[1] * x1 + own[2] * z)) return false;
  }
  return true;
}

}  // namespace zwang::solver
