/// Means over 20 ms of how a base speeds up and how hard it pushes, hits left out.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace zwang::runtime {

/// The acceleration of the base's origin and the planar sum of its contact forces. Both are norms of their
/// means over 20 ms:
///     a = |v(t) - v(t - T)| / T,   F = |sum f_i| / n,   T = n h = 20 ms.
/// No controller bounds a hit, so no hit counts: both keep their values while a hit falls into the 20 ms.
/// Before the first 20 ms they are 0.
class QuietMeans {
 public:
  explicit QuietMeans(double period);

  /// Once a step, at its end. `velocity` [m/s] of the base's origin and `push` [N] in world axes; `is_hit`:
  /// the step belongs to a hit.
  void look(const Eigen::Vector2d& velocity, const Eigen::Vector2d& push, bool is_hit) noexcept;

  double acceleration() const noexcept { return acceleration_; }  ///< [m/s^2]
  double push() const noexcept { return push_; }                  ///< [N]

 private:
  std::size_t length_;                       ///< n, steps of 20 ms
  double period_;                            ///< h [s]
  std::vector<Eigen::Vector2d> velocities_;  ///< a ring of n
  std::vector<Eigen::Vector2d> pushes_;      ///< a ring of n
  std::size_t steps_ = 0;
  std::size_t quiet_steps_ = 0;  ///< without a hit, up to now
  double acceleration_ = 0.0, push_ = 0.0;
};

}  // namespace zwang::runtime
