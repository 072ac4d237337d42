// A few drawn runs; a thousand of each kind with ZWANG_LONG in the environment (`./dev test --long`).
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <string>
#include <thread>

#include "../is_long.hpp"
#include "table.hpp"

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

/// A slide in a held press is within the task's bound, too.
void expect_bounds(const Result& result, int index) {
  EXPECT_FALSE(result.breaks_a_bound()) << index << ": " << result.speed << " m/s of " << result.speed_bound
                                        << ", " << result.force << " N of " << result.force_bound;
}

/// The task's speed and a tenth; no wall is reached. In the suite one of each drive, at eight onsets.
TEST(Sweep, EncodersThatFailAfterAStartStopTheBase) {
  for (int i = 0; i < start_count; i += test::is_long() ? 1 : 11) {
    const Result result = run(draw(1, i, Which::starts));
    expect_bounds(result, i);
    EXPECT_EQ(result.reason, "frozen") << i;
    EXPECT_EQ(result.force, 0.0) << i;
  }
}

/// The base is asked before it could be faster than its task allows, had the contact gone with the last
/// count: no hit, no `done`.
TEST(Sweep, APressThatGoesAwayBehindDeadEncodersKeepsTheBounds) {
  const int runs = test::is_long() ? 300 : 1;
  for (int i = 1; i <= runs; ++i) {
    const Result result = run(draw(1, i, Which::released));
    EXPECT_TRUE(result.is_faulty() || runs > 1) << i << " never presses";
    expect_bounds(result, i);
    EXPECT_FALSE(result.is_untrue()) << i;
  }
}

/// A base of three wheels that has counted a few uneven steps of 5e-5 rad: what they look like is no contact.
/// From rest the bound is v0 + sqrt(2 a S) of each axis, and this one drives two with 1 m/s^2.
TEST(Sweep, UnevenStepsOfAStartAreNoContact) {
  const Result result = run(draw(2, 113, Which::faulty));
  EXPECT_EQ(result.reason, "frozen");
  EXPECT_LT(result.speed, std::sqrt(2.0) * (0.01 + std::sqrt(2.0 * 1.0 * 0.5e-3)));
}

TEST(Sweep, EncodersThatFailAtAnyMomentKeepTheBounds) {
  const int runs = test::is_long() ? 1000 : 6;
  const int threads = test::is_long() ? static_cast<int>(std::thread::hardware_concurrency()) : 1;
  const auto results = run_all(3, 0, runs, Which::faulty, threads);
  for (int i = 0; i < runs; ++i) {
    const Result& result = results[static_cast<std::size_t>(i)];
    expect_bounds(result, i);
    EXPECT_TRUE(result.reason.empty() || result.reason == "frozen") << i << ": " << result.reason;
  }
  if (test::is_long()) print(3, 0, Which::faulty, results, std::cout);
}

/// A hand that leads the base makes its speed. The motors' bound does not apply to `guide`.
bool is_led(const Drawn& drawn) {
  return drawn.name.starts_with("guide.yaml");
}

/// Tasks with an arm, objects that give way and the like. In the suite a button that is pressed from the
/// start, and a board that is wiped: without the arm's own budget they were pressed with 274 N and 1089 N.
TEST(Sweep, EncodersThatFailInAnyOtherTaskKeepTheBounds) {
  const auto judge = [](int index) {
    const Drawn drawn = draw(902, index, Which::others);
    if (is_led(drawn)) return;
    const Result result = run(drawn);
    expect_bounds(result, index);
    EXPECT_TRUE(result.reason.empty() || result.reason == "frozen") << index << ": " << result.reason;
  };
  for (const int index : {25, 38}) judge(index);
  for (int i = 0; test::is_long() && i < 300; ++i) judge(i);
}

/// The same tasks with sound encoders, of steps up to 5e-5 rad. In the suite the drawer.
TEST(Sweep, ASoundArmIsNotFrozen) {
  const int runs = test::is_long() ? 300 : 40;
  for (int i = 0; i < runs; ++i) {
    const Drawn drawn = draw(901, i, Which::sound_others);
    if (drawn.encoder_step > 5e-5 || (!test::is_long() && !drawn.name.starts_with("drawer.yaml"))) continue;
    EXPECT_NE(run(drawn).reason, "frozen") << i << ": " << drawn.name;
    if (!test::is_long()) break;
  }
}

/// In the corner of two walls. Coarse encoders count nothing of a wheel that one of the walls holds. Both
/// walls press together along the direction of one motor for up to 53 ms.
TEST(Sweep, ABaseBetweenTwoWallsIsNotStopped) {
  for (const int index : {7, 22}) EXPECT_FALSE(run(draw(1, index, Which::healthy)).stopped) << index;
}

/// A base leans on one wall of a corner and hits the other one. The steady push of the first wall leaves the
/// line of the hit for 60 ms, as with a lost motor. In the first run that motor would need a wall that pulls.
/// In the second run the push gives way no farther than a spring of its depth.
TEST(Sweep, AWallThatIsLeantOnBesideAHitIsNoLostMotor) {
  EXPECT_FALSE(run(draw(21, 1065, Which::healthy)).stopped);
  EXPECT_FALSE(run(draw(20, 2204, Which::healthy)).stopped);
}

/// A padded wall in line with a wheel resists first with its damper, then with its spring. Together they are
/// as even as the growing command of the wheel for 40 ms. A force that only takes energy is no motor's.
TEST(Sweep, APaddedWallIsNoReversedMotor) {
  EXPECT_FALSE(run(draw(7, 55, Which::healthy)).stopped);
}

/// With encoders of steps up to 5e-5 rad.
TEST(Sweep, AHealthyRunIsNotFrozen) {
  const int runs = test::is_long() ? 1000 : 4;
  const int threads = test::is_long() ? static_cast<int>(std::thread::hardware_concurrency()) : 1;
  const auto results = run_all(3, 0, runs, Which::healthy, threads);
  for (int i = 0; i < runs; ++i) {
    if (draw(3, i, Which::healthy).encoder_step > 5e-5) continue;
    EXPECT_NE(results[static_cast<std::size_t>(i)].reason, "frozen") << i;
  }
  if (test::is_long()) print(3, 0, Which::healthy, results, std::cout);
}

}  // namespace
}  // namespace zwang::sweep
