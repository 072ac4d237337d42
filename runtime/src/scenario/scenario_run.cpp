#include "zwang/runtime/scenario_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

#include "scenario/cell_story.hpp"
#include "scenario/expectation.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/simulated_run.hpp"
#include "zwang/runtime/with_unit.hpp"

namespace zwang::runtime {

namespace {

using Clock = std::chrono::steady_clock;

/// Of a robot that feels `tau` is the virtual robot's, and so are the limits.
double torque_share(const lang::Robot& robot, const Eigen::VectorXd& tau) noexcept {
  const solver::Model& model = robot.model;
  double share = 0.0;
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    if (joint.actuated)
      share = std::max(share, std::abs(tau(j)) / (robot.drive.mass_factor * joint.max_effort));
  }
  return share;
}

void judge(const std::vector<ExpectationWatch>& watches, const std::vector<std::string>& codes,
           CellResult& result) {
  const bool was_run = result.outcome != "error";  // of what could not be simulated nothing is known
  result.passed = was_run;
  std::vector<std::string> of_partners;
  for (const PartnerResult& partner : result.partners) of_partners.push_back(partner.outcome);
  for (const ExpectationWatch& watch : watches) {
    result.expectations.push_back(watch.result(result.outcome, of_partners, codes));
    result.expectations.back().held = was_run && result.expectations.back().held;
    result.passed = result.passed && result.expectations.back().held;
  }
}

/// The partners' measurements and actions on their last tick. Returns the largest share of a torque's limit.
double look_at_partners(ScenePlant& plant, TrueFacts& facts) noexcept {
  double most = 0.0;
  for (std::size_t i = 0; i < plant.partners().size(); ++i) {
    const ScenePartner& partner = plant.partners()[i];
    const double share = torque_share(partner.program->robot, partner.torque);
    facts.update_partner(i, plant.truth(), share);
    most = std::max(most, share);
  }
  return most;
}

std::vector<PartnerResult> results_of(ScenePlant& plant) {
  std::vector<PartnerResult> results;
  for (const ScenePartner& partner : plant.partners()) {
    const RunState state = partner.runner.state();
    results.push_back({partner.name, state == RunState::running ? "unfinished" : to_string(state),
                       partner.runner.because()});
    const BaseTruth& base = plant.truth().robots[results.size() - 1].base;
    if (!base.fallen) continue;
    results.back().outcome = "fallen";
    results.back().because = describe_fall(base);
  }
  return results;
}

/// Whether this tick led to `done` or `failed`.
bool ends_by_itself(const Runner& runner) {
  const std::optional<Transition>& transition = runner.scheduler().transition();
  return transition && transition->to >= runner.scheduler().program_task_count() && !runner.guard().stopped();
}

/// The outputs with what the last exit sets; what `stop` says of them counts from the next tick on.
std::vector<double> outputs_at_the_end(const lang::Program& program, const Runner& runner,
                                       std::vector<double> outputs) {
  const Transition& end = *runner.scheduler().transition();
  const bool is_of_always = end.cause == Cause::always;
  if (!is_of_always && end.cause != Cause::exit) return outputs;
  const std::vector<lang::Exit>& exits =
      is_of_always ? program.always.exits : program.tasks[static_cast<std::size_t>(end.from)].exits;
  for (const lang::SetAction& set : exits[static_cast<std::size_t>(end.exit)].set) {
    if (set.kind != lang::SetKind::output) continue;
    outputs[static_cast<std::size_t>(set.index)] = set.value.evaluate(runner.scheduler().parameters());
  }
  return outputs;
}

/// A tick, and what is to be told of it.
const Eigen::VectorXd& step(Runner& runner, const lang::Program& program, const Sensed& sensed, double time,
                            TrueFacts& facts) {
  const std::size_t told = runner.events().size();
  const std::vector<double> outputs(runner.outputs().begin(), runner.outputs().end());
  const bool was_stopped = runner.guard().stopped();
  const Eigen::VectorXd& tau = runner.step(sensed);
  if (runner.guard().stopped() && !was_stopped) facts.note_stop(time);
  for (std::size_t i = told; i < runner.events().size(); ++i) {
    if (runner.events()[i].code == EventCode::slip) facts.note_slip(time);
  }
  const std::optional<Transition>& transition = runner.scheduler().transition();
  const bool enters = transition && transition->to < runner.scheduler().program_task_count();
  if (enters && !transition->resumes) facts.note_entry(transition->to, time);
  if (ends_by_itself(runner)) {
    facts.note_outputs(outputs_at_the_end(program, runner, outputs));
    if (transition->to == runner.scheduler().program_task_count()) facts.note_done(time);
  } else {
    facts.note_outputs(runner.outputs());
  }
  facts.note_torque(tau, enters && transition->from >= 0);
  return tau;
}

/// Looks at the truth in each step of a cell's run, and asks what the scenario expects.
class CellWatch final : public SimulatedRunHost {
 public:
  CellWatch(const lang::Program& program, ScenePlant& plant, Runner& runner,
            std::vector<ExpectationWatch>& watches, const std::atomic<bool>* interrupted, CellResult& result)
      : program_(program),
        plant_(plant),
        runner_(runner),
        watches_(watches),
        interrupted_(interrupted),
        result_(result),
        facts_(program),
        had_stopped_(plant.partners().size(), false) {
    for (const ExpectationWatch& watch : watches) facts_.follow(watch.condition());
  }

