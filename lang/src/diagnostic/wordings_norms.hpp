/// Diagnostics of norms in the plane.
#pragma once

#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// A way around a circle that `plane` does not allow.
struct Circle {
  double speed = 0.0;  ///< [m/s]
  double rate = 0.0;   ///< [rad/s]
  double most = 0.0;   ///< [m/s^2]
  std::string norm;    ///< "always.calm.plane"
};
Diagnostic circle_beyond_norm(const Span& span, const Circle& circle, const Span& norm);

/// Equal ranges of x and y.
struct Box {
  std::string x, y;  ///< paths
  bool is_force = false;
  double most = 0.0;  ///< [N] or [m/s^2]
};
Diagnostic box_for_norm(const Span& span, const Box& box, const Span& other);

}  // namespace zwang::lang::wording
