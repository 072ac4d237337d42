#include "zwang/runtime/runner.hpp"

#include "drive/led_program.hpp"
#include "run/runner_parts.hpp"

namespace zwang::runtime {

namespace {

/// Two ticks where the robot starts: the first one switches into the task, the second one blends.
void take_two_ticks(Runner& runner, const lang::Program& program) {
  Sensed sensed(program);
  sensed.state = lang::start_state(program.robot);
  sensed.base_measured = true;
  for (int tick = 0; tick < 2; ++tick) {
    runner.step(sensed);
    sensed.time += runner.period();
  }
}

}  // namespace

/// A tick that no tick came before waits for its code and its memory, ten times as long as it computes. So
/// parts that nobody keeps take the first ticks, and those that are kept come to lie where they lay.
Runner::Runner(const lang::Program& program, const RunnerSettings& settings) {
  const lang::Program led = led_program(program);
  parts_ = std::make_unique<Parts>(led, settings);
  take_two_ticks(*this, program);
  parts_.reset();
  parts_ = std::make_unique<Parts>(led, settings);
}
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
  p.tell_refusal(status);
  p.tell_of_host();
  if (status != SampleStatus::not_finite) p.judge_clock(sensed);

  if (good) p.estimate(sensed);
  if (is_timely) {
    p.judge_sensors();
    p.judge_snapshot(sensed);
  }
  if (good) p.judge_wrenches();

  const bool solved = good && !p.guard.stopped() && p.control_or_stop();
  p.send(good, solved);
  p.keep_stop(good);
  if (solved) p.follow_limits();
  if (p.recorder != nullptr) p.record(sensed, good, solved, extra);
  return p.tau;
}

}  // namespace zwang::runtime
