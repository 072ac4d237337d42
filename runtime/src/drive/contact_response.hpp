/// The response of the virtual robot to a felt contact.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>

#include "drive/effort_sense.hpp"
#include "estimate/normal_equations.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/plant.hpp"
#include "zwang/solver/solver.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// It acts after the solver, so that no row works against it:
///     alpha M V' + bias = J' tau + w - gamma alpha M (V - V_f).
/// w is the felt force, low-passed. The damping acts while |w| > `threshold`, and for 50 ms after that:
/// without it the delay turns a wall into a spring that bounces. Where V is below 2 mm/s, or 5 mrad/s, V_f
/// approaches V within 1 s. Otherwise V_f falls to 0. So a base that creeps under load presses with all of
/// its force. In the coordinates y of solver::FreeMotions alpha M is 1. With the base's twist B y and the
/// joints' motion T y, the equation is
///     ydd = B' w - gamma (yd - yd_f).
/// Does not allocate, lock, throw or print after construction.
class ContactResponse {
 public:
  /// `robot`: the virtual one, whose drive says what it feels. `period` [s] of `accelerate`.
  ContactResponse(const lang::Robot& robot, double period);

  /// Whether the sample has what this robot feels by.
  bool can_feel(const Sensed& sensed) const noexcept;
  /// A sample that was measured at `stamp` [s].
  void feel(const Sensed& sensed, double stamp) noexcept;
  void begin() noexcept;

  /// Adds to the joints' accelerations: `qdd` begins as those of `solution`, which `solver` has at `state`,
  /// the virtual robot's. `most` [N m]: no motor presses with more.
  void accelerate(const solver::Solver& solver, const solver::Solution& solution, const solver::State& state,
                  const Eigen::VectorXd& most, Eigen::VectorXd& qdd) noexcept;

  /// w: what presses on the base at its origin, in its axes: x, y [N] and rz [N m].
  const solver::Vector3& force() const noexcept { return w_; }
  bool is_pressed() const noexcept { return pressed_for_ > 0.0; }
  /// Of a robot that stands. [N]
  double threshold() const noexcept { return threshold_; }
  /// Of the last solution.
  const solver::FreeMotions& motions() const noexcept { return motions_; }
  /// T' tau of the same: what the motors pressed with.
  auto pressed_with() const noexcept { return pressed_with_.head(motions_.count); }
  /// The virtual robot does not move any more.
  void rest() noexcept {
    if (effort_) effort_->rest();
  }
  /// The time constant of w. [s]
  static double low_pass(const lang::Drive& drive) noexcept { return std::max(20e-3, 1.0 / drive.rate); }

  static constexpr double pressed_on = 0.05;        ///< [s] that the damping stays
  static constexpr double taken_over_within = 1.0;  ///< [s] of V_f
  static constexpr double slow = 2e-3;              ///< [m/s]
  static constexpr double slow_turn = 5e-3;         ///< [rad/s]
  /// Of the noise behind the low pass, the threshold: noise passes it once in 15 days at 50 Hz, e^(-6^2/2). A
  /// false contact brakes the base with gamma V, which looks like an obstacle.
  static constexpr double sigmas = 6.0;
  /// Beside it, of a robot that feels by effort: so much of M |V'|, over 30 ms, for a mass that is known
  /// badly.
  static constexpr double share_of_inertia = 0.3;
  static constexpr double accelerated_over = 30e-3;  ///< [s]

 private:
  solver::Vector3 felt_wrench(const Sensed& sensed) const noexcept;
  double threshold(const solver::State& state) noexcept;
  void take_off_beyond(const Eigen::VectorXd& most, const solver::Solution& solution) noexcept;

  double period_;
  lang::Drive drive_;
  solver::Pose sensor_;     ///< on the base
  double threshold_ = 0.0;  ///< [N]
  double filter_;           ///< [s]
  std::optional<EffortSense> effort_;
  solver::FreeMotions motions_;
  NormalEquations base_factor_;  ///< of B'B
  Eigen::MatrixXd base_;         ///< B
  Eigen::VectorXd y_, right_;
  Eigen::VectorXd pressed_with_;
  solver::Vector3 w_ = solver::Vector3::Zero();
  solver::Vector3 creep_ = solver::Vector3::Zero();         ///< V_f of the base: x, y [m/s], rz [rad/s]
  double felt_at_ = -solver::infinity;                      ///< [s]
  double pressed_for_ = 0.0;                                ///< [s] that are left of `pressed_on`
  solver::Vector3 velocity_ = solver::Vector3::Zero();      ///< [m/s] of the base's origin, a tick ago
  solver::Vector3 acceleration_ = solver::Vector3::Zero();  ///< [m/s^2] of the same, low-passed
};

}  // namespace zwang::runtime
