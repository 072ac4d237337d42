/// Friction and torque constants of a base's motors, from how it moved.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::runtime {

struct TwinLines;

/// Why nothing could be told, in words for the user.
class ZWANG_EXPORT NotIdentified : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A number with its standard error, both in the same unit.
struct Estimate {
  double value = 0.0;
  double error = 0.0;  ///< standard error; 0 of what was given
};

/// The estimates of one motor.
struct IdentifiedMotor {
  std::string joint;
  Estimate torque_factor;  ///< what the motor gives of the torque it is told
  Estimate coulomb;        ///< [N m]
  Estimate viscous;        ///< [N m s/rad]
};

/// The result: all motors, the mass and the inertia.
struct Identification {
  std::vector<IdentifiedMotor> motors;
  Estimate mass;     ///< [kg] without the added load
  Estimate inertia;  ///< [kg m^2] about the vertical through the base's origin
  double lag = 0.0;  ///< [s] of the samples behind the torques
  std::size_t windows = 0;
};

/// Takes the records of one run after the other, and estimates by instrumental variables. Equations: in the
/// source.
class ZWANG_EXPORT DriveIdentification {
 public:
  /// Without `mass` [kg] it is estimated, too: one of the runs must carry a known load. Throws NotIdentified
  /// on a robot whose motors do not turn wheels that are fixed to the base, or are not told torques.
  DriveIdentification(const lang::Robot& robot, std::optional<double> mass);

  /// A run, with `added_load` [kg] over the base's centre of mass.
  void begin_run(double added_load);
  /// Of all joints of the model: positions [rad], rates [rad/s], which may come late or through a low pass,
  /// and the torques sent [N m] at `time` [s].
  void add(double time, const Eigen::VectorXd& q, const Eigen::VectorXd& qd, const Eigen::VectorXd& tau);

  /// Throws NotIdentified where the motion tells too little.
  Identification solve() const;

 private:
  struct Wheel {
    int joint = 0;
    std::string name;
    bool has_motor = false;
    double inertia = 0.0;   ///< [kg m^2] about its axis, rotor included
    Eigen::Vector3d rates;  ///< j: rate [rad/s] = j . (vx, vy, wz)
    Eigen::Vector3d twist;  ///< its part of (vx, vy, wz) is this times its rate
  };
  struct Sample {
    double time = 0.0;
    Eigen::VectorXd measured;  ///< [rad/s] rates of the wheels, late perhaps
    Eigen::VectorXd rates;     ///< [rad/s] the same, from the positions
    Eigen::Vector3d twist;     ///< (vx, vy, wz) of the base, in its axes
    Eigen::VectorXd q, tau;    ///< [rad] and, until the next one, [N m], of all joints
  };
  /// Sums over a window, weighed by the trapezoid.
  struct Window {
    Eigen::MatrixXd impulse;  ///< [N m s] of the joints, a column for each lag of the samples
    Eigen::VectorXd angle;    ///< [rad]
    Eigen::Vector3d turned;   ///< of w x p and v x p, a mass's share
    double seconds = 0.0;
  };
  /// left . b = right. The factors of the torques depend on the lag: a column of `impulses` for each.
  struct Lines {
    std::vector<Eigen::VectorXd> left;
    std::vector<Eigen::MatrixXd> impulses;
    std::vector<double> right;
  };
  void find_wheels(const lang::Robot& robot);
  void permit(const std::vector<Eigen::Vector3d>& held);
  void end_window();
  void take_rates();
  bool rolls_on_at_the_ends() const;
  Eigen::VectorXd impulse_until(double time) const;
  Eigen::MatrixXd impulses(const std::vector<double>& f) const;
  std::vector<double> trapezoid() const;
  Eigen::VectorXd weights(const std::vector<double>& f, std::size_t parity) const;
  void add_lines(const Window& sums, const Eigen::VectorXd& weights, Lines& lines) const;
  /// m^-1 (p_x, p_y, L - J w) of a twist.
  Eigen::Vector3d momentum_per_mass(const Eigen::Vector3d& twist) const;
  Eigen::Index columns() const;
  TwinLines lines_at(double lag) const;
  double find_lag() const;

  std::vector<Wheel> wheels_;               ///< that stand fixed to the base
  std::vector<int> swivels_;                ///< joints of casters
  std::vector<std::size_t> motors_;         ///< of `wheels_`
  std::vector<Eigen::Vector3d> permitted_;  ///< B: motions that no wheel holds, orthonormal
  Eigen::Vector2d centre_;                  ///< [m] of mass, in the base
  double caster_mass_ = 0.0;                ///< [kg] that the spin of caster wheels adds along x and y
  double length_ = 0.3;                     ///< [m] makes forces of torques
  std::optional<double> mass_;
  double added_load_ = 0.0;
  std::vector<Sample> samples_;          ///< of the window that is open
  std::vector<double> pushed_at_;        ///< [s]
  std::vector<Eigen::VectorXd> pushed_;  ///< [N m s] of the joints until then
  bool is_clean_ = true;                 ///< the forces of that window are those of sliding friction
  Lines even_, odd_;                     ///< by the rates of every other sample
};

}  // namespace zwang::runtime
