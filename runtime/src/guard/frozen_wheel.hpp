/// Detects a dead encoder of one wheel.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// A frozen wheel contradicts the other wheels about the base's motion. With as many wheels as freedoms no
/// other measurement shows it. A wheel counts as frozen in two cases:
///  - It rolled evenly, and then keeps the same position to the bit, while at least half of the others roll
///    on. A hit that stops one wheel takes some time. It leaves neither this wheel quite still nor the others
///    unchanged.
///  - Its motor is told to turn it, it is as still, and the others roll a good way. It also does not answer
///    when it is told the opposite for a moment. If a single wheel spins, the standing ones are not reported.
///
/// A wheel that a wall holds stands for long between two counts of a coarse encoder, too. But it answers, and
/// is asked again after twice the way. Does not allocate, lock, throw or print after construction.
class FrozenWheel {
 public:
  explicit FrozenWheel(const lang::Robot& robot);

  /// Every good sample, as it was measured, and what was sent last. The event's value: the rate that the
  /// wheel had before.
  std::optional<Event> look(const solver::State& state, const Eigen::VectorXd& sent, double time) noexcept;
  /// Sets the torque of a wheel that is asked.
  void ask(Eigen::VectorXd& tau) const noexcept;

  static constexpr double window = 0.05;     ///< [s]
  static constexpr int windows = 2;          ///< in a row without a change
  static constexpr double rolled = 0.02;     ///< [rad] in each of two windows before that,
  static constexpr double steps = 2.0;       ///< and of its encoder
  static constexpr double rolls_on = 0.5;    ///< of its own way before that, and of `rolled`: another wheel
  static constexpr double good_way = 1.0;    ///< [rad] of another wheel
  static constexpr double farthest = 8.0;    ///< [rad] the same, of a wheel that has answered
  static constexpr double smallest = 0.03;   ///< torque that turns a wheel, of its motor's limit
  static constexpr double asked_with = 2.0;  ///< of that, at least
  static constexpr double answers_within = 0.04;  ///< [s]
  static constexpr int signs_of_life = 2;         ///< that are an answer

 private:
  struct Wheel {
    int joint = 0;
    double threshold = 0.0;  ///< [N m]
    double q = 0.0;          ///< [rad] of the last sample
    double step = 0.0;       ///< [rad] the least that q has changed by; 0: not yet
    // In this window.
    double began = 0.0;  ///< [rad]
    bool is_still = true;
    double impulse = 0.0;  ///< [N m s] that was sent
    // In those before it.
    double way = 0.0;                          ///< [rad] the last that it moved in, when it may have died
    double way_before = 0.0, way_first = 0.0;  ///< [rad] the two before that
    int still_windows = 0;
    double way_of_another = 0.0;  ///< [rad] while it stood and was told to turn
    double told = 0.0;            ///< [N m] in the last window
    double patience = good_way;   ///< [rad] of another wheel, until it is asked
    double way_rolled() const { return way_before < way_first ? way_before : way_first; }
  };
  void begin(const solver::State& state, double time) noexcept;
  Event event_of(const Wheel& frozen) const noexcept;
  static void end_window(Wheel& wheel, double longest) noexcept;
  void begin_to_ask(const Wheel& wheel) noexcept;
  bool is_left_unanswered(const solver::State& state, double dt) noexcept;

  std::vector<Wheel> wheels_;
  int asked_ = -1;             ///< of `wheels_`; -1: none
  double asked_torque_ = 0.0;  ///< [N m]
  double asked_for_ = 0.0;     ///< [s]
  int answers_ = 0;
  double last_time_ = 0.0;
  double began_ = 0.0;  ///< [s] the window
  bool has_last_ = false;
};

}  // namespace zwang::runtime
