// Guards evaluate a condition only as far as it takes to decide it. `evaluate`, which looks at every node, is
// the oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "schedule/condition.hpp"

namespace zwang::runtime {
namespace {

using lang::ExpressionNode;
using lang::Op;

constexpr int signals = 5;

/// Signals that are true, false or unknown, and how often each was asked for.
class Values final : public Facts {
 public:
  explicit Values(std::mt19937& random) {
    for (double& value : values_) value = std::uniform_int_distribution(0, 2)(random);
  }
  Fact look_up(const ExpressionNode& node, int owner) const noexcept override {
    EXPECT_EQ(owner, 7);
    ++asked_[node.index];
    const double value = values_[static_cast<std::size_t>(node.index)];
    if (value == 2.0) return {std::nan(""), true};
    return {value};
  }
  /// The same, not asked yet.
  Values unasked() const {
    Values same(*this);
    same.asked_.clear();
    return same;
  }
  int most_asked() const {
    int most = 0;
    for (const auto& [signal, count] : asked_) most = std::max(most, count);
    return most;
  }

 private:
  double values_[signals] = {};
  mutable std::map<int, int> asked_;
};

/// The index of a new node behind the others.
int put(lang::Condition& condition, const ExpressionNode& node) {
  condition.nodes.push_back(node);
  return static_cast<int>(condition.nodes.size()) - 1;
}

int put_signal(lang::Condition& condition, std::mt19937& random) {
  ExpressionNode node;
  node.op = Op::signal;
  node.index = std::uniform_int_distribution(0, signals - 1)(random);
  return put(condition, node);
}

/// `abs(a - b) < c`, with two signals and a constant of 0, 0.5 or 1.
int put_comparison(lang::Condition& condition, std::mt19937& random) {
  ExpressionNode difference, distance, constant, comparison;
  difference.op = Op::subtract;
  difference.left = put_signal(condition, random);
  difference.right = put_signal(condition, random);
  distance.op = Op::abs;
  distance.left = put(condition, difference);
  constant.number = 0.5 * std::uniform_int_distribution(0, 2)(random);
  comparison.left = put(condition, distance);
  comparison.right = put(condition, constant);
  comparison.op = static_cast<Op>(
      std::uniform_int_distribution(static_cast<int>(Op::less), static_cast<int>(Op::greater_equal))(random));
  return put(condition, comparison);
}

/// The index of the root of a tree of `and`, `or` and `not`.
int grow(lang::Condition& condition, int depth, std::mt19937& random) {
  const int kind =
      depth == 0 ? std::uniform_int_distribution(0, 1)(random) : std::uniform_int_distribution(0, 7)(random);
  if (kind == 0) return put_signal(condition, random);
  if (kind == 1) return put_comparison(condition, random);
  ExpressionNode node;
  if (kind == 2) {
    node.op = Op::logical_not;
    node.left = grow(condition, depth - 1, random);
  } else {
    node.op = kind < 5 ? Op::logical_and : Op::logical_or;
    node.left = grow(condition, depth - 1, random);
    node.right = grow(condition, depth - 1, random);
  }
  return put(condition, node);
}

TEST(Decision, IsThatOfAllNodesAndAsksForEachNameOnce) {
  std::mt19937 random(1);
  for (int i = 0; i < 3000; ++i) {
    SharedNumbers numbers;
    std::vector<lang::Condition> conditions(3);
    std::vector<Decision> decisions;
    for (lang::Condition& condition : conditions) {
      grow(condition, 4, random);
      decisions.emplace_back(condition, numbers);
    }
    for (int tick = 0; tick < 2; ++tick) {
      const Values facts(random);
      numbers.forget();
      for (std::size_t k = 0; k < conditions.size(); ++k) {
        std::vector<double> values(conditions[k].nodes.size());
        const Judgement decided = decisions[k].decide(7, facts, numbers, values, std::nullopt);
        ASSERT_LE(facts.most_asked(), 1);
        const Values again = facts.unasked();
        const Judgement all = evaluate(conditions[k], 7, again, values);
        ASSERT_EQ(decided.verdict, all.verdict) << "condition " << k << " of " << i;
        if (all.verdict == Verdict::unknown) {
          EXPECT_EQ(decided.stale, all.stale);
        }
      }
    }
  }
}

/// A false first operand decides an `and`: the signals behind it are not asked for.
TEST(Decision, AsksForNothingBehindTheComparisonThatDecides) {
  std::mt19937 random(1);
  lang::Condition condition;
  ExpressionNode none, less, both;
  none.number = 1.0;
  less.op = Op::less;
  less.left = put(condition, none);
  less.right = put(condition, ExpressionNode{});
  both.op = Op::logical_and;
  both.left = put(condition, less);
  both.right = put_comparison(condition, random);
  put(condition, both);
  SharedNumbers numbers;
  const Decision decision(condition, numbers);
  const Values facts(random);
  std::vector<double> values(condition.nodes.size());
  EXPECT_EQ(decision.decide(7, facts, numbers, values, std::nullopt).verdict, Verdict::no);
  EXPECT_EQ(facts.most_asked(), 0);
}

}  // namespace
}  // namespace zwang::runtime
