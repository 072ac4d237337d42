#include "zwang/solver/wheel_odometry.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "constraint/ground.hpp"
#include "constraint/kinematics.hpp"

namespace zwang::solver {

namespace {

constexpr double smallest_pivot = 1e-9;  // of the largest

/// u . (v + w z x P) = -u . s, with s the velocity that the joints alone give the contact point P: one line
/// of J V = r, V = (vx, vy, l w). The length l makes its three columns alike.
struct ContactDirection {
  Vector3 u, P, slip_of_joints;
};

template <typename Visit>
void for_each_contact_direction(const Model& model, const State& state, const Visit& visit) noexcept {
  for_each_held_direction(model, [&](const Wheel& wheel, const HeldDirection& direction) {
    const BodyMotion motion = motion_of_body(wheel.body, model, state, BodyMotion{});
    const Vector3 axis =
        motion.pose.rotation * model.bodies()[static_cast<std::size_t>(wheel.body)].joint.axis;
    const Vector3 down = -wheel.radius * Vector3::UnitZ();
    const Vector3 slip = motion.linear + motion.angular.cross(down);
    visit(ContactDirection{direction.along(axis), motion.pose.position + down, slip});
  });
}

}  // namespace

WheelTwist twist_from_wheels(const Model& model, const State& state) noexcept {
  int rows = 0;
  double square_distance = 0.0;
  for_each_contact_direction(model, state, [&](const ContactDirection& held) {
    ++rows;
    square_distance += held.P.head<2>().squaredNorm();
  });
  WheelTwist result;
  if (rows == 0) return result;
  const double length = square_distance > 0.0 ? std::sqrt(square_distance / rows) : 1.0;

  const auto line = [length](const ContactDirection& held) {
    return Vector3(held.u.x(), held.u.y(), Vector3::UnitZ().cross(held.P).dot(held.u) / length);
  };
  Matrix3 JtJ = Matrix3::Zero();
  Vector3 Jtr = Vector3::Zero();
  for_each_contact_direction(model, state, [&](const ContactDirection& held) {
    JtJ += line(held) * line(held).transpose();
    Jtr -= line(held) * held.u.dot(held.slip_of_joints);
  });
  const Eigen::SelfAdjointEigenSolver<Matrix3> modes(JtJ);
  Vector3 V = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (modes.eigenvalues()(i) <= smallest_pivot * modes.eigenvalues()(2)) continue;
    const Vector3 mode = modes.eigenvectors().col(i);
    V += mode * (mode.dot(Jtr) / modes.eigenvalues()(i));
    ++result.rank;
  }
  double square_slip = 0.0;
  for_each_contact_direction(model, state, [&](const ContactDirection& held) {
    const double slip = line(held).dot(V) + held.u.dot(held.slip_of_joints);
    square_slip += slip * slip;
  });
  result.slip = std::sqrt(square_slip / rows);
  result.twist.linear = {V.x(), V.y(), 0.0};
  result.twist.angular = {0.0, 0.0, V.z() / length};
  return result;
}

}  // namespace zwang::solver
