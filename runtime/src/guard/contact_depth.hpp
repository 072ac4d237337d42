/// How deep contacts are pressed in, to tell a spring that gives back from a motor that drives.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "guard/wheel_motors.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// Against a force p from outside the robot moves by
///   ds = - p . yd / |p| dt,
/// in coordinates in which it is a unit mass [m sqrt(kg)]. Summed since the onset of p, that is at most the
/// depth x of the contact. It is an upper bound, as sliding takes way, too; so x ends at `deepest`. The
/// contact took the work E = -p . yd dt, of which damping keeps some. A contact that gives back is a spring:
///  - It weakens: on the way s back its force falls by the part s / x, and grows by it on the way s ahead.
///  - It gives no more than E.
/// Softness does not change this: 20 N of 1 kN/m are 2 cm deep, and 1 mm back is a twentieth of them. A force
/// that neither weakens on the way back nor grows on the way in, as a spring does, is not a contact force. At
/// the deepest point the robot does not move. There |p| is the spring's force alone, while at the hit damping
/// may be the larger part. If |p| falls below `quiet` of that, the contact is over. Another one that pressed
/// before it presses on: a wall beside one that is hit. So x and E are kept of each level of |p|, from 2^i to
/// 2^(i+1), as it was pressed in. Does not allocate, lock, throw or print after construction.
class ContactDepth {
 public:
  using Force = Eigen::Ref<const Eigen::VectorXd>;
  /// `period` [s] between looks.
  ContactDepth(const lang::Robot& robot, double period);

  void reset() noexcept;
  /// p, what it does, P = p . yd [W], and the energy of the motion, T = |yd|^2 / 2 [J].
  void follow(const solver::FreeMotions& motions, Force p, double power, double kinetic_energy) noexcept;

  /// A moment to look back to.
  struct Mark {
    double size = 0.0;   ///< |p|
    double depth = 0.0;  ///< x
    double work = 0.0;   ///< [J] that the world may have stored
    double way = 0.0;    ///< that the world drove the robot, in all
    double given = 0.0;  ///< [J] of work it did on the robot, in all
    double gone = 0.0;   ///< that the robot went, in any direction, in all
  };
  const Mark& now() const noexcept { return now_; }
  /// Whether p since then did what no spring does.
  bool is_no_spring(const Mark& since) const noexcept;

  /// Whether the robot went along p since then, by this share of its way. A thing that stands drives no way
  /// at all, however the robot turns about it.
  bool goes_along(const Mark& since, double share) const noexcept;

  static constexpr double unexplained = 0.05;  ///< of x: the least way that a spring does not explain
  static constexpr double deepest = 0.1;       ///< [m] times the root of the robot's mass
  static constexpr double quiet = 0.1;         ///< of |p| at the deepest: a hundredth of what a spring stored
  static constexpr double smallest = 0.015;    ///< torque of a motor that counts as a force, of its limit
  static constexpr int lowest_level = -10;     ///< of |p|, 2^-10 N/sqrt(kg): less than any motor's threshold
  static constexpr int levels = 24;            ///< to 2^14 N/sqrt(kg), 100 kN on 40 kg

 private:
  /// x and E at a level of |p|, when the contact was last pressed in there.
  struct Held {
    double depth = 0.0, work = 0.0;
    bool is_known = false;
  };
  void forget() noexcept;
  void keep_what_pressed_before(int level) noexcept;
  void remember(int level) noexcept;

  std::vector<WheelMotor> motors_;
  double period_;
  double deepest_;  ///< [m sqrt(kg)]
  Mark now_;
  double deepest_yet_ = 0.0, force_when_deepest_ = 0.0;  ///< x and |p|, since it began
  std::array<Held, levels> held_;
  int level_ = -1;  ///< of |p| as it was last pressed in; -1: no contact
};

}  // namespace zwang::runtime
