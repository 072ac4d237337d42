// A parameter may be set to any value of its range, before the run and under way. So each place asks for the
// whole range. A parameter p with the sign s = +-1 that must keep s p >= limit has
//
//   p >= limit      for s = 1
//   p <= -limit     for s = -1
#include "check/parameter_values.hpp"

#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_never.hpp"

namespace zwang::lang {

namespace {

constexpr double least_magnitude = 1e-15;  ///< of any quantity that a file can give, but 0 [SI]

const ParameterSymbol* good_parameter(const CheckContext& context, const ValueText& value) {
  if (value.kind != ValueKind::parameter) return nullptr;
  const ParameterSymbol* symbol = context.symbols.find_parameter(value.name);
  return symbol == nullptr || symbol->is_bad ? nullptr : symbol;
}

/// The declared range without what breaks the bound `end`; nullopt where that leaves no width, or not the
/// value at the start.
std::optional<solver::Range> narrowed(const Parameter& parameter, double end, bool is_least) {
  if (!parameter.range) return std::nullopt;
  solver::Range range = *parameter.range;
  (is_least ? range.low : range.high) = end;
  const bool holds_start = range.low <= parameter.value && parameter.value <= range.high;
  if (!(range.low < range.high) || !holds_start) return std::nullopt;
  return range;
}

const StatementText* range_text(const CheckContext& context, const std::string& parameter) {
  for (const ParameterText& text : context.file.parameters) {
    if (text.name.text == parameter && text.range) return &*text.range;
  }
  return nullptr;
}

solver::Range hull(const solver::Range& a, const solver::Range& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Each `set` of a parameter in the file.
template <typename Use>
void for_each_set(const TaskFile& file, const Use& use) {
  const auto of_list = [&](const std::vector<SetText>& sets) {
    for (const SetText& set : sets) {
      if (set.kind == SetKind::parameter) use(set);
    }
  };
  for (const ExitText& exit : file.always_exits) of_list(exit.set);
  for (const TaskText& task : file.tasks) {
    of_list(task.set_on_entry);
    for (const ExitText& exit : task.exits) of_list(exit.set);
  }
}

/// The value that a `set` gives a parameter without a range: a constant, or the values of another parameter.
struct Given {
  ParameterSymbol* parameter = nullptr;
  const ParameterSymbol* source = nullptr;
  solver::Range constant{0.0, 0.0};
  double sign = 1.0;
};

std::vector<Given> given_by_sets(const CheckContext& context) {
  std::vector<Given> all;
  for_each_set(context.file, [&](const SetText& set) {
    ParameterSymbol* parameter = context.symbols.find_parameter(set.name.text);
    if (parameter == nullptr || parameter->is_bad || parameter->parameter.range) return;
    const ParameterSymbol* source = good_parameter(context, set.value);
    const Quantity& quantity = set.value.quantity;
    if (source != nullptr && source->dimension == parameter->dimension) {
      all.push_back({.parameter = parameter, .source = source, .sign = set.value.sign});
    } else if (set.value.kind == ValueKind::quantity && quantity.dimension == parameter->dimension) {
      all.push_back({.parameter = parameter, .constant = {quantity.value, quantity.value}});
    }
  });
  return all;
}

/// Where the file sets the parameter to that value; may be nowhere.
Span set_to(const CheckContext& context, const std::string& parameter, double value) {
  Span found;
  for_each_set(context.file, [&](const SetText& set) {
    const solver::Range values = values_of(context, set.value);
    if (set.name.text == parameter && (values.low == value || values.high == value)) found = set.value.span;
  });
  return found;
}

}  // namespace

std::optional<double> known_value(const CheckContext& context, const ValueText& value,
                                  const Dimension& expected) {
  if (value.kind == ValueKind::quantity && value.quantity.dimension == expected) return value.quantity.value;
  if (value.kind != ValueKind::parameter) return std::nullopt;
  const ParameterSymbol* symbol = context.symbols.find_parameter(value.name);
  if (symbol == nullptr || symbol->is_bad || symbol->dimension != expected) return std::nullopt;
  return present_value(context, value);
}

solver::Range values_of(const CheckContext& context, const ValueText& value) {
  if (value.kind != ValueKind::parameter) return {value.quantity.value, value.quantity.value};
  const ParameterSymbol* symbol = context.symbols.find_parameter(value.name);
  if (symbol == nullptr) return {0.0, 0.0};
  const solver::Range& values = symbol->values;
  return value.sign < 0.0 ? solver::Range{-values.high, -values.low} : values;
}

void require(CheckContext& context, const ValueText& value, const Need& need) {
  if (good_parameter(context, value) == nullptr) return;
  ParameterSymbol& symbol = *context.symbols.find_parameter(value.name);
  const bool is_least = need.is_least == (value.sign > 0.0);
  const double limit = value.sign * need.limit;
  const double worst = is_least ? symbol.values.low : symbol.values.high;
  const bool is_beyond = is_least ? worst < limit : worst > limit;
  if (!is_beyond && (need.or_equal || worst != limit)) {
    const double end = limit + (need.or_equal ? 0.0 : is_least ? least_magnitude : -least_magnitude);
    double& admitted = is_least ? symbol.admitted.low : symbol.admitted.high;
    admitted = is_least ? std::max(admitted, end) : std::min(admitted, end);
    return;
  }
  // Where the limit itself is excluded, a tenth of the value at the start is a sound end.
  const double end = need.or_equal ? limit : symbol.parameter.value / 10.0;
  const StatementText* range = range_text(context, value.name);
  context.diagnostics.add(wording::breaks_a_use(
      value.span, need.rule, symbol.parameter, value.sign < 0.0, worst,
      narrowed(symbol.parameter, end, is_least),
      range != nullptr ? range->span : set_to(context, value.name, worst), range != nullptr));
}

void require_positive(CheckContext& context, const ValueText& value, const std::string& what,
                      bool zero_allowed) {
  require(
      context, value,
      {.rule = what + (zero_allowed ? " cannot be below 0" : " must be above 0"), .or_equal = zero_allowed});
}

void require_order(CheckContext& context, const ValueText& low, const ValueText& high,
                   const std::string& rule) {
  const bool both = low.kind == ValueKind::parameter && high.kind == ValueKind::parameter;
  const bool is_one = both && low.name == high.name;
  if (is_one && low.sign == high.sign) return;
  if (is_one) return require(context, high, {.rule = rule});
  const double lowest_high = values_of(context, high).low, highest_low = values_of(context, low).high;
  if (lowest_high < highest_low) {
    if (high.kind == ValueKind::parameter)
      return require(context, high, {.rule = rule, .limit = highest_low});
    return require(context, low, {.rule = rule, .limit = lowest_high, .is_least = false});
  }
  // Two parameters without ranges may each go halfway.
  const double between = 0.5 * (lowest_high + highest_low);
  require(context, high, {.rule = rule, .limit = both ? between : highest_low});
  require(context, low, {.rule = rule, .limit = both ? between : lowest_high, .is_least = false});
}

void gather_set_values(CheckContext& context) {
  std::vector<ParameterSymbol>& symbols = context.symbols.parameters;
  for (ParameterSymbol& symbol : symbols) {
    const double value = symbol.parameter.value;
    symbol.values = symbol.parameter.range.value_or(solver::Range{value, value});
  }
  const std::vector<Given> all = given_by_sets(context);
  // A parameter that is set to another one takes that one's values, over any number of parameters. Signs may
  // turn them around once.
  bool has_grown = true;
  for (std::size_t pass = 0; has_grown && pass <= 2 * symbols.size(); ++pass) {
    has_grown = false;
    for (const Given& given : all) {
      const solver::Range& from = given.source != nullptr ? given.source->values : given.constant;
      const solver::Range turned = given.sign < 0.0 ? solver::Range{-from.high, -from.low} : from;
      solver::Range& values = given.parameter->values;
      has_grown = has_grown || turned.low < values.low || turned.high > values.high;
      values = hull(values, turned);
    }
  }
}

std::string as_written(const ValueText& value) {
  if (value.kind == ValueKind::parameter) return (value.sign < 0 ? "-$" : "$") + value.name;
  return value.quantity.number + " " + value.quantity.unit;
}

}  // namespace zwang::lang
