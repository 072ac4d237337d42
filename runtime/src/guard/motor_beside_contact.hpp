/// Finds a motor that does not follow its command while the robot touches an object.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "estimate/disturbance.hpp"
#include "guard/contact_depth.hpp"
#include "guard/obedience.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

/// One contact presses along one line: however hard it presses, its force p = n f(t) on the free motions
/// keeps to n. A motor j that gives (1 - gamma) tau_j adds - gamma tau_j T_j and takes p off that line. <> is
/// the mean over the last while. With r = p + gamma tau_j T_j and R = <r r'>,
///   N(gamma) = (tr(R)^2 - |R|^2) / 2 = N0 + N1 gamma + N2 gamma^2
/// is the sum of R's principal minors, and 0 where r keeps to a line. N is smallest at gamma = 1 for a motor
/// that gives nothing, and at 2 for one that gives the opposite. A stuck motor has another gamma. Where next
/// to nothing is left of N0, the fault is motor j beside one contact. Friction turns n, too, but not by one
/// motor's command while f varies. As long as f does not vary, p is on a line in any case, and no fault is
/// reported. The exception is a motor that breaks then: p leaves the line that it had. So gamma is sought
/// twice. The first search is for a motor that was broken all the while, unless it was seen to obey
/// (Obedience). The second is for a motor that broke when p last left its line. The check needs three free
/// motions: with two, two contacts can have the effect of a motor. In a corner, the steady push of one wall
/// leaves the line of a hit on the other. Then p keeps off that line as with a motor. Two laws
/// of a contact refute that motor:
///  - A contact never pulls. The hardest p that the means still know is the hit. r may not be against it.
///  - A standing wall is a spring, and two of them are one. So p must do what no spring does (ContactDepth).
/// Does not allocate, lock, throw or print after construction.
class MotorBesideContact {
 public:
  MotorBesideContact(const lang::Robot& robot, double period);

  void reset() noexcept;
  /// After each comparison of the observer; `q` are the joints' positions.
  std::optional<Event> look(const DisturbanceObserver& observer, const Eigen::VectorXd& q,
                            const ContactDepth& contact) noexcept;

  static constexpr double memory = 0.02;  ///< [s] of the means
  static constexpr double dwell =
      0.06;  ///< [s] that a motor must explain the force: longer than the means remember a hit
  static constexpr double travel = 0.5e-3;    ///< [m] of the wheel's rim meanwhile
  static constexpr double left = 1.0 / 30.0;  ///< of N0: the most that a motor may leave
  static constexpr double visible = 0.1;      ///< of the motor's own square: the least that is off the line
  static constexpr double least_gamma = 0.4;  ///< less may be the model's error,
  static constexpr double most_gamma = 2.4;   ///< and more than twice the command is not a motor's
  static constexpr double strict = 10.0;      ///< times as well a stuck motor has to fit
  static constexpr double near = 0.2;         ///< of gamma, to what it is for a kind of fault
  static constexpr double smallest = 0.03;    ///< torque that is missed, of the motor's limit
  static constexpr double another = 0.1;      ///< of the size of all T: coordinates that were turned
  static constexpr double quiet = 0.01;       ///< [s] on a line, before p can leave it

 private:
  static constexpr int freedoms = 3;
  using Vector = Eigen::Matrix<double, freedoms, 1>;
  using Matrix = Eigen::Matrix<double, freedoms, freedoms>;
  /// Over the time that a motor may have been broken.
  struct Since {
    Vector p_tau = Vector::Zero();   ///< <p tau_j>
    double tau_tau = 0.0;            ///< <tau_j^2>
    int ticks = 0;                   ///< that it has explained the force
    double least = 0.0, most = 0.0;  ///< [m] where its rim was meanwhile
    ContactDepth::Mark contact;      ///< when it began to explain the force
    double tau_of_hit = 0.0;         ///< [N m] tau_j at the hardest p
  };
  struct Motor {
    int joint = 0;
    double radius = 0.0;         ///< [m]
    double threshold = 0.0;      ///< [N m]
    Vector T = Vector::Zero();   ///< of the last tick
    std::array<Since, 2> since;  ///< all the while; since p left its line
    Obedience obedience;
  };
  void forget_means() noexcept;
  bool take_directions(const solver::FreeMotions& motions) noexcept;
  double broken_part(const Vector& p, int window) noexcept;
  void keep_hardest(const Vector& p, const std::array<double, 2>& parts,
                    const Eigen::VectorXd& told) noexcept;
  bool pulls(const Since& since, const Motor& motor, const Vector& p, double gamma,
             double tau) const noexcept;
  double find_gamma(const Since& since, const Motor& motor, const Vector& T) const noexcept;

  std::vector<Motor> motors_;
  Matrix p_p_ = Matrix::Zero();    ///< <p p'>
  Vector hit_ = Vector::Zero();    ///< the p with the largest share of it
  double share_of_hit_ = 0.0;      ///< |p|^2 of it, faded as in the mean
  Vector line_ = Vector::UnitX();  ///< n
  double trace_ = 0.0;             ///< of it
  double off_line_ = 0.0;          ///< N0
  double part_;
  int dwell_ticks_, quiet_ticks_;
  int ticks_on_line_ = 0, ticks_off_line_ = 0;
};

}  // namespace zwang::runtime
