#include "spec/parse_group.hpp"

#include <algorithm>
#include <initializer_list>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/in_one_line.hpp"
#include "words/text.hpp"

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

/// The keys of a group or an axis besides its statements.
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

/// The statement that the author of `0 deg` alone may have meant.
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

}  // namespace

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

GroupText unread_group() {
  GroupText unread;
  unread.is_incomplete = true;
  return unread;
}

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

}  // namespace zwang::lang
