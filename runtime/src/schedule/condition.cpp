#include "schedule/condition.hpp"

#include <cmath>

namespace zwang::runtime {

namespace {

using lang::Op;

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

bool is_name(Op op) {
  return op >= Op::parameter && op <= Op::estimated_wrench;
}

double apply(Op op, double a, double b) {
  const bool known = !std::isnan(a) && !std::isnan(b);
  switch (op) {
    case Op::abs:
      return std::abs(a);
    case Op::negate:
      return -a;
    case Op::add:
      return number(a + b);
    case Op::subtract:
      return number(a - b);
    case Op::multiply:
      return number(a * b);
    case Op::divide:
      return number(a / b);
    case Op::less:
      return truth(known, a < b);
    case Op::less_equal:
      return truth(known, a <= b);
    case Op::greater:
      return truth(known, a > b);
    case Op::greater_equal:
      return truth(known, a >= b);
    case Op::logical_and:
      return both(a, b);
    case Op::logical_or:
      return either(a, b);
    case Op::logical_not:
      return truth(!std::isnan(a), a == 0.0);
    default:  // names and constants have no operands
      return unknown;
  }
}

/// The comparison goes on to hold until its left side has passed `q`.
double not_yet_passed(Op op, double a, double q) {
  const bool known = !std::isnan(a) && !std::isnan(q);
  return truth(known, op == Op::less || op == Op::less_equal ? a <= q : a >= q);
}

}  // namespace

Judgement evaluate(const lang::Condition& condition, int owner, const Facts& facts, std::span<double> values,
                   std::optional<double> release) noexcept {
  Judgement judgement;
  const std::size_t count = condition.nodes.size();
  if (count == 0) return judgement;
  for (std::size_t i = 0; i < count; ++i) {
    const lang::ExpressionNode& node = condition.nodes[i];
    if (node.op == Op::constant) {
      values[i] = number(node.number);
    } else if (is_name(node.op)) {
      const Fact fact = facts.look_up(node, owner);
      values[i] = number(fact.value);
      judgement.stale = judgement.stale || fact.stale;
    } else {
      const double a = node.left >= 0 ? values[static_cast<std::size_t>(node.left)] : unknown;
      const double b = node.right >= 0 ? values[static_cast<std::size_t>(node.right)] : unknown;
      const bool is_root = i + 1 == count;
      values[i] = release && is_root ? not_yet_passed(node.op, a, *release) : apply(node.op, a, b);
    }
  }
  const double root = values[count - 1];
  if (!std::isnan(root)) judgement.verdict = root != 0.0 ? Verdict::yes : Verdict::no;
  if (std::isnan(root)) judgement.verdict = Verdict::unknown;
  return judgement;
}

}  // namespace zwang::runtime
