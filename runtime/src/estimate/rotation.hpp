/// The check whether a measured matrix is a rotation.
#pragma once

#include "zwang/solver/spatial.hpp"

namespace zwang::runtime {

/// R R' = I to a thousandth, with det R = 1: a quaternion that was not normalised gives something else, which
/// stretches and turns what is seen. NaN fails; in Eigen's maxCoeff() it may not.
inline bool is_rotation(const solver::Matrix3& R) noexcept {
  constexpr double rounding = 1e-3;  // a quaternion of four decimals has 2e-4
  const solver::Matrix3 square = R * R.transpose();
  return ((square - solver::Matrix3::Identity()).array().abs() <= rounding).all() && R.determinant() > 0.0;
}

}  // namespace zwang::runtime
