#include "diagnostic/wordings_friction.hpp"

#include "diagnostic/axis_units.hpp"
#include "diagnostic/make.hpp"
#include "diagnostic/wordings_physics.hpp"

namespace zwang::lang::wording {

Diagnostic held_by_friction(const Span& span, const HeldByFriction& held) {
  const std::string unit = axis_units(held.turns).force;
  const std::string most = figure(held.held, unit);
  const std::string help = held.time_constant > 0.0
                               ? "write a `time_constant` below " + figure(held.time_constant, "s") +
                                     ", `build_up`, or a faster `velocity`"
                               : "ask for more than " + most;
  return warning("W649", span,
                 "from rest nothing moves: `" + held.axis + "` pushes with " + figure(held.force, unit) +
                     ", and the wheels' dry friction holds " + most,
                 help);
}

}  // namespace zwang::lang::wording
