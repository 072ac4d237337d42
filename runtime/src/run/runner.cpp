#include "zwang/runtime/runner.hpp"

#include <algorithm>
#include <limits>

#include "drive/led_program.hpp"
#include "drive/velocity_drive.hpp"
#include "estimate/disturbance.hpp"
#include "estimate/friction.hpp"
#include "estimate/press.hpp"
#include "estimate/ticks.hpp"
#include "guard/blind_budget.hpp"
#include "guard/clock_rate.hpp"
#include "guard/frozen_wheel.hpp"
#include "guard/hook_latch.hpp"
#include "guard/joint_rates.hpp"
#include "guard/motor_watch.hpp"
#include "guard/slip_watch.hpp"
#include "guard/wheel_signs.hpp"
#include "guard/wrench_bound.hpp"
#include "guard/wrench_refusal.hpp"
#include "run/limit_table.hpp"
#include "run/log_layout.hpp"
#include "run/run_facts.hpp"
#include "run/shortfall.hpp"
#include "run/signal_watch.hpp"
#include "run/snapshot_signals.hpp"
#include "run/statement_table.hpp"
#include "run/why.hpp"
#include "schedule/at_rest.hpp"
#include "zwang/runtime/odometry.hpp"
#include "zwang/runtime/with_unit.hpp"
#include "zwang/solver/joint_loads.hpp"

namespace zwang::runtime {

namespace {

constexpr std::size_t kept_transitions = 1024;
constexpr std::size_t kept_events = 1024;
constexpr double start_window = 0.05;  // [s] in which a force sensor that touches nothing is judged
constexpr double quiet_sensor = 5.0;   // [N] that it may read then

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

namespace {

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

/// On the floor, whose normal is the world's z: roll and pitch of the body on its springs are no slope that
/// it could roll down.
solver::Pose level(const solver::Pose& pose) {
  const double yaw = solver::yaw_of(pose.rotation);
  return {Eigen::AngleAxisd(yaw, solver::Vector3::UnitZ()).toRotationMatrix(), pose.position};
}

double period_of(const lang::Robot& robot, const RunnerSettings& settings) {
  const double period = settings.period.value_or(robot.control_period);
  if (!(period >= lang::shortest_control_period && period <= lang::longest_control_period))
    throw std::invalid_argument("runner: the control period is not between 0.1 ms and 10 ms");
  return period;
}

/// That are ridden through: 20, and 50 ms of them, but 4 of any.
int lost_ticks(double period) {
  constexpr int most = 20, least = 5;
  constexpr double longest = 0.05;  // [s]
  return std::clamp(ticks_of(longest, period), least, most);
}

}  // namespace

struct Runner::Parts {
  Parts(const lang::Program& program, const RunnerSettings& settings)
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
        blind_budget(program.robot),
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

  /// What is known of a good sample: itself, or with the base as the wheels tell it.
  void estimate(const Sensed& sensed) noexcept;
  /// The same of a drive whose samples come now and then.
  void estimate_between_samples(const Sensed& sensed) noexcept;
  /// [s] by the guard's clock.
  double measured_at(const Sensed& sensed) const noexcept;
  void estimate_base(const Sensed& sensed, double time) noexcept;
  /// `tau` and, of a drive that takes velocities, what it is told beside.
  void put_command(bool good, bool solved) noexcept;
  void take_signals(const Sensed& sensed) noexcept;
  void judge_clock(const Sensed& sensed) noexcept;
  void mend_rates() noexcept;
  /// Whether encoders confirm what the motors were told.
  void confirm() noexcept;
  /// The torques to send, or the brake's; and what is expected of them.
  void send(bool good, bool solved) noexcept;
  /// Everything between that and the guard. False when there are no torques to send.
  bool control() noexcept;
  bool solve() noexcept;
  /// `state` as the ground allows it, in the sample. False when the solver cannot.
  bool project(const solver::State& state) noexcept;
  /// What motors and wheels made of the last command; `measured`: the sample before it was projected.
  void compare(const solver::State& measured) noexcept;
  /// After a swap of programs: what was sent last fades out of the torques.
  void hand_over() noexcept;
  bool has_the_joints_of(const Parts& other) const noexcept;
  void take_events_of(Parts& before) noexcept;
  void take_outputs_of(const Parts& before) noexcept;
  void take_motion_of(const Command& before) noexcept;
  void judge_sensors() noexcept;
  void judge_wrenches() noexcept;
  bool blends() const noexcept { return scheduler.set_count() > 1; }
  void tell(const Event& event) noexcept;
  void tell_excursion() noexcept;
  void tell_doubt() noexcept;
  /// The protective stop, where a watch found something.
  void stop(const std::optional<Event>& found) noexcept;
  void tell_refusal(SampleStatus status) noexcept;
  void brake_protectively(bool good_sample) noexcept;
  /// What presses on the base at its origin, in its axes: felt, or estimated.
  const solver::Vector3& force_on_base() const noexcept {
    const solver::Vector3* felt = drive ? drive->felt_force() : nullptr;
    return felt != nullptr ? *felt : disturbance.base_force();
  }
  /// Of the last tick that was solved.
  Shortfall find_shortfall() const noexcept;

