// W611. The rate qd of a wheel of radius R. V = v + w x p is the velocity over the ground of the point where
// the wheel stands:
//
//   fixed wheel           qd = u'V / (R u'e)        and a'V = 0 where it holds sideways
//   wheel on a swivel     qd = |V| / R              once it points along the motion
//
//   a   the wheel's axis
//   e   its rolling direction, a x z
//   u   the direction that it holds: its roller's axis; of a plain wheel e
#include "robot/wheel_speed.hpp"

#include <cmath>
#include <numbers>

#include "diagnostic/wordings_standing.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;

struct Standing {
  solver::Pose pose;          ///< in the base
  bool is_on_swivel = false;  ///< a joint that moves carries it
};

Standing standing_of(const Robot& robot, int body) {
  const auto& bodies = robot.model.bodies();
  Standing standing;
  for (int b = body; b > 0; b = bodies[static_cast<std::size_t>(b)].parent) {
    standing.pose = bodies[static_cast<std::size_t>(b)].pose_in_parent * standing.pose;
    standing.is_on_swivel = standing.is_on_swivel || b != body;
  }
  return standing;
}

/// [rad/s]; nullopt where the wheel holds the motion.
std::optional<double> rate_of(const Robot& robot, const solver::Wheel& wheel, const Vector3& linear,
                              double turn) {
  const Standing standing = standing_of(robot, wheel.body);
  const Vector3& p = standing.pose.position;
  const Vector3 V(linear.x() - turn * p.y(), linear.y() + turn * p.x(), 0.0);
  if (standing.is_on_swivel) return V.norm() / wheel.radius;
  Vector3 a = standing.pose.rotation * robot.model.joint(wheel.body - 1).axis;
  a.z() = 0.0;
  if (a.norm() < 1e-6) return std::nullopt;
  a.normalize();
  const Vector3 e = a.cross(Vector3::UnitZ());
  if (wheel.roller_angle) {
    const Vector3 u = Eigen::AngleAxisd(*wheel.roller_angle, Vector3::UnitZ()) * a;
    return u.dot(V) / (wheel.radius * u.dot(e));
  }
  if (wheel.holds_sideways && std::abs(a.dot(V)) > 1e-3) return std::nullopt;
  return wheel.holds_rolling ? e.dot(V) / wheel.radius : 0.0;
}

}  // namespace

WheelSpeed wheel_speed(const Robot& robot, const Vector3& linear, double turn) {
  WheelSpeed speed;
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const std::optional<double> rate = rate_of(robot, wheel, linear, turn);
    if (!rate) return {};
    const solver::Joint& joint = robot.model.joint(wheel.body - 1);
    if (!joint.actuated || std::abs(*rate) < 1e-9) continue;
    const double most = joint.max_velocity / std::abs(*rate);
    if (most < speed.most) speed = {most, wheel.body - 1};
  }
  return speed;
}

WheelSpeed wheel_speed_along(const Robot& robot, solver::Axis axis) {
  if (axis == solver::Axis::x) return wheel_speed(robot, Vector3::UnitX(), 0.0);
  if (axis == solver::Axis::y) return wheel_speed(robot, Vector3::UnitY(), 0.0);
  return axis == solver::Axis::rz ? wheel_speed(robot, Vector3::Zero(), 1.0) : WheelSpeed{};
}

WheelSpeed wheel_speed_at_best(const Robot& robot) {
  constexpr int directions = 72;  // every 5 deg: axes, diagonals and those of three wheels are among them
  WheelSpeed best{0.0, -1};
  for (int i = 0; i < directions; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / directions;
    const WheelSpeed speed = wheel_speed(robot, {std::cos(angle), std::sin(angle), 0.0}, 0.0);
    if (std::isfinite(speed.most) && speed.most > best.most) best = speed;
  }
  return best.joint < 0 ? WheelSpeed{} : best;
}

double dry_friction_along(const Robot& robot, const Vector3& linear, double turn) {
  double force = 0.0;
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const std::optional<double> rate = rate_of(robot, wheel, linear, turn);
    if (!rate) return 0.0;
    const auto j = static_cast<std::size_t>(wheel.body - 1);
    if (standing_of(robot, wheel.body).is_on_swivel || j >= robot.friction.size()) continue;
    const JointFriction& friction = robot.friction[j];
    const double left = friction.presliding > 0.0 ? 1.0 - friction.compensate : 1.0;
    force += left * friction.coulomb * std::abs(*rate);
  }
  return force;
}

void check_speed_limits(const Robot& robot, Diagnostics& diagnostics) {
  for (const BaseLimit& limit : robot.limits) {
    if (limit.quantity != solver::Quantity::velocity) continue;
    const WheelSpeed speed = wheel_speed_along(robot, limit.axis);
    const double asked = std::max(limit.range.high, -limit.range.low);
    if (asked <= speed.most * (1.0 + 1e-6)) continue;
    const bool turns = limit.axis == solver::Axis::rz;
    const solver::Joint& joint = robot.model.joint(speed.joint);
    diagnostics.add(
        wording::beyond_the_wheels(limit.span,
                                   {std::string("limits.velocity.") + (turns                           ? "rz"
                                                                       : limit.axis == solver::Axis::x ? "x"
                                                                                                       : "y"),
                                    turns, asked, speed.most, joint.name, joint.max_velocity, true},
                                   robot.joint_spans[static_cast<std::size_t>(speed.joint)]));
  }
}

}  // namespace zwang::lang
