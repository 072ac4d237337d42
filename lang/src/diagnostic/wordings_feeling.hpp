/// Wordings about `feels`: what tells a robot of contacts, and how late.
#pragma once

#include <optional>
#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

Diagnostic feels_twice(const Span& span);
Diagnostic feels_nothing(const Span& span);
Diagnostic feels_beside_torques(const Span& span);
Diagnostic feels_on_a_joint(const Span& span, const std::string& frame);
/// `after` [s] all lags together; `longest` [s] the delay that would do, none where a shorter one does not
/// help.
Diagnostic feels_too_late(const Span& span, double after, std::optional<double> longest);
/// `fades` [1/s]: the force over the mass is the speed times it.
Diagnostic slow_in_contact(const Span& span, double fades, double mass);

/// A heading that a wall turns, behind a drive that feels.
struct SlowTurn {
  std::string axis;
  double asked = 0.0;  ///< [rad/s] below which the exit takes it for square
  double turns = 0.0;  ///< [rad/s] what the wall turns it with
  double force = 0.0;  ///< [N] that it is pressed with
  double askew = 0.0;  ///< [rad]
};
Diagnostic turned_slowly(const Span& exit, const SlowTurn& turn, const Span& push);

}  // namespace zwang::lang::wording
