#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "diagnostic/make.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_never.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "words/nearest.hpp"
#include "words/text.hpp"
#include "words/units.hpp"
#include "zwang/lang/condition_function.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang::wording {

namespace {

// Of many names the first are shown, `world` and the base of frames, and the last: the file's own.
constexpr std::size_t most_shown = 16, first_shown = 2;

std::vector<std::string> shown_of(std::vector<std::string> names) {
  std::erase(names, "");
  if (names.size() <= most_shown) return names;
  const auto begin = names.begin() + first_shown;
  names.erase(begin, begin + static_cast<std::ptrdiff_t>(names.size() - most_shown));
  return names;
}

std::string known_here(const std::vector<std::string>& names) {
  const std::vector<std::string> shown = shown_of(names);
  const bool is_cut = std::count(names.begin(), names.end(), "") + std::ssize(shown) < std::ssize(names);
  std::string text;
  for (std::size_t i = 0; i < shown.size(); ++i)
    text += (i == 0 ? "known here: " : is_cut && i == first_shown ? ", .., " : ", ") + shown[i];
  return text;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "`" : ", `") + name + "`";
  return text;
}

std::string unit_to_write(const Dimension& expected) {
  const std::string unit = usual_unit(expected);
  return unit.empty() ? "write it without a unit"
                      : "write it in `" + unit + "`, or another unit of that kind";
}

}  // namespace

Diagnostic needs_unit(const Span& span, const std::string& what, const std::string& number,
                      const Dimension& expected) {
  const std::string written = with_unit(number, expected);
  return with_replacement(error("E201", span, what + " needs a unit", "write `" + written + "`"), written);
}

Diagnostic wrong_dimension(const Span& span, const std::string& what, const Dimension& expected,
                           const Dimension& found) {
  return error("E202", span, what + " is " + describe(expected) + ", but this is " + describe(found),
               unit_to_write(expected));
}

Diagnostic wrong_parameter_dimension(const Span& span, const std::string& what, const Dimension& expected,
                                     const std::string& parameter, const Dimension& found,
                                     const Span& declared) {
  return with_related(
      error("E202", span,
            what + " is " + describe(expected) + ", but `" + parameter + "` is " + describe(found)),
      declared, "`" + parameter + "` is declared here");
}

Diagnostic unlike_operands(const Span& span, const std::string& op, const Dimension& left,
                           const Dimension& right) {
  const bool compares = op[0] == '<' || op[0] == '>';
  const std::string verb = compares ? "compared with " : op == "+" ? "added to " : "set off against ";
  const std::string a = usual_unit(left), b = usual_unit(right);
  const std::string units = a.empty() || b.empty() ? "" : ": " + in_ticks(a) + " or " + in_ticks(b);
  return error("E202", span, describe(left) + " cannot be " + verb + describe(right),
               "give both the same unit" + units);
}

Diagnostic unknown_unit(const Span& span, const std::string& text, const std::string& unknown,
                        const std::string& meant) {
  Diagnostic diagnostic = error("E203", span, in_ticks(unknown) + " is not a unit zwang knows");
  if (unknown == "tick" || unknown == "ticks")
    diagnostic.help = "write the time in `s` or `ms`; a tick is 1 ms unless the robot file says otherwise";
  if (unknown == "rpm") diagnostic.help = "a turn has 360 deg: 1 rpm is `6 deg/s`";
  if (unknown == "rps") diagnostic.help = "a turn has 360 deg: one a second is `360 deg/s`";
  if (meant.empty()) return diagnostic;
  std::string written = text;
  const std::size_t at = text.rfind(unknown);
  if (at != std::string::npos) {
    const bool is_glued = at > 0 && text[at - 1] >= '0' && text[at - 1] <= '9';
    written.replace(at, unknown.size(), (is_glued ? " " : "") + meant);
    diagnostic.replacement = written;
  }
  // The whole value, not the unit alone: it can be copied as it stands.
  diagnostic.help = "did you mean `" + (at == std::string::npos ? meant : written) + "`?";
  return diagnostic;
}

Diagnostic outside_range(const Span& span, const Parameter& parameter, double value) {
  const std::string range =
      in_unit_of(parameter, parameter.range->low) + " to " + in_unit_of(parameter, parameter.range->high);
  return with_related(error("E204", span,
                            "the value of `" + parameter.name + "` lies outside its own range: " +
                                in_unit_of(parameter, value) + " is not within " + range),
                      parameter.span,
                      "`" + parameter.name + "` is declared on line " +
                          std::to_string(parameter.span.begin.line) + " with the range " + range);
}

