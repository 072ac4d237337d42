/// What every entry of the solver asks of its input before it touches anything.
#pragma once

#include <Eigen/Core>

#include "pairs.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

/// 0 where every number is finite, else NaN: infinity times 0 is NaN, and a NaN stays one in every sum.
template <class Derived>
double finite_sum(const Eigen::MatrixBase<Derived>& numbers) {
  return (numbers * 0.0).sum();
}

inline bool is_finite(const MotionVector& v) {
  return finite_sum(v.angular) + finite_sum(v.linear) == 0.0;
}
inline bool is_finite(const ForceVector& f) {
  return finite_sum(f.angular) + finite_sum(f.linear) == 0.0;
}

/// The same, of `count` numbers side by side.
inline double finite_sum(const double* numbers, std::size_t count) {
  Eigen::Array2d sum = Eigen::Array2d::Zero();
  std::size_t k = 0;
  for (; k + 2 <= count; k += 2) sum += ConstPair(numbers + k) * 0.0;
  const double rest = k < count ? numbers[k] * 0.0 : 0.0;
  return sum(0) + sum(1) + rest;
}

inline double finite_sum(const Eigen::VectorXd& numbers) {
  return finite_sum(numbers.data(), static_cast<std::size_t>(numbers.size()));
}

inline bool is_finite(const State& state) {
  static_assert(sizeof(ForceVector) == 6 * sizeof(double));  // so that the wrenches lie side by side
  double sum = finite_sum(state.q) + finite_sum(state.qd) + finite_sum(state.tau_ff) +
               finite_sum(state.base_pose.rotation) + finite_sum(state.base_pose.position) +
               finite_sum(state.base_twist.angular) + finite_sum(state.base_twist.linear);
  if (!state.f_ext.empty()) sum += finite_sum(state.f_ext.front().angular.data(), 6 * state.f_ext.size());
  return sum == 0.0;
}

inline bool fits(const State& state, const Model& model) {
  return state.q.size() == model.joint_count() && state.qd.size() == model.joint_count() &&
         state.tau_ff.size() == model.joint_count() &&
         state.f_ext.size() == static_cast<std::size_t>(model.body_count());
}

inline bool is_body(int body, const Model& model) {
  return body >= 0 && body < model.body_count();
}

}  // namespace zwang::solver
