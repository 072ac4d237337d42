#include "sweep/sweeps.hpp"

#include <cmath>
#include <limits>

namespace zwang::solver {

namespace {

/// R = from Rot(e_k, q): turned about its own column k.
void turn_about_column(const Matrix3& from, int k, double cosine, double sine, Matrix3& R) {
  constexpr int after[] = {1, 2, 0};
  const int i = after[k];
  const int j = after[i];
  const Vector3 u = from.col(i);
  const Vector3 v = from.col(j);
  R.col(k) = from.col(k);
  R.col(i) = cosine * u + sine * v;
  R.col(j) = cosine * v - sine * u;
}

/// Turns R about an axis given in its own coordinates, by Rodrigues' formula on each column.
void turn_about_axis(const Vector3& axis_in_base, double cosine, double sine, Matrix3& R) {
  const double versine = 1.0 - cosine;
  for (int k = 0; k < 3; ++k) {
    const Vector3 normal = axis_in_base.cross(R.col(k));
    R.col(k) += sine * normal + versine * axis_in_base.cross(normal);
  }
}

/// S of a joint that turns about an axis through the body's origin. (Number by number, as it is read.)
void write_turn(const double* axis, BodySweep& sweep) {
  const double x = axis[0], y = axis[1], z = axis[2];
  const double px = sweep.p.x(), py = sweep.p.y(), pz = sweep.p.z();
  sweep.S << x, y, z, py * z - pz * y, pz * x - px * z, px * y - py * x;
}

/// The axes of a body at q = 0, in the base's.
const Matrix3& unturned_axes(const Body& body, const BodySweep& parent, BodySweep& sweep) {
  if (!sweep.turned_in_parent) return parent.R;
  sweep.R.noalias() = parent.R * body.pose_in_parent.rotation;
  return sweep.R;
}

/// R at q from R at 0, which may stand in the same place.
void turn_axes(const Matrix3& unturned, const Body& body, BodySweep& sweep) {
  if (sweep.axis_column >= 0) {
    turn_about_column(unturned, sweep.axis_column, sweep.cosine, sweep.sine, sweep.R);
    return;
  }
  const Vector3 axis = unturned * body.joint.axis;
  sweep.R = unturned;
  turn_about_axis(axis, sweep.cosine, sweep.sine, sweep.R);
}

/// Pose and joint motion of body i from its parent's, but for the axes of a round one.
void place(const Body& body, double q, const BodySweep& parent, BodySweep& sweep) {
  const Matrix3& R = unturned_axes(body, parent, sweep);
  sweep.p = parent.p;
  sweep.p.noalias() += parent.R * body.pose_in_parent.position;
  if (body.joint.type == JointType::prismatic) {
    const Vector3 axis = R * body.joint.axis;
    sweep.R = R;
    sweep.p += q * axis;
    sweep.S << Vector3::Zero(), axis;
    return;
  }
  if (sweep.axis_column >= 0) {
    write_turn(R.data() + 3 * sweep.axis_column, sweep);
  } else {
    const Vector3 axis = R * body.joint.axis;
    write_turn(axis.data(), sweep);
  }
  if (!sweep.is_round) turn_axes(R, body, sweep);
}

/// Twist and velocity products of a body from its parent's:  v = v_p + S qd,  c = c_p + v_p x S qd
/// (RBDA 2.31).
void move(double qd, const BodySweep& parent, BodySweep& sweep) {
  const Vector3 w = parent.v.head<3>();
  const Vector3 v = parent.v.tail<3>();
  const Vector3 joint_w = sweep.S.head<3>() * qd;
  const Vector3 joint_v = sweep.S.tail<3>() * qd;
  sweep.v.head<3>() = w + joint_w;
  sweep.v.tail<3>() = v + joint_v;
  sweep.c.head<3>() = parent.c.head<3>() + w.cross(joint_w);
  sweep.c.tail<3>() = parent.c.tail<3>() + w.cross(joint_v) + v.cross(joint_w);
}

/// The same all around the joint's axis e: its centre of mass is on it and J_B = across 1 + (along - across)
/// e e'.
bool is_round_about(const Vector3& e, const Vector3& com, const Matrix3& J) {
  const double along = e.dot(J * e);
  const double across = 0.5 * (J.trace() - along);
  const Matrix3 round = across * Matrix3::Identity() + (along - across) * e * e.transpose();
  return com.cross(e).norm() <= 1e-14 && (J - round).norm() <= 1e-14 * J.norm();
}

/// The inertia about the centre of mass in the base's axes: J = R J_B R'. With the principal moments x, y, z
/// about the body's own axes, the columns of R, that is  z 1 + (x - z) R_x R_x' + (y - z) R_y R_y'.
void turn_inertia(BodySweep& sweep) {
  const Matrix3& R = sweep.R;
  if (sweep.has_principal_axes) {
    const Vector3 x = R.col(0);
    const Vector3 y = R.col(1);
    const double z = sweep.inertia_in_body(2, 2);
    const Vector3 scaled_x = (sweep.inertia_in_body(0, 0) - z) * x;
    const Vector3 scaled_y = (sweep.inertia_in_body(1, 1) - z) * y;
    sweep.J.noalias() = scaled_x * x.transpose() + scaled_y * y.transpose();
    sweep.J.diagonal().array() += z;
    return;
  }
  const Matrix3 half = R * sweep.inertia_in_body;
  const double xx = half.row(0).dot(R.row(0));
  const double yx = half.row(1).dot(R.row(0));
  const double yy = half.row(1).dot(R.row(1));
  const double zx = half.row(2).dot(R.row(0));
  const double zy = half.row(2).dot(R.row(1));
  const double zz = half.row(2).dot(R.row(2));
  sweep.J << xx, yx, zx, yx, yy, zy, zx, zy, zz;
}

/// Where the mass of a body is. That of a round one stays where it is when the body turns, to the last bit.
void place_mass(BodySweep& sweep) {
  sweep.com = sweep.p;
  if (!sweep.is_round) {
    sweep.com.noalias() += sweep.R * sweep.com_in_body;
    turn_inertia(sweep);
    return;
  }
  const Vector3 e = sweep.S.head<3>();
  sweep.com += sweep.com_on_axis * e;
  sweep.J.noalias() = (sweep.inertia_along_axis - sweep.inertia_across_axis) * e * e.transpose();
  sweep.J.diagonal().array() += sweep.inertia_across_axis;
}

/// Poses and masses where the joints are now. Where round bodies alone have turned, all of them stay.
void place_bodies(const Model& model, const Eigen::VectorXd& q, Sweeps& sweeps) {
  bool moved = false;
  for (std::size_t i = 1; i < sweeps.bodies.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i) - 1;
    const bool is_placed = !std::isnan(sweeps.placed_at(j));
    moved = moved || (q(j) != sweeps.placed_at(j) && !(sweeps.bodies[i].is_round && is_placed));
    sweeps.bodies[i].axes_are_due = sweeps.bodies[i].is_round;
  }
  sweeps.placed_at = q;
  if (!moved) return;
  sweeps.is_articulated = false;
  // Ahead of the walk, where each body would wait for them: these do not wait for one another.
  for (std::size_t i = 1; i < sweeps.bodies.size(); ++i) {
    if (sweeps.bodies[i].is_round) continue;
    const double angle = q(static_cast<Eigen::Index>(i) - 1);
    sweeps.bodies[i].cosine = std::cos(angle);
    sweeps.bodies[i].sine = std::sin(angle);
  }
  for (std::size_t i = 1; i < sweeps.bodies.size(); ++i) {
    const Body& body = model.bodies()[i];
    BodySweep& sweep = sweeps.bodies[i];
    place(body, q(static_cast<Eigen::Index>(i) - 1), sweeps.bodies[static_cast<std::size_t>(body.parent)],
          sweep);
    place_mass(sweep);
  }
}

/// The rigid body's inertia about the base's origin, by the parallel axis theorem:
///   IA = [ J + m (com.com 1 - com com')   m com x ]
///        [ -m com x                        m 1     ]
void write_inertia(BodySweep& sweep) {
  const Vector3& com = sweep.com;
  const Vector3 h = sweep.mass * com;
  Matrix3 about_origin = sweep.J - h * com.transpose();
  about_origin.diagonal().array() += h.dot(com);
  sweep.IA.topLeftCorner<3, 3>() = about_origin;
  sweep.IA.topRightCorner<3, 3>() = skew(h);
  sweep.IA.bottomLeftCorner<3, 3>() = -skew(h);
  sweep.IA.bottomRightCorner<3, 3>() = sweep.mass * Matrix3::Identity();
}

/// The wrench that keeps da = 0, by Newton and Euler about the centre of mass:
///   force   m (acceleration of the centre of mass - gravity)
///   moment  J alpha + w x J w + com x force
void write_bias(const Vector3& gravity, const ForceVector& f_ext, BodySweep& sweep) {
  const Vector3& com = sweep.com;
  const Vector3 w = sweep.v.head<3>();
  const Vector3 alpha = sweep.c.head<3>();
  const Vector3 v_com = sweep.v.tail<3>() + w.cross(com);
  const Vector3 a_com = sweep.c.tail<3>() + alpha.cross(com) + w.cross(v_com);
  const Vector3 force = sweep.mass * (a_com - gravity);
  const Vector3 spin = sweep.J * w;
  const Vector3 turning = sweep.J * alpha;
  const Vector3 moment = turning + w.cross(spin) + com.cross(force);
  sweep.pA << moment.x(), moment.y(), moment.z(), force.x(), force.y(), force.z();
  if (f_ext.is_zero()) return;
  Vector6 external;
  sweep.to_base(f_ext, external);
  sweep.pA -= external;
}

/// U = IA S and D = d + S'U; false where D is not positive.
bool divide_by_inertia(double rotor_inertia, BodySweep& sweep) {
  sweep.U.noalias() = sweep.IA * sweep.S;
  const double D = rotor_inertia + sweep.S.dot(sweep.U);
  if (!(D > 0.0)) return false;
  sweep.D_inverse = 1.0 / D;
  sweep.UD = sweep.U * sweep.D_inverse;
  sweep.root_D = std::sqrt(D);
  sweep.root_D_inverse = sweep.root_D * sweep.D_inverse;  // neither waits for the other
  return true;
}

/// F with inertia^-1 = F'F, the inverse of the Cholesky factor G over the freedoms in `order`; line k of it
/// is line (k + shift) % 6 of F. False when the inertia is not positive definite.
bool invert_factor(const Matrix6& inertia, const int (&order)[6], int shift, Matrix6& F) {
  double G[6][6];  // 1 / G_kk on the diagonal
  for (int k = 0; k < 6; ++k) {
    double pivot = inertia(order[k], order[k]);
    for (int c = 0; c < k; ++c) {
      double rest = inertia(order[k], order[c]);
      for (int l = 0; l < c; ++l) rest -= G[k][l] * G[c][l];
      G[k][c] = rest * G[c][c];
      pivot -= G[k][c] * G[k][c];
    }
    if (!(pivot > 1e-14 * inertia(order[k], order[k]))) return false;
    G[k][k] = std::sqrt(pivot) * (1.0 / pivot);  // neither waits for the other
  }
  F.setZero();
  for (int c = 0; c < 6; ++c) {
    double inverse[6];
    inverse[c] = G[c][c];
    for (int i = c + 1; i < 6; ++i) {
      double rest = 0.0;
      for (int l = c; l < i; ++l) rest += G[i][l] * inverse[l];
      inverse[i] = -rest * G[i][i];
    }
    for (int i = c; i < 6; ++i) F((i + shift) % 6, order[c]) = inverse[i];
  }
  return true;
}

constexpr int all_freedoms[6] = {0, 1, 2, 3, 4, 5};
constexpr int planar_first[6] = {2, 3, 4, 5, 0, 1};  // rz, x, y; z, rx, ry

}  // namespace

