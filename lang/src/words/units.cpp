#include "words/units.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "words/nearest.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

struct NamedUnit {
  std::string_view name;
  Dimension dimension;
  double scale;
};

// No offsets (temperatures) and no names that mean two things (rpm, l, t): they are refused.
constexpr std::array named_units{
    NamedUnit{"m", dimension::length, 1.0},
    NamedUnit{"cm", dimension::length, 0.01},
    NamedUnit{"mm", dimension::length, 0.001},
    NamedUnit{"um", dimension::length, 1e-6},
    NamedUnit{"km", dimension::length, 1000.0},
    NamedUnit{"kg", dimension::mass, 1.0},
    NamedUnit{"g", dimension::mass, 0.001},
    NamedUnit{"s", dimension::time, 1.0},
    NamedUnit{"ms", dimension::time, 0.001},
    NamedUnit{"us", dimension::time, 1e-6},
    NamedUnit{"min", dimension::time, 60.0},
    NamedUnit{"h", dimension::time, 3600.0},
    NamedUnit{"rad", dimension::angle, 1.0},
    NamedUnit{"mrad", dimension::angle, 0.001},
    NamedUnit{"deg", dimension::angle, std::numbers::pi / 180.0},
    NamedUnit{"N", dimension::force, 1.0},
    NamedUnit{"kN", dimension::force, 1000.0},
    NamedUnit{"MN", dimension::force, 1e6},
    NamedUnit{"mN", dimension::force, 0.001},
    NamedUnit{"Hz", dimension::frequency, 1.0},
    NamedUnit{"%", dimension::none, 0.01},
};

struct NamedDimension {
  Dimension dimension;
  std::string_view words;
  std::string_view unit;
};

constexpr std::array named_dimensions{
    NamedDimension{dimension::none, "a plain number", ""},
    NamedDimension{dimension::length, "a length", "m"},
    NamedDimension{dimension::velocity, "a velocity", "m/s"},
    NamedDimension{dimension::acceleration, "an acceleration", "m/s^2"},
    NamedDimension{dimension::mass, "a mass", "kg"},
    NamedDimension{dimension::inertia, "a moment of inertia", "kg m^2"},
    NamedDimension{dimension::time, "a time", "s"},
    NamedDimension{dimension::frequency, "a frequency", "Hz"},
    NamedDimension{dimension::angle, "an angle", "rad"},
    NamedDimension{dimension::angular_velocity, "an angular velocity", "rad/s"},
    NamedDimension{dimension::angular_acceleration, "an angular acceleration", "rad/s^2"},
    NamedDimension{dimension::force, "a force", "N"},
    NamedDimension{dimension::torque, "a torque", "N m"},
    NamedDimension{dimension::stiffness, "a stiffness", "N/m"},
    NamedDimension{dimension::damping, "a damping", "N s/m"},
    NamedDimension{dimension::angular_stiffness, "an angular stiffness", "N m/rad"},
    NamedDimension{dimension::angular_damping, "an angular damping", "N m s/rad"},
    NamedDimension{{2, 1, -3, 0}, "a torque per time", "N m/s"},
    NamedDimension{{1, 1, -3, 0}, "a force per time", "N/s"},
    NamedDimension{{2, 0, 0, 0}, "an area", "m^2"},
};

/// Spellings of a unit that has another name here.
struct OtherName {
  std::string_view written;
  std::string_view meant;
};
constexpr std::array other_names{
    OtherName{"Nm", "N m"},      OtherName{"nm", "N m"},       OtherName{"NM", "N m"},
    OtherName{"sec", "s"},       OtherName{"seconds", "s"},    OtherName{"second", "s"},
    OtherName{"msec", "ms"},     OtherName{"minutes", "min"},  OtherName{"degree", "deg"},
    OtherName{"degrees", "deg"}, OtherName{"\xC2\xB0", "deg"}, OtherName{"meter", "m"},
    OtherName{"meters", "m"},    OtherName{"metre", "m"},      OtherName{"newton", "N"},
    OtherName{"newtons", "N"},   OtherName{"Newton", "N"},     OtherName{"radian", "rad"},
    OtherName{"radians", "rad"}, OtherName{"kph", "km/h"},     OtherName{"kmh", "km/h"},
    OtherName{"mps", "m/s"},     OtherName{"mmps", "mm/s"},    OtherName{"cmps", "cm/s"},
    OtherName{"ms-1", "m/s"},    OtherName{"ms-2", "m/s^2"},   OtherName{"N.m", "N m"},
    OtherName{"N-m", "N m"},     OtherName{"percent", "%"},    OtherName{"S", "s"},
    OtherName{"M", "m"},
};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

const NamedUnit* find_unit(std::string_view name) {
  for (const NamedUnit& unit : named_units) {
    if (unit.name == name) return &unit;
  }
  return nullptr;
}

std::string power_text(std::string_view unit, int power) {
  if (power == 0) return {};
  return std::string(unit) + (power == 1 ? "" : "^" + std::to_string(power)) + " ";
}

/// Reads `^-2` at `at`; 1 when there is no `^`, 0 when what follows is not a small whole number.
int parse_power(std::string_view text, std::size_t& at) {
  if (at >= text.size() || text[at] != '^') return 1;
  ++at;
  const bool is_negative = at < text.size() && text[at] == '-';
  if (is_negative) ++at;
  if (at >= text.size() || text[at] < '1' || text[at] > '4') return 0;
  const int power = text[at++] - '0';
  return is_negative ? -power : power;
}

/// Two things to two people, and neither is a unit here.
bool is_of_revolutions(std::string_view unit) {
  return unit == "rpm" || unit == "rps" || unit == "rev";
}

}  // namespace

