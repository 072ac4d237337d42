// N603: the first hit. A bound holds what the robot presses with; the base's momentum it cannot hold. The
// peak is that of hit.hpp, with
//
//   m   the effective mass along the axis, less where the object gives way: 1/m = 1/m_axis + 1/m_object
//   v   the speed with which the axis arrives (arrival.hpp)
//   K   n times the object's stiffness, c likewise: all n points of a flat side strike together
//   F   what the driver presses with once it stands: m v / tau of a velocity, within its force range
//
// A robot that feels through the lags of a velocity loop presses on until its virtual robot gives way. It
// strikes as with a stiffer spring, the drive's integral k = m k_i in series with the object's:
//
//   K + min(m / T_c^2, alpha K k / (K + k)),   k_i = 1/(T_c T_i)
//
// of the object of the scene that makes it largest. Without one the robot file's bumper is the spring,
// undamped. Where a force range bounds F, a peak above 2.5 times that bound is told, with the speed at which
// it comes down to the bound. Without a range the peak is told as it is. Where v is a bound the peak is one,
// too. The hardest of such peaks is told in tasks in which no forecast is.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_statics.hpp"
#include "physics/arrival.hpp"
#include "physics/statics.hpp"
#include "zwang/lang/hit.hpp"
#include "zwang/lang/object_outline.hpp"
#include "zwang/lang/plane.hpp"

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

/// What the driver presses with against something that stops it, `led` times as heavy as the robot. Other
/// drivers than velocities press with `unbounded` times that at most. [N]
double pressing(const PlannedAxis& axis, const AxisFigures& figures, double led, double speed, double bound,
                double unbounded) {
  double most = bound > 0.0 ? std::min(bound, figures.force) : figures.force;
  if (axis.driver != solver::Quantity::velocity) most = std::min(most, led * unbounded);
  if (axis.driver == solver::Quantity::velocity)
    most = std::min(most, led * figures.mass * speed / axis.time_constant);
  return most;
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

struct Struck {
  Hit hit;
  double stiffness = 0.0;  ///< [N/m] of the object alone
  std::string name;        ///< of the object; empty: the robot's own bumper
  int points = 1;
};

/// What a drive that feels late adds. [N/m]
double stiffness_of_drive(const Drive& drive, const Hit& hit) {
  if (!drive.feels_contact()) return 0.0;
  const double T = drive.time_constant;
  double series = hit.stiffness;
  if (drive.integral_time) {
    const double k = hit.mass / (T * *drive.integral_time);
    series *= k / (hit.stiffness + k);
  }
  return std::min(hit.mass / (T * T), drive.mass_factor * series);
}

Struck struck_bumper(const Robot& robot, const AxisFigures& figures, double speed, double push) {
  const Hit hit{figures.mass, speed, robot.bumper_stiffness, 0.0, push};
  Struck struck{hit, robot.bumper_stiffness, "", 1};
  struck.hit.stiffness += stiffness_of_drive(robot.drive, hit);
  return struck;
}

Struck struck_object(const SceneObject& object, const Robot& robot, const Hit& of_robot, int corners) {
  Struck struck{of_robot, 0.0, object.name, 1};
  const double other = object.inverse_mass();
  struck.hit.mass = 1.0 / (1.0 / of_robot.mass + other);
  // A flat side meets corners, or the corners of what is narrower; a round thing one point.
  if (object.shape != ShapeKind::cylinder) struck.points = corners;
  const double reduced = 1.0 / (1.0 / robot.model.total_mass() + other);
  struck.hit.stiffness = struck.points * object.stiffness;
  struck.stiffness = struck.hit.stiffness;
  struck.hit.stiffness += stiffness_of_drive(robot.drive, struck.hit);
  struck.hit.damping = struck.points * 2.0 * object.damping * std::sqrt(object.stiffness * reduced);
  return struck;
}

/// The object that is hit hardest, or the `only` one; none when there is none.
std::optional<Struck> hardest(const Scene& scene, const Robot& robot, const Hit& of_robot, int corners,
                              const SceneObject* only) {
  std::optional<Struck> worst;
  for (const SceneObject& object : scene.objects) {
    if (only != nullptr && only != &object) continue;
    if (!reaches(object, robot.bumper_height)) continue;  // it passes
    const Struck struck = struck_object(object, robot, of_robot, corners);
    if (!worst || struck.hit.peak_force() > worst->hit.peak_force()) worst = struck;
  }
  return worst;
}

/// The speed at which the peak comes down to `allowed`; what presses is as before.
double gentle_speed(Hit hit, double allowed) {
  double slow = 0.0, fast = hit.speed;
  for (int i = 0; i < 50; ++i) {
    hit.speed = 0.5 * (slow + fast);
    (hit.peak_force() > allowed ? fast : slow) = hit.speed;
  }
  return slow;
}

/// Of one axis; nullopt where nothing is struck, or gently.
struct Forecast {
  Span span;
  std::string path;
  wording::Impact impact;
  double allowed = 0.0, gentle_speed = 0.0;
};

std::optional<Forecast> forecast(const PlannedTask& plan, const PlannedAxis& axis,
                                 const std::optional<Scene>& scene, bool is_first, Probe& probe) {
  const Robot& robot = probe.robot();
  const AxisFigures* figures = probe.figures(axis);
  if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) return std::nullopt;
  const Arrival arrival = arrival_of(plan, axis, *figures, scene, is_first, probe);
  const double bound = bound_of(axis);
  if (!(arrival.speed > 0.0)) return std::nullopt;
  const double push = pressing(axis, *figures, robot.drive.mass_factor, arrival.speed, bound,
                               pressed_without_range(plan, axis, *figures));
  const double sign = axis.target && *axis.target < 0.0 ? -1.0 : 1.0;
  const int corners =
      std::max(1, foremost_corners(robot.footprint, sign * direction_in_base(axis, probe, scene)));
  const Hit of_robot{figures->mass, arrival.speed, 0.0, 0.0, push};
  std::optional<Struck> struck;
  if (scene && !robot.footprint.empty()) struck = hardest(*scene, robot, of_robot, corners, arrival.object);
  if (!struck && bound > 0.0) struck = struck_bumper(robot, *figures, arrival.speed, push);
  if (!struck) return std::nullopt;
  const double peak = struck->hit.peak_force(), allowed = gentle * bound;
  if (bound > 0.0 && peak <= allowed) return std::nullopt;
  return Forecast{bound > 0.0 ? axis.span(solver::Quantity::force) : axis.driver_span(),
                  axis.path,
                  {struck->hit.mass, arrival.speed, struck->stiffness, peak, struck->name, struck->points,
                   arrival.is_bound},
                  allowed,
                  bound > 0.0 ? gentle_speed(struck->hit, allowed) : 0.0};
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
    if (!axis.driver || axis.turns() || axis.move.body != 0 || axis.is_spring) continue;
    std::optional<Forecast> one = forecast(plan, axis, scene, is_first, probe);
    if (!one) continue;
    if (!one->impact.is_bound) {
      tell(*one);
      is_told = true;
    } else if (!bound || one->impact.peak > bound->impact.peak) {
      bound = std::move(one);
    }
  }
  if (bound && !is_told) tell(*bound);
}

}  // namespace zwang::lang
