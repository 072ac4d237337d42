// Step 7 of the tick: the switch, `set`, and every `here`.
#include <algorithm>

#include "schedule/braking.hpp"
#include "schedule/kinetic_energy.hpp"
#include "schedule/parts.hpp"

namespace zwang::runtime {

void Scheduler::Parts::apply(const std::vector<lang::SetAction>& actions) noexcept {
  for (const lang::SetAction& action : actions) {
    const auto i = static_cast<std::size_t>(action.index);
    switch (action.kind) {
      case lang::SetKind::frame:
        frames.set(action.index, action.source);
        break;
      case lang::SetKind::parameter:
        parameters[i] = action.value.evaluate(parameters);
        break;
      case lang::SetKind::output:
        outputs[i] = action.value.evaluate(parameters);
        break;
    }
  }
}

/// The frame whose pose is not known now, of the copied frames and the set ones; -1: none. A frame that is
/// set from it, or depends on it, would be at a false place.
int Scheduler::Parts::unknown_frame_of(const std::vector<lang::SetAction>& actions) const noexcept {
  for (const lang::SetAction& action : actions) {
    if (action.kind != lang::SetKind::frame) continue;
    if (!is_known(action.source)) return action.source;
    if (!is_known(action.index)) return action.index;
  }
  return -1;
}

/// No task begins with a frame at a false place.
void Scheduler::Parts::refuse_set(Transition& t, int unknown_frame) const noexcept {
  t.refusal = Refusal::set;
  t.refused = t.to;
  t.unknown_frame = unknown_frame;
  t.to = tasks.failed();
  t.resumes = false;
}

/// The actions of the exit that is taken; nullptr where no exit is.
const std::vector<lang::SetAction>* Scheduler::Parts::exit_sets(const Transition& t) const noexcept {
  if (t.cause != Cause::always && t.cause != Cause::exit) return nullptr;
  const int owner = t.cause == Cause::always ? tasks.always() : t.from;
  return &tasks[owner].exits[static_cast<std::size_t>(t.exit)].set;
}

/// Where the `set` stands that refused the switch.
lang::Span Scheduler::Parts::refused_set(const Transition& t) const noexcept {
  for (const std::vector<lang::SetAction>* sets : {exit_sets(t), &tasks[t.refused].set_on_entry}) {
    if (sets == nullptr) continue;
    for (const lang::SetAction& action : *sets) {
      const bool sets_frame = action.kind == lang::SetKind::frame;
      if (sets_frame && (action.source == t.unknown_frame || action.index == t.unknown_frame))
        return action.span;
    }
  }
  return {};
}

/// `back` where nothing was interrupted has nowhere to go.
void Scheduler::Parts::lead(Transition& t, const lang::Target& target) const noexcept {
  t.resumes = false;
  switch (target.kind) {
    case lang::TargetKind::task:
      t.to = target.task;
      return;
    case lang::TargetKind::done:
      t.to = tasks.done();
      return;
    case lang::TargetKind::back:
      t.resumes = interruption.task >= 0;
      t.to = t.resumes ? interruption.task : tasks.failed();
      return;
    case lang::TargetKind::failed:
      t.to = tasks.failed();
      return;
  }
}

/// Whether the next entry would be one more than the task may have.
bool Scheduler::Parts::is_used_up(int of_task) const noexcept {
  const auto& attempts = tasks[of_task].attempts;
  return attempts && entries[static_cast<std::size_t>(of_task)] >= attempts->most;
}

/// Past the tasks whose attempts are used up; to `failed` where one requires what does not hold, or sets a
/// frame from what is not known.
void Scheduler::Parts::turn_away(Transition& t) noexcept {
  for (int hops = 0; hops <= tasks.program_tasks; ++hops) {
    if (t.resumes || tasks.ends(t.to)) return;
    const lang::Task& next = tasks[t.to];
    if (is_used_up(t.to)) {
      t.refusal = Refusal::attempts;
      t.refused = t.to;
      lead(t, next.attempts->target);
      continue;
    }
    std::vector<double>& values = left[static_cast<std::size_t>(t.to)].required;
    if (next.require && evaluate(*next.require, t.to, *this, values).verdict != Verdict::yes) {
      t.refusal = Refusal::require;
      t.refused = t.to;
      t.to = tasks.failed();
      return;
    }
    if (const int frame = unknown_frame_of(next.set_on_entry); frame >= 0) refuse_set(t, frame);
    return;
  }
  t.to = tasks.failed();  // attempts that lead to one another in a circle
}

/// An interruption of an interruption does not change where `back` leads.
void Scheduler::Parts::interrupt(const Transition& t) noexcept {
  if (t.cause != Cause::always || interruption.task >= 0 || tasks.ends(task)) return;
  interruption = {task, elapsed()};
  frames.keep_sums();
}

void Scheduler::Parts::enter() noexcept {
  ++entries[static_cast<std::size_t>(task)];
  apply(active().set_on_entry);
  entered = now;
  entered_last[static_cast<std::size_t>(task)] = now;
  frames.start_sums();
  // It is over where no `back` can follow.
  if (!tasks.leads_back[static_cast<std::size_t>(task)]) interruption = {};
  if (is_at_end()) {
    phase = Phase::stopping;
    energy_at_end = kinetic_energy(model, *state, frames.motions());
    rest.begin();
    outcome = task == tasks.done() ? Outcome::done : Outcome::failed;
    stop_outputs();
  }
}

void Scheduler::Parts::stop_outputs() noexcept {
  for (std::size_t i = 0; i < outputs.size(); ++i) outputs[i] = declared_outputs[i].stop.value_or(outputs[i]);
}

/// No entry: neither counted nor asked what it requires, nothing is set, and the time goes on where it was.
void Scheduler::Parts::resume() noexcept {
  entered = now - interruption.spent;
  frames.resume_sums();
  interruption = {};
}

/// The present state of its exits. A reader who asks why a task went on wants to see all of a condition, not
/// only the operands that decided it.
void Scheduler::Parts::remember(TaskSnapshot& snapshot, int of_task) const noexcept {
  const Guards& of = of_task == tasks.always() ? always_guards : guards;
  const std::vector<lang::Exit>& exits = tasks[of_task].exits;
  snapshot.elapsed = elapsed();
  snapshot.course = of.course();
  for (std::size_t i = 0; i < snapshot.exits.size(); ++i) {
    TaskSnapshot::Exit& exit = snapshot.exits[i];
    evaluate(exits[i].when, of_task, *this, exit.values);
    exit.true_for = of.dwell(i);
    exit.longest = of.longest(i);
    exit.times = of.times(i);
  }
  for (std::size_t i = 0; i < snapshot.signals.size(); ++i)
    snapshot.signals[i] = signals.state(static_cast<int>(i));
}

void Scheduler::Parts::take(Choice choice) noexcept {
  Transition& t = choice.transition;
  for (const int owner : {task, tasks.always()}) {
    if (task >= 0) remember(left[static_cast<std::size_t>(owner)], owner);
  }
  const std::vector<lang::SetAction>* sets = exit_sets(t);
  const int unknown = sets != nullptr ? unknown_frame_of(*sets) : -1;
  if (sets != nullptr && unknown < 0) apply(*sets);
  interrupt(t);
  lead(t, choice.target);
  if (unknown < 0) {
    turn_away(t);
  } else if (!tasks.ends(t.to)) {
    refuse_set(t, unknown);
  }
  transition = t;
  task = t.to;
  if (t.resumes) {
    resume();
  } else {
    enter();
  }
  guards.restart();
  list_axes(t.resumes);
  start_blend();
}

void Scheduler::Parts::list_axes(bool resumes) noexcept {
  for (const int owner : {tasks.always(), task}) follow_paths(owner, owner == task && !resumes);
  const auto list = [&](int owner) {
    const lang::Task& t = tasks[owner];
    for (std::size_t g = 0; g < t.groups.size(); ++g) {
      for (std::size_t i = 0; i < t.groups[g].axes.size(); ++i) {
        axes.push_back(active_axis({owner, static_cast<int>(g), static_cast<int>(i)}));
        capture_here(axes.back());
      }
    }
  };
  // The axes of `always` stay, with their `here`, from the start of the run on.
  if (axes.empty()) {
    list(tasks.always());
    always_axes = axes.size();
  }
  axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(always_axes), axes.end());
  list(task);
}

