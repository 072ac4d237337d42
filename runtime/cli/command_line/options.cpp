#include <memory>

#include "argument_text.hpp"
#include "command_line/command_line.hpp"
#include "shipped.hpp"

namespace zwang::cli {

namespace {

const std::map<std::string, Format> formats = {{"human", Format::human}, {"json", Format::json}};

}  // namespace

void add_format(CLI::App& verb, Format& format) {
  takes(verb.add_option("--format", format, "human (default) or json: one object on stdout"), formats);
}

CLI::Option* add_log_limits(CLI::App& verb, std::optional<double>& rate, std::vector<std::string>& rotation) {
  verb.add_option("--log-rate", rate, "most records a second, beside switches and events; replay needs all")
      ->check(CLI::Range(1e-3, 1e6));
  const char* words = "a new file after `500 MB` or `10 min`, or after both: log_0.mcap, log_1.mcap ..";
  return verb.add_option("--log-rotate", rotation, words)->allow_extra_args(false);
}

void add_overrides(CLI::App& verb, TaskOverrides& overrides) {
  verb.add_option("--robot", overrides.robot, "robot file, in the place of the task's own");
  verb.add_option("--scene", overrides.scene, "scene file, in the place of the task's own");
  const auto texts = std::make_shared<std::vector<std::string>>();
  verb.add_option("-p,--param", *texts, "set a parameter: name=value, as push=30N; may be repeated")
      ->allow_extra_args(false);
  verb.parse_complete_callback([texts, &overrides] {
    overrides.parameters = parameters(*texts);
    if (overrides.robot) overrides.robot = file_or_shipped(*overrides.robot, "robots");
    if (overrides.scene) overrides.scene = file_or_shipped(*overrides.scene, "scenes");
  });
}

}  // namespace zwang::cli
