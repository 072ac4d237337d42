/// The log: one record a tick, written by a thread of its own. Nothing that happens to the disk reaches the
/// control loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/source.hpp"

namespace zwang::runtime {

/// One number of a record.
struct Column {
  std::string name;
  std::string unit;                ///< empty for pure numbers and words
  std::vector<std::string> words;  ///< when not empty, the value is an index into it
  lang::Span span = {};            ///< the words of the author that it comes from
  bool is_input = false;           ///< for a replay only: left out of the CSV
};

/// The context of a log beside its records: enough to run the same thing again.
struct LogContext {
  std::vector<lang::Source> sources;         ///< every file that was read; a column's span counts them
  std::map<std::string, std::string> facts;  ///< "seed": "0", "version": ...
};

/// A form of the log. All calls come from one thread, never from the control loop. Each returns what went
/// wrong, or nothing; after the first complaint only `close` is called.
class ZWANG_EXPORT LogSink {
 public:
  virtual ~LogSink() = default;
  virtual std::string open(const std::vector<Column>& columns) = 0;  ///< once, by Recorder's constructor
  virtual std::string write(std::span<const double> values) = 0;     ///< one value a column; NaN: blank
  /// Before the next record, or the end, so many were dropped.
  virtual std::string skip(std::uint64_t records);
  /// The facts that are known only when the run is over. Called once, after the last record.
  virtual std::string conclude(const std::map<std::string, std::string>& facts);
  virtual std::string flush() = 0;  ///< now and then, when there is nothing to write
  virtual std::string close() = 0;
  virtual std::uint64_t size() const { return 0; }  ///< [bytes] handed to the disk so far; 0: not known
};

/// A line a record, `name [unit]` in the header. The bytes depend on the values alone: numbers have nine
/// significant digits and a point whatever the locale.
ZWANG_EXPORT std::unique_ptr<LogSink> csv_sink(const std::filesystem::path& path);

/// MCAP (https://mcap.dev). The channel `/records` has every bit of each record, in blocks and compressed
/// chunks of at most 75 ms; docs/logs.md has their format. The channel `/tick` has 10 records a second as
/// JSON, for viewers. The context's sources are its attachments. Cut anywhere, all whole chunks before the
/// cut can be read. Dropped records are missing among the sequence numbers, and `read_log` tells so. Wants a
/// first column `time` in seconds.
ZWANG_EXPORT std::unique_ptr<LogSink> mcap_sink(const std::filesystem::path& path, LogContext context);

/// Counts of records, and the first error.
struct RecorderStatus {
  std::uint64_t recorded = 0;   ///< records accepted by `record`
  std::uint64_t written = 0;    ///< records handed to every sink without an error
  std::uint64_t dropped = 0;    ///< records refused because the writer was behind
  double processor_time = 0.0;  ///< [s] that the writer's thread took; known after `close`
  std::string error;            ///< what a sink said first; empty when all is well
  bool complete() const { return dropped == 0 && error.empty() && recorded == written; }
};

/// Takes records from the control loop, and writes them on a thread of its own.
class ZWANG_EXPORT Recorder {
 public:
  /// Opens the sinks and starts the writer. A sink that cannot be opened, or throws, is reported by `status`,
  /// not thrown; the others go on. `capacity`: records that the ring holds. Throws std::invalid_argument
  /// without sinks, columns or capacity.
  Recorder(std::vector<std::unique_ptr<LogSink>> sinks, std::vector<Column> columns,
           std::size_t capacity = 8192);
  /// Into one CSV file.
  Recorder(const std::filesystem::path& path, std::vector<Column> columns, std::size_t capacity = 8192);
  ~Recorder();  ///< closes
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// One value a column. False, and counted, when the ring is full. One thread only. Does not allocate, lock,
  /// throw or print.
  bool record(std::span<const double> values) noexcept;
  /// Waits until a record finds room: for runs that are faster than the disk and must not lose a record.
  void wait_for_room() const noexcept;
  /// For the end of the log: outcome, report. To be called before `close`, by the thread that calls it.
  void conclude(std::map<std::string, std::string> facts);
  /// Writes what is left and closes the file.
  void close() noexcept;

  std::size_t column_count() const noexcept;
  RecorderStatus status() const;  ///< `written` and `error` are final after `close`

 private:
  struct Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace zwang::runtime
