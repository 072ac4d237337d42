/// The recursions of Algorithm 1 (Popov, Vereshchagin 1974; Shakhimardanov 2015) on a tree, with
/// Featherstone's letters:
///
///   1 outward  kinematics     S v c
///   2 inward   inertia        IA pA  and  A L h
///   4 outward  accelerations  a qdd
///
/// (Phase 3, at the base, finds the multipliers: see bounded_problem.hpp.)
///
/// A body's acceleration has two parts, a = c + da. Velocities alone give c = c_p + v_p x S qd, which needs
/// no sweep inward. The joints and the base add da = da_p + S qdd. The equations below are about da.
///
/// Bellman's step. Gauss's function of the links beyond joint i, minimised over their joint accelerations for
/// given multipliers nu, is quadratic in the part da of link i:
///
///   Z_i(da, nu) = 1/2 da' IA da + pA' da - (A nu)' da - 1/2 nu' L nu - (g - b)' nu
///
/// so `A nu` is the wrench that the constraints put on the link. g is the acceleration along the rows when
/// da = 0 and nu = 0, and L the acceleration along the rows for unit multipliers (the Delassus matrix). The
/// recursion starts from the rigid body: IA = I, pA = I c + v x* I v - f_ext - weight, g = A'c, L = 0. With
/// da = da_p + S qdd the minimum over qdd is at
///
///   qdd = D^-1 (u - U'da_p + (S'A) nu),   U = IA S, D = d + S'U, u = tau - S' pA
///
/// and substituting it gives the coefficients of the parent:
///
///   IA_p += IA - U D^-1 U'               lines 11 to 14
///   pA_p += pA + U D^-1 u                lines 15, 16
///   A_p  += A - U D^-1 S'A               line 17
///   g_p  += g + (S'A)' D^-1 u            line 18
///   L_p  += L + (S'A)' D^-1 (S'A)        line 19, with our sign
///
/// A branch carries the rows of its own links only. A row on a joint's own axis has A = 0 and S'A = 1 there.
/// At a floating base L = L_0 + A_0' IA_0^-1 A_0 and g = g_0 - A_0' IA_0^-1 pA_0; on the ground the base
/// moves in rz, x and y only. L is kept as its factor W, L = W W', and g = A'c + W h (columns.hpp). Gravity
/// acts as a force inside pA, so all accelerations are true ones.
///
/// Coordinates: all quantities are written in the axes of the base and at its origin. Their frame is the
/// inertial one that coincides with the base at this instant. So no quantity is transformed from link to link
/// (the X of the textbook form are 1), and a column of A is updated in place. No number depends on the
/// distance of the robot from the origin of the world.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sweep/columns.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

struct BodySweep {
  // The constants of the model.
  double mass = 0.0;
  Vector3 com_in_body;
  Matrix3 inertia_in_body;          ///< about the centre of mass
  bool has_principal_axes = false;  ///< inertia_in_body is diagonal
  int axis_column = -1;  ///< the body's own axis that the joint turns about or slides along; -1: some other
  bool turned_in_parent = false;  ///< at q = 0
  /// A body that carries no other and is the same all around its joint's axis, as wheels are: its turning
  /// moves no mass.
  bool is_round = false;
  double com_on_axis = 0.0;          ///< [m] from the body's origin
  double inertia_along_axis = 0.0;   ///< [kg m^2] about the centre of mass
  double inertia_across_axis = 0.0;  ///< [kg m^2] of a round body

  // Kinematics.
  double cosine = 1.0;  ///< of the joint's angle
  double sine = 0.0;
  bool axes_are_due = false;  ///< of a round body whose joint has turned
  Matrix3 R;                  ///< axes of the body in the base's; of a round one where they are needed
  Vector3 p;                  ///< [m] origin of the body from the base's
  Vector3 com;                ///< [m] centre of mass from the base's origin
  Matrix3 J;                  ///< [kg m^2] inertia about the centre of mass
  Vector6 S;                  ///< motion of the joint
  Vector6 v;                  ///< twist
  Vector6
      c;  ///< acceleration while no joint accelerates: velocity products, and the base's where it is given

