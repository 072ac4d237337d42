#include "edit/name_walk.hpp"

#include <algorithm>
#include <array>

#include "words/text.hpp"
#include "words/units.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t end_of_word(std::string_view text, std::size_t at) {
  while (at < text.size() && is_word_part(text[at])) ++at;
  return at;
}

const Node& below(const Node& node, std::string_view key) {
  static const Node none;
  const Entry* entry = node.find(key);
  return entry == nullptr ? none : entry->value;
}

/// The first part of `hook.x`.
std::size_t length_of_first(std::string_view text) {
  return std::min(text.find('.'), text.size());
}

/// As NamePlace::unit.
std::optional<std::string> unit_given(NameKind kind, const Node& declared) {
  if (kind == NameKind::parameter) {
    const QuantityResult read =
        parse_quantity(declared.is_mapping() ? below(declared, "value").text : declared.text);
    return read.error == QuantityError::none ? std::optional(read.quantity.unit) : std::nullopt;
  }
  if (kind == NameKind::feature) {
    if (declared.find("distance") != nullptr) return "m";
    const bool is_angle = declared.find("angle") != nullptr || declared.find("bearing") != nullptr;
    return is_angle ? std::optional<std::string>("rad") : std::nullopt;
  }
  const bool may_be_number = kind == NameKind::signal || kind == NameKind::output;
  if (!may_be_number || below(declared, "type").text != "number") return std::nullopt;
  return below(declared, "unit").text;
}

}  // namespace

void NameWalk::give(const Node& key, NameKind kind, const std::string& scope) {
  if (key.is_scalar() && !key.text.empty()) places_.push_back({{kind}, key.text, scope, key.span, true});
}

void NameWalk::mean(const Node& scalar, Kinds kinds, const std::string& scope) {
  if (scalar.is_scalar()) mean_part(scalar, 0, scalar.text.size(), std::move(kinds), scope);
}

void NameWalk::mean_part(const Node& scalar, std::size_t begin, std::size_t end, Kinds kinds,
                         const std::string& scope) {
  const std::string name = scalar.text.substr(begin, end - begin);
  if (!is_name(name)) return;
  const std::optional<Span> span = span_of(scalar, begin, end);
  if (span) places_.push_back({std::move(kinds), name, scope, *span, false});
}

/// A scalar that stands as it is on one line needs no search for the places of its letters.
std::optional<Span> NameWalk::span_of(const Node& scalar, std::size_t begin, std::size_t end) const {
  const Position& first = scalar.span.begin;
  const auto width = static_cast<int>(scalar.text.size());
  const bool is_plain = !scalar.is_quoted && first.line == scalar.span.end.line &&
                        scalar.span.end.column - first.column == width;
  if (is_plain) {
    const auto at = [&](std::size_t i) { return Position{first.line, first.column + static_cast<int>(i)}; };
    return Span{document_.source, at(begin), at(end)};
  }
  const std::vector<Position> positions = positions_of(scalar, text_);
  if (end >= positions.size()) return std::nullopt;
  return Span{document_.source, positions[begin], positions[end]};
}

/// The kinds of names that a word may have, in the parenthesis of the function `called` or outside of any.
std::vector<NameKind> kinds_in(const ConditionFunction* called) {
  if (called != nullptr && called->argument == FunctionArgument::task) return {NameKind::task};
  if (called != nullptr && called->argument == FunctionArgument::signal) return {NameKind::signal};
  const bool is_place = called != nullptr && (called->argument == FunctionArgument::frame ||
                                              called->argument == FunctionArgument::path);
  if (is_place) return {NameKind::frame};
  return {NameKind::group,   NameKind::signal, NameKind::output,
          NameKind::feature, NameKind::frame,  NameKind::object};
}

/// The first word of each path of words, and what the functions take. A word behind a number is its unit.
void NameWalk::mean_condition(const Node& scalar, const std::string& scope) {
  if (!scalar.is_scalar()) return;
  const std::string& text = scalar.text;
  bool is_behind_number = false;
  const ConditionFunction* called = nullptr;  // in whose parenthesis the next word stands
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (is_digit(c) || c == '.') {
      while (at < text.size() && (is_word_part(text[at]) || text[at] == '.')) ++at;  // with an exponent
      is_behind_number = true;
    } else if (c == '$') {
      const std::size_t end = end_of_word(text, at + 1);
      mean_part(scalar, at + 1, end, {NameKind::argument, NameKind::parameter}, scope);
      at = std::max(end, at + 1);
    } else if (is_word_start(c)) {
      const std::size_t end = end_of_word(text, at);
      const ConditionFunction* call =
          end < text.size() && text[end] == '(' ? find_function(text.substr(at, end - at)) : nullptr;
      const std::string_view word = std::string_view(text).substr(at, end - at);
      const bool joins = word == "and" || word == "or" || word == "not";
      if (!is_behind_number && call == nullptr && !joins) mean_part(scalar, at, end, kinds_in(called), scope);
      called = call;
      at = end;
      while (at < text.size() && (is_word_part(text[at]) || text[at] == '.')) ++at;  // `.x.velocity`
    } else {
      // A unit goes on over blanks and signs: `3 N m/s^2`.
      is_behind_number = is_behind_number && (c == ' ' || c == '^' || c == '/');
      ++at;
    }
    if (is_behind_number && at < text.size() && text.compare(at, 5, " and ") == 0) is_behind_number = false;
    if (is_behind_number && at < text.size() && text.compare(at, 4, " or ") == 0) is_behind_number = false;
  }
}