ActiveAxis Scheduler::Parts::active_axis(const Origin& origin) noexcept {
  ActiveAxis a;
  a.origin = origin;
  a.group = &group(origin);
  a.says = &a.group->axes[static_cast<std::size_t>(origin.axis)];
  a.fence = fence_of[static_cast<std::size_t>(origin.task)][static_cast<std::size_t>(origin.group)];
  if (limits_a_plane(*a.says))
    a.plane = plane_of[static_cast<std::size_t>(origin.task)][static_cast<std::size_t>(origin.group)];
  a.brakes = braking_direction(*a.group, *a.says);
  a.hangs_on_signal = frames.signal_of(a.group->in) >= 0 || frames.signal_of(a.group->move) >= 0 ||
                      a.says->target.signal >= 0 || a.says->yield;
  a.is_along_path = a.group->path >= 0;
  // The braking of a range of places depends on the base's heading. The acceleration of a base that rolls
  // depends on its turning.
  const bool rolls = a.plane >= 0 && planes[static_cast<std::size_t>(a.plane)].rolls;
  a.varies = a.hangs_on_signal || a.is_along_path || a.says->position || a.says->build_up || rolls;
  return a;
}

/// Acceleration and force ranges on the base itself leave less for braking along their axis.
int Scheduler::Parts::braking_direction(const lang::Group& g, const lang::AxisStatements& s) const noexcept {
  return s.acceleration || (s.force && !s.driver) ? base_direction(g, s) : -1;
}

/// Of the base's x, y and rz the one that an axis of the base itself speaks of; `both_axes`; -1: none.
int Scheduler::Parts::base_direction(const lang::Group& g, const lang::AxisStatements& s) const noexcept {
  const bool on_base =
      g.kind == lang::GroupKind::axes && is_base(declarations, g.move) && is_base(declarations, g.in);
  if (!on_base) return -1;
  if (s.is_planar) return both_axes;
  switch (s.axis) {
    case solver::Axis::x:
      return 0;
    case solver::Axis::y:
      return 1;
    case solver::Axis::rz:
      return 2;
    default:
      return -1;
  }
}

void Scheduler::Parts::capture_here(ActiveAxis& a) noexcept {
  const lang::AxisStatements& s = *a.says;
  const lang::Group& g = *a.group;
  if (!s.here || a.has_here || !is_known(g.in) || is_off_path(g)) return;
  const solver::AttachedFrame& move = frames.attached(g.move);
  const solver::AttachedFrame& in = frames.attached(g.in);
  // Axes that the moved body carries cannot tell where it is: they stay where they were on entry.
  if (in.body >= 0 && in.body == move.body) a.entry_axes = solver::AttachedFrame{-1, frames.pose(g.in), {}};
  a.here = position_of(g, s, &a);
  a.has_here = true;
}

}  // namespace zwang::runtime
