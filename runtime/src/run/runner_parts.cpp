#include "run/runner_parts.hpp"

#include <algorithm>
#include <stdexcept>

namespace zwang::runtime {

namespace {

constexpr std::size_t kept_transitions = 1024;
constexpr std::size_t kept_events = 1024;

std::vector<std::string> signal_names(const lang::Program& program) {
  std::vector<std::string> names;
  for (const lang::Signal& signal : program.signals) names.push_back("signal." + signal.name);
  return names;
}

std::vector<std::string> row_names(const StatementTable& statements) {
  std::vector<std::string> names;
  for (const Statement& statement : statements.all()) names.push_back(statement.name);
  return names;
}

double period_of(const lang::Robot& robot, const RunnerSettings& settings) {
  const double period = settings.period.value_or(robot.control_period);
  if (!(period >= lang::shortest_control_period && period <= lang::longest_control_period))
    throw std::invalid_argument("runner: the control period is not between 0.1 ms and 10 ms");
  return period;
}

}  // namespace

Runner::Parts::Parts(const lang::Program& program, const RunnerSettings& settings)
    : model(program.robot.model),
      period(period_of(program.robot, settings)),
      facts(facts_of(settings, period)),
      scheduler(program, period),
      solver(model, {.row_capacity = scheduler.row_capacity(),
                     .set_capacity = scheduler.set_capacity(),
                     .base_motion = true,
                     .every_acceleration = false}),
      solution(model, scheduler.row_capacity()),
      estimated(model),
      sample(model, program.signals.size()),
      odometry(model, {}, {.period = period}),
      friction(program.robot),
      press(model),
      arm(model),
      disturbance(program.robot, period),
      clock_rate(period),
      rates(model),
      frozen_wheel(program.robot),
      blind_budget(program.robot, BlindMotion::Part::wheels),
      blind_arm(program.robot, BlindMotion::Part::arm),
      hook_latch(program),
      motors(program.robot, period),
      slip(model),
      signs(model),
      wrenches(model),
      wrench_bound(program, period, lost_ticks(period)),
      signals(program.signals),
      snapshot(program),
      signal_watch(program),
      guard(program.robot,
            {.period = period, .max_lost_ticks = lost_ticks(period), .max_slew = settings.max_slew}),
      statements(scheduler, program),
      signal_words(event_signals(model, signal_names(program), row_names(statements))),
      limits(statements, program.robot),
      layout(statements, scheduler, model, program, signal_words, settings.extra_columns),
      given_parameters(scheduler.parameters()),
      handed_over(Eigen::VectorXd::Zero(model.joint_count())),
      wanted(Eigen::VectorXd::Zero(model.joint_count())),
      tau(Eigen::VectorXd::Zero(model.joint_count())),
      unknown_torque(tau),
      compensation(tau),
      command(model.joint_count()) {
  if (program.robot.drive.takes_velocity) drive.emplace(program.robot, period, scheduler.row_capacity());
  for (const lang::Output& output : program.outputs) output_names.push_back(output.name);
  command.outputs.assign(scheduler.outputs().begin(), scheduler.outputs().end());
  transitions.reserve(kept_transitions);
  events.reserve(kept_events);
  is_judged.resize(program.signals.size(), false);
  facts["task"] = program.path;
  for (const lang::Parameter& p : program.parameters) parameter_names.push_back(p.name);
}

}  // namespace zwang::runtime
