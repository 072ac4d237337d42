// A host sets parameters, swaps the program, looks at events, stops, and writes a log while a task runs.
//
//   05_live TASK.yaml OTHER_TASK.yaml LOG.mcap        specs/wall_align.yaml specs/obstacle.yaml
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"
#include "zwang/runtime/watchdog.hpp"

namespace {

using namespace zwang;

std::optional<lang::Program> load(const char* path, lang::Diagnostics& diagnostics) {
  auto program = lang::load(path, {}, diagnostics);
  lang::render_human(diagnostics, std::cerr);
  return program;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::cerr << "usage: 05_live TASK.yaml OTHER_TASK.yaml LOG.mcap\n";
    return 2;
  }
  lang::Diagnostics diagnostics, of_the_other;
  const auto program = load(argv[1], diagnostics), other = load(argv[2], of_the_other);
  if (!program || !program->scene || !other) return 2;
  runtime::ScenePlant plant(*program);
  runtime::Runner runner(*program), next(*other);  // both are ready before the loop begins
  runtime::Sensed sensed(*program);
  runtime::LogContext context;
  context.sources = diagnostics.sources();  // the files, as `load` read them
  context.facts = runner.facts();           // what a replay needs beside them
  std::vector<std::unique_ptr<runtime::LogSink>> sinks;
  sinks.push_back(runtime::mcap_sink(argv[3], context));
  runtime::Recorder recorder(std::move(sinks), runner.columns());
  runner.record_to(&recorder);  // it outlives the runner's last step
  // On a robot it would cut the motors' current: the thread that should do it is the one that is blocked.
  runtime::Watchdog watchdog(1.0, [] { std::fputs("the loop is blocked\n", stderr); });
  while (!runner.finished()) {
    watchdog.feed();
    if (plant.sense(sensed) == runtime::PlantStatus::diverged) return 1;
    const long tick = std::lround(sensed.time * 1e3);
    if (tick == 500) std::printf("push 30 N: %s\n", runner.set_parameter("push", 30.0) ? "taken" : "refused");
    if (tick == 600)
      std::printf("push 300 N: %s\n", runner.set_parameter("push", 300.0) ? "taken" : "refused");
    if (tick == 1000) {
      const std::string swapped = runtime::describe(runner.swap_program(next));
      std::printf("the other task: %s\n", swapped.c_str());
    }
    if (tick == 2000) runner.guard().stop(runtime::EventCode::requested);
    if (plant.apply(runner.step(sensed)) != runtime::PlantStatus::ok) return 1;
  }
  for (const runtime::Event& event : runner.events()) {
    std::printf("%.3f s: %s\n", event.time, runtime::to_string(event.code));
  }
  std::printf("%.2f s: %s\n", sensed.time, runtime::to_string(runner.state()));
  return runner.state() == runtime::RunState::stopped ? 0 : 1;
} catch (const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 2;
}
