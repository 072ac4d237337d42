/// The links and loads that hang on the joints of an arm, and the weight of them at each joint.
#pragma once

#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

/// Weight and inertia at every joint whose motor turns no wheel. The joint has the unit axis u through o, and
/// g is gravity. All links beyond it have the mass m, the centre c and the inertia J about o:
///   weight   -u . ((c - o) x m g)   revolute,   -u . m g   prismatic     the torque or force that bears it
///   inertia   u . J u + d           revolute,    m + d     prismatic     d: the rotor's
/// With the weights as `tau_ff` an arm floats. A force row then presses with its own newtons alone, without
/// the arm's weight. Does not allocate, lock, throw or print after construction.
class ZWANG_EXPORT JointLoads {
 public:
  struct Load {
    int joint = 0;
    double weight = 0.0;   ///< [N m] or [N]
    double inertia = 0.0;  ///< [kg m^2] or [kg]
  };
  explicit JointLoads(const Model& model);

  /// In this posture and at this tilt of the base. The state is sized for the model.
  void weigh(const State& state) noexcept;
  /// As weighed last, in the order of the joints.
  const std::vector<Load>& all() const noexcept { return loads_; }
  /// Weighs, and adds the weights to `state.tau_ff`.
  void bear(State& state) noexcept;

 private:
  const Model model_;
  std::vector<Load> loads_;
  std::vector<Pose> poses_;             ///< of each body in the base
  std::vector<RigidInertia> subtrees_;  ///< of each body and what hangs on it, in the base's axes
};

}  // namespace zwang::solver
