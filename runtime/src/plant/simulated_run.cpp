#include "zwang/runtime/simulated_run.hpp"

namespace zwang::runtime {

namespace {

void note_entry(const Runner& runner, ScenePlant& plant) noexcept {
  const std::optional<Transition>& transition = runner.scheduler().transition();
  if (!transition || transition->resumes || transition->to >= runner.scheduler().program_task_count()) return;
  plant.note_entry(transition->to, plant.truth().time);
}

}  // namespace

PlantStatus run_simulated(ScenePlant& plant, Runner& runner, Sensed& sensed, double time_limit,
                          SimulatedRunHost& host) {
  SimulationSteps steps(runner.period());
  PlantStatus status = PlantStatus::ok;
  while (!runner.finished() && plant.truth().time < time_limit && host.goes_on()) {
    // A sample that does not arrive is the guard's to count: the runner is shown the last one again.
    status = plant.sense(sensed);
    if (status == PlantStatus::diverged) break;
    if (steps.tick_is_due()) {
      if (!host.tick(sensed)) break;
      note_entry(runner, plant);
    }
    host.look_before_step();
    status = plant.follow(runner.command());
    if (status != PlantStatus::ok || plant.truth().base.fallen) break;
    host.look_after_step(sensed);
  }
  if (runner.finished() && status == PlantStatus::ok) plant.end_lean();
  return status;
}

}  // namespace zwang::runtime