Sweeps::Sweeps(const Model& model, int robot_row_capacity, int task_row_capacity)
    : bodies(static_cast<std::size_t>(model.body_count())),
      robot_rows(model, robot_row_capacity),
      task_rows(model, task_row_capacity),
      free_motion(Eigen::VectorXd::Zero(task_rows.dimensions())),
      placed_at(Eigen::VectorXd::Constant(model.joint_count(), std::numeric_limits<double>::quiet_NaN())) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = model.bodies()[i];
    BodySweep& sweep = bodies[i];
    sweep.mass = body.inertia.mass;
    sweep.com_in_body.setZero();
    if (sweep.mass > 0.0) sweep.com_in_body = body.inertia.first_moment / sweep.mass;
    const Matrix3 com = skew(sweep.com_in_body);
    sweep.inertia_in_body = body.inertia.rotational + sweep.mass * com * com;
    sweep.has_principal_axes = sweep.inertia_in_body.isDiagonal(1e-14);
    sweep.turned_in_parent = body.pose_in_parent.rotation != Matrix3::Identity();
    for (int k = 0; k < 3; ++k) {
      if (body.joint.axis == Vector3::Unit(k)) sweep.axis_column = k;
    }
    const Vector3& e = body.joint.axis;
    sweep.com_on_axis = e.dot(sweep.com_in_body);
    sweep.inertia_along_axis = e.dot(sweep.inertia_in_body * e);
    sweep.inertia_across_axis = 0.5 * (sweep.inertia_in_body.trace() - sweep.inertia_along_axis);
    sweep.is_round = i > 0 && body.joint.type != JointType::prismatic &&
                     is_round_about(e, sweep.com_in_body, sweep.inertia_in_body);
    if (i > 0) bodies[static_cast<std::size_t>(body.parent)].is_round = false;
  }
  BodySweep& base = bodies.front();
  base.R.setIdentity();
  base.p.setZero();
  base.com = base.com_in_body;
  base.J = base.inertia_in_body;
}

