/// Detects that all encoders die at once.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace zwang::runtime {

/// A driver that receives no samples any more may repeat the last positions. The rates that it computes from
/// them are 0. So a base that pushes blindly looks like a base that stands at a wall. But frozen positions
/// rolled evenly, and then stay the same to the bit from one sample to the next. A hit takes some time, and
/// leaves the positions not quite still. The difference can be seen where a tick's way is several of the
/// encoders' steps. Does not allocate, lock, throw or print after construction.
class FrozenState {
 public:
  explicit FrozenState(Eigen::Index joints) : q_(Eigen::VectorXd::Zero(joints)) {}

  /// Every good sample; `dt` [s] since the last one.
  void look(const Eigen::VectorXd& q, double dt) noexcept;
  void begin() noexcept;

  /// Since when, in samples; 0: nothing is wrong.
  int ticks() const noexcept { return is_abrupt_ ? still_ticks_ : 0; }
  /// The joint that turned fastest, and how fast. [rad/s] or [m/s]
  int joint() const noexcept { return joint_; }
  double pace() const noexcept { return pace_; }

  static constexpr double least_pace = 0.1;  ///< [rad/s] or [m/s]
  static constexpr double evenly = 0.8;      ///< of the pace: the last step
  static constexpr double steps = 4.0;       ///< of the encoder, in a tick
  static constexpr double share = 0.1;       ///< that a tick has in the pace

 private:
  Eigen::VectorXd q_;  ///< of the last sample
  bool has_last_ = false;
  int joint_ = 0;
  double pace_ = 0.0;                                              ///< of the fastest joint, a mean
  double last_pace_ = 0.0;                                         ///< in the last tick
  double tick_way_ = 0.0;                                          ///< in the last tick [rad] or [m]
  double encoder_step_ = std::numeric_limits<double>::infinity();  ///< the least that any joint moved by
  int still_ticks_ = 0;
  bool is_abrupt_ = false;
};

}  // namespace zwang::runtime
