#include "file_kind.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>

#include "output.hpp"
#include "plant_start.hpp"
#include "verbs.hpp"
#include "zwang/lang/connection.hpp"
#include "zwang/lang/notes.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/lang/scene_for_robot.hpp"
#include "zwang/lang/study.hpp"

namespace zwang::cli {

namespace fs = std::filesystem;

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

namespace {

/// Breadth first, and what is no link before what is one: a loop of links ends where it began.
class Folders {
 public:
  std::vector<std::string> files_below(const fs::path& folder) {
    walk(folder);
    while (!links_.empty()) {
      const std::vector<fs::path> links = std::exchange(links_, {});
      for (const fs::path& link : links) fs::is_directory(link) ? walk(link) : take(link);
    }
    std::sort(files_.begin(), files_.end());
    return files_;
  }

 private:
  bool is_new(const fs::path& path) { return seen_.insert(fs::canonical(path)).second; }

  void walk(const fs::path& folder) {
    if (!is_new(folder)) return;
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
    std::sort(entries.begin(), entries.end());
    for (const fs::path& entry : entries) {
      if (!fs::exists(entry)) continue;  // a link that leads nowhere
      if (fs::is_symlink(entry)) {
        links_.push_back(entry);
      } else if (fs::is_directory(entry)) {
        walk(entry);
      } else {
        take(entry);
      }
    }
  }

  void take(const fs::path& file) {
    const bool is_yaml = file.extension() == ".yaml" || file.extension() == ".yml";
    if (is_yaml && fs::is_regular_file(file) && is_new(file)) files_.push_back(file.string());
  }

  std::set<fs::path> seen_;
  std::vector<fs::path> links_;
  std::vector<std::string> files_;
};

}  // namespace

std::vector<std::string> yaml_files_below(const std::string& folder) {
  try {
    return Folders().files_below(folder);
  } catch (const fs::filesystem_error& error) {
    throw Impossible(error.path1().string() + ": " + error.code().message());
  }
}

bool is_urdf_text(const std::string& text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c < 0; };
  const auto first = std::find_if_not(text.begin(), text.end(), is_blank);
  return first != text.end() && *first == '<';
}

bool is_urdf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string start(256, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return is_urdf_text(start);
}

void refuse_urdf(const std::string& path) {
  if (is_urdf(path)) refuse_as_urdf(path);
}

void refuse_as_urdf(const std::string& path) {
  const std::string draft = fs::path(path).filename().replace_extension(".yaml").string();
  throw Impossible(path + ": is a URDF, not a file of zwang's; `zwang robot init " + path + " -o " + draft +
                   "` begins a robot file of it, which task files name");
}

std::optional<std::string> read_as(FileKind kind, const std::string& path, lang::Diagnostics& diagnostics,
                                   const Reading& reading) {
  const lang::LoadOptions& options = reading.options;
  switch (kind) {
    case FileKind::robot:
      if (const auto robot = lang::load_robot(path, diagnostics)) {
        if (reading.with_plant) check_plant(*robot, diagnostics);
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
    case FileKind::connection:
      if (const auto connection = lang::load_connection(path, diagnostics))
        return "connection, " + count(connection->signals.size(), "signal");
      return std::nullopt;
    case FileKind::study:
      if (const auto study = lang::load_study(path, diagnostics))
        return "study, " + count(study->draws.size(), "draw") + ", " + count(study->runs, "run");
      return std::nullopt;
    case FileKind::task:
      break;
  }
  if (const auto program =
          (reading.with_notes ? lang::load_with_notes : lang::load)(path, options, diagnostics)) {
    if (reading.with_plant) check_plant(*program, diagnostics);
    return count(program->tasks.size(), "task") + ", robot `" + program->robot.name + "`" +
           (program->scene ? ", with a scene" : "");
  }
  return std::nullopt;
}

}  // namespace zwang::cli
