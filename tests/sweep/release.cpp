#include "release.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::sweep {

namespace {

using namespace runtime;

constexpr double pressed = 0.5;      // of the task's force, and no hit
constexpr double hit = 1.5;          // of it
constexpr double settles_for = 0.2;  // [s] of pressing before an onset
constexpr double leaves_for = 0.2;   // [s] on a way of
constexpr double leaves_by = 3.0;    // [m]

/// [s] The ticks in which the base has pressed for a while.
std::vector<double> press_times(const Drawn& drawn) {
  SimulationSteps steps(drawn.program.robot.control_period);
  ScenePlantOptions options;
  options.simulation.period = steps.period();
  options.seed = drawn.seed;
  ScenePlant plant(drawn.program, options);
  Runner runner(drawn.program);
  Sensed sensed(drawn.program.robot.model, drawn.program.signals.size());
  Eigen::VectorXd tau;
  std::vector<double> times;
  double since = 0.0;
  while (plant.truth().time < drawn.time_limit && !runner.finished()) {
    if (plant.sense(sensed) == PlantStatus::diverged) break;
    const Truth& truth = plant.truth();
    double force = 0.0;
    for (const ObjectTruth& object : truth.objects) force = std::max(force, object.force);
    if (force < pressed * drawn.force || force > hit * drawn.force) since = truth.time;
    if (truth.time - since > settles_for) times.push_back(truth.time);
    if (steps.tick_is_due()) tau = runner.step(sensed);
    if (plant.apply(tau) != PlantStatus::ok) break;
  }
  return times;
}

}  // namespace

Drawn released(Drawn drawn) {
  const std::vector<double> times = press_times(drawn);
  drawn.onset.entry = -1;
  drawn.onset.after = 2.0 * drawn.time_limit;
  const double leaves_after = drawn.leaves_after;
  drawn.leaves_after = -1.0;
  if (times.empty()) return drawn;
  const double share = drawn.press_share * static_cast<double>(times.size());
  drawn.onset.after = times[std::min(times.size() - 1, static_cast<std::size_t>(share))];
  const double leaves_at = drawn.onset.after + leaves_after;
  for (lang::SceneObject& object : drawn.program.scene->objects) {
    if (object.mass) continue;
    const std::array<double, 2> gone = {object.at[0] + leaves_by * std::cos(object.yaw),
                                        object.at[1] + leaves_by * std::sin(object.yaw)};
    object.motion = {{.time = leaves_at, .at = object.at, .yaw = object.yaw},
                     {.time = leaves_at + leaves_for, .at = gone, .yaw = object.yaw}};
  }
  return drawn;
}

}  // namespace zwang::sweep
