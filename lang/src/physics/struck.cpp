// The hit is the hardest of these:
//
//   ahead, where the way is known    as it gives way (gives_way.hpp); at the end of that way a wall
//   any object, where it is not      a bound; one on a joint is a wall
//   an object under a script         a bound: a wall that comes with the script's largest speed
//   another robot                    its mass along the way; a wall where nobody knows that way
//
// Nobody knows how fast a hand or its own task moves something without a script: the note says so.
#include "physics/struck.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "physics/gives_way.hpp"
#include "zwang/lang/object_outline.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;

/// A drive that feels late adds so much. [N/m]
double stiffness_of_drive(const Drive& drive, double mass, double stiffness) {
  if (!drive.feels_contact()) return 0.0;
  const double T = drive.time_constant;
  double series = stiffness;
  if (drive.integral_time) {
    const double k = mass / (T * *drive.integral_time);
    series *= k / (stiffness + k);
  }
  return std::min(mass / (T * T), drive.mass_factor * series);
}

/// A skin of `points`, on something that weighs `other_mass` as a whole; infinite: it is fixed.
Struck skin_of(const Comer& comer, const std::string& name, int points, double stiffness, double ratio,
               double inverse_of_other) {
  Struck struck;
  struck.name = name;
  struck.points = points;
  struck.stiffness = points * stiffness;
  const double reduced = 1.0 / (1.0 / comer.robot.model.total_mass() + inverse_of_other);
  struck.hit = {comer.mass,
                comer.arrival.speed,
                struck.stiffness,
                points * 2.0 * ratio * std::sqrt(stiffness * reduced),
                0.0,
                0.0,
                comer.push};
  return struck;
}

/// As a wall, or as the mass 1 / `inverse_mass` that `hold` holds.
DrivenHit met_as(DrivenHit hit, const Drive& drive, double inverse_mass, double hold) {
  hit.inverse_mass = inverse_mass;
  hit.hold = hold;
  hit.stiffness += stiffness_of_drive(drive, hit.reduced_mass(), hit.stiffness);
  return hit;
}

bool is_pushed(const Scene& scene, const std::string& object) {
  return std::any_of(scene.pushes.begin(), scene.pushes.end(),
                     [&](const ScenePush& push) { return push.object == object; });
}

/// Whether the robot comes to the end of the object's free way. Either it pushes harder than the object is
/// held, or its energy carries both so far.
bool reaches_end(const DrivenHit& hit, const GivesWay& gives) {
  const double against = gives.hold + gives.stiffness * gives.free_way;
  if (hit.push.most >= against) return true;
  const double both = hit.mass + 1.0 / hit.inverse_mass;
  return 0.5 * both * hit.speed * hit.speed >= (gives.hold - hit.push.most) * gives.free_way;
}

Struck struck_ahead(const Scene& scene, const SceneObject& object, const Comer& comer) {
  const Meeting& meeting = comer.arrival.ahead.meeting;
  const GivesWay gives = gives_way(scene, object, meeting, *comer.arrival.forward, comer.robot.bumper_height);
  Struck struck =
      skin_of(comer, object.name, meeting.points, object.stiffness, object.damping, object.inverse_mass());
  const DrivenHit wall = met_as(struck.hit, comer.robot.drive, 0.0, 0.0);
  struck.hit = met_as(struck.hit, comer.robot.drive, gives.inverse_mass, gives.hold);
  if (gives.inverse_mass > 0.0 && std::isfinite(gives.free_way) && reaches_end(struck.hit, gives))
    struck.at_end = wall;
  if (is_pushed(scene, object.name)) struck.uncounted = "the hand on `" + object.name + "`";
  return struck;
}

/// Wherever it is struck.
Struck struck_somewhere(const Scene& scene, const SceneObject& object, const Comer& comer) {
  const int points = object.shape == ShapeKind::cylinder ? 1 : comer.corners;
  Struck struck =
      skin_of(comer, object.name, points, object.stiffness, object.damping, object.inverse_mass());
  const bool is_free = object.mass && !object.guide;
  struck.hit = met_as(struck.hit, comer.robot.drive, is_free ? 1.0 / *object.mass : 0.0,
                      is_free ? held_by_floor(scene, object) : 0.0);
  struck.is_bound = true;
  if (is_pushed(scene, object.name)) struck.uncounted = "the hand on `" + object.name + "`";
  return struck;
}

/// How fast the script brings it towards the robot at most. [m/s]
double speed_of_script(const SceneObject& object, const Arrival& arrival) {
  double most = 0.0;
  const double reach = std::hypot(object.size[0], object.size[1]);
  for (std::size_t i = 1; i < object.motion.size(); ++i) {
    const Waypoint& from = object.motion[i - 1];
    const Waypoint& to = object.motion[i];
    const double time = to.time - from.time;
    if (!(time > 0.0)) continue;
    const Vector3 velocity((to.at[0] - from.at[0]) / time, (to.at[1] - from.at[1]) / time, 0.0);
    const bool is_known = arrival.forward && !arrival.turns;
    const double nearer = is_known ? std::max(0.0, -velocity.dot(*arrival.forward)) : velocity.norm();
    most = std::max(most, nearer + reach * std::abs(to.yaw - from.yaw) / time);
  }
  return most;
}