std::string describe(const Dimension& dimension) {
  for (const NamedDimension& named : named_dimensions) {
    if (named.dimension == dimension) return std::string(named.words);
  }
  return "a quantity in " + usual_unit(dimension);
}

std::string usual_unit(const Dimension& dimension) {
  for (const NamedDimension& named : named_dimensions) {
    if (named.dimension == dimension) return std::string(named.unit);
  }
  return trimmed(power_text("kg", dimension.mass) + power_text("m", dimension.length) +
                 power_text("s", dimension.time) + power_text("rad", dimension.angle));
}

bool is_unit_name(std::string_view name) {
  return find_unit(name) != nullptr;
}

std::vector<std::string> unit_names() {
  std::vector<std::string> names;
  for (const NamedUnit& unit : named_units) names.emplace_back(unit.name);
  return names;
}

std::string nearest_unit(std::string_view unknown) {
  if (is_of_revolutions(unknown)) return {};  // what is near has another size
  for (const OtherName& other : other_names) {
    if (other.written == unknown) return std::string(other.meant);
  }
  // `ms2`, `m/s2`: the power without its sign.
  if (unknown.size() >= 2 && is_digit(unknown.back()) &&
      is_unit_name(unknown.substr(0, unknown.size() - 1))) {
    return std::string(unknown.substr(0, unknown.size() - 1)) + "^" + unknown.back();
  }
  return nearest(unknown, unit_names());
}

std::optional<Unit> parse_unit(std::string_view text, std::string& unknown) {
  Unit unit;
  std::size_t at = 0;
  int divisors = 0;
  const auto fail = [&unknown](std::string_view part) {
    unknown = trimmed(part);
    return std::nullopt;
  };
  const auto skip_spaces = [&] {
    const std::size_t start = at;
    while (at < text.size() && text[at] == ' ') ++at;
    return at > start;
  };
  if (text.size() > 64) return fail(text);
  for (bool is_first = true; is_first || at < text.size(); is_first = false) {
    const bool is_spaced = skip_spaces();
    bool divides = false;
    if (!is_first) {
      divides = at < text.size() && text[at] == '/';
      const bool has_sign = divides || (at < text.size() && text[at] == '*');
      if (!has_sign && !is_spaced) return fail(text);
      // `kg/m s`: does the second divide or multiply? `N m s/rad` and `m/s/s` say it.
      if (!divides && divisors > 0) return fail(text);
      if (has_sign) ++at;
      skip_spaces();
    } else if (text.starts_with("1/")) {
      ++at;
      continue;
    }
    const std::size_t start = at;
    while (at < text.size() && (is_letter(text[at]) || is_digit(text[at]))) ++at;
    const std::string_view name = text.substr(start, at - start);
    const NamedUnit* named = find_unit(name);
    if (named == nullptr) return fail(name.empty() ? text.substr(start) : name);
    const int power = parse_power(text, at);
    if (power == 0) return fail(text.substr(start));
    divisors += divides ? 1 : 0;
    const int signed_power = divides ? -power : power;
    unit.dimension = unit.dimension * named->dimension.power(signed_power);
    unit.scale *= std::pow(named->scale, signed_power);
  }
  return unit;
}

std::size_t number_length(std::string_view text) {
  std::size_t at = 0;
  std::size_t digits = 0;
  const auto skip_digits = [&] {
    while (at < text.size() && is_digit(text[at])) ++at, ++digits;
  };
  skip_digits();
  if (at < text.size() && text[at] == '.') {
    ++at;
    skip_digits();
  }
  if (digits == 0) return 0;
  const std::size_t mantissa = at;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    digits = 0;
    skip_digits();
    if (digits == 0) return mantissa;
  }
  return at;
}

QuantityResult parse_quantity(std::string_view text) {
  QuantityResult result;
  const std::string trimmed_text = trimmed(text);
  const std::string_view whole = trimmed_text;
  const std::size_t sign = (!whole.empty() && (whole[0] == '-' || whole[0] == '+')) ? 1 : 0;
  const std::size_t length = number_length(whole.substr(sign));
  if (length == 0) {
    result.error = QuantityError::not_a_number;
    return result;
  }
  double value = 0.0;
  const char* first = whole.data() + sign;
  const auto [end, error] = std::from_chars(first, first + length, value);
  if (error != std::errc{} || end != first + length || !std::isfinite(value)) {
    result.error = QuantityError::too_large;
    return result;
  }
  if (whole[0] == '-') value = -value;
  Quantity& quantity = result.quantity;
  quantity.number = std::string(whole.substr(0, sign + length));
  quantity.unit = trimmed(whole.substr(sign + length));
  quantity.has_unit = !quantity.unit.empty();
  if (quantity.has_unit) {
    const std::optional<Unit> unit = parse_unit(quantity.unit, result.unknown);
    if (!unit) {
      result.error = QuantityError::unknown_unit;
      return result;
    }
    quantity.dimension = unit->dimension;
    quantity.scale = unit->scale;
  }
  quantity.value = value * quantity.scale;
  // No robot is in a thousand kilometres, or has a thousand tonnes; and what is lost in rounding is a slip.
  const bool is_length = quantity.dimension == dimension::length,
             is_mass = quantity.dimension == dimension::mass;
  const double most = is_length || is_mass ? 1e6 : 1e12;
  const double size = std::abs(quantity.value);
  if (!std::isfinite(size) || size > most || (size < 1e-15 && value != 0.0))
    result.error = QuantityError::too_large;
  return result;
}

std::string format_number(double value) {
  std::array<char, 40> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return error == std::errc{} ? std::string(buffer.data(), end) : std::string("?");
}

}  // namespace zwang::lang
