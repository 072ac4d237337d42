// The conditions that the exits of a task waited for, from the values of their nodes.
#include <algorithm>
#include <cmath>

#include "schedule/parts.hpp"
#include "zwang/lang/printable.hpp"
#include "zwang/runtime/with_unit.hpp"

namespace zwang::runtime {

const char* to_string(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::no:
      return "false";
    case Verdict::yes:
      return "true";
    case Verdict::unknown:
      break;
  }
  return "unknown";
}

namespace {

using lang::Op;

Verdict verdict_of(double truth) {
  if (std::isnan(truth)) return Verdict::unknown;
  return truth != 0.0 ? Verdict::yes : Verdict::no;
}

/// A condition with the value that each of its nodes had.
struct Evaluated {
  const lang::ExpressionNode& node(int i) const { return condition.nodes[static_cast<std::size_t>(i)]; }
  double value(int i) const { return values[static_cast<std::size_t>(i)]; }
  int root() const { return static_cast<int>(condition.nodes.size()) - 1; }

  const lang::Condition& condition;
  std::span<const double> values;
};

/// The nodes that keep `node` from being `wanted`. For an `and` that should be true, they are the operands
/// that are not true. For an `and` that should be false, they are both operands. An `or` is the other way
/// around. Behind a `not` the wanted value is reversed.
void find_holders(const Evaluated& of, int node, bool wanted, std::vector<int>& holders) {
  const Verdict now = verdict_of(of.value(node));
  if (now == (wanted ? Verdict::yes : Verdict::no)) return;
  const lang::ExpressionNode& n = of.node(node);
  switch (n.op) {
    case Op::logical_and:
    case Op::logical_or:
      find_holders(of, n.left, wanted, holders);
      find_holders(of, n.right, wanted, holders);
      return;
    case Op::logical_not:
      return find_holders(of, n.left, !wanted, holders);
    default:
      holders.push_back(node);
  }
}

/// The names in an expression that are not known.
void find_unknown_names(const Evaluated& of, int node, std::vector<int>& names) {
  const lang::ExpressionNode& n = of.node(node);
  if (n.op >= Op::parameter && n.op <= Op::estimated_wrench) {
    const bool is_lost_signal = n.op == Op::valid && of.value(node) == 0.0;
    if (std::isnan(of.value(node)) || is_lost_signal) names.push_back(node);
    return;
  }
  if (n.left >= 0) find_unknown_names(of, n.left, names);
  if (n.right >= 0) find_unknown_names(of, n.right, names);
}

bool is_fixed(Op op) {
  return op == Op::constant || op == Op::parameter;
}

void put_values(const Evaluated& of, const lang::ExpressionNode& term, WaitedTerm& waited) {
  const auto finite = [&](int i) {
    return std::isfinite(of.value(i)) ? std::optional(of.value(i)) : std::nullopt;
  };
  if (!(term.op >= Op::less && term.op <= Op::greater_equal)) return;
  const bool left_is_fixed = is_fixed(of.node(term.left).op),
             right_is_fixed = is_fixed(of.node(term.right).op);
  waited.value = finite(left_is_fixed ? term.right : term.left);
  if (!left_is_fixed && !right_is_fixed) waited.bound = finite(term.right);
}

/// Why a name is not known, where no signal is the reason.
const char* reason_of(Op op) {
  switch (op) {
    case Op::coordinate:
      return "the row is not in force";
    case Op::of_task:
      return "the task was never entered";
    case Op::estimated_force:
    case Op::estimated_wrench:
      return "the contact force is not estimated";
    default:
      return "it is no finite number";
  }
}

}  // namespace

