#include "trial.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "release.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::sweep {

namespace {

using namespace runtime;

// Samples that are the same to the bit are told by that alone; a real converter's are not.
constexpr double noise = 1e-10;      // [rad]
constexpr double watched_for = 3.0;  // [s] after the onset
constexpr double rests_for = 1.0;    // [s] after the end of a run
// No motor holds an arm that nobody sees: behind a stop its own brakes do, and close by then.
constexpr double brakes_within = 0.2;  // [s]

/// Encoders read the true state, in steps, until they fail.
class Encoders {
 public:
  explicit Encoders(const Drawn& drawn)
      : drawn_(drawn), dice_(drawn.seed + 1), kept_(drawn.program.robot.model) {}

  void read(solver::State& state, bool has_failed) {
    const double step = drawn_.encoder_step;
    for (double& q : state.q) {
      if (step > 0.0) q = std::floor(q / step) * step;
    }
    if (!has_failed || !has_read_) kept_ = state;
    has_read_ = true;
    if (!has_failed) return;
    if (drawn_.fault == EncoderFault::frozen) state = kept_;
    state.q = kept_.q;
    if (drawn_.fault == EncoderFault::dead) state.qd.setZero();
    for (double& q : state.q) q += dice_.uniform(0.0, noise);
  }

 private:
  const Drawn& drawn_;
  Dice dice_;
  solver::State kept_;
  bool has_read_ = false;
};

bool begins(const Drawn& drawn, const Runner& runner, double time) {
  if (drawn.fault == EncoderFault::none) return false;
  if (drawn.onset.entry < 0) return time >= drawn.onset.after;
  const auto& entries = runner.transitions();
  const auto entry = static_cast<std::size_t>(drawn.onset.entry);
  return entry < entries.size() && time >= entries[entry].time + drawn.onset.after;
}

double planar_speed(const Truth& truth) {
  return truth.velocity.head<2>().norm();
}

void note_onset(const Drawn& drawn, const Runner& runner, const Truth& truth, Result& result) {
  result.onset = truth.time;
  result.speed_at_onset = planar_speed(truth);
  const int task = runner.scheduler().task();
  const bool has_name = task >= 0 && task < static_cast<int>(drawn.program.tasks.size());
  result.task = has_name ? drawn.program.tasks[static_cast<std::size_t>(task)].name : "end";
  result.speed_bound = 1.1 * std::max(drawn.speed, result.speed_at_onset);
  double stiffness = 0.0;
  for (const lang::SceneObject& object : drawn.program.scene->objects)
    stiffness = std::max(stiffness, object.stiffness);
  const double mass = 1.3 * drawn.program.robot.model.total_mass();
  result.force_bound = 1.1 * drawn.force + result.speed_bound * std::sqrt(2.0 * stiffness * mass);
}

bool has_an_arm(const solver::Model& model) {
  bool found = false;
  for (int j = 0; j < model.joint_count(); ++j)
    found = found || (model.joint(j).actuated && !solver::carries_wheel(model, j + 1));
  return found;
}

}  // namespace

Result run(const Drawn& drawn) {
  if (drawn.leaves_after >= 0.0) return run(released(drawn));
  const lang::Program& program = drawn.program;
  SimulationSteps steps(program.robot.control_period);
  ScenePlantOptions options;
  options.simulation.period = steps.period();
  options.seed = drawn.seed;
  ScenePlant plant(program, options);
  Runner runner(program);
  Encoders encoders(drawn);
  Sensed sensed(program.robot.model, program.signals.size());
  Eigen::VectorXd tau;
  Result result;
  result.encoder_step = drawn.encoder_step;
  double x = 0.0, y = 0.0, end = drawn.time_limit;
  bool is_over = false;
  while (plant.truth().time < end) {
    PlantStatus status = plant.sense(sensed);
    const Truth& truth = plant.truth();
    if (status == PlantStatus::diverged) break;
    if (!result.onset && !is_over && begins(drawn, runner, truth.time)) {
      note_onset(drawn, runner, truth, result);
      x = truth.x;
      y = truth.y;
      end = std::min(end, truth.time + watched_for);
    }
    if (status == PlantStatus::ok) encoders.read(sensed.state, result.onset.has_value());
    if (steps.tick_is_due()) tau = runner.step(sensed);
    if (runner.guard().stopped() && !result.stopped) {
      result.stopped = truth.time;
      if (has_an_arm(program.robot.model)) end = std::min(end, truth.time + brakes_within);
    }
    if (result.onset) {
      result.speed = std::max(result.speed, planar_speed(truth));
      for (const ObjectTruth& object : truth.objects) result.force = std::max(result.force, object.force);
      if (!result.stopped) result.moved = std::max(result.moved, std::hypot(truth.x - x, truth.y - y));
    }
    status = plant.apply(tau);
    if (status != PlantStatus::ok) break;
    if (!is_over && runner.finished()) {
      is_over = true;
      end = result.onset ? std::max(end, plant.truth().time + rests_for) : plant.truth().time;
    }
  }
  for (const ObjectTruth& object : plant.truth().objects) result.is_hooked |= object.latched.has_value();
  for (const Event& event : runner.events())
    result.probed += std::string_view(to_string(event.code)) == "probed" ? 1 : 0;
  result.outcome = runner.finished() ? to_string(runner.state()) : "unfinished";
  if (result.stopped) {
    result.outcome = "stopped";
    result.reason = to_string(runner.guard().reason());
  }
  return result;
}

}  // namespace zwang::sweep
