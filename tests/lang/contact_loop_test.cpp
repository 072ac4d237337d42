// The virtual robot of a robot that feels: what is chosen from frequencies is judged in time.
#include "robot/contact_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace zwang::lang {
namespace {

Drive drive(double rate, double delay, Feels::By by) {
  Drive drive;
  drive.takes_velocity = drive.limit_is_fixed = true;
  drive.rate = rate;
  drive.delay = delay;
  drive.time_constant = 20e-3;
  drive.integral_time = 100e-3;
  drive.feels.by = by;
  drive.feels.filter = by == Feels::By::wrench ? 5e-3 : 10e-3;
  return drive;
}

/// The remaining depth after `seconds`, by simulation of one kilogram on its drive. It starts at a depth of 1
/// in the wall.
double left_after(double seconds, const Drive& drive, const VirtualMass& led, double K) {
  constexpr double step = 1e-4;
  const double filter = felt_filter(drive) + drive.feels.filter;
  std::vector<double> on_way(
      static_cast<std::size_t>(std::lround((drive.delay + 1.0 / drive.rate) / step)) + 1, 0.0);
  double x = 1.0, v = 0.0, sum = 0.0, felt = 0.0, V = 0.0, most = 0.0;
  const auto steps = static_cast<std::size_t>(std::lround(seconds / step));
  for (std::size_t i = 0; i < steps; ++i) {
    const double force = K * x + 0.2 * std::sqrt(K) * v;
    felt += step / filter * (force - felt);
    on_way[i % on_way.size()] = felt;
    const double late = on_way[(i + 1) % on_way.size()];
    const double acceleration = -late / led.factor - led.damping * V;
    const double off = V + drive.time_constant * acceleration - v;
    V += step * acceleration;
    sum += step * off / (drive.time_constant * *drive.integral_time);
    v += step * (off / drive.time_constant + sum - force);
    x += step * v;
    if (i > steps / 2) most = std::max(most, std::abs(x));
  }
  return most;
}

TEST(ContactLoop, ARobotThatIsChosenComesToRestAtEveryWall) {
  for (const Feels::By by : {Feels::By::wrench, Feels::By::effort}) {
    for (const auto& [rate, delay] : {std::pair(1000.0, 0.0), {100.0, 10e-3}, {50.0, 20e-3}}) {
      const Drive of = drive(rate, delay, by);
      const std::optional<VirtualMass> chosen = choose_virtual_mass(of);
      ASSERT_TRUE(chosen) << rate;
      for (const double K : {10.0, 1e2, 1e3, 4e3, 1e4, 1e5, 1e6})
        EXPECT_LT(left_after(30.0, of, *chosen, K), 1e-2) << rate << " " << K;
    }
  }
}

/// A virtual robot as heavy as the real one, with hardly any damping, swings.
TEST(ContactLoop, WhatIsNotStableInTimeHasNoPeak) {
  const Drive of = drive(50.0, 20e-3, Feels::By::wrench);
  const VirtualMass light{1.0, 0.1};
  EXPECT_TRUE(std::isinf(worst_peak(of, light)));
  double most = 0.0;
  for (const double K : {1e3, 1e4}) most = std::max(most, left_after(5.0, of, light, K));
  EXPECT_GT(most, 10.0);
}

/// A heavier robot with as much damping is steadier; a later one is less so.
TEST(ContactLoop, ThePeakFallsWithTheMassAndGrowsWithTheDelay) {
  const Drive of = drive(50.0, 20e-3, Feels::By::wrench);
  EXPECT_LT(worst_peak(of, {12.0, 3.0}), worst_peak(of, {6.0, 3.0}));
  Drive later = of;
  later.delay = 40e-3;
  EXPECT_GT(worst_peak(later, {12.0, 3.0}), worst_peak(of, {12.0, 3.0}));
}

TEST(ContactLoop, TheLongestDelayWouldDoAndALongerOneWouldNot) {
  Drive late = drive(50.0, 50e-3, Feels::By::wrench);
  late.time_constant = 10e-3;
  ASSERT_FALSE(choose_virtual_mass(late));
  const std::optional<double> longest = longest_felt_delay(late);
  ASSERT_TRUE(longest);
  late.delay = *longest;
  EXPECT_TRUE(choose_virtual_mass(late));
  late.delay += 2e-3;
  EXPECT_FALSE(choose_virtual_mass(late));
}

}  // namespace
}  // namespace zwang::lang
