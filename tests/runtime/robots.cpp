#include "robots.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "zwang/lang/condition_function.hpp"

namespace zwang::runtime::test {

solver::Vector3 wheel_position(int i) {
  return {i < 2 ? half_length : -half_length, i % 2 == 0 ? half_width : -half_width, wheel_radius};
}

double roller_angle(int i) {
  return (i == 0 || i == 3 ? 1.0 : -1.0) * std::numbers::pi / 4.0;
}

lang::Robot mecanum_robot() {
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

std::vector<lang::FrameDeclaration> base_frames() {
  lang::FrameDeclaration world, base, ahead;
  world.name = "world";
  base.name = "base_link";
  base.parent = lang::FrameParent::body;
  base.parent_index = 0;
  ahead = base;
  ahead.name = "bumper";
  ahead.pose.position = {0.4, 0, 0};
  return {world, base, ahead};
}

lang::Program program(std::vector<lang::Task> tasks) {
  lang::Program p;
  p.path = "test.yaml";
  p.robot = mecanum_robot();
  p.frames = base_frames();
  p.tasks = std::move(tasks);
  return p;
}

AxisStatements free_axis(const std::string& name, Axis axis) {
  AxisStatements a;
  a.name = name;
  a.axis = axis;
  return a;
}

AxisStatements drive(const std::string& name, Axis axis, Quantity quantity, double target) {
  AxisStatements a = free_axis(name, axis);
  a.driver = quantity;
  a.target.constant = target;
  return a;
}

lang::ValueRange between(double low, double high) {
  return {{.constant = low}, {.constant = high}};
}

lang::Task task(const std::string& name, std::vector<AxisStatements> axes, int move, int in) {
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

Nodes number(double x) {
  ExpressionNode n;
  n.number = x;
  return {n};
}

Nodes name(Op op, int index) {
  ExpressionNode n;
  n.op = op;
  n.index = index;
  return {n};
}

Nodes call(const char* function, int frame_or_task) {
  return {lang::call_of(function, frame_or_task)};
}

Nodes coordinate(int group, int axis, CoordinateQuantity what) {
  ExpressionNode n;
  n.op = Op::coordinate;
  n.index = group;
  n.axis = axis;
  n.what = what;
  return {n};
}

Nodes apply(Op op, Nodes a) {
  ExpressionNode n;
  n.op = op;
  n.left = static_cast<int>(a.size()) - 1;
  a.push_back(n);
  return a;
}

Nodes apply(Op op, const Nodes& a, const Nodes& b) {
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

Nodes unknown() {
  return apply(Op::divide, number(0.0), number(0.0));
}

lang::Condition when(Nodes nodes, const std::string& text) {
  lang::Condition c;
  c.nodes = std::move(nodes);
  c.text = text;
  return c;
}

lang::Condition after(double seconds) {
  return when(apply(Op::greater_equal, name(Op::elapsed), number(seconds - 1e-9)), "elapsed");
}

lang::Condition always_true() {
  return when(apply(Op::less, number(0.0), number(1.0)), "0 < 1");
}

lang::Target to_task(int index) {
  return {lang::TargetKind::task, index};
}

lang::Exit exit(lang::Condition condition, lang::Target target, double dwell) {
  lang::Exit e;
  e.when = std::move(condition);
  e.target = target;
  e.dwell.constant = dwell;
  return e;
}

PlanarBase::PlanarBase() {
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

PlanarBase::PlanarBase(const lang::Robot& robot) {
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

Eigen::Vector3d PlanarBase::commanded(const Eigen::VectorXd& tau) const {
  return jacobian_.transpose() * tau;
}

Eigen::MatrixXd PlanarBase::jacobian() const {
  return jacobian_;
}

void PlanarBase::step(const Eigen::VectorXd& tau, const Eigen::Vector3d& force) {
  const Eigen::Vector3d p = rigid_ * V;  // momentum
  const Eigen::Vector3d w_cross(-V.z() * p.y(), V.z() * p.x(), V.x() * p.y() - V.y() * p.x());
  V += period * inertia_.ldlt().solve(commanded(tau) + force - w_cross);
  const double c = std::cos(pose.z()), s = std::sin(pose.z());
  pose += period * Eigen::Vector3d(c * V.x() - s * V.y(), s * V.x() + c * V.y(), V.z());
  wheels += period * jacobian_ * V;
  time += period;
}

void PlanarBase::sense(Sensed& sensed) const {
  sensed.time = time;
  sensed.base_measured = true;
  sensed.state.base_pose.rotation = solver::rotation_from_rpy(0, 0, pose.z());
  sensed.state.base_pose.position = {pose.x(), pose.y(), 0.0};
  sensed.state.base_twist.linear = {V.x(), V.y(), 0.0};
  sensed.state.base_twist.angular = {0.0, 0.0, V.z()};
  sensed.state.q = wheels;
  sensed.state.qd = jacobian_ * V;
}

}  // namespace zwang::runtime::test
