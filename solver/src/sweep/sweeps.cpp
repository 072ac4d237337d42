#include "sweep/sweeps.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::solver {

namespace {

/// v x m (RBDA 2.31).
Vector6 cross_motion(const Vector6& v, const Vector6& m) {
  const Vector3 w = v.head<3>();
  Vector6 result;
  result << w.cross(m.head<3>()), w.cross(m.tail<3>()) + v.tail<3>().cross(m.head<3>());
  return result;
}

/// Turns R about its own column k: R Rot(e_k, q).
void turn_about_column(int k, double q, Matrix3& R) {
  const double cosine = std::cos(q);
  const double sine = std::sin(q);
  const int i = (k + 1) % 3;
  const int j = (k + 2) % 3;
  const Vector3 column = R.col(i);
  R.col(i) = cosine * column + sine * R.col(j);
  R.col(j) = cosine * R.col(j) - sine * column;
}

/// Turns R about an axis given in its own coordinates, by Rodrigues' formula on each column.
void turn_about_axis(const Vector3& axis_in_base, double q, Matrix3& R) {
  const double sine = std::sin(q);
  const double versine = 1.0 - std::cos(q);
  for (int k = 0; k < 3; ++k) {
    const Vector3 normal = axis_in_base.cross(R.col(k));
    R.col(k) += sine * normal + versine * axis_in_base.cross(normal);
  }
}

/// Pose and joint motion of body i from its parent's.
void place(const Body& body, double q, const BodySweep& parent, BodySweep& sweep) {
  if (sweep.turned_in_parent) {
    sweep.R.noalias() = parent.R * body.pose_in_parent.rotation;
  } else {
    sweep.R = parent.R;
  }
  sweep.p = parent.p;
  sweep.p.noalias() += parent.R * body.pose_in_parent.position;
  const int k = sweep.axis_column;
  const Vector3 axis = k >= 0 ? Vector3(sweep.R.col(k)) : Vector3(sweep.R * body.joint.axis);
  if (body.joint.type == JointType::prismatic) {
    sweep.p += q * axis;
    sweep.S << Vector3::Zero(), axis;
    return;
  }
  if (k >= 0) {
    turn_about_column(k, q, sweep.R);
  } else {
    turn_about_axis(axis, q, sweep.R);
  }
  sweep.S << axis, sweep.p.cross(axis);
}

/// The body's own inertia in the base's axes and about its origin, and what its motion, gravity and the world
/// do to it:
///   pA = v x* I v - f_ext - I g
void write_inertia(const RigidInertia& inertia, bool moving, const Vector3& gravity, const ForceVector& f_ext,
                   BodySweep& sweep) {
  const RigidInertia turned = inertia.expressed_in({sweep.R, sweep.p});
  const Vector3& h = turned.first_moment;
  sweep.IA.topLeftCorner<3, 3>() = turned.rotational;
  sweep.IA.topRightCorner<3, 3>() = skew(h);
  sweep.IA.bottomLeftCorner<3, 3>() = -skew(h);
  sweep.IA.bottomRightCorner<3, 3>() = turned.mass * Matrix3::Identity();
  sweep.pA.setZero();
  if (!moving) return;
  const Vector3 w = sweep.v.head<3>();
  const Vector3 v = sweep.v.tail<3>();
  const Vector3 momentum = turned.mass * v - h.cross(w);
  const Vector3 spin = turned.rotational * w + h.cross(v);
  sweep.pA << w.cross(spin) + v.cross(momentum) - h.cross(gravity), w.cross(momentum) - turned.mass * gravity;
  if (!f_ext.is_zero()) sweep.pA -= sweep.to_base(f_ext);
}

/// Inverse of the lower Cholesky factor of a symmetric positive definite 6 x 6; false when it is not.
bool invert_factor(const Matrix6& inertia, Matrix6& inverse) {
  Matrix6 factor = inertia;
  for (int k = 0; k < 6; ++k) {
    const double pivot = inertia(k, k) - factor.row(k).head(k).squaredNorm();
    if (!(pivot > 1e-14 * inertia(k, k))) return false;
    factor(k, k) = std::sqrt(pivot);
    for (int i = k + 1; i < 6; ++i) {
      factor(i, k) = (inertia(i, k) - factor.row(i).head(k).dot(factor.row(k).head(k))) / factor(k, k);
    }
  }
  inverse.setZero();
  for (int c = 0; c < 6; ++c) {
    inverse(c, c) = 1.0 / factor(c, c);
    for (int i = c + 1; i < 6; ++i) {
      inverse(i, c) = -factor.row(i).segment(c, i - c).dot(inverse.col(c).segment(c, i - c)) / factor(i, i);
    }
  }
  return true;
}

}  // namespace

