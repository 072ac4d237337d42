#include "physics/driven_hit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zwang::lang {

namespace {

/// Step by step, over five swings of the spring or until the two part.
double stepped_peak(const DrivenHit& hit) {
  constexpr double step = 0.01;  // of the fastest time constant: 1 % of the peak at most
  constexpr int most_steps = 200000;
  const double w = std::sqrt(hit.stiffness / hit.reduced_mass());
  const double rate = hit.damping / hit.reduced_mass() + hit.push.per_speed / hit.mass;
  const double h = step / std::max(w, rate);
  const double end = 5.0 * 2.0 * std::numbers::pi / w;
  double x = 0.0, v = hit.speed, y = 0.0, u = 0.0, peak = 0.0;
  for (int i = 0; i < most_steps && i * h < end; ++i) {
    const double contact = hit.stiffness * (x - y) + hit.damping * (v - u);
    if (contact <= 0.0 && i > 0) break;
    peak = std::max(peak, contact);
    v += h * (hit.push.at(hit.speed - v, x) - contact) / hit.mass;
    if (hit.inverse_mass > 0.0) u = std::max(0.0, u + h * (contact - hit.hold) * hit.inverse_mass);
    x += h * v;
    y += h * u;
  }
  return peak;
}

}  // namespace

double DriverPush::at(double slower, double way) const {
  return std::clamp(at_arrival + per_speed * slower - per_way * way, -most, most);
}

double DrivenHit::peak() const {
  if (!push.is_constant() || (inverse_mass > 0.0 && hold > 0.0)) return stepped_peak(*this);
  // Of the way d = x - y:  m M/(m + M) d'' = F M/(m + M) - C.
  const double reduced = reduced_mass();
  return Hit{reduced, speed, stiffness, damping, push.at_arrival * reduced / mass}.peak_force();
}

}  // namespace zwang::lang
