/// The recursions of Algorithm 1 (Popov, Vereshchagin 1974; Shakhimardanov 2015) on a tree, with
/// Featherstone's letters:
///
///   1 outward  kinematics     S v c
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
/// and nu = 0, and L the acceleration along the rows for unit multipliers (the Delassus matrix). With a = a_p
/// + c + S qdd the minimum over qdd is at
///
///   qdd = D^-1 (u - U'(a_p + c) + (S'A) nu),   U = IA S, D = d + S'U, u = tau - S' pA
///
/// and substituting it gives the coefficients of the parent:
///
///   IA_p += IA - U D^-1 U'                     lines 11 to 14
///   pA_p += pA + Ia c + U D^-1 u               lines 15, 16
///   A_p  += A - U D^-1 S'A                     line 17
///   g_p  += g + A' c + (S'A)' D^-1 (u - U'c)   line 18
///   L_p  += L + (S'A)' D^-1 (S'A)              line 19, with our sign
///
/// A branch carries the rows of its own links only. A row on a joint's own axis has A = 0 and S'A = 1 there.
/// At a floating base L = L_0 + A_0' IA_0^-1 A_0 and g = g_0 - A_0' IA_0^-1 pA_0. Gravity acts as a force
/// inside pA, so all accelerations are true ones.
///
/// Coordinates: everything is written in the axes of the base and at its origin, in the inertial frame that
/// coincides with the base at this instant. So nothing is transformed from link to link (the X of the
/// textbook form are 1), a column of A is updated where it stands, and nothing depends on how far the robot
/// is from the origin of the world.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct BodySweep {
  Matrix6 IA;  ///< articulated inertia
  Vector6 pA;  ///< articulated bias force
  Vector6 S;   ///< motion of the joint
  Vector6 U;
  Vector6 v;  ///< twist
  Vector6 c;  ///< v x S qd
  Vector6 a;  ///< spatial acceleration
  Matrix3 R;  ///< axes of the body in the base's
  Vector3 p;  ///< [m] origin of the body from the base's
  double D = 0.0;
  double u = 0.0;
  int axis_column = -1;  ///< the body's own axis that the joint turns about or slides along; -1: some other
  bool turned_in_parent = false;  ///< at q = 0
  std::vector<int> columns;       ///< of A, of the rows at this body and beyond
  std::vector<double> SA;         ///< S'A of those columns

  /// A wrench in the body's coordinates, written in the base's.
  Vector6 to_base(const ForceVector& f) const {
    const Vector3 force = R * f.linear;
    Vector6 result;
    result << R * f.angular + p.cross(force), force;
    return result;
  }
  /// A motion in the base's coordinates, written in the body's.
  MotionVector from_base(const Vector6& m) const {
    const Vector3 angular = m.head<3>();
    const Vector3 linear = m.tail<3>();
    return {R.transpose() * angular, R.transpose() * (linear + angular.cross(p))};
  }
};

/// Everything the sweeps write. Sized once.
struct Sweeps {
  Sweeps(const Model& model, int row_capacity);

  std::vector<BodySweep> bodies;
  int rows = 0;
  RowMajorMatrix L;  ///< lower triangle, rows x rows
  Eigen::VectorXd g;

  void clear_rows() noexcept;
  /// Adds a row that acts on the body with the constraint force `a` (base coordinates); returns its id.
  int add_row(int body, const Vector6& a) noexcept;
  /// The row added last also acts on a second body.
  void extend_last_row(int body, const Vector6& a) noexcept;
  /// Adds the row of a joint's own acceleration.
  int add_joint_row(int joint) noexcept;

  /// A row that joins two bodies has two columns; `L` and `g` of columns are folded into those of rows at the
  /// end.
  struct ColumnOrigin {
    int row = 0;
    int joint_body = -1;  ///< of a joint row: the body where S'A = 1
  };
  int columns = 0;
  std::vector<ColumnOrigin> origins;
  Eigen::Matrix<double, 6, Eigen::Dynamic> A;
  Matrix6 base_inverse_factor;  ///< inverse of IA_0's Cholesky factor

 private:
  friend bool inward_inertia(const Model&, const Eigen::VectorXd&, const Vector6&, Sweeps&) noexcept;
  int add_column(int body, const Vector6& a, ColumnOrigin origin) noexcept;
  void fold_columns() noexcept;
  std::vector<int> parents_;
};

/// Phase 1. `moving`: with the velocities, external wrenches and gravity of the state; else the robot rests
/// in free space and answers to multipliers only.
void outward_kinematics(const Model& model, const State& state, bool moving, const Vector3& gravity,
                        Sweeps& sweeps) noexcept;
/// Phase 2, with the base's inertia factorised at the end. `base_acceleration` counts on a fixed base only.
/// False where an inertia cannot be inverted.
bool inward_inertia(const Model& model, const Eigen::VectorXd& tau, const Vector6& base_acceleration,
                    Sweeps& sweeps) noexcept;
/// Phase 4. `nu` by row id; writes `a` of every body and qdd.
void outward_accelerations(const Model& model, const Eigen::VectorXd& nu, const Vector6& base_acceleration,
                           Sweeps& sweeps, Eigen::VectorXd& qdd) noexcept;

}  // namespace zwang::solver
