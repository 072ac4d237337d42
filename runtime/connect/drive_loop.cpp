#include "drive_loop.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "../cli/interruption.hpp"
#include "arguments.hpp"
#include "frozen_base.hpp"
#include "overrun.hpp"
#include "zwang/runtime/watchdog.hpp"

namespace zwang::connect {

namespace {

using runtime::EventCode;

constexpr double blocked_for = 0.2;  // [s] without a tick: the thread hangs, and zeros go out without it
constexpr double too_late = 0.1;     // [s] a tick that is so late is a stop
constexpr double longest_brake = lang::given_up_after;  // [s] behind a signal, or where the robot is silent
constexpr double nearly_a_period = 0.7;
constexpr double told_rounding = 1e-3;  // of a period
constexpr double look_again = 0.5e-3;   // [s] at a clock that is told

class Loop {
 public:
  Loop(const lang::Connection& connection, const lang::Program& program, Inbox& inbox, Outbox& outbox,
       Control& control, runtime::Runner& runner, DriveReport& report)
      : connection_(connection),
        program_(program),
        inbox_(inbox),
        outbox_(outbox),
        control_(control),
        runner_(runner),
        report_(report),
        sensed_(program),
        frozen_base_(program.robot.model, connection.joints.stale_after),
        takes_velocity_(program.robot.drive.takes_velocity),
        period_(runner.period()),
        send_every_(1.0 / connection.command.rate.value_or(1.0 / period_)) {}

  void run() {
    runtime::Watchdog watchdog(blocked_for, [this] {
      outbox_.send_zeros(now());
      static constexpr char text[] = "zwang drive: the loop was blocked for 0.2 s; zeros were sent\n";
      [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof(text) - 1);
      _exit(exit_bad);
    });
    watchdog_ = &watchdog;
    begin_ = now();
    due_ = inbox_.clock().time();
    inbox_.fill(sensed_);
    sensed_.time = report_.first_sample = inbox_.joints().stamp;
    while (!runner_.finished()) {
      watchdog.feed();
      takes_velocity_ ? wait_for_clock() : wait_for_sample();
      watchdog.feed();
      judge();
      if (give_up_ && now() > *give_up_) break;
      step();
    }
    report_.elapsed = now() - begin_;
    report_.ended_early = !runner_.finished();
  }

 private:
  void wait_for_clock() {
    due_ += period_;
    const bool is_due = wait_until_due();
    inbox_.fill(sensed_);
    sensed_.time = inbox_.clock().time();
    sensed_.measured_at = inbox_.joints().stamp;
    if (!is_due) {
      ++report_.without_new;  // the guard counts it as lost
      due_ = sensed_.time;
      return;
    }
    const double late = std::max(0.0, sensed_.time - due_);
    const double missed = std::floor(late / period_);
    note(late, missed);
    due_ += missed * period_;
  }

  /// By the robot's clock. False: it stands.
  bool wait_until_due() {
    const RobotClock& clock = inbox_.clock();
    if (!clock.is_told()) {
      sleep_until(due_);
      return true;
    }
    // The robot's clock comes in steps: a tick that falls short by rounding is due.
    while (clock.time() < due_ - told_rounding * period_) {
      if (clock.stands(now()) || cli::is_interrupted()) {
        sleep_until(now() + period_);  // the stop takes its time, though its clock does not
        return false;
      }
      sleep_until(now() + look_again);
      watchdog_->feed();
    }
    return true;
  }

  /// Samples may come more often than the control period: those between are passed over.
  void wait_for_sample() {
    const RobotClock& clock = inbox_.clock();
    const double last = inbox_.joints().stamp, until = clock.time() + 1.5 * period_;
    bool is_new = false;
    while (!is_new && clock.time() < until && !clock.stands(now())) {
      if (inbox_.wait_for_joints(clock.is_told() ? now() + look_again : until)) {
        inbox_.fill(sensed_);
        is_new = inbox_.joints().stamp - last > nearly_a_period * period_;
      }
      watchdog_->feed();
    }
    if (!is_new) {
      ++report_.without_new;  // the guard counts it as lost
      return;
    }
    const double missed =
        has_stepped_ ? std::max(0.0, std::round((inbox_.joints().stamp - last) / period_) - 1.0) : 0.0;
    note(now() - inbox_.joints().arrival, missed);
    sensed_.time = inbox_.joints().stamp;
  }

