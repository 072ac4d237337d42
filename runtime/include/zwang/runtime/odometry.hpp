/// Where the base is, by its wheels: dead reckoning, corrected by poses of another sensor.
#pragma once

#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"
#include "zwang/solver/wheel_odometry.hpp"

namespace zwang::runtime {

struct OdometrySettings {
  double memory = 0.5;         ///< [s] a measured pose that is older is ignored
  double period = 1e-3;        ///< [s] of the updates, for the memory's size
  double time_constant = 0.5;  ///< [s] within which measured poses take over
};

/// Does not allocate, lock, throw or print after construction.
class ZWANG_EXPORT Odometry {
 public:
  /// Throws std::invalid_argument on settings that are not positive. `start` is X_WB at the first update.
  explicit Odometry(const solver::Model& model, const solver::Pose& start = {},
                    const OdometrySettings& settings = {});

  /// Forgets everything and starts anew at X_WB.
  void start_at(const solver::Pose& start) noexcept;

  /// Gives the state the base's twist as the wheels tell it, and the pose that it leads to. Reads q and qd.
  /// Keeps its own height, roll and pitch: those of `start`.
  void update(double time, solver::State& state) noexcept;

  /// A pose X_WB of the base that was measured at `stamp` [s], which is not later than the last update. Call
  /// it before `update`, once a measurement. Only x, y and yaw count. False, without an effect, when it is
  /// too old, not finite or its rotation is invalid.
  bool correct(double stamp, const solver::Pose& measured) noexcept;

  static constexpr double longest_step = 0.1;  ///< [s] beyond it a clock jumped, and the base did not

  double slip() const noexcept { return slip_; }  ///< [m/s] by which the wheels contradict each other
  const solver::Pose& pose() const noexcept { return pose_; }

 private:
  struct Past {
    double time = 0.0;
    solver::Pose pose;
  };
  const Past* at(double stamp) const noexcept;

  solver::WheelOdometry wheels_;
  OdometrySettings settings_;
  solver::Pose pose_;
  solver::MotionVector twist_;
  double slip_ = 0.0;
  double last_correction_ = 0.0;  // [s]
  bool started_ = false;
  std::vector<Past> past_;  // a ring
  std::size_t updates_ = 0;
};

}  // namespace zwang::runtime
