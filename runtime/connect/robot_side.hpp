/// The robot's side of a connection: it publishes what `Inbox` reads, and takes what `Outbox` sends.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "clock.hpp"
#include "dds.hpp"
#include "mailbox.hpp"
#include "message.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/command.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::connect {

struct CommandMail {
  runtime::Command command;
  double arrival = 0.0;  ///< [s] of RobotSide::time
  bool has_come = false;
};

class RobotSide {
 public:
  /// All of them outlive it, the participant excepted: that is closed before.
  /// `stamps_ahead` [s] is added to every stamp that goes out.
  RobotSide(const lang::Connection& connection, const lang::Program& program, double stamps_ahead = 0.0);

  void join(Participant& participant);
  /// The writers go: before the participant does.
  void leave() noexcept;
  /// [s] The clock of the stamps: this computer's, or the one that `tell_time` publishes.
  double time() const noexcept { return connection_.clock ? told_time_.load() : now(); }
  /// On the topic of the connection's clock, if it has one. [s]
  void tell_time(double time);
  /// The joints, the base, a fix and the signals of a sample, which was measured at `stamp` [s] since 1970.
  /// `shift` is the same time less that of the sample's own clock.
  void publish(const runtime::Sensed& sensed, double stamp, double shift);
  /// A peer listens to the joints.
  bool is_heard() const noexcept { return joints_->readers() > 0; }
  /// The next `publish` sends the fix and the signals even if they have not changed.
  void tell_again() noexcept;
  /// From now on the odometry repeats its last pose and twist, under new stamps.
  void hold_odometry() noexcept { holds_odometry_ = true; }
  /// The newest command, or zeros when it is older than the receiver's `timeout`; with the outputs as they
  /// were told last. `time` [s] is as `time()`.
  const runtime::Command& command(double time);
  const CommandMail& newest() const noexcept { return mail_.value(); }
  /// [s] of a published clock: the last tick that the other side has told of; none: it tells of none.
  std::optional<double> ticked() const noexcept {
    const double time = ticked_;
    return time < 0.0 ? std::nullopt : std::optional(time);
  }

 private:
  void subscribe_outputs(Participant& participant);
  void publish_fix(const runtime::MeasuredPose& fix, double shift);
  void publish_signal(const lang::SignalSource& source, const runtime::SignalSample& sample, double shift,
                      Writer& writer);

  struct SignalWriter {
    std::size_t index = 0;  ///< in Program::signals
    const lang::SignalSource* source = nullptr;
    std::unique_ptr<Writer> writer;
    double last_stamp = -1.0;  ///< [s] of the sample's own clock
  };

  const lang::Connection& connection_;
  const lang::Program& program_;
  std::vector<int> order_;
  Mailbox<CommandMail> mail_;
  OnePublisher commander_;  ///< of the thread of DDS that takes commands
  runtime::Command zeros_, given_;
  std::atomic<double> told_time_{0.0}, ticked_{-1.0};
  std::vector<std::atomic<double>> outputs_;  ///< by Program::outputs
  std::unique_ptr<Writer> joints_, base_, fix_, wrench_, clock_;
  std::vector<SignalWriter> signals_;
  JointState joint_state_;
  Odometry odometry_;
  double stamps_ahead_;  // [s]
  bool holds_odometry_ = false;
  double last_fix_ = -1.0;  // [s]
  Bytes bytes_;
};

}  // namespace zwang::connect
