#include "edit/units_that_fit.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include "spec/task_file.hpp"
#include "words/units.hpp"
#include "zwang/lang/completion.hpp"

namespace zwang::lang {

namespace {

struct Measured {
  std::string_view key;
  Dimension dimension;
};

/// Keys that measure the same wherever they stand.
constexpr std::array measured{
    Measured{"time_constant", dimension::time},  Measured{"for", dimension::time},
    Measured{"after", dimension::time},          Measured{"blend", dimension::time},
    Measured{"stale_after", dimension::time},    Measured{"timeout", dimension::time},
    Measured{"time_limit", dimension::time},     Measured{"time", dimension::time},
    Measured{"within", dimension::time},         Measured{"delay", dimension::time},
    Measured{"control_period", dimension::time}, Measured{"rate", dimension::frequency},
    Measured{"margin", dimension::length},       Measured{"polygon", dimension::length},
    Measured{"at", dimension::length},           Measured{"radius", dimension::length},
    Measured{"height", dimension::length},       Measured{"length", dimension::length},
    Measured{"thickness", dimension::length},    Measured{"start_at", dimension::length},
    Measured{"yaw", dimension::angle},           Measured{"rpy", dimension::angle},
    Measured{"start_yaw", dimension::angle},     Measured{"nearest", dimension::angle},
    Measured{"encoder_step", dimension::angle},  Measured{"mass", dimension::mass},
    Measured{"payload", dimension::mass},        Measured{"deceleration", dimension::acceleration},
    Measured{"stiffness", dimension::stiffness}};

std::optional<solver::Quantity> quantity_named(const std::string& key) {
  for (const auto quantity : {solver::Quantity::position, solver::Quantity::velocity,
                              solver::Quantity::acceleration, solver::Quantity::force}) {
    if (key == word_of(quantity)) return quantity;
  }
  return std::nullopt;
}

/// The dimension of a value below these keys; nullopt: not known.
std::optional<Dimension> dimension_below(const std::vector<std::string>& keys) {
  std::vector<std::string> names;
  for (const std::string& key : keys) {
    if (key != "-") names.push_back(key);
  }
  if (names.empty()) return std::nullopt;
  const std::string last = names.back(), above = names.size() > 1 ? names[names.size() - 2] : "";
  const auto axis = axis_named(above);
  const auto quantity = quantity_named(last);
  // `speed` and `plane` are norms of what moves along; the limits of a robot file stand the other way around.
  if (quantity && (axis || above == "speed" || above == "plane"))
    return dimension_of(axis.value_or(solver::Axis::x), *quantity);
  if (const auto outer = quantity_named(above); outer && axis_named(last))
    return dimension_of(*axis_named(last), *outer);
  if (last == "return" && axis) return dimension_of(*axis, solver::Quantity::velocity);
  if (last == "return") return dimension::velocity;
  if (last == "weight") return axis && is_rotation(*axis) ? dimension::inertia : dimension::mass;
  if (last == "stiffness" && axis && is_rotation(*axis)) return dimension::angular_stiffness;
  if (last == "damping" && axis) return is_rotation(*axis) ? dimension::angular_damping : dimension::damping;
  if (last == "force") return dimension::force;
  for (const Measured& one : measured) {
    if (one.key == last) return one.dimension;
  }
  return std::nullopt;
}

/// Beside the units with a name of their own.
constexpr std::array usual_products{"m/s",   "cm/s",    "mm/s",    "m/s^2",   "rad/s",
                                    "deg/s", "rad/s^2", "deg/s^2", "N m",     "kg m^2",
                                    "N/m",   "kN/m",    "N s/m",   "N m/rad", "N m s/rad"};

}  // namespace

std::vector<std::string> units_that_fit(const std::vector<std::string>& keys) {
  const std::optional<Dimension> wanted = dimension_below(keys);
  std::vector<std::string> units = unit_names();
  units.insert(units.end(), usual_products.begin(), usual_products.end());
  if (!wanted) return units;
  std::erase_if(units, [&wanted](const std::string& unit) {
    std::string unknown;
    const std::optional<Unit> parsed = parse_unit(unit, unknown);
    return !parsed || parsed->dimension != *wanted;
  });
  return units;
}

std::string in_si(std::string_view text) {
  const QuantityResult read = parse_quantity(text);
  const Quantity& quantity = read.quantity;
  if (read.error != QuantityError::none || !quantity.has_unit || quantity.scale == 1.0) return {};
  const std::string unit = usual_unit(quantity.dimension);
  char number[32];
  std::snprintf(number, sizeof number, "%.6g", quantity.value);  // as much as a person reads
  return number + (unit.empty() ? "" : " " + unit);
}

std::string kind_of_quantity(std::string_view text) {
  const QuantityResult read = parse_quantity(text);
  if (read.error != QuantityError::none || !read.quantity.has_unit) return {};
  return describe(read.quantity.dimension);
}

}  // namespace zwang::lang
