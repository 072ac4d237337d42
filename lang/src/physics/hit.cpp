// The peak of a hit in closed form. g = C - F obeys the equation of the free spring,
//
//   g'' + 2 z w g' + w^2 g = 0,   w = sqrt(K/m),   z = c / (2 m w)
//
// and begins with
//
//   g(0)  = c v - F
//   g'(0) = m w^2 v (1 - 4 z^2) + 2 z w F
//
// A g that falls from the begin on has its largest value there; else at the first zero of g'.
#include "zwang/lang/hit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zwang::lang {

namespace {

/// Of g'' + 2 z w g' + w^2 g = 0, g(0) = `value`, g'(0) = `slope` > 0: g at the first zero of g'.
double first_crest(double value, double slope, double z, double w) {
  constexpr double nearly_critical = 1e-6;
  if (z < 1.0 - nearly_critical) {
    // g' = e^(-z w t) (slope cos(d t) - (z w slope + w^2 value)/d sin(d t))
    const double d = w * std::sqrt(1.0 - z * z);
    const double angle = std::atan2(slope * d, z * w * slope + w * w * value);  // in (0, pi)
    const double t = angle / d;
    return std::exp(-z * w * t) * (value * std::cos(angle) + (slope + z * w * value) / d * std::sin(angle));
  }
  if (z < 1.0 + nearly_critical) {
    // g' = e^(-w t) (slope - w (slope + w value) t)
    const double rate = slope + w * value;
    if (!(rate > 0.0)) return 0.0;  // it rises for ever, towards 0
    const double t = slope / (w * rate);
    return std::exp(-w * t) * (value + rate * t);
  }
  const double root = std::sqrt(z * z - 1.0);
  const double slow = -w * (z - root), fast = -w * (z + root);
  // g = a e^(slow t) + b e^(fast t)
  const double a = (slope - fast * value) / (slow - fast);
  const double b = value - a;
  const double ratio = -(b * fast) / (a * slow);
  if (!(a > 0.0) || !(ratio > 0.0)) return 0.0;
  const double t = std::max(0.0, std::log(ratio) / (slow - fast));
  return a * std::exp(slow * t) + b * std::exp(fast * t);
}

}  // namespace

double Hit::peak_force() const {
  const double w = std::sqrt(stiffness / mass);
  const double z = damping / (2.0 * mass * w);
  const double value = damping * speed - push;
  const double slope = mass * w * w * speed * (1.0 - 4.0 * z * z) + 2.0 * z * w * push;
  const double rise = slope > 0.0 ? first_crest(value, slope, z, w) : value;
  return push + std::max({0.0, value, rise});
}

}  // namespace zwang::lang