  /// A tick that is `late` [s] and follows as many cycles that were missed.
  void note(double late, double missed) {
    report_.lateness.add(late);
    const auto skipped = static_cast<std::uint64_t>(missed);
    report_.skipped += skipped;
    if (overrun_.add(skipped, now()))
      runner_.tell(EventCode::overrun, runtime::event_signal::time, std::max(late, missed * period_));
    if (late > too_late) stop(EventCode::watchdog);
  }

  void stop(EventCode code, int signal = -1, double value = 0.0) {
    if (!runner_.guard().stopped()) runner_.guard().stop(code, signal, value);
  }

  /// A frozen pose of the base cannot guide the brake. The wheels' rates replace it from here on.
  void judge_base() {
    const BaseSample* base = inbox_.base();
    if (base == nullptr) return;
    const JointsSample& joints = inbox_.joints();
    const auto contradiction = frozen_base_.look(*base, joints.q, joints.qd, now());
    if (!contradiction) return;
    inbox_.distrust_base();
    sensed_.base_measured = false;
    stop(EventCode::frozen_base, runtime::event_signal::base_pose, *contradiction);
  }

  /// The guard does not know this process's own clock, by which samples may have ended. Nor does it know a
  /// request to end, by a signal or by the service `stop`.
  void judge() {
    if (inbox_.silence() > connection_.joints.stale_after) {
      stop(EventCode::lost_ticks);
      // No sample will show that it stands.
      if (!give_up_) give_up_ = now() + longest_brake;
    }
    judge_base();
    if ((cli::is_interrupted() || control_.wants_stop() || control_.wants_cancel()) && !give_up_) {
      give_up_ = now() + longest_brake;
      stop(EventCode::requested);
    }
  }

  void step() {
    if (const auto change = control_.take_change())
      runner_.set_parameter(program_.parameters[change->parameter].name, change->value);
    runner_.step(sensed_);
    control_.note(runner_.scheduler().task(), now() - begin_, progress(),
                  runner_.estimated_force().head<2>().norm());
    control_.note_base(sensed_.time, runner_.estimated_state());
    control_.note_skipped(report_.skipped);
    has_stepped_ = true;
    const runtime::SafetyGuard& guard = runner_.guard();
    if (!report_.silence && guard.stopped() && guard.reason() == EventCode::lost_ticks)
      report_.silence = inbox_.silence();
    outbox_.send_outputs(runner_.outputs());
    send_command();
    outbox_.tell_tick(sensed_.time);
  }

  void send_command() {
    // A tick that comes a little early is that of its cycle.
    const double time = inbox_.clock().time();
    if (time < send_at_ - 0.3 * period_) return;
    send_at_ = std::max(send_at_ + send_every_, time);
    if (!outbox_.send(runner_.command(), time)) ++report_.unsent;
  }

  /// Of the active task's timeout; -1 without one.
  double progress() const {
    const runtime::Scheduler& scheduler = runner_.scheduler();
    if (scheduler.task() < 0) return -1.0;  // stopped before the first one was entered
    const auto& timeout = scheduler.tasks()[static_cast<std::size_t>(scheduler.task())].timeout;
    const double after = timeout ? timeout->after.evaluate(scheduler.parameters()) : 0.0;
    return after > 0.0 ? std::clamp(scheduler.elapsed() / after, 0.0, 1.0) : -1.0;
  }

  const lang::Connection& connection_;
  const lang::Program& program_;
  Inbox& inbox_;
  Outbox& outbox_;
  Control& control_;
  runtime::Runner& runner_;
  DriveReport& report_;
  runtime::Sensed sensed_;
  FrozenBase frozen_base_;
  Overrun overrun_;
  runtime::Watchdog* watchdog_ = nullptr;
  bool takes_velocity_;
  double period_, send_every_;
  double begin_ = 0.0, due_ = 0.0, send_at_ = 0.0;  // [s]
  bool has_stepped_ = false;
  std::optional<double> give_up_;
};

}  // namespace

void drive(const lang::Connection& connection, const lang::Program& program, Inbox& inbox, Outbox& outbox,
           Control& control, runtime::Runner& runner, DriveReport& report) {
  Loop(connection, program, inbox, outbox, control, runner, report).run();
  outbox.send_zeros(now());
}

}  // namespace zwang::connect
