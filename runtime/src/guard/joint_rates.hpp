/// Detects a joint's rate that is not that of its position.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "zwang/runtime/event.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// For each driven joint, over windows of the time T,
///   q(t) - q(t - T) = integral of qd from t - T to t.
/// For wheels, whole turns do not count, as encoders may count from 0 after each. If the two sides differ by
/// more than half of the larger one, one of them is not measured. The difference has to keep its direction
/// over some windows in a row. Examples are rates that a host never fills in, or that have another sign or
/// unit. Neither noise nor the steps of an encoder add up that way, and a late rate differs only while it
/// changes. Does not allocate, lock, throw or print after construction.
class JointRates {
 public:
  explicit JointRates(const solver::Model& model);

  /// Every good sample, as it was measured. The event has the rate that the joint was said to have.
  std::optional<Event> look(const solver::State& state, double time) noexcept;
  /// Puts the rates of the positions in the place of those that are not twice as fast: for a brake, where
  /// the two contradict each other.
  void mend(Eigen::VectorXd& qd) const noexcept;

  static constexpr double window = 0.05;  ///< [s]
  static constexpr int windows = 3;       ///< in a row
  static constexpr double share = 0.5;
  static constexpr double resolution =
      0.02;  ///< [rad] over a window, the steps of an encoder: 2 mm of a wheel's rim
  static constexpr double resolution_m = 0.002;  ///< [m] the same where a joint slides
  static constexpr double quick = 0.02;          ///< [s] of the low pass of the positions' rates

 private:
  struct DrivenJoint {
    int joint = 0;
    bool turns_on = false;  ///< and on: whole turns do not count
    double resolution = 0.0;
    double last_q = 0.0, last_qd = 0.0;
    double way = 0.0;        ///< [rad] or [m] of the position since the window began
    double integral = 0.0;   ///< of the rate
    double rate = 0.0;       ///< [rad/s] or [m/s] of the position, low-passed
    int more = 0, less = 0;  ///< windows in a row that the way was more, or less, than the integral
  };
  std::vector<DrivenJoint> joints_;
  double last_time_ = 0.0;
  double window_time_ = 0.0;  ///< [s] since the window began
  bool has_last_ = false;
};

}  // namespace zwang::runtime
