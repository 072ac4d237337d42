/// Diagnostics of measured and estimated forces, and of the drivers that follow them.
#pragma once

#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// `estimated.goal.x` of a frame that no link carries.
Diagnostic wrench_on_the_world(const Span& span, const std::string& frame);
/// `estimated.base.z`: the floor bears it, and no motor feels it.
Diagnostic wrench_that_the_floor_bears(const Span& span, const std::string& name);

Diagnostic yield_with_time_constant(const Span& span, const std::string& axis);
/// `build_up` beside a driver that has no error to add up, or beside none.
Diagnostic build_up_without_driver(const Span& span, const std::string& axis);
Diagnostic build_up_with_spring(const Span& span, const std::string& axis);
Diagnostic builds_up_too_fast(const Span& span, const std::string& axis, double time_constant, double least);

/// A yield, held by something stiff.
struct Ringing {
  double stiffest = 0.0;  ///< [N/m] of what it still holds
  double mass = 0.0;      ///< [kg] effective
  double lag = 0.0;       ///< [s] of the force
  double enough = 0.0;    ///< [kg] that holds anything
};
Diagnostic rings_when_held(const Span& span, const std::string& axis, const Ringing& ringing, bool is_error);

/// A yield with a force range below its dead band. [N] or [N m]
struct BandNotHeld {
  double dead_band = 0.0;
  double held = 0.0;  ///< by the force range, or by the motors
  Span dead_band_span;
  bool is_of_motors = false;
};
Diagnostic dead_band_not_held(const Span& span, const std::string& axis, bool turns, const BandNotHeld& band);

/// A spring that swings.
struct Swinging {
  double mass = 0.0;    ///< [kg] or [kg m^2] effective
  double left = 0.0;    ///< share of a swing at the timeout
  double time = 0.0;    ///< [s] until then
  double enough = 0.0;  ///< [N s/m] or [N m s/rad] without a swing
};
Diagnostic swings_on(const Span& span, const std::string& axis, bool turns, const Swinging& swinging);

/// A target that moves on while its signal is taken to stand.
struct Trailed {
  double speed = 0.0;     ///< [m/s] or [rad/s] of the target
  double distance = 0.0;  ///< [m] or [rad] that it is trailed by
  bool turns = false;
  std::string signal;
};
Diagnostic trails_its_target(const Span& span, const std::string& axis, const Trailed& trailed,
                             const Span& declared);

/// A yield along an axis that is not the one along which its force is measured.
struct Across {
  std::string in;         ///< whose axes the group has
  std::string force;      ///< whose axes the force has
  double at_start = 0.0;  ///< [rad] between the two; 0: not known, or together at the start
};
Diagnostic yields_across(const Span& span, const std::string& axis, const Across& across);

/// `twist` of a signal that is no pose.
Diagnostic twist_without_pose(const Span& span, const std::string& signal);
/// Two forces along one motion, of which `left` is left. [N] or [N m]
Diagnostic push_against(const Span& span, const std::string& one, const std::string& other, bool turns,
                        double left, const Span& other_span);

}  // namespace zwang::lang::wording
