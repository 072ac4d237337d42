// A folder to begin in: a task, its robot and scene, a scenario, and an editor that knows the files.
#include <filesystem>

#include "output.hpp"
#include "shipped.hpp"
#include "verbs.hpp"
#include "zwang/lang/schema.hpp"

namespace zwang::cli {

namespace fs = std::filesystem;

namespace {

constexpr const char* scenario = R"~(# yaml-language-server: $schema=../schemas/scenario.json
# The task keeps its promise from several headings. `zwang test scenarios` judges it by the simulator's truth.
zwang_scenario: 1
task: ../wall_align.yaml
scene: ../scenes/wall_far.yaml
matrix:
  start_yaw: [-20 deg, 5 deg, 20 deg]
expect:
  - outcome: done
  - {at: end, that: abs(truth.base.yaw) < 0.1 deg}
  - {at: end, that: abs(truth.wall.force - 20 N) < 0.1 N}
)~";

constexpr const char* editor_settings = R"~({
  "yaml.schemas": {
    "schemas/task.json": "*.yaml",
    "schemas/robot.json": "robots/*.yaml",
    "schemas/scene.json": "scenes/*.yaml",
    "schemas/scenario.json": "scenarios/*.yaml"
  }
}
)~";

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  write_file(file.string(), text);
}

/// Half a folder is none: the disk may be full. The folder was empty, or not there.
void take_back(const fs::path& folder, bool was_there) {
  std::error_code error;
  if (!was_there) {
    fs::remove_all(folder, error);
    return;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) fs::remove_all(entry, error);
}

}  // namespace

int init(const InitArguments& arguments) {
  const fs::path folder = arguments.folder;
  const std::optional<fs::path> shipped = shipped_folder();
  if (!shipped)
    throw Impossible(
        "the shipped files are not beside this program: install it, or run it from its checkout");
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error))
    throw Impossible(arguments.folder + ": is there already; name a folder that is new or empty");
  const bool was_there = fs::exists(folder, error);
  try {
    for (const char* file : {".zwang-root", "wall_align.yaml", "robots/mecanum_base.yaml",
                             "robots/mecanum_base.urdf", "scenes/wall.yaml", "scenes/wall_far.yaml"}) {
      fs::create_directories((folder / file).parent_path());
      fs::copy_file(*shipped / file, folder / file);
    }
    write(folder / "scenarios/wall_align.yaml", scenario);
    write(folder / ".vscode/settings.json", editor_settings);
    for (const auto& [name, kind] : schema_kinds)
      write(folder / "schemas" / (name + ".json"), lang::json_schema(kind));
  } catch (const Impossible&) {
    take_back(folder, was_there);
    throw;
  } catch (const fs::filesystem_error& failure) {
    take_back(folder, was_there);
    throw Impossible(failure.path1().string() + ": " + failure.code().message());
  }
  print(arguments.folder + ": written\n\n  cd " + arguments.folder +
        "\n  zwang run wall_align.yaml    run the task\n  zwang test scenarios         judge it from three "
        "headings\n"
        "  zwang robot init URDF        begin the file of your own robot\n");
  return exit_good;
}

}  // namespace zwang::cli
