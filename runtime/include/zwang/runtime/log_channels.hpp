/// Channels of a log beside its records, in the forms that Foxglove and Lichtblick show by themselves.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/log_parts.hpp"
#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

struct LogChannel {
  std::string topic;
  std::string schema;      ///< its name, as `foxglove.Log`
  std::string definition;  ///< JSON Schema
};

/// Makes messages out of records. All calls come from one thread. Messages are stamped with the time of the
/// record that they were made of.
class ZWANG_EXPORT LogChannels {
 public:
  using Put = std::function<void(std::size_t channel, std::string_view json)>;
  virtual ~LogChannels() = default;
  virtual const std::vector<LogChannel>& channels() const = 0;
  virtual void open(const std::vector<Column>& columns) = 0;              ///< once, before all records
  virtual void take(std::span<const double> values, const Put& put) = 0;  ///< one value a column; NaN: blank
  virtual void conclude(const std::map<std::string, std::string>& facts, const Put& put) = 0;
};

/// `/tf` (50 a second) and `/tf_static`: where robot, frames and objects are; `/scene`: their shapes, once;
/// `/log`: transitions and events. By the scene's truth where the records have it, else by the estimate.
ZWANG_EXPORT std::unique_ptr<LogChannels> scene_channels(const lang::Program& program);

/// As `mcap_sink` without channels; replays and readers of the records see no difference.
ZWANG_EXPORT std::unique_ptr<LogSink> mcap_sink(const std::filesystem::path& path, LogContext context,
                                                std::unique_ptr<LogChannels> channels);

/// The log of a run of the program, with `scene_channels`: `file`, or its parts `STEM_0.mcap` and so on
/// beside it where a rotation is asked for.
ZWANG_EXPORT std::unique_ptr<LogSink> program_log(const std::filesystem::path& file,
                                                  const LogRotation& rotation, const LogContext& context,
                                                  const lang::Program& program);

}  // namespace zwang::runtime
