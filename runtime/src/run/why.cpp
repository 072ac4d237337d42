#include "run/why.hpp"

#include <algorithm>
#include <utility>

#include "zwang/runtime/with_unit.hpp"

namespace zwang::runtime {

const char* to_string(WhyCause cause) noexcept {
  switch (cause) {
    case WhyCause::waiting:
      return "waiting";
    case WhyCause::timeout:
      return "timeout";
    case WhyCause::exit:
      return "exit";
    case WhyCause::always:
      return "always";
    case WhyCause::require:
      return "require";
    case WhyCause::attempts:
      return "attempts";
    case WhyCause::set:
      return "set";
    case WhyCause::never_stood:
      return "never_stood";
    case WhyCause::stopped:
      break;
  }
  return "stopped";
}

/// A program that nowhere leads to `done` decides nothing by its start: the last transition stands for it.
void TurningPoint::look(const Transition& t, const Scheduler& scheduler, const LimitTable& limits) noexcept {
  const bool was_open = t.from >= 0 && scheduler.can_reach_done(t.from);
  if (scheduler.can_reach_done(t.to)) {
    found_.reset();
    leads_to_done_ = true;
  } else if (was_open || !leads_to_done_) {
    found_ = t;
    entry_ = last_;
    limit_ = limits.tightest();
  }
  last_ = t;
}

namespace {

WhyCause cause_of(const Transition& t) {
  if (t.refusal == Refusal::require) return WhyCause::require;
  if (t.refusal == Refusal::attempts) return WhyCause::attempts;
  if (t.refusal == Refusal::set) return WhyCause::set;
  switch (t.cause) {
    case Cause::timeout:
      return WhyCause::timeout;
    case Cause::exit:
      return WhyCause::exit;
    case Cause::always:
      return WhyCause::always;
    case Cause::never_stood:
      return WhyCause::never_stood;
    case Cause::start:
      break;
  }
  return WhyCause::waiting;
}

/// One decision in words.
class Sentence {
 public:
  Sentence(const EndOfRun& end, const Why& why) : end_(end), words_{end}, why_(why) {}

  std::string text(const Transition* t) const {
    const std::string of = t != nullptr ? of_transition(*t) : of_the_end();
    const std::string note = t != nullptr ? end_.scheduler.note(*t) : "";
    const std::string told = joined(end_.told), missing = joined(missing_signals());
    // A stop comes last of the guard's reports: wheels that slide seem to have motors that turn the wrong
    // way.
    if (why_.cause == WhyCause::stopped) {
      std::vector<std::string> before = end_.met;
      before.insert(before.end(), end_.told.begin(), end_.told.end());
      return joined(before) + (before.empty() ? "" : "; then ") + of +
             (missing.empty() ? "" : "; " + missing) + at_limit();
    }
    std::string text = note.empty() ? "" : note + ": ";
    for (const std::string& first : {joined(end_.met), missing}) text += first.empty() ? "" : first + "; ";
    return text + of + (told.empty() ? "" : "; ") + told + at_limit();
  }

 private:
  std::string at_limit() const {
    if (!end_.limit) return {};
    const LimitReport& limit = *end_.limit;
    const std::string figure = with_unit(limit.limit, limit.unit);
    const std::string is = limit.is_broken() ? " stood at " + with_unit(limit.worst, limit.unit) +
                                                   ", beyond its limit of " + figure
                                             : " was at its limit, " + figure;
    const std::string keeps = end_.limit_keeps.empty() ? "" : ", which keeps " + end_.limit_keeps;
    return "; " + quoted(limit.row) + is + keeps;
  }

  static std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& one : parts) text += (text.empty() ? "" : "; ") + one;
    return text;
  }

  /// Of the exit that was taken, of a `require`, or of those that were waited for.
  std::vector<std::string> missing_signals() const {
    if (why_.met) return WhyWords::missing(*why_.met);
    std::vector<std::string> all;
    for (const WaitedExit& exit : WhyWords::leading(why_.waited)) {
      for (const std::string& one : WhyWords::missing(exit)) {
        if (std::ranges::find(all, one) == all.end()) all.push_back(one);
      }
    }
    return all;
  }

  /// By how much a timeout came too early. A pace counts as far ahead as the wait was long.
  std::string too_short() const {
    std::optional<double> least;
    for (const WaitedExit& exit : WhyWords::leading(why_.waited)) {
      const std::optional<double> left = WhyWords::time_left(exit);
      if (left && *left < why_.waited.elapsed) least = std::min(left.value(), least.value_or(*left));
    }
    return least ? ", too short by about " + with_unit(*least, "s", 2) + " at its pace" : "";
  }

  static std::string quoted(const std::string& text) { return "`" + text + "`"; }
  const lang::Task& task(int index) const { return end_.scheduler.tasks()[static_cast<std::size_t>(index)]; }

  /// Where an exit of `always` led there, what it interrupted.
  std::string task_with_entry() const {
    std::string name = quoted(why_.waited.task);
    const std::optional<Transition>& entry = end_.turning_point.entry();
    if (!entry || entry->cause != Cause::always || entry->from < 0) return name;
    return name + ", which interrupted " + quoted(task(entry->from).name) + " by " +
           quoted(end_.scheduler.why(*entry)) + words_.place(end_.scheduler.where(*entry)) + ",";
  }

