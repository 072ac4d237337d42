// N603: the first hit. A bound holds what the robot presses with; the base's momentum it cannot hold. The
// peak is that of driven_hit.hpp, with
//
//   m   the effective mass along the axis
//   v   the speed with which the axis arrives (arrival.hpp), and with which a script comes to meet it
//   K   n times the object's stiffness, c likewise: all n points of a flat side strike together
//   M   what the object weighs there, and what holds it (gives_way.hpp)
//   F   what the driver presses with, within its force range, the acceleration limits and the motors
//
// A robot that feels through the lags of a velocity loop presses on until its virtual robot gives way. It
// strikes as with a stiffer spring, the drive's integral k = m k_i in series with the object's:
//
//   K + min(m / T_c^2, alpha K k / (K + k)),   k_i = 1/(T_c T_i)
//
// of the object of the scene that makes it largest (struck.hpp). Without a scene the robot file's bumper is
// the spring, undamped. If a force range bounds F, a peak above 2.5 times that bound is told. The note names
// the speed at which the peak comes down to the bound. Without a range every peak is told. If v is only an
// upper bound, so is the peak. The hardest of these peaks is told, in tasks without a forecast.
//
// A step of h follows springs up to h w = 0.3, w = sqrt(K/m). The simulation feels a smaller force of a
// stiffer spring: at most 2 m v / h. There the depth h v at which a step may find the contact counts as much
// as the speed.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_statics.hpp"
#include "physics/statics.hpp"
#include "physics/struck.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;

constexpr double gentle = 2.5;  // of the force range

/// 0 where nothing bounds it. [N]
double bound_of(const PlannedAxis& axis) {
  if (axis.driver == solver::Quantity::force) return std::abs(axis.target.value_or(0.0));
  const std::optional<solver::Range>& range = axis[solver::Quantity::force];
  return range ? std::max(range->high, -range->low) : 0.0;
}

/// How many corners of the footprint lie foremost, together.
int foremost_corners(const std::vector<Vector3>& footprint, const Vector3& direction) {
  constexpr double together = 1e-3;  // [m]
  double most = -solver::infinity;
  for (const Vector3& corner : footprint) most = std::max(most, corner.dot(direction));
  return static_cast<int>(std::count_if(footprint.begin(), footprint.end(), [&](const Vector3& corner) {
    return corner.dot(direction) > most - together;
  }));
}

/// The speed at which the peak comes down to `allowed`; what presses is as before.
double gentle_speed(const Struck& struck, double allowed) {
  double slow = 0.0, fast = struck.hit.speed;
  for (int i = 0; i < 20; ++i) {
    const double speed = 0.5 * (slow + fast);
    (struck.most_at(speed) > allowed ? fast : slow) = speed;
  }
  return slow;
}

/// To two digits, up, with 2 %: the base passes its speed by so much. [N]
double rounded_up(double bound) {
  constexpr double past = 1.02;
  const double digit = std::pow(10.0, std::floor(std::log10(bound)) - 1.0);
  return digit * std::ceil(past * bound / digit);
}

/// The force that steps of h feel of the hit at most; 0: they follow it. [N]
double felt_in_steps(const DrivenHit& hit, double peak, double h) {
  constexpr double followed = 0.3;  // HitEnergy.*: 4 % of the peak are missing
  if (h * std::sqrt(hit.stiffness / hit.reduced_mass()) <= followed) return 0.0;
  return std::min(peak, 2.0 * hit.reduced_mass() * hit.speed / h + hit.push.most);
}

