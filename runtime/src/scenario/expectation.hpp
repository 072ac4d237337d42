/// One expectation, followed through a run.
#pragma once

#include <limits>
#include <vector>

#include "scenario/true_facts.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/runtime/scenario_run.hpp"

namespace zwang::runtime {

/// The result of a condition's node at one instant.
struct Reading {
  double value = 0.0;       ///< of a quantity
  double margin = 0.0;      ///< of a truth value
  int decisive = -1;        ///< the comparison that the margin is of
  bool is_of_time = false;  ///< asks for nothing but `elapsed`
  bool is_fixed = false;    ///< says nothing but numbers and parameters
};

/// A condition that does not ask now: `elapsed < 2 s or ...` before 2 s.
inline constexpr double not_asked = 1e300;

/// The margin of a condition from its change: positive where it holds. The margin of a comparison is the
/// distance between its sides as a share of the threshold. The threshold is the fixed side or else the right
/// one; where it is 0 the margin is infinite. `and` takes the least, `or` the largest, but beside a window of
/// time the other side alone. An unknown condition does not hold. Allocates nothing: `readings` holds one for
/// each node, and the last is the condition's.
void read_condition(const lang::Condition& condition, const TrueFacts& facts,
                    std::vector<Reading>& readings) noexcept;

class ExpectationWatch {
 public:
  explicit ExpectationWatch(const lang::Expectation& expectation);

  const lang::Condition& condition() const noexcept { return expectation_.that; }
  /// `in_task`: a task is active, not the brake behind it.
  void look(const TrueFacts& facts, double time, bool in_task) noexcept;
  /// `of_partners`: their outcomes, in the scene's order.
  ExpectationResult result(const std::string& outcome, const std::vector<std::string>& of_partners,
                           const std::vector<std::string>& codes) const;

 private:
  void note_worst(double time) noexcept;

  const lang::Expectation& expectation_;
  std::vector<Reading> readings_;
  double worst_ = not_asked;
  double worst_value_ = 0.0;
  int decisive_ = -1;
  double worst_time_ = 0.0;
  bool was_looked_at_ = false;
  double begin_ = -1.0;       ///< [s] of `within`
  double held_since_ = -1.0;  ///< [s] without a break, -1: does not hold
  double last_time_ = 0.0;
};

}  // namespace zwang::runtime