void NameWalk::mean_parameters(const Node& node, const std::string& scope) {
  for (const Node& item : node.items) mean_parameters(item, scope);
  for (const Entry& entry : node.entries) mean_parameters(entry.value, scope);
  if (!node.is_scalar()) return;
  for (std::size_t at = node.text.find('$'); at != std::string::npos; at = node.text.find('$', at + 1))
    mean_part(node, at + 1, end_of_word(node.text, at + 1), {NameKind::argument, NameKind::parameter}, scope);
}

/// `push` of `params.push`.
void NameWalk::mean_key_part(const Node& key, std::string_view prefix, NameKind kind) {
  if (key.text.starts_with(prefix)) mean_part(key, prefix.size(), key.text.size(), {kind});
}

std::vector<NamePlace> NameWalk::walk(FileKind kind) {
  switch (kind) {
    case FileKind::task:
      walk_task_file(document_.root);
      break;
    case FileKind::scene:
      walk_scene(document_.root);
      break;
    case FileKind::scenario:
      walk_scenario(document_.root);
      break;
    case FileKind::study:
      walk_scenario(document_.root);
      for (const Entry& draw : below(document_.root, "draw").entries)
        mean_key_part(draw.key, "params.", NameKind::parameter);
      break;
    case FileKind::connection:
      walk_connection(document_.root);
      break;
    case FileKind::robot:
      for (const Entry& frame : below(document_.root, "frames").entries) give(frame.key, NameKind::frame);
      break;
  }
  return std::move(places_);
}

// --- task files ---

void NameWalk::walk_task_file(const Node& root) {
  walk_declarations(root);
  walk_frames(root);
  walk_features(below(root, "features"));
  walk_templates(below(root, "templates"));
  const Node& always = below(root, "always");
  walk_groups(below(always, "constraints"), "always");
  walk_exits(below(always, "exits"), "always");
  mean(below(root, "start"), {NameKind::task});
  for (const Entry& task : below(root, "tasks").entries) walk_task(task.value, "tasks." + task.key.text);
}

void NameWalk::walk_declarations(const Node& root) {
  constexpr std::array<std::pair<const char*, NameKind>, 9> sections = {
      {{"params", NameKind::parameter},
       {"outputs", NameKind::output},
       {"frames", NameKind::frame},
       {"paths", NameKind::frame},  // the one that it begins in
       {"regions", NameKind::region},
       {"signals", NameKind::signal},
       {"features", NameKind::feature},
       {"templates", NameKind::task_template},
       {"tasks", NameKind::task}}};
  for (const auto& [section, kind] : sections) {
    for (const Entry& entry : below(root, section).entries) {
      const std::size_t before = places_.size();
      give(entry.key, kind);
      if (places_.size() > before) places_.back().unit = unit_given(kind, entry.value);
    }
  }
}

/// The frames that other frames, regions and signals are seen from.
void NameWalk::walk_frames(const Node& root) {
  const Kinds frames{NameKind::frame, NameKind::signal};
  for (const char* section : {"frames", "regions", "paths"}) {
    for (const Entry& entry : below(root, section).entries) mean(below(entry.value, "parent"), frames);
  }
  for (const Entry& signal : below(root, "signals").entries) {
    for (const char* key : {"in", "holds"}) mean(below(signal.value, key), frames);
  }
}

void NameWalk::walk_features(const Node& features) {
  for (const Entry& feature : features.entries) {
    for (const char* key : {"distance", "bearing"}) {
      for (const Node& frame : below(feature.value, key).items) mean(frame, {NameKind::frame});
    }
    for (const Node& axis : below(feature.value, "angle").items)
      mean_part(axis, 0, length_of_first(axis.text), {NameKind::frame});
    const Node& direction = below(feature.value, "direction");
    for (const char* key : {"move", "in"}) mean(below(direction, key), {NameKind::frame});
  }
}

void NameWalk::walk_templates(const Node& templates) {
  for (const Entry& entry : templates.entries) {
    const std::string scope = "templates." + entry.key.text;
    for (const Entry& argument : below(entry.value, "args").entries)
      give(argument.key, NameKind::argument, scope);
    walk_task(below(entry.value, "body"), scope);
    mean_parameters(below(entry.value, "group"), scope);
    walk_group(below(entry.value, "group"), scope);
  }
}

