/// Faults of a robot's body and of the floor below it, as the simulation gets them: only what has changed.
#pragma once

#include <cstddef>
#include <vector>

#include "injected_faults.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::runtime {

/// Payload, shift of mass and floor friction in the simulation, as faults have left them.
class BodyFaults {
 public:
  /// `robot` is its number in the simulation.
  BodyFaults(std::size_t robot, const solver::Model& model, double floor_friction)
      : robot_(robot), friction_(model.wheels().size(), floor_friction) {
    for (const solver::Wheel& wheel : model.wheels()) joints_.push_back(wheel.body - 1);
  }

  void make(MujocoPlant& simulation, const InjectedFaults& faults, double floor_friction,
            double time) noexcept {
    const lang::Fault* payload = faults.find(lang::FaultKind::payload, time);
    const double mass = payload != nullptr ? payload->value : 0.0;
    if (mass != payload_ && robot_ == 0) simulation.set_payload(mass);
    if (mass != payload_ && robot_ > 0) simulation.set_partner_payload(robot_ - 1, mass);
    payload_ = mass;
    const lang::Fault* shifted = faults.find(lang::FaultKind::centre_of_mass, time);
    const double ahead = shifted != nullptr ? shifted->value : 0.0;
    if (ahead != ahead_) simulation.shift_centre_of_mass(robot_, ahead);
    ahead_ = ahead;
    const lang::Fault* turns_otherwise = faults.find(lang::FaultKind::inertia, time);
    const double more = turns_otherwise != nullptr ? turns_otherwise->value : 0.0;
    if (more != inertia_more_) simulation.scale_inertia(robot_, 1.0 + more);
    inertia_more_ = more;
    for (std::size_t w = 0; w < friction_.size(); ++w) {
      const lang::Fault* slip = faults.find(lang::FaultKind::floor_friction, time, joints_[w]);
      const double friction = slip != nullptr ? slip->value : floor_friction;
      if (friction != friction_[w]) simulation.set_wheel_friction(robot_, w, friction);
      friction_[w] = friction;
    }
  }

 private:
  std::size_t robot_;
  std::vector<Eigen::Index> joints_;  ///< of the wheels
  std::vector<double> friction_;      ///< under them
  double payload_ = 0.0;              ///< [kg]
  double ahead_ = 0.0;                ///< [m] of the centre of mass
  double inertia_more_ = 0.0;         ///< of the base's own
};

}  // namespace zwang::runtime
