/// The robot at the other end of the loop: it is sensed, and it takes torques.
#pragma once

#include <Eigen/Core>

#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// One stamped snapshot of everything the controller may know.
struct Sensed {
  explicit Sensed(const solver::Model& model) : state(model) {}
  double time = 0.0;  ///< [s]
  solver::State state;
};

enum class PlantStatus {
  ok,
  diverged,    ///< the simulation reset itself, warned or left the finite numbers: the run is void
  unreachable  ///< no sample, or the command did not arrive
};
const char* to_string(PlantStatus status) noexcept;

/// Implement this for your own robot. Both calls are made once per control period, on one thread, and must
/// not throw.
class Plant {
 public:
  virtual ~Plant() = default;
  virtual PlantStatus sense(Sensed& sensed) noexcept = 0;
  /// Applies the joint torques [N m] or [N] for one control period.
  virtual PlantStatus apply(const Eigen::VectorXd& tau) noexcept = 0;
};

}  // namespace zwang::runtime