Diagnostic parameter_needs_quantity(const Span& span, const std::string& name) {
  return error("E105", span, "parameter `" + name + "` must be a number with its unit");
}

Diagnostic not_a_condition(const Span& span, const Dimension& found) {
  const std::string unit = usual_unit(found);
  return error("E205", span, "this is " + describe(found) + ", not a condition",
               "compare it with something, for example `.. > 1" + (unit.empty() ? "" : " " + unit) + "`");
}

Diagnostic expected_number(const Span& span) {
  return error("E205", span, "this is true or false, where a number is due");
}

Diagnostic misplaced_here(const Span& span, const std::string& what) {
  return error("E105", span, what + " cannot be `here`",
               "only `position: here` holds what there is on entry");
}

Diagnostic unknown_name(const Span& span, const std::string& kind, const std::string& name,
                        const std::vector<std::string>& known) {
  Diagnostic diagnostic = error("E301", span, "no " + kind + " named " + in_ticks(name));
  const std::string meant = nearest(name, known);
  diagnostic.help = meant.empty() ? known_here(known) : "did you mean `" + meant + "`?";
  // The span may hold more than the name, as `speed(name)` or quotes do: a replacement would not fit it.
  const bool is_the_name = span.begin.line == span.end.line &&
                           span.end.column - span.begin.column == static_cast<int>(name.size());
  if (!is_the_name) return diagnostic;
  return meant.empty() ? with_choices(diagnostic, shown_of(known)) : with_replacement(diagnostic, meant);
}

Diagnostic unknown_function(const Span& span, const std::string& name, const std::string& meant,
                            const std::vector<std::string>& known) {
  if (name == "distance" || name == "dist" || name == "angle")
    return error(
        "E301", span, "no function named " + in_ticks(name),
        "declare it under `features`, as `reach: {distance: [base_link, goal]}`, and measure `reach`");
  if (name == "elapsed")
    return error("E301", span, "no function named " + in_ticks(name), "write `elapsed`, without parentheses");
  const Diagnostic unknown =
      error("E301", span, "no function named " + in_ticks(name), "there are " + list_of_functions());
  return meant.empty() ? with_choices(unknown, known) : with_suggestion(unknown, meant);
}

Diagnostic unknown_quantity(const Span& span, const std::string& name, const std::string& near) {
  const std::string meant = name == "time" || name == "t" ? "elapsed" : near;
  const bool is_quantity = name == "force" || name == "velocity" || name == "position" || name == "torque";
  if (is_quantity)
    return error("E301", span, "nothing named " + in_ticks(name) + " can be measured here",
                 "say of which axis: `contact.x." + std::string(name == "torque" ? "force" : name) +
                     "`; what the base presses with is estimated, too: `estimated.force.x`");
  return with_suggestion(error("E301", span, "nothing named " + in_ticks(name) + " can be measured here",
                               "write group.axis.velocity, a function, $parameter or elapsed"),
                         meant);
}

Diagnostic unknown_axis(const Span& span, const std::string& group, const std::string& axis, bool is_axis,
                        const std::vector<std::string>& known) {
  return error("E301", span, "group `" + group + "` says nothing about an axis " + in_ticks(axis),
               is_axis ? "add `" + axis + ": free` to the group to measure it" : "it has " + listed(known));
}

Diagnostic boundary_in_a_condition(const Span& span, const std::string& group, const std::string& move) {
  return error(
      "E301", span, "group `" + group + "` keeps something inside a region: it measures nothing",
      "measure with a group that has axes: `place: {move: " + (move == "footprint" ? "base_link" : move) +
          ", in: world, x: free}`, and `place.x.position`");
}

Diagnostic unused(const Span& span, const std::string& kind, const std::string& name) {
  return warning("W302", span, kind + " `" + name + "` is never used");
}

Diagnostic frame_loop(const Span& span, const std::vector<std::string>& names) {
  std::string text = names[0] + " hangs on " + names[1];
  for (std::size_t i = 2; i < names.size(); ++i) text += ", which hangs on " + names[i];
  return error("E304", span, text, "one of them must have a parent outside the loop, for example `world`");
}

Diagnostic name_taken(const Span& span, const std::string& name, const std::string& owner) {
  return error("E305", span, "`" + name + "` is already the name of " + owner, "choose another name");
}

