#include <algorithm>
#include <set>

#include "diagnostic/ways_out.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/in_one_line.hpp"
#include "spec/shape.hpp"
#include "spec/task_file.hpp"
#include "words/nearest.hpp"
#include "words/text.hpp"

namespace zwang::lang {

MapReader::MapReader(const Node& node, std::string what, Diagnostics& diagnostics, const std::string& example)
    : node_(node), what_(std::move(what)), diagnostics_(diagnostics) {
  require_mapping(node, what_, diagnostics, example);
}

const Node* MapReader::optional(std::string_view key) {
  // A key that is read twice stands once in the list of the known ones.
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  if (!is_mapping()) return nullptr;
  const Entry* entry = node_.find(key);
  return entry == nullptr || entry->key.is_bad ? nullptr : &entry->value;
}

const Node* MapReader::required(std::string_view key, const std::string& value) {
  const Node* node = optional(key);
  if (node == nullptr) {
    missing_.emplace_back(key);
    proposals_.emplace(key, value);
  }
  return node;
}

bool MapReader::report_split_condition() {
  if (!is_mapping() || !node_.is_flow) return false;
  for (const Entry& entry : node_.entries) {
    const bool is_known = std::find(known_.begin(), known_.end(), entry.key.text) != known_.end();
    const bool is_fragment = entry.value.kind == NodeKind::null && !entry.key.is_bad && !is_known &&
                             text_cut_before(entry).empty();
    if (is_fragment && !split_reported_ && missing_.empty() && !report_decimal_comma_before(entry))
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

/// `{when: reach < 0,5 m, ..}`, where the entry is `5 m`. Whether it was so.
bool MapReader::report_decimal_comma_before(const Entry& entry) {
  if (&entry == &node_.entries.front()) return false;
  const Node& before = (&entry - 1)->value;
  const std::string whole = before.text.substr(before.text.find_last_of(' ') + 1);
  const std::string number = joined_at_decimal_comma(whole, entry.key.text);
  if (number.empty()) return false;
  Span span{node_.span.source, before.span.end, entry.key.span.end};
  span.begin.column -= static_cast<int>(whole.size());
  diagnostics_.add(wording::decimal_comma(span, number));
  return true;
}

bool MapReader::has_misspelt(const std::vector<std::string>& keys) const {
  return std::any_of(node_.entries.begin(), node_.entries.end(), [&](const Entry& entry) {
    return is_unknown(entry) && !meant_key(entry.key.text, keys).empty();
  });
}

bool MapReader::is_unknown(const Entry& entry) const {
  return !entry.key.is_bad && std::find(known_.begin(), known_.end(), entry.key.text) == known_.end();
}

bool MapReader::has_unread_keys() const {
  return std::any_of(node_.entries.begin(), node_.entries.end(), [this](const Entry& entry) {
    return entry.key.is_bad || std::find(known_.begin(), known_.end(), entry.key.text) == known_.end();
  });
}

void MapReader::finish() {
  if (!is_mapping()) return;
  if (!others_allowed_) report_unknown_keys();
  for (const std::string& key : missing_)
    diagnostics_.add(wording::missing_key(node_.span, what_, key, proposals_[key]));
}

void MapReader::report_unknown_keys() {
  std::vector<std::string> absent;
  for (const std::string& key : known_) {
    if (node_.find(key) == nullptr) absent.push_back(key);
  }
  std::vector<const Node*> puzzling;
  // Several keys may have one way out, which is told with the first of them.
  std::set<std::string> told;
  const auto is_new = [&](const std::string& remedy) { return told.insert(remedy).second; };
  const auto is_told = [&](const std::string& meant) {
    return std::any_of(told.begin(), told.end(), [&](const std::string& remedy) {
      return remedy.find("`" + meant + "`") != std::string::npos;
    });
  };
  std::vector<const Entry*> others;
  for (const Entry& entry : node_.entries) {
    if (!is_unknown(entry) || (split_reported_ && entry.value.kind == NodeKind::null)) continue;
    if (const std::string text = text_cut_before(entry); !text.empty()) {
      if (is_new(text)) diagnostics_.add(wording::split_text(entry.key.span, text));
      continue;
    }
    const std::string& key = entry.key.text;
    const std::string begin = key.substr(0, key.find_first_of(": "));
    if (begin != key && std::find(known_.begin(), known_.end(), begin) != known_.end()) {
      diagnostics_.add(wording::no_colon_or_space(entry.key.span, key, begin));
      std::erase(missing_, begin);
    } else if (const std::string remedy = remedy_of(entry); !remedy.empty()) {
      if (is_new(remedy)) diagnostics_.add(wording::said_otherwise(entry.key.span, key, what_, remedy));
      missing_.clear();
    } else {
      others.push_back(&entry);
    }
  }
  for (const Entry* entry : others) {
    const std::string& key = entry->key.text;
    const std::string meant = meant_key(key, absent);
    if (meant.empty()) puzzling.push_back(&entry->key);
    if (meant.empty() || is_told(meant)) continue;
    // The misspelt key was the missing one: one cause, one message.
    std::erase(missing_, meant);
    const std::string whole = whole_of_parts(meant);
    if (whole.empty()) {
      diagnostics_.add(wording::unknown_key(entry->key.span, key, what_, meant, known_, {}));
    } else if (is_new(whole)) {
      diagnostics_.add(wording::said_otherwise(entry->key.span, key, what_, "write " + in_ticks(whole)));
    }
  }
  for (const Node* key : puzzling) {
    diagnostics_.add(wording::unknown_key(key->span, key->text, what_, "", known_, missing_));
    // Perhaps it was one of these.
    missing_.clear();
  }
}

/// `{note: one thing, or another}`, where the entry is `or another`: the key of the text; else empty.
std::string MapReader::text_cut_before(const Entry& entry) const {
  const Entry* text = &entry;
  while (node_.is_flow && text != &node_.entries.front() && text->value.kind == NodeKind::null) --text;
  const std::string& key = text->key.text;
  const bool is_text = key == "note" || key == "about" || key == "help";
  return is_text && text != &entry ? key : "";
}

std::string MapReader::remedy_of(const Entry& entry) const {
  const auto knows = [this](std::string_view key) {
    return std::find(known_.begin(), known_.end(), key) != known_.end();
  };
  const Node& value = entry.value;
  if (knows("constraints") && (value.find("move") != nullptr || value.find("feature") != nullptr))
    return "a group stands in `constraints`: indent it below that";
  if (const std::string way = way_out(what_, entry.key.text); !way.empty()) return way;
  if (knows("rz") && is_axis_in_one_word(entry)) return axes_in_one_word();
  return knows("time_constant") ? range_of_bound(entry) : "";
}

bool MapReader::is_axis_in_one_word(const Entry& entry) const {
  return is_unknown(entry) && !entry.value.is_bad && !entry.value.is_mapping() &&
         entry.value.kind != NodeKind::null && axis_in_one_word(entry.key.text).has_value();
}

/// All that are like `vx: 0.1 m/s`, as `x: {velocity: 0.1 m/s}`.
std::string MapReader::axes_in_one_word() const {
  std::string written;
  for (const Entry& entry : node_.entries) {
    if (!is_axis_in_one_word(entry)) continue;
    const AxisInOneWord word = *axis_in_one_word(entry.key.text);
    written += (written.empty() ? "write " : ", ") +
               in_ticks(word.axis + ": {" + word_of(word.quantity) + ": " +
                        in_one_line(entry.value, dimension_of(*axis_named(word.axis), word.quantity)) + "}");
  }
  return written;
}

/// `max_velocity: 0.2 m/s` and `velocity_limit: 0.2 m/s` as a range.
std::string MapReader::range_of_bound(const Entry& entry) const {
  std::string_view key = entry.key.text;
  const bool is_low = key.starts_with("min_") || key.ends_with("_min");
  for (const std::string_view affix : {"max_", "min_", "_max", "_min", "_limit"}) {
    if (affix.ends_with('_') && key.starts_with(affix)) key.remove_prefix(affix.size());
    if (affix.starts_with('_') && key.ends_with(affix)) key.remove_suffix(affix.size());
  }
  if (key == entry.key.text || !entry.value.is_scalar()) return {};
  const std::string meant = meant_key(key, {"position", "velocity", "acceleration", "force"});
  const std::string quantity = meant.empty() && std::find(known_.begin(), known_.end(), key) != known_.end()
                                   ? std::string(key)
                                   : meant;
  if (quantity.empty()) return {};
  const std::string value = trimmed(entry.value.text);
  std::string range = "+-" + value;
  if (is_low) range = "[" + value + ", ..]";
  if (what_.ends_with(".speed`")) range = "[0 m/s, " + value + "]";
  return "a bound is a range: write " + in_ticks(quantity + ": " + range);
}

/// `x: 1 m` and `y: 2 m` are `at: [1 m, 2 m]`, `min` and `max` a range. Empty: no parts of one thing.
std::string MapReader::whole_of_parts(const std::string& meant) const {
  if (meant != "at" && meant != "range") return {};
  std::vector<std::string> parts;
  for (const std::string_view part : {"x", "y", "z", "min", "lower", "max", "upper"}) {
    const Entry* entry = node_.find(part);
    if (entry != nullptr && entry->value.is_scalar() && meant_key(part, {meant}) == meant)
      parts.push_back(trimmed(entry->value.text));
  }
  if (parts.size() < 2) return {};
  std::string whole = meant + ": [";
  for (std::size_t i = 0; i < parts.size(); ++i) whole += (i == 0 ? "" : ", ") + parts[i];
  return whole + "]";
}

}  // namespace zwang::lang