  std::string waiting() const { return words_.of_waiting(why_.waited); }

  std::string of_the_end() const {
    const bool is_in_task = !why_.waited.task.empty();
    if (why_.cause == WhyCause::stopped) {
      const std::string in = is_in_task ? " in " + quoted(why_.waited.task) : "";
      const std::string waited = why_.waited.exits.empty() ? "" : ", which waited: " + waiting();
      return "the protective stop latched" + in + ": " + end_.stop + waited;
    }
    if (!is_in_task) return "no task was entered";
    return quoted(why_.waited.task) + " still waits after " + with_unit(why_.waited.elapsed, "s") + ": " +
           waiting();
  }

  /// The exit that was taken, and what its terms were.
  std::string taken(const Transition& t) const {
    const bool is_always = t.cause == Cause::always;
    std::string text = quoted(why_.waited.task) + " was ended by the exit " + quoted(why_.met->when) +
                       words_.place(why_.met->span) + (is_always ? " of `always`" : "");
    if (is_always && why_.met->verdict == Verdict::unknown) text += ", which fires when it is unknown";
    std::string values;
    for (const WaitedTerm& term : why_.met->terms) {
      if (term.value) values += (values.empty() ? "" : ", ") + with_unit(*term.value, term.unit);
    }
    return text + (values.empty() ? "" : ": " + values);
  }

  std::string way_to_the_refusal(const Transition& t) const {
    const std::string from = t.from < 0 ? "the start" : quoted(task(t.from).name);
    return from + " led to " + quoted(task(t.refused).name) +
           (t.cause == Cause::start ? "" : " by " + quoted(cause_alone(t)));
  }

  std::string cause_alone(const Transition& t) const {
    Transition alone = t;
    alone.refusal = Refusal::none;
    return end_.scheduler.why(alone);
  }

  std::string of_transition(const Transition& t) const {
    switch (why_.cause) {
      case WhyCause::timeout:
        return task_with_entry() + " waited " + with_unit(why_.waited.elapsed, "s") + ", its timeout" +
               words_.place(end_.scheduler.where(t)) + too_short() + ": " + waiting();
      case WhyCause::exit:
      case WhyCause::always: {
        const bool has_others = !why_.waited.exits.empty() && why_.cause == WhyCause::always;
        return taken(t) + (has_others ? "; it waited: " + waiting() : "");
      }
      case WhyCause::require:
        return way_to_the_refusal(t) + ", which requires " + quoted(why_.met->when) +
               words_.place(why_.met->span) + ": " + words_.of_terms(*why_.met);
      case WhyCause::attempts:
        return way_to_the_refusal(t) + ", which had been entered " +
               std::to_string(task(t.refused).attempts->most) + " times, all its attempts" +
               words_.place(end_.scheduler.where(t)) + "; " + quoted(why_.waited.task) +
               " waited: " + waiting();
      case WhyCause::set:
        return way_to_the_refusal(t) + ", on the way a frame is set" + words_.place(end_.scheduler.where(t)) +
               ", which needs the pose of " + quoted(end_.scheduler.unknown_frame(t)) + ": it is not known";
      case WhyCause::never_stood:
        return "the brake did not bring the base to rest";
      case WhyCause::waiting:
      case WhyCause::stopped:
        break;
    }
    return of_the_end();
  }

  const EndOfRun& end_;
  WhyWords words_;
  const Why& why_;
};

void note_refusals(const std::vector<RefusedSignal>& refused, WaitedExit& exit) {
  for (WaitedTerm& term : exit.terms) {
    for (WaitedSignal& signal : term.signals) {
      const auto one = std::ranges::find(refused, signal.name, &RefusedSignal::name);
      if (one == refused.end()) continue;
      signal.refused = true;
      signal.ahead = one->ahead;
    }
  }
}

}  // namespace

Why why_of(const EndOfRun& end) {
  const Scheduler& scheduler = end.scheduler;
  const std::optional<Transition>& found = end.turning_point.found();
  const bool decided = end.is_decided && cause_of(*found) != WhyCause::waiting;
  Why why;
  why.time = decided ? found->time : end.time;
  if (!end.stop.empty()) why.cause = WhyCause::stopped;
  const int task = decided ? found->from : scheduler.task();
  if (decided) {
    why.cause = cause_of(*found);
    if (why.cause == WhyCause::require) {
      why.met = scheduler.required(found->refused);
    } else if (found->exit >= 0) {
      const int owner = found->cause == Cause::always ? scheduler.always_task() : found->from;
      why.met = scheduler.waited(owner).exits[static_cast<std::size_t>(found->exit)];
    }
  }
  if (task >= 0) why.waited = scheduler.waited(task);
  for (WaitedExit& exit : why.waited.exits) note_refusals(end.refused, exit);
  if (why.met) note_refusals(end.refused, *why.met);
  if (end.limit) why.limit = end.limit->row;
  why.sentence = Sentence(end, why).text(decided ? &*found : nullptr);
  return why;
}

}  // namespace zwang::runtime
