/// A program out of two texts: a task file for the mecanum base, and the scene that it stands in.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "../temporary_folder.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::test {

/// `scene` without its first line. Throws what the files were refused for.
inline lang::Program program_in_scene(const char* task, const std::string& scene) {
  namespace fs = std::filesystem;
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  fs::create_directories(folder / "robots");
  for (const char* name : {"robots/mecanum_base.yaml", "robots/mecanum_base.urdf"}) {
    fs::copy_file(fs::path(ZWANG_SOURCE_DIR "/specs") / name, folder / name);
  }
  std::ofstream(folder / "task.yaml") << task;
  std::ofstream(folder / "scene.yaml") << "zwang_scene: 1\n" << scene;
  lang::LoadOptions options;
  options.scene = folder / "scene.yaml";
  lang::Diagnostics diagnostics;
  auto program = lang::load(folder / "task.yaml", options, diagnostics);
  std::ostringstream text;
  lang::render_human(diagnostics, text);
  if (!program) throw std::runtime_error(text.str());
  return *program;
}

}  // namespace zwang::test
