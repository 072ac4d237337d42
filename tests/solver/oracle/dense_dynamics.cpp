#include "oracle/dense_dynamics.hpp"

#include <cmath>

namespace zwang::oracle {

namespace {

using solver::BaseType;
using solver::JointType;

Vec3 real(const solver::Vector3& v) {
  return v.cast<Real>();
}

Mat3 real(const solver::Matrix3& m) {
  return m.cast<Real>();
}

/// Left-multiplies every column by `a x`.
Matrix cross_columns(const Vec3& a, const Matrix& columns) {
  Matrix out(3, columns.cols());
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    const Vec3 column = columns.col(j);
    out.col(j) = a.cross(column);
  }
  return out;
}

Mat3 tensor_at_centre(const solver::RigidInertia& inertia) {
  const Real m = inertia.mass;
  const Vec3 c = real(inertia.first_moment) / m;
  return real(inertia.rotational) - m * (c.dot(c) * Mat3::Identity() - c * c.transpose());
}

}  // namespace

Vector generalised_velocity(const solver::Model& model, const solver::State& state) {
  const int base = model.has_fixed_base() ? 0 : 6;
  Vector v(base + model.joint_count());
  if (base) v.head(6) << real(state.base_twist.angular), real(state.base_twist.linear);
  v.tail(model.joint_count()) = state.qd.cast<Real>();
  return v;
}

DenseDynamics::DenseDynamics(const solver::Model& m, const solver::State& state)
    : DenseDynamics(m, state, generalised_velocity(m, state)) {}

DenseDynamics::DenseDynamics(const solver::Model& m, const solver::State& state, const Vector& v)
    : model(&m), joints(m.joint_count()), velocity(v) {
  move(state);
  collect(state);
}

void DenseDynamics::move(const solver::State& state) {
  const int n = freedoms();
  const int base = base_freedoms();
  for (std::size_t i = 0; i < model->bodies().size(); ++i) {
    const solver::Body& body = model->bodies()[i];
    BodyMotion k;
    if (i == 0) {
      k.rotation = real(state.base_pose.rotation);
      k.origin = real(state.base_pose.position);
      k.angular_jacobian = Matrix::Zero(3, n);
      k.linear_jacobian = Matrix::Zero(3, n);
      if (base) {
        k.angular_jacobian.leftCols(3) = k.rotation;
        k.linear_jacobian.middleCols(3, 3) = k.rotation;
      }
      k.angular = k.angular_jacobian * velocity;
      k.linear = k.linear_jacobian * velocity;
      // d/dt (R v_base) = R (w x v_base) + R vdot_base
      k.angular_bias.setZero();
      k.linear_bias = k.angular.cross(k.linear);
    } else {
      const BodyMotion& p = bodies[static_cast<std::size_t>(body.parent)];
      const Eigen::Index j = static_cast<Eigen::Index>(i) - 1;
      const Real q = state.q[j];
      const Real rate = velocity[base + j];
      const bool slides = body.joint.type == JointType::prismatic;
      const Vec3 axis_in_body = real(body.joint.axis);
      const Mat3 at_zero = p.rotation * real(body.pose_in_parent.rotation);
      const Vec3 axis = at_zero * axis_in_body;
      k.rotation =
          slides ? at_zero : Mat3(at_zero * Eigen::AngleAxis<Real>(q, axis_in_body).toRotationMatrix());
      k.origin = p.origin + p.rotation * real(body.pose_in_parent.position) +
                 (slides ? Vec3(axis * q) : Vec3::Zero());
      const Vec3 arm = k.origin - p.origin;
      k.angular_jacobian = p.angular_jacobian;
      k.linear_jacobian = p.linear_jacobian - cross_columns(arm, p.angular_jacobian);
      (slides ? k.linear_jacobian : k.angular_jacobian).col(base + j) += axis;
      k.angular = k.angular_jacobian * velocity;
      k.linear = k.linear_jacobian * velocity;
      k.angular_bias = p.angular_bias;
      k.linear_bias = p.linear_bias + p.angular_bias.cross(arm) + p.angular.cross(p.angular.cross(arm));
      if (slides) {
        k.linear_bias += 2 * p.angular.cross(axis) * rate;
      } else {
        k.angular_bias += p.angular.cross(axis) * rate;
      }
    }
    bodies.push_back(std::move(k));
  }
}