Sweeps::Sweeps(const Model& model, int row_capacity)
    : bodies(static_cast<std::size_t>(model.body_count())),
      L(RowMajorMatrix::Zero(2 * row_capacity, 2 * row_capacity)),
      g(Eigen::VectorXd::Zero(2 * row_capacity)),
      origins(static_cast<std::size_t>(2 * row_capacity)),
      A(Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 2 * row_capacity)) {
  for (BodySweep& body : bodies) {
    body.columns.reserve(origins.size());
    body.SA.resize(origins.size());
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = model.bodies()[i];
    parents_.push_back(body.parent);
    bodies[i].turned_in_parent = body.pose_in_parent.rotation != Matrix3::Identity();
    for (int k = 0; k < 3; ++k) {
      if (body.joint.axis == Vector3::Unit(k)) bodies[i].axis_column = k;
    }
  }
}

void Sweeps::clear_rows() noexcept {
  rows = 0;
  columns = 0;
  for (BodySweep& body : bodies) body.columns.clear();
}

int Sweeps::add_column(int body, const Vector6& a, ColumnOrigin origin) noexcept {
  A.col(columns) = a;
  origins[static_cast<std::size_t>(columns)] = origin;
  for (int i = body; i >= 0; i = parents_[static_cast<std::size_t>(i)]) {
    bodies[static_cast<std::size_t>(i)].columns.push_back(columns);
  }
  return columns++;
}

int Sweeps::add_row(int body, const Vector6& a) noexcept {
  add_column(body, a, {rows, -1});
  return rows++;
}

void Sweeps::extend_last_row(int body, const Vector6& a) noexcept {
  add_column(body, a, {rows - 1, -1});
}

int Sweeps::add_joint_row(int joint) noexcept {
  add_column(joint + 1, Vector6::Zero(), {rows, joint + 1});
  return rows++;
}

void outward_kinematics(const Model& model, const State& state, bool moving, const Vector3& gravity,
                        Sweeps& sweeps) noexcept {
  for (std::size_t i = 0; i < sweeps.bodies.size(); ++i) {
    const Body& body = model.bodies()[i];
    BodySweep& sweep = sweeps.bodies[i];
    if (i == 0) {
      sweep.R.setIdentity();
      sweep.p.setZero();
      sweep.c.setZero();
      sweep.v.setZero();
      if (moving && !model.has_fixed_base()) sweep.v = state.base_twist.vector();
    } else {
      const BodySweep& parent = sweeps.bodies[static_cast<std::size_t>(body.parent)];
      const auto j = static_cast<Eigen::Index>(i) - 1;
      place(body, state.q(j), parent, sweep);
      sweep.v = parent.v;
      sweep.c.setZero();
      if (moving) {
        const Vector6 joint_twist = sweep.S * state.qd(j);
        sweep.c = cross_motion(parent.v, joint_twist);
        sweep.v += joint_twist;
      }
    }
    write_inertia(body.inertia, moving, gravity, state.f_ext[i], sweep);
  }
}

