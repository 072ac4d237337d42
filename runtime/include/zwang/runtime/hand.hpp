/// A person's hand on a simulated world: it pushes, blocks signals, puts on faults and moves objects.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

/// A fault that a hand can put on the first robot or on its world: one of some words, or a number.
struct ZWANG_EXPORT FaultSwitch {
  std::string name;                    ///< `samples`, `torque.front_left_wheel`, `payload`
  std::vector<std::string> words;      ///< `none` first; empty: a number
  std::vector<lang::FaultKind> kinds;  ///< of the words behind `none`, or of the number
  std::string joint;                   ///< empty: of no joint
  std::string unit;                    ///< of the number; empty: a plain one
  double low = 0.0, high = 0.0;        ///< of the number, in SI

  double nothing() const;  ///< the value without a fault: the place of `none`, or NaN
  bool has(double value) const;
};
/// Each fault that scenes know, of each joint that it can be of.
ZWANG_EXPORT std::vector<FaultSwitch> fault_switches(const lang::Robot& robot);

/// The object that was sent somewhere last.
struct SentObject {
  int object = -1;             ///< in Scene::objects; -1: none
  std::array<double, 2> to{};  ///< [m] of its `at`, in the world
  double yaw = 0.0;            ///< [rad]
  bool operator==(const SentObject&) const = default;
};

/// All actions of a hand at one instant.
struct Hand {
  Push push;
  std::vector<bool> blocked;   ///< of Program::signals: nothing is measured
  std::vector<double> faults;  ///< of each switch the place of its word, or its number
  SentObject sent;
};
/// That does nothing.
ZWANG_EXPORT Hand idle_hand(const lang::Program& program);

/// How fast a hand moves an object: no faster than either.
inline constexpr double hand_speed = 0.25;  // [m/s]
inline constexpr double hand_turn = 0.8;    // [rad/s]

/// Signals of the program that its scene gives, by their places in Program::signals.
ZWANG_EXPORT std::vector<std::size_t> given_signals(const lang::Program& program);

/// The log's columns of a hand. The point of its push is in the base's axes, the force in the world's. Behind
/// them stand the signals that it may block, the faults, and where it has sent an object. The last columns
/// are the places of objects that nothing else moves.
class ZWANG_EXPORT HandColumns {
 public:
  /// The program has a scene.
  explicit HandColumns(const lang::Program& program);
  const std::vector<Column>& columns() const noexcept { return columns_; }
  /// In the order of the columns, as many values.
  void put(const Hand& hand, const Truth& truth, std::span<double> values) const noexcept;

 private:
  std::vector<std::size_t> signals_;  ///< `given_signals`
  std::vector<std::size_t> fixed_;    ///< objects, by their numbers in the scene
  std::vector<Column> columns_;
};

}  // namespace zwang::runtime
