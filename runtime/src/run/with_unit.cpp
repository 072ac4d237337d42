#include "zwang/runtime/with_unit.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace zwang::runtime {

std::string exactly(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string with_unit(double value, std::string_view si_unit, int digits) {
  std::string unit(si_unit);
  if (unit.rfind("rad", 0) == 0) {
    value *= 180.0 / std::numbers::pi;
    unit.replace(0, 3, "deg");
  }
  // As many decimals as a number around 1 needs for `digits`; small values are shown as small, not as 1e-17.
  const double size = std::abs(value);
  int decimals = digits - 1;
  for (double bound = 10.0; size >= bound && decimals > 0; bound *= 10.0) --decimals;
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  std::string number = text;
  if (number.find_first_not_of("-0.") == std::string::npos && number[0] == '-') number.erase(0, 1);
  return number + " " + unit;
}

}  // namespace zwang::runtime
