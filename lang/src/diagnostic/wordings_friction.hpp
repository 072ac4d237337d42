/// W649: drivers that dry friction holds.
#pragma once

#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

struct HeldByFriction {
  std::string axis;
  bool turns = false;
  double force = 0.0;          ///< that the driver makes from rest [N] or [N m]
  double held = 0.0;           ///< by the wheels' friction [N] or [N m]
  double time_constant = 0.0;  ///< [s] with which a velocity makes as much; 0: of another driver
};
Diagnostic held_by_friction(const Span& span, const HeldByFriction& held);

}  // namespace zwang::lang::wording
