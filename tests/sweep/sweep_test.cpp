// A few drawn runs; a thousand of each kind with ZWANG_LONG in the environment (`./dev test --long`).
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <thread>

#include "table.hpp"

namespace zwang::sweep {
namespace {

bool is_long() {
  return std::getenv("ZWANG_LONG") != nullptr;
}

TEST(Sweep, ASeedFixesARun) {
  const Drawn a = draw(7, 3, Which::all), b = draw(7, 3, Which::all), c = draw(7, 4, Which::all);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.program.scene->objects[0].stiffness, b.program.scene->objects[0].stiffness);
  EXPECT_NE(a.program.scene->objects[0].stiffness, c.program.scene->objects[0].stiffness);
  const Result first = run(draw(1, 50, Which::starts)), again = run(draw(1, 50, Which::starts));
  EXPECT_EQ(first.speed, again.speed);
  EXPECT_EQ(first.force, again.force);
}

constexpr double slowest_slide = 0.02;  // [m/s]

void expect_bounds(const std::vector<Result>& results, const char* what) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_FALSE(results[i].breaks_a_bound())
        << what << " " << i << ": " << results[i].speed << " m/s of " << results[i].speed_bound << ", "
        << results[i].force << " N of " << results[i].force_bound;
    // In a held press a slide along the wall is not told: docs/limits.md.
    EXPECT_FALSE(results[i].is_untrue() && results[i].speed > slowest_slide)
        << what << " " << i << ": moved by " << results[i].moved << " m at " << results[i].speed << " m/s";
  }
}

/// The task's speed and a tenth; no wall is reached. In the suite one of each drive, at eight onsets.
TEST(Sweep, EncodersThatFailAfterAStartStopTheBase) {
  for (int i = 0; i < start_count; i += is_long() ? 1 : 11) {
    const Result result = run(draw(1, i, Which::starts));
    expect_bounds({result}, "start");
    EXPECT_EQ(result.reason, "frozen") << i;
    EXPECT_EQ(result.force, 0.0) << i;
  }
}

TEST(Sweep, EncodersThatFailAtAnyMomentKeepTheBounds) {
  const int runs = is_long() ? 1000 : 6;
  const int threads = is_long() ? static_cast<int>(std::thread::hardware_concurrency()) : 1;
  const auto results = run_all(3, 0, runs, Which::faulty, threads);
  expect_bounds(results, "run");
  if (is_long()) print(3, 0, Which::faulty, results, std::cout);
}

/// With encoders of steps up to 5e-5 rad.
TEST(Sweep, AHealthyRunIsNotFrozen) {
  const int runs = is_long() ? 1000 : 4;
  const int threads = is_long() ? static_cast<int>(std::thread::hardware_concurrency()) : 1;
  const auto results = run_all(3, 0, runs, Which::healthy, threads);
  for (int i = 0; i < runs; ++i) {
    if (draw(3, i, Which::healthy).encoder_step > 5e-5) continue;
    EXPECT_NE(results[static_cast<std::size_t>(i)].reason, "frozen") << i;
  }
  if (is_long()) print(3, 0, Which::healthy, results, std::cout);
}

}  // namespace
}  // namespace zwang::sweep
