/// Values as the author wrote them: a quantity, a parameter, `here`, a name; driving or limiting.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tree/node.hpp"
#include "words/units.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

/// A name in the text. Empty: missing or bad, and already complained of.
struct Word {
  std::string text;
  Span span;

  bool exists() const { return !text.empty(); }
};

enum class ValueKind { bad, quantity, parameter, here, name };

struct ValueText {
  ValueKind kind = ValueKind::bad;
  Quantity quantity;  ///< of a quantity
  std::string name;   ///< of a parameter or a name
  double sign = 1.0;  ///< of a parameter
  Span span;
};

/// One statement of an axis: a single value drives, a range limits.
struct StatementText {
  bool is_range = false;
  ValueText value;      ///< of a driver
  ValueText low, high;  ///< of a range
  Span key_span;
  Span span;
};

bool is_identifier(std::string_view text);

/// One value. Writes E104, E105, E203; a bad value has the kind `bad`.
ValueText parse_value(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// A value, `[low, high]` or `+-value`.
StatementText parse_statement(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// `[low, high]` or `+-value` only.
StatementText parse_range(const Node& node, const std::string& what, Diagnostics& diagnostics);

/// Of `true` and `false`; nullopt for anything else.
std::optional<bool> truth_of(const ValueText& value);

/// Whether the value is a plain quantity of the dimension; writes E201, E202, and E105 for anything but a
/// quantity. False for bad values, silently.
bool require_quantity(const ValueText& value, const Dimension& expected, const std::string& what,
                      Diagnostics& diagnostics);

}  // namespace zwang::lang
