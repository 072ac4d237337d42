/// A record as a JSON object, and the JSON schema of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

/// One object schema; a column's unit and the place in the text that it comes from are its description.
std::string tick_schema(const std::vector<Column>& columns, const std::vector<lang::Source>& sources);

class TickJson {
 public:
  explicit TickJson(const std::vector<Column>& columns);
  /// The record without its blanks; numbers with as many digits as bring them back bit by bit, infinities as
  /// null. Valid until the next call.
  const std::string& of(std::span<const double> values);

 private:
  std::vector<std::string> keys_;                // escaped, with quotes and colon
  std::vector<std::vector<std::string>> words_;  // escaped, with quotes
  std::string line_;
};

}  // namespace zwang::runtime