  const solver::Model model;
  std::vector<std::string> parameter_names;
  std::vector<std::string> output_names;
  double period;
  RunFacts facts;  ///< but for the parameters
  Scheduler scheduler;
  solver::Solver solver;
  solver::Solution solution;
  bool is_solution_of_rows = false;  ///< `solution` answers the constraints that the scheduler holds
  Sensed estimated;                  ///< the last good sample, but for its signals
  Sensed sample;                     ///< the same, its velocities as the ground allows them, and its signals
  Odometry odometry;
  std::optional<double> start;  ///< [s] of the first good sample
  bool reckoning = false;       ///< the base is not measured: `odometry` tells it
  double last_fix = -std::numeric_limits<double>::infinity();  ///< [s]
  FrictionEstimate friction;
  Press press;
  solver::JointLoads arm;
  DisturbanceObserver disturbance;
  ClockRate clock_rate;
  JointRates rates;
  FrozenWheel frozen_wheel;
  BlindBudget blind_budget;
  HookLatch hook_latch;
  MotorWatch motors;
  SlipWatch slip;
  WheelSigns signs;
  WrenchRefusal wrenches;
  WrenchBound wrench_bound;
  const std::vector<lang::Signal> signals;
  SnapshotSignals snapshot;  ///< where they are in it
  SignalWatch signal_watch;
  std::vector<bool> is_judged;  ///< of each signal: it was looked at when the run began
  std::vector<Event> events;
  std::uint64_t event_count = 0;
  bool stop_is_told = false;
  EventCode told_refusal = EventCode::none;  ///< of the last sample; `none` when it was taken
  Event event;                               ///< of this tick; code `none` when there is none
  SafetyGuard guard;
  StatementTable statements;
  const std::vector<std::string> signal_words;  ///< of events
  LimitTable limits;
  LogLayout layout;
  std::vector<double> given_parameters;  ///< as they stood when the tick began
  Recorder* recorder = nullptr;
  Eigen::VectorXd handed_over;        ///< what the torques differ by at a swap of programs
  double handed_over_for = handover;  ///< [s] since then
  Eigen::VectorXd wanted;             ///< the solution's torques and the friction's
  Eigen::VectorXd tau;                ///< sent
  Eigen::VectorXd unknown_torque;     ///< of the motors behind velocity loops: 0
  Eigen::VectorXd compensation;       ///< of it, against friction
  std::optional<VelocityDrive> drive;
  bool is_new_sample = true;
  Command command;
  solver::Status solver_status = solver::Status::ok;
  GuardStatus guard_status = GuardStatus::passed;
  std::vector<Transition> transitions;
  std::uint64_t transition_count = 0;
  TurningPoint turning_point;
  std::uint64_t stopped_ticks = 0;
  bool is_a_wheel_dead = false;  ///< the stop is for its encoder
  RestWatch rest;                ///< after a protective stop
  bool is_past_stop = false;     ///< a protective stop is over, by its time if not by rest
  bool is_rest_doubted = false;  ///< and nobody saw the base stand
};

void Runner::Parts::estimate(const Sensed& sensed) noexcept {
  const double time = guard.time();
  estimated.time = time;
  estimated.state = sensed.state;
  if (drive) return estimate_between_samples(sensed);
  stop(rates.look(estimated.state, time));
  const auto dead_wheel = frozen_wheel.look(estimated.state, tau, time);
  is_a_wheel_dead = guard.stopped() ? is_a_wheel_dead : dead_wheel.has_value();
  stop(dead_wheel);
  take_signals(sensed);
  confirm();
  if (guard.stopped()) mend_rates();
  estimate_base(sensed, time);
}

double Runner::Parts::measured_at(const Sensed& sensed) const noexcept {
  const double now = guard.time();
  if (!sensed.measured_at) return now;
  const double stamp = *sensed.measured_at + guard.clock_shift();
  return stamp <= now + 0.5 * period ? stamp : -std::numeric_limits<double>::infinity();
}

void Runner::Parts::estimate_between_samples(const Sensed& sensed) noexcept {
  const double stamp = measured_at(sensed);
  is_new_sample = drive->is_new(stamp) && drive->can_feel(sensed);
  if (is_new_sample) {
    stop(rates.look(estimated.state, stamp));
    const auto dead_wheel = frozen_wheel.look(estimated.state, unknown_torque, stamp);
    is_a_wheel_dead = guard.stopped() ? is_a_wheel_dead : dead_wheel.has_value();
    stop(dead_wheel);
    if (guard.stopped()) mend_rates();
    estimate_base(sensed, stamp);
    stop(drive->look(estimated.state, stamp));
    drive->take(estimated.state, stamp);
    drive->feel(sensed, stamp);
  } else {
    stop(drive->look_for_samples(estimated.time));
  }
  take_signals(sensed);
  drive->carry_on(estimated.time, estimated.state);
  if (drive->has_virtual_robot()) drive->put_virtual(estimated.time, guard.stopped(), estimated.state);
}

void Runner::Parts::estimate_base(const Sensed& sensed, double time) noexcept {
  solver::Pose& base = estimated.state.base_pose;
  const bool is_new = sensed.base_measured || !reckoning;
  if (is_new && model.base_type() == solver::BaseType::ground) base = level(base);
  if (sensed.base_measured) {
    reckoning = false;
    return;
  }
  if (!reckoning) odometry.start_at(base);
  reckoning = true;
  if (sensed.base_fix) {
    const double stamp = sensed.base_fix->stamp + guard.clock_shift();
    // One that is stamped ahead must not keep out those that follow.
    if (stamp > last_fix && stamp <= time + 0.5 * period) {
      last_fix = stamp;
      odometry.correct(last_fix, sensed.base_fix->pose);
    }
  }
  odometry.update(time, estimated.state);
}

/// A snapshot of another size was not laid out for these signals: no sample has come.
void Runner::Parts::take_signals(const Sensed& sensed) noexcept {
  sample.time = guard.time();
  if (sensed.signals.size() != snapshot.size()) {
    for (SignalSample& nothing : sample.signals) nothing.valid = false;
    return;
  }
  for (std::size_t i = 0; i < sample.signals.size(); ++i) {
    sample.signals[i] = sensed.signals[snapshot.places()[i]];
    sample.signals[i].stamp += guard.clock_shift();
  }
}

void Runner::Parts::judge_clock(const Sensed& sensed) noexcept {
  if (guard.stopped()) return clock_rate.begin();
  const auto found = clock_rate.look(sensed.time);
  if (found && latches_the_stop(found->code)) {
    guard.stop(found->code, found->signal, found->value);
  } else if (found) {
    tell(*found);
  }
}

void Runner::Parts::confirm() noexcept {
  if (blind_budget.is_blind() && !guard.stopped()) blind_budget.begin();  // the stop was reset
  hook_latch.look(sample, scheduler.parameters(), blind_budget);
  const std::optional<Event> found = blind_budget.look(estimated.state.q, estimated.time);
  if (found && found->code == EventCode::probed) tell(*found);
  if (found) stop(found);
  guard.brake_by_model(blind_budget.takes_over());
}

void Runner::Parts::send(bool good, bool solved) noexcept {
  if (good && blind_budget.takes_over()) {
    if (guard.stopped()) wanted.setZero();
    blind_budget.give_back(wanted);
  }
  guard_status = good ? guard.output(estimated, wanted, tau) : guard.output_blind(tau);
  put_command(good, solved);
  if (solved && !guard.stopped() && !drive) {
    disturbance.expect(solver, solution, sample.state, friction.torque(), tau, sample.time);
    blind_budget.expect(disturbance, friction.torque(), tau);
    return;
  }
  if (good) disturbance.pause();
  if (guard.stopped() && !drive) blind_budget.expect_brake(tau);
}

/// A stop for rates that are wrong is over when the base stands by those that are not.
void Runner::Parts::mend_rates() noexcept {
  Eigen::VectorXd& qd = estimated.state.qd;
  if (guard.reason() == EventCode::rate_contradicts) rates.mend(qd);
  if (guard.reason() != EventCode::wheel_reversed) return;
  const int joint = event_signal::joint_of(guard.stop_event().signal);
  qd(joint) = -qd(joint);
}

bool Runner::Parts::project(const solver::State& state) noexcept {
  sample.state = state;
  solver_status = solver.project_velocity(sample.state);
  return solver_status == solver::Status::ok;
}

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
  if (!was_finished && scheduler.phase() == Phase::finished && !scheduler.has_stood()) tell_doubt();
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

bool Runner::Parts::has_the_joints_of(const Parts& other) const noexcept {
  if (!model.has_joints_of(other.model)) return false;
  if (drive.has_value() != other.drive.has_value()) return false;
  return !drive || drive->has_virtual_robot() == other.drive->has_virtual_robot();
}

void Runner::Parts::tell(const Event& told) noexcept {
  ++event_count;
  if (events.size() < events.capacity()) events.push_back(told);
  const bool is_stop = latches_the_stop(told.code);
  if (event.code == EventCode::none || is_stop) event = told;
}

void Runner::Parts::tell_excursion() noexcept {
  const std::optional<Excursion>& excursion = scheduler.excursion();
  if (!excursion) return;
  const int row = statements.id(excursion->origin);
  tell({EventCode::outside, sample.time,
        event_signal::of_row(model.joint_count(), static_cast<int>(signals.size()), row),
        excursion->distance});
}

/// Under a clock of another rate all that is computed with dt is wrong, and accuses motors and encoders.
void Runner::Parts::stop(const std::optional<Event>& found) noexcept {
  if (!found) return;
  if (clock_rate.is_off()) return guard.stop(EventCode::clock_rate, event_signal::time, clock_rate.rate());
  guard.stop(found->code, found->signal, found->value);
}

/// Samples that are refused one after the other for one reason are one event.
void Runner::Parts::tell_refusal(SampleStatus status) noexcept {
  const EventCode refusal = status == SampleStatus::bad_clock ? guard.refusal().code : EventCode::none;
  if (refusal != EventCode::none && refusal != told_refusal) tell(guard.refusal());
  told_refusal = refusal;
}

void Runner::Parts::compare(const solver::State& measured) noexcept {
  if (const auto begins = slip.look(measured, sample.state, sample.time)) tell(*begins);
  if (!slip.doubtful()) {
    signs.roll(solver, measured, sample.state, reckoning, sample.time);
  } else {
    stop(signs.look(solver, measured, sample.state, reckoning, sample.time));
  }
  if (!disturbance.compare(sample.state, sample.time)) {
    motors.reset();
    return;
  }
  scheduler.estimate_force(disturbance.base_force());
  scheduler.estimate_wrenches(disturbance.motions(), disturbance.force(), period);
  // A wheel that slides gives the ground less than its motor gives the wheel; what no encoder tells, tells
  // nothing of a motor.
  if (slip.doubtful() || blind_budget.takes_over()) {
    motors.reset();
    return;
  }
  stop(motors.look(disturbance, sample.state, tau, scheduler.constraints(), blends()));
}

/// A force that is measured before anything moved is the sensor's own.
void Runner::Parts::judge_sensors() noexcept {
  const double time = estimated.time;
  if (!start) start = time;
  if (time - *start > start_window) return;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const SignalSample& measured = sample.signals[i];
    if (is_judged[i] || !measured.valid) continue;
    is_judged[i] = true;
    double reads = 0.0;
    if (signals[i].type == lang::SignalType::wrench) reads = measured.wrench.linear.norm();
    if (signals[i].measures_force) reads = measured.number;
    if (!(std::abs(reads) > quiet_sensor)) continue;
    tell({EventCode::sensor_bias, time, event_signal::measured(model.joint_count(), static_cast<int>(i)),
          reads});
  }
}

/// Behind `estimate`, which knows the speed that a hit may have.
void Runner::Parts::judge_wrenches() noexcept {
  const auto found = wrench_bound.look(estimated.state, sample.signals, estimated.time);
  if (!found) return;
  tell(*found);
  if (wrench_bound.is_due()) guard.stop(found->code, found->signal, found->value);
}

Shortfall Runner::Parts::find_shortfall() const noexcept {
  if (!is_solution_of_rows) return {};
  return runtime::find_shortfall(statements, scheduler.constraints(), scheduler.in_force(), solver, solution);
}

void Runner::Parts::brake_protectively(bool good_sample) noexcept {
  ++stopped_ticks;
  // Where one wheel's encoder is dead, the others do not tell how the base moves.
  if (good_sample && !is_a_wheel_dead && !blind_budget.takes_over()) {
    rest.look(estimated.state.base_twist, period);
  } else {
    rest.doubt();
  }
  if (drive && drive->moves(command)) return;  // it is told less from tick to tick
  if (rest.stood_for() >= rest_dwell) is_past_stop = true;
  if (is_past_stop || static_cast<double>(stopped_ticks) * period <= longest_stop) return;
  is_past_stop = is_rest_doubted = true;
  tell_doubt();
}

/// The longest time of a stop is over.
void Runner::Parts::tell_doubt() noexcept {
  tell({EventCode::not_at_rest, estimated.time, event_signal::base_twist,
        estimated.state.base_twist.linear.norm()});
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
    const bool is_contrary = guard.reason() == EventCode::not_followed;
    const int suspect = is_contrary ? event_signal::joint_of(guard.stop_event().signal) : -1;
    drive->brake(good && !is_a_wheel_dead ? &estimated.state.qd : nullptr, suspect, command);
    tau.setZero();
  } else if (solved) {
    command.torque = tau;
    compensation = wanted - solution.tau;
    drive->drive(solver, scheduler, solution, sample.state, sample.time, compensation, command);
    if (scheduler.phase() == Phase::finished) drive->rest(command);
  }
}

