// At the begin of a fillet the base needs a = v^2/r across its way at once. Its wheels still head straight
// on. A wheel at the trail c behind its swivel turns by
//
//   theta' = (y' - v theta)/c            y': across the straight line, theta: of the wheel to it
//
// The swivels' inertia weighs M - m across the way, so that a push f makes
//
//   f = m y'' + (M - m) c theta'' = M y'' - (M - m) v theta'
//
// Along the fillet theta'' fades with exp(-v t/c), and m a is left. A push cut to F lets the base lag while
// the swivels turn. The controller leads it back with the time constant T of a driver that says nothing.
#include "physics/swivel_lag.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace zwang::lang {

namespace {

bool is_on_a_free_swivel(const solver::Model& model, const solver::Wheel& wheel) {
  const int swivel = model.bodies()[static_cast<std::size_t>(wheel.body)].parent;
  return swivel > 0 && !model.joint(swivel - 1).actuated;
}

}  // namespace

double trail_of_swivels(const solver::Model& model) {
  double trail = 0.0;
  for (const solver::Wheel& wheel : model.wheels()) {
    if (!is_on_a_free_swivel(model, wheel)) continue;
    const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
    const solver::Vector3 axle = body.pose_in_parent.rotation * body.joint.axis;
    trail = std::max(trail, std::abs(body.pose_in_parent.position.cross(axle).z()));
  }
  return trail;
}

double off_the_path(const Rounding& r) {
  constexpr double T = 0.5;    // [s]
  constexpr int steps = 4000;  // each far below c/v of the shortest trail
  const double a = r.speed * r.speed / r.radius, end = 0.5 * std::numbers::pi * r.radius / r.speed;
  const double h = end / steps, turning = (r.most_mass - r.least_mass) * r.speed;
  double y = 0.0, rate = 0.0, theta = 0.0, most = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double t = i * h, missing = 0.5 * a * t * t - y;
    const double asked = a + missing / (T * T) + 2.0 * (a * t - rate) / T;
    // Exact within a step, however short c/v is.
    const double settled = rate / r.speed, fade = std::exp(-r.speed * h / r.trail);
    const double swing = (settled - theta) * (1.0 - fade) / h;
    const double push = std::clamp(r.most_mass * asked - turning * swing, -r.most_push, r.most_push);
    rate += h * (push + turning * swing) / r.most_mass;
    y += h * rate;
    theta += h * swing;
    most = std::max(most, std::abs(missing));
  }
  return most;
}

}  // namespace zwang::lang
