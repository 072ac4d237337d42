#include "zwang/runtime/runner.hpp"

#include <algorithm>
#include <limits>

#include "estimate/friction.hpp"
#include "estimate/weight.hpp"
#include "run/limit_table.hpp"
#include "run/log_layout.hpp"
#include "run/shortfall.hpp"
#include "run/statement_table.hpp"
#include "zwang/runtime/odometry.hpp"

namespace zwang::runtime {

namespace {

constexpr std::size_t kept_transitions = 1024;
constexpr double at_rest_speed = 0.01;               // [m/s]
constexpr double at_rest_turn = 0.0174532925199433;  // [rad/s], 1 deg/s
constexpr double longest_stop = 10.0;                // [s]

}  // namespace

const char* to_string(RunState state) noexcept {
  switch (state) {
    case RunState::running:
      return "running";
    case RunState::done:
      return "done";
    case RunState::failed:
      return "failed";
    case RunState::stopped:
      return "stopped";
  }
  return "?";
}

struct Runner::Parts {
  Parts(const lang::Program& program, const RunnerSettings& settings)
      : model(program.robot.model),
        period(settings.period),
        scheduler(program, settings.period),
        solver(model, {.row_capacity = scheduler.row_capacity()}),
        solution(model, scheduler.row_capacity()),
        estimated(model, program.signals.size()),
        sample(model, program.signals.size()),
        odometry(model, {}, {.period = settings.period}),
        friction(program.robot),
        weight(model),
        guard(program.robot, {.period = settings.period, .max_slew = settings.max_slew}),
        statements(scheduler, program),
        limits(statements, program.robot),
        layout(statements, scheduler, model, program.signals, settings.extra_columns),
        wanted(Eigen::VectorXd::Zero(model.joint_count())),
        tau(Eigen::VectorXd::Zero(model.joint_count())) {
    transitions.reserve(kept_transitions);
    for (const lang::Parameter& p : program.parameters) parameter_names.push_back(p.name);
  }

  /// What is known of a good sample: itself, or with the base as the wheels tell it.
  void estimate(const Sensed& sensed) noexcept;
  /// Everything between that and the guard. False when there are no torques to send.
  bool control() noexcept;
  void brake_protectively(bool good_sample) noexcept;

