/// Compares the torques that a drive measures with those that its velocity loops must give.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "drive/loop_gain.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

/// From one sample to the next, the loop of a wheel changes its torque by
///     d torque = k_p d(V - v) + k_i (integral of V dt - dq),
/// whatever the wheel meets: mass, friction, slip and contact are no part of it. Both sides are added up from
/// sample to sample, and fade with `memory`: `felt` is the left side by the measured torque, `told` the right
/// side. A motor that gives nothing, keeps its torque, or gives the contrary leaves `felt` behind `told`.
///
/// V at a wheel is a command that is delay/2 to delay/2 + cycle old, and nobody knows where in between.
/// `told` is computed for the middle. If V comes s earlier, `told` is larger by
///     s (k_p V' + k_i V),
/// added up and faded likewise. So much of it is doubted. While a motor is at its limit, the loop's integral
/// is not known: the sums begin anew. Does not allocate, lock, throw or print after construction.
class EffortWatch {
 public:
  /// `robot`: the virtual one, `drive.mass_factor` times as heavy and strong. `period` [s] of `tell`.
  EffortWatch(const lang::Robot& robot, double period);

  void begin() noexcept {
    told_count_ = 0;
    is_known_ = false;
  }
  /// The wheels' velocities that the drive is told at `time` [s], each tick.
  void tell(const Eigen::VectorXd& velocity, double time) noexcept;
  /// `effort_lost`, by a sample that was measured at `stamp` [s].
  std::optional<Event> look(const Sensed& sensed, double stamp) noexcept;
  /// `drive_at_limit`, after `look`; once until the motor was below its limit for as long.
  std::optional<Event> look_at_limits(double stamp) noexcept;

  static constexpr double memory = 0.5;      ///< [s] a press takes 0.1 s to build up at a hard wall
  static constexpr double smoothing = 0.05;  ///< [s] of both sides
  /// Of `told`. A loop of half the k_p or k_i that the robot file tells gives half; noise and taps take more.
  static constexpr double share = 0.15;
  static constexpr double lasts = 0.2;      ///< [s]
  static constexpr double sigmas = 6.0;     ///< of the noise behind `smoothing`, that `told` must pass
  static constexpr double smallest = 0.05;  ///< of the motor's limit, that `told` must pass
  static constexpr double at_limit = 0.9;   ///< of the motor's limit

 private:
  /// [N m], [N m/s] A sum that fades. It goes through the sensor's low pass, and through `smoothing`.
  struct Sum {
    double value = 0.0, filtered = 0.0, smooth = 0.0;
  };
  /// What is left of a sum after a sample's time.
  struct Left {
    double sum = 0.0, filtered = 0.0, smooth = 0.0;
  };
  struct Sample {
    double q = 0.0;             ///< [rad]
    double effort = 0.0;        ///< [N m]
    double error = 0.0;         ///< [rad/s] V - v
    double velocity = 0.0;      ///< [rad/s] V since the sample before
    double acceleration = 0.0;  ///< [rad/s^2] V' since the sample before
  };
  struct Wheel {
    LoopGain gain;
    double threshold = 0.0;  ///< [N m]
    Sample last;
    Sum told, felt, told_earlier;
    double effort = 0.0;        ///< [N m] behind `smoothing`
    double lost_for = 0.0;      ///< [s]
    double at_limit_for = 0.0;  ///< [s] up to `lasts`; it falls as fast below the limit
    bool is_limit_told = false;
  };
  /// A time among the commands.
  struct Place {
    Eigen::Index command = -1;  ///< the newest until then; -1: none is as old
    double since = 0.0;         ///< [s] it was told; negative before the first one
  };
  Place place(double time) const noexcept;
  /// [rad] that the wheel was told to turn until then.
  double way(std::size_t wheel, const Place& then) const noexcept {
    const auto row = static_cast<Eigen::Index>(wheel);
    return ways_(row, then.command) + then.since * rates_(row, then.command);
  }
  static void add(Sum& sum, double change, const Left& left) noexcept;
  /// `way` [rad] that it was told to turn since the last sample.
  void follow(Wheel& wheel, const Sample& now, double way, double since) const noexcept;

  double filter_;  ///< [s] of the sensor
  double late_;    ///< [s] from a command to the wheel, the least
  double cycle_;   ///< [s]
  double doubt_;   ///< [s] of when a command acts, either way
  std::vector<Wheel> wheels_;
  std::vector<double> times_;     ///< [s] of the commands, a ring
  Eigen::MatrixXd rates_, ways_;  ///< [rad/s] of the commands; [rad] that they told until then
  Eigen::Index newest_ = 0;
  Eigen::Index told_count_ = 0;  ///< commands that the ring holds
  double looked_at_ = 0.0;       ///< [s] the last sample
  bool is_known_ = false;
};

}  // namespace zwang::runtime
