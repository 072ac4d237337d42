/// The protective stop's brake on the wheels.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/lang/robot.hpp"

namespace zwang::runtime {

/// Each driven wheel damps its own motion, tau = -d qd within its limit. This can only take energy, as long
/// as the motor obeys its command. A motor that does the opposite drives the base instead, faster than the
/// others brake it. Of four mecanum wheels' rates three quarters can be its own. So a motor under suspicion
/// is left out. If the wheels get faster under the brake, the one with the largest gain is left out instead.
/// If that does not end the gain, each wheel in turn is left out, and at last all of them. If they get faster
/// even then, somebody pushes: no motor gives anything. The brake then begins anew. Few wheels cannot brake
/// every motion without the one that is left out. If they roll on evenly, its torque is reversed. If the
/// wheels then get faster, its motor obeys. A motor that was only under suspicion brakes again. So does a
/// motor that was taken for lost or reversed, a tenth as stiffly: a mass that the model lacks looks like one.
/// It must do so twice, each time twice as fast as without it: a push does not wait for that. Any other motor
/// stays left out, without torque. That also brakes a base whose motors, or encoders, are all wired the wrong
/// way round.
///
/// While a motor is only under suspicion, the brake is a tenth as stiff. Another motor that drives the base
/// then needs at least some 40 ms to double a rate. The brake sees that before that motor presses.
///
/// Where no motor is under suspicion the base slows down no harder than `robot.stop.deceleration`. With v and
/// w its speed and yaw rate at the onset of the brake, every wheel may keep the share 1 - t / t_s of its
/// rate:
///   t_s = max(|v|, R |w|) / a,   R the footprint's radius.
/// It is damped only beyond that. Against a person who drives the base all of the torques are still
/// available.
///
/// Without samples the brake continues from the last one. The kinetic energy T of that sample is gone after
/// 2 T / P, with P the power of the brakes at that moment, if no other force acts. The brake ends earlier, by
/// the possible error of the model: a brake that acts on a past speed drives the robot backwards. Does not
/// allocate, lock, throw or print after construction.
class WheelBrake {
 public:
  /// All wheels together press the ground with `robot.stop.force` at most.
  WheelBrake(const lang::Robot& robot, double period);

  /// `suspect`: a joint whose motor the stop is about; -1: none. It is believed to be that one while the
  /// wheels are no faster than `believed` [m/s], root mean square at the rims; 0: it is suspected only.
  void begin(int suspect, double believed) noexcept;
  /// All motors, or all encoders, are the wrong way round.
  void begin_turned_around() noexcept;
  void brake(const Eigen::VectorXd& qd, Eigen::VectorXd& tau) noexcept;
  /// Since it began: the motor that the stop is about was told the reverse, and drove the base each time.
  bool has_obeyed() const noexcept { return has_obeyed_; }
  /// Takes a tick with a trusted sample. The sample before it is the one that counts. When encoders die,
  /// their rates may show it a sample before their positions stay.
  void remember(const solver::State& state) noexcept;
  /// A tick without one: goes on from what was remembered last. Leaves `tau` as it is when that is used up.
  void brake_blind(Eigen::VectorXd& tau) noexcept;

  static constexpr double full_brake_speed = 0.5;  ///< [rad/s] the torque shrinks with the rate below it
  static constexpr double soft_brake_speed = 5.0;  ///< the same, of a brake with a motor under suspicion
  static constexpr double trusted = 0.75;          ///< of 2 T / P: masses may be a quarter less
  static constexpr double look_every = 0.02;       ///< [s]
  static constexpr double growth = 1.1;            ///< of the sum of squared speeds at the rims,
  static constexpr double forgotten = 1.01;  ///< from the least it was; from look to look that counts less
  static constexpr double evenly = 0.95;     ///< of the same sum: less is braking
  static constexpr int even_looks = 3;       ///< before a motor is turned around
  static constexpr int drives = 2;           ///< of a motor that obeys
  static constexpr double most_by_a_push = 2.0;  ///< times the gain without that torque
  static constexpr double rest = 0.005;          ///< [m/s] root mean square at the rims
  static constexpr double slow = 0.02;           ///< [m/s] root mean square at the rims: as good as rest
  static constexpr double fast =
      0.3;  ///< [m/s] root mean square at the rims: faster than one motor drives a base

