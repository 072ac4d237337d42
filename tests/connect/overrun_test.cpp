// A computer that is too slow for its control period: five cycles skipped within a second.
#include "overrun.hpp"

#include <gtest/gtest.h>

namespace zwang::connect {
namespace {

TEST(Overrun, BeginsWithTheFifthCycleWithinASecond) {
  Overrun overrun;
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(overrun.add(1, 100.0 + 0.2 * i)) << i;
  EXPECT_TRUE(overrun.add(1, 100.8));
}

TEST(Overrun, IsNoneWhereTheyAreFartherApart) {
  Overrun overrun;
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(overrun.add(1, 100.0 + 0.26 * i)) << "five of them take 1.04 s";
}

TEST(Overrun, OfOneLongPauseBeginsAtOnce) {
  Overrun hiccup, pause;
  EXPECT_FALSE(hiccup.add(4, 100.0));
  EXPECT_TRUE(pause.add(1'000'000'000'000ULL, 100.0));
}

TEST(Overrun, IsToldOnceUntilASecondIsBetter) {
  Overrun overrun;
  int told = 0;
  for (int i = 0; i < 1000; ++i) told += overrun.add(1, 100.0 + 0.1 * i);
  EXPECT_EQ(told, 1);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(overrun.add(0, 200.0 + 0.1 * i));
  EXPECT_FALSE(overrun.add(4, 201.0));
  EXPECT_TRUE(overrun.add(1, 201.1));
}

}  // namespace
}  // namespace zwang::connect
