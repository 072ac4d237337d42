// A seed fixes what is drawn, and what it comes to.
#include <gtest/gtest.h>

#include "trial.hpp"

namespace zwang::sweep {
namespace {

TEST(Sweep, ASeedFixesARun) {
  const Drawn a = draw(7, 3, Which::all), b = draw(7, 3, Which::all), c = draw(7, 4, Which::all);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.program.scene->objects[0].stiffness, b.program.scene->objects[0].stiffness);
  EXPECT_NE(a.program.scene->objects[0].stiffness, c.program.scene->objects[0].stiffness);
  const Result first = run(draw(1, 50, Which::starts)), again = run(draw(1, 50, Which::starts));
  EXPECT_EQ(first.speed, again.speed);
  EXPECT_EQ(first.force, again.force);
}

}  // namespace
}  // namespace zwang::sweep
