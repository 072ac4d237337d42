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
  int most_asked() const {
    int most = 0;
    for (const auto& [signal, count] : asked_) most = std::max(most, count);
    return most;
  }

 private:
  double values_[signals] = {};
  mutable std::map<int, int> asked_;
};

/// The index of the root of a tree of `and`, `or` and `not`.
int grow(lang::Condition& condition, int depth, std::mt19937& random) {
  ExpressionNode node;
  const int kind = depth == 0 ? 0 : std::uniform_int_distribution(0, 6)(random);
  if (kind == 0) {
    node.op = Op::signal;
    node.index = std::uniform_int_distribution(0, signals - 1)(random);
  } else if (kind == 1) {
    node.op = Op::logical_not;
    node.left = grow(condition, depth - 1, random);
  } else {
    node.op = kind < 4 ? Op::logical_and : Op::logical_or;
    node.left = grow(condition, depth - 1, random);
    node.right = grow(condition, depth - 1, random);
  }
  condition.nodes.push_back(node);
  return static_cast<int>(condition.nodes.size()) - 1;
}

TEST(Decision, IsThatOfAllNodesAndAsksForEachNameOnce) {
  std::mt19937 random(1);
  int cut_short = 0;
  for (int i = 0; i < 3000; ++i) {
    SharedNames names;
    std::vector<lang::Condition> conditions(3);
    std::vector<Decision> decisions;
    for (lang::Condition& condition : conditions) {
      grow(condition, 4, random);
      decisions.emplace_back(condition, names);
    }
    const Values facts(random);
    names.forget();
    std::vector<std::vector<double>> decided_values;
    std::vector<Judgement> decided;
    std::vector<bool> whole;
    for (std::size_t k = 0; k < conditions.size(); ++k) {
      decided_values.emplace_back(conditions[k].nodes.size());
      bool is_whole = false;
      decided.push_back(decisions[k].decide(7, facts, names, decided_values[k], std::nullopt, is_whole));
      whole.push_back(is_whole);
      cut_short += is_whole ? 0 : 1;
    }
    EXPECT_LE(facts.most_asked(), 1);
    for (std::size_t k = 0; k < conditions.size(); ++k) {
      std::vector<double> values(conditions[k].nodes.size());
      const Judgement all = evaluate(conditions[k], 7, facts, values);
      ASSERT_EQ(decided[k].verdict, all.verdict) << "condition " << k << " of " << i;
      if (all.verdict == Verdict::unknown) {
        EXPECT_EQ(decided[k].stale, all.stale);
      }
      for (std::size_t n = 0; whole[k] && n < values.size(); ++n) {
        EXPECT_EQ(std::isnan(decided_values[k][n]), std::isnan(values[n]));
        if (!std::isnan(values[n])) {
          EXPECT_EQ(decided_values[k][n], values[n]);
        }
      }
    }
  }
  EXPECT_GT(cut_short, 1000);
}

}  // namespace
}  // namespace zwang::runtime
