// Conditions have three values, and are calculated in the order of their tree.
#include <gtest/gtest.h>

#include <limits>

#include "scheduler_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

/// Kleene's tables, by the exits that they let through.
TEST(Conditions, AreThreeValued) {
  const Nodes yes = apply(Op::less, number(0), number(1));
  const Nodes no = apply(Op::less, number(1), number(0));
  const Nodes maybe = apply(Op::less, unknown(), number(1));
  const auto fires = [](const Nodes& nodes) {
    lang::Task a = task("a", ahead);
    a.exits = {exit(when(nodes), to_done)};
    Bench bench(program({a}));
    bench.tick();
    bench.tick();
    return bench.scheduler.outcome() == Outcome::done;
  };
  EXPECT_TRUE(fires(yes));
  EXPECT_FALSE(fires(no));
  EXPECT_FALSE(fires(maybe));
  EXPECT_FALSE(fires(apply(Op::logical_not, maybe)));
  EXPECT_TRUE(fires(apply(Op::logical_not, no)));
  EXPECT_TRUE(fires(apply(Op::logical_or, maybe, yes)));
  EXPECT_FALSE(fires(apply(Op::logical_or, maybe, no)));
  EXPECT_FALSE(fires(apply(Op::logical_not, apply(Op::logical_or, maybe, no))));
  EXPECT_TRUE(fires(apply(Op::logical_not, apply(Op::logical_and, maybe, no))));
  EXPECT_FALSE(fires(apply(Op::logical_and, maybe, yes)));
  EXPECT_FALSE(fires(apply(Op::logical_not, apply(Op::logical_and, yes, maybe))));
}

TEST(Conditions, CalculateInTheOrderOfTheTree) {
  // abs(-(2 - 5) / 2 * 4 + 1) >= 7 and <= 7
  const Nodes value = apply(
      Op::abs,
      apply(Op::add,
            apply(Op::multiply,
                  apply(Op::divide, apply(Op::negate, apply(Op::subtract, number(2), number(5))), number(2)),
                  number(4)),
            number(1)));
  lang::Task a = task("a", ahead);
  a.exits = {exit(when(apply(Op::logical_and, apply(Op::greater_equal, value, number(7)),
                             apply(Op::less_equal, value, number(7)))),
                  to_done)};
  Bench bench(program({a}));
  bench.tick();
  bench.tick();
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
}

}  // namespace
}  // namespace zwang::runtime
