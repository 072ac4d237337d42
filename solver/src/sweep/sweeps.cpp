#include "sweep/sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "constraint/kinematics.hpp"

namespace zwang::solver {

namespace {

MotionVector motion_from(const Vector6& v) {
  return {v.head<3>(), v.tail<3>()};
}

MotionVector joint_axis(const Joint& joint) {
  if (joint.type == JointType::prismatic) return {Vector3::Zero(), joint.axis};
  return {joint.axis, Vector3::Zero()};
}

ForceVector times(const Matrix6& inertia, const MotionVector& v) {
  const Vector6 f = inertia * v.vector();
  return {f.head<3>(), f.tail<3>()};
}

/// X' I X for an articulated inertia I in body coordinates: rotate the 3 x 3 blocks, then shift them by r.
///   I = [J H; H' M]:  M_p = E'ME,  H_p = E'HE + r x M_p,  J_p = E'JE - (E'HE) rx + ... with everything about
///   the parent.
Matrix6 to_parent(const PluckerTransform& X, const Matrix6& I) {
  const Matrix3 Et = X.E.transpose();
  const Matrix3 M = Et * I.bottomRightCorner<3, 3>() * X.E;
  const Matrix3 H = Et * I.topRightCorner<3, 3>() * X.E;
  const Matrix3 J = Et * I.topLeftCorner<3, 3>() * X.E;
  const Matrix3 rx = skew(X.r);
  const Matrix3 shifted_H = H + rx * M;
  Matrix6 result;
  result.bottomRightCorner<3, 3>() = M;
  result.topRightCorner<3, 3>() = shifted_H;
  result.bottomLeftCorner<3, 3>() = shifted_H.transpose();
  result.topLeftCorner<3, 3>() = J + rx * H.transpose() - shifted_H * rx;
  return result;
}

/// Adds a child's column to its parent's.
void gather(const Column& child, const PluckerTransform& X, const ForceVector& A,
            std::vector<Column>& parent) {
  const ForceVector A_p = X.transpose_apply(A);
  if (child.shared) {
    for (Column& column : parent) {
      if (column.id == child.id) {
        column.A += A_p;
        return;
      }
    }
  }
  parent.push_back({child.id, child.shared, false, A_p, 0.0});
}

}  // namespace

Sweeps::Sweeps(const Model& model, int row_capacity)
    : bodies(static_cast<std::size_t>(model.body_count())),
      L(Eigen::MatrixXd::Zero(row_capacity, row_capacity)),
      g(Eigen::VectorXd::Zero(row_capacity)) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].columns.reserve(static_cast<std::size_t>(row_capacity));
    if (i > 0) bodies[i].S = joint_axis(model.bodies()[i].joint);
  }
}

void Sweeps::clear_rows() noexcept {
  rows = 0;
  for (BodySweep& body : bodies) body.columns.clear();
}

int Sweeps::add_row(int body, const ForceVector& a) noexcept {
  bodies[static_cast<std::size_t>(body)].columns.push_back({rows, false, false, a, 0.0});
  return rows++;
}

void Sweeps::extend_row(int id, int body, const ForceVector& a) noexcept {
  for (BodySweep& other : bodies) {
    for (Column& column : other.columns) {
      if (column.id == id) column.shared = true;
    }
  }
  bodies[static_cast<std::size_t>(body)].columns.push_back({id, true, false, a, 0.0});
}

int Sweeps::add_joint_row(int joint) noexcept {
  bodies[static_cast<std::size_t>(joint) + 1].columns.push_back({rows, false, true, ForceVector{}, 1.0});
  return rows++;
}

void outward_kinematics(const Model& model, const State& state, bool moving, Sweeps& sweeps) noexcept {
  const Vector3 gravity =
      moving ? Vector3(state.base_pose.rotation.transpose() * model.gravity()) : Vector3(Vector3::Zero());
  // Gravity in each body's axes rides outward with the twist.
  for (std::size_t i = 0; i < sweeps.bodies.size(); ++i) {
    const Body& body = model.bodies()[i];
    BodySweep& sweep = sweeps.bodies[i];
    if (i == 0) {
      sweep.v = moving && !model.has_fixed_base() ? state.base_twist : MotionVector{};
      sweep.c = MotionVector{};
      sweep.pA.linear = gravity;
    } else {
      const BodySweep& parent = sweeps.bodies[static_cast<std::size_t>(body.parent)];
      const auto j = static_cast<Eigen::Index>(i) - 1;
      sweep.X = PluckerTransform(pose_in_parent(body, state.q(j)));
      const MotionVector joint_twist = moving ? sweep.S * state.qd(j) : MotionVector{};
      sweep.v = sweep.X * parent.v + joint_twist;
      sweep.c = cross(sweep.v, joint_twist);
      sweep.pA.linear = sweep.X.E * parent.pA.linear;
    }
  }
  // pA = v x* I v - f_ext - I g, with the gravity g that was carried outward in pA.
  for (std::size_t i = 0; i < sweeps.bodies.size(); ++i) {
    BodySweep& sweep = sweeps.bodies[i];
    const RigidInertia& inertia = model.bodies()[i].inertia;
    sweep.IA = inertia.matrix();
    if (!moving) {
      sweep.pA = ForceVector{};
      continue;
    }
    const MotionVector fall{Vector3::Zero(), sweep.pA.linear};
    sweep.pA = cross(sweep.v, inertia * sweep.v) - state.f_ext[i] - inertia * fall;
  }
}

