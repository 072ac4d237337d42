#include "schedule/condition.hpp"

#include <cmath>
#include <limits>

namespace zwang::runtime {

namespace {

// Truth values are 0 and 1; unknown, of a number or of a truth value, is NaN.
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double number(double x) {
  return std::isfinite(x) ? x : unknown;
}

double truth(bool known, bool value) {
  return known ? (value ? 1.0 : 0.0) : unknown;
}

// Kleene's: a false operand decides an `and`, a true one an `or`, whatever the other is.
double both(double a, double b) {
  if (a == 0.0 || b == 0.0) return 0.0;
  return truth(!std::isnan(a) && !std::isnan(b), true);
}

double either(double a, double b) {
  if (a == 1.0 || b == 1.0) return 1.0;
  return truth(!std::isnan(a) && !std::isnan(b), false);
}

double value_of(const lang::ExpressionNode& node, const Facts& facts, const std::vector<double>& values) {
  const double a = node.left >= 0 ? values[static_cast<std::size_t>(node.left)] : unknown;
  const double b = node.right >= 0 ? values[static_cast<std::size_t>(node.right)] : unknown;
  const bool known = !std::isnan(a) && !std::isnan(b);
  switch (node.op) {
    case lang::Op::constant:
      return number(node.number);
    case lang::Op::parameter:
      return number(facts.parameter(node.index));
    case lang::Op::elapsed:
      return number(facts.elapsed());
    case lang::Op::coordinate:
      return number(facts.coordinate(node.index, node.axis, node.what));
    case lang::Op::speed:
      return number(facts.speed(node.index));
    case lang::Op::moved:
      return number(facts.moved(node.index));
    case lang::Op::abs:
      return std::abs(a);
    case lang::Op::negate:
      return -a;
    case lang::Op::add:
      return number(a + b);
    case lang::Op::subtract:
      return number(a - b);
    case lang::Op::multiply:
      return number(a * b);
    case lang::Op::divide:
      return number(a / b);
    case lang::Op::less:
      return truth(known, a < b);
    case lang::Op::less_equal:
      return truth(known, a <= b);
    case lang::Op::greater:
      return truth(known, a > b);
    case lang::Op::greater_equal:
      return truth(known, a >= b);
    case lang::Op::logical_and:
      return both(a, b);
    case lang::Op::logical_or:
      return either(a, b);
    case lang::Op::logical_not:
      return truth(!std::isnan(a), a == 0.0);
    case lang::Op::signal:
    case lang::Op::valid:
    case lang::Op::feature:
      return unknown;  // not measured by the runtime yet
  }
  return unknown;
}

}  // namespace

Verdict evaluate(const lang::Condition& condition, const Facts& facts,
                 std::vector<double>& scratch) noexcept {
  if (condition.nodes.empty()) return Verdict::no;
  for (std::size_t i = 0; i < condition.nodes.size(); ++i) {
    scratch[i] = value_of(condition.nodes[i], facts, scratch);
  }
  const double root = scratch[condition.nodes.size() - 1];
  if (std::isnan(root)) return Verdict::unknown;
  return root != 0.0 ? Verdict::yes : Verdict::no;
}

}  // namespace zwang::runtime
