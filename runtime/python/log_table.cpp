#include "log_table.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

#include "zwang/lang/nearest.hpp"
#include "zwang/runtime/log_reader.hpp"

namespace zwang::python {

namespace {

class TableSink final : public runtime::LogSink {
 public:
  explicit TableSink(std::shared_ptr<LogTable> table) : table_(std::move(table)) {}
  std::string open(const std::vector<runtime::Column>&) override { return {}; }
  std::string write(std::span<const double> values) override {
    table_->add(values);
    return {};
  }
  std::string flush() override { return {}; }
  std::string close() override { return {}; }

 private:
  std::shared_ptr<LogTable> table_;
};

std::vector<runtime::Column> columns_of(const runtime::LogContents& log) {
  std::vector<runtime::Column> columns;
  for (const runtime::LoggedColumn& logged : log.columns) {
    runtime::Column column;
    column.name = logged.name;
    column.unit = logged.unit;
    column.words = logged.words;
    columns.push_back(std::move(column));
  }
  return columns;
}

}  // namespace

LogTable::LogTable(std::vector<runtime::Column> columns) : columns_(std::move(columns)) {
  for (std::size_t i = 0; i < columns_.size(); ++i) places_.emplace(columns_[i].name, i);
}

namespace {

std::set<std::string> words_of(const std::string& name) {
  std::set<std::string> words;
  std::istringstream text(name);
  for (std::string word; std::getline(text, word, '.');) words.insert(word);
  return words;
}

/// The names that may be meant: a close spelling, else the names that share the most words.
std::string like(const std::string& name, const std::vector<runtime::Column>& columns) {
  constexpr std::size_t most_told = 5;
  const std::set<std::string> wanted = words_of(name);
  std::vector<std::string> names, shared;
  std::size_t most = 1;
  for (const runtime::Column& column : columns) {
    names.push_back(column.name);
    const std::set<std::string> words = words_of(column.name);
    const auto common = static_cast<std::size_t>(std::count_if(
        words.begin(), words.end(), [&](const std::string& word) { return wanted.contains(word); }));
    if (common > most) shared.clear();
    most = std::max(most, common);
    if (common == most && shared.size() < most_told) shared.push_back(column.name);
  }
  if (const std::string near = lang::nearest(name, names); !near.empty()) shared = {near};
  std::string text;
  for (const std::string& one : shared) text += (text.empty() ? "; there is `" : "`, `") + one;
  return text.empty() ? "; `columns` lists them" : text + "`";
}

}  // namespace

std::size_t LogTable::column(const std::string& name) const {
  const auto found = places_.find(name);
  if (found == places_.end())
    throw std::out_of_range("the log has no column `" + name + "`" + like(name, columns_));
  return found->second;
}

std::unique_ptr<runtime::LogSink> table_sink(std::shared_ptr<LogTable> table) {
  return std::make_unique<TableSink>(std::move(table));
}

std::shared_ptr<LogTable> read_table(const std::filesystem::path& path) {
  std::shared_ptr<LogTable> table;
  runtime::read_log(
      path, [&](double, std::span<const double> values) { table->add(values); },
      [&](const runtime::LogContents& head) { table = std::make_shared<LogTable>(columns_of(head)); });
  return table != nullptr ? table : std::make_shared<LogTable>(std::vector<runtime::Column>{});
}

}  // namespace zwang::python
