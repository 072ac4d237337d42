/// The columns of a log, and a record taken apart into them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace zwang::runtime {

struct LoggedColumn {
  std::string name;
  std::string unit;
  std::string file;  ///< whose line it comes from, as the log names it; empty: none
  int line = 0;
  bool has_words = false;
};

/// From the JSON schema of the records; empty where it cannot be read.
std::vector<LoggedColumn> logged_columns(const std::string& schema);

/// The texts of a record by column. Keys stand in the order of the columns; those of blanks are left out.
class RecordParts {
 public:
  explicit RecordParts(const std::vector<LoggedColumn>& columns);

  /// `record` must outlive the parts.
  void split(std::string_view record);
  /// A number as it is written, a word without its quotes; empty where the column is blank.
  std::string_view operator[](std::size_t column) const { return parts_[column]; }

 private:
  std::vector<std::string> keys_;  ///< as a record writes them: `"base.x":`
  std::vector<std::string_view> parts_;
};

/// NaN where it is blank or no number.
double number_of(std::string_view part) noexcept;

}  // namespace zwang::runtime
