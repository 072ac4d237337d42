/// The requests of a live page to the simulated world.
#pragma once

#include <string>
#include <vector>

#include "json_parts.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/hand.hpp"

namespace zwang::cli {

/// The hand of the page's user. A request that cannot be met changes nothing.
class LiveHand {
 public:
  LiveHand() = default;
  /// That does nothing yet. The program has a scene.
  explicit LiveHand(const lang::Program& program);

  /// The choices of the page: `signals`, `faults` and `objects` by name. A fault has its `words`, or the
  /// `unit`, `low` and `high` of its number.
  nlohmann::ordered_json choices() const;
  /// The choices in force: the signals that are `blocked`, and `faults` by name, each a word or a number.
  nlohmann::ordered_json in_force() const;

  /// `{"do": "push", "at": [x, y], "force": [x, y]}`: 500 N at most, within 5 m of the base's origin;
  /// `{"do": "block", "name": SIGNAL, "value": true}`;
  /// `{"do": "fault", "name": FAULT, "value": a word, a number, or null for none}`;
  /// `{"do": "move", "name": OBJECT, "to": [x, y], "yaw": rad}`. Gives the reason why it is refused, else
  /// nothing, and nothing of a request of another kind.
  std::string obey(const nlohmann::json& request);
  void let_go() { hand_.push = {}; }

  const runtime::Hand& hand() const { return hand_; }

 private:
  std::string press(const nlohmann::json& request);
  std::string block(const nlohmann::json& request);
  std::string put_fault(const nlohmann::json& request);
  std::string move_object(const nlohmann::json& request);

  std::vector<std::string> signals_;  ///< by the program; empty: the scene does not give it
  std::vector<std::string> objects_;
  std::vector<runtime::FaultSwitch> switches_;
  runtime::Hand hand_;
};

}  // namespace zwang::cli
