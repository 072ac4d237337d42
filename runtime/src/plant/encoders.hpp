/// Encoders as a study draws them: they count in steps, and their readings do not repeat to the bit.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "scene_signals.hpp"
#include "zwang/lang/scenario.hpp"

namespace zwang::runtime {

class Encoders {
 public:
  Encoders(const lang::RobotDeviation& deviation, std::uint64_t seed)
      : step_(deviation.encoder_step), noise_(deviation.encoder_noise), random_(seed ^ 0x8CB92BA72F3D8DD7U) {}

  /// The count, before a fault keeps it.
  void count(Eigen::VectorXd& q) const noexcept {
    for (double& angle : q) {
      if (step_ > 0.0) angle = std::floor(angle / step_) * step_;
    }
  }
  /// The reading of the count, of dead encoders, too.
  void read(Eigen::VectorXd& q) noexcept {
    for (double& angle : q) {
      if (noise_ > 0.0) angle += noise_ * random_.normal();
    }
  }

 private:
  double step_, noise_;  ///< [rad]
  Noise random_;
};

}  // namespace zwang::runtime
