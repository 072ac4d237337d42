/// The end of a push, in the protective stop.
#pragma once

#include <Eigen/Core>

#include "drive/contact_response.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/command.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// A loop with an integral that is told 0 at a wall goes on pressing. So the felt force moves the virtual
/// robot without rows, until it is below the threshold of ContactResponse. With gamma = `damping`, in the
/// coordinates y of solver::FreeMotions:
///     ydd = B' w - gamma yd.
/// V goes the way that the contact presses, so it takes no energy from the motors. The force is believed only
/// if it answers the motors' push. A sensor that lies even so moves the base by `farthest` at most, with
/// `fastest` at most, away from what the base pressed on. The free motions are those of the last solution:
/// only for bases whose wheels all stand on the body. Does not allocate, lock, throw or print after
/// construction.
class ContactRelease {
 public:
  /// `robot`: the virtual one. `period` [s] of `update`.
  ContactRelease(const lang::Robot& robot, double period);

  void begin() noexcept;
  /// Nothing is felt now: V is 0.
  void pause() noexcept;
  /// A tick of the stop. V begins at 0, once the loops have followed the ramp.
  void update(const ContactResponse& contact) noexcept;
  /// V + T_c V', to the wheels and the base.
  void tell(const ContactResponse& contact, Command& command) const noexcept;

  bool is_over() const noexcept { return is_over_; }
  bool runs() const noexcept { return runs_; }

  /// At least the damping of ContactResponse. More of it makes the loop's gain smaller at each frequency.
  static constexpr double damping = 4.0;    ///< [1/s]
  static constexpr double fastest = 0.02;   ///< [m/s] of the footprint's farthest corner: 5 mm to stand
  static constexpr double farthest = 0.05;  ///< [m] of the same: a wall of 2 kN/m lets 80 N go in 40 mm
  static constexpr double longest = 8.0;    ///< [s] less than a stop may take
  /// Cosine, in y: the contact presses back against what the motors pressed with. A sensor that tells else is
  /// not believed. One corner at a wall answers with 0.7 of a push straight ahead.
  static constexpr double least_answer = 0.5;
  static constexpr double quiet = 0.2;           ///< [s] below the threshold; a bounce is shorter
  static constexpr double time_constants = 3.0;  ///< that the loops and the low passes settle

 private:
  double period_;
  double radius_;   ///< [m] of the footprint about the base's origin
  double lead_;     ///< [s] T_c
  double damping_;  ///< [1/s]
  double settled_;  ///< [s]
  bool is_rigid_;   ///< the wheels stand on the body
  Eigen::VectorXd yd_, told_, felt_;
  double since_ = 0.0;        ///< [s] the ramp was over
  double quiet_for_ = quiet;  ///< [s]
  double way_ = 0.0;          ///< [m]
  bool runs_ = false;
  bool is_over_ = false;
};

}  // namespace zwang::runtime
