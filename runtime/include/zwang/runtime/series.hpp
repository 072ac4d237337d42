/// A log as curves: few points a column, and every extreme among them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/runtime/log_reader.hpp"

namespace zwang::runtime {

/// A column of numbers.
struct Curve {
  std::string name;
  std::string unit;
  std::string file;  ///< whose line it comes from, as the log names it; empty: none
  int line = 0;
  /// Of each point, NaN where the column is blank. Two points of a bucket are its least and its largest
  /// value, in the order in which they came.
  std::vector<float> points;
  std::vector<float> samples;  ///< of each bucket its first record, blank or not
};

/// While a column of words keeps its word.
struct Stretch {
  std::string word;
  double begin = 0.0;  ///< [s] of its first record
  double end = 0.0;    ///< [s] of the first record behind it, or of the last one of the log
};

/// An event as the log has it; `value` in SI.
struct LoggedEvent {
  double time = 0.0;  ///< [s]
  std::string code, signal;
  double value = 0.0;
};

/// Records are gathered in buckets of equally many. While a bucket is one record, a point is one record, too.
struct Series {
  LogContents log;
  std::vector<Curve> curves;
  std::vector<double> times;         ///< [s] of the points: of a bucket its begin and its middle
  std::vector<double> sample_times;  ///< [s] of the samples
  std::size_t records_a_bucket = 1;
  std::vector<Stretch> tasks;
  std::vector<LoggedEvent> events;
};

/// The curves have `most_points` together, or little more where there are very many columns. Columns of
/// words, and inputs, are no curves. Throws as `read_log`.
ZWANG_EXPORT Series read_series(const std::filesystem::path& log, std::size_t most_points);

/// As 32-bit floats of this machine's byte order, the first bytes of all numbers before their second ones and
/// so on, in the zlib format. Smooth curves get small by it.
ZWANG_EXPORT std::string packed(const std::vector<float>& numbers);

}  // namespace zwang::runtime
