/// Reads the MCAP logs that `mcap_sink` writes, whole or damaged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

struct LogContents {
  LogContext context;
  std::map<std::string, std::string> conclusion;  ///< given when the run was over: "outcome", "report"
  std::string schema;                             ///< JSON schema of the records
  std::uint64_t records = 0;                      ///< that could be read
  double begin = 0.0;                             ///< [s] of the first record
  double end = 0.0;                               ///< [s] of the last one
  bool closed = false;                            ///< the log was ended properly
  /// What could not be read, and where; empty when all is well.
  std::vector<std::string> damage;
};

/// The records of a log, one by one. A cut or changed file is read as far as it is whole.
class LogRecords {
 public:
  /// Throws std::runtime_error when the file cannot be opened or is no MCAP file.
  explicit LogRecords(const std::filesystem::path& path);
  ~LogRecords();
  LogRecords(const LogRecords&) = delete;
  LogRecords& operator=(const LogRecords&) = delete;

  bool next();                          ///< false: there is no record any more
  double time() const;                  ///< [s] of the record
  std::string_view json() const;        ///< of the record; valid until `next`
  const LogContents& contents() const;  ///< as far as the log has been read

 private:
  class Reading;
  std::unique_ptr<Reading> reading_;
};

/// Calls `record` with the time [s] and the JSON text of every record that can be read, in the order of the
/// file, and before the first one `before`, with the files, the facts and the schema. A cut or changed file
/// is read as far as it is whole, and `damage` tells the rest. What is in the file never makes it
/// throw, and it needs no more memory than a chunk. It throws std::runtime_error when the file cannot be
/// opened or is no MCAP file.
LogContents read_log(const std::filesystem::path& path,
                     const std::function<void(double time, std::string_view json)>& record,
                     const std::function<void(const LogContents& head)>& before = {});

}  // namespace zwang::runtime
