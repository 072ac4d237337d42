/// Where two runs part: their records, column by column, and what happened in them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/runtime/log_reader.hpp"

namespace zwang::runtime {

/// A column that both logs have, and that differs in at least one pair of records.
struct ColumnDifference {
  std::string name, unit;
  bool is_input = false;          ///< came from outside: sensed, or a parameter that was set
  double time = 0.0;              ///< [s] since the runs began, of the first pair that differs
  std::string first, second;      ///< the values of that pair, with every digit of the logs; empty: blank
  std::uint64_t records = 0;      ///< pairs that differ
  std::optional<double> largest;  ///< difference of two numbers, its size; none: words, or one side is blank
  double largest_time = 0.0;      ///< [s] since the runs began
};

struct LogDifference {
  std::uint64_t compared = 0;  ///< pairs of records
  double until = 0.0;          ///< [s] since the runs began, of the last pair
  /// The one that differs first comes first. Within a record: inputs, then the order of the first log.
  std::vector<ColumnDifference> columns;
  std::vector<std::string> only_first, only_second;  ///< columns of one log alone
  LogContents first, second;                         ///< as `read_log` gives them
};

/// Records are pairs if their times since the runs began are the same to a quarter of the shorter period. So
/// logs of unlike rates are compared at the instants that both have. Numbers are compared bit by bit; zeros
/// of either sign are alike. Clocks count from the start of their run. Throws as `read_log`.
ZWANG_EXPORT LogDifference difference(const std::filesystem::path& first,
                                      const std::filesystem::path& second);

/// A transition or an event.
struct Happening {
  double time = 0.0;  ///< [s] since the run began
  std::string what;
};

/// The number of the first pair that is not the same thing at the same time, to `tolerance` [s]. If one list
/// is longer, that is the length of the shorter one. None: the lists are alike.
ZWANG_EXPORT std::optional<std::size_t> first_difference(const std::vector<Happening>& first,
                                                         const std::vector<Happening>& second,
                                                         double tolerance);

/// [s] as the facts of the log tell it; 1 ms where they do not.
ZWANG_EXPORT double period_of(const LogContext& context);

}  // namespace zwang::runtime
