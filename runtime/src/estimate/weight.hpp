/// Bears the weight of what hangs on the joints, so that an arm floats where nothing is said of it.
#pragma once

#include <vector>

#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// Torque of every joint with a motor that turns no wheel, against the weight of all that it carries, as
/// feed-forward:
///   tau_ff = -a . ((c - o) x m g)   revolute,     -a . m g   prismatic
/// with the axis a through o, the mass m beyond the joint and its centre c. A force row then presses with its
/// own newtons, and none of the arm's weight. Does not allocate, lock, throw or print after construction.
class WeightFeedForward {
 public:
  explicit WeightFeedForward(const solver::Model& model);
  void add_to(solver::State& state) noexcept;

 private:
  struct Carried {
    solver::Pose pose;                                       ///< X_WB of the body itself
    double mass = 0.0;                                       ///< of the body and all that it carries
    solver::Vector3 first_moment = solver::Vector3::Zero();  ///< about the world's origin, in its axes
  };
  const solver::Model model_;
  std::vector<bool> bears_;  ///< by body: the joint that moves it
  std::vector<Carried> carried_;
  bool any_ = false;
};

}  // namespace zwang::runtime
