#include "run_log.hpp"

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "output.hpp"
#include "zwang/runtime/log_channels.hpp"
#include "zwang/runtime/log_reader.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;

std::string exactly(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

}  // namespace

std::filesystem::path make_log_folder(const RunArguments& arguments) {
  std::error_code error;
  if (arguments.log) {
    fs::create_directories(*arguments.log, error);
    if (!fs::is_directory(*arguments.log))
      throw Impossible(*arguments.log + ": cannot make this folder: " + error.message());
    // A script that runs again with the same folder goes on; whom it surprises is told.
    if (fs::exists(fs::path(*arguments.log) / "log.mcap", error))
      print_error("zwang: " + *arguments.log + ": the log that was here is written over\n");
    return *arguments.log;
  }
  fs::create_directories("runs", error);
  const std::string name = fs::path(arguments.file).stem().string();
  for (int i = 1; i < 1'000'000 && !error; ++i) {
    char number[16];
    std::snprintf(number, sizeof number, "-%03d", i);
    fs::path folder = fs::path("runs") / (name + number);
    // True for the one that made it: two runs at once do not share a folder.
    if (fs::create_directory(folder, error)) return folder;
  }
  throw Impossible("runs: cannot make a folder for the log: " + error.message());
}

void require_log(const std::string& log) {
  if (!fs::is_directory(log)) return require_file(log);
  try {
    for (const fs::path& file : runtime::log_files(log)) require_file(file.string());
  } catch (const std::runtime_error& error) {
    throw Impossible(error.what());
  }
}

runtime::LogContext context_of(const RunArguments& arguments, const lang::Scene& scene,
                               const lang::SceneRobot& robot, const lang::Diagnostics& diagnostics) {
  runtime::LogContext context;
  context.sources = diagnostics.sources();
  context.facts["scene"] = scene.path;
  if (!robot.robot_path.empty()) context.facts["robot"] = robot.robot_path;
  context.facts["partner"] = robot.name;
  context.facts["seed"] = std::to_string(arguments.seed);
  return context;
}

std::unique_ptr<runtime::Recorder> record(runtime::Runner& runner, const lang::Program& program,
                                          const fs::path& folder, const std::string& name,
                                          runtime::LogContext context,
                                          std::unique_ptr<runtime::LogSink> also) {
  context.facts.merge(runner.facts());
  std::vector<std::unique_ptr<runtime::LogSink>> sinks;
  sinks.push_back(
      runtime::mcap_sink(folder / (name + ".mcap"), std::move(context), runtime::scene_channels(program)));
  sinks.push_back(runtime::csv_sink(folder / (name + ".csv")));
  if (also) sinks.push_back(std::move(also));
  auto recorder = std::make_unique<runtime::Recorder>(std::move(sinks), runner.columns());
  runner.record_to(recorder.get());
  return recorder;
}

runtime::LogContext context_of(const RunArguments& arguments, const lang::Diagnostics& diagnostics) {
  runtime::LogContext context;
  context.sources = diagnostics.sources();
  std::map<std::string, std::string>& facts = context.facts;
  if (arguments.overrides.robot) facts["robot"] = *arguments.overrides.robot;
  if (arguments.overrides.scene) facts["scene"] = *arguments.overrides.scene;
  facts["seed"] = std::to_string(arguments.seed);
  if (arguments.choice) {
    facts["scenario"] = arguments.choice->scenario;
    facts["cell"] = arguments.cell.value_or("as written");
    if (arguments.choice->blend) facts["blend [s]"] = exactly(*arguments.choice->blend);
  }
  if (arguments.start_yaw) facts["start_yaw [rad]"] = exactly(*arguments.start_yaw);
  if (arguments.start_at) {
    facts["start_at [m]"] = exactly((*arguments.start_at)[0]) + ", " + exactly((*arguments.start_at)[1]);
  }
  return context;
}

}  // namespace zwang::cli