  // Dynamics.
  Matrix6 IA;  ///< articulated inertia
  Vector6 pA;  ///< articulated bias force
  Vector6 U;
  Vector6 UD;  ///< U D^-1
  double D_inverse = 0.0;
  double root_D = 0.0;
  double root_D_inverse = 0.0;
  Vector6 da;  ///< what joints and base add to c
  Vector6 a;   ///< spatial acceleration: c + da

  /// A wrench in the body's coordinates, written in the base's. (`need_axes` before, here and below.)
  template <class Result>
  void to_base(const ForceVector& f, Result&& result) const {
    const Vector3 force = R * f.linear;
    result.template tail<3>() = force;
    result.template head<3>() = R * f.angular + p.cross(force);
  }
  /// A motion in the base's coordinates, written in the body's. (To where it belongs: a copy would wait for
  /// it.)
  void from_base(const Vector6& m, MotionVector& result) const {
    const Vector3 angular = m.head<3>();
    const Vector3 linear = m.tail<3>() + angular.cross(p);
    result.angular.noalias() = R.transpose() * angular;
    result.linear.noalias() = R.transpose() * linear;
  }
};

/// Everything the sweeps write. Sized once.
struct Sweeps {
  Sweeps(const Model& model, int robot_rows, int task_rows);

  std::vector<BodySweep> bodies;
  Columns robot_rows;  ///< of the ground, then those of the base's freedoms and the joints
  Columns task_rows;
  Eigen::VectorXd free_motion;  ///< h: the acceleration by dimension that no constraint changes
  /// The joints' positions for which the position-dependent quantities are kept, as from project_velocity to
  /// solve. They are the poses (except axes that are due). When is_articulated, they are also the articulated
  /// inertias and W of the robot_rows. These stay while only round bodies turn, as all along the run of a
  /// base on plain wheels.
  Eigen::VectorXd placed_at;
  bool is_articulated = false;
  /// F, the inverse of a Cholesky factor: IA_0^-1 = F'F. Its lines are the base's dimensions. Under wheels z,
  /// rx and ry come last in the factor, so that the lines of the free dimensions are 0 there.
  Matrix6 base_inverse_factor;
};

/// Phase 1: where the bodies are and how they move. `base_acceleration` counts on a fixed base only.
void outward_kinematics(const Model& model, const State& state, const Vector6& base_acceleration,
                        Sweeps& sweeps) noexcept;
/// R of a round body where its joint is now. Nothing of the sweeps depends on it: it is for wrenches and
/// motions in the body's own coordinates, which few ask for.
void find_axes_of_round_body(const Model& model, std::size_t body, Sweeps& sweeps) noexcept;
inline void need_axes(const Model& model, std::size_t body, Sweeps& sweeps) noexcept {
  if (sweeps.bodies[body].axes_are_due) find_axes_of_round_body(model, body, sweeps);
}
/// Puts the moving bodies' inertias into IA, and into pA what their motion, gravity and the world do to them.
void load_bodies(const Model& model, const State& state, const Vector3& gravity, Sweeps& sweeps) noexcept;
/// The same for a robot that rests in free space where it is, and answers to multipliers only.
void load_bodies_at_rest(Sweeps& sweeps) noexcept;
/// Phase 2: bodies, task_rows and, where the joints have moved, robot_rows; the base's inertia factorised at
/// the end. Body by body and not kind by kind: rows give the processor something to do while the next body
/// waits for a division. False where an inertia cannot be inverted.
bool sweep_inward(const Model& model, const Eigen::VectorXd& tau, Sweeps& sweeps) noexcept;
/// Phase 4. `motion` = h + W'nu, by dimension; writes `a` of every body and qdd.
void outward_accelerations(const Model& model, const Eigen::VectorXd& motion, Sweeps& sweeps,
                           Eigen::VectorXd& qdd) noexcept;

/// The constraint forces along the dimensions of the base that the ground holds: z, rx and ry. They bring its
/// acceleration there to that of `a` when nothing else acts.
Vector3 held_base_force(const Sweeps& sweeps, const Vector6& a) noexcept;

}  // namespace zwang::solver