void NameWalk::walk_task(const Node& task, const std::string& scope) {
  mean_parameters(task, scope);
  walk_use(task);
  const Node& enter = below(task, "enter");
  mean_condition(below(enter, "require"), scope);
  walk_set(below(enter, "set"), scope);
  walk_groups(below(task, "constraints"), scope);
  walk_exits(below(task, "exits"), scope);
  for (const char* key : {"timeout", "attempts"}) mean(below(below(task, key), "goto"), {NameKind::task});
}

void NameWalk::walk_use(const Node& task) {
  const Node& use = below(task, "use");
  if (!use.is_scalar()) return;
  mean(use, {NameKind::task_template});
  for (const Entry& argument : below(task, "with").entries) {
    mean(argument.key, {NameKind::argument}, "templates." + use.text);
    mean(argument.value,
         {NameKind::frame, NameKind::task, NameKind::signal, NameKind::region, NameKind::feature});
  }
}

void NameWalk::walk_groups(const Node& groups, const std::string& scope) {
  for (const Entry& group : groups.entries) {
    give(group.key, NameKind::group, scope);
    if (scope == "always") mean_parameters(group.value, scope);
    walk_group(group.value, scope);
  }
}

void NameWalk::walk_group(const Node& group, const std::string& scope) {
  walk_use(group);
  const Kinds frames{NameKind::frame, NameKind::signal};
  for (const char* key : {"move", "in"}) mean(below(group, key), frames);
  mean(below(group, "inside"), {NameKind::region});
  mean(below(group, "feature"), {NameKind::feature});
  mean_condition(below(group, "yield"), scope);
  for (const Entry& axis : group.entries) mean_condition(below(axis.value, "yield"), scope);
  for (const char* quantity : {"position", "velocity", "acceleration", "force"}) {
    mean(below(group, quantity), {NameKind::signal}, scope);
    for (const Entry& axis : group.entries) mean(below(axis.value, quantity), {NameKind::signal}, scope);
  }
}

void NameWalk::walk_exits(const Node& exits, const std::string& scope) {
  for (const Node& exit : exits.items) {
    if (scope == "always") mean_parameters(exit, scope);
    mean_condition(below(exit, "when"), scope);
    mean(below(exit, "goto"), {NameKind::task});
    walk_set(below(exit, "set"), scope);
  }
}

void NameWalk::walk_set(const Node& set, const std::string& scope) {
  for (const Entry& action : set.entries) {
    mean_key_part(action.key, "frames.", NameKind::frame);
    mean_key_part(action.key, "params.", NameKind::parameter);
    mean_key_part(action.key, "outputs.", NameKind::output);
    mean(action.value, {NameKind::frame}, scope);
  }
}

// --- files beside the task ---

void NameWalk::walk_scene(const Node& root) {
  for (const char* section : {"objects", "robots"}) {
    for (const Entry& entry : below(root, section).entries) give(entry.key, NameKind::object);
  }
  walk_signals(below(root, "signals"));
  walk_robots(below(root, "robots"));
}

/// The signals that a scene measures, by the names of the task file, and the object of each.
void NameWalk::walk_signals(const Node& signals) {
  for (const Entry& signal : signals.entries) {
    mean(signal.key, {NameKind::signal});
    for (const Entry& entry : signal.value.entries) mean(entry.value, {NameKind::object});
  }
}

/// Signals and parameters of another robot are those of its own task file: they are not told apart here.
void NameWalk::walk_robots(const Node& robots) {
  for (const Entry& robot : robots.entries) {
    for (const Entry& parameter : below(robot.value, "params").entries)
      mean(parameter.key, {NameKind::parameter}, "robots." + robot.key.text);
    for (const Entry& signal : below(robot.value, "signals").entries)
      mean(signal.key, {NameKind::signal}, "robots." + robot.key.text);
  }
}

void NameWalk::walk_scenario(const Node& root) {
  for (const Entry& set : below(root, "faults").entries) give(set.key, NameKind::fault_set);
  for (const Node* keys : {&root, &below(root, "matrix")}) {
    for (const Entry& entry : keys->entries) mean_key_part(entry.key, "params.", NameKind::parameter);
    for (const Entry& entry : below(*keys, "params").entries) mean(entry.key, {NameKind::parameter});
  }
  for (const Node& faults : below(below(root, "matrix"), "faults").items) mean(faults, {NameKind::fault_set});
  for (const Node& expected : below(root, "expect").items) {
    for (const char* key : {"that", "always"}) mean_condition(below(expected, key), "expect");
    mean(below(expected, "of"), {NameKind::task, NameKind::object});
  }
}

void NameWalk::walk_connection(const Node& root) {
  for (const Entry& signal : below(root, "signals").entries) mean(signal.key, {NameKind::signal});
}

}  // namespace zwang::lang
