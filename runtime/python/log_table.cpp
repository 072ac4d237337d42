#include "log_table.hpp"

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
  runtime::read_log(
      path, [&](double, std::span<const double> values) { table->add(values); },
      [&](const runtime::LogContents& head) { table = std::make_shared<LogTable>(columns_of(head)); });
  return table != nullptr ? table : std::make_shared<LogTable>(std::vector<runtime::Column>{});
}

}  // namespace zwang::python
