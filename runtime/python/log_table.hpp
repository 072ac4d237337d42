/// A log in memory: one number a column and tick.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "zwang/runtime/recorder.hpp"

namespace zwang::python {

/// Row after row. Blanks are NaN; a column of words holds their indices.
class LogTable {
 public:
  explicit LogTable(std::vector<runtime::Column> columns);

  const std::vector<runtime::Column>& columns() const { return columns_; }
  /// Its place; throws std::out_of_range for a name that no column has.
  std::size_t column(const std::string& name) const;
  std::size_t size() const { return columns_.empty() ? 0 : values_.size() / columns_.size(); }
  const double* data() const { return values_.data(); }
  void add(std::span<const double> row) { values_.insert(values_.end(), row.begin(), row.end()); }

 private:
  std::vector<runtime::Column> columns_;
  std::unordered_map<std::string, std::size_t> places_;
  std::vector<double> values_;
};

/// For a Recorder: writes into `table`, which has the recorder's columns.
std::unique_ptr<runtime::LogSink> table_sink(std::shared_ptr<LogTable> table);

/// Of an MCAP log of zwang, as far as it can be read. Throws std::runtime_error as runtime::read_log does.
std::shared_ptr<LogTable> read_table(const std::filesystem::path& path);

}  // namespace zwang::python
