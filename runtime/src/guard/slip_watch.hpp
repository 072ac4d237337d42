/// Detects wheels that slide instead of rolling.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "zwang/runtime/event.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// Slip is the part of the measured velocities that the ground does not allow. The slip of a wheel is its
/// radius times the rate that the projection of the velocities takes away from it, low-passed. Where the base
/// is measured, all wheels may slip at once. Where it is reckoned from the wheels, only their contradictions
/// are seen. Does not allocate, lock, throw or print after construction.
class SlipWatch {
 public:
  explicit SlipWatch(const solver::Model& model);

  /// `measured` and `allowed` are the same sample before and after the projection. An event when slip begins,
  /// and not again before it has ended.
  std::optional<Event> look(const solver::State& measured, const solver::State& allowed,
                            double time) noexcept;
  bool slips() const noexcept { return slips_; }
  /// Slip is possible: half of the reported speed. Estimates that need wheels without slip are not trusted
  /// then.
  bool doubtful() const noexcept { return speed_ > 0.5 * threshold; }
  /// [m] that the worst wheel slid while it slipped, since the start.
  double way() const noexcept { return way_; }
  double speed() const noexcept {
    return std::max(0.0, speed_);
  }  ///< [m/s] beyond `share`, of the worst wheel

  static constexpr double threshold = 0.02;      ///< [m/s]
  static constexpr double share = 0.1;           ///< of the rim's speed, added to the threshold
  static constexpr double time_constant = 0.05;  ///< [s]

 private:
  struct Wheel {
    int joint = 0;
    double radius = 0.0;
    double slip = 0.0;  ///< [m/s]
  };
  std::vector<Wheel> wheels_;
  double speed_ = 0.0;
  double way_ = 0.0;
  double last_time_ = 0.0;
  bool slips_ = false;
};

}  // namespace zwang::runtime
