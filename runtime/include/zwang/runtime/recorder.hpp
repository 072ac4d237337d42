/// The log: one record a tick, written by a thread of its own. Nothing that happens to the disk reaches the
/// control loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace zwang::runtime {

/// One column of the CSV file; its header is `name [unit]`.
struct Column {
  std::string name;
  std::string unit;                ///< empty for pure numbers and words
  std::vector<std::string> words;  ///< when not empty, the value is an index into it
};

struct RecorderStatus {
  std::uint64_t recorded = 0;  ///< records accepted by `record`
  std::uint64_t written = 0;   ///< records handed to the file without an error
  std::uint64_t dropped = 0;   ///< records refused because the writer was behind
  std::string error;           ///< what the file system said; empty when all is well
  bool complete() const { return dropped == 0 && error.empty() && recorded == written; }
};

/// A value that is not a number is written as a blank. The bytes depend on the values alone: numbers have
/// nine significant digits and a point whatever the locale, and no wall-clock time is in them.
class Recorder {
 public:
  /// Opens the file and starts the writer. A file that cannot be written is reported by `status`, not thrown.
  /// Throws std::invalid_argument without columns or capacity.
  Recorder(const std::filesystem::path& path, std::vector<Column> columns, std::size_t capacity = 8192);
  ~Recorder();  ///< closes
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// One value a column. False, and counted, when the ring is full. One thread only. Does not allocate, lock,
  /// throw or print.
  bool record(std::span<const double> values) noexcept;
  /// Waits until a record finds room: for runs that are faster than the disk and must not lose a record.
  void wait_for_room() const noexcept;
  /// Writes what is left and closes the file.
  void close() noexcept;

  std::size_t column_count() const noexcept;
  RecorderStatus status() const;  ///< `written` and `error` are final after `close`

 private:
  struct Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace zwang::runtime
