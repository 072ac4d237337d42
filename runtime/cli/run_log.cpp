#include "run_log.hpp"

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "output.hpp"
#include "zwang/runtime/log_channels.hpp"
#include "zwang/runtime/log_parts.hpp"
#include "zwang/runtime/log_reader.hpp"
#include "zwang/runtime/with_unit.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;

}  // namespace

std::filesystem::path make_log_folder(const RunArguments& arguments) {
  std::error_code error;
  if (arguments.log) {
    fs::create_directories(*arguments.log, error);
    if (!fs::is_directory(*arguments.log))
      throw Impossible(*arguments.log + ": cannot make this folder: " + error.message());
    // A script that runs again with the same folder goes on; whom it surprises is told.
    const fs::path folder = *arguments.log;
    const auto has_log = [&] {
      return fs::exists(folder / "log.mcap", error) || fs::exists(folder / "log_0.mcap", error);
    };
    const bool had_one = has_log();
    const std::string hindrance = had_one ? runtime::remove_log(folder, "log") : "";
    if (!hindrance.empty()) throw Impossible(hindrance);
    // A link or a pipe is still there: the run refuses it, and writes nothing over.
    if (had_one && !has_log())
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
  context.facts["seed"] = std::to_string(arguments.seed.value_or(0));
  return context;
}

std::string log_name(const RunArguments& arguments, const std::string& name) {
  return name + (arguments.rotation.is_asked() ? "_0.mcap" : ".mcap");
}

std::unique_ptr<runtime::Recorder> record(const RunArguments& arguments, runtime::Runner& runner,
                                          const lang::Program& program, const fs::path& folder,
                                          const std::string& name, runtime::LogContext context,
                                          std::unique_ptr<runtime::LogSink> also) {
  context.facts.merge(runner.facts());
  if (arguments.log_rate) context.facts[runtime::log_rate_fact] = runtime::exactly(*arguments.log_rate);
  std::vector<std::unique_ptr<runtime::LogSink>> sinks;
  sinks.push_back(runtime::program_log(folder / (name + ".mcap"), arguments.rotation, context, program));
  if (arguments.csv) sinks.push_back(runtime::csv_sink(folder / (name + ".csv")));
  if (arguments.log_rate) {
    for (auto& sink : sinks) sink = runtime::thinned_sink(std::move(sink), *arguments.log_rate);
  }
  if (also) sinks.push_back(std::move(also));
  // Small enough for a cache. A simulation waits for room, so that a slow disk loses nothing.
  constexpr std::size_t records = 1024;
  auto recorder = std::make_unique<runtime::Recorder>(std::move(sinks), runner.columns(), records);
  runner.record_to(recorder.get());
  return recorder;
}

runtime::LogContext context_of(const RunArguments& arguments, const lang::Diagnostics& diagnostics) {
  runtime::LogContext context;
  context.sources = diagnostics.sources();
  std::map<std::string, std::string>& facts = context.facts;
  if (arguments.overrides.robot) facts["robot"] = *arguments.overrides.robot;
  if (arguments.overrides.scene) facts["scene"] = *arguments.overrides.scene;
  facts["seed"] = std::to_string(arguments.seed.value_or(0));
  if (arguments.choice) {
    facts["scenario"] = arguments.choice->scenario;
    facts["cell"] = arguments.cell.value_or("as written");
    if (arguments.choice->blend) facts["blend [s]"] = runtime::exactly(*arguments.choice->blend);
  }
  if (arguments.start_yaw) facts["start_yaw [rad]"] = runtime::exactly(*arguments.start_yaw);
  if (arguments.start_at) {
    facts["start_at [m]"] =
        runtime::exactly((*arguments.start_at)[0]) + ", " + runtime::exactly((*arguments.start_at)[1]);
  }
  return context;
}

}  // namespace zwang::cli
