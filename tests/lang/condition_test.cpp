#include <gtest/gtest.h>

#include "spec/expression.hpp"
#include "support.hpp"

namespace zwang::lang {
namespace {

struct Parsed {
  Diagnostics diagnostics;
  ConditionText condition;
};

/// The condition as the value of `when:`, from column 7 on.
Parsed parse_text(const std::string& text) {
  Parsed parsed;
  const int source = parsed.diagnostics.add_source({"t.yaml", "when: " + text + "\n"});
  Node node;
  node.kind = NodeKind::scalar;
  node.text = text;
  node.span = {source, {1, 7}, {1, 7 + static_cast<int>(text.size())}};
  parsed.condition = parse_condition(node, parsed.diagnostics);
  return parsed;
}

/// Fully bracketed, so that precedence shows.
std::string bracketed(const ConditionText& condition, int i) {
  const ExpressionText& node = condition.nodes[static_cast<std::size_t>(i)];
  switch (node.kind) {
    case ExpressionKind::quantity:
      return node.quantity.number + (node.quantity.has_unit ? "_" + node.quantity.unit : "");
    case ExpressionKind::parameter:
      return "$" + node.word;
    case ExpressionKind::name:
      return node.word;
    case ExpressionKind::call:
      return node.word + "(" + (node.left >= 0 ? bracketed(condition, node.left) : node.argument) + ")";
    case ExpressionKind::negate:
      return "(-" + bracketed(condition, node.left) + ")";
    case ExpressionKind::logical_not:
      return "(not " + bracketed(condition, node.left) + ")";
    case ExpressionKind::binary:
      break;
  }
  return "(" + bracketed(condition, node.left) + " " + node.word + " " + bracketed(condition, node.right) +
         ")";
}

std::string tree_of(const std::string& text) {
  const Parsed parsed = parse_text(text);
  if (parsed.condition.is_bad) return test::rendered(parsed.diagnostics);
  return bracketed(parsed.condition, static_cast<int>(parsed.condition.nodes.size()) - 1);
}

TEST(Condition, binds_as_written_in_the_grammar) {
  EXPECT_EQ(tree_of("a > 1 m and b < 2 s or c > 3 N"), "(((a > 1_m) and (b < 2_s)) or (c > 3_N))");
  EXPECT_EQ(tree_of("a > 1 m and (b < 2 s or c > 3 N)"), "((a > 1_m) and ((b < 2_s) or (c > 3_N)))");
  EXPECT_EQ(tree_of("not latch or reach > 3 cm"), "((not latch) or (reach > 3_cm))");
  EXPECT_EQ(tree_of("a + b * c - d < e"), "(((a + (b * c)) - d) < e)");
  EXPECT_EQ(tree_of("-a < -2 m"), "((-a) < (-2_m))");
  EXPECT_EQ(tree_of("a - 2 m - b > 0 m"), "(((a - 2_m) - b) > 0_m)");
  EXPECT_EQ(tree_of("abs(back.x.position + 0.20 m) < 2 cm"), "(abs((back.x.position + 0.20_m)) < 2_cm)");
  EXPECT_EQ(tree_of("moved(base_link) > $far and speed( hook ) <= 2 cm/s"),
            "((moved(base_link) > $far) and (speed(hook) <= 2_cm/s))");
}

TEST(Condition, takes_a_unit_as_far_as_it_goes) {
  EXPECT_EQ(tree_of("t > 3 N m and a"), "((t > 3_N m) and a)");
  EXPECT_EQ(tree_of("2 m / 4 s > v"), "((2_m / 4_s) > v)");
  EXPECT_EQ(tree_of("2 m/s*2 > v"), "((2_m/s * 2) > v)");
  EXPECT_EQ(tree_of("a > 1 m/s^2"), "(a > 1_m/s^2)");
}

struct Refusal {
  const char* text;
  int column;  ///< in the condition, from 1
  const char* message;
};

class ConditionRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(ConditionRefuses, at_its_place) {
  const Parsed parsed = parse_text(GetParam().text);
  ASSERT_TRUE(parsed.condition.is_bad);
  ASSERT_EQ(parsed.diagnostics.all().size(), 1u) << test::rendered(parsed.diagnostics);
  const Diagnostic& d = parsed.diagnostics.all()[0];
  EXPECT_EQ(d.span.begin.column, GetParam().column + 6) << test::rendered(parsed.diagnostics);
  EXPECT_NE(d.message.find(GetParam().message), std::string::npos) << d.message;
}

INSTANTIATE_TEST_SUITE_P(
    Texts, ConditionRefuses,
    testing::Values(Refusal{"(a > 1 m", 1, "missing `)`"}, Refusal{"abs(a < 1 m", 4, "missing `)`"},
                    Refusal{"a > 1 m)", 8, "closes nothing"}, Refusal{"a >", 4, "ends"},
                    Refusal{"a && b", 3, "`&&` is not part"}, Refusal{"!a", 1, "`!` is not part"},
                    Refusal{"a == 1 m", 3, "never exactly equal"}, Refusal{"a < b < c", 7, "two sides"},
                    Refusal{"a > 3 n", 5, "`n` is not a unit"}, Refusal{"and b", 1, "not expected"},
                    Refusal{"a b", 3, "`b` is not expected"},
                    Refusal{"sped(a) > 1 m", 1, "no function named"},
                    Refusal{"moved() > 1 m", 1, "does not say of what"},
                    Refusal{"a > 1e999 m", 5, "too large"}),
    [](const auto& test_case) { return "case_" + std::to_string(test_case.index); });

TEST(Condition, cannot_be_nested_without_end) {
  EXPECT_TRUE(parse_text(std::string(2000, '(') + "a").condition.is_bad);
  EXPECT_TRUE(parse_text(std::string(2000, '-') + "a").condition.is_bad);
  std::string nots;
  for (int i = 0; i < 1000; ++i) nots += "not ";
  EXPECT_TRUE(parse_text(nots + "a").condition.is_bad);
  std::string ands = "a";
  for (int i = 0; i < 600; ++i) ands += " and a";
  EXPECT_FALSE(parse_text(ands).condition.is_bad);
}

}  // namespace
}  // namespace zwang::lang