void outward_kinematics(const Model& model, const State& state, const Vector6& base_acceleration,
                        Sweeps& sweeps) noexcept {
  BodySweep& base = sweeps.bodies.front();
  base.v.setZero();
  base.c.setZero();
  if (model.has_fixed_base()) {
    base.c = base_acceleration;
  } else {
    base.v = state.base_twist.vector();
  }
  if (sweeps.placed_at != state.q) place_bodies(model, state.q, sweeps);
  for (std::size_t i = 1; i < sweeps.bodies.size(); ++i) {
    const auto parent = static_cast<std::size_t>(model.bodies()[i].parent);
    move(state.qd(static_cast<Eigen::Index>(i) - 1), sweeps.bodies[parent], sweeps.bodies[i]);
  }
}

void find_axes_of_round_body(const Model& model, std::size_t i, Sweeps& sweeps) noexcept {
  const Body& body = model.bodies()[i];
  BodySweep& sweep = sweeps.bodies[i];
  const double angle = sweeps.placed_at(static_cast<Eigen::Index>(i) - 1);
  sweep.cosine = std::cos(angle);
  sweep.sine = std::sin(angle);
  turn_axes(unturned_axes(body, sweeps.bodies[static_cast<std::size_t>(body.parent)], sweep), body, sweep);
  sweep.axes_are_due = false;
}

