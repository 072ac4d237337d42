/// Reads the MCAP logs that `mcap_sink` writes, whole or damaged, and those of zwang before 2026-11-26.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

/// A log's description of one of its columns.
struct ZWANG_EXPORT LoggedColumn {
  std::string name;
  std::string unit;                ///< empty for pure numbers and words
  std::vector<std::string> words;  ///< when not empty, a value is an index into it
  std::string file;                ///< whose line it comes from, as the log names it; empty: none
  int line = 0;

  bool is_input() const;  ///< came from outside: sensed, or a parameter that was set
  /// Empty: blank, or no word of its own.
  std::string_view word(double value) const noexcept;
  /// As many digits as bring the number back bit by bit, or the word; empty: blank.
  std::string text(double value) const;
};

/// The number of the column with this name; that of all columns where there is none.
ZWANG_EXPORT std::size_t place_of(const std::vector<LoggedColumn>& columns, std::string_view name) noexcept;

/// The contents of a log beside its records.
struct LogContents {
  LogContext context;
  std::map<std::string, std::string> conclusion;  ///< given when the run was over: "outcome", "report"
  std::string schema;                             ///< JSON schema of the records
  std::vector<LoggedColumn> columns;              ///< of the records, in their order
  std::uint64_t records = 0;                      ///< that could be read
  double begin = 0.0;                             ///< [s] of the first record
  double end = 0.0;                               ///< [s] of the last one
  bool closed = false;                            ///< the log was ended properly
  /// The parts that could not be read, each with its place; empty when all is well.
  std::vector<std::string> damage;
};

/// The files of a run's log: `log.mcap` in its folder, or `log_0.mcap`, `log_1.mcap` and so on in their
/// order. A path that is no folder is itself the file. Throws std::runtime_error where the folder holds no
/// log.
ZWANG_EXPORT std::vector<std::filesystem::path> log_files(const std::filesystem::path& run);

/// The records of a log, one by one. A cut or changed file is read as far as it is whole.
class ZWANG_EXPORT LogRecords {
 public:
  /// `log`: a file, or the folder of a run. Throws std::runtime_error when the file cannot be opened or is no
  /// MCAP file.
  explicit LogRecords(const std::filesystem::path& log);
  ~LogRecords();
  LogRecords(const LogRecords&) = delete;
  LogRecords& operator=(const LogRecords&) = delete;

  bool next();                             ///< false: there is no record any more
  double time() const;                     ///< [s] of the record
  std::span<const double> values() const;  ///< one a column, NaN: blank; valid until `next`
  const LogContents& contents() const;     ///< as far as the log has been read

 private:
  class File;
  bool open_next();

  LogContents contents_;
  std::vector<std::filesystem::path> files_;
  std::size_t opened_ = 0;  ///< of the files
  std::unique_ptr<File> file_;
};

/// Calls `record` with the time [s] and the values of every record that can be read, in their order. Calls
/// `before` ahead of the first one, with the files, the facts and the columns. A cut or changed file is read
/// as far as it is whole, and `damage` tells the rest. No content of a file makes it throw, or take more
/// memory than a chunk. Throws as LogRecords.
ZWANG_EXPORT LogContents
read_log(const std::filesystem::path& log,
         const std::function<void(double time, std::span<const double> values)>& record,
         const std::function<void(const LogContents& head)>& before = {});

}  // namespace zwang::runtime
