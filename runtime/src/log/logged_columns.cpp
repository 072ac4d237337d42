#include "log/logged_columns.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "log/blank.hpp"

namespace zwang::runtime {

namespace {

using nlohmann::ordered_json;

std::string json_text(const std::string& text) {
  return ordered_json(text).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string unquoted(const std::string& text) {
  return text.substr(1, text.size() - 2);
}

std::vector<std::string> words_in(const ordered_json& list) {
  std::vector<std::string> words;
  if (!list.is_array()) return words;
  for (const ordered_json& word : list) words.push_back(word.is_string() ? word.get<std::string>() : "");
  return words;
}

/// `[m/s] wall_align.yaml:22`, either part alone, or none.
void read_description(const std::string& text, LoggedColumn& column) {
  std::string_view rest = text;
  if (rest.starts_with('[')) {
    const std::size_t close = rest.find(']');
    column.unit = rest.substr(1, close - 1);
    rest.remove_prefix(std::min(rest.size(), close == std::string_view::npos ? rest.size() : close + 2));
  }
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string_view::npos) return;
  column.file = rest.substr(0, colon);
  std::from_chars(rest.data() + colon + 1, rest.data() + rest.size(), column.line);
}

}  // namespace

bool LoggedColumn::is_input() const {
  return name.starts_with("sensed.") || name.starts_with("params.");
}

std::string_view LoggedColumn::word(double value) const noexcept {
  const bool is_one = value >= 0.0 && value < static_cast<double>(words.size());
  return is_one ? std::string_view(words[static_cast<std::size_t>(value)]) : std::string_view{};
}

std::string LoggedColumn::text(double value) const {
  if (std::isnan(value)) return "";
  if (!words.empty()) return std::string(word(value));
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::size_t place_of(const std::vector<LoggedColumn>& columns, std::string_view name) noexcept {
  const auto found =
      std::ranges::find_if(columns, [&](const LoggedColumn& column) { return column.name == name; });
  return static_cast<std::size_t>(found - columns.begin());
}

std::vector<LoggedColumn> logged_columns(const std::string& schema) {
  std::vector<LoggedColumn> columns;
  const ordered_json whole = ordered_json::parse(schema, nullptr, false);
  const auto properties = whole.is_object() ? whole.find("properties") : whole.end();
  if (properties == whole.end() || !properties->is_object()) return columns;
  for (const auto& [name, property] : properties->items()) {
    LoggedColumn& column = columns.emplace_back();
    column.name = name;
    if (const auto words = property.find("enum"); words != property.end()) column.words = words_in(*words);
    const auto description = property.find("description");
    if (description != property.end() && description->is_string())
      read_description(description->get<std::string>(), column);
  }
  return columns;
}

JsonRecord::JsonRecord(const std::vector<LoggedColumn>& columns) {
  for (const LoggedColumn& column : columns) {
    keys_.push_back(json_text(column.name) + ":");
    words_.emplace_back();
    for (const std::string& word : column.words) words_.back().push_back(unquoted(json_text(word)));
  }
}

double JsonRecord::value_of(std::size_t column, std::string_view text, bool is_word) const {
  if (is_word) {
    const std::vector<std::string>& words = words_[column];
    const auto found = std::ranges::find(words, text);
    return found == words.end() ? log_column::blank : static_cast<double>(found - words.begin());
  }
  return text == "null" ? std::numeric_limits<double>::infinity() : number_of(text);
}

void JsonRecord::read(std::string_view record, std::vector<double>& values) const {
  values.assign(keys_.size(), log_column::blank);
  const char* at = record.data() + std::min<std::size_t>(1, record.size());
  const char* const end = record.data() + record.size();
  for (std::size_t i = 0; i < keys_.size() && at < end; ++i) {
    const std::string& key = keys_[i];
    if (static_cast<std::size_t>(end - at) < key.size() || std::memcmp(at, key.data(), key.size()) != 0)
      continue;
    at += key.size();
    const bool is_word = at < end && *at == '"';
    const char* const begin = is_word ? at + 1 : at;
    at = begin;
    if (is_word) {
      while (at < end && *at != '"') ++at;
    } else {
      while (at < end && *at != ',' && *at != '}') ++at;
    }
    values[i] = value_of(i, {begin, static_cast<std::size_t>(at - begin)}, is_word);
    at += std::min<std::ptrdiff_t>(is_word ? 2 : 1, end - at);
  }
}

double number_of(std::string_view part) noexcept {
  double value = std::numeric_limits<double>::quiet_NaN();
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  return error == std::errc() ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace zwang::runtime