 private:
  struct DrivenWheel {
    int joint = 0;
    double radius = 0.0;  ///< [m]
    double limit = 0.0;   ///< [N m]
    double spin = 0.0;    ///< [kg m^2] about its axle, with its rotor
  };
  /// Of the whole robot at its joints' zero, seen from above, about the base's origin.
  struct PlanarInertia {
    double mass = 0.0;                                       ///< [kg]
    Eigen::Vector2d first_moment = Eigen::Vector2d::Zero();  ///< [kg m]
    double yaw = 0.0;                                        ///< [kg m^2]
  };
  static PlanarInertia planar_inertia(const solver::Model& model);
  void look(const Eigen::VectorXd& qd) noexcept;
  void begin_anew() noexcept;
  void take_a_drive(double speed) noexcept;
  void brake_with_the_suspect() noexcept;
  void brake_with_the_accused() noexcept;
  void leave_out_the_fastest(const Eigen::VectorXd& qd) noexcept;
  void leave_out_the_next() noexcept;
  int all() const noexcept { return static_cast<int>(wheels_.size()); }  ///< as `left_out_`
  bool has_tried_all() const noexcept { return tried_ > all() + 1; }
  void put(const Eigen::VectorXd& qd, double share, Eigen::VectorXd& tau) const noexcept;
  void begin_slope() noexcept;
  double allowed_rate(const DrivenWheel& wheel, double rate) const noexcept;
  bool is_on_slope() const noexcept { return slope_for_ < slope_time_; }
  double kinetic_energy() const noexcept;

  std::vector<DrivenWheel> wheels_;
  PlanarInertia inertia_;
  double period_;
  Eigen::VectorXd last_qd_;  ///< of the sample before the last one, as is the twist
  solver::MotionVector last_twist_;
  Eigen::VectorXd newest_qd_;  ///< that sample itself
  solver::MotionVector newest_twist_;
  double deceleration_;        ///< [m/s^2]
  double footprint_radius_;    ///< [m]
  Eigen::VectorXd first_qd_;   ///< when the brake began
  Eigen::VectorXd last_look_;  ///< [rad/s] rates at the last look
  bool slope_is_due_ = false;  ///< it begins with the next sample
  double slope_time_ = 0.0;    ///< [s] t_s
  double slope_for_ = 0.0;     ///< [s] t
  double blind_for_ = 0.0;     ///< [s]
  double blind_stop_ = 0.0;    ///< [s] 2 T / P
  double blind_share_ = 1.0;   ///< of the torques: P / T is no more than the deceleration of the stop
  int ticks_between_looks_;
  int ticks_ = 0;
  int left_out_ = -1;         ///< index into `wheels_`; -1: none, as many as there are: all
  double sense_ = 0.0;        ///< what its torque is multiplied with: 0, or -1 when it was turned around
  int first_left_out_ = -1;   ///< as the stop's reason has it
  double first_sense_ = 0.0;  ///< the same
  bool may_turn_ = true;
  int looks_turned_ = 0;      ///< since its torque was turned around
  double even_from_ = 0.0;    ///< [m/s] the root of the sum before the even looks
  double turned_at_ = 0.0;    ///< [m/s] the same as its torque was turned around
  double gain_before_ = 0.0;  ///< [m/s] of it from look to look, until then
  int drives_ = 0;            ///< by it, one after the other, that no push explains
  int even_looks_ = 0;
  int tried_ = 0;          ///< choices of a motor that is left out
  double believed_ = 0.0;  ///< [m/s] beyond it another motor is sought
  bool is_suspected_only_ = false;
  bool has_obeyed_ = false;
  bool may_be_mistaken_ = false;  ///< what is left out is taken for lost or reversed, not for stuck
  double last_sum_ = 0.0;         ///< [m^2/s^2]
  double least_sum_ = 0.0;        ///< [m^2/s^2] since the motors are chosen that brake
};

}  // namespace zwang::runtime
