#include "spec/shape.hpp"

#include <algorithm>
#include <charconv>

#include "diagnostic/nearest.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/decimal_comma.hpp"
#include "tree/text.hpp"

namespace zwang::lang {

MapReader::MapReader(const Node& node, std::string what, Diagnostics& diagnostics)
    : node_(node), what_(std::move(what)), diagnostics_(diagnostics) {
  require_mapping(node, what_, diagnostics);
}

const Node* MapReader::optional(std::string_view key) {
  known_.emplace_back(key);
  if (!is_mapping()) return nullptr;
  const Entry* entry = node_.find(key);
  return entry == nullptr || entry->key.is_bad ? nullptr : &entry->value;
}

const Node* MapReader::required(std::string_view key) {
  const Node* value = optional(key);
  if (value == nullptr) missing_.emplace_back(key);
  return value;
}

bool MapReader::report_split_condition() {
  if (!is_mapping() || !node_.is_flow) return false;
  for (const Entry& entry : node_.entries) {
    const bool is_known = std::find(known_.begin(), known_.end(), entry.key.text) != known_.end();
    const bool is_fragment = entry.value.kind == NodeKind::null && !entry.key.is_bad && !is_known;
    if (is_fragment && !split_reported_ && missing_.empty())
      diagnostics_.add(wording::split_condition(entry.key.span));
    // The condition is whole, and lacks its key.
    if (is_fragment && !split_reported_ && !missing_.empty()) {
      diagnostics_.add(wording::condition_without_key(entry.key.span, what_, missing_[0], entry.key.text));
      missing_.erase(missing_.begin());
    }
    split_reported_ = split_reported_ || is_fragment;
  }
  return split_reported_;
}

bool MapReader::has_misspelt(const std::vector<std::string>& keys) const {
  for (const Entry& entry : node_.entries) {
    const bool is_known = std::find(known_.begin(), known_.end(), entry.key.text) != known_.end();
    if (!is_known && !meant_key(entry.key.text, keys).empty()) return true;
  }
  return false;
}

bool MapReader::has_unread_keys() const {
  return std::any_of(node_.entries.begin(), node_.entries.end(), [this](const Entry& entry) {
    return entry.key.is_bad || std::find(known_.begin(), known_.end(), entry.key.text) == known_.end();
  });
}

void MapReader::finish() {
  if (!is_mapping()) return;
  if (!others_allowed_) {
    std::vector<std::string> absent;
    for (const std::string& key : known_) {
      if (node_.find(key) == nullptr) absent.push_back(key);
    }
    std::vector<const Node*> puzzling;
    for (const Entry& entry : node_.entries) {
      if (entry.key.is_bad || std::find(known_.begin(), known_.end(), entry.key.text) != known_.end()) {
        continue;
      }
      if (split_reported_ && entry.value.kind == NodeKind::null) continue;
      const std::string begin = entry.key.text.substr(0, entry.key.text.find_first_of(": "));
      if (begin != entry.key.text && std::find(known_.begin(), known_.end(), begin) != known_.end()) {
        diagnostics_.add(wording::no_colon_or_space(entry.key.span, entry.key.text, begin));
        std::erase(missing_, begin);
        continue;
      }
      const std::string meant = meant_key(entry.key.text, absent);
      if (meant.empty()) {
        puzzling.push_back(&entry.key);
        continue;
      }
      diagnostics_.add(wording::unknown_key(entry.key.span, entry.key.text, what_, meant, known_, {}));
      // The misspelt key was the missing one: one cause, one message.
      std::erase(missing_, meant);
    }
    for (const Node* key : puzzling) {
      diagnostics_.add(wording::unknown_key(key->span, key->text, what_, "", known_, missing_));
      // Perhaps it was one of these.
      missing_.clear();
    }
  }
  for (const std::string& key : missing_) diagnostics_.add(wording::missing_key(node_.span, what_, key));
}

Word parse_word(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  if (node.is_bad) return {};
  if (!node.is_scalar() || trimmed(node.text).empty()) {
    diagnostics.add(wording::expected_word(node.span, what));
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

std::optional<int> parse_integer(const Node& node, const std::string& what, int low, int high,
                                 Diagnostics& diagnostics) {
  if (node.is_bad) return std::nullopt;
  int value = 0;
  const std::string text = node.is_scalar() ? trimmed(node.text) : std::string();
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = !text.empty() && error == std::errc{} && end == text.data() + text.size();
  if (!is_whole || value < low || value > high) {
    diagnostics.add(wording::expected_integer(node.span, what, low, high));
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

bool require_sequence(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  if (node.is_bad) return false;
  if (!node.is_sequence()) diagnostics.add(wording::expected_list(node.span, what));
  return node.is_sequence();
}

bool require_mapping(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  if (node.is_bad) return false;
  if (!node.is_mapping())
    diagnostics.add(wording::expected_mapping(node.span, what, node.is_sequence() && !node.is_flow));
  return node.is_mapping();
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
  std::vector<std::string> numbers;
  for (const Node& item : list.items) {
    if (item.is_bad || !item.is_scalar()) return false;
    const QuantityResult result = parse_quantity(trimmed(item.text));
    if (result.error != QuantityError::none || result.quantity.has_unit) return false;
    numbers.push_back(result.quantity.number);
  }
  diagnostics.add(wording::needs_units(list.span, what, numbers, expected));
  return true;
}

std::optional<std::vector<double>> parse_vector(const Node& node, const Dimension& expected,
                                                std::size_t fewest, std::size_t most, const std::string& what,
                                                Diagnostics& diagnostics) {
  if (node.is_bad) return std::nullopt;
  if (!node.is_sequence()) {
    diagnostics.add(wording::expected_vector(node.span, what, fewest, usual_unit(expected)));
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

bool check_version(MapReader& map, const std::string& key, Diagnostics& diagnostics) {
  const Node* version = map.optional(key);
  if (version == nullptr) {
    for (const char* other : {"zwang", "zwang_robot", "zwang_scene", "zwang_scenario"}) {
      const Node* given = map.optional(other);
      if (given == nullptr) continue;
      diagnostics.add(wording::another_kind_of_file(map.node().span, map.what(), other));
      return false;
    }
    diagnostics.add(wording::missing_version(map.node().span, map.what(), key));
    return false;
  }
  if (version->is_bad) return true;
  if (version->is_scalar() && version->text == "1") return true;
  diagnostics.add(wording::other_version(version->span, key, version->text));
  return false;
}

}  // namespace zwang::lang
