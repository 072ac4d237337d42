// What a task waited for came nearer, stood, or went away.
#include "schedule/wait_course.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace zwang::runtime {
namespace {

constexpr double period = 0.001;  // [s]

/// The trend of a comparison that lacks lack(t) at each tick, after `ticks` of them.
template <typename Lack>
Trend after(int ticks, const Lack& lack, bool is_turned = false) {
  WaitCourse course(1);
  for (int i = 0; i < ticks; ++i) {
    if (course.advance()) course.keep(0, lack(i * period));
  }
  return course.trend(0, (is_turned ? -1.0 : 1.0) * lack((ticks - 1) * period), is_turned, period);
}

TEST(WaitCourse, ASteadyPaceTellsTheTimeThatIsLeft) {
  // 2 m - 0.3 m/s t is none at t = 20/3 s, however long was waited.
  for (const int ticks : {2, 3, 9, 100, 1000, 1024, 4096, 6000}) {
    const Trend trend = after(ticks, [](double t) { return 2.0 - 0.3 * t; });
    const bool is_seen = 0.3 * (ticks - 1) * period > 0.1;
    if (!is_seen) continue;  // by less than a hundredth of what it lacks
    ASSERT_TRUE(trend.left) << ticks;
    EXPECT_NEAR(*trend.left, 2.0 / 0.3 - (ticks - 1) * period, 1e-9) << ticks;
    EXPECT_EQ(trend.stood, 0.0) << ticks;
    EXPECT_FALSE(trend.grows) << ticks;
  }
}

TEST(WaitCourse, WhatStandsSaysForHowLong) {
  const Trend whole = after(5000, [](double) { return 4.0; });
  EXPECT_TRUE(whole.is_whole);
  EXPECT_FALSE(whole.left);
  EXPECT_NEAR(whole.stood, 4999 * period, 1e-9);
  // It comes nearer for 1.8 s and stands from then on: half of the true time at least, and not more.
  const Trend late = after(6000, [](double t) { return 1.0 - 0.3 * std::min(t, 1.8); });
  EXPECT_FALSE(late.left);
  EXPECT_FALSE(late.is_whole);
  EXPECT_GT(late.stood, 0.5 * (6.0 - 1.8));
  EXPECT_LE(late.stood, 6.0 - 1.8);
}

TEST(WaitCourse, WhatGoesAwayGrows) {
  const Trend trend = after(3000, [](double t) { return 1.0 + t; });
  EXPECT_TRUE(trend.grows);
  EXPECT_FALSE(trend.left);
  // It went away and comes back.
  EXPECT_FALSE(after(3000, [](double t) { return 4.0 - (t - 1.0) * (t - 1.0); }).grows);
}

TEST(WaitCourse, OfWhatShouldBeFalseTheOtherSideCounts) {
  // `not a < 2` is held back by a = 0.5 t: its lack is 0.5 t - 2, and it comes to 0 at 4 s.
  const Trend trend = after(
      1000, [](double t) { return 0.5 * t - 2.0; }, true);
  ASSERT_TRUE(trend.left);
  EXPECT_NEAR(*trend.left, 4.0 - 999 * period, 1e-9);
}

TEST(WaitCourse, ANewWaitForgetsTheOldOne) {
  WaitCourse course(1);
  for (int i = 0; i < 100; ++i) {
    if (course.advance()) course.keep(0, 1.0);
  }
  course.restart();
  EXPECT_EQ(course.trend(0, 1.0, false, period).stood, 0.0);
}

}  // namespace
}  // namespace zwang::runtime
