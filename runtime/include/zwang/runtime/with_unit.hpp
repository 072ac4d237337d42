/// Numbers as text.
#pragma once

#include <string>
#include <string_view>

namespace zwang::runtime {

/// `0.080 m/s`; angles in degrees. `digits` are significant ones.
std::string with_unit(double value, std::string_view si_unit, int digits = 4);

/// The shortest text that has every bit of the number.
std::string exactly(double value);

}  // namespace zwang::runtime
