// Steps 5 and 6 of the tick: guards, then at most one transition.
#include "schedule/at_rest.hpp"
#include "schedule/parts.hpp"

namespace zwang::runtime {

namespace {

void mark(std::uint64_t& bits, std::size_t exit) {
  if (exit < 64) bits |= std::uint64_t{1} << exit;
}

}  // namespace

/// The exits of `always` are evaluated on every tick. A task's exits are not evaluated on the tick it is
/// entered: this is not called on that tick.
void Scheduler::Parts::advance_guards() noexcept {
  always_guards.advance(guarded[static_cast<std::size_t>(tasks.always())], *this, parameters);
  if (task >= 0) guards.advance(guarded[static_cast<std::size_t>(task)], *this, parameters);
}

bool Scheduler::Parts::is_own_target(const lang::Target& target) const noexcept {
  return target.kind == lang::TargetKind::task && target.task == task;
}

/// Where the target leads past the tasks whose attempts are used up; to the active one in any case.
lang::Target Scheduler::Parts::led_past(lang::Target target) const noexcept {
  for (int hops = 0; hops <= tasks.program_tasks; ++hops) {
    if (target.kind != lang::TargetKind::task || is_own_target(target) || !is_used_up(target.task)) break;
    target = tasks[target.task].attempts->target;
  }
  return target;
}

/// An exit of `always` is ignored while its own target is active, or the target of used up attempts. `back`
/// is ignored if no task was interrupted.
bool Scheduler::Parts::is_heeded(const lang::Target& target) const noexcept {
  const lang::Target to = led_past(target);
  return to.kind == lang::TargetKind::back ? interruption.task >= 0 : !is_own_target(to);
}

/// The exit of `always` that fires: the first that is due; -1 for none. If a due exit's own target is active,
/// only the exits below it that end the run can fire. Otherwise two due exits would alternate.
int Scheduler::Parts::first_interruption() const noexcept {
  const std::vector<lang::Exit>& exits = tasks[tasks.always()].exits;
  bool stays = false;
  for (std::size_t i = 0; i < exits.size(); ++i) {
    const lang::Target& target = exits[i].target;
    const bool ends = target.kind == lang::TargetKind::done || target.kind == lang::TargetKind::failed;
    if ((stays && !ends) || !always_guards.is_due(exits, i, parameters)) continue;
    if (is_heeded(target)) return static_cast<int>(i);
    stays = stays || is_own_target(target);
  }
  return -1;
}

bool Scheduler::Parts::is_timed_out() const noexcept {
  const auto& timeout = active().timeout;
  return timeout && elapsed() >= timeout->after.evaluate(parameters) - clock_rounding * period;
}

/// Order is priority: the exits of `always`, the timeout, then the task's exits, each from top to bottom.
std::optional<Scheduler::Parts::Choice> Scheduler::Parts::choose() noexcept {
  Choice choice;
  Transition& t = choice.transition;
  t.time = now;
  t.from = task;
  bool any = false;
  const auto offer = [&](Cause cause, int exit, const lang::Target& target) {
    if (any) return false;
    any = true;
    t.cause = cause;
    t.exit = exit;
    choice.target = target;
    return true;
  };
  const std::vector<lang::Exit>& interrupting = tasks[tasks.always()].exits;
  const int first = first_interruption();
  if (first >= 0) offer(Cause::always, first, interrupting[static_cast<std::size_t>(first)].target);
  for (std::size_t i = any ? static_cast<std::size_t>(first) + 1 : interrupting.size();
       i < interrupting.size(); ++i) {
    if (is_heeded(interrupting[i].target) && always_guards.is_due(interrupting, i, parameters))
      mark(t.also_always, i);
  }
  if (is_timed_out()) t.also_timeout = !offer(Cause::timeout, -1, active().timeout->target);
  const std::vector<lang::Exit>& exits = active().exits;
  for (std::size_t i = 0; i < exits.size(); ++i) {
    if (!guards.is_due(exits, i, parameters)) continue;
    if (!offer(Cause::exit, static_cast<int>(i), exits[i].target)) mark(t.also_true, i);
  }
  if (!any) return std::nullopt;
  return choice;
}

/// Once the end is reached, the one thing that can still change it is an exit of `always` to `failed`.
std::optional<Scheduler::Parts::Choice> Scheduler::Parts::choose_while_stopping() noexcept {
  if (task != tasks.done()) return std::nullopt;
  const std::vector<lang::Exit>& exits = tasks[tasks.always()].exits;
  for (std::size_t i = 0; i < exits.size(); ++i) {
    if (exits[i].target.kind != lang::TargetKind::failed) continue;
    if (!always_guards.is_due(exits, i, parameters)) continue;
    Choice choice;
    choice.transition.time = now;
    choice.transition.from = task;
    choice.transition.cause = Cause::always;
    choice.transition.exit = static_cast<int>(i);
    choice.target = exits[i].target;
    return choice;
  }
  return std::nullopt;
}

void Scheduler::Parts::check_rest() noexcept {
  if (phase != Phase::stopping) return;
  rest.look(state->base_twist, period);
  if (model.has_fixed_base() || rest.stood_for() >= rest_dwell - clock_rounding * period) {
    has_stood = true;
    phase = Phase::finished;
  } else if (elapsed() > longest_stop) {
    if (task == tasks.done()) {
      Transition t;
      t.time = now;
      t.from = task;
      t.to = tasks.failed();
      t.cause = Cause::never_stood;
      transition = t;
    }
    outcome = Outcome::failed;
    phase = Phase::finished;
  }
}

}  // namespace zwang::runtime
