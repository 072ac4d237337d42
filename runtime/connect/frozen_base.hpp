/// Whether the measured base is stuck: a localisation that died, or a driver that repeats itself.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"
#include "zwang/solver/wheel_odometry.hpp"

namespace zwang::connect {

struct BaseSample {
  double stamp = 0.0, arrival = 0.0;  ///< [s]
  solver::Pose pose;                  ///< in the axes of the odometry
  solver::MotionVector twist;         ///< in the axes of the base
};

/// A live measurement has noise, or at least other digits. So a pose that stays the same bit by bit is stuck,
/// as soon as the wheels have carried the base on by `least_way`. It may come again, come under new stamps,
/// or not come at all. The same holds for a twist and `least_change` of the wheels' twist. Either has
/// `patience` to follow. A turn counts as the motion of a point `lever` beside the origin.
class FrozenBase {
 public:
  static constexpr double least_way = 0.02;     ///< [m]
  static constexpr double least_change = 0.05;  ///< [m/s]
  static constexpr double lever = 0.4;          ///< [m]

  /// `stale_after` [s] is the least patience.
  FrozenBase(const solver::Model& model, double stale_after);

  /// Takes the newest sample of the base and the newest positions and rates of the joints. `time` [s] is of
  /// the clock of arrivals. Returns the motion that the wheels show and the base does not: a way [m], or a
  /// change of speed [m/s]; none where all is well.
  std::optional<double> look(const BaseSample& base, const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                             double time) noexcept;

  /// [s] The longest of `stale_after` and three periods of the messages, and as much as they came late.
  double patience() const noexcept;

 private:
  /// Of one thing that is measured: since when the wheels contradict that it stays.
  struct Standing {
    std::optional<double> since;  // [s]

    bool is_stuck(bool is_contradicted, double time, double patience) noexcept;
  };

  void take_message(const BaseSample& base) noexcept;
  /// The base's twist that these rates of the joints tell; of a way of the joints, the base's way.
  solver::MotionVector by_wheels(const Eigen::VectorXd& q, const Eigen::VectorXd& rates) noexcept;

  solver::WheelOdometry wheels_;
  solver::State state_;
  double stale_after_;
  BaseSample last_;                                             // message
  double first_arrival_ = 0.0, period_ = 0.0, lateness_ = 0.0;  // [s]
  int messages_ = 0;
  bool has_begun_ = false;
  Eigen::VectorXd q_at_pose_;             // as the pose changed last
  solver::MotionVector wheels_at_twist_;  // as the twist changed last
  Standing pose_, twist_;
};

}  // namespace zwang::connect
