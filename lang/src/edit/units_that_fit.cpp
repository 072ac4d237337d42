#include "edit/units_that_fit.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

#include "edit/name_walk.hpp"
#include "spec/task_file.hpp"
#include "words/units.hpp"
#include "zwang/lang/completion.hpp"
#include "zwang/lang/condition_function.hpp"

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

/// Without the blanks and one of these letters at its end, as often as they stand there.
std::string_view without_end(std::string_view text, std::string_view letters) {
  const auto trimmed = [](std::string_view of, std::string_view which) {
    const std::size_t last = of.find_last_not_of(which);
    return of.substr(0, last == std::string_view::npos ? 0 : last + 1);
  };
  return trimmed(trimmed(trimmed(text, " "), letters), " ");
}

/// Of the unit that a name of one of these kinds is given with; nullopt: not known.
std::optional<Dimension> dimension_given(std::string_view name, std::initializer_list<NameKind> kinds,
                                         const std::vector<NamePlace>& given) {
  for (const NamePlace& place : given) {
    const bool is_meant = place.is_given && place.unit && place.name == name;
    if (!is_meant || std::find(kinds.begin(), kinds.end(), place.kinds.front()) == kinds.end()) continue;
    if (place.unit->empty()) return Dimension{};
    std::string unknown;
    const std::optional<Unit> unit = parse_unit(*place.unit, unknown);
    return unit ? std::optional(unit->dimension) : std::nullopt;
  }
  return std::nullopt;
}

/// Of `contact.x.velocity`, `estimated.force.x`, `elapsed`, a signal, and the part `felt.x` of a wrench.
std::optional<Dimension> dimension_of_path(std::string_view path, const std::vector<NamePlace>& given) {
  if (path == "elapsed") return dimension::time;
  const std::size_t point = path.rfind('.');
  if (point == std::string_view::npos)
    return dimension_given(path, {NameKind::signal, NameKind::output, NameKind::feature}, given);
  const std::string last(path.substr(point + 1));
  if (path.starts_with("estimated.")) {
    const auto axis = axis_named(last);
    return axis ? std::optional(dimension_of(*axis, solver::Quantity::force)) : std::nullopt;
  }
  const std::size_t before = point == 0 ? std::string_view::npos : path.rfind('.', point - 1);
  if (before == std::string_view::npos) {
    if (last == "plane") return dimension::force;
    const auto part = axis_named(last);
    return part ? std::optional(dimension_of(*part, solver::Quantity::force)) : std::nullopt;
  }
  const auto axis = axis_named(std::string(path.substr(before + 1, point - before - 1)));
  const auto quantity = quantity_named(last);
  return axis && quantity ? std::optional(dimension_of(*axis, *quantity)) : std::nullopt;
}

/// Of the left side of the last comparison; nullopt: not known. `abs(contact.x.velocity) < 5 `
std::optional<Dimension> dimension_compared(std::string_view condition, const std::vector<NamePlace>& given) {
  const std::string_view compared = without_end(without_end(condition, "0123456789.-"), "<>=");
  constexpr std::string_view of_path = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.";
  const auto path_at_end = [&](std::string_view text) {
    const std::size_t before = text.find_last_not_of(of_path);
    return text.substr(before == std::string_view::npos ? 0 : before + 1);
  };
  if (!compared.ends_with(')')) return dimension_of_path(path_at_end(compared), given);
  const std::size_t open = compared.rfind('(');
  if (open == std::string_view::npos) return std::nullopt;
  const ConditionFunction* function = find_function(path_at_end(compared.substr(0, open)));
  if (function == nullptr || function->is_truth) return std::nullopt;
  if (function->argument == FunctionArgument::number)
    return dimension_of_path(path_at_end(compared.substr(open + 1, compared.size() - open - 2)), given);
  return Dimension{function->powers[0], function->powers[1], function->powers[2], function->powers[3]};
}

std::vector<std::string> units_of(const std::optional<Dimension>& wanted) {
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

constexpr int most_uses = 50;      // each costs a walk through the text
constexpr int most_templates = 3;  // one inside of another, down to the statement that uses an argument

bool holds_condition(const std::string& key) {
  return key == "when" || key == "require" || key == "that" || key == "yield";
}

/// Of the first place with `$name` that tells one.
std::optional<Dimension> dimension_of_use(std::string_view name, const UnitSources& sources, int depth = 0) {
  const std::string_view text = sources.text;
  int uses = 0;
  for (std::size_t at = text.find('$'); at != std::string_view::npos; at = text.find('$', at + 1)) {
    const std::string_view word = text.substr(at + 1, name.size() + 1);
    if (!word.starts_with(name) || (word.size() > name.size() && is_word_part(word.back()))) continue;
    if (++uses > most_uses) break;
    const TextPlace place = place_at(text, at);
    std::vector<std::string> keys = place.keys;
    std::erase(keys, "-");
    if (keys.empty()) continue;
    const bool is_argument = keys.size() > 1 && keys[keys.size() - 2] == "with";
    std::optional<Dimension> found;
    if (is_argument) {
      if (depth < most_templates) found = dimension_of_use(keys.back(), sources, depth + 1);
    } else if (holds_condition(keys.back())) {
      found = dimension_compared(place.value, sources.given);
    } else {
      found = dimension_below(keys);
    }
    if (found) return found;
  }
  return std::nullopt;
}

/// The parameter that the place gives a value or a range; empty: none.
std::string parameter_at(const std::vector<std::string>& names) {
  constexpr std::string_view prefix = "params.";
  if (names.size() > 1 && names.front() == "params") return names[1];
  if (names.back().starts_with(prefix)) return names.back().substr(prefix.size());
  return names.size() > 1 && names[names.size() - 2] == "params" ? names.back() : "";
}

std::optional<Dimension> dimension_at(const std::vector<std::string>& keys, const UnitSources& sources) {
  constexpr std::string_view output = "outputs.";
  std::vector<std::string> names = keys;
  std::erase(names, "-");
  if (names.empty()) return std::nullopt;
  if (const std::string parameter = parameter_at(names); !parameter.empty()) {
    if (const auto used = dimension_of_use(parameter, sources)) return used;
    // The unit of a parameter's own value is free as long as nothing uses it.
    const bool is_own =
        sources.kind == FileKind::task && names.front() == "params" && names.back() != "range";
    return is_own ? std::nullopt : dimension_given(parameter, {NameKind::parameter}, sources.given);
  }
  if (names.back().starts_with(output))
    return dimension_given(names.back().substr(output.size()), {NameKind::output}, sources.given);
  if (names.size() > 1 && names[names.size() - 2] == "with") return dimension_of_use(names.back(), sources);
  return dimension_below(keys);
}

}  // namespace

std::vector<std::string> units_that_fit(const std::vector<std::string>& keys, const UnitSources& sources) {
  return units_of(dimension_at(keys, sources));
}

std::vector<std::string> units_in_condition(std::string_view condition, const UnitSources& sources) {
  return units_of(dimension_compared(condition, sources.given));
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
