#include "diagnostic/wordings_never.hpp"

#include <cmath>
#include <numbers>

#include "diagnostic/axis_units.hpp"
#include "diagnostic/make.hpp"
#include "words/units.hpp"

namespace zwang::lang::wording {

namespace {

std::string within(double low, double high, const std::string& unit) {
  if (std::isinf(low)) return "at most " + figure(high, unit);
  if (std::isinf(high)) return "at least " + figure(low, unit);
  if (low == high) return "at " + figure(low, unit);
  return "within [" + figure(low, unit) + ", " + figure(high, unit) + "]";
}

Diagnostic related_where_known(Diagnostic diagnostic, const Span& span, const std::string& text) {
  return span.exists() ? with_related(std::move(diagnostic), span, text) : diagnostic;
}

std::string with_article(const std::string& quantity) {
  return (quantity.starts_with("a") ? "an " : "a ") + quantity;
}

std::string ticked(const std::string& path) {
  const bool is_name = path.find_first_of(" `") == std::string::npos;
  return is_name ? "`" + path + "`" : path;
}

/// "`c.x.velocity` stays within [-0.1 m/s, 0.1 m/s], as `c.x` keeps it so"
std::string stays(const Kept& kept) {
  const std::string by = kept.by.empty() ? "this base keeps it so" : ticked(kept.by) + " keeps it so";
  const std::string now =
      kept.parameter.empty() ? "" : " with the value that `" + kept.parameter + "` has now";
  const std::string in_time =
      std::isfinite(kept.time) ? " in the " + figure(kept.time, "s") + " until the task ends" : "";
  return "`" + kept.what + "` stays " + within(kept.low, kept.high, kept.unit) + ", as " + by + now + in_time;
}

}  // namespace

Diagnostic excluding_ranges(const Span& span, const Bound& own, const Bound& other, const Span& other_span) {
  return related_where_known(
      warning("W416", span,
              ticked(own.path) + " keeps the " + own.quantity + " " + within(own.low, own.high, own.unit) +
                  ", " + ticked(other.path) + " keeps it " + within(other.low, other.high, other.unit) +
                  ": no value is in both",
              "widen one of the two ranges, or take it out"),
      other_span, "the other range is here");
}

Diagnostic excluding_regions(const Span& span, const std::string& own, const std::string& other, double apart,
                             const Span& other_span) {
  return related_where_known(
      warning("W416", span,
              ticked(own) + " and " + ticked(other) + " keep the base in regions that are " +
                  figure(apart, "m") + " too far apart: no place is in both",
              "move one of the two regions, or take it out"),
      other_span, "the other region is asked for here");
}

Diagnostic beyond_the_motors(const Span& span, const Bound& range, double most) {
  return warning("W416", span,
                 ticked(range.path) + " keeps the " + range.quantity + " " +
                     within(range.low, range.high, range.unit) + ", and the motors make " +
                     figure(most, range.unit) + ": no value is in both",
                 "let the range begin below that");
}

Diagnostic beyond_a_range(const Span& span, const Bound& asked, const Bound& range, const Span& range_span) {
  return related_where_known(
      warning("W416", span,
              ticked(asked.path) + " asks for " + with_article(asked.quantity) + " of " +
                  figure(asked.low, asked.unit) + ", " + ticked(range.path) + " keeps it " +
                  within(range.low, range.high, range.unit) + ": it never gets there",
              "ask for `" + figure(asked.low > range.high ? range.high : range.low, asked.unit) +
                  "`, or widen the range"),
      range_span, "the range is here");
}

Diagnostic never_stands(const Span& span, const std::string& asked, const Bound& range,
                        const Span& range_span) {
  return related_where_known(
      warning("W416", span,
              ticked(asked) + " drives to a place and stays there, " + ticked(range.path) +
                  " keeps the velocity " + within(range.low, range.high, range.unit) + ": it never stands",
              "let the range contain 0, or drive a velocity"),
      range_span, "the range is here");
}

Diagnostic beyond_a_norm(const Span& span, const std::string& one, const std::string& other, double together,
                         const Bound& norm, const Span& norm_span) {
  return related_where_known(
      warning("W416", span,
              ticked(one) + " and " + ticked(other) + " ask for " + figure(together, norm.unit) +
                  " together, " + ticked(norm.path) + " keeps the norm " +
                  within(norm.low, norm.high, norm.unit) + ": it never gets there",
              "ask for less along one of the two axes, or widen the range"),
      norm_span, "the range is here");
}

Diagnostic no_way_out(const Span& span, const std::vector<std::string>& tasks) {
  std::string names;
  for (std::size_t i = 0; i < tasks.size() && i < 4; ++i) names += (i == 0 ? "`" : ", `") + tasks[i] + "`";
  if (tasks.size() > 4) names += " and " + std::to_string(tasks.size() - 4) + " more";
  return warning("W510", span, "no way leads from " + names + " to `done` or `failed`: the run never ends",
                 "let an exit or a timeout lead to `done` or `failed`, or stop it by a signal: "
                 "`always: {exits: [{when: stop_key, goto: failed}]}`");
}

Diagnostic to_and_fro(const Span& span, const std::string& from, const std::string& to, const Span& there) {
  return with_related(
      warning("W512", span,
              "this may be true while what leads to `" + from + "` is: the run is back in " + ticked(to) +
                  " at once, goes around, and no task on the way comes into force",
              "leave a gap between the thresholds, or wait here: `for: 1 s`"),
      there, "the way there begins with this exit");
}

Diagnostic boundary_rides_along(const Span& span, const std::string& group, const std::string& region,
                                const std::string& parent, const std::string& move, const Span& declared) {
  return with_related(error("E405", span,
                            "`" + group + "` never acts: region `" + region + "` hangs on `" + parent +
                                "`, and moves along with `" + move + "`",
                            "give the region a parent in the world: `parent: world`"),
                      declared, "`" + region + "` is declared here");
}

Diagnostic loose_without_mass(const Span& span, const std::string& what) {
  return error("E916", span, what + " is not fixed and has no mass: nothing would move it",
               "add `mass: 20 kg`, or write `fixed: true`");
}

Diagnostic negative_width(const Span& span, const std::string& argument, const std::string& body,
                          const Span& body_span) {
  return with_related(
      error("E303", span, "argument `" + argument + "` cannot be below 0: the template writes `" + body + "`",
            "give the magnitude"),
      body_span, "it is used here");
}

Diagnostic interrupts_again(const Span& span, const std::string& task, const Span& there) {
  return with_related(warning("W512", span,
                              "`back` leads from `" + task +
                                  "` to a task whose `moved` and `elapsed` go on: what interrupted "
                                  "it is still true, and interrupts it at once",
                              "let the interruption ask for something that `" + task +
                                  "` ends, or lead to a task by its name"),
                      there, "it is interrupted here");
}

std::string in_unit_of(const Parameter& parameter, double value) {
  return format_number(value / parameter.unit_scale) + (parameter.unit.empty() ? "" : " " + parameter.unit);
}

Diagnostic breaks_a_use(const Span& span, const std::string& rule, const Parameter& parameter,
                        bool is_negated, double worst, const std::optional<solver::Range>& narrowed,
                        const Span& from, bool from_range) {
  const std::string use = (is_negated ? "`-$" : "`$") + parameter.name + "`";
  Diagnostic diagnostic = error(
      "E206", span, rule + ", and " + use + " may be " + in_unit_of(parameter, is_negated ? -worst : worst));
  if (!from_range) {
    if (from.exists()) diagnostic = with_related(std::move(diagnostic), from, "it is set here");
    diagnostic.help = "set it to a value that fits, or take a parameter of its own for this place";
    return diagnostic;
  }
  diagnostic.related.push_back({from, "the range of `" + parameter.name + "` allows it", std::nullopt});
  diagnostic.help = "narrow the range of `" + parameter.name + "`, or take a parameter of its own";
  if (!narrowed) return diagnostic;
  const std::string range =
      "[" + in_unit_of(parameter, narrowed->low) + ", " + in_unit_of(parameter, narrowed->high) + "]";
  diagnostic.help = "write `range: " + range + "`";
  diagnostic.related.back().replacement = range;
  return diagnostic;
}

Diagnostic set_from_unknown(const Span& span, const std::string& frame, const std::string& source,
                            const std::string& signal, SetIn in, const Span* when,
                            const std::string& condition) {
  const std::string valid = "valid(" + signal + ")";
  Diagnostic diagnostic = warning("W513", span,
                                  "`" + frame + "` is set from `" + source +
                                      "`, and the run ends `failed` if `" + signal + "` is not known then");
  if (in == SetIn::entry) {
    diagnostic.help = "ask `" + valid + "` in each exit that leads here, or write `require: " + valid + "`";
  } else if (in == SetIn::always) {
    diagnostic.help =
        "an exit of `always` fires without the signal, too: set the frame in an exit of a task "
        "that asks `" +
        valid + "`";
  } else {
    const bool is_choice = condition.find(" or ") != std::string::npos;
    const std::string guarded = (is_choice ? "(" + condition + ")" : condition) + " and " + valid;
    diagnostic.help = "write `when: " + guarded + "`";
    diagnostic.related.push_back({*when, "the exit fires without the signal, too", guarded});
  }
  return diagnostic;
}

Diagnostic never_true(const Span& span, const Kept& kept) {
  return related_where_known(warning("W511", span, "this is never true: " + stays(kept),
                                     "compare with a value that it can come to, or take the exit out"),
                             kept.range, "it is bounded here");
}

Diagnostic only_from_outside(const Span& span, const Kept& kept, bool or_entered) {
  const std::string who = or_entered ? "only an entry from outside of the range, or a push from outside,"
                                     : "only a push from outside";
  return related_where_known(
      warning("W511", span, who + " makes this true: " + stays(kept),
              "compare with a value that the task comes to, or take the exit out; one that watches "
              "for a push leads to `failed`"),
      kept.range, "it is bounded here");
}

Diagnostic not_entered_yet(const Span& span, const std::string& what, const std::string& task) {
  return warning(
      "W511", span,
      "this is never true: no way leads from " + ticked(task) + " to this task, so `" + what + "` is unknown",
      "ask for a task that comes earlier, or take the exit out");
}

Diagnostic always_true(const Span& span, const Kept& kept) {
  return related_where_known(warning("W511", span, "this is true at once: " + stays(kept),
                                     "compare with a value that it comes to later, or take the exit out"),
                             kept.range, "it is bounded here");
}

Diagnostic contradicts_itself(const Span& span) {
  return warning("W511", span, "this is never true: its parts exclude each other",
                 "join them with `or`, or look at the direction of the comparisons");
}

Diagnostic never_on_entry(const Span& span, const std::string& what) {
  return warning(
      "W511", span,
      "this is never true: " + ticked(what) + " is 0 when the task is entered, so the run ends `failed`",
      "ask for it in an exit, or in the task before: `since(TASK)`, `moved(FRAME)`");
}

Diagnostic never_in_time(const Span& span, const std::string& by, const Span& end) {
  return related_where_known(
      warning("W511", span, "this is never true for so long: " + by + " ends the task before",
              "shorten `for`, or let the task last longer"),
      end, "the task ends here");
}

Diagnostic never_reached(const Span& span, const Unreached& u, const Span& limit) {
  const AxisUnits unit = axis_units(u.turns);
  std::string help = "`force: +-" + figure(u.pressed, unit.force) + "` says what it makes";
  if (u.enough > 0.0) help += ", `time_constant: " + figure(u.enough, "s") + "` makes more of it";
  if (u.velocity != 0.0 && !limit.exists()) {
    // q grows with v/t, and a blocked driver presses with m (v + q)/T.
    const double t = 4.0 * u.time_constant;
    const double after = t * (u.bound / u.pressed - 1.0);
    help += "; to press harder write `build_up: " + (t < 1.0 ? figure(t * 1e3, "ms") : figure(t, "s")) +
            "` (" + figure(u.bound, unit.force) + " after " + figure(after, "s") +
            "), or `force: " + figure(std::copysign(u.bound, u.velocity), unit.force) + ", velocity: +-" +
            figure(std::abs(u.velocity), unit.speed) + "`";
  } else if (!u.sum.empty()) {
    help += "; to press harder widen `" + u.sum + "`, which bounds the sum of all forces";
  } else if (limit.exists()) {
    help +=
        "; to press harder allow an acceleration of `" + figure(u.bound / u.mass, unit.acceleration) + "`";
  }
  const std::string from =
      u.by_motors      ? "what the motors make"
      : !u.sum.empty() ? "`" + u.sum + "` bounds the sum of all forces"
      : u.velocity != 0.0 && !limit.exists()
          ? figure(u.mass, unit.mass) + " x " + figure(std::abs(u.velocity), unit.speed) + " / " +
                figure(u.time_constant, "s")
          : figure(u.mass, unit.mass) + " x " + figure(u.acceleration, unit.acceleration);
  return related_where_known(
      warning("W619", span,
              "blocked, `" + u.axis + "` presses with " + figure(u.pressed, unit.force) + " (" + from +
                  "), never with " + figure(u.bound, unit.force),
              help),
      limit, u.sum.empty() ? "the acceleration is limited here" : "the sum is limited here");
}

Diagnostic limited_range(const Span& span, const Unreached& u, const Span& limit) {
  const AxisUnits unit = axis_units(u.turns);
  return related_where_known(
      make("N619", Severity::note, span,
           "blocked, `" + u.axis + "` presses with " + figure(u.pressed, unit.force) + " at most (" +
               figure(u.mass, unit.mass) + " x " + figure(u.acceleration, unit.acceleration) +
               "), not with " + figure(u.bound, unit.force),
           ""),
      limit, "the acceleration is limited here");
}

Diagnostic never_saturated(const Span& span, const Unreached& u, double motors) {
  const AxisUnits unit = axis_units(u.turns);
  return warning("W602", span,
                 "`" + u.axis + "` is not saturated when it is blocked: it presses with " +
                     figure(u.pressed, unit.force) + " at most (" + figure(u.mass, unit.mass) + " x " +
                     figure(u.acceleration, unit.acceleration) + "), the motors make " +
                     figure(motors, unit.force),
                 "give the axis a force range of `+-" + figure(0.9 * u.pressed, unit.force) + "` or less");
}

Diagnostic clipped_spring(const Span& span, const Cap& cap, double clipped, const Span& limit,
                          const std::string& sum) {
  const AxisUnits unit = axis_units(cap.turns);
  const double degrees = 180.0 / 3.14159265358979;
  const std::string way = figure(cap.turns ? clipped * degrees : clipped, unit.way);
  const std::string most = figure(cap.most, unit.force), wanted = figure(cap.wanted, unit.force);
  const std::string cause = sum.empty() ? "the acceleration limit caps it at " + most + " (" +
                                              figure(cap.mass, unit.mass) + " x " +
                                              figure(cap.most / cap.mass, unit.acceleration) + ")"
                                        : "`" + sum + "` caps the sum of all forces at " + most;
  const std::string fix =
      sum.empty() ? "allow an acceleration of `" + figure(cap.wanted / cap.mass, unit.acceleration) + "`"
                  : "widen `" + sum + "` to `+-" + wanted + "`";
  return related_where_known(warning("W601", span,
                                     "`" + cap.axis + "` would push with " + wanted + ", " + cause +
                                         ": from " + way + " on it is no spring",
                                     "`force: +-" + most + "` says so, or " + fix),
                             limit,
                             sum.empty() ? "the acceleration is limited here" : "the sum is limited here");
}

Diagnostic stops_too_late(const Span& span, const LateGuard& g, const std::string& limit,
                          const Span& limit_span) {
  std::string message = figure(g.distance, "m") + " is too late at " + figure(g.speed, "m/s") + ": " +
                        figure(g.way, "m") + " to stop";
  if (g.reach > 0.0)
    message += ", " + figure(g.reach, "m") + " of footprint before `" + g.signal + "` counts";
  const double enough = std::ceil((g.way + g.reach) * 100.0) / 100.0;
  std::string help = "ask at `" + figure(enough, "m") + "`";
  if (g.slow_enough > 0.005)
    help += ", or keep the speed below " + figure(std::floor(g.slow_enough * 1000.0) / 1000.0, "m/s");
  return related_where_known(warning("W620", span, message, help), limit_span,
                             (limit.empty() ? "the speed" : ticked(limit)) + " allows that speed");
}

Diagnostic steering_stands(const Span& span, const std::string& axis, const std::string& steering,
                           const std::string& link, const std::string& base) {
  return warning("W643", span,
                 "nothing moves along `" + axis +
                     "`: the wheels hold it as they are steered, and nothing turns `" + steering + "`",
                 "drive ahead along `x`, and point it at the place, `features: {look: {bearing: [" + link +
                     ", PLACE]}}` driven to 0 deg; or turn it in an earlier task, `steer: {move: " + link +
                     ", in: " + base + ", rz: {position: 20 deg}}`");
}

Diagnostic hops_along(const Span& span, const std::string& push, const std::string& way, const Span& driven) {
  return with_related(
      warning("W645", span,
              "`" + push + "` presses across the way of `" + way +
                  "`: the driven wheels swivel by themselves, and the base hops along a stiff wall",
              "stand still while the base presses, or drive beside it with a `position` or `velocity`"),
      driven, "the base drives here");
}

Diagnostic leaves_freedoms(const Span& span, const std::string& path, int left, int all) {
  const std::string freedoms = left == 1 ? " freedom" : " freedoms";
  return warning("W646", span,
                 "beside `" + path + "` nothing drives " + std::to_string(left) + " of the base's " +
                     std::to_string(all) + " freedoms: motion along " + (left == 1 ? "it" : "them") +
                     " goes on, and nothing stops it",
                 "hold the other" + freedoms +
                     " by `still: {move: base, in: base, level: 2, x: {velocity: 0 m/s}, "
                     "y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}`, or write an axis as `free`");
}

Diagnostic coasts_on(const Span& span, const Coasting& c, const Span& driven) {
  const std::string axis = c.driver.substr(c.driver.rfind('.') + 1);
  const std::string rest = c.turns ? "rz: {velocity: 0 rad/s}" : axis + ": {velocity: 0 m/s}";
  return with_related(warning("W646", span,
                              "`" + c.task + "` " + (c.turns ? "turns" : "moves") + " the base with " +
                                  figure(c.speed, c.turns ? "rad/s" : "m/s") + ", and no row of `" + c.next +
                                  "` stops it: the motion goes on there",
                              "give `" + c.next + "` a row `still: {move: base, in: base, level: 2, " + rest +
                                  "}`; if it must stay free there, let `" + c.task +
                                  "` end at rest, by a `position` or a `speed(base)` in its exit"),
                      driven, "it is driven here");
}

}  // namespace zwang::lang::wording
