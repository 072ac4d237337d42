#include "schedule/condition.hpp"

#include <algorithm>
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

bool is_same_number(const lang::ExpressionNode& a, const lang::ExpressionNode& b) {
  return a.op == b.op && a.number == b.number && a.index == b.index && a.axis == b.axis &&
         a.function == b.function && a.in_always == b.in_always && a.what == b.what && a.left == b.left &&
         a.right == b.right;
}

bool is_comparison(Op op) {
  return op >= Op::less && op <= Op::greater_equal;
}

bool is_combination(Op op) {
  return op >= Op::logical_and && op <= Op::logical_not;
}

inline double compare(Op op, double a, double b) {
  const bool known = !std::isnan(a) && !std::isnan(b);
  switch (op) {
    case Op::less:
      return truth(known, a < b);
    case Op::less_equal:
      return truth(known, a <= b);
    case Op::greater:
      return truth(known, a > b);
    default:
      return truth(known, a >= b);
  }
}

double apply(Op op, double a, double b) {
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
    case Op::less_equal:
    case Op::greater:
    case Op::greater_equal:
      return compare(op, a, b);
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

Verdict verdict_from(double truth) {
  if (std::isnan(truth)) return Verdict::unknown;
  return truth != 0.0 ? Verdict::yes : Verdict::no;
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
  judgement.verdict = verdict_from(values[count - 1]);
  return judgement;
}

int SharedNumbers::add(const lang::Condition& condition, int node) {
  lang::ExpressionNode own = condition.nodes[static_cast<std::size_t>(node)];
  if (own.left >= 0) own.left = add(condition, own.left);
  if (own.right >= 0) own.right = add(condition, own.right);
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    if (is_same_number(numbers_[i].node, own)) return static_cast<int>(i);
  }
  Number& added = numbers_.emplace_back(Number{own, {}, 0});
  if (own.op == Op::constant) {
    added.fact.value = number(own.number);
    added.known_at = std::numeric_limits<std::uint64_t>::max();
  }
  return static_cast<int>(numbers_.size()) - 1;
}

void SharedNumbers::compute(Number& n, int owner, const Facts& facts) noexcept {
  n.known_at = tick_;
  if (is_name(n.node.op)) {
    n.fact = facts.look_up(n.node, owner);
    n.fact.value = number(n.fact.value);
    return;
  }
  constexpr Fact none;
  const Fact& a = n.node.left < 0 ? none : look_up(n.node.left, owner, facts);
  const Fact& b = n.node.right < 0 ? none : look_up(n.node.right, owner, facts);
  n.fact = {apply(n.node.op, a.value, b.value), a.stale || b.stale};
}

Decision::Decision(const lang::Condition& condition, SharedNumbers& numbers) {
  if (condition.nodes.empty()) return;
  mark(add(condition, static_cast<int>(condition.nodes.size()) - 1, numbers), Verdict::no, Verdict::yes);
}

/// Operands stand before what combines them, as in the condition.
int Decision::add(const lang::Condition& condition, int node, SharedNumbers& numbers) {
  const lang::ExpressionNode& own = condition.nodes[static_cast<std::size_t>(node)];
  Step step{.op = own.op};
  if (is_combination(own.op)) {
    step.kind = Kind::combination;
    step.left = add(condition, own.left, numbers);
    if (own.right >= 0) step.right = add(condition, own.right, numbers);
  } else if (is_comparison(own.op)) {
    step.kind = Kind::comparison;
    step.left = numbers.add(condition, own.left);
    step.right = numbers.add(condition, own.right);
  } else {
    step.left = numbers.add(condition, node);
  }
  steps_.push_back(step);
  return static_cast<int>(steps_.size()) - 1;
}

/// The decision that a value of the step makes. A false operand of an `and` decides as much as a false `and`,
/// and a true operand of an `or` as much as a true `or`. Behind a `not` the two change places.
void Decision::mark(int at, std::optional<Verdict> if_false, std::optional<Verdict> if_true) {
  Step& step = steps_[static_cast<std::size_t>(at)];
  step.if_false = if_false;
  step.if_true = if_true;
  if (step.op == Op::logical_not) mark(step.left, if_true, if_false);
  if (step.op != Op::logical_and && step.op != Op::logical_or) return;
  const bool is_and = step.op == Op::logical_and;
  for (const int operand : {step.left, step.right})
    mark(operand, is_and ? if_false : std::nullopt, is_and ? std::nullopt : if_true);
}

Judgement Decision::decide(int owner, const Facts& facts, SharedNumbers& numbers, std::span<double> values,
                           std::optional<double> release) const noexcept {
  Judgement judgement;
  const std::size_t count = steps_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Step& step = steps_[i];
    double& value = values[i];
    if (step.kind == Kind::comparison) {
      const Fact& a = numbers.look_up(step.left, owner, facts);
      const Fact& b = numbers.look_up(step.right, owner, facts);
      judgement.stale = judgement.stale || a.stale || b.stale;
      const bool is_root = i + 1 == count;
      value = release && is_root ? not_yet_passed(step.op, a.value, *release)
                                 : compare(step.op, a.value, b.value);
    } else if (step.kind == Kind::truth) {
      const Fact& fact = numbers.look_up(step.left, owner, facts);
      judgement.stale = judgement.stale || fact.stale;
      value = fact.value;
    } else {
      const double b = step.right >= 0 ? values[static_cast<std::size_t>(step.right)] : unknown;
      value = apply(step.op, values[static_cast<std::size_t>(step.left)], b);
    }
    if (value == 0.0 && step.if_false) {
      judgement.verdict = *step.if_false;
      return judgement;
    }
    if (value == 1.0 && step.if_true) {
      judgement.verdict = *step.if_true;
      return judgement;
    }
  }
  if (count > 0) judgement.verdict = verdict_from(values[count - 1]);
  return judgement;
}

}  // namespace zwang::runtime
