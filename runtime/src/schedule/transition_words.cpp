#include <cstdio>

#include "schedule/parts.hpp"
#include "zwang/runtime/scheduler.hpp"

namespace zwang::runtime {

namespace {

std::string cause_in_words(const Transition& t, const TaskList& tasks,
                           const std::vector<double>& parameters) {
  switch (t.cause) {
    case Cause::start:
      return "start";
    case Cause::timeout: {
      char text[64];
      std::snprintf(text, sizeof text, "timeout after %g s",
                    tasks[t.from].timeout->after.evaluate(parameters));
      return text;
    }
    case Cause::never_stood:
      return "the brake did not bring the base to rest";
    case Cause::always:
      return tasks[tasks.always()].exits[static_cast<std::size_t>(t.exit)].when.text;
    case Cause::exit:
      break;
  }
  return tasks[t.from].exits[static_cast<std::size_t>(t.exit)].when.text;
}

}  // namespace

std::string Scheduler::why(const Transition& transition) const {
  const TaskList& tasks = parts_->tasks;
  std::string words = cause_in_words(transition, tasks, parts_->parameters);
  if (transition.refusal == Refusal::none) return words;
  const lang::Task& refused = tasks[transition.refused];
  words += ", but `" + refused.name + "` ";
  if (transition.refusal == Refusal::require) return words + "requires " + refused.require->text;
  if (transition.refusal == Refusal::set)
    return words + "needs the pose of `" + unknown_frame(transition) + "`, which is not known";
  return words + "was entered " + std::to_string(refused.attempts->most) + " times";
}

const std::string& Scheduler::note(const Transition& transition) const noexcept {
  static const std::string none;
  const TaskList& tasks = parts_->tasks;
  if (transition.refusal == Refusal::attempts) return tasks[transition.refused].attempts->note;
  if (transition.refusal != Refusal::none) return none;
  if (transition.cause == Cause::timeout) return tasks[transition.from].timeout->note;
  if (transition.cause != Cause::exit && transition.cause != Cause::always) return none;
  const int owner = transition.cause == Cause::always ? tasks.always() : transition.from;
  return tasks[owner].exits[static_cast<std::size_t>(transition.exit)].note;
}

std::string Scheduler::why_with_note(const Transition& transition) const {
  const std::string& text = note(transition);
  return why(transition) + (text.empty() ? "" : ": " + text);
}

const std::string& Scheduler::unknown_frame(const Transition& transition) const noexcept {
  return parts_->declarations[static_cast<std::size_t>(transition.unknown_frame)].name;
}

lang::Span Scheduler::where(const Transition& transition) const noexcept {
  const TaskList& tasks = parts_->tasks;
  if (transition.refusal == Refusal::set) return parts_->refused_set(transition);
  if (transition.refusal == Refusal::require) return tasks[transition.refused].require->span;
  if (transition.refusal == Refusal::attempts) return tasks[transition.refused].attempts->span;
  if (transition.from < 0) return {};
  if (transition.cause == Cause::timeout) return tasks[transition.from].timeout->span;
  if (transition.cause != Cause::exit && transition.cause != Cause::always) return {};
  const int owner = transition.cause == Cause::always ? tasks.always() : transition.from;
  return tasks[owner].exits[static_cast<std::size_t>(transition.exit)].when.span;
}

}  // namespace zwang::runtime