void load_bodies(const Model& model, const State& state, const Vector3& gravity, Sweeps& sweeps) noexcept {
  for (std::size_t i = model.has_fixed_base() ? 1 : 0; i < sweeps.bodies.size(); ++i) {
    if (!sweeps.is_articulated) write_inertia(sweeps.bodies[i]);
    if (!state.f_ext[i].is_zero()) need_axes(model, i, sweeps);
    write_bias(gravity, state.f_ext[i], sweeps.bodies[i]);
  }
}

void load_bodies_at_rest(Sweeps& sweeps) noexcept {
  for (BodySweep& sweep : sweeps.bodies) {
    if (!sweeps.is_articulated) write_inertia(sweep);
    sweep.pA.setZero();
    sweep.v.setZero();
    sweep.c.setZero();
  }
}

bool sweep_inward(const Model& model, const Eigen::VectorXd& tau, Sweeps& sweeps) noexcept {
  const bool base_moves = !model.has_fixed_base();
  const bool robot_stays = sweeps.is_articulated;
  sweeps.is_articulated = false;
  if (!robot_stays) sweeps.robot_rows.start_sweep();
  sweeps.task_rows.start_sweep();
  for (std::size_t i = sweeps.bodies.size() - 1; i > 0; --i) {
    const Body& body = model.bodies()[i];
    BodySweep& sweep = sweeps.bodies[i];
    BodySweep& parent = sweeps.bodies[static_cast<std::size_t>(body.parent)];
    const bool goes_on = base_moves || body.parent > 0;

    if (!robot_stays && !divide_by_inertia(body.joint.rotor_inertia, sweep)) return false;
    const double u = tau(static_cast<Eigen::Index>(i) - 1) - sweep.S.dot(sweep.pA);
    sweeps.free_motion(sweeps.task_rows.dimension_of(i)) = sweep.root_D_inverse * u;
    if (goes_on) {
      if (!robot_stays) {
        for (int k = 0; k < 6; ++k) parent.IA.col(k) += sweep.IA.col(k) - sweep.UD * sweep.U(k);
      }
      parent.pA += sweep.pA + sweep.UD * u;
    }
    if (!robot_stays) sweeps.robot_rows.carry(i, sweep, goes_on);
    sweeps.task_rows.carry(i, sweep, goes_on);
  }
  if (base_moves) {
    const BodySweep& base = sweeps.bodies.front();
    const int held = sweeps.task_rows.held_dimensions();
    const auto& order = held > 0 ? planar_first : all_freedoms;
    Matrix6& F = sweeps.base_inverse_factor;
    if (!robot_stays && !invert_factor(base.IA, order, held, F)) return false;
    // The dimensions that the ground holds do not follow pA.
    sweeps.free_motion.head<6>() = -(F * base.pA);
    sweeps.free_motion.head(held).setZero();
    if (!robot_stays) sweeps.robot_rows.finish(F);
    sweeps.task_rows.finish(F);
  }
  sweeps.is_articulated = true;
  return true;
}

