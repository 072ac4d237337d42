#include "zwang/runtime/log_channels.hpp"

namespace zwang::runtime {

namespace fs = std::filesystem;

std::unique_ptr<LogSink> program_log(const fs::path& file, const LogRotation& rotation,
                                     const LogContext& context, const lang::Program& program) {
  const auto make = [program, context](const fs::path& path,
                                       const std::map<std::string, std::string>& facts) {
    LogContext of_part = context;
    of_part.facts.insert(facts.begin(), facts.end());
    return mcap_sink(path, std::move(of_part), scene_channels(program));
  };
  if (!rotation.is_asked()) return make(file, {});
  return rotating_sink(file.parent_path(), file.stem().string(), rotation, make);
}

}  // namespace zwang::runtime
