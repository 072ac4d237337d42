#include "zwang/solver/wheel_odometry.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "constraint/ground.hpp"
#include "constraint/kinematics.hpp"

namespace zwang::solver {

namespace {

constexpr double smallest_pivot = 1e-9;  // of the largest

}  // namespace

WheelOdometry::WheelOdometry(const Model& model) : model_(model) {
  for_each_held_direction(model, [this](const Wheel& wheel, const HeldDirection& direction) {
    const Body& body = model_.bodies()[static_cast<std::size_t>(wheel.body)];
    held_.push_back({body.parent, wheel.body - 1, body.pose_in_parent.position,
                     body.pose_in_parent.rotation * body.joint.axis, wheel.radius, direction.rolling,
                     direction.sideways});
    is_rigid_ = is_rigid_ && body.parent == 0;
  });
  if (!is_rigid_) return;
  rigid_normal_ = normal(State(model));
  for (const Held& held : held_) rigid_lines_.push_back(line(held, State(model)));
}

WheelOdometry::Line WheelOdometry::line(const Held& held, const State& state) const noexcept {
  FrameMotion carrier;  // against the base
  if (held.carrier != 0) carrier = motion_of_body(held.carrier, model_, state, FrameMotion{});
  const Vector3 axis = carrier.pose.rotation * held.axis;
  const Vector3 u = HeldDirection{held.rolling, held.sideways}.along(axis);
  const Vector3 centre = carrier.pose.rotation * held.centre;
  const Vector3 down = -held.radius * Vector3::UnitZ();
  const Vector3 P = carrier.pose.position + centre + down;
  const Vector3 carried = carrier.linear + carrier.angular.cross(Vector3(centre + down));
  return {
      {u.x(), u.y(), P.x() * u.y() - P.y() * u.x()}, u, carried, axis.cross(down), P.head<2>().squaredNorm()};
}

WheelOdometry::Normal WheelOdometry::normal(const State& state) const noexcept {
  Normal result;
  Matrix3 JtJ = Matrix3::Zero();
  double square_distance = 0.0;
  for (const Held& held : held_) {
    const Line l = line(held, state);
    JtJ += l.direction * l.direction.transpose();
    square_distance += l.square_distance;
  }
  if (square_distance > 0.0) result.length = std::sqrt(square_distance / static_cast<double>(held_.size()));
  const Vector3 scale(1.0, 1.0, 1.0 / result.length);
  const Eigen::SelfAdjointEigenSolver<Matrix3> modes(Matrix3(scale.asDiagonal() * JtJ * scale.asDiagonal()));
  for (int i = 0; i < 3; ++i) {
    const double value = modes.eigenvalues()(i);
    if (value <= smallest_pivot * modes.eigenvalues()(2)) continue;
    const Vector3 mode = modes.eigenvectors().col(i);
    result.pseudo_inverse += mode * mode.transpose() / value;
    ++result.rank;
  }
  return result;
}

WheelTwist WheelOdometry::twist(const State& state) const noexcept {
  WheelTwist result;
  if (held_.empty()) return result;
  const Normal now = is_rigid_ ? rigid_normal_ : normal(state);
  const Vector3 scale(1.0, 1.0, 1.0 / now.length);
  const auto for_each_line = [&](auto&& visit) {
    for (std::size_t i = 0; i < held_.size(); ++i) {
      const double rate = state.qd(held_[i].joint);
      if (is_rigid_) visit(rigid_lines_[i], rate);
      if (!is_rigid_) visit(line(held_[i], state), rate);
    }
  };
  Vector3 Jtr = Vector3::Zero();
  for_each_line(
      [&](const Line& l, double rate) { Jtr -= l.direction.cwiseProduct(scale) * l.slip_of_joints(rate); });
  const Vector3 V = (now.pseudo_inverse * Jtr).cwiseProduct(scale);  // (vx, vy, w)
  double square_slip = 0.0;
  for_each_line([&](const Line& l, double rate) {
    const double slip = l.direction.dot(V) + l.slip_of_joints(rate);
    square_slip += slip * slip;
  });
  result.rank = now.rank;
  result.slip = std::sqrt(square_slip / static_cast<double>(held_.size()));
  result.twist.linear = {V.x(), V.y(), 0.0};
  result.twist.angular = {0.0, 0.0, V.z()};
  return result;
}

}  // namespace zwang::solver