/// Nothing of its task drives it.
bool never_drives(const SceneRobot& robot) {
  const auto drives = [](const Group& group) {
    return std::any_of(group.axes.begin(), group.axes.end(), [](const AxisStatements& axis) {
      return axis.driver && (axis.driver != solver::Quantity::velocity || axis.target.parameter >= 0 ||
                             axis.target.constant != 0.0);
    });
  };
  const auto any = [&](const std::vector<Group>& groups) {
    return std::any_of(groups.begin(), groups.end(), drives);
  };
  const Program& program = *robot.program;
  return !any(program.always.groups) && std::none_of(program.tasks.begin(), program.tasks.end(),
                                                     [&](const Task& task) { return any(task.groups); });
}

/// [1/kg] along `forward`; 0: askew, or its wheels hold it that way.
double inverse_mass_of(const SceneRobot& robot, const Vector3& forward) {
  constexpr double square = 0.999;  // 2.5 deg
  const double along = std::cos(robot.yaw) * forward.x() + std::sin(robot.yaw) * forward.y();
  const double across = std::cos(robot.yaw) * forward.y() - std::sin(robot.yaw) * forward.x();
  if (std::max(std::abs(along), std::abs(across)) < square) return 0.0;
  PlannedAxis axis;
  axis.move = axis.in = {0, {}};
  axis.axis = std::abs(along) >= square ? solver::Axis::x : solver::Axis::y;
  double budget = 1e7;
  try {
    Probe probe(robot.program->robot, std::nullopt, budget);
    const AxisFigures* figures = probe.figures(axis);
    return figures != nullptr && std::isfinite(figures->mass) && figures->mass > 0.0 ? 1.0 / figures->mass
                                                                                     : 0.0;
  } catch (const std::invalid_argument&) {
    return 0.0;  // no model
  }
}

Struck struck_robot(const SceneRobot& robot, const Comer& comer, bool is_ahead) {
  const double mass = robot.program->robot.model.total_mass();
  const int points = is_ahead ? comer.arrival.ahead.meeting.points : 2 * comer.corners;
  Struck struck = skin_of(comer, robot.name, points, robot.stiffness, robot.damping, 1.0 / mass);
  const double inverse = is_ahead ? inverse_mass_of(robot, *comer.arrival.forward) : 0.0;
  struck.hit = met_as(struck.hit, comer.robot.drive, inverse, 0.0);
  struck.is_bound = inverse == 0.0;
  if (!never_drives(robot)) struck.uncounted = "how `" + robot.name + "` moves";
  return struck;
}

}  // namespace

double Struck::most_at(double speed) const {
  Struck slower = *this;
  slower.hit.speed = speed;
  if (slower.at_end) slower.at_end->speed = speed;
  return slower.most();
}

Struck struck_bumper(const Comer& comer) {
  Struck struck;
  struck.stiffness = comer.robot.bumper_stiffness;
  struck.hit = {comer.mass, comer.arrival.speed, struck.stiffness, 0.0, 0.0, 0.0, comer.push};
  struck.hit = met_as(struck.hit, comer.robot.drive, 0.0, 0.0);
  return struck;
}

std::optional<Struck> struck_in(const Scene& scene, const Comer& comer) {
  const Arrival& arrival = comer.arrival;
  const Outline base = outline_at_start(comer.robot, scene);
  const auto is_passed = [&](const Outline& outline) {
    return arrival.forward && !arrival.turns && is_behind(outline, base, *arrival.forward);
  };
  std::vector<Struck> all;
  for (const SceneObject& object : scene.objects) {
    if (!reaches(object, comer.robot.bumper_height)) continue;
    const bool is_scripted = !object.motion.empty();
    if (arrival.ahead.object == &object) {
      all.push_back(struck_ahead(scene, object, comer));
      continue;
    }
    const bool is_moved = is_scripted || is_pushed(scene, object.name);
    const Outline outline = outline_in_world(object, comer.robot.bumper_height);
    if (!is_moved && (arrival.is_straight || is_passed(outline))) continue;
    all.push_back(struck_somewhere(scene, object, comer));
    if (!is_scripted) continue;
    all.back().hit.speed += speed_of_script(object, arrival);
    if (scene.objects.size() + scene.robots.size() > 1)
      all.back().uncounted = "what `" + object.name + "` squeezes the base against";
  }
  for (const SceneRobot& robot : scene.robots) {
    const Outline outline = outline_in_world(robot);
    if (outline.empty()) continue;
    const bool is_ahead = arrival.ahead.robot == &robot;
    if (!is_ahead && never_drives(robot) && (arrival.is_straight || is_passed(outline))) continue;
    all.push_back(struck_robot(robot, comer, is_ahead));
  }
  const auto worst = std::max_element(all.begin(), all.end(),
                                      [](const Struck& a, const Struck& b) { return a.most() < b.most(); });
  return worst == all.end() ? std::nullopt : std::optional<Struck>(*worst);
}

}  // namespace zwang::lang
