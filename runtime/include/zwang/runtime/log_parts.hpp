/// Logs of tasks that run for hours: fewer records, and files of a bounded size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "zwang/export.hpp"
#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

/// Hands on a record at most every 1/`rate` [s] of the run's time. Records of a switch, of an event, and the
/// last one are handed on beside them.
ZWANG_EXPORT std::unique_ptr<LogSink> thinned_sink(std::unique_ptr<LogSink> sink, double rate);
/// The fact that tells of it: a replay needs each record.
inline constexpr const char* log_rate_fact = "log_rate [Hz]";

/// When a log goes on in a new file; whichever comes first.
struct LogRotation {
  std::optional<double> seconds;       ///< of the run's time
  std::optional<std::uint64_t> bytes;  ///< that are on disk
  bool is_asked() const { return seconds || bytes; }
};
/// `500 MB`, `2 GB`, `90 s`, `10 min`, `1 h`, put into `rotation`: at least 1 MB, or 1 s. False: neither.
ZWANG_EXPORT bool read_rotation(std::string_view text, LogRotation& rotation);

/// Writes `STEM_0.mcap`, `STEM_1.mcap` and so on, as rosbag2 splits a bag. Each file opens by itself; from
/// the second one on, facts `continues` and `part` tell which one it goes on from. `make` makes the sink of a
/// file, given the facts to add. Files of that name from a run before are removed.
ZWANG_EXPORT std::unique_ptr<LogSink> rotating_sink(
    const std::filesystem::path& folder, const std::string& stem, const LogRotation& rotation,
    std::function<std::unique_ptr<LogSink>(const std::filesystem::path& path,
                                           const std::map<std::string, std::string>& facts)>
        make);
inline constexpr const char* part_fact = "part";
inline constexpr const char* continues_fact = "continues";

/// Removes the log of a run before, `STEM.mcap` or its parts, and its CSV. Returns what hinders it, as
/// another run that writes it; or nothing.
ZWANG_EXPORT std::string remove_log(const std::filesystem::path& folder, const std::string& stem);

}  // namespace zwang::runtime