Runner::Runner(const lang::Program& program, const RunnerSettings& settings)
    : parts_(std::make_unique<Parts>(led_program(program), settings)) {}
Runner::~Runner() = default;
Runner::Runner(Runner&&) noexcept = default;
Runner& Runner::operator=(Runner&&) noexcept = default;

const Eigen::VectorXd& Runner::step(const Sensed& sensed, std::span<const double> extra) noexcept {
  Parts& p = *parts_;
  p.event = {};
  if (p.recorder != nullptr) p.given_parameters = p.scheduler.parameters();
  const SampleStatus status = p.guard.admit(sensed);
  const bool is_timely = status == SampleStatus::good;
  const bool good = is_timely || status == SampleStatus::untimely;
  bool solved = false;
  p.tell_refusal(status);
  if (status != SampleStatus::not_finite) p.judge_clock(sensed);
  if (good) p.estimate(sensed);
  if (is_timely) {
    p.judge_sensors();
    if (const auto refused = p.signal_watch.look(sensed, p.snapshot.size(), p.sample)) p.tell(*refused);
  }
  if (good) p.judge_wrenches();
  if (good && !p.guard.stopped()) {
    const bool computed = p.control();
    if (!computed) p.guard.stop(EventCode::solver, -1, static_cast<double>(p.solver_status));
    solved = computed && !p.guard.stopped();
  }
  p.send(good, solved);
  if (!p.guard.stopped()) {
    p.stop_is_told = false;
    p.stopped_ticks = 0;
    p.rest.begin();
    p.is_past_stop = p.is_rest_doubted = false;
  }
  if (p.guard.stopped() && !p.stop_is_told) {
    p.stop_is_told = true;
    p.tell(p.guard.stop_event());
  }
  if (p.guard.stopped()) p.brake_protectively(good);
  if (solved) {
    p.limits.update(p.statements, p.scheduler.constraints(), p.scheduler.in_force(), p.solution, p.tau,
                    p.blends());
  }
  if (p.recorder != nullptr) {
    const Shortfall shortfall = p.find_shortfall();
    const Tick tick{sensed,
                    p.given_parameters,
                    good ? p.estimated : sensed,
                    p.scheduler,
                    solved,
                    p.solution,
                    p.solver_status,
                    p.guard_status,
                    p.tau,
                    p.command,
                    extra,
                    shortfall,
                    p.event,
                    p.force_on_base(),
                    p.slip.speed()};
    p.recorder->record(p.layout.fill(p.statements, tick));
  }
  return p.tau;
}

