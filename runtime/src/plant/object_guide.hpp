/// The force of a hinge or a slide on the object that it carries. MuJoCo adds the limits of its range and its
/// damper, which stand in the simulation's text.
///
/// At the travel q the force is f = -p sign(q) - k q - b(q). The preload p presses towards 0, k is the
/// spring, and b is dry friction, a bristle.
#pragma once

#include "bristle.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::runtime {

class ObjectGuide {
 public:
  ObjectGuide() = default;
  /// `inertia`: what moves, about the hinge's axis [kg m^2] or along the slide [kg].
  ObjectGuide(const lang::Guide& guide, double inertia);

  /// [N m] or [N] at the travel `q` and its rate; moves the bristle by one step of `period` [s].
  double step(double q, double rate, double period) noexcept;

 private:
  lang::Guide guide_;
  double side_ = 0.0;  ///< of 0 on which the range lies; 0: on both
  Bristle bristle_;
};

}  // namespace zwang::runtime