bool inward_inertia(const Model& model, const Eigen::VectorXd& tau, const Vector6& base_acceleration,
                    Sweeps& sweeps) noexcept {
  const int m = sweeps.columns;
  sweeps.L.topLeftCorner(m, m).setZero();
  sweeps.g.head(m).setZero();

  for (std::size_t i = sweeps.bodies.size() - 1; i > 0; --i) {
    const Body& body = model.bodies()[i];
    BodySweep& sweep = sweeps.bodies[i];
    BodySweep& parent = sweeps.bodies[static_cast<std::size_t>(body.parent)];

    sweep.U.noalias() = sweep.IA * sweep.S;
    sweep.D = body.joint.rotor_inertia + sweep.S.dot(sweep.U);
    if (!(sweep.D > 0.0)) return false;
    sweep.u = tau(static_cast<Eigen::Index>(i) - 1) - sweep.S.dot(sweep.pA);
    const double D_inverse = 1.0 / sweep.D;
    const Vector6 UD = sweep.U * D_inverse;

    sweep.IA.noalias() -= UD * sweep.U.transpose();
    parent.IA += sweep.IA;
    parent.pA += sweep.pA + UD * sweep.u;
    parent.pA.noalias() += sweep.IA * sweep.c;

    const double free_qdd = D_inverse * (sweep.u - sweep.U.dot(sweep.c));
    const std::size_t carried = sweep.columns.size();
    const int* const columns = sweep.columns.data();
    double* const SA = sweep.SA.data();
    for (std::size_t k = 0; k < carried; ++k) {
      const int column = columns[k];
      const bool own_joint =
          sweeps.origins[static_cast<std::size_t>(column)].joint_body == static_cast<int>(i);
      auto A = sweeps.A.col(column);
      SA[k] = own_joint ? 1.0 : sweep.S.dot(A);
      sweeps.g(column) += A.dot(sweep.c) + SA[k] * free_qdd;
      A -= UD * SA[k];
      const double SA_D = SA[k] * D_inverse;
      double* const L = &sweeps.L(column, 0);
      for (std::size_t l = 0; l <= k; ++l) L[columns[l]] += SA_D * SA[l];
    }
  }

  BodySweep& base = sweeps.bodies.front();
  if (model.has_fixed_base()) {
    sweeps.g.head(m).noalias() += sweeps.A.leftCols(m).transpose() * base_acceleration;
  } else {
    // With IA_0^-1 = F'F, F the inverse of the Cholesky factor: L += (F A)'(F A), g -= (F A)'(F pA).
    if (!invert_factor(base.IA, sweeps.base_inverse_factor)) return false;
    const Matrix6& F = sweeps.base_inverse_factor;
    const Vector6 Fp = F * base.pA;
    for (int k = 0; k < m; ++k) {
      const Vector6 FA = F * sweeps.A.col(k);
      sweeps.A.col(k) = FA;
      sweeps.g(k) -= FA.dot(Fp);
      for (int l = 0; l <= k; ++l) sweeps.L(k, l) += FA.dot(sweeps.A.col(l));
    }
  }
  sweeps.fold_columns();
  return true;
}

/// Adds the rows and columns of L, and the entries of g, that belong to the same row. Columns of a row are
/// neighbours.
void Sweeps::fold_columns() noexcept {
  if (columns == rows) return;
  for (int k = 0; k < columns; ++k) {
    const int row = origins[static_cast<std::size_t>(k)].row;
    const bool first = k == 0 || origins[static_cast<std::size_t>(k) - 1].row != row;
    g(row) = first ? g(k) : g(row) + g(k);
    for (int l = 0; l <= k; ++l) {
      const int other = origins[static_cast<std::size_t>(l)].row;
      const bool first_other = l == 0 || origins[static_cast<std::size_t>(l) - 1].row != other;
      // The off-diagonal pair of one row counts twice on its diagonal.
      const double value = (row == other && k != l ? 2.0 : 1.0) * L(k, l);
      L(row, other) = first && first_other ? value : L(row, other) + value;
    }
  }
}

void outward_accelerations(const Model& model, const Eigen::VectorXd& nu, const Vector6& base_acceleration,
                           Sweeps& sweeps, Eigen::VectorXd& qdd) noexcept {
  BodySweep& base = sweeps.bodies.front();
  base.a = base_acceleration;
  if (!model.has_fixed_base()) {
    // A holds F A by now: a_0 = F' (F A nu - F pA).
    const Matrix6& F = sweeps.base_inverse_factor;
    Vector6 force = -(F * base.pA);
    for (int k = 0; k < sweeps.columns; ++k) {
      force += sweeps.A.col(k) * nu(sweeps.origins[static_cast<std::size_t>(k)].row);
    }
    base.a = F.transpose() * force;
  }
  for (std::size_t i = 1; i < sweeps.bodies.size(); ++i) {
    BodySweep& sweep = sweeps.bodies[i];
    const auto parent = static_cast<std::size_t>(model.bodies()[i].parent);
    sweep.a = sweeps.bodies[parent].a + sweep.c;
    double force = sweep.u - sweep.U.dot(sweep.a);
    for (std::size_t k = 0; k < sweep.columns.size(); ++k) {
      force += sweep.SA[k] * nu(sweeps.origins[static_cast<std::size_t>(sweep.columns[k])].row);
    }
    const double joint_acceleration = force / sweep.D;
    qdd(static_cast<Eigen::Index>(i) - 1) = joint_acceleration;
    sweep.a += sweep.S * joint_acceleration;
  }
}

}  // namespace zwang::solver
