/// The messages from the robot: topics decoded on the threads of DDS, read by the control thread.
#pragma once

#include <semaphore.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "clock.hpp"
#include "dds.hpp"
#include "frozen_base.hpp"
#include "mailbox.hpp"
#include "message.hpp"
#include "robot_clock.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::connect {

/// How a topic does. Written by the threads of DDS.
struct TopicCounts {
  std::string topic;
  const char* type = "";
  bool may_be_silent = false;  ///< nothing has to come on it
  std::atomic<std::uint64_t> received{0};
  std::atomic<std::uint64_t> others{0};    ///< of another publisher than the one that is obeyed
  std::atomic<std::uint64_t> bad{0};       ///< not this message, or not whole, or numbers that cannot be
  std::atomic<double> last_arrival{0.0};   ///< [s] 0: none
  std::atomic<double> first_arrival{0.0};  ///< [s]
  std::atomic<double> age_sum{0.0}, most_age{0.0};  ///< [s] from stamp to arrival
  OnePublisher publisher;                           ///< of all that the topic tells, but for joints
};

struct JointsSample {
  double stamp = 0.0, arrival = 0.0;  ///< [s]
  Eigen::VectorXd q, qd;              ///< of every joint of the model; one that is never told stays at 0
  Eigen::VectorXd effort;             ///< [N m] the same, of a robot that `feels` by effort
};

class Inbox {
 public:
  /// The program and the connection outlive it; `check_connection` has found them good.
  Inbox(const lang::Connection& connection, const lang::Program& program);
  ~Inbox();

  /// From now on it is filled. The participant must be closed before the inbox ends.
  void subscribe(Participant& participant);

  /// From now on `fill` serves snapshots of this program, which has the same joints and outlives it, too. The
  /// newest sample of each signal counts for it as well. For the thread that calls `fill`.
  void read_for(const lang::Program& program);

  /// Waits for a sample of the joints until a time [s] of `now`; whether one has come. One thread calls it,
  /// and `fill`.
  bool wait_for_joints(double until) noexcept;
  /// The newest that has come. The state as it was measured; `Sensed::time` and `measured_at` are the
  /// caller's.
  void fill(runtime::Sensed& sensed) noexcept;

  /// The clock of the robot's stamps.
  const RobotClock& clock() const noexcept;
  /// [s] by that clock, for how long no sample of the joints has come.
  double silence() const noexcept;
  const JointsSample& joints() const noexcept;  ///< as of the last `fill`
  /// As of the last `fill`, not carried on; nullptr where none has come, or it is distrusted.
  const BaseSample* base() const noexcept;
  /// From now on the base's motion is reckoned from the wheels.
  void distrust_base() noexcept;
  bool has_joints() const noexcept;   ///< every motor's joint has come; as of the last `fill`
  bool has_base() const noexcept;     ///< the base's pose has come, or the robot needs none
  bool has_wrench() const noexcept;   ///< the wrench on the robot has come, or it needs none
  bool has_signals() const noexcept;  ///< each one that the program reads has come
  /// [s] when the newest sample of the joints has come, also of one that is not yet taken.
  double last_arrival() const noexcept;
  const std::vector<std::unique_ptr<TopicCounts>>& counts() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace zwang::connect
