/// The motion of the base by the model, while no encoder shows it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "estimate/disturbance.hpp"
#include "estimate/normal_equations.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// In the coordinates y of solver::FreeMotions the robot is a unit mass:
///   yd' = T' (tau - friction) + what the model says of the rest,   qd = T yd.
/// T has a row for each driven joint. Coordinates y are those of one tick: between ticks only rates of joints
/// are kept. The world acts on the base and on the joints of an arm, C' w with C = [B; T_arm]. Does not
/// allocate, lock, throw or print after construction.
class BlindMotion {
 public:
  /// Whose encoders tell, and whose motors give back.
  enum class Part { wheels, arm };
  BlindMotion(const lang::Robot& robot, Part part);

  struct DrivenJoint {
    int joint = 0;
    double radius = 0.0;    ///< [m] of its wheel, or of what it reaches; 0: it is not of this part
    double friction = 0.0;  ///< [N m] a torque of less moves nothing
    double effort = 0.0;    ///< [N m] of its motor; 0: it is not of this part, or its torque has no limit
    double limit = 0.0;     ///< [N m] with which it may brake: all wheels together press with `stop.force`
    bool turns_on = false;  ///< and on: whole turns do not count
    double weight = 0.0;    ///< [N m] that an arm's joint bears, of the last `expect`
    double lower = -std::numeric_limits<double>::infinity();  ///< [rad], [m] ends of an arm's joint
    double upper = std::numeric_limits<double>::infinity();
    int way_out = 0;  ///< 1, -1: it rests on its lower or upper end
  };
  const std::vector<DrivenJoint>& joints() const noexcept { return joints_; }

  /// No joint is of this part.
  bool is_empty() const noexcept { return is_empty_; }

  /// Predicts the motion under the torques that were sent. `model` knows them already. `friction` [N m] is
  /// the friction that `model` subtracted. `state` has the arm's weights and postures.
  void expect(const DisturbanceObserver& model, const Eigen::VectorXd& friction, const Eigen::VectorXd& sent,
              const solver::State& state) noexcept;
  /// Predicts the motion under a brake's torques when no rows were solved, at the state of the last `expect`.
  void expect_brake(const Eigen::VectorXd& sent) noexcept;

  int freedoms() const noexcept { return m_; }
  /// yd', `freedoms()` entries; 0 where no wheel's motor is told anything.
  const Eigen::VectorXd& acceleration() const noexcept { return a_; }
  /// B of this tick: of the base along its own x, y and about its own z, by `freedoms()` columns.
  const Eigen::MatrixXd& base() const noexcept { return B_; }
  double norm_of_row(std::size_t joint) const noexcept;

  /// Takes from yd what would move a joint beyond the end that it rests on.
  void keep_in_travel(Eigen::VectorXd& y) const noexcept;

  /// Rates by driven joint [rad/s] to yd, by least squares, and back.
  void to_motions(const Eigen::VectorXd& rates, Eigen::VectorXd& y) noexcept;
  void to_rates(const Eigen::VectorXd& y, Eigen::VectorXd& rates) const noexcept;
  /// w of p = C' w: on the base x, y [N], rz [N m], then by joint of an arm; and back.
  void to_wrench(const Eigen::VectorXd& p, Eigen::VectorXd& w) noexcept;
  void to_force(const Eigen::VectorXd& w, Eigen::VectorXd& p) const noexcept;
  Eigen::Index wrench_size() const noexcept { return C_turned_.cols(); }
  Eigen::Index most_freedoms() const noexcept { return T_.cols(); }
  /// The torques that take yd away within `time` [s], or as much of it as their limits let them; an arm's
  /// bear it, too. False, and 0 or the weights, where no motor would be told more than what moves nothing.
  bool to_stop(const Eigen::VectorXd& y, double time, Eigen::VectorXd& tau) noexcept;

  /// Of a motor's limit: what gears and bearings take that no file declares.
  static constexpr double least_torque = 2e-3;
  static constexpr double least_torque_of_arm = 1e-2;  ///< the same of its gears
  static constexpr double weight_error = 0.05;  ///< of an arm's weight: payloads and masses that no file says
  static constexpr double rest = 0.02;          ///< [rad], [m] from an end in which a joint rests on it

 private:
  void find_weights(const solver::State& state) noexcept;
  void take_motions(const solver::FreeMotions& motions) noexcept;
  std::vector<DrivenJoint> joints_;
  Part part_;
  bool is_empty_ = true;
  std::vector<std::size_t> arm_;  ///< of `joints_`: those that carry no wheel
  int m_ = 0;
  std::uint64_t factorisation_ = 0;  ///< of the solver, to which the matrices belong
  Eigen::MatrixXd T_, B_, C_turned_, T_wheels_turned_;
  NormalEquations T_factor_, C_factor_, wheel_factor_;
  Eigen::VectorXd a_, lost_, right_, expected_, torques_;
};

}  // namespace zwang::runtime
