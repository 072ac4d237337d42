/// The drive of a simulated robot that takes velocities.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "zwang/lang/robot.hpp"
#include "zwang/runtime/command.hpp"

namespace zwang::runtime {

/// A line that takes a value every `cycle` and hands it out `delay` later. [s] Does not allocate after
/// construction where a copy of `Value` does not.
template <typename Value>
class SampledLine {
 public:
  /// `first` is there before anything has arrived.
  SampledLine(double cycle, double delay, const Value& first)
      : cycle_(cycle),
        delay_(delay),
        ring_(static_cast<std::size_t>(std::ceil(delay / cycle)) + 2, {first}) {}

  /// The value that has arrived at `time`; `now` is the value at the other end.
  const Value& pass(const Value& now, double time) noexcept {
    if (time >= next_ - rounding) {
      newest_ = (newest_ + 1) % ring_.size();
      ring_[newest_].value = now;
      ring_[newest_].at = time;
      next_ = std::max(next_ + cycle_, time);
      if (waiting_ + 1 < ring_.size()) ++waiting_;
    }
    const auto next_is_there = [&] {
      return waiting_ > 0 && ring_[(oldest_ + 1) % ring_.size()].at <= time - delay_ + rounding;
    };
    while (next_is_there()) {
      oldest_ = (oldest_ + 1) % ring_.size();
      --waiting_;
    }
    return ring_[oldest_].value;
  }

 private:
  static constexpr double rounding = 1e-9;  // [s]
  struct Entry {
    Value value;
    double at = 0.0;  ///< [s] when it was taken
  };
  double cycle_, delay_;
  std::vector<Entry> ring_;
  std::size_t newest_ = 0, oldest_ = 0, waiting_ = 0;  ///< behind `oldest_`, which has arrived
  double next_ = 0.0;                                  ///< [s] when a value is taken
};

/// A PI loop at each driven wheel, in each step of the simulation:
///     torque = k_p (V - v) + k_i sum (V - v) dt,   k_p = m R^2 / (n T_c),   k_i = k_p / T_i,
/// inside the command's bounds and the motor's limit. m is the mass that n wheels of the radius R drive,
/// rotors included. Alone on the floor the base follows a step as 1 - e^(-t/T_c), apart from the integral.
/// The weight of a wheel is its rotation for a way of the base. It is averaged over the directions in which
/// motors drive the base: an omni wheel counts half. The integral is frozen while the torque is at a bound
/// and the error would push it farther.
///
/// A drive with torque limits of its own takes the motors' limits, whatever the command says. A drive that
/// takes the base's twist turns it into V as drivers do, by the places of the wheels. With u the direction
/// that the wheel holds at its contact point P, and d the way of P for 1 rad of the wheel,
///     u . (v + w z x P + V d) = 0.
class VelocityLoop {
 public:
  explicit VelocityLoop(const lang::Robot& robot);

  /// The motors' torques; `qd` as it is now. Does not allocate, lock, throw or print.
  const Eigen::VectorXd& step(const Command& command, const Eigen::VectorXd& qd, double period) noexcept;

  static double driven_mass(const lang::Robot& robot);  ///< m [kg]

 private:
  struct Wheel {
    int joint = 0;
    double limit = 0.0;         ///< [N m]
    double proportional = 0.0;  ///< k_p [N m s/rad]
    double integral = 0.0;      ///< k_i [N m/rad]
    double sum = 0.0;           ///< [N m] of the integral
    /// V for 1 m/s of the base's x, of its y, and 1 rad/s. [rad/s]
    Eigen::Vector3d per_twist = Eigen::Vector3d::Zero();
  };
  double wanted_velocity(const Wheel& wheel, const Command& command) const noexcept {
    return takes_twist_ ? wheel.per_twist.dot(command.twist) : command.velocity(wheel.joint);
  }

  bool takes_twist_;
  bool limit_is_fixed_;
  std::vector<Wheel> wheels_;
  Eigen::VectorXd torque_;
};

}  // namespace zwang::runtime
