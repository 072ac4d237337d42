/// The program, run with task files beside the shipped robot and scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "program.hpp"

namespace zwang::test {

namespace fs = std::filesystem;

inline const std::string specs = std::string(ZWANG_SOURCE_DIR) + "/specs/";
inline const std::string wall_align = specs + "wall_align.yaml";

class Cli : public test::Program {
 protected:
  /// A task file beside the shipped robot and scene.
  Result run_task(const std::string& tasks, std::vector<std::string> more = {"--format", "json"}) {
    const fs::path file = write("task.yaml", "zwang: 1\nrobot: none.yaml\n" + tasks);
    std::vector<std::string> arguments = {"run",     file.string(),
                                          "--robot", specs + "robots/mecanum_base.yaml",
                                          "--scene", specs + "scenes/wall.yaml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return zwang(arguments);
  }
};

inline const char* const stand = R"(
start: stand
tasks:
  stand:
    constraints: {still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
)";

}  // namespace zwang::test
