/// Numbers as text.
#pragma once

#include <string>
#include <string_view>

#include "zwang/export.hpp"

namespace zwang::runtime {

/// `0.080 m/s`; angles in degrees. `digits` are significant ones.
ZWANG_EXPORT std::string with_unit(double value, std::string_view si_unit, int digits = 4);

/// The shortest text that has every bit of the number.
ZWANG_EXPORT std::string exactly(double value);

}  // namespace zwang::runtime
