#include "file_kind.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "output.hpp"
#include "plant_start.hpp"
#include "verbs.hpp"
#include "zwang/lang/connection.hpp"
#include "zwang/lang/notes.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/lang/scene_for_robot.hpp"

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

const char* word_of(FileKind kind) {
  switch (kind) {
    case FileKind::task:
      return "task";
    case FileKind::robot:
      return "robot";
    case FileKind::scene:
      return "scene";
    case FileKind::scenario:
      return "scenario";
    case FileKind::connection:
      break;
  }
  return "connection";
}

namespace {

struct FirstKey {
  std::string_view key;
  FileKind kind;
};
constexpr FirstKey first_keys[] = {{"zwang", FileKind::task},
                                   {"zwang_robot", FileKind::robot},
                                   {"zwang_scene", FileKind::scene},
                                   {"zwang_scenario", FileKind::scenario},
                                   {"zwang_connection", FileKind::connection}};
constexpr std::size_t is_another_word = 3;

/// How many letters have to be written again for one word to become the other, if they stand together.
std::size_t letters_between(std::string_view a, std::string_view b) {
  const std::size_t longest = std::max(a.size(), b.size()), shortest = std::min(a.size(), b.size());
  std::size_t before = 0, behind = 0;
  while (before < shortest && a[before] == b[before]) ++before;
  while (before + behind < shortest && a[a.size() - 1 - behind] == b[b.size() - 1 - behind]) ++behind;
  return longest - before - behind;
}

/// A key with a letter too many, too few, wrong or swapped is the one that it is nearest to.
std::optional<FileKind> kind_of_key(std::string_view key) {
  std::size_t least = is_another_word;
  std::optional<FileKind> kind;
  for (const FirstKey& first : first_keys) {
    const std::size_t letters = letters_between(key, first.key);
    // Of a short word more would be left than is told by it.
    if (letters >= least || (first.kind == FileKind::task && letters > 1)) continue;
    least = letters;
    kind = first.kind;
  }
  return kind;
}

/// The key that a line begins with, whatever stands around it; empty for a comment and the like.
std::string_view key_of(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t\r{\"'");
  if (begin == std::string_view::npos || line[begin] == '#' || line.substr(begin, 3) == "---") return {};
  line.remove_prefix(begin);
  return line.substr(0, line.find_first_of(" \t\r:\"'"));
}

}  // namespace

std::optional<FileKind> kind_by_key(const std::string& path) {
  std::string start(16 * 1024, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  if (start.starts_with("\xEF\xBB\xBF")) start.erase(0, 3);
  std::istringstream in(start);
  for (std::string line; std::getline(in, line);) {
    if (const std::string_view key = key_of(line); !key.empty()) return kind_of_key(key);
  }
  return std::nullopt;
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