bool inward_inertia(const Model& model, const Eigen::VectorXd& tau, Sweeps& sweeps) noexcept {
  const int m = sweeps.rows;
  sweeps.L.topLeftCorner(m, m).setZero();
  sweeps.g.head(m).setZero();

  for (std::size_t i = sweeps.bodies.size() - 1; i > 0; --i) {
    const Body& body = model.bodies()[i];
    BodySweep& sweep = sweeps.bodies[i];
    BodySweep& parent = sweeps.bodies[static_cast<std::size_t>(body.parent)];

    sweep.U = times(sweep.IA, sweep.S);
    sweep.D = body.joint.rotor_inertia + dot(sweep.S, sweep.U);
    if (!(sweep.D > 0.0)) return false;
    sweep.u = tau(static_cast<Eigen::Index>(i) - 1) - dot(sweep.S, sweep.pA);
    const double D_inverse = 1.0 / sweep.D;

    const Vector6 U = sweep.U.vector();
    const Matrix6 Ia = sweep.IA - U * (D_inverse * U.transpose());
    const ForceVector pa = sweep.pA + times(Ia, sweep.c) + sweep.U * (D_inverse * sweep.u);
    parent.IA += to_parent(sweep.X, Ia);
    parent.pA += sweep.X.transpose_apply(pa);

    const double free_qdd = D_inverse * (sweep.u - dot(sweep.U, sweep.c));
    for (std::size_t k = 0; k < sweep.columns.size(); ++k) {
      Column& column = sweep.columns[k];
      if (!column.on_joint) column.SA = dot(sweep.S, column.A);
      sweeps.g(column.id) += dot(column.A, sweep.c) + column.SA * free_qdd;
      const double SA_D = column.SA * D_inverse;
      for (std::size_t l = 0; l <= k; ++l) {
        const Column& other = sweep.columns[l];
        sweeps.L(std::max(column.id, other.id), std::min(column.id, other.id)) += SA_D * other.SA;
      }
      gather(column, sweep.X, column.A - sweep.U * SA_D, parent.columns);
    }
  }

  BodySweep& base = sweeps.bodies.front();
  if (model.has_fixed_base()) return true;
  sweeps.base_inertia.compute(base.IA);
  if (sweeps.base_inertia.info() != Eigen::Success) return false;
  const Vector6 free_acceleration = -sweeps.base_inertia.solve(base.pA.vector());
  for (std::size_t k = 0; k < base.columns.size(); ++k) {
    const Column& column = base.columns[k];
    const Vector6 A = column.A.vector();
    const Vector6 response = sweeps.base_inertia.solve(A);
    sweeps.g(column.id) += A.dot(free_acceleration);
    for (std::size_t l = 0; l <= k; ++l) {
      const Column& other = base.columns[l];
      sweeps.L(std::max(column.id, other.id), std::min(column.id, other.id)) +=
          response.dot(other.A.vector());
    }
  }
  return true;
}

void outward_accelerations(const Model& model, const Sweeps& sweeps, const Eigen::VectorXd& nu,
                           std::vector<MotionVector>& acceleration, Eigen::VectorXd& qdd) noexcept {
  const BodySweep& base = sweeps.bodies.front();
  acceleration.front() = MotionVector{};
  if (!model.has_fixed_base()) {
    Vector6 force = -base.pA.vector();
    for (const Column& column : base.columns) force += column.A.vector() * nu(column.id);
    acceleration.front() = motion_from(sweeps.base_inertia.solve(force));
  }
  for (std::size_t i = 1; i < sweeps.bodies.size(); ++i) {
    const BodySweep& sweep = sweeps.bodies[i];
    const auto parent = static_cast<std::size_t>(model.bodies()[i].parent);
    const MotionVector carried = sweep.X * acceleration[parent] + sweep.c;
    double force = sweep.u - dot(sweep.U, carried);
    for (const Column& column : sweep.columns) force += column.SA * nu(column.id);
    const double joint_acceleration = force / sweep.D;
    qdd(static_cast<Eigen::Index>(i) - 1) = joint_acceleration;
    acceleration[i] = carried + sweep.S * joint_acceleration;
  }
}

}  // namespace zwang::solver
