// E621, W621: a base that is pushed to a wall, and does not rest square. `resting_yaw` has the law.
//
// If a scene has a wall straight ahead of the start, the base comes as askew as it stands there. Else it is
// asked from 20 deg to both sides, as the shipped tasks promise, and the answer is a warning.
//
// The law is of statics, and a hit turns the base before it rests. All of the motion is E = m v^2 / 2. After
// the hit the base goes back with u, and turns with w. The push F brings it back after 2 m u / F:
//
//   dt = 2 m u w / F,  m u^2 + I w^2 <= m v^2  =>  dt <= m v^2 / F sqrt(m / I)
//
// A restitution e leaves e^2 of E to the next hit. All later ones turn the base by e^2 / (1 - e^2) as much:
// by less than the bound, if e is below 0.7. A base that would rest square from dt less askew is warned of.
#include "physics/resting.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnostic/wordings_square.hpp"
#include "physics/ahead.hpp"
#include "physics/questions.hpp"
#include "zwang/lang/configurations.hpp"
#include "zwang/lang/object_outline.hpp"
#include "zwang/lang/plane.hpp"
#include "zwang/lang/task_draft.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {

namespace {

using Corners = std::vector<Eigen::Vector2d>;

constexpr double degree_askew = std::numbers::pi / 180.0;
constexpr double assumed_askew = 20.0 * degree_askew;

/// A base that rests farther than this is beside its front, on one of its sides. [rad]
constexpr double to_a_side = 45.0 * degree_askew;

/// From `yaw` and as far to the other side. nullopt: the base turns away.
std::optional<double> farthest_rest(const Corners& outline, const std::vector<double>& yaws,
                                    const WallGrip& grip) {
  double farthest = 0.0;
  for (const double yaw : yaws) {
    const std::optional<double> rest = resting_yaw(outline, yaw, grip);
    if (!rest) return std::nullopt;
    if (std::abs(*rest) > std::abs(farthest)) farthest = *rest;
  }
  return farthest;
}

std::vector<double> both_sides(double yaw) {
  return {yaw, -yaw};
}

bool is_square(const std::optional<double>& rest) {
  return rest && std::abs(*rest) <= round_ahead;
}

/// In whole degrees, from which and from below which the base squares up. [rad]
double largest_square_start(const Corners& outline, const WallGrip& grip) {
  int most = 0;
  while (most < 60 && is_square(farthest_rest(outline, both_sides((most + 1) * degree_askew), grip))) ++most;
  return most * degree_askew;
}

/// A frame of an arm beyond the outline, in the axes of the outline.
struct Tip {
  Eigen::Vector2d at{0.0, 0.0};  ///< [m]
  std::string name;
};

/// Of bodies that neither are wheels nor carry them, at the start pose.
std::vector<Tip> tips_beyond(const Corners& outline, const PushedToWall& pushed, Probe& probe) {
  const Robot& robot = probe.robot();
  const solver::Model& model = robot.model;
  std::vector<bool> is_of_base(static_cast<std::size_t>(model.body_count()), false);
  is_of_base[0] = true;
  for (const solver::Wheel& wheel : model.wheels()) {
    for (int b = wheel.body; b > 0; b = model.bodies()[static_cast<std::size_t>(b)].parent)
      is_of_base[static_cast<std::size_t>(b)] = true;
  }
  const double ground = model.wheels().empty() ? 0.0 : wheel_level(model).mean;
  const Eigen::VectorXd q = start_state(robot).q;
  std::vector<Tip> tips;
  for (const solver::Frame& frame : model.frames()) {
    if (is_of_base[static_cast<std::size_t>(frame.body)]) continue;
    const solver::Vector3 place = pose_in_base(model, frame.body, q) * frame.pose_in_body.position;
    if (pushed.wall && !reaches(*pushed.wall->object, place.z() - ground)) continue;
    const Eigen::Vector2d at = along_push(place, pushed.push, probe);
    if (!plane::contains(outline, at)) tips.push_back({at, frame.name});
  }
  return tips;
}

/// The outline with the tips; `first`: the tip that touches first from these angles, nullptr where none does.
Corners with_tips(const Corners& outline, const std::vector<Tip>& tips, const std::vector<double>& yaws,
                  const Tip*& first) {
  Corners all = outline;
  for (const Tip& tip : tips) all.push_back(tip.at);
  first = nullptr;
  for (const double yaw : yaws) {
    const Eigen::Vector2d forward = Eigen::Rotation2Dd(-yaw) * Eigen::Vector2d::UnitX();
    double most = -solver::infinity;
    for (const Eigen::Vector2d& corner : outline) most = std::max(most, forward.dot(corner));
    for (const Tip& tip : tips) {
      if (forward.dot(tip.at) <= most) continue;
      most = forward.dot(tip.at);
      first = &tip;
    }
  }
  return plane::convex_hull(all);
}

/// The least and the most that may keep a base from turning square.
struct Grips {
  WallGrip least, most;
};

/// The wheels of a swivel hold the base sideways, until they have swivelled.
bool has_swivels(const solver::Model& model) {
  return std::any_of(model.wheels().begin(), model.wheels().end(),
                     [](const solver::Wheel& wheel) { return wheel.holds_sideways && !wheel.roller_angle; });
}

/// The friction of a wall turns a base square that slides along it, and not before the base slides.
Grips grips_of(const PushedToWall& pushed, const Robot& robot) {
  const double friction = pushed.wall ? pushed.wall->friction : 0.0;
  const double floor = pushed.floor / pushed.push.force, row = pushed.row / pushed.push.force;
  Grips grips{{friction, floor, false}, {friction, floor + row, false}};
  if (has_axle(robot.model)) return grips;
  const bool slides = pushed.floor == 0.0;
  grips.least.slides = slides;
  if (!slides) grips.least.friction = 0.0;
  if (slides && !has_swivels(robot.model)) grips.most.friction = 0.0;
  return grips;
}

/// By which a hit turns the base at most: `dt`. [rad]
double turned_by_hit(const PlannedAxis& heading, const PushedToWall& pushed, Probe& probe) {
  const AxisFigures* ahead = probe.figures(*pushed.push.axis);
  const AxisFigures* turn = probe.figures(heading);
  if (ahead == nullptr || turn == nullptr || !(turn->mass > 0.0)) return solver::infinity;
  return ahead->mass * pushed.speed * pushed.speed / pushed.push.force * std::sqrt(ahead->mass / turn->mass);
}

wording::ComesAskew coming_askew(const Corners& outline, const std::vector<double>& yaws, const Grips& grips,
                                 const PushedToWall& pushed, double by_hit) {
  const bool is_certain = !is_square(farthest_rest(outline, yaws, grips.least));
  const WallGrip& grip = is_certain ? grips.least : grips.most;
  wording::ComesAskew coming;
  for (const double yaw : yaws) {
    const std::optional<double> rest = resting_yaw(outline, yaw, grip);
    if (is_square(rest)) continue;
    coming.from = yaw;
    coming.rests_at = rest.value_or(yaw);
    coming.how = wording::Askew::rests;
    if (!rest || std::abs(*rest) > to_a_side) coming.how = wording::Askew::turned_away;
    if (rest && std::abs(*rest - yaw) < 1e-12) coming.how = wording::Askew::held;
  }
  const bool is_slowed = coming.how == wording::Askew::held && !is_certain && pushed.row > 0.0;
  if (is_slowed) coming.how = wording::Askew::slowed;
  coming.most = largest_square_start(outline, grips.most);
  const double hit = std::abs(coming.from) - by_hit;
  const bool is_askew_yet =
      hit > round_ahead && !is_square(resting_yaw(outline, std::copysign(hit, coming.from), grips.least));
  coming.is_sure =
      is_certain && (pushed.wall ? is_askew_yet : largest_square_start(outline, grips.least) == 0.0);
  if (pushed.wall && !coming.is_sure && !is_slowed)
    coming.unless = is_certain                           ? wording::Unless::hit
                    : coming.how == wording::Askew::held ? wording::Unless::slides
                                                         : wording::Unless::friction;
  coming.by_hit = by_hit;
  coming.friction = pushed.wall ? pushed.wall->friction : 0.0;
  coming.held = pushed.floor;
  coming.row = pushed.row;
  return coming;
}

}  // namespace

