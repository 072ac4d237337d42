// From a sample to the command.
#include <algorithm>

#include "run/runner_parts.hpp"

namespace zwang::runtime {

namespace {

/// Whether the reason of a stop leaves samples, wheels and their motors to be trusted.
bool leaves_what_is_felt(EventCode reason) noexcept {
  return reason == EventCode::requested || reason == EventCode::watchdog || reason == EventCode::solver ||
         reason == EventCode::bad_torque;
}

}  // namespace

bool Runner::Parts::control() noexcept {
  sample.time = estimated.time;
  const bool is_virtual = drive && drive->has_virtual_robot();
  if (is_virtual && is_new_sample) {
    if (!project(drive->measured())) return false;
    compare(drive->measured());
  }
  if (!project(estimated.state)) return false;
  friction.follow(sample.state.q);
  if (!is_virtual && is_new_sample) compare(estimated.state);
  if (drive && drive->felt_force() != nullptr) scheduler.estimate_force(*drive->felt_force());
  if (guard.stopped()) return true;  // a motor is not to be trusted
  arm.bear(sample.state);            // it floats where nothing is said of it
  is_solution_of_rows = false;
  const bool was_finished = scheduler.phase() == Phase::finished;
  scheduler.tick(sample);
  if (!was_finished && scheduler.phase() == Phase::finished) {
    // A base that lets go of a wall moves a little. Where no encoder counts that, the wall may be gone.
    is_end_doubted = !scheduler.has_stood() || blind_budget.leans();
    if (is_end_doubted) tell_doubt(sample.time);
  }
  if (scheduler.transition()) {
    const Transition& t = *scheduler.transition();
    if (t.refusal == Refusal::require || t.refusal == Refusal::set)
      tell({EventCode::entry_refused, sample.time, -1, static_cast<double>(t.refused)});
    ++transition_count;
    turning_point.look(*scheduler.transition(), scheduler, limits);
    if (transitions.size() < transitions.capacity()) transitions.push_back(*scheduler.transition());
  }
  tell_excursion();
  if (!solve()) return false;
  wanted = solution.tau;
  if (!friction.empty()) {
    friction.update(sample.state.qd, press.look(solver, scheduler.row_sets(), solution));
    friction.compensate(wanted);
  }
  if (handed_over_for < handover) hand_over();
  return true;
}

bool Runner::Parts::project(const solver::State& state) noexcept {
  sample.state = state;
  solver_status = solver.project_velocity(sample.state);
  return solver_status == solver::Status::ok;
}

/// Until no norm in a plane is broken.
bool Runner::Parts::solve() noexcept {
  constexpr int most_rounds = 5;
  for (int round = 1;; ++round) {
    const bool is_filled = scheduler.fill_constraints();
    if (round == 1) {
      if (const auto refused = wrenches.look(scheduler.row_sets(), sample.state, sample.time)) tell(*refused);
    }
    solver_status = is_filled ? solver.solve(sample.state, scheduler.row_sets(), solution)
                              : solver::Status::capacity_exceeded;
    if (solver_status != solver::Status::ok && solver_status != solver::Status::iteration_limit) return false;
    scheduler.observe(solution);
    if (round == most_rounds || !scheduler.pose_broken_sides(solver, solution)) break;
  }
  scheduler.follow_up(solver);
  is_solution_of_rows = true;
  return true;
}

void Runner::Parts::hand_over() noexcept {
  if (handed_over_for <= 0.0) handed_over = tau - wanted;
  wanted += (1.0 - handed_over_for / handover) * handed_over;
  handed_over_for += period;
}

void Runner::Parts::send(bool good, bool solved) noexcept {
  if (good && blind_budget.takes_over()) {
    if (guard.stopped()) wanted.setZero();
    blind_budget.give_back(wanted);
  }
  if (good && blind_arm.takes_over()) blind_arm.give_back(wanted);
  if (good && !guard.stopped() && !drive && blind_budget.asks()) blind_budget.slacken(wanted);
  if (good && !guard.stopped() && !drive) frozen_wheel.ask(wanted);
  guard_status = good ? guard.output(estimated, wanted, tau) : guard.output_blind(tau);
  put_command(good, solved);
  if (solved && !guard.stopped() && !drive) {
    disturbance.expect(solver, solution, sample.state, friction.torque(), tau, sample.time);
    blind_budget.expect(disturbance, friction.torque(), tau, sample.state);
    blind_arm.expect(disturbance, friction.torque(), tau, sample.state);
    return;
  }
  if (good) disturbance.pause();
  if (!guard.stopped() || drive) return;
  blind_budget.expect_brake(tau);
  blind_arm.expect_brake(tau);
}

/// A sample that was refused leaves a drive's velocities and bounds as they are.
void Runner::Parts::put_command(bool good, bool solved) noexcept {
  if (guard.stopped()) scheduler.stop_outputs();
  std::ranges::copy(scheduler.outputs(), command.outputs.begin());
  if (!drive) {
    command.torque = command.lower = command.upper = tau;
    return;
  }
  if (guard.stopped()) {
    const bool is_contrary =
        guard.reason() == EventCode::not_followed || guard.reason() == EventCode::effort_lost;
    const int suspect = is_contrary ? event_signal::joint_of(guard.stop_event().signal) : -1;
    const bool is_measured = good && !is_a_wheel_dead;
    const bool is_felt =
        is_measured && leaves_what_is_felt(guard.reason()) && !drive->look_for_samples(estimated.time);
    drive->brake(is_measured ? &estimated.state.qd : nullptr, suspect, command, is_felt);
    tau.setZero();
  } else if (solved) {
    command.torque = tau;
    compensation = wanted - solution.tau;
    drive->drive(solver, scheduler, solution, sample.state, sample.time, compensation, command);
    if (scheduler.phase() == Phase::finished) drive->rest(command);
  }
}

bool Runner::Parts::control_or_stop() noexcept {
  const bool computed = control();
  if (!computed) guard.stop(EventCode::solver, -1, static_cast<double>(solver_status));
  return computed && !guard.stopped();
}

void Runner::Parts::keep_stop(bool good_sample) noexcept {
  if (guard.stopped()) {
    if (!stop_is_told) tell(guard.stop_event());
    stop_is_told = true;
    brake_protectively(good_sample);
    return;
  }
  stop_is_told = false;
  stopped_ticks = 0;
  rest.begin();
  is_past_stop = is_rest_doubted = is_obedience_told = false;
}

void Runner::Parts::brake_protectively(bool good_sample) noexcept {
  ++stopped_ticks;
  if (guard.motor_obeyed() && !is_obedience_told) {
    is_obedience_told = true;
    tell({EventCode::motor_obeyed, guard.time(), guard.stop_event().signal, guard.stop_event().value});
  }
  // Where one wheel's encoder is dead, the others do not tell how the base moves.
  if (good_sample && !is_a_wheel_dead && !blind_budget.takes_over() && !blind_arm.takes_over()) {
    rest.look(estimated.state.base_twist, period);
  } else {
    rest.doubt();
  }
  if (drive && drive->moves(command)) return;  // it is told less from tick to tick
  if (rest.stood_for() >= rest_dwell) is_past_stop = true;
  const double stopped_for = static_cast<double>(stopped_ticks) * period;
  if (is_past_stop || stopped_for <= longest_stop) return;
  is_past_stop = is_rest_doubted = true;
  tell_doubt(guard.stop_event().time + stopped_for);  // no sample's: none may have been good since
}

}  // namespace zwang::runtime