/// Their signals are those of the program that runs now.
void Runner::Parts::take_events_of(Parts& before) noexcept {
  events.swap(before.events);
  std::swap(event_count, before.event_count);
  for (Event& told : events) {
    const auto was = static_cast<std::size_t>(told.signal);
    if (told.signal < 0 || was >= before.signal_words.size()) continue;
    const auto now = std::find(signal_words.begin(), signal_words.end(), before.signal_words[was]);
    told.signal = now == signal_words.end() ? -1 : static_cast<int>(now - signal_words.begin());
  }
}

/// What motors were told last; outputs are each program's own.
void Runner::Parts::take_motion_of(const Command& before) noexcept {
  command.torque = before.torque;
  command.velocity = before.velocity;
  command.lower = before.lower;
  command.upper = before.upper;
  command.twist = before.twist;
}

/// Those of the same name stay as they are: a gripper does not open because a file was saved.
void Runner::Parts::take_outputs_of(const Parts& before) noexcept {
  for (std::size_t i = 0; i < output_names.size(); ++i) {
    const auto was = std::ranges::find(before.output_names, output_names[i]);
    if (was == before.output_names.end()) continue;
    const auto k = static_cast<std::size_t>(was - before.output_names.begin());
    scheduler.set_output(static_cast<int>(i), before.scheduler.outputs()[k]);
  }
}

