/// Whether the motors follow their commands, by all checks together.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "estimate/disturbance.hpp"
#include "guard/actuator_watch.hpp"
#include "guard/contact_depth.hpp"
#include "guard/motor_beside_contact.hpp"
#include "guard/motor_signs.hpp"
#include "guard/pusher.hpp"
#include "guard/reversed_motor.hpp"
#include "guard/runaway_watch.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// In free motion a motor's force shows its fault (ActuatorWatch). Beside one contact, the fault shows by the
/// line that it takes the force off (MotorBesideContact). Beside any number of contacts it shows by its work
/// (ReversedMotor, RunawayWatch). A fault of all motors together shows by the first torques (MotorSigns). Two
/// forces are not a motor's. One is the force that a pressed contact (ContactDepth) gives back. The other has
/// the size of a person's push, while the person pushes (Pusher). Does not allocate, lock, throw or print
/// after construction.
class MotorWatch {
 public:
  /// `period` [s] from one look to the next.
  MotorWatch(const lang::Robot& robot, double period);

  /// Forgets what was: there is nothing to compare with, or wheels slide.
  void reset() noexcept;
  /// After each comparison of the observer: `sent` is what brought the motors to `state`, and `set` what the
  /// robot was to do. The first that is sure says what is wrong.
  std::optional<Event> look(DisturbanceObserver& observer, const solver::State& state,
                            const Eigen::VectorXd& sent, const solver::ConstraintSet& set,
                            bool blends) noexcept;

 private:
  MotorSigns signs_;
  ActuatorWatch actuators_;
  MotorBesideContact beside_contact_;
  RunawayWatch runaway_;
  ReversedMotor reversed_;
  ContactDepth contact_;
  Pusher pusher_;
};

}  // namespace zwang::runtime
