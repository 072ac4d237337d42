/// Friction of wheels that slide sideways (skid steering). It is an elastic bristle that yields, the wheel's
/// own part of floor_friction.hpp. Along the wheel's axis, with stretch s, ds/dt = v,
///     f = -(k s + c v), |f| <= mu N, and |k s| <= mu N by cutting s.
/// N is the force that the floor carries the wheel with. The simulator's own contact holds the rolling
/// direction only: one of its contacts that slides lifts off and hops.
#pragma once

#include <vector>

#include "zwang/solver/model.hpp"

namespace zwang::runtime {

class SideFriction {
 public:
  /// Of every wheel that holds rolling and not sideways. `coefficient` mu.
  SideFriction(const solver::Model& model, double coefficient);

  bool empty() const noexcept { return wheels_.empty(); }
  /// Under all wheels, or under the one with this number in the model.
  void set_coefficient(double coefficient) noexcept;
  void set_coefficient(double coefficient, std::size_t wheel) noexcept;
  /// The wrench on the base, in base axes and about its origin, at the base's twist in the same. `loads` are
  /// the wheels' N by their number. Moves the bristles by one step of `period` [s].
  solver::ForceVector step(const solver::MotionVector& twist, const std::vector<double>& loads,
                           double period) noexcept;
  void reset() noexcept;

 private:
  struct Bristle {
    std::size_t wheel = 0;
    solver::Vector3 axis;     ///< in base axes
    solver::Vector3 contact;  ///< [m] in the base frame
    double coefficient = 0.0;
    double stretch = 0.0;  ///< [m]
  };
  std::vector<Bristle> wheels_;
  double stiffness_ = 0.0;  ///< k [N/m]
  double damping_ = 0.0;    ///< c [N s/m]
};

}  // namespace zwang::runtime
