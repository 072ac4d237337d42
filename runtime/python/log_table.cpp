#include "log_table.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

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

/// The properties of the schema, in their order.
std::vector<runtime::Column> columns_of(const std::string& schema) {
  const auto parsed = nlohmann::ordered_json::parse(schema, nullptr, false);
  std::vector<runtime::Column> columns;
  if (!parsed.is_object() || !parsed.contains("properties")) return columns;
  for (const auto& [name, property] : parsed["properties"].items()) {
    runtime::Column column;
    column.name = name;
    if (property.contains("enum"))
      for (const auto& word : property["enum"])
        if (word.is_string()) column.words.push_back(word.get<std::string>());
    columns.push_back(std::move(column));
  }
  return columns;
}

double number_of(const nlohmann::json& value, const std::vector<std::string>& words) {
  if (value.is_number()) return value.get<double>();
  if (!value.is_string()) return std::numeric_limits<double>::quiet_NaN();
  const auto at = std::find(words.begin(), words.end(), value.get_ref<const std::string&>());
  return at == words.end() ? std::numeric_limits<double>::quiet_NaN()
                           : static_cast<double>(at - words.begin());
}

}  // namespace

LogTable::LogTable(std::vector<runtime::Column> columns) : columns_(std::move(columns)) {
  for (std::size_t i = 0; i < columns_.size(); ++i) places_.emplace(columns_[i].name, i);
}

std::size_t LogTable::column(const std::string& name) const {
  const auto found = places_.find(name);
  if (found == places_.end()) throw std::out_of_range("the log has no column `" + name + "`");
  return found->second;
}

std::unique_ptr<runtime::LogSink> table_sink(std::shared_ptr<LogTable> table) {
  return std::make_unique<TableSink>(std::move(table));
}

std::shared_ptr<LogTable> read_table(const std::filesystem::path& path) {
  std::shared_ptr<LogTable> table;
  std::vector<double> row;
  const auto begin = [&](const runtime::LogContents& head) {
    table = std::make_shared<LogTable>(columns_of(head.schema));
  };
  const auto add = [&](double, std::string_view text) {
    const auto record = nlohmann::json::parse(text, nullptr, false);
    if (table == nullptr || !record.is_object()) return;
    row.assign(table->columns().size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto value = record.find(table->columns()[i].name);
      if (value != record.end()) row[i] = number_of(*value, table->columns()[i].words);
    }
    table->add(row);
  };
  runtime::read_log(path, add, begin);
  return table != nullptr ? table : std::make_shared<LogTable>(std::vector<runtime::Column>{});
}

}  // namespace zwang::python