void DenseDynamics::collect(const solver::State& state) {
  const int n = freedoms();
  const Vec3 g = real(model->gravity());
  M = Matrix::Zero(n, n);
  h = Vector::Zero(n);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const solver::RigidInertia& inertia = model->bodies()[i].inertia;
    const BodyMotion& k = bodies[i];
    if (inertia.mass > 0.0 && !(i == 0 && model->has_fixed_base())) {
      const Real m = inertia.mass;
      const Vec3 arm = k.rotation * real(inertia.first_moment) / m;
      const Mat3 I = k.rotation * tensor_at_centre(inertia) * k.rotation.transpose();
      const Matrix J = k.linear_jacobian - cross_columns(arm, k.angular_jacobian);
      const Matrix& W = k.angular_jacobian;
      const Vec3 bias = k.linear_bias + k.angular_bias.cross(arm) + k.angular.cross(k.angular.cross(arm));
      const Vec3 angular_momentum = I * k.angular;
      M += m * J.transpose() * J + W.transpose() * I * W;
      h += m * J.transpose() * (bias - g) +
           W.transpose() * (I * k.angular_bias + k.angular.cross(angular_momentum));
      potential -= m * g.dot(k.origin + arm);
    }
    const solver::ForceVector& f = state.f_ext[i];
    h -= k.linear_jacobian.transpose() * (k.rotation * real(f.linear));
    h -= k.angular_jacobian.transpose() * (k.rotation * real(f.angular));
  }
  for (int j = 0; j < joints; ++j) {
    M(base_freedoms() + j, base_freedoms() + j) += static_cast<Real>(model->joint(j).rotor_inertia);
  }
}

Vector DenseDynamics::spatial_acceleration(int body, const Vector& vdot) const {
  const BodyMotion& k = bodies[static_cast<std::size_t>(body)];
  const Vec3 angular = k.angular_jacobian * vdot + k.angular_bias;
  const Vec3 classical = k.linear_jacobian * vdot + k.linear_bias;
  const Vec3 linear = classical - k.angular.cross(k.linear);
  Vector a(6);
  a << k.rotation.transpose() * angular, k.rotation.transpose() * linear;
  return a;
}

LinearRows DenseDynamics::rows(const std::vector<solver::Row>& list) const {
  LinearRows out{Matrix::Zero(static_cast<Eigen::Index>(list.size()), freedoms()),
                 Vector::Zero(static_cast<Eigen::Index>(list.size()))};
  const auto add = [&](Eigen::Index r, int body, const solver::ForceVector& a, Real sign) {
    const BodyMotion& k = bodies[static_cast<std::size_t>(body)];
    const Vec3 moment = k.rotation * real(a.angular);
    const Vec3 force = k.rotation * real(a.linear);
    out.jacobian.row(r) +=
        sign * (moment.transpose() * k.angular_jacobian + force.transpose() * k.linear_jacobian);
    out.rhs[r] -= sign * (moment.dot(k.angular_bias) + force.dot(k.linear_bias - k.angular.cross(k.linear)));
  };
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto r = static_cast<Eigen::Index>(i);
    out.rhs[r] = static_cast<Real>(list[i].b);
    add(r, list[i].body, list[i].a, 1);
    if (list[i].reference_body >= 0) add(r, list[i].reference_body, list[i].a_reference, -1);
  }
  return out;
}

LinearRows DenseDynamics::ground() const {
  const int n = freedoms();
  if (model->base_type() != BaseType::ground) return {Matrix::Zero(0, n), Vector::Zero(0)};
  Eigen::Index count = 3;
  for (const solver::Wheel& wheel : model->wheels()) count += wheel.held_directions();
  LinearRows out{Matrix::Zero(count, n), Vector::Zero(count)};
  const BodyMotion& base = bodies[0];
  out.jacobian.row(0) = base.linear_jacobian.row(2);
  out.jacobian.row(1) = base.angular_jacobian.row(0);
  out.jacobian.row(2) = base.angular_jacobian.row(1);
  out.rhs.head(3) << -base.linear_bias.z(), -base.angular_bias.x(), -base.angular_bias.y();

  const Vec3 up = Vec3::UnitZ();
  Eigen::Index r = 3;
  for (const solver::Wheel& wheel : model->wheels()) {
    const solver::Body& body = model->bodies()[static_cast<std::size_t>(wheel.body)];
    const BodyMotion& k = bodies[static_cast<std::size_t>(wheel.body)];
    const BodyMotion& carrier = bodies[static_cast<std::size_t>(body.parent)];
    const Vec3 axle = k.rotation * real(body.joint.axis);
    const Vec3 to_ground = -static_cast<Real>(wheel.radius) * up;
    const auto hold = [&](Vec3 u) {
      u.normalize();
      // u . (v + w x to_ground) = 0 for all time, u turning with the carrier.
      const Vec3 slip = k.linear + k.angular.cross(to_ground);
      out.jacobian.row(r) =
          u.transpose() * (k.linear_jacobian - cross_columns(to_ground, k.angular_jacobian));
      out.rhs[r] =
          -u.dot(k.linear_bias + k.angular_bias.cross(to_ground)) - carrier.angular.cross(u).dot(slip);
      ++r;
    };
    if (wheel.roller_angle) {
      hold(Eigen::AngleAxis<Real>(*wheel.roller_angle, up) * (axle - axle.dot(up) * up));
      continue;
    }
    if (wheel.holds_rolling) hold(axle.cross(up));
    if (wheel.holds_sideways) hold(axle - axle.dot(up) * up);
  }
  return out;
}

}  // namespace zwang::oracle
