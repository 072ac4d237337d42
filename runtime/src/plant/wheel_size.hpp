/// Wheels of another size than the robot's model says.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// Wheels whose radius is `factor` times what the model says. With the same power, they turn 1/factor times
/// as far along the floor, and push 1/factor times as hard. The simulation has the model's wheels, and their
/// angles and torques are told so. Their own inertia is told as factor^-2 of the model's.
class WheelSize {
 public:
  WheelSize(const solver::Model& model, double factor) : share_(1.0 / factor) {
    for (const solver::Wheel& wheel : model.wheels()) {
      if (share_ != 1.0 && model.joint(wheel.body - 1).actuated) joints_.push_back(wheel.body - 1);
    }
  }
  void tell(solver::State& state) const noexcept {
    for (const int joint : joints_) {
      state.q(joint) *= share_;
      state.qd(joint) *= share_;
    }
  }
  void push(Eigen::VectorXd& torque) const noexcept {
    for (const int joint : joints_) torque(joint) *= share_;
  }

 private:
  double share_;
  std::vector<int> joints_;
};

}  // namespace zwang::runtime
