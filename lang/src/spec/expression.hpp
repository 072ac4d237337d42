/// Conditions: comparisons of expressions with units, joined by and, or, not.
///
///     condition  := conjunction {or conjunction}
///     conjunction:= negation {and negation}
///     negation   := not negation | comparison
///     comparison := sum [(< | <= | > | >=) sum]
///     sum        := product {(+ | -) product}
///     product    := factor {(* | /) factor}
///     factor     := - factor | number [unit] | $parameter | name{.name} | function(argument) | (condition)
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tree/node.hpp"
#include "words/units.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

enum class ExpressionKind { quantity, parameter, name, call, negate, logical_not, binary };

/// A node of the expression as written; operands stand before it in the list.
struct ExpressionText {
  ExpressionKind kind = ExpressionKind::quantity;
  std::string word;      ///< of a parameter, a name, a function; the operator of `binary`
  std::string argument;  ///< of a function that takes a name
  Span argument_span;
  Quantity quantity;
  int left = -1;  ///< operand of negate, logical_not and abs()
  int right = -1;
  Span span;
  std::string text;  ///< as written, in one line
};

struct ConditionText {
  std::string text;
  std::vector<ExpressionText> nodes;  ///< the last is the root
  Span span;
  bool is_bad = true;
};

std::vector<std::string> function_names();

ConditionText parse_condition(const Node& node, Diagnostics& diagnostics);
/// A condition, or an expression that has a value: what it is shows when it is checked.
ConditionText parse_expression(const Node& node, const std::string& what, Diagnostics& diagnostics);

}  // namespace zwang::lang
