#include "zwang/runtime/scenario_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "scenario/expectation.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double period = 1e-3;  // [s]

double torque_share(const solver::Model& model, const Eigen::VectorXd& tau) noexcept {
  double share = 0.0;
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    if (joint.actuated) share = std::max(share, std::abs(tau(j)) / joint.max_effort);
  }
  return share;
}

void judge(const std::vector<ExpectationWatch>& watches, const std::vector<std::string>& codes,
           CellResult& result) {
  result.passed = true;
  for (const ExpectationWatch& watch : watches) {
    result.expectations.push_back(watch.result(result.outcome, codes));
    result.passed = result.passed && result.expectations.back().held;
  }
}

void simulate(const lang::Scenario& scenario, const lang::ScenarioCell& cell, const lang::Program& program,
              std::vector<ExpectationWatch>& watches, CellResult& result) {
  ScenePlantOptions options;
  options.simulation.period = period;
  options.simulation.start_at = cell.start_at;
  options.simulation.start_yaw = cell.start_yaw;
  options.seed = scenario.seed;
  options.faults = cell.faults;
  ScenePlant plant(program, options);
  Runner runner(program, {.period = period});
  TrueFacts facts(program);
  Sensed sensed(program.robot.model, program.signals.size());
  PlantStatus status = PlantStatus::ok;
  while (!runner.finished() && plant.truth().time < scenario.time_limit) {
    // A sample that does not arrive is the runtime's to deal with: it steps on what it has.
    status = plant.sense(sensed);
    if (status == PlantStatus::diverged) break;
    const std::size_t told = runner.events().size();
    const bool was_stopped = runner.guard().stopped();
    const Eigen::VectorXd& tau = runner.step(sensed);
    if (runner.guard().stopped() && !was_stopped) facts.note_stop(plant.truth().time);
    for (std::size_t i = told; i < runner.events().size(); ++i) {
      if (runner.events()[i].code == EventCode::slip) facts.note_slip(plant.truth().time);
    }
    facts.update(plant.truth(), plant.true_state(), torque_share(program.robot.model, tau));
    const bool in_task = runner.state() == RunState::running;
    for (ExpectationWatch& watch : watches) watch.look(facts, plant.truth().time, in_task);
    status = plant.apply(tau);
    if (status != PlantStatus::ok) break;
  }
  result.simulated = plant.truth().time;
  if (status == PlantStatus::diverged) {
    result.outcome = "diverged";
  } else if (!runner.finished()) {
    result.outcome = "unfinished";
  } else {
    result.outcome = to_string(runner.state());
  }
  if (runner.state() == RunState::stopped) result.because = to_string(runner.guard().reason());
}

}  // namespace

CellResult run_cell(const lang::Scenario& scenario, const lang::ScenarioCell& cell,
                    const lang::ScenarioRun& run, const std::vector<std::string>& codes) {
  CellResult result;
  result.name = cell.name;
  std::vector<ExpectationWatch> watches;
  for (const lang::Expectation& expectation : run.expectations) watches.emplace_back(expectation);
  const auto begin = Clock::now();
  if (!run.program) {
    result.outcome = "refused";
    for (const std::string& code : codes) result.because += (result.because.empty() ? "" : ", ") + code;
  } else {
    try {
      simulate(scenario, cell, *run.program, watches, result);
    } catch (const std::exception& error) {
      result.outcome = "error";
      result.because = error.what();
    }
  }
  result.wall = std::chrono::duration<double>(Clock::now() - begin).count();
  judge(watches, codes, result);
  return result;
}

}  // namespace zwang::runtime
