/// Between points of space and points of the plane.
#pragma once

#include <Eigen/Core>

#include "zwang/solver/spatial.hpp"

namespace zwang::runtime {

inline Eigen::Vector2d flat(const solver::Vector3& v) {
  return v.head<2>();
}

inline solver::Vector3 high(const Eigen::Vector2d& v) {
  return {v.x(), v.y(), 0.0};
}

}  // namespace zwang::runtime