  bool is_interrupted() const noexcept { return interrupted_ != nullptr && interrupted_->load(); }
  const PathWatch& path() const noexcept { return path_; }
  /// [s] when a hand pressed on the robot first.
  const std::optional<double>& pushed() const noexcept { return pushed_; }

  bool goes_on() override { return !is_interrupted(); }
  bool tick(const Sensed& sensed) override {
    tau_ = step(runner_, program_, sensed, plant_.truth().time, facts_);
    facts_.note_pose(runner_.estimated_state(), plant_.true_state());
    has_ticked_ = true;
    return true;
  }
  void look_before_step() override {
    const bool ends = std::exchange(has_ticked_, false) && ends_by_itself(runner_);
    const bool in_task = runner_.state() == RunState::running || ends;
    const double share = torque_share(program_.robot, tau_);
    facts_.note_fault(plant_.onset());
    facts_.update(plant_.truth(), plant_.true_state(), share);
    path_.look(plant_.truth());
    if (plant_.truth().base.hand > 0.0 && !pushed_) pushed_ = plant_.truth().time;
    result_.torque = std::max({result_.torque, share, look_at_partners(plant_, facts_)});
    for (ExpectationWatch& watch : watches_) watch.look(facts_, plant_.truth().time, in_task);
  }
  void look_after_step(const Sensed& sensed) override {
    const std::vector<ScenePartner>& partners = plant_.partners();
    for (std::size_t i = 0; i < partners.size(); ++i) {
      if (!partners[i].runner.guard().stopped() || had_stopped_[i]) continue;
      had_stopped_[i] = true;
      facts_.note_partner_stop(i, sensed.time);
    }
  }

 private:
  const lang::Program& program_;
  ScenePlant& plant_;
  Runner& runner_;
  std::vector<ExpectationWatch>& watches_;
  const std::atomic<bool>* interrupted_;
  CellResult& result_;
  TrueFacts facts_;
  std::vector<bool> had_stopped_;  ///< by partner
  Eigen::VectorXd tau_;
  PathWatch path_;
  std::optional<double> pushed_;
  bool has_ticked_ = false;
};

/// What the plant saw that the robot may not know, behind the reason that it gives.
std::string met(const Truth& truth, const std::optional<double>& pushed) {
  std::string text;
  if (pushed) text += "; a hand pressed on the robot from " + with_unit(*pushed, "s") + " on";
  for (const ObjectTruth& object : truth.objects) {
    if (!object.touched || object.latched) continue;
    text += "; it touched `" + object.name + "` at " + with_unit(*object.touched, "s") + ", with " +
            with_unit(object.peak_force, "N") + " at most";
  }
  return text;
}

void simulate(const lang::Scenario& scenario, const lang::ScenarioCell& cell, const lang::Program& program,
              std::vector<ExpectationWatch>& watches, const std::atomic<bool>* interrupted,
              CellResult& result) {
  ScenePlantOptions options;
  options.simulation.period = SimulationSteps(program.robot.control_period).period();
  options.seed = scenario.seed;
  options.faults = cell.faults;
  options.deviation = cell.deviation;
  ScenePlant plant(program, options);
  Runner runner(program);
  Sensed sensed(program);
  CellWatch watch(program, plant, runner, watches, interrupted, result);
  const PlantStatus status = run_simulated(plant, runner, sensed, scenario.time_limit, watch);
  result.partners = results_of(plant);
  result.simulated = plant.truth().time;
  if (watch.is_interrupted()) {
    result.outcome = "interrupted";
  } else if (status == PlantStatus::diverged) {
    result.outcome = "diverged";
  } else if (plant.truth().base.fallen) {
    result.outcome = "fallen";
  } else if (!runner.finished()) {
    result.outcome = "unfinished";
  } else {
    result.outcome = to_string(runner.state());
  }
  result.because = runner.because();
  result.story = story_of(runner, watch.path());
  const std::optional<Why> why = runner.why();
  if (why && status != PlantStatus::diverged) result.why = why->sentence + met(plant.truth(), watch.pushed());
  if (plant.truth().base.fallen) {
    result.because = describe_fall(plant.truth().base);
    result.why.clear();
  }
}

}  // namespace

CellResult run_cell(const lang::Scenario& scenario, const lang::ScenarioCell& cell,
                    const lang::ScenarioRun& run, const std::vector<std::string>& codes,
                    const std::atomic<bool>* interrupted) {
  CellResult result;
  result.name = cell.name;
  std::vector<ExpectationWatch> watches;
  for (const lang::Expectation& expectation : run.expectations) watches.emplace_back(expectation);
  const auto begin = Clock::now();
  if (!run.program) {
    result.outcome = "refused";
    for (const std::string& code : codes) {
      if (code.front() == 'E') result.because += (result.because.empty() ? "" : ", ") + code;
    }
  } else {
    try {
      simulate(scenario, cell, *run.program, watches, interrupted, result);
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
