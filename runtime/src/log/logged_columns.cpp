#include "log/logged_columns.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

namespace zwang::runtime {

namespace {

using nlohmann::ordered_json;

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

std::vector<LoggedColumn> logged_columns(const std::string& schema) {
  std::vector<LoggedColumn> columns;
  const ordered_json whole = ordered_json::parse(schema, nullptr, false);
  const auto properties = whole.is_object() ? whole.find("properties") : whole.end();
  if (properties == whole.end() || !properties->is_object()) return columns;
  for (const auto& [name, property] : properties->items()) {
    LoggedColumn& column = columns.emplace_back();
    column.name = name;
    column.has_words = property.contains("enum");
    const auto description = property.find("description");
    if (description != property.end() && description->is_string())
      read_description(description->get<std::string>(), column);
  }
  return columns;
}

RecordParts::RecordParts(const std::vector<LoggedColumn>& columns) : parts_(columns.size()) {
  for (const LoggedColumn& column : columns)
    keys_.push_back(ordered_json(column.name).dump(-1, ' ', false, ordered_json::error_handler_t::replace) +
                    ":");
}

void RecordParts::split(std::string_view record) {
  std::ranges::fill(parts_, std::string_view{});
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
    // A loop of its own: it is most of the time that a long log takes to read.
    if (is_word) {
      while (at < end && *at != '"') ++at;
    } else {
      while (at < end && *at != ',' && *at != '}') ++at;
    }
    parts_[i] = {begin, static_cast<std::size_t>(at - begin)};
    at += std::min<std::ptrdiff_t>(is_word ? 2 : 1, end - at);
  }
}

double number_of(std::string_view part) noexcept {
  double value = std::numeric_limits<double>::quiet_NaN();
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  return error == std::errc() ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace zwang::runtime
