/// The friction of the joints now, and the part of it that is compensated.
#pragma once

#include <vector>

#include "zwang/lang/robot.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// Dry and viscous friction of each joint:
///   f = coulomb ((1 - w) qd / sqrt(qd^2 + taper^2) + w z / delta) + viscous qd.
/// The fraction c of it that the robot file says to `compensate` is added to the torque. It comes on top of
/// the rows' torques, outside of their bounds.
///
/// While a joint moves, both terms follow its direction. At rest the first is 0: no friction is compensated,
/// and no motor bears an unrequested load. But that takes up to sum coulomb / R from a push without a
/// sensor, or adds as much once the base has rolled back. So the second term counts as far as a joint
/// presses, w = min(1, |press| / coulomb). It is the stretch of a bristle that yields (Dahl):
///   z <- clamp(z + dq, -delta, delta),   delta = presliding, w = 0 where that is not known.
/// The bristle remembers the last direction through a bounce, too. Once the base has rolled back, friction
/// helps the push, and the added part is negative. At rest the robot presses on the world with F + sum e / R,
///   e = c coulomb z/delta - (true coulomb) (true z) / (true delta).
/// After a push forward e is c coulomb - (true coulomb). If all parameters are right, it is at most
/// (1 - c) coulomb.
///
/// Passivity. With the play P_r = q - z of a bristle that yields at r, the work done against it is
///   int coulomb z/r dq = coulomb r/2 [(z/r)^2] + coulomb Var(P_r).
/// The first term is stored, the second is dissipated; Var is the play's way there and back. The play of a
/// longer bristle is a play of the shorter one's, P_R = P_(R-r) of P_r, and no play goes farther than its
/// input. So friction takes at least as much as its compensation gives, apart from bounded stores. This holds
/// for any motion, while
///   c coulomb <= true coulomb   and   delta >= true delta.
/// With c = 80 % a coulomb may be 25 % too large. If delta is too short, swings smaller than the true delta
/// gain at most 4 c coulomb (true delta - delta) each; one mass and spring rings from 0.7 on. If delta is too
/// long, it still has the old direction when friction has the new one:
///   |e| <= coulomb (1 + c - 2 c true/delta),
/// that is 0.4 coulomb at 1.14, and up to 2 no more than without compensation. An encoder's noise of the
/// amplitude n shakes the torque by c coulomb n/delta and keeps z/delta short of 1 by n/delta.
///
/// Does not allocate, lock, throw or print after construction.
class FrictionEstimate {
 public:
  explicit FrictionEstimate(const lang::Robot& robot);

  bool empty() const noexcept { return terms_.empty(); }
  /// The joints' positions, once a sample.
  void follow(const Eigen::VectorXd& q) noexcept;
  /// f at the joints' rates, `press` [N m] or [N] what each joint presses with.
  void update(const Eigen::VectorXd& qd, const Eigen::VectorXd& press) noexcept;
  /// f by joint, against the motion [N m] or [N].
  const Eigen::VectorXd& torque() const noexcept { return torque_; }
  /// The part of it that is compensated.
  void compensate(Eigen::VectorXd& tau) const noexcept;

  static constexpr double turn_taper = 0.2;    ///< [rad/s]
  static constexpr double slide_taper = 0.01;  ///< [m/s]

 private:
  struct Term {
    int joint = 0;
    lang::JointFriction friction;
    bool turns = true;
    double stretch = 0.0;  ///< z
    double q = 0.0;        ///< of the last sample
  };
  std::vector<Term> terms_;
  Eigen::VectorXd torque_;
  bool is_followed_ = false;
};

}  // namespace zwang::runtime
