#include "diagnostic/wordings_habits.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "diagnostic/make.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "words/nearest.hpp"
#include "words/text.hpp"
#include "words/units.hpp"

namespace zwang::lang::wording {

Diagnostic mapping_by_example(const Span& span, const std::string& what, const std::string& example) {
  Diagnostic diagnostic =
      error("E104", span, what + " must be a list of `key: value` lines", "write " + in_ticks(example));
  // Where nothing stands there is nothing to replace.
  if (span.begin.column != span.end.column || span.begin.line != span.end.line)
    diagnostic.replacement = example;
  return diagnostic;
}

Diagnostic name_in_an_item(const Span& span, const std::string& what, const std::string& key,
                           const std::string& name) {
  return error("E104", span, what + " must be a list of `key: value` lines",
               "the name is the key: write " + in_ticks(name + ":") + " in the place of " +
                   in_ticks("- " + key + ": " + name) + ", and its other lines indented below it");
}

Diagnostic said_otherwise(const Span& span, const std::string& key, const std::string& what,
                          const std::string& remedy) {
  return error("E101", span, "unknown key " + in_ticks(key) + " in " + what, remedy);
}

Diagnostic vector_by_example(const Span& span, const std::string& what, const std::string& list) {
  return with_replacement(error("E104", span, what + " must be a list of values", "write " + in_ticks(list)),
                          list);
}

Diagnostic named_items(const Span& span, const std::string& what, const std::string& name) {
  return error("E104", span, what + " must be a list",
               "its items have no names: write `- ` in the place of " + in_ticks(name + ":"));
}

Diagnostic body_and_group(const Span& span, const std::string& name) {
  return error("E104", span, "template " + in_ticks(name) + " has both a `body` and a `group`",
               "keep `body` for a task, or `group` for one group of its constraints");
}

Diagnostic template_of_another_part(const Span& span, const std::string& name, bool is_group) {
  return error(
      "E303", span,
      "template " + in_ticks(name) + " is a " + (is_group ? "group, not a task" : "task, not a group"),
      is_group ? "use it under `constraints`, for a group" : "use it under `tasks`, for a task");
}

Diagnostic argument_without_kind(const Span& span, const std::string& name) {
  return error("E104", span, "argument " + in_ticks(name) + " does not say what kind it is of",
               "write for example " + in_ticks(name + ": velocity") + " or " + in_ticks(name + ": task"));
}

Diagnostic frame_only_set(const Span& span, const std::string& name) {
  return error("E301", span, "no frame named " + in_ticks(name),
               "`set` moves a frame that is declared: `frames: {" + name + ": {parent: world}}`");
}

Diagnostic still_to_fill_in(const Span& span, const std::vector<Span>& others) {
  Diagnostic diagnostic =
      error("E105", span, "this is still to be filled in",
            "the comment above it says what with, and docs/language.md under \"The robot file\"");
  for (const Span& other : others) diagnostic.related.push_back({other, "and here"});
  return diagnostic;
}

Diagnostic contact_in_a_condition(const Span& span, const std::string& name) {
  return error("E301", span, "nothing named " + in_ticks(name) + " can be measured here",
               "contact is motion that has ended: `moved(base_link) > 2 cm and speed(base_link) < 5 mm/s`");
}

namespace {

struct ConditionWord {
  std::string_view words;  ///< with a blank on both sides of each
  const char* help;
};
constexpr std::array condition_words{
    ConditionWord{
        " done finished complete completed reached arrived succeeded success failed failure "
        "goal_reached at_goal on_success on_failure ",
        "an exit says how near is near enough, `abs(contact.x.position) < 1 cm`, or that motion has "
        "ended, `speed(base_link) < 5 mm/s`"},
    ConditionWord{" timeout timed_out time_out duration ",
                  "the time since the task was entered is `elapsed`; its longest stands beside `exits`: "
                  "`timeout: {after: 20 s, goto: failed}`"},
    ConditionWord{" true True always yes on ",
                  "an exit that waits for nothing but time says `elapsed > 2 s`"},
    ConditionWord{" false False never no off ", "leave out the exit: it would never be taken"},
};

}  // namespace

std::optional<Diagnostic> word_for_a_condition(const Span& span, const std::string& written) {
  const std::string word = " " + written.substr(written.rfind('.') + 1) + " ";
  for (const auto& [words, help] : condition_words) {
    if (words.find(word) != std::string_view::npos)
      return error("E301", span, "nothing named " + in_ticks(written) + " can be measured here", help);
  }
  return std::nullopt;
}

Diagnostic gear_as_a_ratio(const Span& span, const std::string& turns) {
  return with_replacement(error("E105", span, "a gear is one number: the motor's turns for one of the joint",
                                "write " + in_ticks(turns)),
                          turns);
}

Diagnostic region_without_name(const Span& span, const std::string& region) {
  return error("E104", span, "`inside` must be the name of a region",
               "declare it, `regions: {area: " + (region.empty() ? "{polygon: [..]}" : region) +
                   "}`, and write `inside: area`");
}

Diagnostic height_in_a_place(const Span& span, const std::string& what, const std::string& place) {
  return with_replacement(
      error("E104", span, what + " is a place on the floor: it has no height", "write " + in_ticks(place)),
      place);
}

Diagnostic range_by_names(const Span& span, const std::string& low, const std::string& high) {
  const bool is_whole = !low.empty() && !high.empty();
  const std::string text = is_whole && low == "-" + high
                               ? "+-" + high
                               : "[" + (low.empty() ? ".." : low) + ", " + (high.empty() ? ".." : high) + "]";
  const auto has_unit = [](const std::string& end) {
    const QuantityResult result = parse_quantity(end);
    return end.find('$') != std::string::npos ||
           (result.error == QuantityError::none && result.quantity.has_unit);
  };
  const bool has_units = (low.empty() || has_unit(low)) && (high.empty() || has_unit(high));
  Diagnostic diagnostic = error("E104", span, "a range is two ends in brackets",
                                "write " + in_ticks(text) + (has_units ? "" : ", with their units") +
                                    (low.empty() ? ", or " + in_ticks("+-" + high) : ""));
  if (is_whole && has_units) diagnostic.replacement = text;
  return diagnostic;
}

Diagnostic speed_without_range(const Span& span, const std::string& what, const std::string& most) {
  const std::string range = "[0 m/s, " + most + "]";
  return with_replacement(error("E104", span, what + " must be a range", "write " + in_ticks(range)), range);
}

Diagnostic range_without_brackets(const Span& span, const std::string& text) {
  const std::string range = "[" + text + "]";
  return with_replacement(error("E104", span, "a range stands in brackets", "write " + in_ticks(range)),
                          range);
}

Diagnostic end_without_unit(const Span& span, const std::string& what, const std::string& with_unit,
                            const std::string& with_point) {
  return error(
      "E201", span, what + " needs a unit",
      "write " + in_ticks(with_unit) + ", or " + in_ticks(with_point) + " where the comma is a decimal one");
}

Diagnostic unknown_parameter(const Span& span, const std::string& name,
                             const std::vector<std::string>& known) {
  Diagnostic diagnostic = unknown_name(span, "parameter", name, known);
  const std::string plain = name.substr(name.rfind('.') + 1);
  if (plain != name && std::find(known.begin(), known.end(), plain) != known.end())
    diagnostic.help = "write `$" + plain + "`";
  return diagnostic;
}

Diagnostic unknown_target(const Span& span, const std::string& name, const std::vector<std::string>& known) {
  Diagnostic diagnostic = unknown_name(span, "task", name, known);
  const std::string meant = meant_key(lower_case(name), {"done", "failed"});
  const std::string plain = name.substr(name.rfind('.') + 1);
  if (std::find(known.begin(), known.end(), plain) != known.end()) return with_suggestion(diagnostic, plain);
  return nearest(name, known).empty() ? with_suggestion(diagnostic, meant) : diagnostic;
}

Diagnostic link_for_a_joint(const Span& span, const std::string& link, const std::string& joint) {
  return with_replacement(error("E301", span, "no joint named " + in_ticks(link),
                                "that is a link: the joint above it is " + in_ticks(joint)),
                          joint);
}

Diagnostic footprint_without_polygon(const Span& span) {
  return error("E104", span, "`footprint` does not say that it is a polygon",
               "write `footprint: {polygon: [[0.4 m, 0.3 m], ..]}`");
}

Diagnostic heading_in_a_place(const Span& span, const std::string& what, const std::string& place,
                              const std::string& yaw) {
  return error("E104", span, what + " is a place: a heading stands beside it",
               "write " + in_ticks(place) + " and " + in_ticks(yaw));
}

Diagnostic place_for_a_list(const Span& span, const std::string& what) {
  return error("E104", span, what + " must be a list of places",
               "write each in brackets of its own: `[[0 m, 0 m], [0.5 m, 0 m]]`");
}

namespace {

/// REP 105's names of what stands, and of what floats in it.
constexpr std::array<std::string_view, 4> frames_that_stand{"map", "odom", "earth", "odom_combined"};
constexpr std::array<std::string_view, 7> frames_of_a_base{
    "base_footprint", "base_link", "base", "base_frame", "chassis", "robot", "body"};

bool holds(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Diagnostic unknown_frame(const Span& span, const std::string& kind, const std::string& name,
                         const std::vector<std::string>& known, const std::string& base) {
  Diagnostic diagnostic = unknown_name(span, kind, name, known);
  if (holds(frames_that_stand, name))
    diagnostic.help = "did you mean `world`? It is the one frame that stands, and the run begins in it";
  else if (holds(frames_of_a_base, name) && !base.empty())
    diagnostic.help = "did you mean " + in_ticks(base) + "? That is the robot's base";
  return diagnostic;
}

Diagnostic unknown_base(const Span& span, const std::string& name, const std::vector<std::string>& links,
                        const std::string& root) {
  const std::string meant = holds(frames_of_a_base, name) ? "" : nearest(name, links);
  if (!meant.empty()) return unknown_name(span, "link", name, links);
  return with_replacement(
      error("E301", span, "no link named " + in_ticks(name),
            "did you mean " + in_ticks(root) + "? That is the URDF's root, on which all others hang"),
      root);
}

std::string help_to_invert(double inverse, bool is_time) {
  const bool is_short = is_time && inverse < 1.0;
  const std::string written = is_short ? figure(inverse * 1e3, "ms") : figure(inverse, is_time ? "s" : "Hz");
  return "write " + in_ticks(written);
}

}  // namespace zwang::lang::wording
