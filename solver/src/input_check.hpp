/// The checks that every entry of the solver makes of its input before it changes anything.
#pragma once

#include <Eigen/Core>

#include "linear/pairs.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

/// 0 where every number is finite, else NaN: infinity times 0 is NaN, and a NaN stays one in every sum.
template <class Derived>
double finite_sum(const Eigen::MatrixBase<Derived>& numbers) {
  return (numbers * 0.0).sum();
}

/// The same, of `count` numbers side by side.
inline double finite_sum(const double* numbers, std::size_t count) {
  Two sum = {}, other = {};  // neither waits for the other
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    sum += two(numbers + k) * 0.0;
    other += two(numbers + k + 2) * 0.0;
  }
  sum += other;
  for (; k + 2 <= count; k += 2) sum += two(numbers + k) * 0.0;
  const double rest = k < count ? numbers[k] * 0.0 : 0.0;
  return sum[0] + sum[1] + rest;
}

inline double finite_sum(const Eigen::VectorXd& numbers) {
  return finite_sum(numbers.data(), static_cast<std::size_t>(numbers.size()));
}

static_assert(sizeof(ForceVector) == 6 * sizeof(double));  // so that its numbers lie side by side

/// Of the forces of a row.
template <class BodyRow>
bool has_finite_axis(const BodyRow& row) {
  const double* const a = row.a.angular.data();
  const double* const other = row.a_reference.angular.data();
  const Two sum = two(a) * 0.0 + two(a + 2) * 0.0 + two(a + 4) * 0.0 + two(other) * 0.0 +
                  two(other + 2) * 0.0 + two(other + 4) * 0.0;
  return sum[0] + sum[1] == 0.0;
}

inline bool is_finite(const State& state) {
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
