#include "file_kind.hpp"

#include <fstream>
#include <sstream>

#include "output.hpp"
#include "verbs.hpp"
#include "zwang/lang/notes.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/lang/scene_for_robot.hpp"

namespace zwang::cli {

lang::LoadOptions TaskOverrides::load_options() const {
  lang::LoadOptions options;
  for (const auto& file : {robot, scene}) {
    if (file) require_file(*file);
  }
  if (robot) options.robot = *robot;
  if (scene) options.scene = *scene;
  options.parameters = parameters;
  return options;
}

const char* word_of(FileKind kind) {
  switch (kind) {
    case FileKind::task:
      return "task";
    case FileKind::robot:
      return "robot";
    case FileKind::scene:
      return "scene";
    case FileKind::scenario:
      break;
  }
  return "scenario";
}

std::optional<FileKind> kind_by_key(const std::string& path) {
  std::string start(16 * 1024, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  if (start.starts_with("\xEF\xBB\xBF")) start.erase(0, 3);
  std::istringstream in(start);
  for (std::string line; std::getline(in, line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#' || line.compare(begin, 3, "---") == 0) continue;
    if (line.compare(begin, 11, "zwang_robot") == 0) return FileKind::robot;
    if (line.compare(begin, 14, "zwang_scenario") == 0) return FileKind::scenario;
    if (line.compare(begin, 11, "zwang_scene") == 0) return FileKind::scene;
    if (line.compare(begin, 6, "zwang:") == 0) return FileKind::task;
    return std::nullopt;
  }
  return std::nullopt;
}

std::optional<std::string> read_as(FileKind kind, const std::string& path, lang::Diagnostics& diagnostics,
                                   const lang::LoadOptions& options, bool with_notes) {
  switch (kind) {
    case FileKind::robot:
      if (const auto robot = lang::load_robot(path, diagnostics)) {
        return "robot `" + robot->name + "`, " + count(robot->model.wheels().size(), "wheel") + ", " +
               with_unit(robot->model.total_mass(), "kg", 3);
      }
      return std::nullopt;
    case FileKind::scene:
      if (const auto scene = options.robot ? lang::load_scene_for(*options.robot, path, diagnostics)
                                           : lang::load_scene(path, diagnostics)) {
        return "scene, " + count(scene->objects.size(), "object");
      }
      return std::nullopt;
    case FileKind::scenario:
      if (const auto scenario = lang::check_scenario(path, diagnostics)) {
        return "scenario, " + count(scenario->cells.size(), "run");
      }
      return std::nullopt;
    case FileKind::task:
      break;
  }
  if (const auto program = (with_notes ? lang::load_with_notes : lang::load)(path, options, diagnostics)) {
    return count(program->tasks.size(), "task") + ", robot `" + program->robot.name + "`" +
           (program->scene ? ", with a scene" : "");
  }
  return std::nullopt;
}

}  // namespace zwang::cli