void outward_accelerations(const Model& model, const Eigen::VectorXd& motion, Sweeps& sweeps,
                           Eigen::VectorXd& qdd) noexcept {
  BodySweep& base = sweeps.bodies.front();
  base.da.setZero();
  // IA_0 da_0 = A_0 nu - pA_0
  if (!model.has_fixed_base()) base.da.noalias() = sweeps.base_inverse_factor.transpose() * motion.head<6>();
  base.a = base.c + base.da;
  const std::size_t count = sweeps.bodies.size();
  Vector6 da = base.da;  // of the body before
  for (std::size_t i = 1; i < count; ++i) {
    BodySweep& sweep = sweeps.bodies[i];
    const auto parent = static_cast<std::size_t>(model.bodies()[i].parent);
    if (parent + 1 != i) da = sweeps.bodies[parent].da;
    // D^-1 (u - U'da_p + (S'A) nu)
    const double acceleration =
        sweep.root_D_inverse * motion(sweeps.task_rows.dimension_of(i)) - sweep.UD.dot(da);
    qdd(static_cast<Eigen::Index>(i) - 1) = acceleration;
    da += sweep.S * acceleration;
    sweep.da = da;
    sweep.a = sweep.c + da;
  }
}

/// F_hh' z = a_h, with F_hh a lower triangle over z, rx, ry.
Vector3 held_base_force(const Sweeps& sweeps, const Vector6& a) noexcept {
  const Matrix6& F = sweeps.base_inverse_factor;
  Vector3 force = Vector3::Zero();
  for (int k = sweeps.task_rows.held_dimensions() - 1; k >= 0; --k) {
    const int freedom = planar_first[3 + k];
    double rest = a(freedom);
    for (int l = k + 1; l < 3; ++l) rest -= F(l, freedom) * force(l);
    force(k) = rest / F(k, freedom);
  }
  return force;
}

}  // namespace zwang::solver
