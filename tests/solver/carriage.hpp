/// A carriage of 10 kg on a rail along x, and rows along it: every answer is a line of arithmetic.
#pragma once

#include "zwang/solver/constraint.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::solver::test {

inline constexpr double carriage_mass = 10.0;  ///< [kg]

inline Model carriage(double max_effort = infinity) {
  const auto body = [](double mass) {
    return RigidInertia::from_com(mass, Vector3::Zero(), Matrix3::Identity());
  };
  ModelBuilder builder(BaseType::fixed, "rail", body(1.0));
  Joint joint;
  joint.name = "slide";
  joint.type = JointType::prismatic;
  joint.actuated = true;
  joint.max_effort = max_effort;
  builder.add_link("carriage", "rail", {}, joint, body(carriage_mass));
  return builder.build();
}

/// `value` is b, or f of a force row.
inline Row along_rail(RowKind kind, double value, double bound, int level = 1) {
  Row row;
  row.kind = kind;
  row.body = 1;
  row.a.linear = Vector3::UnitX();
  (kind == RowKind::force ? row.force : row.b) = value;
  row.lo = kind == RowKind::lower ? 0.0 : -bound;
  row.hi = kind == RowKind::upper ? 0.0 : bound;
  row.level = level;
  return row;
}

}  // namespace zwang::solver::test