/// The signals that a name hangs on: itself, or those that its frames hang on.
std::vector<int> Scheduler::Parts::signals_of(const lang::ExpressionNode& name, int owner) const {
  std::vector<int> found;
  const auto add_frame = [&](int frame) {
    if (frames.signal_of(frame) >= 0) found.push_back(frames.signal_of(frame));
  };
  switch (name.op) {
    case Op::signal:
    case Op::valid:
      found.push_back(name.index);
      break;
    case Op::of_frame:
      add_frame(name.index);
      break;
    case Op::feature:
      add_frame(features[static_cast<std::size_t>(name.index)].first);
      add_frame(features[static_cast<std::size_t>(name.index)].second);
      break;
    case Op::coordinate: {
      const Origin origin{name.in_always ? tasks.always() : owner, name.index, name.axis};
      add_frame(group(origin).move);
      add_frame(group(origin).in);
      break;
    }
    default:
      break;
  }
  return found;
}

WaitedExit Scheduler::Parts::waited(const lang::Condition& condition, int owner,
                                    std::span<const double> values,
                                    const std::vector<SignalState>& states) const {
  WaitedExit exit;
  exit.when = lang::in_one_line(condition.text);
  exit.span = condition.span;
  if (condition.nodes.empty()) return exit;
  const Evaluated of{condition, values};
  exit.verdict = verdict_of(of.value(of.root()));
  std::vector<int> holders;
  find_holders(of, of.root(), true, holders);
  std::vector<lang::ConditionTerm> terms = condition.terms;
  if (terms.empty()) terms.push_back({of.root(), exit.when, ""});
  for (const lang::ConditionTerm& term : terms) {
    WaitedTerm& waited = exit.terms.emplace_back();
    waited.text = term.text;
    waited.unit = term.unit;
    waited.verdict = verdict_of(of.value(term.node));
    waited.holds_back = std::ranges::find(holders, term.node) != holders.end();
    put_values(of, of.node(term.node), waited);
    std::vector<int> unknown;
    find_unknown_names(of, term.node, unknown);
    std::vector<int> lost;
    for (const int name : unknown) {
      for (const int signal : signals_of(of.node(name), owner)) {
        const bool is_new = std::ranges::find(lost, signal) == lost.end();
        if (is_new && !states[static_cast<std::size_t>(signal)].known) lost.push_back(signal);
      }
    }
    for (const int signal : lost) {
      const SignalState& then = states[static_cast<std::size_t>(signal)];
      const lang::Signal& declared = signals.declared(signal);
      waited.signals.push_back(
          {declared.name, then.received, then.age, declared.stale_after.evaluate(parameters)});
    }
    if (waited.verdict == Verdict::unknown && lost.empty())
      waited.because = reason_of(unknown.empty() ? Op::constant : of.node(unknown.front()).op);
  }
  return exit;
}

std::string Scheduler::Parts::name_of(const lang::Target& target) const {
  switch (target.kind) {
    case lang::TargetKind::task:
      return tasks[target.task].name;
    case lang::TargetKind::back:
      return "back";
    case lang::TargetKind::done:
      return "done";
    case lang::TargetKind::failed:
      break;
  }
  return "failed";
}

/// What drives the coordinate that the term looks at, where that is one alone.
std::string Scheduler::Parts::asked_of(const lang::Condition& condition, const Compared& compared,
                                       const std::string& unit, int owner) const {
  const auto frame_name = [&](int frame) { return declarations[static_cast<std::size_t>(frame)].name; };
  const lang::ExpressionNode* found = nullptr;
  std::vector<int> open = {compared.left, compared.right};
  while (!open.empty()) {
    const lang::ExpressionNode& n = condition.nodes[static_cast<std::size_t>(open.back())];
    open.pop_back();
    for (const int operand : {n.left, n.right}) {
      if (operand >= 0) open.push_back(operand);
    }
    if (is_fixed(n.op) || n.left >= 0) continue;
    if (n.op != Op::coordinate || found != nullptr) return {};
    found = &n;
  }
  if (found == nullptr) return {};
  const Origin origin{found->in_always ? tasks.always() : owner, found->index, found->axis};
  const lang::Group& row = group(origin);
  if (row.kind == lang::GroupKind::inside) return {};
  const lang::AxisStatements& axis = row.axes[static_cast<std::size_t>(found->axis)];
  std::string words = "`" + axis.name + "`";
  if (row.kind == lang::GroupKind::axes && row.move != row.in)
    words += " of `" + frame_name(row.move) + "` in `" + frame_name(row.in) + "`";
  if (!axis.driver) return words + " is driven by no row";
  const bool is_rate = *axis.driver == solver::Quantity::velocity;
  const bool is_of_rate = found->what == lang::CoordinateQuantity::velocity;
  const bool is_of_position = found->what == lang::CoordinateQuantity::position;
  const bool is_comparable =
      is_rate ? is_of_rate || is_of_position : is_of_position && *axis.driver == solver::Quantity::position;
  if (axis.here || axis.yield || !is_comparable) return {};
  return words + " is driven to " +
         with_unit(axis.target.evaluate(parameters), unit + (is_rate && is_of_position ? "/s" : ""));
}

