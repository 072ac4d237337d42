/// Bounds the motion that motors make and no encoder confirms.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "estimate/disturbance.hpp"
#include "guard/blind_motion.hpp"
#include "guard/felt_contact.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

/// A sign of life is a change of any driven wheel's position. Between two signs the model moves the base by
/// its torques. It starts at the rates v of the last sign less `slowest` of each rim:
///   s = integral of max_j r_j |v_j| dt,   v' = T yd' of BlindMotion and FeltContact.
/// The budget is S = max(`least_budget`, 4 d r), with d the least step that was ever counted, or that of the
/// robot file. When s exceeds S, the motors take back the motion v, whatever the mass. A free base then
/// stands again, and a base at a wall comes off it. Two signs of life meanwhile end this look. Without them,
/// the state of the base is unknown. Above `look_below` the wait is as long as for lost samples. The check
/// makes no diagnosis. Dead encoders, a driver that repeats itself, motors without power and an engaged brake
/// look alike. Does not allocate, lock, throw or print after construction.
class BlindBudget {
 public:
  /// Of an arm the encoders of its joints count in the place of the wheels', with what they reach in the
  /// place of a radius. Its presses are not asked: each count of such an encoder is a good part of them.
  BlindBudget(const lang::Robot& robot, BlindMotion::Part part);

  /// Every good sample: the positions as they were measured. `frozen` when nothing answers, with the way [m]
  /// that was not confirmed; `probed` when something does.
  std::optional<Event> look(const Eigen::VectorXd& q, double time) noexcept;
  /// Takes the torques that were sent since that sample, as BlindMotion does.
  void expect(const DisturbanceObserver& model, const Eigen::VectorXd& friction, const Eigen::VectorXd& sent,
              const solver::State& state) noexcept {
    motion_.expect(model, friction, sent, state);
  }
  void expect_brake(const Eigen::VectorXd& sent) noexcept { motion_.expect_brake(sent); }

  /// A hook that is held from now on at this point of the base [m], where no budget is being given back.
  /// `is_to_move`: the task asks for motion, so the hook is asked as any contact is.
  void tie(double x, double y, bool is_to_move) noexcept;
  void untie() noexcept { contact_.untie(); }
  /// The other part of the robot is blind. Where this one counts nothing either, it is asked at once.
  void doubt() noexcept;
  /// Forgets what was seen and told, as after a stop that is reset.
  void begin() noexcept { has_last_ = false; }

  /// The wheels are to get the torques of `give_back`.
  bool takes_over() const noexcept { return phase_ != Phase::counts; }
  /// The model's motors would have moved a rim at `slowest` since the last sign of life, but for a contact.
  /// No encoder says whether that contact is still there.
  bool leans() noexcept;
  /// The wheels are to get the torques of `slacken`.
  bool asks() const noexcept { return phase_ == Phase::counts && asked_for_ > 0.0; }
  void slacken(Eigen::VectorXd& tau) const noexcept;
  /// [s] since the last sign of life.
  double silent_for() const noexcept { return gap_; }
  /// Rates are not to be believed.
  bool is_blind() const noexcept { return phase_ == Phase::blind; }
  /// Sets the torques of its part.
  void give_back(Eigen::VectorXd& tau) noexcept;

