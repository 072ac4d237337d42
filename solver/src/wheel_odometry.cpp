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
  lines_.resize(held_.size());
  if (!is_rigid_) return;
  find_lines(State(model));
  rigid_normal_ = normal();
}

/// Directions of one wheel, and of the wheels of one caster, follow one another: they share a carrier.
void WheelOdometry::find_lines(const State& state) noexcept {
  FrameMotion carrier;  // against the base
  int body = 0;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (held_[i].carrier != body) {
      body = held_[i].carrier;
      carrier = body == 0 ? FrameMotion{} : motion_of_body(body, model_, state, FrameMotion{});
    }
    lines_[i] = line(held_[i], carrier);
  }
}

WheelOdometry::Line WheelOdometry::line(const Held& held, const FrameMotion& carrier) noexcept {
  const Vector3 axis = carrier.pose.rotation * held.axis;
  const Vector3 u = HeldDirection{held.rolling, held.sideways}.along(axis);
  const Vector3 centre = carrier.pose.rotation * held.centre;
  const Vector3 down = -held.radius * Vector3::UnitZ();
  const Vector3 P = carrier.pose.position + centre + down;
  const Vector3 carried = carrier.linear + carrier.angular.cross(Vector3(centre + down));
  return {
      {u.x(), u.y(), P.x() * u.y() - P.y() * u.x()}, u, carried, axis.cross(down), P.head<2>().squaredNorm()};
}

WheelOdometry::Normal WheelOdometry::normal() const noexcept {
  Normal result;
  Matrix3 JtJ = Matrix3::Zero();
  double square_distance = 0.0;
  for (const Line& l : lines_) {
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

WheelTwist WheelOdometry::twist(const State& state) noexcept {
  WheelTwist result;
  if (held_.empty()) return result;
  if (!is_rigid_) find_lines(state);
  const Normal now = is_rigid_ ? rigid_normal_ : normal();
  const Vector3 scale(1.0, 1.0, 1.0 / now.length);
  Vector3 Jtr = Vector3::Zero();
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const Line& l = lines_[i];
    Jtr -= l.direction.cwiseProduct(scale) * l.slip_of_joints(state.qd(held_[i].joint));
  }
  const Vector3 V = (now.pseudo_inverse * Jtr).cwiseProduct(scale);  // (vx, vy, w)
  double square_slip = 0.0;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const Line& l = lines_[i];
    const double slip = l.direction.dot(V) + l.slip_of_joints(state.qd(held_[i].joint));
    square_slip += slip * slip;
  }
  result.rank = now.rank;
  result.slip = std::sqrt(square_slip / static_cast<double>(held_.size()));
  result.twist.linear = {V.x(), V.y(), 0.0};
  result.twist.angular = {0.0, 0.0, V.z()};
  return result;
}

}  // namespace zwang::solver