/// How each comparison that holds the exit back went on while the task waited.
void Scheduler::Parts::follow_course(const TaskSnapshot& snapshot, int owner, std::size_t exit,
                                     WaitedExit& waited) const {
  const GuardedExits& of = guarded[static_cast<std::size_t>(owner)];
  const lang::Condition& condition = of.exits[exit].when;
  for (std::size_t t = 0; t < condition.terms.size(); ++t) {
    WaitedTerm& term = waited.terms[t];
    const auto same = [&](const Compared& one) {
      return one.exit == exit && one.node == condition.terms[t].node;
    };
    const auto compared = std::ranges::find_if(of.compared, same);
    if (!term.holds_back || compared == of.compared.end()) continue;
    const bool is_turned = term.verdict == Verdict::yes;
    const double lack = lack_of(*compared, snapshot.exits[exit].values) * (is_turned ? -1.0 : 1.0);
    const auto index = static_cast<std::size_t>(compared - of.compared.begin());
    const Trend trend = snapshot.course.trend(index, lack, is_turned, period);
    term.left = trend.left;
    term.stood = trend.stood;
    term.stood_throughout = trend.is_whole;
    term.recedes = trend.grows;
    if (trend.stood > 0.0) term.asked = asked_of(condition, *compared, term.unit, owner);
  }
}

WaitedTask Scheduler::waited(int task) const {
  const Parts& p = *parts_;
  const lang::Task& of = p.tasks[task];
  const bool is_active = task == p.task || (task == p.tasks.always() && p.phase == Phase::running);
  TaskSnapshot now = p.left[static_cast<std::size_t>(task)];
  if (is_active) p.remember(now, task);
  WaitedTask waited;
  waited.task = of.name;
  waited.elapsed = now.elapsed;
  for (std::size_t i = 0; i < of.exits.size(); ++i) {
    const lang::Exit& exit = of.exits[i];
    WaitedExit& one = waited.exits.emplace_back(p.waited(exit.when, task, now.exits[i].values, now.signals));
    one.column = of.name + ".exit" + std::to_string(i + 1) + ".true_for";
    one.target = p.name_of(exit.target);
    one.can_reach_done = exit.target.kind == lang::TargetKind::task
                             ? can_reach_done(exit.target.task)
                             : exit.target.kind != lang::TargetKind::failed;
    one.true_for = now.exits[i].true_for;
    one.longest = now.exits[i].longest;
    one.times = now.exits[i].times;
    p.follow_course(now, task, i, one);
    one.needed = exit.dwell.evaluate(p.parameters);
  }
  return waited;
}

WaitedExit Scheduler::required(int task) const {
  const Parts& p = *parts_;
  const lang::Task& of = p.tasks[task];
  if (!of.require) return {};
  const TaskSnapshot& asked = p.left[static_cast<std::size_t>(task)];
  std::vector<SignalState> states;
  for (std::size_t i = 0; i < asked.signals.size(); ++i)
    states.push_back(p.signals.state(static_cast<int>(i)));
  WaitedExit required = p.waited(*of.require, task, asked.required, states);
  required.target = of.name;
  return required;
}

bool Scheduler::can_reach_done(int task) const noexcept {
  return parts_->tasks.reaches_done[static_cast<std::size_t>(task)];
}

}  // namespace zwang::runtime
