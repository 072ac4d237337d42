#include "zwang/runtime/runner.hpp"

#include "drive/led_program.hpp"
#include "run/runner_parts.hpp"

namespace zwang::runtime {

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
