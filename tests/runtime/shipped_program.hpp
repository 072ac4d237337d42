/// A program out of the files that ship with zwang.
#pragma once

#include <stdexcept>
#include <string>

#include "zwang/lang/program.hpp"

namespace zwang::test {

inline std::string specs(const std::string& name) {
  return ZWANG_SOURCE_DIR "/specs/" + name;
}

/// Files of specs, by their paths below it. In the task's own scene where none is named.
inline lang::Program shipped_files(const std::string& task, const std::string& robot,
                                   const std::string& scene = "") {
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  options.robot = specs(robot);
  if (!scene.empty()) options.scene = specs(scene);
  auto program = lang::load(specs(task), options, diagnostics);
  if (!program) throw std::runtime_error(task + " does not load with " + robot);
  return *program;
}

/// A shipped task on a shipped base: `mecanum` is robots/mecanum_base.yaml. In the task's own scene where
/// none is named.
inline lang::Program shipped_program(const std::string& task, const std::string& robot,
                                     const std::string& scene = "") {
  return shipped_files(task, "robots/" + robot + "_base.yaml",
                       scene.empty() ? "" : "scenes/" + scene + ".yaml");
}

/// On a base that feels: `mecanum_wrench_50_hz` is robots/feels/mecanum_wrench_50_hz.yaml.
inline lang::Program feeling_program(const std::string& task, const std::string& robot,
                                     const std::string& scene) {
  return shipped_files(task + ".yaml", "robots/feels/" + robot + ".yaml", "scenes/" + scene + ".yaml");
}

}  // namespace zwang::test
