#include "spec/value.hpp"

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/decimal_comma.hpp"
#include "spec/measured_value.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

bool starts_a_number(std::string_view text) {
  const std::size_t sign = (!text.empty() && (text[0] == '+' || text[0] == '-')) ? 1 : 0;
  return number_length(text.substr(sign)) > 0;
}

ValueText parse_parameter(std::string_view text, double sign, ValueText value, Diagnostics& diagnostics) {
  value.name = std::string(text.substr(1));
  value.sign = sign;
  // A name that no parameter can have may be that of one that was declared so, and complained of there.
  const bool is_odd = !value.name.empty() && value.name.find_first_of(" $*/+-()") == std::string::npos;
  if (is_identifier(value.name) || is_odd) {
    value.kind = ValueKind::parameter;
  } else {
    diagnostics.add(wording::not_a_value(value.span, std::string(text)));
  }
  return value;
}

/// Whether the text is a quantity in letters that a word processor makes of it; complains of that.
bool is_spelt_oddly(const std::string& text, const Span& span, Diagnostics& diagnostics) {
  const std::string plain = wording::plainly_written(text);
  if (plain == text) return false;
  const std::string_view magnitude = std::string_view(plain).substr(plain.starts_with("+-") ? 2 : 0);
  if (parse_quantity(magnitude).error != QuantityError::none) return false;
  diagnostics.add(wording::odd_letters(span, text, plain));
  return true;
}

/// The dimension of `GROUP.AXIS.QUANTITY`. nullopt: `what` is another place.
std::optional<Dimension> dimension_of_place(const std::string& what) {
  struct Quantity {
    std::string_view name;
    Dimension along, about;
  };
  constexpr Quantity quantities[] = {
      {"position", dimension::length, dimension::angle},
      {"velocity", dimension::velocity, dimension::angular_velocity},
      {"acceleration", dimension::acceleration, dimension::angular_acceleration},
      {"force", dimension::force, dimension::torque}};
  for (const Quantity& quantity : quantities) {
    for (const char* axis : {"x", "y", "z"}) {
      const std::string end = std::string(axis) + "." + std::string(quantity.name);
      if (what.ends_with(".r" + end)) return quantity.about;
      if (what.ends_with("." + end)) return quantity.along;
    }
  }
  return std::nullopt;
}

/// The unit that was meant, where it can stand there; what an axis that does not turn presses with is no
/// torque.
std::string unit_meant(const std::string& text, const std::string& unknown, const std::string& what,
                       const std::optional<Dimension>& measured) {
  const std::string meant = nearest_unit(unknown);
  const std::optional<Dimension> wanted = measured ? measured : dimension_of_place(what);
  if (wanted == dimension::force && meant == "N m") return "N";
  std::string replaced = text;
  const QuantityResult result = parse_quantity(replaced.replace(text.rfind(unknown), unknown.size(), meant));
  const bool can_stand =
      !wanted || result.error != QuantityError::none || result.quantity.dimension == *wanted;
  return can_stand ? meant : std::string();
}