wording::Impact impact_of(const Struck& struck, const Arrival& arrival, const Scene* scene, double h) {
  wording::Impact impact;
  impact.mass = struck.hit.reduced_mass();
  impact.speed = struck.hit.speed;
  impact.stiffness = struck.stiffness;
  impact.peak = struck.hit.peak();
  impact.object = struck.name;
  impact.points = struck.points;
  impact.is_bound = arrival.is_bound || struck.hit.speed > arrival.speed;
  impact.is_most = impact.is_bound || struck.is_bound;
  if (impact.is_most) impact.peak = rounded_up(impact.peak);
  if (struck.at_end) impact.at_end = rounded_up(struck.at_end->peak());
  const DrivenHit& harder = struck.at_end ? *struck.at_end : struck.hit;
  impact.in_steps = felt_in_steps(harder, std::max(impact.peak, impact.at_end), h);
  if (!struck.uncounted.empty()) impact.uncounted.push_back(struck.uncounted);
  if (scene == nullptr) return impact;
  const auto is_on_base = [](const ScenePush& push) { return push.object.empty() && push.robot.empty(); };
  if (std::any_of(scene->pushes.begin(), scene->pushes.end(), is_on_base))
    impact.uncounted.emplace_back("the hand on the base");
  const auto is_load = [](const Fault& fault) {
    return fault.kind == FaultKind::payload && fault.robot.empty() && fault.value > 0.0;
  };
  if (std::any_of(scene->faults.begin(), scene->faults.end(), is_load))
    impact.uncounted.emplace_back("the scene's payload");
  return impact;
}

/// Of one axis; nullopt where nothing is struck, or gently.
struct Forecast {
  Span span;
  std::string path;
  wording::Impact impact;
  double allowed = 0.0, gentle_speed = 0.0;
  double most = 0.0;            ///< [N]
  bool has_slow_bound = false;  ///< nobody knows the speed
};

std::optional<Forecast> forecast(const PlannedTask& plan, const PlannedAxis& axis,
                                 const std::optional<Scene>& scene, bool is_first, Probe& probe) {
  const Robot& robot = probe.robot();
  const AxisFigures* figures = probe.figures(axis);
  if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) return std::nullopt;
  const Arrival arrival = arrival_of(plan, axis, *figures, scene, is_first, probe);
  const double bound = bound_of(axis);
  if (!(arrival.speed > 0.0)) return std::nullopt;
  const double sign = axis.target && *axis.target < 0.0 ? -1.0 : 1.0;
  const Vector3 along = sign * direction_in_base(axis, probe, scene);
  const Comer comer{robot, figures->mass, driver_push_of(plan, axis, *figures, arrival, bound, robot.drive),
                    arrival, std::max(1, foremost_corners(robot.footprint, along))};
  const bool is_seen =
      scene && !robot.footprint.empty() && !(scene->objects.empty() && scene->robots.empty());
  std::optional<Struck> struck;
  if (is_seen) struck = struck_in(*scene, comer);
  if (!is_seen && bound > 0.0) struck = struck_bumper(comer);
  if (!struck) return std::nullopt;
  const double most = struck->most(), allowed = gentle * bound;
  if (bound > 0.0 && most <= allowed) return std::nullopt;
  return Forecast{bound > 0.0 ? axis.span(solver::Quantity::force) : axis.driver_span(),
                  axis.path,
                  impact_of(*struck, arrival, scene ? &*scene : nullptr, robot.control_period),
                  allowed,
                  bound > 0.0 ? gentle_speed(*struck, allowed) : 0.0,
                  most,
                  arrival.is_bound};
}

}  // namespace

void ask_hit(const PlannedTask& plan, const std::optional<Scene>& scene, bool is_first, Probe& probe,
             Remarks& remarks) {
  const auto tell = [&](const Forecast& f) {
    remarks.add(wording::first_hit(f.span, f.path, f.impact, f.allowed, f.gentle_speed));
  };
  std::optional<Forecast> bound;
  bool is_told = false;
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis.driver || axis.turns() || axis.move.body != 0) continue;
    std::optional<Forecast> one = forecast(plan, axis, scene, is_first, probe);
    if (!one) continue;
    if (!one->has_slow_bound) {
      tell(*one);
      is_told = true;
    } else if (!bound || one->most > bound->most) {
      bound = std::move(one);
    }
  }
  if (bound && !is_told) tell(*bound);
}

}  // namespace zwang::lang
