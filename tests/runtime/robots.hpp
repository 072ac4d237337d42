/// A mecanum base in numbers that a test can check by hand, and conditions without a parser.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime::test {

using lang::AxisStatements;
using lang::CoordinateQuantity;
using lang::ExpressionNode;
using lang::Op;
using solver::Axis;
using solver::Quantity;

constexpr double period = 1e-3;       // [s]
constexpr double body_mass = 40.0;    // [kg]
constexpr double body_yaw = 3.0;      // [kg m^2]
constexpr double wheel_mass = 1.5;    // [kg]
constexpr double wheel_spin = 0.004;  // [kg m^2]
constexpr double wheel_turn = 0.002;  // [kg m^2] about the vertical
constexpr double wheel_radius = 0.075;
constexpr double rotor_inertia = 0.01;
constexpr double half_length = 0.25;
constexpr double half_width = 0.20;
constexpr double effort = 12.0;  // [N m]

inline constexpr const char* wheel_names[] = {"front_left", "front_right", "rear_left", "rear_right"};

inline solver::Vector3 wheel_position(int i) {
  return {i < 2 ? half_length : -half_length, i % 2 == 0 ? half_width : -half_width, wheel_radius};
}

/// Angle from the wheel's axis (+y) to that of the roller at the ground: front left and rear right 45 deg.
inline double roller_angle(int i) {
  return (i == 0 || i == 3 ? 1.0 : -1.0) * std::numbers::pi / 4.0;
}

inline lang::Robot mecanum_robot() {
  using solver::Matrix3;
  using solver::RigidInertia;
  using solver::Vector3;
  solver::ModelBuilder builder(
      solver::BaseType::ground, "base_link",
      RigidInertia::from_com(body_mass, Vector3(0, 0, 0.1), Vector3(2.0, 2.0, body_yaw).asDiagonal()));
  for (int i = 0; i < 4; ++i) {
    solver::Joint joint;
    joint.name = std::string(wheel_names[i]) + "_wheel";
    joint.type = solver::JointType::continuous;
    joint.axis = Vector3::UnitY();
    joint.rotor_inertia = rotor_inertia;
    joint.actuated = true;
    joint.max_effort = effort;
    builder.add_link(std::string(wheel_names[i]), "base_link", {Matrix3::Identity(), wheel_position(i)},
                     joint,
                     RigidInertia::from_com(wheel_mass, Vector3::Zero(),
                                            Vector3(wheel_turn, wheel_spin, wheel_turn).asDiagonal()));
    solver::Wheel wheel;
    wheel.radius = wheel_radius;
    wheel.roller_angle = roller_angle(i);
    builder.add_wheel(joint.name, wheel);
  }
  lang::Robot robot;
  robot.name = "test_base";
  robot.model = builder.build();
  robot.base_frame = "base_link";
  robot.stop = {.deceleration = 1.0, .force = 80.0};
  robot.footprint = {{0.4, 0.3, 0}, {-0.4, 0.3, 0}, {-0.4, -0.3, 0}, {0.4, -0.3, 0}};  // radius 0.5 m
  return robot;
}

/// The frames of the test base: 0 the world, 1 the base, 2 a bumper 0.4 m ahead.
inline std::vector<lang::FrameDeclaration> base_frames() {
  lang::FrameDeclaration world, base, bumper;
  world.name = "world";
  base.name = "base_link";
  base.parent = lang::FrameParent::body;
  base.parent_index = 0;
  bumper = base;
  bumper.name = "bumper";
  bumper.pose.position = {0.4, 0, 0};
  return {world, base, bumper};
}
constexpr int world_frame = 0;
constexpr int base_link = 1;
constexpr int bumper = 2;

inline lang::Program program(std::vector<lang::Task> tasks) {
  lang::Program p;
  p.path = "test.yaml";
  p.robot = mecanum_robot();
  p.frames = base_frames();
  p.tasks = std::move(tasks);
  return p;
}

