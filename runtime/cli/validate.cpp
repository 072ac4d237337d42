#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "output.hpp"
#include "verbs.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/scenario.hpp"

namespace zwang::cli {

namespace {

enum class Kind { task, robot, scene, scenario };

const char* word(Kind kind) {
  switch (kind) {
    case Kind::task:
      return "task";
    case Kind::robot:
      return "robot";
    case Kind::scene:
      return "scene";
    case Kind::scenario:
      break;
  }
  return "scenario";
}

/// By the first key of the file. What is none of them is read as a task file, whose reader says what is
/// wrong.
Kind kind_of(const std::string& path) {
  std::string start(16 * 1024, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  std::istringstream in(start);
  for (std::string line; std::getline(in, line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#' || line.compare(begin, 3, "---") == 0) continue;
    if (line.compare(begin, 11, "zwang_robot") == 0) return Kind::robot;
    if (line.compare(begin, 14, "zwang_scenario") == 0) return Kind::scenario;
    if (line.compare(begin, 11, "zwang_scene") == 0) return Kind::scene;
    return Kind::task;
  }
  return Kind::task;
}

std::string count(std::size_t n, const char* thing) {
  return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

/// What was read, in a few words; nothing when it is bad.
std::optional<std::string> check(const std::string& path, Kind kind, lang::Diagnostics& diagnostics) {
  switch (kind) {
    case Kind::robot:
      if (const auto robot = lang::load_robot(path, diagnostics)) {
        return "robot `" + robot->name + "`, " + count(robot->model.wheels().size(), "wheel") + ", " +
               with_unit(robot->model.total_mass(), "kg", 3);
      }
      return std::nullopt;
    case Kind::scene:
      if (const auto scene = lang::load_scene(path, diagnostics)) {
        return "scene, " + count(scene->objects.size(), "object");
      }
      return std::nullopt;
    case Kind::scenario:
      if (const auto scenario = lang::load_scenario(path, diagnostics))
        return "scenario, " + count(scenario->cells.size(), "run");
      return std::nullopt;
    case Kind::task:
      break;
  }
  if (const auto program = lang::load(path, {}, diagnostics)) {
    return count(program->tasks.size(), "task") + ", robot `" + program->robot.name + "`" +
           (program->scene ? ", with a scene" : "");
  }
  return std::nullopt;
}

}  // namespace

int validate(const ValidateArguments& arguments) {
  for (const std::string& path : arguments.files) require_file(path);
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  bool good = true;
  for (const std::string& path : arguments.files) {
    lang::Diagnostics diagnostics;
    const Kind kind = kind_of(path);
    const std::optional<std::string> summary = check(path, kind, diagnostics);
    const bool ok = summary && !diagnostics.has_errors();
    good = good && ok;
    if (arguments.format == Format::json) {
      files.push_back({{"file", path}, {"kind", word(kind)}, {"ok", ok}});
      for (auto& d : nlohmann::ordered_json::parse(lang::render_json(diagnostics))) all.push_back(d);
      continue;
    }
    std::ostringstream text;
    lang::render_human(diagnostics, text);
    if (ok) {
      text << path << ": good (" << *summary << ")\n";
    } else {
      text << path << ": " << count(static_cast<std::size_t>(diagnostics.error_count()), "error") << "\n";
    }
    print(text.str());
  }
  if (arguments.format == Format::json) {
    const nlohmann::ordered_json whole = {{"ok", good}, {"files", files}, {"diagnostics", all}};
    print(whole.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  }
  return good ? exit_good : exit_bad;
}

}  // namespace zwang::cli
