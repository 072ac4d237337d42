/// The statics of a base: what it stands on, where its mass is, and what tips it over.
#pragma once

#include <optional>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang {

/// [rad] 0.5 deg: floors that count as level lean by 0.3 deg, and masses are known to a few millimetres.
inline constexpr double least_lean = 0.5 * 3.14159265358979 / 180.0;

inline constexpr double rounding_of_places = 1e-6;  ///< [m] of places in a file

/// At the start posture, on a level floor, in the axes of the base frame.
struct ZWANG_EXPORT Footing {
  std::vector<solver::Vector3> points;  ///< [m] where wheels, then supports, meet the floor
  std::size_t wheels = 0;               ///< how many of the points are wheels, in the model's order
  solver::Vector3 centre;               ///< [m] of the whole robot's mass
  double mass = 0.0;                    ///< [kg]
  double weight = 0.0;                  ///< [N]
  double height = 0.0;                  ///< [m] of the centre above the floor
  /// [m] from the centre of mass to the nearest edge of the hull of the points, in the plane; negative
  /// outside of it. Points on a line have no inside.
  double inside = 0.0;

  /// [rad] By so much a floor may lean before the base tips over: atan(inside / height). Below 0 it falls as
  /// it stands.
  double lean() const;
  /// Whether a floor as level as builders make it, within `least_lean`, tips the base over.
  bool is_on_edge() const;
  /// The largest acceleration [m/s^2] along `direction`, a unit vector in the plane, that lifts no point.
  /// Beyond it the base tips over an edge behind: a h > g d, d from the centre to that edge.
  double tipping_acceleration(const solver::Vector3& direction) const;
  /// The largest deceleration [m/s^2] along x, either way, and along y of a base that `goes_sideways`.
  double tipping_deceleration(bool goes_sideways) const;
  /// The largest force [N] with which it may push along `direction` at a height [m] above the floor. It tips
  /// over an edge behind where F z > m g d.
  double tipping_push(const solver::Vector3& direction, double height_of_push) const;
  /// The largest sum of shares_i N_i [N] that statics allow, N_i >= 0 the load of point i. Three points have
  /// one load each; of more, the loads depend on how the wheels give way.
  double most_carried(const std::vector<double>& shares) const;

 private:
  /// [m] d over the share of the direction that leads away from the edge; the least of all edges behind.
  double arm_behind(const solver::Vector3& direction) const;
};

/// None of a robot that does not stand on wheels. Two wheels without supports stand on the corners of the
/// footprint, too.
ZWANG_EXPORT std::optional<Footing> footing_of(const Robot& robot);

}  // namespace zwang::lang
