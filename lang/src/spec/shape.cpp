#include "spec/shape.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/decimal_comma.hpp"
#include "spec/in_one_line.hpp"
#include "words/text.hpp"

namespace zwang::lang {

Word parse_word(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  if (node.is_bad) return {};
  if (!node.is_scalar() || trimmed(node.text).empty()) {
    // `{file: mini.yaml}` and `[mini.yaml]` for `mini.yaml`.
    const bool is_one = node.entries.size() + node.items.size() == 1;
    const Node* word = !is_one ? nullptr : node.is_mapping() ? &node.entries[0].value : &node.items[0];
    diagnostics.add(
        wording::expected_word(node.span, what, word != nullptr && word->is_scalar() ? word->text : ""));
    return {};
  }
  return {node.text, node.span};
}

Word parse_name(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  Word word = parse_word(node, what, diagnostics);
  if (word.exists() && !is_identifier(word.text)) {
    diagnostics.add(wording::not_a_name(node.span, word.text));
    return {{}, node.span};  // no name, but a place for what else is said of the thing
  }
  return word;
}

std::string parse_text(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  if (node.is_bad) return {};
  if (!node.is_scalar()) {
    diagnostics.add(wording::expected_value(node.span, what, node.kind == NodeKind::null));
  }
  return node.text;
}

namespace {

/// 10000 of `1e4`; else the least number above 0.
int meant_integer(const std::string& text, int low, int high) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole =
      error == std::errc{} && end == text.data() + text.size() && number == std::floor(number);
  return is_whole && low <= number && number <= high ? static_cast<int>(number) : std::max(low, 1);
}

}  // namespace

std::optional<int> parse_integer(const Node& node, const std::string& what, int low, int high,
                                 Diagnostics& diagnostics) {
  if (node.is_bad) return std::nullopt;
  int value = 0;
  const std::string text = node.is_scalar() ? trimmed(node.text) : std::string();
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = !text.empty() && error == std::errc{} && end == text.data() + text.size();
  if (!is_whole || value < low || value > high) {
    diagnostics.add(wording::expected_integer(node.span, what, low, high, meant_integer(text, low, high)));
    return std::nullopt;
  }
  return value;
}

std::optional<bool> parse_boolean(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  if (node.is_bad) return std::nullopt;
  if (node.is_scalar() && node.text == "true") return true;
  if (node.is_scalar() && node.text == "false") return false;
  diagnostics.add(wording::expected_boolean(node.span, what));
  return std::nullopt;
}

namespace {

/// The keys that other programs use for an item's name in a list of items.
bool is_name_key(std::string_view key) {
  return key == "name" || key == "id" || key == "joint";
}

/// `{gap: 1 m, pace: 2 m}` of `[gap: 1 m, pace: 2 m]`.
std::string without_brackets(const Node& list) {
  std::string line;
  for (const Node& item : list.items) {
    std::string entry = in_one_line(item, dimension::none);
    if (item.is_mapping()) entry = entry.substr(1, entry.size() - 2);
    line += (line.empty() ? "" : ", ") + entry;
  }
  return "{" + line + "}";
}

}  // namespace

bool require_sequence(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  if (node.is_bad) return false;
  if (!node.is_sequence()) {
    const bool is_named = node.is_mapping() && !node.entries.empty() && node.entries[0].value.is_mapping();
    diagnostics.add(is_named ? wording::named_items(node.span, what, node.entries[0].key.text)
                             : wording::expected_list(node.span, what));
  }
  return node.is_sequence();
}

bool require_mapping(const Node& node, const std::string& what, Diagnostics& diagnostics,
                     const std::string& example) {
  if (node.is_bad) return false;
  if (node.is_mapping()) return true;
  const bool holds_entries = node.is_sequence() && !node.items.empty() && node.items[0].is_mapping() &&
                             !node.items[0].entries.empty();
  const Entry* first = holds_entries ? &node.items[0].entries[0] : nullptr;
  const bool is_one_each = first != nullptr && node.items[0].entries.size() == 1;
  const bool names_itself = first != nullptr && first->value.is_scalar() && is_name_key(first->key.text);
  if (names_itself) {
    diagnostics.add(wording::name_in_an_item(node.span, what, first->key.text, first->value.text));
  } else if (is_one_each && node.is_flow) {
    diagnostics.add(wording::mapping_by_example(node.span, what, without_brackets(node)));
  } else if (!is_one_each && !example.empty()) {
    diagnostics.add(wording::mapping_by_example(node.span, what, example));
  } else {
    diagnostics.add(wording::expected_mapping(node.span, what, node.is_sequence() && !node.is_flow));
  }
  return false;
}

