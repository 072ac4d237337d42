/// The recursions of Algorithm 1 (Popov, Vereshchagin 1974; Shakhimardanov 2015) on a tree, with
/// Featherstone's letters:
///
///   1 outward  kinematics     X v c
///   2 inward   inertia        IA pA  and  A L g
///   4 outward  accelerations  a qdd
///
/// (Phase 3, at the base, finds the multipliers: see bounded_problem.hpp.)
///
/// Bellman's step. Gauss's function of the links beyond joint i, minimised over their joint accelerations for
/// given multipliers nu, is quadratic in the acceleration a of link i:
///
///   Z_i(a, nu) = 1/2 a' IA a + pA' a - (A nu)' a - 1/2 nu' L nu - (g - b)' nu
///
/// so `A nu` is the wrench that the constraints put on the link, g the acceleration along the rows when a = 0
/// and nu = 0, and L the acceleration along the rows for unit multipliers (the Delassus matrix). With a = X
/// a_p + c + S qdd the minimum over qdd is at
///
///   qdd = D^-1 (u - U'(X a_p + c) + (S'A) nu),   U = IA S, D = d + S'U, u = tau - S' pA
///
/// and substituting it gives the coefficients of the parent:
///
///   IA_p += X' (IA - U D^-1 U') X                 lines 11 to 14
///   pA_p += X' (pA + Ia c + U D^-1 u)             lines 15, 16
///   A_p  += X' (A - U D^-1 S'A)                   line 17
///   g_p  += g + A' c + (S'A)' D^-1 (u - U'c)      line 18
///   L_p  += L + (S'A)' D^-1 (S'A)                 line 19, with our sign
///
/// Branches stack their columns; a branch carries the rows of its own links only. A row on a joint's own axis
/// has A = 0 and S'A = 1 there. At a floating base L = L_0 + A_0' IA_0^-1 A_0 and g = g_0 - A_0' IA_0^-1
/// pA_0. Gravity acts as a force inside pA, so all accelerations are true ones.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

/// A column of a body's A: the row `id` acts on this body or on one beyond it.
struct Column {
  int id = 0;
  bool shared = false;    ///< the row joins two bodies, so two branches may carry it
  bool on_joint = false;  ///< the row is the own joint's acceleration
  ForceVector A;
  double SA = 0.0;  ///< S'A
};

struct BodySweep {
  PluckerTransform X;  ///< from the parent's coordinates to the body's
  MotionVector S;
  MotionVector v;  ///< twist
  MotionVector c;  ///< v x S qd
  Matrix6 IA;      ///< articulated inertia
  ForceVector pA;  ///< articulated bias force
  ForceVector U;
  double D = 0.0;
  double u = 0.0;
  std::vector<Column> columns;
};

/// Everything the sweeps write. Sized once.
struct Sweeps {
  Sweeps(const Model& model, int row_capacity);

  std::vector<BodySweep> bodies;
  Eigen::LLT<Matrix6> base_inertia;
  int rows = 0;
  Eigen::MatrixXd L;  ///< lower triangle, rows x rows
  Eigen::VectorXd g;

  /// Forgets all rows.
  void clear_rows() noexcept;
  /// Adds a row that acts on the body with the constraint force `a` (body coordinates); returns its id.
  int add_row(int body, const ForceVector& a) noexcept;
  /// The same row also acts on a second body.
  void extend_row(int id, int body, const ForceVector& a) noexcept;
  /// Adds the row of a joint's own acceleration.
  int add_joint_row(int joint) noexcept;
};

/// Phase 1. Without `moving`, velocities and gravity count as zero: what is left answers to multipliers only.
void outward_kinematics(const Model& model, const State& state, bool moving, Sweeps& sweeps) noexcept;
/// Phase 2, with the base's inertia solved at the end. False where an inertia cannot be inverted.
bool inward_inertia(const Model& model, const Eigen::VectorXd& tau, Sweeps& sweeps) noexcept;
/// Phase 4. `nu` by row id.
void outward_accelerations(const Model& model, const Sweeps& sweeps, const Eigen::VectorXd& nu,
                           std::vector<MotionVector>& acceleration, Eigen::VectorXd& qdd) noexcept;

}  // namespace zwang::solver