inline AxisStatements free_axis(const std::string& name, Axis axis) {
  AxisStatements a;
  a.name = name;
  a.axis = axis;
  return a;
}

inline AxisStatements drive(const std::string& name, Axis axis, Quantity quantity, double target) {
  AxisStatements a = free_axis(name, axis);
  a.driver = quantity;
  a.target.constant = target;
  return a;
}

inline lang::ValueRange between(double low, double high) {
  return {{.constant = low}, {.constant = high}};
}

inline lang::Task task(const std::string& name, std::vector<AxisStatements> axes, int move = base_link,
                       int in = base_link) {
  lang::Task t;
  t.name = name;
  t.blend.constant = 0.0;
  lang::Group group;
  group.name = "go";
  group.move = move;
  group.in = in;
  group.axes = std::move(axes);
  t.groups.push_back(group);
  return t;
}

// Conditions. Operands stand before their operators, as the parser leaves them.
using Nodes = std::vector<ExpressionNode>;

inline Nodes number(double x) {
  ExpressionNode n;
  n.number = x;
  return {n};
}
inline Nodes name(Op op, int index = -1) {
  ExpressionNode n;
  n.op = op;
  n.index = index;
  return {n};
}
inline Nodes coordinate(int group, int axis, CoordinateQuantity what) {
  ExpressionNode n;
  n.op = Op::coordinate;
  n.index = group;
  n.axis = axis;
  n.what = what;
  return {n};
}
inline Nodes apply(Op op, Nodes a) {
  ExpressionNode n;
  n.op = op;
  n.left = static_cast<int>(a.size()) - 1;
  a.push_back(n);
  return a;
}
inline Nodes apply(Op op, const Nodes& a, const Nodes& b) {
  const int shift = static_cast<int>(a.size());
  Nodes all(a.size() + b.size() + 1);
  std::copy(a.begin(), a.end(), all.begin());
  std::transform(b.begin(), b.end(), all.begin() + shift, [shift](ExpressionNode node) {
    if (node.left >= 0) node.left += shift;
    if (node.right >= 0) node.right += shift;
    return node;
  });
  all.back().op = op;
  all.back().left = shift - 1;
  all.back().right = shift + static_cast<int>(b.size()) - 1;
  return all;
}
inline Nodes unknown() {
  return apply(Op::divide, number(0.0), number(0.0));
}
inline lang::Condition when(Nodes nodes, const std::string& text = "a condition") {
  lang::Condition c;
  c.nodes = std::move(nodes);
  c.text = text;
  return c;
}
inline lang::Condition after(double seconds) {
  return when(apply(Op::greater_equal, name(Op::elapsed), number(seconds - 1e-9)), "elapsed");
}
inline lang::Condition always_true() {
  return when(apply(Op::less, number(0.0), number(1.0)), "0 < 1");
}

inline lang::Target to_task(int index) {
  return {lang::TargetKind::task, index};
}
inline constexpr lang::Target to_done{lang::TargetKind::done, -1};
inline constexpr lang::Target to_failed{lang::TargetKind::failed, -1};

inline lang::Exit exit(lang::Condition condition, lang::Target target, double dwell = 0.0) {
  lang::Exit e;
  e.when = std::move(condition);
  e.target = target;
  e.dwell.constant = dwell;
  return e;
}

/// The planar dynamics of the test base, derived apart from the library: with the wheel rates w = J V,
/// (M + J' I J) dV/dt + Coriolis = J' tau + F, V = (vx, vy, wz) in base axes. The centre of mass lies on the
/// vertical through the base's origin.
class PlanarBase {
 public:
  PlanarBase() {
    const double mass = body_mass + 4 * wheel_mass;
    double yaw = body_yaw;
    for (int i = 0; i < 4; ++i) {
      const solver::Vector3 p = wheel_position(i);
      yaw += wheel_mass * p.head<2>().squaredNorm() + wheel_turn;
      // The roller's axis is the wheel's, turned by the roller angle; the ground holds motion along it.
      const Eigen::Vector2d u(-std::sin(roller_angle(i)), std::cos(roller_angle(i)));
      jacobian_.row(i) << u.x(), u.y(), u.y() * p.x() - u.x() * p.y();
      jacobian_.row(i) /= wheel_radius * u.x();
    }
    rigid_ = Eigen::Vector3d(mass, mass, yaw).asDiagonal();
    inertia_ = rigid_ + (wheel_spin + rotor_inertia) * jacobian_.transpose() * jacobian_;
  }