/// `sign`: what stands before the text in the file, as `+-`.
ValueText parse_value_text(const std::string& text, const std::string& what, const Span& span,
                           Diagnostics& diagnostics, const std::optional<Dimension>& measured = std::nullopt,
                           const std::string& sign = {}) {
  ValueText value;
  value.span = span;
  const bool has_braces = text.starts_with("${") || text.starts_with("-${");
  const bool has_parentheses = text.starts_with("$(") || text.starts_with("-$(");
  if ((has_braces && text.ends_with('}')) || (has_parentheses && text.ends_with(')'))) {
    diagnostics.add(wording::parameter_in_braces(span, text));
    return value;
  }
  if (text.starts_with("$")) return parse_parameter(text, 1.0, value, diagnostics);
  if (!text.starts_with("-$") && text.find('$') != std::string::npos) {
    diagnostics.add(wording::computed_value(span, text));
    return value;
  }
  if (text.starts_with("-$")) return parse_parameter(text.substr(1), -1.0, value, diagnostics);
  if (text.starts_with("here ") || text.starts_with("pi/") || text.starts_with("pi ")) {
    diagnostics.add(wording::computed_value(span, text));
    return value;
  }
  if (text == "here") {
    value.kind = ValueKind::here;
  } else if (is_identifier(text)) {
    value.kind = ValueKind::name;
    value.name = text;
  } else if (is_spelt_oddly(text, span, diagnostics)) {
    return value;
  } else if (!starts_a_number(text) || text.find("..") != std::string::npos) {
    diagnostics.add(wording::not_a_value(span, text));
  } else {
    QuantityResult result = parse_quantity(text);
    switch (result.error) {
      case QuantityError::none:
        value.kind = ValueKind::quantity;
        value.quantity = std::move(result.quantity);
        break;
      case QuantityError::unknown_unit:
        diagnostics.add(result.unknown.find('+') != std::string::npos || result.unknown.starts_with('-')
                            ? wording::computed_value(span, text)
                            : wording::unknown_unit(span, sign + text, result.unknown,
                                                    unit_meant(text, result.unknown, what, measured)));
        break;
      case QuantityError::too_large:
        diagnostics.add(wording::number_out_of_range(span, text));
        break;
      case QuantityError::not_a_number:
        diagnostics.add(wording::not_a_value(span, text));
        break;
    }
  }
  return value;
}

ValueText negated(ValueText value) {
  value.sign = -value.sign;
  value.quantity.value = -value.quantity.value;
  if (value.kind == ValueKind::quantity) value.quantity.number = "-" + value.quantity.number;
  return value;
}

}  // namespace

bool is_identifier(std::string_view text) {
  if (text.empty() || (text[0] >= '0' && text[0] <= '9')) return false;
  for (const char c : text) {
    const bool is_good =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (!is_good) return false;
  }
  return true;
}

ValueText parse_value(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  return parse_measured_value(node, what, std::nullopt, diagnostics);
}

ValueText parse_measured_value(const Node& node, const std::string& what,
                               const std::optional<Dimension>& measured, Diagnostics& diagnostics) {
  ValueText bad;
  bad.span = node.span;
  if (node.is_bad) return bad;
  if (!node.is_scalar()) {
    diagnostics.add(wording::expected_value(node.span, what, node.kind == NodeKind::null));
    return bad;
  }
  const std::string text = trimmed(node.text);
  if (text.starts_with("+-")) {
    diagnostics.add(wording::range_where_value(node.span, what, trimmed(std::string_view(text).substr(2))));
    return bad;
  }
  return parse_value_text(text, what, node.span, diagnostics, measured);
}

namespace {

/// One of several keys of a mapping, in the order of preference; empty: none is there.
std::string end_named(const Node& node, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (const Entry* entry = node.find(key)) return trimmed(entry->value.text);
  }
  return {};
}

/// `{min: -1 N, max: 1 N}`, `1 m, 2 m` and `[0, 2 m]`, which may be a range or a decimal comma.
bool is_odd_range(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  if (node.is_bad) return false;
  if (node.is_mapping()) {
    const std::string low = end_named(node, {"min", "lower", "low", "from"});
    const std::string high = end_named(node, {"max", "upper", "high", "to"});
    if (low.empty() && high.empty()) return false;
    diagnostics.add(wording::range_by_names(node.span, low, high));
    return true;
  }
  const auto is_quantity = [](std::string_view text) {
    return parse_quantity(trimmed(text)).error == QuantityError::none;
  };
  if (node.is_scalar()) {
    const std::size_t comma = node.text.find(',');
    if (comma == std::string::npos) return false;
    const std::string low = node.text.substr(0, comma), high = node.text.substr(comma + 1);
    if (!is_quantity(low) || !is_quantity(high) || !joined_at_decimal_comma(low, high).empty()) return false;
    diagnostics.add(wording::range_without_brackets(node.span, trimmed(node.text)));
    return true;
  }
  if (node.items.size() != 2 || !node.items[0].is_scalar() || !node.items[1].is_scalar()) return false;
  const std::string low = trimmed(node.items[0].text), high = trimmed(node.items[1].text);
  const std::string meant = joined_at_decimal_comma(low, high);
  const QuantityResult end = parse_quantity(high);
  if (meant.empty() || end.error != QuantityError::none || !end.quantity.has_unit) return false;
  const std::string unit = high.substr(number_length(high));
  diagnostics.add(wording::end_without_unit(node.items[0].span, what, low + " " + trimmed(unit), meant));
  return true;
}

}  // namespace