std::optional<WallAhead> wall_ahead(const std::optional<Scene>& scene, const Push& push, Probe& probe) {
  if (!scene || push.axis->in.body != 0) return std::nullopt;
  const double sign = push.axis->target.value_or(0.0) < 0.0 ? -1.0 : 1.0;
  const solver::Vector3 forward = sign * probe.direction(*push.axis);
  const Ahead ahead = first_ahead(*scene, probe.robot(), forward);
  const SceneObject* object = ahead.object;
  if (object == nullptr || object->shape == ShapeKind::cylinder || object->inverse_mass() > 0.0 ||
      object->leans())
    return std::nullopt;
  const Outline outline = outline_in_world(*object, probe.robot().bumper_height);
  const double turn = plane::signed_area(outline) < 0.0 ? -1.0 : 1.0;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    constexpr double on_it = 1e-6, edge = 1e-3;  // [m]
    const solver::Vector3 along = turn * (outline[i] - outline[j]);
    const solver::Vector3 into(-along.y(), along.x(), 0.0);
    const bool is_met = plane::distance_to_segment(ahead.meeting.middle, outline[j], outline[i]) < on_it &&
                        (ahead.meeting.middle - outline[i]).norm() > edge &&
                        (ahead.meeting.middle - outline[j]).norm() > edge;
    if (!is_met || into.dot(forward) <= 0.0) continue;
    const double askew = std::atan2(into.x() * forward.y() - into.y() * forward.x(), into.dot(forward));
    return WallAhead{askew, object->friction.value_or(0.0), object};
  }
  return std::nullopt;
}

void ask_rest(const PlannedAxis& axis, const PushedToWall& pushed, const Span& exit, Probe& probe,
              Remarks& remarks) {
  const Corners outline = outline_along(pushed.push, probe);
  if (outline.size() < 3) return;
  const Span& span = axis.text->name.span;
  if (pushed.floor + pushed.row == 0.0) {
    const std::optional<double> round = farthest_rest(outline, both_sides(assumed_askew), {});
    const bool is_round = round && !is_square(round) && std::abs(*round) < to_a_side;
    if (is_round) return remarks.add(wording::rests_askew(span, axis.path, std::abs(*round), exit));
  }
  const Grips grips = grips_of(pushed, probe.robot());
  const std::vector<double> yaws = pushed.wall ? std::vector{pushed.wall->askew} : both_sides(assumed_askew);
  const Tip* first = nullptr;
  const std::vector<Tip> tips = tips_beyond(outline, pushed, probe);
  const Corners touching = with_tips(outline, tips, yaws, first);
  if (is_square(farthest_rest(touching, yaws, grips.most))) return;
  const double by_hit = turned_by_hit(axis, pushed, probe);
  wording::ComesAskew coming = coming_askew(touching, yaws, grips, pushed, by_hit);
  if (first != nullptr) coming.tip = first->name;
  remarks.add(wording::comes_askew(span, axis.path, coming, exit));
}

}  // namespace zwang::lang
