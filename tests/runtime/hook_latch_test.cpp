// A held hook is told from dead encoders by its latch.
#include "guard/hook_latch.hpp"

#include <gtest/gtest.h>

#include "blind_course.hpp"
#include "guard/blind_budget.hpp"

namespace zwang::runtime::test {
namespace {

/// A hook catches the base from 0.5 s on, within a fifth of a second, and then holds it both ways. Only the
/// latch distinguishes this from dead encoders.
lang::Program with_latch(lang::Program program_, int holds) {
  lang::Signal latch;
  latch.name = "latch";
  latch.stale_after = {.constant = 0.2};
  latch.holds = holds;
  program_.signals = {latch};
  return program_;
}

Course pull_in_a_dock(int holds, double open_at, double stale_from) {
  return go(
      with_latch(presses(), holds), 3.0, {},
      [&](PlanarBase& base, Sensed& sensed) {
        if (base.time > stale_from) return;
        const bool is_closed = base.time > 0.6 && base.time < open_at;
        sensed.signals[0] = {.valid = true, .stamp = base.time, .boolean = is_closed};
      },
      [&](PlanarBase& base) {
        if (base.time < 0.5) return;
        hold(base, base.time < 0.7 ? Eigen::Vector3d(0.95 * base.V) : Eigen::Vector3d::Zero());
      });
}

TEST(HookLatch, TellsADockFromDeadEncoders) {
  EXPECT_EQ(pull_in_a_dock(-1, never, never).reason, EventCode::frozen) << "nobody says that a hook holds";
  EXPECT_EQ(pull_in_a_dock(2, never, never).reason, EventCode::none);
  const Course opened = pull_in_a_dock(2, 1.5, never);
  EXPECT_EQ(opened.reason, EventCode::frozen) << "it is open, and nothing moves";
  EXPECT_GT(opened.stopped_at, 1.5);
  const Course stale = pull_in_a_dock(2, never, 1.5);
  EXPECT_EQ(stale.reason, EventCode::frozen) << "nobody says so any more";
  EXPECT_GT(stale.stopped_at, 1.7);
}

/// The hook is on a cart that rolls along, its mass left out: the base sets out with 1 m/s^2 10 ms before its
/// encoders die. It is asked as a held press is.
TEST(HookLatch, AHookThatRollsAlongExcusesNoTaskThatAsksForMotion) {
  constexpr double dies_at = 0.01, closes_at = 0.003;  // [s]
  Failing encoders;
  const Course course = go(with_latch(sets_out(0.5), 2), 3.0, {}, [&](PlanarBase& base, Sensed& sensed) {
    sensed.signals[0] = {.valid = true, .stamp = base.time, .boolean = base.time > closes_at};
    if (base.time > dies_at) encoders.spoil(sensed);
  });
  const double asked = BlindBudget::most_lean + 2.0 / 3.0 * acceleration * BlindBudget::slackens_for;
  EXPECT_EQ(course.reason, EventCode::frozen);
  EXPECT_LT(course.fastest, 1.1 * (acceleration * dies_at + asked));
}

}  // namespace
}  // namespace zwang::runtime::test
