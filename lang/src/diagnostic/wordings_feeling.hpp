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

}  // namespace zwang::lang::wording