  static constexpr double least_budget = lang::least_blind_way;  ///< [m]
  static constexpr double least_arm_budget = 2e-3;    ///< [m] of what it reaches: gears give by half of that
  static constexpr double steps = lang::blind_steps;  ///< of the encoder, at the rim
  static constexpr double arm_steps = 16.0;           ///< of an arm's: its joints count one after the other
  static constexpr double least_change = 1e-7;    ///< [rad] of a position: an encoder of 25 bits counts 2e-7
  static constexpr double slowest = 0.01;         ///< [m/s] at a rim: rolling on at that does no harm
  static constexpr double rate_low_pass = 0.005;  ///< [s]
  static constexpr double arm_low_pass = 0.05;    ///< [s] a count of 1e-3 rad in 1 ms is 0.8 m/s at 0.8 m
  static constexpr double look_below = 0.05;      ///< [m/s] at a rim: above it the wait is short
  static constexpr double ridden_through = 0.02;  ///< [s] of a look at such a speed, as of lost samples
  static constexpr double least_look = 0.1e-3;    ///< [m] of the way that is given back
  static constexpr double quickest_look = 0.005;  ///< [s] in which it is given back, e-fold
  static constexpr double longest_look = 0.15;    ///< [s]
  static constexpr double answers_within = 0.02;  ///< [s] after that, and
  static constexpr double longest_count = 0.1;    ///< [s] at most more for the counts of a coarse encoder
  static constexpr double most_lean = 0.04;       ///< [m/s] at a rim, if the contact has gone
  static constexpr double slackens_for = 0.06;    ///< [s] from all of the press to none of it
  static constexpr double comes_off = 0.02;       ///< [m/s] at a rim: 0.4 mm within `answers_within`
  static constexpr double held = 0.5;             ///< of what is given back: the world held it off
  static constexpr int signs_of_life = 2;         ///< that are an answer
  static constexpr double near = 2.0;             ///< budgets around where a look found a contact
  static constexpr double longest = 0.1;          ///< [s] from one sample to the next, lost ones between

 private:
  enum class Phase { counts, looks, blind };
  void remember(const Eigen::VectorXd& q) noexcept;
  void begin(const Eigen::VectorXd& q) noexcept;
  bool take_steps(const Eigen::VectorXd& q) noexcept;
  void learn() noexcept;
  void feel() noexcept;
  double way_from_the_found() const noexcept;
  void set_out_from(const Eigen::VectorXd& rates) noexcept;
  double rim_speed(const Eigen::VectorXd& rates) noexcept;
  double budget() const noexcept;
  double time_of_counts(double acceleration) const noexcept;
  Event event(EventCode code) const noexcept;
  std::optional<Event> spend(double dt) noexcept;
  void begin_look(double speed, double acceleration) noexcept;
  void ask_the_contact(double dt) noexcept;
  /// The latch says that the hook holds, and the task only pulls on it.
  bool is_excused() const noexcept {
    return part_ == BlindMotion::Part::arm || (contact_.is_tied() && !is_to_move_);
  }
  std::optional<Event> wait_for_an_answer(bool is_alive, double dt) noexcept;

  BlindMotion::Part part_;
  BlindMotion motion_;
  FeltContact contact_;
  Phase phase_ = Phase::counts;
  // By driven joint [rad], [rad/s].
  Eigen::VectorXd q_;       ///< of the last sign of life
  Eigen::VectorXd rates_;   ///< up to it, of the whole time since the one before
  Eigen::VectorXd mean_;    ///< their low pass
  Eigen::VectorXd change_;  ///< of rates that the model expects since then
  Eigen::VectorXd now_;     ///< rates up to this sign
  Eigen::VectorXd v_;       ///< by the model
  Eigen::VectorXd found_;   ///< where a look was answered last [rad]
  Eigen::VectorXd lean_;    ///< that contacts took from the model, since the last sign of life
  Eigen::VectorXd y_, p_, told_;
  double time_ = 0.0;
  double gap_ = 0.0;        ///< [s] since the last sign of life
  double s_ = 0.0;          ///< [m]
  double asked_for_ = 0.0;  ///< [s] that the press has slackened; 0: it does not
  double rim_step_ =
      std::numeric_limits<double>::infinity();  ///< [m] the least that was ever counted, or told
  int fastest_ = 0;                             ///< the joint whose rim is
  bool has_last_ = false, has_rates_ = false;
  bool is_to_move_ = false;  ///< although a hook holds the base
  // While it is given back.
  double time_constant_ = 0.0;                  ///< [s]
  double looked_for_ = 0.0, waited_for_ = 0.0;  ///< [s]
  double patience_ = answers_within;            ///< [s] for an answer, after that
  double spent_ = 0.0;                          ///< |yd| that is to be given back
  bool is_fast_ = false;
  int answers_ = 0;
  bool gives_ = false;  ///< something is left to give back
};

}  // namespace zwang::runtime
