// The peak of a hit in closed form, against the motion itself.
#include "zwang/lang/hit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace zwang::lang {
namespace {

/// m x'' + c x' + K x = F in steps of a thousandth of 1/w, by the rule of Runge and Kutta.
double integrated_peak(const Hit& hit) {
  const auto a = [&](double x, double v) {
    return (hit.push - hit.damping * v - hit.stiffness * x) / hit.mass;
  };
  const double w = std::sqrt(hit.stiffness / hit.mass);
  const double h = 1e-3 / w;
  double x = 0.0, v = hit.speed, peak = hit.damping * v;
  for (int i = 0; i < 12000; ++i) {
    const double x1 = v, v1 = a(x, v);
    const double x2 = v + 0.5 * h * v1, v2 = a(x + 0.5 * h * x1, v + 0.5 * h * v1);
    const double x3 = v + 0.5 * h * v2, v3 = a(x + 0.5 * h * x2, v + 0.5 * h * v2);
    const double x4 = v + h * v3, v4 = a(x + h * x3, v + h * v3);
    x += h / 6.0 * (x1 + 2.0 * x2 + 2.0 * x3 + x4);
    v += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
    peak = std::max(peak, hit.damping * v + hit.stiffness * x);
  }
  return peak;
}

TEST(Hit, HasThePeakOfTheMotion) {
  std::mt19937 random(20);
  const auto between = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 60; ++i) {
    Hit hit{between(1.0, 200.0), between(0.01, 2.0), std::pow(10.0, between(3.0, 7.0)), 0.0, 0.0};
    const double ratio = i % 6 == 0 ? 1.0 : between(0.0, 2.0);
    hit.damping = 2.0 * ratio * std::sqrt(hit.stiffness * hit.mass);
    if (i % 3 != 0) hit.push = between(0.0, 300.0);
    const double expected = integrated_peak(hit);
    EXPECT_NEAR(hit.peak_force(), expected, 1e-4 * expected) << "ratio " << ratio << " push " << hit.push;
  }
}

// Without a push, as a share of v sqrt(K m): the figures that the documents state.
TEST(Hit, AShareOfTheUndampedPeak) {
  for (const auto& [ratio, share] : {std::pair(0.0, 1.0), {0.27, 0.81}, {0.5, 1.0}, {1.0, 2.0}, {1.5, 3.0}}) {
    Hit hit{57.0, 0.3, 1e5, 0.0, 0.0};
    const double undamped = hit.speed * std::sqrt(hit.stiffness * hit.mass);
    hit.damping = 2.0 * ratio * std::sqrt(hit.stiffness * hit.mass);
    EXPECT_NEAR(hit.peak_force() / undamped, share, 1e-3) << ratio;
  }
}

}  // namespace
}  // namespace zwang::lang
