#include "log/tick_json.hpp"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "log/longest_number.hpp"

namespace zwang::runtime {

namespace {

std::string json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string description(const Column& column, const std::vector<lang::Source>& sources) {
  std::string text;
  if (!column.unit.empty()) text.append("[").append(column.unit).append("]");
  if (column.span.exists() && static_cast<std::size_t>(column.span.source) < sources.size()) {
    if (!text.empty()) text += ' ';
    text += sources[static_cast<std::size_t>(column.span.source)].path;
    text.append(":").append(std::to_string(column.span.begin.line));
  }
  return text;
}

std::string property(const Column& column, const std::vector<lang::Source>& sources) {
  std::string text = json_string(column.name);
  if (column.words.empty()) {
    text += R"(:{"type":"number")";
  } else {
    text += R"(:{"type":"string","enum":[)";
    for (std::size_t i = 0; i < column.words.size(); ++i) {
      if (i > 0) text += ',';
      text += json_string(column.words[i]);
    }
    text += ']';
  }
  const std::string words = description(column, sources);
  if (!words.empty()) text.append(R"(,"description":)").append(json_string(words));
  text += '}';
  return text;
}

}  // namespace

std::string tick_schema(const std::vector<Column>& columns, const std::vector<lang::Source>& sources) {
  std::string text = R"({"type":"object","title":"zwang.Tick","properties":{)";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) text += ',';
    text += property(columns[i], sources);
  }
  text += "}}";
  return text;
}

TickJson::TickJson(const std::vector<Column>& columns) {
  for (const Column& column : columns) {
    keys_.push_back(json_string(column.name));
    keys_.back() += ':';
    words_.emplace_back();
    for (const std::string& word : column.words) words_.back().push_back(json_string(word));
  }
}

const std::string& TickJson::of(std::span<const double> values) {
  line_.assign(1, '{');
  for (std::size_t i = 0; i < keys_.size() && i < values.size(); ++i) {
    const double value = values[i];
    if (!std::isfinite(value)) continue;  // JSON has no word for it
    if (line_.size() > 1) line_ += ',';
    line_ += keys_[i];
    if (!words_[i].empty()) {
      const auto word = static_cast<std::size_t>(value);
      line_ += value >= 0.0 && word < words_[i].size() ? words_[i][word] : "\"\"";
    } else if (value == 0.0 && std::signbit(value)) {
      line_ += "-0.0";  // readers take -0 for the whole number 0
    } else {
      char digits[longest_number];
      line_.append(digits, std::to_chars(digits, digits + longest_number, value).ptr);
    }
  }
  line_ += '}';
  return line_;
}

}  // namespace zwang::runtime
