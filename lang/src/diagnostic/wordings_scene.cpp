#include <algorithm>

#include "diagnostic/make.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "diagnostic/wordings_scenario.hpp"
#include "words/nearest.hpp"
#include "words/text.hpp"
#include "words/units.hpp"

namespace zwang::lang::wording {

namespace {

std::string list_of(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "`" : ", `") + word + "`";
  return text;
}

Diagnostic unknown_word(const char* code, const Span& span, const std::string& message,
                        const std::string& text, const std::vector<std::string>& known) {
  Diagnostic diagnostic = error(code, span, message, "write one of " + list_of(known));
  return with_suggestion(std::move(diagnostic), nearest(text, known));
}

}  // namespace

Diagnostic scripted_with_mass(const Span& span, const std::string& what, const Span& mass) {
  return with_related(error("E902", span, what + " follows a motion and has a mass", "keep one of them"),
                      mass, "`mass` is given here");
}

Diagnostic unknown_outcome(const Span& span, const std::string& text, const std::vector<std::string>& known) {
  std::vector<std::string> likely = known;
  // Nobody who writes `finished` means the opposite.
  std::erase(likely, "unfinished");
  return with_suggestion(
      error("E903", span, in_ticks(text) + " is not how a run can end", "write one of " + list_of(known)),
      meant_key(text, likely));
}

Diagnostic one_expectation(const Span& span) {
  return error("E904", span,
               "an expectation says exactly one of `outcome`, `diagnostic`, `at`, `within`, `always`");
}

Diagnostic at_the_end_only(const Span& span) {
  return with_replacement(
      error("E904", span, "`at` knows one instant, the end", "write `at: end`, or use `within`"), "end");
}

Diagnostic two_outcomes(const Span& span, const std::string& first, const std::string& second,
                        const Span& first_span) {
  return with_related(
      error("E904", span, "a run ends once: `" + first + "` and `" + second + "` exclude each other",
            "keep one of them, or write a scenario for each"),
      first_span, "the other outcome");
}

Diagnostic within_no_time(const Span& span) {
  return error("E904", span, "`within: 0 s` leaves no time: it asks that the condition holds on every tick",
               "write `always`, or give a time");
}

Diagnostic nothing_expected(const Span& span) {
  return error("E904", span, "a scenario that expects nothing cannot fail",
               "write for example `- outcome: done`");
}

Diagnostic empty_matrix_key(const Span& span, const std::string& key) {
  return error("E905", span, "`matrix." + key + "` holds no value: the matrix would be empty");
}

Diagnostic too_many_cells(const Span& span, std::size_t most) {
  return error("E905", span, "with this key the matrix has more than " + std::to_string(most) + " cells",
               "split it into several scenario files");
}

Diagnostic not_a_time(const Span& span, const std::string& name) {
  return error("E906", span, "`of` needs a time, and " + in_ticks(name) + " is none",
               "use for example `truth.wall.touched`");
}

Diagnostic unknown_task_parameter(const Span& span, const std::string& name, const std::string& meant,
                                  const std::vector<std::string>& known, const std::string& task) {
  const std::string has = in_ticks(task) + (known.empty() ? " declares none" : " has " + list_of(known));
  const std::string help = meant.empty() ? has : "did you mean `" + meant + "`? " + has;
  return error("E301", span, "no parameter named " + in_ticks(name), help);
}

Diagnostic refused_cell(const std::vector<Span>& spans, const std::string& cell, const std::string& code,
                        const std::string& reason, const std::string& place) {
  // A value that the cell gives stands in no file of the task.
  const std::string where = place.starts_with("-p:") ? "" : " at " + place;
  Diagnostic diagnostic =
      error("E912", spans.front(),
            "in the cell `" + cell + "` the task is refused, and nothing expects it: " + code + where + ", " +
                reason,
            "leave this out of the matrix, or write `- diagnostic: " + code + "`");
  const auto is_same = [](const Span& a, const Span& b) {
    return a.source == b.source && a.begin.line == b.begin.line && a.begin.column == b.begin.column;
  };
  for (const Span& span : spans) {
    const auto& said = diagnostic.related;
    const bool is_new = !is_same(span, spans.front()) &&
                        std::none_of(said.begin(), said.end(),
                                     [&](const RelatedSpan& other) { return is_same(other.span, span); });
    if (is_new) diagnostic.related.push_back({span, "and with this"});
  }
  return diagnostic;
}

