/// Rigid-body dynamics the slow and obvious way, as the oracle of the sweeps: points, angular velocities and
/// Jacobians in world coordinates, one dense mass matrix. It shares no formula with the solver.
///
/// Generalised velocities: the base's twist in base coordinates (angular, linear; absent on a fixed base),
/// then the joints. The derivative of the former is the base's spatial acceleration in base coordinates.
#pragma once

#include <vector>

#include "oracle/real.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::oracle {

/// A body's motion in world coordinates; accelerations are classical, of the body's origin.
struct BodyMotion {
  Mat3 rotation;
  Vec3 origin;              ///< [m]
  Vec3 angular;             ///< [rad/s]
  Vec3 linear;              ///< [m/s]
  Matrix angular_jacobian;  ///< 3 x n
  Matrix linear_jacobian;   ///< 3 x n
  Vec3 angular_bias;        ///< angular acceleration at zero generalised acceleration
  Vec3 linear_bias;         ///< acceleration of the origin at zero generalised acceleration
};

/// Linear equations on the generalised acceleration: jacobian * vdot = rhs.
struct LinearRows {
  Matrix jacobian;
  Vector rhs;
};

struct DenseDynamics {
  DenseDynamics(const solver::Model& model, const solver::State& state);
  /// With other generalised velocities than the state's.
  DenseDynamics(const solver::Model& model, const solver::State& state, const Vector& velocity);

  int freedoms() const { return static_cast<int>(velocity.size()); }
  int base_freedoms() const { return freedoms() - joints; }
  Real kinetic_energy() const { return velocity.dot(M * velocity) / 2; }  ///< rotors included
  Real potential_energy() const { return potential; }
  /// (a . A_body - a_reference . A_reference) = jacobian * vdot + bias; `rhs` is b - bias.
  LinearRows rows(const std::vector<solver::Row>& rows) const;
  /// Spatial acceleration of a body in its own coordinates, angular first.
  Vector spatial_acceleration(int body, const Vector& vdot) const;
  /// The rows of the ground: base z, rx, ry, then what each wheel holds; rhs is minus the velocity products.
  LinearRows ground() const;

  const solver::Model* model;
  int joints = 0;
  Vector velocity;
  std::vector<BodyMotion> bodies;
  Matrix M;
  Vector h;            ///< M vdot + h = generalised force; Coriolis, gravity, external wrenches
  Real potential = 0;  ///< [J], of gravity

 private:
  void move(const solver::State& state);
  void collect(const solver::State& state);
};

Vector generalised_velocity(const solver::Model& model, const solver::State& state);

}  // namespace zwang::oracle
