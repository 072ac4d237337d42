#include "diagnostic/wordings_slips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "diagnostic/make.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "words/text.hpp"
#include "words/units.hpp"

namespace zwang::lang::wording {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 12> spellings{{
    {"\u00a0", " "},     // no-break space
    {"\u202f", " "},     // narrow no-break space
    {"\u2212", "-"},     // minus
    {"\u2013", "-"},     // en dash
    {"\u00b1", "+-"},    // plus-minus
    {"\u00b2", "^2"},    // superscript two
    {"\u00b3", "^3"},    // superscript three
    {"\u00b7", " "},     // middle dot
    {"\u22c5", " "},     // dot operator
    {"\u00b5", "u"},     // micro
    {"\u03bc", "u"},     // mu
    {"\u00b0", " deg"},  // degree
}};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::string plainly_written(const std::string& text) {
  std::string plain = text;
  for (const auto& [odd, usual] : spellings) {
    for (std::size_t at = 0; (at = plain.find(odd, at)) != std::string::npos; at += usual.size()) {
      plain.replace(at, odd.size(), usual);
      // A unit keeps the one blank that stands before it.
      if (at > 0 && plain[at] == ' ' && plain[at - 1] == ' ') plain.erase(at, 1);
    }
  }
  // Between digits a comma stands for the point, with blanks behind it, too, and an underscore for nothing.
  for (std::size_t i = 1; i + 1 < plain.size(); ++i) {
    const std::size_t next = plain[i] == ',' ? plain.find_first_not_of(' ', i + 1) : i + 1;
    if (next == std::string::npos || !is_digit(plain[i - 1]) || !is_digit(plain[next])) continue;
    if (plain[i] == ',') plain.replace(i, next - i, ".");
    if (plain[i] == '_') plain.erase(i, 1);
  }
  return plain;
}

Diagnostic odd_letters(const Span& span, const std::string& text, const std::string& plain) {
  return with_replacement(error("E105", span, in_ticks(text) + " is spelt in a way that zwang does not read",
                                "write `" + plain + "`"),
                          plain);
}

Diagnostic word_in_capitals(const Span& span, const std::string& text, const std::string& word) {
  return with_replacement(
      error("E105", span, in_ticks(text) + " is not part of conditions", "write `" + word + "`"), word);
}

Diagnostic divides_by_zero(const Span& span) {
  return error("E105", span, "this divides by zero", "compare what stands above it instead");
}

Diagnostic speed_from_zero(const Span& span, const std::string& what) {
  return error("E104", span, what + " begins at 0: a speed has no direction, and nothing keeps it up",
               "write `[0 m/s, ..]`");
}

Diagnostic norm_from_zero(const Span& span, const std::string& what) {
  return error("E415", span, "a norm only limits: " + in_ticks(what) + " begins at 0",
               "write `[0, ..]` with its unit");
}

Diagnostic norm_that_drives(const Span& span, const std::string& what) {
  return error("E415", span, "a norm only limits: " + in_ticks(what) + " has no direction to drive in",
               "drive `x` and `y`, or give a range that begins at 0");
}

Diagnostic parameter_without_dollar(const Span& span, const std::string& name) {
  return with_replacement(
      error("E301", span, "`" + name + "` is a parameter, and lacks its `$`", "write `$" + name + "`"),
      "$" + name);
}

Diagnostic silent_axis(const Span& span, const std::string& axis) {
  return error("E103", span, "axis `" + axis + "` says nothing",
               "write `free`, or for example `{velocity: 0 m/s}`");
}

Diagnostic free_in_brackets(const Span& span) {
  return with_replacement(error("E104", span, "`free` stands alone", "write `free` without brackets"),
                          "free");
}

Diagnostic decimal_comma(const Span& span, const std::string& number) {
  return error("E104", span, "a decimal comma cuts this number in two",
               "write `" + number + "`, with a point");
}

Diagnostic axis_of_a_feature(const Span& span, const std::string& group, const std::string& quantity) {
  const std::string path = group + "." + quantity;
  return with_replacement(
      error("E301", span, "group `" + group + "` is on a feature, which has no axes", "write `" + path + "`"),
      path);
}

Diagnostic crossing_edges(const char* code, const Span& span, const std::string& what) {
  return error(code, span, "two edges of " + what + " cross",
               "give the corners in the order in which one would walk around");
}

Diagnostic unknown_signal_type(const Span& span, const std::string& text, const std::string& meant) {
  return with_suggestion(
      error("E301", span, "no type of signal named " + in_ticks(text), "write bool, number, pose or wrench"),
      meant);
}

Diagnostic bare_attempts(const Span& span, const std::string& text) {
  return error("E104", span, "`attempts` must say where it leads",
               "write `attempts: {max: " + escaped(text) + ", goto: failed}`");
}

Diagnostic footprint_is_no_frame(const Span& span) {
  return error("E301", span, "`footprint` is no frame: it has no axes to move along",
               "move a frame of the robot, or keep the footprint `inside` a region");
}

Diagnostic unknown_truth(const Span& span, const std::string& name, const std::string& meant) {
  return with_suggestion(
      error(
          "E301", span, "the plant does not measure " + in_ticks(name),
          "it measures x, y, yaw, speed, turn and torque of `truth.base`, and force, peak, touched, x, y and "
          "yaw of `truth.OBJECT`, each object of the scene"),
      meant);
}

Diagnostic word_for_a_name(const Span& span, const std::string& word) {
  return error("E305", span, "`" + word + "` is a word of the language: nothing can have it as a name",
               "choose another name");
}

Diagnostic condition_without_key(const Span& span, const std::string& what, const std::string& key,
                                 const std::string& condition) {
  return error("E103", span, what + " does not say `" + key + "`",
               "write `" + key + ": " + escaped(condition) + "`");
}

Diagnostic unknown_driver(const Span& span, const std::string& name, const std::string& meant,
                          bool is_position) {
  const std::string values = "write a number with its unit, a parameter, as `$push`, ";
  return with_suggestion(
      error("E301", span, "no number signal named " + in_ticks(name),
            values + (is_position ? "`here`, or a number signal" : "or the name of a number signal")),
      meant);
}

Diagnostic dollar_before_here(const Span& span) {
  return with_replacement(error("E301", span, "no parameter named `here`", "write `here` without the `$`"),
                          "here");
}

Diagnostic parameter_of_a_matrix(const Span& span, const std::string& key) {
  return error("E101", span, "unknown key " + in_ticks(key) + " in `matrix`",
               "a parameter is written `params." + (key == "params" ? "NAME: [..]" : escaped(key)) +
                   "`; the other keys are robot, scene, start_at, start_yaw, faults");
}

Diagnostic unknown_hook(const Span& span, const std::string& name, const std::string& meant) {
  return with_suggestion(error("E301", span, "no frame of the robot named " + in_ticks(name),
                               "a hook is a part of the robot: declare it under `frames` of the robot file"),
                         meant);
}

Diagnostic never_after(const Span& span) {
  return with_replacement(
      error("E104", span, "`never` stands in the place of the whole timeout", "write `timeout: never`"),
      "never");
}

Diagnostic computed_value(const Span& span, const std::string& text) {
  return error("E105", span, in_ticks(text) + " is not a value",
               "nothing is computed here: write a number, or one parameter as `$push` or `-$push`");
}

Diagnostic needs_units(const Span& span, const std::string& what, const std::string& written) {
  constexpr std::size_t longest = 160;
  const std::string shown = written.size() > longest ? in_ticks(written) : "`" + written + "`";
  return with_replacement(error("E201", span, what + " needs units", "write " + shown), written);
}

Diagnostic argument_without_unit(const Span& span, const std::string& argument, const std::string& number,
                                 const Dimension& expected) {
  const std::string written = with_unit(number, expected);
  return with_replacement(error("E303", span, "argument `" + argument + "` must be " + describe(expected),
                                "write `" + written + "`"),
                          written);
}

Diagnostic axis_without_quantity(const Span& span, const std::string& axis) {
  return error("E301", span, "`" + axis + "` does not say which quantity is meant",
               "write `" + axis + ".position`, or `.velocity`, `.force`, `.residual`, `.saturated`");
}

Diagnostic frame_for_a_quantity(const Span& span, const std::string& written, const std::string& frame) {
  return error("E301", span, "nothing named " + in_ticks(written) + " can be measured here",
               "`" + frame + "` is a frame: measure `speed(" + frame + ")`, `moved(" + frame +
                   ")`, or an axis of a group that moves it, as `group.x.position`");
}

Diagnostic quantity_of_a_feature(const Span& span, const std::string& written, const std::string& feature) {
  return with_replacement(error("E301", span, "nothing named " + in_ticks(written) + " can be measured here",
                                "a feature is measured by its name alone: `" + feature + "`"),
                          feature);
}

Diagnostic signal_of_another_type(const Span& span, const std::string& name, const std::string& measured,
                                  const std::string& expected, const std::string& remedy,
                                  const Span& declared) {
  return with_related(error("E701", span,
                            "for signal `" + name + "` the scene gives " + measured +
                                ", and the task file declares " + expected,
                            remedy),
                      declared, "`" + name + "` is declared here");
}

Diagnostic signal_too_old(const Span& span, const std::string& name, double delay, double period, double age,
                          const Span& stale_after) {
  const auto ms = [](double seconds) { return figure(seconds * 1e3, "ms"); };
  const bool is_never_known = delay > age;
  const std::string message =
      is_never_known ? "` comes " + ms(delay) + " late and is believed for " + ms(age) + ": it is never known"
                     : "` is " + ms(delay + period) + " old before the next sample comes, and believed for " +
                           ms(age) + ": it is lost again and again";
  return with_related(
      warning("W702", span, "signal `" + name + message,
              "make `stale_after` longer than " + ms(delay + period) + ", or let the signal come sooner"),
      stale_after, "`stale_after` is given here");
}

Diagnostic partner_rolls(const Span& span, const std::string& hook, const std::string& partner,
                         const Span& object) {
  return with_related(
      warning("W703", span,
              in_ticks(hook) + " hangs on " + in_ticks(partner) +
                  ", which a pull moves: it holds the base in no place, and hides encoders that fail",
              "leave `holds` out"),
      object, in_ticks(partner) + " has a mass, and nothing fixes it");
}

Diagnostic unheard_signal(const Span& span, const std::string& name, const std::string& meant) {
  return with_suggestion(
      warning("W302", span, "the scene gives a signal `" + name + "`, and the task file has none"), meant);
}

Diagnostic directive(const Span& span) {
  return error("E100", span, "a line cannot begin with `%`: YAML keeps that for instructions to its reader",
               "delete the line, or indent it");
}

Diagnostic urdf_for_robot_file(const Span& span) {
  return error("E103", span, "this is a URDF, not a robot file",
               "`zwang robot init` writes the robot file that goes with it");
}

Diagnostic unfed_signal(const Span& span, const std::string& name, UnfedUse use, const Span& declared) {
  const std::string source = "give it a source under `signals` of the scene; never measured, ";
  const std::string help =
      use == UnfedUse::condition
          ? source + "it lets an exit of `always` fire once its `stale_after` is over, and any other never"
      : use == UnfedUse::motion ? source + "it lets the axis stand still, and a force be 0"
                                : "give it a sensor in the scene, as `" + name +
                                      ": {wrench_at: base}`, or ask for `estimated.FRAME`";
  return with_related(
      warning("W509", span, "the scene gives nothing for the signal " + in_ticks(name) + ", which this reads",
              help),
      declared, "it is declared here");
}

Diagnostic signal_is_no_frame(const Span& span, const std::string& name) {
  std::string frame = name;
  frame += "_frame";
  return error("E301", span, "no frame named " + in_ticks(name) + ": that is a signal",
               "give the signal a frame, `frames: {" + frame + ": {parent: " + name + "}}`, and name that");
}

Diagnostic level_of_always(const Span& span, const std::string& what) {
  return error("E105", span, what + " must be a whole number from 1 to 9: level 0 is that of `always`");
}

Diagnostic no_inside(const Span& span, const std::string& region, double margin, double footprint,
                     const Span& declared) {
  std::string message = "a margin of " + figure(margin, "m") + " leaves nothing of " + in_ticks(region);
  if (footprint > 0.0)
    message = "within " + in_ticks(region) +
              (margin > 0.0 ? ", less " + figure(margin, "m") + " of margin" : "") +
              ", there is no room for the footprint";
  return with_related(
      error("E414", span, std::move(message), "make the margin smaller, or the region larger"), declared,
      "the region is declared here");
}

std::string with_unit(const std::string& written, const Dimension& expected) {
  const bool is_symmetric = written.starts_with("+-");
  const QuantityResult result = parse_quantity(std::string_view(written).substr(is_symmetric ? 2 : 0));
  if (result.error != QuantityError::none || result.quantity.has_unit) return written;
  // Nobody turns by more than once in radians.
  const bool is_in_degrees = expected == dimension::angle && std::abs(result.quantity.value) > 6.3;
  return written + " " + (is_in_degrees ? "deg" : usual_unit(expected));
}

Diagnostic not_indented(const Span& span, const std::string& key, const std::string& group) {
  if (group.empty())
    return error(
        "E104", span, in_ticks(key) + " stands in `constraints` without a group",
        "write the name of a group above it, as `contact:`, and indent the lines of the group below it");
  return error("E104", span, in_ticks(key) + " is not indented under its group " + in_ticks(group),
               "indent the lines of the group: two spaces more than " + in_ticks(group + ":"));
}

Diagnostic not_indented_in_task(const Span& span, const std::string& key, const std::string& task) {
  return error("E104", span, in_ticks(key) + " is not indented under its task " + in_ticks(task),
               "indent the lines of the task: two spaces more than " + in_ticks(task + ":"));
}

Diagnostic group_in_a_task(const Span& span, const std::string& key) {
  return error("E104", span, in_ticks(key) + " stands in a task, and belongs to a constraint group",
               "put the lines of the group into `constraints: {NAME: {move: .., in: .., ..}}`");
}

Diagnostic no_colon_or_space(const Span& span, const std::string& written, const std::string& key) {
  const std::size_t value = written.find_first_not_of(" :", key.size());
  const std::string rest = value == std::string::npos ? std::string() : written.substr(value);
  // A value in brackets goes on behind the span.
  const std::string shown = rest.starts_with('{') || rest.starts_with('[') ? rest.substr(0, 1) + ".." : rest;
  return error("E101", span, in_ticks(key) + " lacks a colon and a space behind it",
               "write " + in_ticks(key + ": " + shown));
}

Diagnostic parameter_in_braces(const Span& span, const std::string& written) {
  const std::size_t open = written.find_first_of("{(");
  const std::string plain = written.substr(0, open) + written.substr(open + 1, written.size() - open - 2);
  return with_replacement(
      error("E105", span, "a parameter stands without braces", "write " + in_ticks(plain)), plain);
}

Diagnostic argument_of_another_kind(const Span& span, const std::string& argument, const std::string& kind,
                                    const std::string& name, const std::string& found) {
  return error(
      "E303", span,
      "argument `" + argument + "` is declared as a " + kind + ", but `" + name + "` is a " + found,
      "give the name of a " + kind + ", or write `" + argument + ": " + found + "` in the template's `args`");
}

Diagnostic frame_hides_signal(const Span& span, const std::string& name, const Span& signal) {
  const std::string quoted = "`" + name + "`";
  return with_related(
      error("E304", span, "frame " + quoted + " hides the signal " + quoted + " that it hangs on",
            "give the frame another name, for example `" + name + "_frame`"),
      signal, "the signal is declared here");
}

Diagnostic measured_position_in_own_axes(const Span& span, const std::string& axis,
                                         const std::string& signal) {
  return error(
      "E405", span,
      "axis `" + axis + "` cannot have the position `" + signal + "`: its axes ride along with it",
      "to keep a distance, take what is measured as a signal of `type: pose`, and drive `in` a frame on it");
}

Diagnostic split_text(const Span& span, const std::string& key) {
  return error("E107", span,
               "a comma cut the text of `" + key + "` in two: inside `{..}` it starts a new key",
               "quote the text: `" + key + ": \"..\"`");
}

Diagnostic lone_return(const Span& span) {
  return error("E100", span, "lines end with a carriage return alone, as on a Mac before 2001",
               "save the file with the line ends of Linux (LF) or Windows (CR LF)");
}

}  // namespace zwang::lang::wording