Diagnostic unasked_cells(const Span& span, const std::string& cell) {
  return make("N608", Severity::note, span,
              "from the cell `" + cell + "` on nothing was asked: so many would take too long",
              "`zwang test` asks them all");
}

Diagnostic one_fault(const Span& span) {
  return error("E907", span, "a fault says exactly one thing that goes wrong",
               "`samples`, `clock`, `wheel` with `torque`, `floor_friction`, `payload`, `centre_of_mass`, "
               "`inertia`, `leaves` or `plant`");
}

Diagnostic fault_of_all(const Span& span) {
  return error("E907", span, "floor, objects and plant are not one robot's",
               "leave `robot` out: such a fault is everybody's");
}

Diagnostic leaves_for_good(const Span& span) {
  return error("E907", span, "an object that leaves does not come back", "leave `for` out");
}

Diagnostic unknown_fault(const Span& span, const std::string& key, const std::string& text,
                         const std::vector<std::string>& known) {
  return unknown_word("E907", span, "`" + key + "` cannot be " + in_ticks(text), text, known);
}

Diagnostic fault_without_motor(const Span& span, const std::string& joint) {
  return error("E907", span, "no motor turns " + in_ticks(joint) + ": its torque cannot fail",
               "name a joint of the robot file's `actuated`");
}

Diagnostic too_light(const Span& span, double most) {
  return error("E907", span, "a negative `payload` takes off more than there is",
               "take off at most three quarters of the base link's mass, " + at_most(most, "kg"));
}

Diagnostic too_nimble(const Span& span) {
  return error("E907", span, "a negative `inertia` takes off more than there is",
               "it is a share of the base link's own, -75 % at least");
}

Diagnostic script_step(const Span& span) {
  return error("E908", span, "a step of a script is a time and a value",
               "write for example `[[0 s, false], [5 s, true]]`");
}

Diagnostic mixed_script(const Span& span, const std::string& what, bool starts_with_number,
                        const Span& first) {
  const char* kinds = starts_with_number ? "a truth value among numbers" : "a number among truth values";
  return with_related(error("E908", span, what + " has " + kinds,
                            "a bool signal is true or false, a number signal a number; `lost` is neither"),
                      first, "it begins with this");
}

Diagnostic empty_script(const Span& span, const std::string& what) {
  return with_replacement(
      error("E908", span, what + " has no step", "write `[[0 s, lost]]` for a signal that never comes"),
      "[[0 s, lost]]");
}

Diagnostic empty_motion(const Span& span, const std::string& what) {
  return error("E908", span, what + " names no point",
               "write for example `[{time: 1 s, at: [2 m, 0 m]}]`, or delete the line");
}

Diagnostic times_not_rising(const Span& span, const std::string& what) {
  return error("E908", span, "the times of " + what + " must rise");
}

Diagnostic one_signal_source(const Span& span, const std::string& signal) {
  return error(
      "E908", span, "signal " + in_ticks(signal) + " needs exactly one source",
      "give it a `script`, `pose_of`, `distance_to`, `latch`, `force_of`, `travel_of` or `wrench_at`");
}

Diagnostic all_dropped(const Span& span) {
  return error("E908", span, "`dropouts` must stay below 100 %: nothing would ever arrive");
}

Diagnostic nothing_latches(const Span& span, const std::string& name) {
  return error("E908", span, in_ticks(name) + " has no dock that a hook could latch in", "give it a `dock`");
}

Diagnostic not_felt(const Span& span, const std::string& name) {
  return error(
      "E908", span, "nobody feels " + in_ticks(name) + " here",
      "the first robot feels what it touches: give its own `signals` a `force_of` an object or a robot");
}

Diagnostic delayed_too_long(const Span& span, const std::string& what, double most) {
  return error("E908", span,
               what + " is delayed for longer than anybody remembers, " + format_number(most) + " s");
}

Diagnostic fix_of_measured(const Span& span, const std::string& key, const Span& measured) {
  return with_related(
      error("E909", span, "`state` is told by the wheels and corrected, or measured with noise: not both",
            "keep one of them"),
      measured, in_ticks(key) + " is given here");
}

Diagnostic too_many_robots(const Span& span, std::size_t most) {
  return error("E910", span,
               "a scene holds at most " + std::to_string(most) + " robots beside the first one");
}

Diagnostic no_rollers(const Span& span, const std::string& robot) {
  return error("E911", span, "no wheel of " + in_ticks(robot) + " has rollers that could be real",
               "delete `real_rollers`, or take a robot on mecanum or omni wheels");
}

}  // namespace zwang::lang::wording
