/// What the friction of the joints takes now, and the part of it that is made up for.
#pragma once

#include <vector>

#include "zwang/lang/robot.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// Dry and viscous friction of each joint:
///   f = coulomb ((1 - w) qd / sqrt(qd^2 + taper^2) + w z / delta) + viscous qd,
/// The fraction c of it that the robot file says to `compensate` is added to the torque. It comes on top of
/// what the rows ask for, outside of their bounds.
///
/// While a joint moves, both terms follow its direction. Where it stands the first is 0: nothing is made up
/// for, and no motor bears what nobody asked for. But that takes up to sum coulomb / R from a push without a
/// sensor, or adds as much once the base has rolled back. So as far as a joint presses,
/// w = min(1, |press| / coulomb), the second term counts, the stretch of a bristle that yields (Dahl):
///   z <- clamp(z + dq, -delta, delta),   delta = presliding, w = 0 where that is not known.
/// It remembers the last direction through a bounce, too: once the base has rolled back, friction helps the
/// push, and the part that is added is negative. At rest the world is pressed with F + sum e / R,
///   e = c coulomb z/delta - (true coulomb) (true z) / (true delta),
/// of a push that has come forward c coulomb - (true coulomb), of all that is right at most (1 - c) coulomb.
///
/// Passivity. With the play P_r = q - z of a bristle that gives r, the work done against it is
///   int coulomb z/r dq = coulomb r/2 [(z/r)^2] + coulomb Var(P_r):
/// what it stores, and what it takes for good, Var being the play's way there and back. The play of a longer
/// bristle is a play of the shorter one's, P_R = P_(R-r) of P_r, and no play goes farther than what it
/// follows. So friction takes at least as much as its compensation gives, bounded stores apart, whatever the
/// motion, while
///   c coulomb <= true coulomb   and   delta >= true delta.
/// With c = 80 % a coulomb may be 25 % too large. A delta that is too short feeds swings of less than the
/// true one, with 4 c coulomb (true delta - delta) a swing at most; one mass and spring rings from 0.7 on.
/// One that is too long has the old direction still when friction has the new one: |e| <= coulomb (1 + c - 2
/// c true/delta), 0.4 coulomb at 1.14, no more than without compensation up to 2. An encoder's noise of the
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
  /// The part of it that is made up for.
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