StatementText parse_statement(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  StatementText statement;
  statement.span = node.span;
  if (node.is_sequence() && !node.is_bad) {
    statement.is_range = true;
    if (complain_of_decimal_comma(node, 2, 2, diagnostics)) return statement;
    if (node.items.size() != 2) {
      diagnostics.add(wording::range_ends(node.span, node.items.size()));
      return statement;
    }
    if (is_odd_range(node, what, diagnostics)) return statement;
    statement.low = parse_value(node.items[0], what, diagnostics);
    statement.high = parse_value(node.items[1], what, diagnostics);
    return statement;
  }
  const std::string text = node.is_scalar() && !node.is_bad ? trimmed(node.text) : std::string();
  if (text.starts_with("+-")) {
    statement.is_range = true;
    if (is_spelt_oddly(text, node.span, diagnostics)) return statement;
    const std::string magnitude = trimmed(std::string_view(text).substr(2));
    if (magnitude.starts_with("-") || magnitude.starts_with("+")) {
      diagnostics.add(wording::not_a_value(node.span, text));
      return statement;
    }
    statement.high = parse_value_text(magnitude, what, node.span, diagnostics, std::nullopt, "+-");
    statement.low = negated(statement.high);
    // A unit that is missing, or another one, is so behind the sign of both.
    const bool has_unit = statement.high.quantity.has_unit;
    statement.low.quantity.number = statement.high.quantity.number =
        "+-" + (has_unit ? statement.high.quantity.number : magnitude);
    return statement;
  }
  if (is_odd_range(node, what, diagnostics)) {
    statement.is_range = true;
    return statement;
  }
  statement.value = parse_value(node, what, diagnostics);
  return statement;
}

StatementText parse_range(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  StatementText statement = parse_statement(node, what, diagnostics);
  if (!statement.is_range) {
    if (statement.value.kind != ValueKind::bad)
      diagnostics.add(wording::value_where_range(node.span, what, trimmed(node.text)));
    statement.is_range = true;
  }
  return statement;
}

std::optional<bool> truth_of(const ValueText& value) {
  const bool is_truth = value.kind == ValueKind::name && (value.name == "true" || value.name == "false");
  return is_truth ? std::optional(value.name == "true") : std::nullopt;
}

bool require_quantity(const ValueText& value, const Dimension& expected, const std::string& what,
                      Diagnostics& diagnostics) {
  if (value.kind == ValueKind::bad) return false;
  if (value.kind != ValueKind::quantity) {
    diagnostics.add(wording::only_a_quantity(value.span, what, expected));
    return false;
  }
  const Quantity& quantity = value.quantity;
  if (!quantity.has_unit && expected != dimension::none) {
    diagnostics.add(wording::needs_unit(value.span, what, quantity.number, expected));
    return false;
  }
  if (quantity.dimension != expected) {
    const bool is_rate = expected == dimension::time && quantity.dimension == dimension::frequency;
    const bool is_period = expected == dimension::frequency && quantity.dimension == dimension::time;
    Diagnostic diagnostic = wording::wrong_dimension(value.span, what, expected, quantity.dimension);
    if (expected == dimension::force && quantity.dimension == dimension::torque) {
      diagnostic.replacement = quantity.number + " N";
      diagnostic.help = "did you mean `" + *diagnostic.replacement + "`?";
    }
    if ((is_rate || is_period) && quantity.value > 0.0)
      diagnostic.help = wording::help_to_invert(1.0 / quantity.value, is_rate);
    diagnostics.add(std::move(diagnostic));
    return false;
  }
  return true;
}

}  // namespace zwang::lang