std::optional<double> parse_plain(const Node& node, const Dimension& expected, const std::string& what,
                                  Diagnostics& diagnostics) {
  const ValueText value = parse_value(node, what, diagnostics);
  if (!require_quantity(value, expected, what, diagnostics)) return std::nullopt;
  return value.quantity.value;
}

bool require_positive(const ValueText& value, const Dimension& expected, const std::string& what,
                      bool zero_allowed, Diagnostics& diagnostics) {
  if (!require_quantity(value, expected, what, diagnostics)) return false;
  const double number = value.quantity.value;
  const bool is_good = number > 0.0 || (zero_allowed && number == 0.0);
  if (!is_good) diagnostics.add(wording::not_positive(value.span, what, zero_allowed));
  return is_good;
}

std::optional<double> parse_positive(const Node& node, const Dimension& expected, const std::string& what,
                                     bool zero_allowed, Diagnostics& diagnostics) {
  const ValueText value = parse_value(node, what, diagnostics);
  if (!require_positive(value, expected, what, zero_allowed, diagnostics)) return std::nullopt;
  return value.quantity.value;
}

bool complain_of_bare_numbers(const Node& list, const Dimension& expected, const std::string& what,
                              Diagnostics& diagnostics) {
  if (expected == dimension::none || list.items.size() < 2) return false;
  const auto is_bare = [](const Node& item) { return item.is_scalar() && count_bare_numbers(item) == 1; };
  if (!std::all_of(list.items.begin(), list.items.end(), is_bare)) return false;
  diagnostics.add(wording::needs_units(list.span, what, in_one_line(list, expected)));
  return true;
}

namespace {

/// `0 0 0.1`, `1 m, 2 m` and `{x: 1 m, y: 2 m}` as lists; empty: it is none of these.
std::string values_in_brackets(const Node& node, const Dimension& expected, std::size_t fewest,
                               std::size_t most) {
  Node list;
  list.kind = NodeKind::sequence;
  for (const Entry& entry : node.entries) list.items.push_back(entry.value);
  const char separator = node.text.find(',') == std::string::npos ? ' ' : ',';
  for (std::size_t at = 0; node.is_scalar() && at < node.text.size();) {
    const std::size_t end = std::min(node.text.find(separator, at), node.text.size());
    Node item;
    item.kind = NodeKind::scalar;
    item.text = trimmed(std::string_view(node.text).substr(at, end - at));
    if (!item.text.empty()) list.items.push_back(std::move(item));
    at = end + 1;
  }
  const auto is_quantity = [](const Node& item) {
    return item.is_scalar() && parse_quantity(trimmed(item.text)).error == QuantityError::none;
  };
  const bool is_list = list.items.size() >= fewest && list.items.size() <= most &&
                       std::all_of(list.items.begin(), list.items.end(), is_quantity);
  return is_list ? in_one_line(list, expected) : "";
}

}  // namespace

std::optional<std::vector<double>> parse_vector(const Node& node, const Dimension& expected,
                                                std::size_t fewest, std::size_t most, const std::string& what,
                                                Diagnostics& diagnostics) {
  if (node.is_bad) return std::nullopt;
  if (!node.is_sequence()) {
    const std::string list = values_in_brackets(node, expected, fewest, most);
    diagnostics.add(list.empty() ? wording::expected_vector(node.span, what, fewest, usual_unit(expected))
                                 : wording::vector_by_example(node.span, what, list));
    return std::nullopt;
  }
  const bool has_units = expected != dimension::none;
  if (has_units && complain_of_decimal_comma(node, fewest, most, diagnostics)) return std::nullopt;
  if (node.items.size() < fewest || node.items.size() > most) {
    diagnostics.add(wording::wrong_count(node.span, what, fewest, most, node.items.size()));
    return std::nullopt;
  }
  if (complain_of_bare_numbers(node, expected, what, diagnostics)) return std::nullopt;
  std::vector<double> values;
  bool is_good = true;
  for (const Node& item : node.items) {
    const std::optional<double> value = parse_plain(item, expected, what, diagnostics);
    is_good = is_good && value;
    values.push_back(value.value_or(0.0));
  }
  if (!is_good) return std::nullopt;
  return values;
}

