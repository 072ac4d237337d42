/// Places of bodies in the base, and how the wheels stand while all joints are at 0.
#pragma once

#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::lang {

/// X_BaseBody where all joints are at 0.
ZWANG_EXPORT solver::Pose pose_in_base(const solver::Model& model, int body);
/// The same with the joints at `q`.
ZWANG_EXPORT solver::Pose pose_in_base(const solver::Model& model, int body, const Eigen::VectorXd& q);

/// How far wheels may end from their average; a simulation levels so much out. [m]
inline constexpr double least_wheel_lift = 0.002;
/// Of a radius: a tyre's tread, and how exact a tyre's radius is.
inline constexpr double wheel_lift_share = 0.02;

/// The heights of the wheels' lowest points in the base. [m]
struct WheelLevel {
  std::vector<double> ends;  ///< of each wheel of the model
  double mean = 0.0;         ///< where the ground is
  std::size_t lowest = 0, highest = 0;
  double most_lift = least_wheel_lift;  ///< [m] of the smallest wheel's radius

  /// By how much the highest ends above the lowest. [m]
  double spread() const { return ends[highest] - ends[lowest]; }
  bool is_level() const { return mean - ends[lowest] <= most_lift && ends[highest] - mean <= most_lift; }
};
/// The distance [m] along `heading` [rad] from the base's origin to the axle of plain wheels that do not
/// steer. The axle holds a wall's side force, and the base turns about it. 0: no wheel holds the base
/// sideways.
ZWANG_EXPORT double axle_ahead(const solver::Model& model, double heading);
/// Whether there is such an axle.
ZWANG_EXPORT bool has_axle(const solver::Model& model);

/// Of a model that has wheels.
ZWANG_EXPORT WheelLevel wheel_level(const solver::Model& model);

}  // namespace zwang::lang
