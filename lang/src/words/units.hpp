/// Units and quantities: `0.08 m/s`, `26`, `2 kg mm^2`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "words/dimension.hpp"

namespace zwang::lang {

struct Unit {
  Dimension dimension;
  double scale = 1.0;  ///< SI value of one of it
};

/// A product, quotient or power of known units: `N m`, `rad/s^2`, `1/s`. On failure nullopt, and `unknown` is
/// the part that is no unit.
std::optional<Unit> parse_unit(std::string_view text, std::string& unknown);

/// One unit's own name, as `kN`.
bool is_unit_name(std::string_view name);
std::vector<std::string> unit_names();
/// The unit that the author of an unknown one meant, as `N m` for `Nm`. Empty: no unit is near.
std::string nearest_unit(std::string_view unknown);

struct Quantity {
  double value = 0.0;  ///< SI
  Dimension dimension;
  bool has_unit = false;
  std::string number;  ///< as written
  std::string unit;    ///< as written
  double scale = 1.0;  ///< SI value of one `unit`
};

enum class QuantityError { none, not_a_number, too_large, unknown_unit };

struct QuantityResult {
  Quantity quantity;
  QuantityError error = QuantityError::none;
  std::string unknown;  ///< the part that is no unit
};

/// The whole text must be one finite decimal number with or without a unit.
QuantityResult parse_quantity(std::string_view text);

/// Length of the decimal number that `text` starts with, sign excluded; 0 when there is none.
std::size_t number_length(std::string_view text);

/// Shortest text that reads back as the same number.
std::string format_number(double value);

}  // namespace zwang::lang