bool complain_of_third_value(const Node& place, const std::string& what, const std::string& place_key,
                             const std::string& yaw_key, bool may_have_height, Diagnostics& diagnostics) {
  if (place.is_bad || !place.is_sequence() || place.items.size() != 3) return false;
  Node floor = place;
  floor.items.pop_back();
  const std::string written = in_one_line(floor, dimension::length);
  const std::string& text = place.items[2].text;
  const QuantityResult third = parse_quantity(trimmed(text));
  if (third.error != QuantityError::none) return false;
  const bool is_bare = !third.quantity.has_unit;
  // Nothing on a robot is so high as somebody turns in degrees.
  const bool is_heading =
      third.quantity.dimension == dimension::angle ||
      (is_bare && (!may_have_height || wording::with_unit(text, dimension::angle).ends_with("deg")));
  if (is_heading && !yaw_key.empty()) {
    std::string heading = yaw_key;
    heading += ": " + wording::with_unit(text, dimension::angle);
    diagnostics.add(wording::heading_in_a_place(place.span, what, place_key + ": " + written, heading));
    return true;
  }
  if (may_have_height || third.quantity.dimension == dimension::angle) return false;
  diagnostics.add(wording::height_in_a_place(place.span, what, written));
  return true;
}

std::optional<std::array<double, 2>> parse_place(const Node& node, const std::string& what,
                                                 const std::string& yaw_key, Diagnostics& diagnostics) {
  if (complain_of_third_value(node, what, "at", yaw_key, false, diagnostics)) return std::nullopt;
  const auto values = parse_vector(node, dimension::length, 2, 2, what, diagnostics);
  if (!values) return std::nullopt;
  return std::array{(*values)[0], (*values)[1]};
}

std::optional<std::vector<std::array<double, 2>>> parse_polygon(const Node& node, const std::string& what,
                                                                Diagnostics& diagnostics) {
  return parse_places(node, what + "'s `polygon`", "a corner of " + what, diagnostics);
}

std::optional<std::vector<std::array<double, 2>>> parse_places(const Node& node, const std::string& list,
                                                               const std::string& part,
                                                               Diagnostics& diagnostics) {
  if (!require_sequence(node, list, diagnostics)) return std::nullopt;
  const auto is_scalar = [](const Node& place) { return place.is_scalar(); };
  if (!node.items.empty() && std::all_of(node.items.begin(), node.items.end(), is_scalar)) {
    diagnostics.add(wording::place_for_a_list(node.span, list));
    return std::nullopt;
  }
  const auto lacks_units = [](const Node& place) { return count_bare_numbers(place) > 0; };
  if (std::count_if(node.items.begin(), node.items.end(), lacks_units) > 1) {
    diagnostics.add(wording::needs_units(node.span, list, in_one_line(node, dimension::length)));
    return std::nullopt;
  }
  std::vector<std::array<double, 2>> places;
  for (const Node& place : node.items) {
    const auto at = parse_vector(place, dimension::length, 2, 2, part, diagnostics);
    // An author who writes one place in another shape writes all so. One diagnostic is enough.
    if (!at && !place.is_sequence()) return std::nullopt;
    if (at) places.push_back({(*at)[0], (*at)[1]});
  }
  if (places.size() != node.items.size()) return std::nullopt;
  return places;
}

bool check_version(MapReader& map, const std::string& key, int newest, Diagnostics& diagnostics) {
  const Node* version = map.optional(key);
  if (version == nullptr) {
    for (const char* other :
         {"zwang", "zwang_robot", "zwang_scene", "zwang_scenario", "zwang_connection", "zwang_study"}) {
      const Node* given = map.optional(other);
      if (given == nullptr) continue;
      diagnostics.add(wording::another_kind_of_file(map.node().span, map.what(), other));
      return false;
    }
    diagnostics.add(wording::missing_version(map.node().span, map.what(), key));
    return false;
  }
  if (version->is_bad) return true;
  for (int known = 1; known <= newest; ++known) {
    if (version->is_scalar() && version->text == std::to_string(known)) return true;
  }
  diagnostics.add(wording::other_version(version->span, key, version->text, newest));
  return false;
}

}  // namespace zwang::lang