SwapResult Runner::swap_program(Runner& next) noexcept {
  if (parts_->guard.stopped()) return {SwapRefusal::stopped};
  if (next.parts_->scheduler.task() >= 0) return {SwapRefusal::has_run};
  if (!next.parts_->has_the_joints_of(*parts_)) return {SwapRefusal::joints};
  if (next.parts_->period != parts_->period) return {SwapRefusal::period};
  const SwapResult matched = next.parts_->snapshot.match(parts_->snapshot);
  if (!matched) return matched;
  std::swap(parts_, next.parts_);
  Parts& now = *parts_;
  Parts& before = *next.parts_;
  std::swap(now.guard, before.guard);
  std::swap(now.odometry, before.odometry);
  std::swap(now.clock_rate, before.clock_rate);
  std::swap(now.rates, before.rates);
  std::swap(now.frozen_wheel, before.frozen_wheel);
  std::swap(now.blind_budget, before.blind_budget);
  now.hook_latch.take_over(before.hook_latch);
  std::swap(now.slip, before.slip);
  std::swap(now.friction, before.friction);
  now.reckoning = before.reckoning;
  now.last_fix = before.last_fix;
  now.start = before.start;
  now.take_events_of(before);
  now.wrench_bound.go_on_from(before.wrench_bound);
  now.snapshot.go_on_from(before.snapshot);
  now.layout.signals_at(now.snapshot.places());
  now.take_outputs_of(before);
  now.disturbance.pause();
  now.motors.reset();
  now.tau = before.tau;
  now.take_motion_of(before.command);
  if (now.drive) now.drive->go_on_from(*before.drive);
  now.handed_over_for = 0.0;
  now.recorder = nullptr;
  return {};
}

