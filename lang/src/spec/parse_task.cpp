#include "spec/parse_task.hpp"

#include <algorithm>
#include <initializer_list>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/in_one_line.hpp"
#include "tree/text.hpp"

namespace zwang::lang {

namespace {

/// Level 0 is that of `always` alone.
std::optional<int> parse_level(const Node& node, const std::string& path, int lowest_level,
                               Diagnostics& diagnostics) {
  if (lowest_level > 0 && node.is_scalar() && trimmed(node.text) == "0") {
    diagnostics.add(wording::level_of_always(node.span, path));
    return std::nullopt;
  }
  return parse_integer(node, path, lowest_level, 9, diagnostics);
}

/// `return`: the speed of the way back into a range or a region.
void parse_return(MapReader& map, const std::string& path, std::optional<ValueText>& return_speed,
                  Diagnostics& diagnostics) {
  if (const Node* node = map.optional("return"))
    return_speed = parse_value(*node, path + ".return", diagnostics);
}

/// What a group or an axis may say besides its statements.
void parse_manner(MapReader& map, const std::string& path, std::optional<ValueText>& time_constant,
                  std::optional<ValueText>& weight, std::optional<int>& level, int lowest_level,
                  Diagnostics& diagnostics) {
  if (const Node* node = map.optional("time_constant")) {
    time_constant = parse_value(*node, path + ".time_constant", diagnostics);
  }
  if (const Node* node = map.optional("weight")) weight = parse_value(*node, path + ".weight", diagnostics);
  if (const Node* node = map.optional("level")) {
    level = parse_level(*node, path + ".level", lowest_level, diagnostics);
  }
}

/// `yield: felt.x` moves like a mass with a damper.
void parse_yield(MapReader& map, const std::string& path, AxisText& axis, Diagnostics& diagnostics) {
  const Node* force = map.optional("yield");
  if (force == nullptr) {
    // A misspelt `yield` is told alone, not with all that belongs to it.
    if (map.has_misspelt({"yield"})) {
      for (const char* key : {"mass", "dead_band"}) map.optional(key);
    }
    return;
  }
  axis.yield = parse_expression(*force, path + ".yield", diagnostics);
  axis.yield_span = map.node().find("yield")->key.span;
  if (const Node* node = map.required("mass")) axis.mass = parse_value(*node, path + ".mass", diagnostics);
  map.required("damping");
  if (const Node* node = map.optional("dead_band"))
    axis.dead_band = parse_value(*node, path + ".dead_band", diagnostics);
}

void parse_statements(MapReader& map, const std::string& path, AxisText& axis, int lowest_level,
                      Diagnostics& diagnostics) {
  for (const solver::Quantity quantity : {solver::Quantity::position, solver::Quantity::velocity,
                                          solver::Quantity::acceleration, solver::Quantity::force}) {
    const std::string word = word_of(quantity);
    const Node* node = map.optional(word);
    if (node == nullptr) continue;
    StatementText statement = parse_statement(*node, path + "." + word, diagnostics);
    statement.key_span = map.node().find(word)->key.span;
    axis.statements[static_cast<std::size_t>(quantity)] = std::move(statement);
  }
  parse_manner(map, path, axis.time_constant, axis.weight, axis.level, lowest_level, diagnostics);
  if (const Node* node = map.optional("stiffness")) {
    axis.stiffness = parse_value(*node, path + ".stiffness", diagnostics);
  }
  parse_yield(map, path, axis, diagnostics);
  if (const Node* node = map.optional("damping")) {
    axis.damping = parse_value(*node, path + ".damping", diagnostics);
  }
  if (const Node* node = map.optional("build_up")) {
    axis.build_up = parse_value(*node, path + ".build_up", diagnostics);
  }
  parse_return(map, path, axis.return_speed, diagnostics);
}

/// What `0 deg` alone may have been meant as.
std::string statement_of(const std::string& text, const std::string& axis) {
  const QuantityResult result = parse_quantity(text);
  const Dimension& d = result.quantity.dimension;
  const bool is_known = result.error == QuantityError::none;
  if (axis == "plane" && is_known && d == dimension::acceleration)
    return "{acceleration: [0 m/s^2, " + text + "]}";
  if (axis == "plane" && is_known && d == dimension::force) return "{force: [0 N, " + text + "]}";
  if ((axis == "speed" || axis == "plane") && (is_known || text.starts_with("$")))
    return "{velocity: [0 m/s, " + wording::with_unit(text, dimension::velocity) + "]}";
  if (is_known && !result.quantity.has_unit)
    return "{velocity: " +
           wording::with_unit(text,
                              axis.starts_with('r') ? dimension::angular_velocity : dimension::velocity) +
           "}";
  if (is_known && (d == dimension::length || d == dimension::angle)) return "{position: " + text + "}";
  if (is_known && (d == dimension::force || d == dimension::torque)) return "{force: " + text + "}";
  if (is_known && (d == dimension::acceleration || d == dimension::angular_acceleration))
    return "{acceleration: " + text + "}";
  if (is_known || text.starts_with("$")) return "{velocity: " + text + "}";
  return "{position: here}";
}

/// `plane`: ranges of norms, one at least. A single value would drive, and a norm has no direction (E415).
void parse_plane(MapReader& map, const Entry& entry, const std::string& path, AxisText& axis,
                 Diagnostics& diagnostics) {
  bool is_empty = true;
  for (const solver::Quantity quantity : {solver::Quantity::position, solver::Quantity::velocity,
                                          solver::Quantity::acceleration, solver::Quantity::force}) {
    const std::string word = word_of(quantity);
    const Node* node = map.optional(word);
    if (node == nullptr) continue;
    is_empty = false;
    StatementText range = parse_statement(*node, path + "." + word, diagnostics);
    const bool is_read = range.is_range || range.value.kind != ValueKind::bad;
    if (is_read && (quantity == solver::Quantity::position || !range.is_range)) {
      diagnostics.add(wording::norm_that_drives(node->span, path + "." + word));
      continue;
    }
    range.is_range = true;
    range.key_span = entry.value.find(word)->key.span;
    axis.statements[static_cast<std::size_t>(quantity)] = std::move(range);
  }
  if (is_empty && !map.has_unread_keys()) diagnostics.add(wording::silent_axis(entry.key.span, path));
}

/// `is_incomplete` is set where a key could not be read.
AxisText parse_axis(const Entry& entry, const std::string& group, int lowest_level, bool& is_incomplete,
                    Diagnostics& diagnostics) {
  AxisText axis;
  axis.name = {entry.key.text, entry.key.span};
  const std::string path = group + "." + entry.key.text;
  if (entry.value.is_scalar() && !entry.value.is_bad) {
    axis.is_free = entry.value.text == "free";
    if (!axis.is_free)
      diagnostics.add(wording::bare_axis(entry.value.span, path, entry.value.text,
                                         statement_of(trimmed(entry.value.text), entry.key.text)));
    return axis;
  }
  const bool is_empty =
      entry.value.kind == NodeKind::null || (entry.value.is_mapping() && entry.value.entries.empty());
  if (is_empty && !entry.value.is_bad) {
    diagnostics.add(wording::silent_axis(entry.key.span, path));
    return axis;
  }
  if (entry.value.find("free") != nullptr && entry.value.entries.size() == 1) {
    diagnostics.add(wording::free_in_brackets(entry.value.span));
    axis.is_free = true;
    return axis;
  }
  MapReader map(entry.value, "axis `" + path + "`", diagnostics);
  if (axis.is_plane()) {
    parse_manner(map, path, axis.time_constant, axis.weight, axis.level, lowest_level, diagnostics);
    parse_plane(map, entry, path, axis, diagnostics);
  } else if (axis.is_speed()) {
    parse_manner(map, path, axis.time_constant, axis.weight, axis.level, lowest_level, diagnostics);
    // Another quantity in its place is an unknown key, and told as such.
    const bool is_another = entry.value.find("velocity") == nullptr && map.has_unread_keys();
    if (const Node* node = is_another ? map.optional("velocity") : map.required("velocity")) {
      // One value of a speed is its upper end.
      const std::string most = node->is_scalar() ? trimmed(node->text) : "";
      const bool is_end = parse_quantity(most).error == QuantityError::none;
      if (is_end)
        diagnostics.add(wording::speed_without_range(node->span, path + ".velocity",
                                                     wording::with_unit(most, dimension::velocity)));
      StatementText range = is_end ? StatementText{} : parse_range(*node, path + ".velocity", diagnostics);
      range.is_range = true;
      range.span = node->span;
      range.key_span = entry.value.find("velocity")->key.span;
      axis.statements[static_cast<std::size_t>(solver::Quantity::velocity)] = std::move(range);
    }
  } else {
    parse_statements(map, path, axis, lowest_level, diagnostics);
  }
  is_incomplete = is_incomplete || map.has_unread_keys();
  map.finish();
  return axis;
}

/// `inside: [[0 m, 0 m], ..]` and `inside: {polygon: ..}` for a region's name. Whether it was so.
bool complain_of_region(const Node& node, Diagnostics& diagnostics) {
  const bool is_region = node.find("polygon") != nullptr || node.find("circle") != nullptr;
  const bool is_list = node.items.size() > 1;
  if (node.is_bad || (!is_region && !is_list)) return false;
  const bool has_corners = is_list && node.items[0].is_sequence();
  const std::string written = in_one_line(node, dimension::length);
  diagnostics.add(wording::region_without_name(
      node.span, is_region ? written : (has_corners ? "{polygon: " + written + "}" : "")));
  return true;
}

GroupText parse_group(const Entry& entry, int lowest_level, Diagnostics& diagnostics) {
  GroupText group;
  group.name = parse_name(entry.key, "a group's name", diagnostics);
  const std::string& path = entry.key.text;
  MapReader map(entry.value, "constraint group `" + path + "`", diagnostics);
  const auto is_meant = [&](const char* key) {
    const bool is_another = entry.value.find("in") != nullptr || entry.value.find("inside") != nullptr;
    return entry.value.find(key) != nullptr || (!is_another && map.has_misspelt({key}));
  };
  if (is_meant("feature")) {
    group.kind = GroupKind::feature;
    if (const Node* feature = map.required("feature")) {
      group.feature = parse_word(*feature, "`feature`", diagnostics);
    }
    AxisText axis;
    axis.name = {path, entry.key.span};
    parse_statements(map, path, axis, lowest_level, diagnostics);
    group.axes.push_back(std::move(axis));
  } else if (is_meant("inside")) {
    group.kind = GroupKind::inside;
    const Node* region = map.required("inside");
    if (region != nullptr && !complain_of_region(*region, diagnostics)) {
      group.region = parse_word(*region, "`inside`", diagnostics);
    }
    if (const Node* node = map.required("move")) group.move = parse_word(*node, "`move`", diagnostics);
    if (const Node* node = map.optional("margin")) {
      group.margin = parse_value(*node, path + ".margin", diagnostics);
    }
    parse_return(map, path, group.return_speed, diagnostics);
    if (const Node* node = map.optional("level")) {
      group.level = parse_level(*node, path + ".level", lowest_level, diagnostics);
    }
  } else {
    if (const Node* node = map.required("move")) group.move = parse_word(*node, "`move`", diagnostics);
    if (const Node* node = map.required("in")) group.in = parse_word(*node, "`in`", diagnostics);
    parse_manner(map, path, group.time_constant, group.weight, group.level, lowest_level, diagnostics);
    parse_return(map, path, group.return_speed, diagnostics);
    for (const char* name : {"x", "y", "z", "rx", "ry", "rz", "speed", "plane"}) {
      if (map.optional(name) == nullptr) continue;
      group.axes.push_back(
          parse_axis(*entry.value.find(name), path, lowest_level, group.is_incomplete, diagnostics));
    }
  }
  group.is_incomplete =
      group.is_incomplete || !map.is_mapping() || !group.name.exists() || map.has_unread_keys();
  map.finish();
  return group;
}

std::vector<SetText> parse_sets(const Node& node, Diagnostics& diagnostics) {
  std::vector<SetText> sets;
  if (!require_mapping(node, "`set`", diagnostics)) return sets;
  for (const Entry& entry : node.entries) {
    if (entry.key.is_bad) continue;
    SetText set;
    set.span = entry.key.span;
    const std::string& key = entry.key.text;
    const std::size_t dot = key.find('.');
    const std::string kind = key.substr(0, dot);
    const std::string name = dot == std::string::npos ? std::string() : key.substr(dot + 1);
    const bool is_kind = kind == "frames" || kind == "params" || kind == "outputs";
    if (!is_kind || !is_identifier(name)) {
      diagnostics.add(wording::bad_set(entry.key.span, key));
      continue;
    }
    set.name = {name, entry.key.span};
    set.kind = kind == "frames" ? SetKind::frame : kind == "params" ? SetKind::parameter : SetKind::output;
    if (set.kind == SetKind::frame) {
      set.source = parse_word(entry.value, "`" + key + "`", diagnostics);
    } else {
      set.value = parse_value(entry.value, "`" + key + "`", diagnostics);
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

ExitText parse_exit(const Node& node, Diagnostics& diagnostics) {
  ExitText exit;
  exit.span = node.span;
  MapReader map(node, "an exit", diagnostics);
  const Node* when = map.required("when");
  const Node* dwell = map.optional("for");
  const Node* release = map.optional("release");
  const Node* target = map.required("goto");
  const Node* set = map.optional("set");
  const Node* note = map.optional("note");
  const bool is_split = map.report_split_condition();
  if (when != nullptr && !is_split) exit.when = parse_condition(*when, diagnostics);
  if (dwell != nullptr) exit.dwell = parse_value(*dwell, "`for`", diagnostics);
  if (release != nullptr) exit.release = parse_value(*release, "`release`", diagnostics);
  if (target != nullptr) exit.target = parse_word(*target, "`goto`", diagnostics);
  if (set != nullptr) exit.set = parse_sets(*set, diagnostics);
  if (note != nullptr) exit.note = parse_text(*note, "`note`", diagnostics);
  exit.is_incomplete = map.has_unread_keys();
  map.finish();
  return exit;
}

/// `text` as a time: with a unit where it lacks one, and some time where it is none.
std::string time_of(const std::string& text) {
  const bool is_a_time = text.starts_with("$") || parse_quantity(text).error == QuantityError::none;
  return is_a_time ? wording::with_unit(text, dimension::time) : "20 s";
}

TimeoutText parse_timeout(const Node& node, Diagnostics& diagnostics) {
  TimeoutText timeout;
  timeout.span = node.span;
  if (node.is_scalar() && node.text == "never") {
    timeout.is_never = true;
    return timeout;
  }
  if (node.is_scalar()) {
    if (!node.is_bad) diagnostics.add(wording::bare_timeout(node.span, time_of(trimmed(node.text))));
    return timeout;
  }
  MapReader map(node, "`timeout`", diagnostics);
  const Entry* never = node.is_mapping() ? node.find("after") : nullptr;
  if (never != nullptr && never->value.is_scalar() && never->value.text == "never") {
    diagnostics.add(wording::never_after(node.span));
    timeout.is_never = true;
    return timeout;
  }
  if (const Node* after = map.required("after")) {
    timeout.after = parse_value(*after, "timeout.after", diagnostics);
  }
  if (const Node* target = map.required("goto")) timeout.target = parse_word(*target, "`goto`", diagnostics);
  if (const Node* note = map.optional("note")) timeout.note = parse_text(*note, "`note`", diagnostics);
  map.finish();
  return timeout;
}

void parse_enter(const Node& node, TaskText& task, Diagnostics& diagnostics) {
  MapReader map(node, "`enter`", diagnostics, "{blend: 0.2 s}");
  if (const Node* require = map.optional("require")) task.require = parse_condition(*require, diagnostics);
  if (const Node* blend = map.optional("blend")) {
    task.blend = parse_value(*blend, "enter.blend", diagnostics);
  }
  if (const Node* set = map.optional("set")) task.set_on_entry = parse_sets(*set, diagnostics);
  map.finish();
}

/// Whether the entry is a line of a group, rather than a group: `move: base_link`, `x: {velocity: ..}`.
bool is_of_a_group(const Entry& entry) {
  static const std::vector<std::string> words{
      "move",          "in",     "feature",   "inside",  "margin",    "level",    "weight",
      "time_constant", "return", "stiffness", "damping", "position",  "velocity", "acceleration",
      "force",         "x",      "y",         "z",       "rx",        "ry",       "rz",
      "speed",         "plane",  "yield",     "mass",    "dead_band", "build_up"};
  const Node& value = entry.value;
  if (std::find(words.begin(), words.end(), entry.key.text) == words.end()) return false;
  if (!value.is_mapping()) return value.kind != NodeKind::null;
  const auto has = [&](std::initializer_list<const char*> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return value.find(key) != nullptr; });
  };
  return has({"position", "velocity", "acceleration", "force", "yield"}) &&
         !has({"move", "in", "feature", "inside"});
}

/// In the place of groups that could not be read: one of them may be the one that a condition names.
GroupText unread_group() {
  GroupText unread;
  unread.is_incomplete = true;
  return unread;
}

}  // namespace

std::vector<GroupText> parse_groups(const Node& node, int lowest_level, Diagnostics& diagnostics) {
  std::vector<GroupText> groups;
  if (!require_mapping(node, "`constraints`", diagnostics)) return {unread_group()};
  if (node.entries.size() > most_groups) {
    diagnostics.add(wording::too_many_groups(node.entries[most_groups].key.span, most_groups));
  }
  for (auto entry = node.entries.begin(); entry != node.entries.end(); ++entry) {
    if (entry->key.is_bad) continue;
    const auto next = entry + 1;
    const bool is_stray = is_of_a_group(*entry);
    if (!is_stray && (next == node.entries.end() || !is_of_a_group(*next))) {
      groups.push_back(parse_group(*entry, lowest_level, diagnostics));
      continue;
    }
    // Told once for all lines of the group.
    const auto first = is_stray ? entry : next;
    diagnostics.add(wording::not_indented(first->key.span, first->key.text, is_stray ? "" : entry->key.text));
    entry = std::find_if_not(first, node.entries.end(), is_of_a_group) - 1;
    groups.push_back(unread_group());
  }
  return groups;
}

std::vector<GroupText> parse_constraints(MapReader& map, int lowest_level, Diagnostics& diagnostics) {
  if (const Node* node = map.optional("constraints")) return parse_groups(*node, lowest_level, diagnostics);
  if (!map.has_misspelt({"constraints"})) return {};
  return {unread_group()};
}

std::vector<ExitText> parse_exits(const Node& node, Diagnostics& diagnostics) {
  std::vector<ExitText> exits;
  if (!require_sequence(node, "`exits`", diagnostics)) return exits;
  for (const Node& item : node.items) exits.push_back(parse_exit(item, diagnostics));
  return exits;
}

TaskText parse_task(const Entry& entry, const Node& body, Diagnostics& diagnostics) {
  TaskText task;
  task.name = parse_name(entry.key, "a task's name", diagnostics);
  const std::string& name = task.name.text;
  if (name == "done" || name == "failed" || name == "back") {
    diagnostics.add(wording::reserved_name(entry.key.span, name));
  }
  // Lines of a group are told once, and then not read as a task's.
  Node without_them;
  const auto stray = std::find_if(body.entries.begin(), body.entries.end(), is_of_a_group);
  const bool has_stray = stray != body.entries.end();
  if (has_stray) {
    diagnostics.add(wording::group_in_a_task(stray->key.span, stray->key.text));
    without_them = body;
    std::erase_if(without_them.entries, is_of_a_group);
  }
  MapReader map(has_stray ? without_them : body, "task `" + entry.key.text + "`", diagnostics);
  task.is_bad = !map.is_mapping();
  if (const Node* node = map.optional("about")) task.about = parse_text(*node, "`about`", diagnostics);
  if (const Node* node = map.optional("enter")) parse_enter(*node, task, diagnostics);
  task.groups = parse_constraints(map, 1, diagnostics);
  if (has_stray) task.groups.push_back(unread_group());
  if (const Node* node = map.optional("exits")) task.exits = parse_exits(*node, diagnostics);
  if (const Node* node = map.optional("timeout")) task.timeout = parse_timeout(*node, diagnostics);
  const Node* attempts_node = map.optional("attempts");
  if (attempts_node != nullptr && attempts_node->is_scalar() && !attempts_node->is_bad) {
    diagnostics.add(wording::bare_attempts(attempts_node->span, attempts_node->text));
  } else if (const Node* node = attempts_node) {
    MapReader attempts(*node, "`attempts`", diagnostics);
    AttemptsText text;
    text.span = node->span;
    if (const Node* most = attempts.required("max")) {
      text.most = parse_integer(*most, "attempts.max", 1, 1000000, diagnostics).value_or(1);
    }
    if (const Node* target = attempts.required("goto")) {
      text.target = parse_word(*target, "`goto`", diagnostics);
    }
    if (const Node* note = attempts.optional("note")) text.note = parse_text(*note, "`note`", diagnostics);
    attempts.finish();
    task.attempts = std::move(text);
  }
  if (map.has_misspelt({"use"})) {
    for (const char* key : {"use", "with"}) map.optional(key);
    task.groups.push_back(unread_group());
  }
  task.is_bad = task.is_bad || !task.name.exists() || map.has_unread_keys();
  map.finish();
  return task;
}

}  // namespace zwang::lang
