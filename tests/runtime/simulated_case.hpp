/// One run of a task file on the simulated plant.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "../temporary_folder.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::runtime::test {

namespace fs = std::filesystem;
inline const fs::path specs = ZWANG_SOURCE_DIR "/specs";

inline lang::Program load_file(const fs::path& task, lang::LoadOptions options = {}) {
  lang::Diagnostics diagnostics;
  options.root = "/";
  const auto program = lang::load(task, options, diagnostics);
  std::ostringstream words;
  lang::render_human(diagnostics, words);
  if (!program) throw std::runtime_error(words.str());
  return *program;
}

/// A task file of the test's own.
inline lang::Program write(const std::string& text, const fs::path& scene,
                           const std::string& robot = "mecanum_base") {
  const zwang::test::TemporaryFolder folder;
  const fs::path file = folder.path() / "task.yaml";
  std::ofstream(file) << "zwang: 1\nrobot: " << (specs / "robots" / (robot + ".yaml")).string() << "\n"
                      << text;
  lang::LoadOptions options;
  options.scene = scene;
  return load_file(file, options);
}

inline double mass_along_x(const lang::Program& program) {
  return solver::analyse_base(program.robot.model, lang::start_state(program.robot)).axes[0].effective_mass;
}

/// One run of a program on the plant.
struct Simulated {
  explicit Simulated(const lang::Program& p, const ScenePlantOptions& options = {})
      : program(p), plant(program, options), runner(program), sensed(program.robot.model, p.signals.size()) {}

  /// `look` sees each tick after the torques are known and before they act.
  void go(double longest, const std::function<void(const Eigen::VectorXd&)>& look) {
    while (!runner.finished() && plant.truth().time < longest) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      const Eigen::VectorXd& tau = runner.step(sensed);
      look(tau);
      ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
    }
  }
  std::string task() const {
    return runner.scheduler().tasks()[static_cast<std::size_t>(runner.scheduler().task())].name;
  }

  const lang::Program program;
  ScenePlant plant;
  Runner runner;
  Sensed sensed;
};

}  // namespace zwang::runtime::test