  /// The same of any base on wheels that hold one direction: its rigid inertia, the wheels' rates and spins.
  explicit PlanarBase(const lang::Robot& robot) {
    const solver::Model& model = robot.model;
    const solver::State rest(model);
    solver::RigidInertia whole;
    for (int b = 0; b < model.body_count(); ++b) {
      const solver::Pose at = solver::motion_of({b, {}, {}}, model, rest).pose;
      whole = whole + model.bodies()[static_cast<std::size_t>(b)].inertia.expressed_in(at);
    }
    const double m = whole.mass, hx = whole.first_moment.x(), hy = whole.first_moment.y();
    rigid_ << m, 0, -hy, 0, m, hx, -hy, hx, whole.rotational(2, 2);
    inertia_ = rigid_;
    for (int i = 0; i < 4; ++i) {
      const solver::Wheel& wheel = model.wheels()[static_cast<std::size_t>(i)];
      const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
      const solver::Vector3 p = body.pose_in_parent.position;
      const double angle = *wheel.roller_angle;
      const Eigen::Vector2d u(-std::sin(angle), std::cos(angle));
      jacobian_.row(i) << u.x(), u.y(), u.y() * p.x() - u.x() * p.y();
      jacobian_.row(i) /= wheel.radius * u.x();
      const double spin = body.inertia.rotational(1, 1) + body.joint.rotor_inertia;
      inertia_ += spin * jacobian_.row(i).transpose() * jacobian_.row(i);
    }
  }

  /// The planar wrench in base axes that the wheels' torques command.
  Eigen::Vector3d commanded(const Eigen::VectorXd& tau) const { return jacobian_.transpose() * tau; }
  const Eigen::Matrix3d& inertia() const { return inertia_; }
  Eigen::MatrixXd jacobian() const { return jacobian_; }

  /// One period under the wheels' torques and an outer force in base axes at the origin.
  void step(const Eigen::VectorXd& tau, const Eigen::Vector3d& force = Eigen::Vector3d::Zero()) {
    const Eigen::Vector3d p = rigid_ * V;  // momentum
    const Eigen::Vector3d w_cross(-V.z() * p.y(), V.z() * p.x(), V.x() * p.y() - V.y() * p.x());
    V += period * inertia_.ldlt().solve(commanded(tau) + force - w_cross);
    const double c = std::cos(pose.z()), s = std::sin(pose.z());
    pose += period * Eigen::Vector3d(c * V.x() - s * V.y(), s * V.x() + c * V.y(), V.z());
    wheels += period * jacobian_ * V;
    time += period;
  }

  void sense(Sensed& sensed) const {
    sensed.time = time;
    sensed.base_measured = true;
    sensed.state.base_pose.rotation = solver::rotation_from_rpy(0, 0, pose.z());
    sensed.state.base_pose.position = {pose.x(), pose.y(), 0.0};
    sensed.state.base_twist.linear = {V.x(), V.y(), 0.0};
    sensed.state.base_twist.angular = {0.0, 0.0, V.z()};
    sensed.state.q = wheels;
    sensed.state.qd = jacobian_ * V;
  }

  Eigen::Vector3d V = Eigen::Vector3d::Zero();     // vx, vy [m/s], wz [rad/s] in base axes
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();  // x, y [m], yaw [rad] in the world
  Eigen::Vector4d wheels = Eigen::Vector4d::Zero();
  double time = 0.0;

 private:
  Eigen::Matrix<double, 4, 3> jacobian_;
  Eigen::Matrix3d rigid_;
  Eigen::Matrix3d inertia_;
};

}  // namespace zwang::runtime::test
