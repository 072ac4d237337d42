/// What every entry of the solver asks of its input before it touches anything.
#pragma once

#include <algorithm>

#include "zwang/solver/state.hpp"

namespace zwang::solver {

inline bool is_finite(const MotionVector& v) {
  return v.angular.allFinite() && v.linear.allFinite();
}
inline bool is_finite(const ForceVector& f) {
  return f.angular.allFinite() && f.linear.allFinite();
}

inline bool is_finite(const State& state) {
  return state.q.allFinite() && state.qd.allFinite() && state.tau_ff.allFinite() &&
         state.base_pose.rotation.allFinite() && state.base_pose.position.allFinite() &&
         is_finite(state.base_twist) &&
         std::all_of(state.f_ext.begin(), state.f_ext.end(),
                     [](const ForceVector& f) { return is_finite(f); });
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
