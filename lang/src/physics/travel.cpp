// W416: a place that joints cannot come to.
//
//   a turn about one joint       q0 + t - s(q0) within its travel, for t or t + n 360 deg
//   a place on an arm            e'o - r <= s <= e'o + r
//
//   o   the first joint's origin, in the axes of the group
//   r   the sum of what lies between: from joint to joint, and to the frame; a slide adds its travel
//
// A base on level floor does not lift its arm, so heights in the world count, too.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnostic/wordings_never.hpp"
#include "physics/questions.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

namespace {

using solver::Body;
using solver::Model;

/// The joints between the body of `in` and that of `move`, the outermost first; empty where there is no such
/// chain.
std::vector<const Body*> chain(const Model& model, int from, int to) {
  std::vector<const Body*> bodies;
  for (int body = to; body > from; body = model.bodies()[static_cast<std::size_t>(body)].parent) {
    bodies.push_back(&model.bodies()[static_cast<std::size_t>(body)]);
    if (bodies.back()->parent == from) return bodies;
  }
  return {};
}

bool drives_to_a_place(const PlannedAxis& axis) {
  return axis.driver == solver::Quantity::position && axis.target && axis.text != nullptr && axis.is_placed &&
         !axis.is_set && !axis.is_feature() && !axis.is_on_path && axis.move.body > 0;
}

/// In the unit of `left`, of which `unit` is one. [rad] or [m]
void tell(const PlannedAxis& axis, wording::Bound left, double unit, const Span& joint, Remarks& remarks) {
  const wording::Bound asked{axis.path, left.quantity, left.unit, *axis.target / unit, *axis.target / unit};
  left.low /= unit;
  left.high /= unit;
  remarks.add(wording::beyond_a_range(axis.driver_span(), asked, left, joint));
}

/// A turn about the only joint in between.
void ask_turn(const PlannedAxis& axis, const Robot& robot, const solver::State& start, Remarks& remarks) {
  constexpr double small = 1e-3;  // [rad] small enough to be a turn about one axis
  const std::vector<const Body*> bodies = chain(robot.model, axis.in.body, axis.move.body);
  if (axis.in.body < 0 || bodies.size() != 1) return;
  const solver::Joint& joint = bodies.front()->joint;
  const int j = axis.move.body - 1;
  if (joint.type == solver::JointType::prismatic || !std::isfinite(joint.lower) ||
      !std::isfinite(joint.upper))
    return;
  const auto turned = [&](double by) {
    solver::State state = start;
    state.q(j) += by;
    return solver::coordinate_of(axis.move, axis.in, axis.axis, robot.model, state).position;
  };
  const double now = turned(0.0), slope = std::remainder(turned(small) - now, 2.0 * std::numbers::pi) / small;
  if (std::abs(std::abs(slope) - 1.0) > 1e-3) return;  // it turns about another axis
  const double sign = slope > 0.0 ? 1.0 : -1.0;
  const double asked = start.q(j) + sign * (*axis.target - now);
  // The turn nearest to the middle of the travel.
  const double middle = 0.5 * (joint.lower + joint.upper);
  const double away = std::abs(std::remainder(asked - middle, 2.0 * std::numbers::pi));
  if (away <= 0.5 * (joint.upper - joint.lower) + 1e-6) return;
  const double one = now + sign * (joint.lower - start.q(j)), other = now + sign * (joint.upper - start.q(j));
  tell(axis,
       {"the travel of `" + joint.name + "`", "position", "deg", std::min(one, other), std::max(one, other)},
       std::numbers::pi / 180.0, robot.joint_spans[static_cast<std::size_t>(j)], remarks);
}

/// From the first joint's origin to the frame, at most. [m]
double longest(const std::vector<const Body*>& bodies, const PlannedAxis& axis) {
  double way = axis.move.pose.position.norm();
  for (const Body* body : bodies) {
    if (body != bodies.back()) way += body->pose_in_parent.position.norm();
    if (body->joint.type != solver::JointType::prismatic) continue;
    way += std::max(std::abs(body->joint.lower), std::abs(body->joint.upper));
  }
  return way;
}

void ask_place(const PlannedAxis& axis, const Robot& robot, const solver::State& start, Remarks& remarks) {
  const solver::Vector3 along = axis.in.pose.rotation.col(static_cast<int>(axis.axis));
  const bool is_height = axis.in.body < 0 && std::abs(std::abs(along.z()) - 1.0) < 1e-9 &&
                         robot.model.base_type() == solver::BaseType::ground;
  if (axis.in.body < 0 && !is_height) return;
  const std::vector<const Body*> bodies = chain(robot.model, std::max(axis.in.body, 0), axis.move.body);
  if (bodies.empty()) return;
  solver::Vector3 origin = bodies.back()->pose_in_parent.position;
  if (is_height)
    origin =
        solver::motion_of({0, {solver::Matrix3::Identity(), origin}, {}}, robot.model, start).pose.position;
  const double middle = along.dot(origin - axis.in.pose.position), way = longest(bodies, axis);
  if (!std::isfinite(way) || std::abs(*axis.target - middle) <= way * (1.0 + 1e-6) + 1e-6) return;
  tell(axis, {"the arm's reach", "position", "m", middle - way, middle + way}, 1.0, {}, remarks);
}

}  // namespace

void ask_travel(const PlannedTask& plan, const Robot& robot, const std::optional<Scene>& scene,
                Remarks& remarks) {
  const solver::State start = start_state(robot, scene);
  for (const PlannedAxis& axis : plan.axes) {
    if (!drives_to_a_place(axis)) continue;
    axis.turns() ? ask_turn(axis, robot, start, remarks) : ask_place(axis, robot, start, remarks);
  }
}

}  // namespace zwang::lang
