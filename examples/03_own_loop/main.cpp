// A task file in a loop of one's own: sense, step, apply, with a parameter that changes while it runs.
//
//   03_own_loop TASK.yaml        specs/wall_align.yaml, or specs/docking.yaml, which has to see its partner
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace {

using namespace zwang;

std::optional<lang::Program> load(const char* path) {
  lang::Diagnostics diagnostics;
  std::optional<lang::Program> program = lang::load(path, {}, diagnostics);
  lang::render_human(diagnostics, std::cerr);
  if (program && !program->scene) {
    std::cerr << path << ": names no scene\n";
    return std::nullopt;
  }
  return program;
}

/// In the place of the plant stands your robot: anything that can sense and apply.
int run(const lang::Program& program, runtime::Plant& plant) {
  runtime::Runner runner(program);  // allocates; the loop does not
  runtime::Sensed sensed(program);
  bool pushed_harder = false;
  while (!runner.finished() && sensed.time < 60.0) {
    // A robot fills in its signals, too: sensed.signals[i] = {.valid = true, .stamp = ..., .number = ...}. A
    // sample that does not come is the runner's to count: it is shown the last one again.
    if (plant.sense(sensed) == runtime::PlantStatus::diverged) break;
    if (sensed.time > 4.0 && !pushed_harder) {
      pushed_harder = true;
      const bool taken = runner.set_parameter("push", 30.0);
      std::printf("%.2f s: push 30 N %s\n", sensed.time, taken ? "from now on" : "is refused");
    }
    if (plant.apply(runner.step(sensed)) != runtime::PlantStatus::ok) break;
    if (const auto& t = runner.scheduler().transition()) {
      const auto& to = runner.scheduler().tasks()[static_cast<std::size_t>(t->to)];
      std::printf("%.2f s: %s (%s)\n", t->time, to.name.c_str(), runner.scheduler().why(*t).c_str());
    }
  }
  std::printf("%.2f s: %s\n", sensed.time, runtime::to_string(runner.state()));
  return runner.state() == runtime::RunState::done ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: 03_own_loop TASK.yaml\n";
    return 2;
  }
  const std::optional<lang::Program> program = load(argv[1]);
  if (!program) return 2;
  runtime::ScenePlant plant(*program);  // what the scene lets a robot know, and no more
  return run(*program, plant);
} catch (const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 2;
}