  const solver::Model model;
  std::vector<std::string> parameter_names;
  double period;
  Scheduler scheduler;
  solver::Solver solver;
  solver::Solution solution;
  Sensed estimated;  ///< the last good sample
  Sensed sample;     ///< the same, its velocities as the ground allows them
  Odometry odometry;
  bool reckoning = false;  ///< the base is not measured: `odometry` tells it
  double last_fix = -std::numeric_limits<double>::infinity();  ///< [s]
  FrictionFeedForward friction;
  WeightFeedForward weight;
  SafetyGuard guard;
  StatementTable statements;
  LimitTable limits;
  LogLayout layout;
  Recorder* recorder = nullptr;
  Eigen::VectorXd wanted;  ///< the solution's torques and the friction's
  Eigen::VectorXd tau;     ///< sent
  solver::Status solver_status = solver::Status::ok;
  GuardStatus guard_status = GuardStatus::passed;
  std::vector<Transition> transitions;
  std::uint64_t transition_count = 0;
  Shortfall shortfall;
  std::uint64_t stopped_ticks = 0;
  bool stands = false;  ///< after a protective stop
};

void Runner::Parts::estimate(const Sensed& sensed) noexcept {
  estimated.time = sensed.time;
  estimated.state = sensed.state;
  // A snapshot may have fewer or more signals than the program; the estimate keeps its size.
  std::copy_n(sensed.signals.begin(), std::min(sensed.signals.size(), estimated.signals.size()),
              estimated.signals.begin());
  if (sensed.base_measured) {
    reckoning = false;
    return;
  }
  if (!reckoning) odometry.start_at(sensed.state.base_pose);
  reckoning = true;
  if (sensed.base_fix && sensed.base_fix->stamp > last_fix) {
    last_fix = sensed.base_fix->stamp;
    odometry.correct(last_fix, sensed.base_fix->pose);
  }
  odometry.update(sensed.time, estimated.state);
}

bool Runner::Parts::control() noexcept {
  sample.time = estimated.time;
  sample.state = estimated.state;
  std::copy(estimated.signals.begin(), estimated.signals.end(), sample.signals.begin());
  solver_status = solver.project_velocity(sample.state);
  if (solver_status != solver::Status::ok) return false;
  weight.add_to(sample.state);
  scheduler.tick(sample);
  if (scheduler.transition()) {
    ++transition_count;
    if (transitions.size() < transitions.capacity()) transitions.push_back(*scheduler.transition());
  }
  solver_status = scheduler.constraints().fill(model, sample.state)
                      ? solver.solve(sample.state, scheduler.constraints().rows(), solution)
                      : solver::Status::capacity_exceeded;
  if (solver_status != solver::Status::ok && solver_status != solver::Status::iteration_limit) return false;
  scheduler.observe(solution);
  wanted = solution.tau;
  friction.add_to(wanted, sample.state);
  return true;
}

void Runner::Parts::brake_protectively(bool good_sample) noexcept {
  ++stopped_ticks;
  const solver::MotionVector& twist = estimated.state.base_twist;
  const bool at_rest =
      good_sample && twist.linear.norm() < at_rest_speed && twist.angular.norm() < at_rest_turn;
  stands = stands || at_rest || static_cast<double>(stopped_ticks) * period > longest_stop;
}

Runner::Runner(const lang::Program& program, const RunnerSettings& settings)
    : parts_(std::make_unique<Parts>(program, settings)) {}
Runner::~Runner() = default;
Runner::Runner(Runner&&) noexcept = default;
Runner& Runner::operator=(Runner&&) noexcept = default;

const Eigen::VectorXd& Runner::step(const Sensed& sensed, std::span<const double> extra) noexcept {
  Parts& p = *parts_;
  const bool good = p.guard.admit(sensed) == SampleStatus::good;
  bool solved = false;
  if (good) p.estimate(sensed);
  if (good && !p.guard.stopped()) {
    solved = p.control();
    if (!solved) p.guard.stop(StopReason::solver);
  }
  p.guard_status = good ? p.guard.output(p.estimated, p.wanted, p.tau) : p.guard.output_blind(p.tau);
  if (p.guard.stopped()) p.brake_protectively(good);
  if (solved) {
    p.shortfall =
        find_shortfall(p.statements, p.scheduler.constraints(), p.scheduler.in_force(), p.solver, p.solution);
    p.limits.update(p.statements, p.scheduler.constraints(), p.scheduler.in_force(), p.solution, p.tau);
  }
  if (p.recorder != nullptr) {
    const Tick tick{good ? p.estimated : sensed,
                    p.scheduler,
                    solved ? &p.scheduler.constraints() : nullptr,
                    p.solution,
                    p.solver_status,
                    p.guard_status,
                    p.tau,
                    extra,
                    p.shortfall};
    p.recorder->record(p.layout.fill(p.statements, tick));
  }
  return p.tau;
}

RunState Runner::state() const noexcept {
  if (parts_->guard.stopped()) return RunState::stopped;
  switch (parts_->scheduler.outcome()) {
    case Outcome::done:
      return RunState::done;
    case Outcome::failed:
      return RunState::failed;
    case Outcome::none:
      break;
  }
  return RunState::running;
}

bool Runner::finished() const noexcept {
  if (parts_->guard.stopped()) return parts_->stands;
  return parts_->scheduler.phase() == Phase::finished;
}

std::vector<Column> Runner::columns() const {
  return parts_->layout.columns();
}
void Runner::record_to(Recorder* recorder) noexcept {
  parts_->recorder = recorder;
}
const Scheduler& Runner::scheduler() const noexcept {
  return parts_->scheduler;
}
const SafetyGuard& Runner::guard() const noexcept {
  return parts_->guard;
}
SafetyGuard& Runner::guard() noexcept {
  return parts_->guard;
}
const solver::Solution& Runner::solution() const noexcept {
  return parts_->solution;
}
GuardStatus Runner::guard_status() const noexcept {
  return parts_->guard_status;
}
solver::Status Runner::solver_status() const noexcept {
  return parts_->solver_status;
}
const std::vector<Transition>& Runner::transitions() const noexcept {
  return parts_->transitions;
}
std::uint64_t Runner::transition_count() const noexcept {
  return parts_->transition_count;
}
std::optional<ShortfallReport> Runner::shortfall() const {
  const Shortfall& s = parts_->shortfall;
  if (s.missed < 0) return std::nullopt;
  const auto name = [&](int statement, const Origin& origin) {
    const std::string part = parts_->scheduler.part_name(origin);
    const std::string& whole = parts_->statements.all()[static_cast<std::size_t>(statement)].name;
    return part.empty() ? whole : whole + "." + part;
  };
  ShortfallReport report;
  report.row = name(s.missed, s.origin);
  report.residual = s.residual;
  const Statement& missed = parts_->statements.all()[static_cast<std::size_t>(s.missed)];
  report.unit = unit_of(missed.says.axis, solver::Quantity::acceleration);
  for (int i = 0; i < s.count; ++i) {
    const Shortfall::Holder& by = s.held_by[static_cast<std::size_t>(i)];
    report.held_back_by.push_back(name(by.statement, by.origin));
  }
  return report;
}
bool Runner::set_parameter(const std::string& name, double value) noexcept {
  for (std::size_t i = 0; i < parts_->parameter_names.size(); ++i) {
    if (parts_->parameter_names[i] == name)
      return parts_->scheduler.set_parameter(static_cast<int>(i), value);
  }
  return false;
}
std::vector<LimitReport> Runner::limits() const {
  return parts_->limits.reports();
}
std::optional<LimitReport> Runner::limit_now() const {
  return parts_->limits.now();
}

}  // namespace zwang::runtime