Diagnostic not_settable(const Span& span, const std::string& name) {
  return error("E301", span, "frame `" + name + "` belongs to the robot: it cannot be set",
               "declare a frame of your own under `frames:`");
}

Diagnostic template_recursion(const Span& span, const std::string& name) {
  return error("E303", span, "template `" + name + "` uses itself");
}

Diagnostic extra_argument(const Span& span, const std::string& name, const std::string& argument,
                          const std::string& meant) {
  return with_suggestion(
      error("E303", span, "template `" + name + "` takes no argument " + in_ticks(argument)), meant);
}

Diagnostic missing_template_arguments(const Span& span, const std::string& name,
                                      const std::vector<std::string>& arguments) {
  const bool is_one = arguments.size() == 1;
  std::string message = "template `" + name + (is_one ? "` needs the argument" : "` needs the arguments");
  for (std::size_t i = 0; i < arguments.size(); ++i) message += (i == 0 ? " `" : ", `") + arguments[i] + "`";
  return error("E303", span, message, is_one ? "add it under `with:`" : "add them under `with:`");
}

Diagnostic wrong_argument(const Span& span, const std::string& argument, const std::string& expected) {
  return error("E303", span, "argument `" + argument + "` must be " + expected);
}

Diagnostic not_a_number_signal(const Span& span, const std::string& name, const Span& declared) {
  return with_related(error("E202", span, "signal `" + name + "` is not a number: it cannot drive"), declared,
                      "`" + name + "` is declared here");
}

Diagnostic not_a_pose_signal(const Span& span, const std::string& name, const Span& declared) {
  return with_related(error("E202", span, "signal `" + name + "` is not a pose: no frame can hang on it"),
                      declared, "`" + name + "` is declared here");
}

Diagnostic incomparable_signal(const Span& span, const std::string& name, bool is_pose) {
  return error("E205", span,
               "signal `" + name + "` is a " + (is_pose ? "pose" : "wrench") + ": it has no single value",
               is_pose ? "hang a frame on it, and measure that"
                       : "compare one of its parts, for example `" + name + ".x`");
}

Diagnostic unit_without_number(const Span& span, const std::string& name) {
  return error("E104", span, "signal `" + name + "` has a unit, but is no number");
}

Diagnostic one_region_shape(const Span& span, const std::string& what) {
  return error("E104", span, what + " needs a `polygon` or a `circle`");
}

Diagnostic flat_region(const Span& span, const std::string& what) {
  return error("E410", span, "the polygon of " + what + " encloses no area",
               "give three corners or more, in order");
}

Diagnostic one_feature_kind(const Span& span, const std::string& what) {
  return error("E104", span, what + " needs exactly one of `distance`, `angle`, `bearing`, `direction`");
}

Diagnostic not_an_axis_of_a_frame(const Span& span, const std::string& text) {
  return error("E105", span, in_ticks(text) + " is not an axis of a frame", "for example `base_link.x`");
}

Diagnostic feature_without_direction(const Span& span, const std::string& what) {
  return error("E411", span, what + " points nowhere",
               "give at least one of x, y, z, rx, ry, rz a coefficient");
}

Diagnostic rigid_feature(const Span& span, const std::string& name) {
  return error("E412", span, "feature `" + name + "` never changes: one link carries both of its frames");
}

Diagnostic beyond_always(const Span& span, const std::string& axis, const std::string& asked,
                         const std::string& limiting, const std::string& allowed, const Span& limit) {
  return with_related(
      warning("W402", span,
              axis + " asks for " + trimmed(asked) + ", " + limiting + " allows " + trimmed(allowed)),
      limit, "the limit stands here");
}

Diagnostic incomplete_spring(const Span& span, const std::string& axis, const std::string& missing) {
  return error("E104", span, "a spring on `" + axis + "` needs `position`, `stiffness` and `damping`",
               "add `" + missing + ": ..`, or give a `time_constant` in the place of the spring");
}

Diagnostic spring_with_time_constant(const Span& span, const std::string& axis) {
  return error("E104", span, "`" + axis + "` gives a time constant beside stiffness and damping",
               "keep one of the two ways");
}

Diagnostic driven_twice(const Span& span, const std::string& axis, const std::string& first,
                        const std::string& second, const Span& first_span) {
  return with_related(
      error("E401", span, "axis `" + axis + "` is driven twice: by `" + first + "` and by `" + second + "`",
            "write the other as a range, [low, high] or +-value"),
      first_span, "`" + first + "` drives it here");
}