const Command& Runner::command() const noexcept {
  return parts_->command;
}

std::span<const double> Runner::outputs() const noexcept {
  return parts_->command.outputs;
}

double Runner::period() const noexcept {
  return parts_->period;
}

std::map<std::string, std::string> Runner::facts() const {
  RunFacts facts = parts_->facts;
  for (std::size_t i = 0; i < parts_->parameter_names.size(); ++i)
    facts["params." + parts_->parameter_names[i]] = exactly(parts_->scheduler.parameters()[i]);
  return facts;
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
  if (parts_->guard.stopped()) return parts_->is_past_stop;
  return parts_->scheduler.phase() == Phase::finished;
}

bool Runner::may_still_move() const noexcept {
  if (parts_->guard.stopped()) return parts_->is_rest_doubted;
  return finished() && !parts_->scheduler.has_stood();
}

std::string Runner::because() const {
  std::string words;
  if (parts_->guard.stopped()) words = describe(parts_->guard.reason());
  if (may_still_move()) words += (words.empty() ? "" : "; ") + std::string(unseen_rest);
  return words;
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
const std::vector<Event>& Runner::events() const noexcept {
  return parts_->events;
}
std::uint64_t Runner::event_count() const noexcept {
  return parts_->event_count;
}
std::string Runner::event_signal(const Event& event) const {
  const auto i = static_cast<std::size_t>(event.signal);
  return event.signal >= 0 && i < parts_->signal_words.size() ? parts_->signal_words[i] : std::string();
}
solver::Vector3 Runner::estimated_force() const noexcept {
  return parts_->force_on_base();
}
std::optional<ShortfallReport> Runner::shortfall() const {
  const Shortfall s = parts_->find_shortfall();
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
bool Runner::set_parameter(std::string_view name, double value) noexcept {
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

std::optional<Why> Runner::why() const {
  if (state() == RunState::done) return std::nullopt;
  const Parts& p = *parts_;
  const bool is_decided = !p.guard.stopped() && p.turning_point.found();
  EndOfRun end{.scheduler = p.scheduler,
               .turning_point = p.turning_point,
               .file = p.facts.at("task"),
               .time = p.guard.time(),
               .limit = p.limits.report_of(is_decided ? p.turning_point.limit() : p.limits.tightest()),
               .stop = {},
               .refused = {}};
  if (p.guard.stopped()) end.stop = describe_stop();
  const double until = is_decided ? p.turning_point.found()->time : end.time;
  const int first = event_signal::measured(p.model.joint_count(), 0);
  std::vector<EventCode> kinds;  // the first of a kind is enough
  for (const Event& told : p.events) {
    if (told.code == EventCode::signal_refused && told.signal >= first) {
      end.refused.push_back({p.signals[static_cast<std::size_t>(told.signal - first)].name, told.value});
    } else if (!latches_the_stop(told.code) && std::ranges::find(kinds, told.code) == kinds.end() &&
               told.time <= until) {
      kinds.push_back(told.code);
      end.told.push_back("the guard told at " + with_unit(told.time, "s") + ": " + describe(told.code));
    }
  }
  return why_of(end);
}

/// With the signal that told it, and what that read.
std::string Runner::describe_stop() const {
  const Event& stop = parts_->guard.stop_event();
  const std::string signal = event_signal(stop);
  return std::string(describe(stop.code)) + (signal.empty() ? "" : " (`" + signal + "`)");
}

}  // namespace zwang::runtime
