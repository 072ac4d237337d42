/// One expectation, followed through a run.
#pragma once

#include <limits>
#include <vector>

#include "scenario/true_facts.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/runtime/scenario_run.hpp"

namespace zwang::runtime {

/// How far a condition is from changing: positive where it holds. Of a comparison the distance between its
/// sides as a share of the right one (infinite, where that is 0); `and` takes the least, `or` the largest.
/// What nobody knows does not hold. Allocates nothing: `values` and `margins` hold one number for each node.
double margin_of(const lang::Condition& condition, const TrueFacts& facts, std::vector<double>& values,
                 std::vector<double>& margins) noexcept;

class ExpectationWatch {
 public:
  explicit ExpectationWatch(const lang::Expectation& expectation);

  /// `in_task`: a task is active, not the brake behind it.
  void look(const TrueFacts& facts, double time, bool in_task) noexcept;
  /// `of_partners`: their outcomes, in the scene's order.
  ExpectationResult result(const std::string& outcome, const std::vector<std::string>& of_partners,
                           const std::vector<std::string>& codes) const;

 private:
  const lang::Expectation& expectation_;
  std::vector<double> values_, margins_;
  double worst_ = std::numeric_limits<double>::infinity();
  double worst_time_ = 0.0;
  bool was_looked_at_ = false;
  double begin_ = -1.0;       ///< [s] of `within`
  double held_since_ = -1.0;  ///< [s] without a break, -1: does not hold
  double last_time_ = 0.0;
};

}  // namespace zwang::runtime
