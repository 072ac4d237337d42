#include "file_kind.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>
#include <variant>

#include "output.hpp"
#include "plant_start.hpp"
#include "verbs.hpp"
#include "zwang/lang/check_file.hpp"

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

namespace {

/// One line of what a good file holds. A robot is given to the plant where the reading asks for that.
class Summary {
 public:
  Summary(bool with_plant, lang::Diagnostics& diagnostics)
      : with_plant_(with_plant), diagnostics_(diagnostics) {}

  std::optional<std::string> operator()(const std::monostate& /*refused*/) const { return std::nullopt; }
  std::optional<std::string> operator()(const lang::Program& program) const {
    if (with_plant_) check_plant(program, diagnostics_);
    return count(program.tasks.size(), "task") + ", robot `" + program.robot.name + "`" +
           (program.scene ? ", with a scene" : "");
  }
  std::optional<std::string> operator()(const lang::Robot& robot) const {
    if (with_plant_) check_plant(robot, diagnostics_);
    return "robot `" + robot.name + "`, " + count(robot.model.wheels().size(), "wheel") + ", " +
           with_unit(robot.model.total_mass(), "kg", 3);
  }
  std::optional<std::string> operator()(const lang::Scene& scene) const {
    return "scene, " + count(scene.objects.size(), "object");
  }
  std::optional<std::string> operator()(const lang::Scenario& scenario) const {
    return "scenario, " + count(scenario.cells.size(), "run");
  }
  std::optional<std::string> operator()(const lang::Connection& connection) const {
    return "connection, " + count(connection.signals.size(), "signal");
  }
  std::optional<std::string> operator()(const lang::Study& study) const {
    return "study, " + count(study.draws.size(), "draw") + ", " + count(study.runs, "run");
  }

 private:
  bool with_plant_;
  lang::Diagnostics& diagnostics_;
};

}  // namespace

std::optional<std::string> read_as(FileKind kind, const std::string& path, lang::Diagnostics& diagnostics,
                                   const Reading& reading) {
  const lang::FileContent content =
      lang::check_file(kind, path, {reading.options, reading.with_notes, reading.task}, diagnostics);
  return std::visit(Summary(reading.with_plant, diagnostics), content);
}

}  // namespace zwang::cli
