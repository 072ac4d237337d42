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

bool is_same_name(const lang::ExpressionNode& a, const lang::ExpressionNode& b) {
  return a.op == b.op && a.number == b.number && a.index == b.index && a.axis == b.axis &&
         a.function == b.function && a.in_always == b.in_always && a.what == b.what;
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

int SharedNames::add(const lang::ExpressionNode& name) {
  std::size_t i = 0;
  while (i < names_.size() && !is_same_name(names_[i].node, name)) ++i;
  if (i == names_.size()) names_.push_back({name, {}, false});
  return static_cast<int>(i);
}

void SharedNames::forget() noexcept {
  for (Name& name : names_) name.is_known = false;
}

const Fact& SharedNames::look_up(int name, int owner, const Facts& facts) noexcept {
  Name& n = names_[static_cast<std::size_t>(name)];
  if (!n.is_known) n.fact = facts.look_up(n.node, owner);
  n.is_known = true;
  return n.fact;
}

Decision::Decision(const lang::Condition& condition, SharedNames& names) {
  for (const lang::ExpressionNode& node : condition.nodes) {
    Step& step = steps_.emplace_back(Step{node.op, number(node.number), node.left, node.right});
    if (is_name(node.op)) step.name = names.add(node);
  }
  if (!steps_.empty()) mark(static_cast<int>(steps_.size()) - 1, Verdict::no, Verdict::yes);
}

/// The decision that a value of the node makes. A false operand of an `and` decides as much as a false `and`,
/// and a true operand of an `or` as much as a true `or`. Behind a `not` the two change places.
void Decision::mark(int node, std::optional<Verdict> if_false, std::optional<Verdict> if_true) {
  Step& step = steps_[static_cast<std::size_t>(node)];
  step.if_false = if_false;
  step.if_true = if_true;
  if (step.op == Op::logical_not) mark(step.left, if_true, if_false);
  if (step.op != Op::logical_and && step.op != Op::logical_or) return;
  const bool is_and = step.op == Op::logical_and;
  for (const int operand : {step.left, step.right})
    mark(operand, is_and ? if_false : std::nullopt, is_and ? std::nullopt : if_true);
}

Judgement Decision::decide(int owner, const Facts& facts, SharedNames& names, std::span<double> values,
                           std::optional<double> release, bool& is_whole) const noexcept {
  Judgement judgement;
  is_whole = true;
  const std::size_t count = steps_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Step& step = steps_[i];
    double& value = values[i];
    if (step.name >= 0) {
      const Fact& fact = names.look_up(step.name, owner, facts);
      value = number(fact.value);
      judgement.stale = judgement.stale || fact.stale;
    } else if (step.op == Op::constant) {
      value = step.number;
    } else {
      const double a = step.left >= 0 ? values[static_cast<std::size_t>(step.left)] : unknown;
      const double b = step.right >= 0 ? values[static_cast<std::size_t>(step.right)] : unknown;
      const bool is_root = i + 1 == count;
      value = release && is_root ? not_yet_passed(step.op, a, *release) : apply(step.op, a, b);
    }
    const std::optional<Verdict> decided = value == 0.0   ? step.if_false
                                           : value == 1.0 ? step.if_true
                                                          : std::nullopt;
    if (!decided) continue;
    is_whole = i + 1 == count;
    judgement.verdict = *decided;
    return judgement;
  }
  if (count > 0) judgement.verdict = verdict_from(values[count - 1]);
  return judgement;
}

}  // namespace zwang::runtime