Diagnostic empty_range(const Span& span, const std::string& low, const std::string& high) {
  return error("E403", span, trimmed(low) + " is above " + trimmed(high), "write the lower end first");
}

Diagnostic position_in_own_axes(const Span& span, const std::string& axis, const std::string& in,
                                const std::string& move) {
  const std::string why = in == move ? "`" + move + "` is always at 0 in its own axes"
                                     : "`" + in + "` rides along with `" + move + "`";
  return error("E405", span, "axis `" + axis + "` cannot have a position: " + why,
               "use velocity, `here`, or a frame of the world");
}

Diagnostic force_range_without_zero(const Span& span, const std::string& axis) {
  return error("E408", span, "the force range of `" + axis + "` leaves no room for 0",
               "a single force drives; a range only limits, and must hold 0");
}

Diagnostic immovable(const Span& span, const std::string& frame) {
  return error("E409", span, "`" + frame + "` is no part of the robot: nothing can move it",
               "move a frame of the robot, `in` this one");
}

Diagnostic motionless(const Span& span, const std::string& function, const std::string& frame,
                      const std::string& base) {
  return error("E409", span,
               "`" + frame + "` stands in the world: `" + function + "(" + frame + ")` is always 0",
               "ask about a frame of the robot, for example `" + function + "(" + base + ")`");
}

Diagnostic beyond_a_distance(const Span& span, const std::string& axis) {
  return error("E413", span, "a distance is never negative: `" + axis + "` cannot be there",
               "write more than 0; for a side to be on, use a `direction`");
}

Diagnostic beyond_an_angle(const Span& span, const std::string& axis) {
  return error("E413", span,
               "an angle between two axes lies from 0 to 180 deg: `" + axis + "` cannot be there",
               "for a heading with a sign, use `rz` of a group");
}

Diagnostic group_without_axes(const Span& span, const std::string& group) {
  return error("E103", span, "constraint group `" + group + "` says nothing about any axis",
               "name x, y, z, rx, ry or rz");
}

Diagnostic measured_without_for(const Span& span) {
  return warning("W501", span, "a measured quantity decides at a single instant: noise can fire it",
                 "say how long it must hold, for example `for: 0.1 s`");
}

Diagnostic unreachable_task(const Span& span, const std::string& task) {
  return warning("W502", span, "no way leads to task `" + task + "`",
                 "let the `goto` of an exit or a timeout lead to it, or delete it");
}

Diagnostic endless_task(const Span& span, const std::string& task) {
  return warning("W503", span, "task `" + task + "` can run forever: no `timeout` and no exit on `elapsed`",
                 "add `timeout: {after: .., goto: ..}`, or `timeout: never`");
}

Diagnostic signal_without_age(const Span& span, const std::string& name) {
  return error("E504", span,
               "signal `" + name + "` does not say `stale_after`: a dead sensor would look like a quiet one",
               "for example `stale_after: 200 ms`");
}

Diagnostic latch_is_not_bool(const Span& span, const std::string& signal, const std::string& type) {
  return error("E510", span,
               "signal `" + signal + "` is a " + type + ": only a `bool` says whether a latch holds the base",
               "declare it as `type: bool`, or remove `holds`");
}

Diagnostic latch_off_the_base(const Span& span, const std::string& frame, const std::string& base) {
  return error("E510", span,
               "`" + frame + "` is not fixed to the base" + (base.empty() ? "" : " `" + base + "`") +
                   ": what a latch holds there does not hold the base",
               "name a frame that the base carries, such as its hook");
}

Diagnostic release_without_threshold(const Span& span) {
  return error("E506", span, "`release` needs a single comparison with a fixed value",
               "for example `when: nearest < 0.8 m`, `release: 1.2 m`");
}

Diagnostic release_on_wrong_side(const Span& span, bool is_below) {
  return error("E506", span,
               std::string("`release` must lie ") + (is_below ? "above" : "below") +
                   " the threshold: the condition could never stay true");
}

Diagnostic hidden_exit(const Span& span, const Span& first, bool is_same) {
  return with_related(warning("W507", span, "an earlier exit always fires first"), first,
                      is_same ? "it has the same condition" : "it is true wherever this one is");
}

Diagnostic back_without_interruption(const Span& span, bool under_always) {
  return error("E508", span,
               std::string("`back` leads nowhere: no exit under `always` interrupts to ") +
                   (under_always ? "a task" : "this task"),
               "name the task to go to");
}

}  // namespace zwang::lang::wording
