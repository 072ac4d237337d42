/// The columns of a log from its schema, and records that are JSON, as logs of before 2026-11-26 have them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/runtime/log_reader.hpp"

namespace zwang::runtime {

/// From the JSON schema of the records; empty where it cannot be read.
std::vector<LoggedColumn> logged_columns(const std::string& schema);

/// Takes records apart whose keys stand in the order of the columns; those of blanks are left out.
class JsonRecord {
 public:
  explicit JsonRecord(const std::vector<LoggedColumn>& columns);

  /// One number a column, as a record of today has it. An infinity, which JSON has as null, is positive.
  void read(std::string_view record, std::vector<double>& values) const;

 private:
  double value_of(std::size_t column, std::string_view text, bool is_word) const;

  std::vector<std::string> keys_;  ///< as a record writes them: `"base.x":`
  std::vector<std::vector<std::string>> words_;
};

/// NaN where it is blank or no number.
double number_of(std::string_view part) noexcept;

}  // namespace zwang::runtime
