#include "robot/possible_inertia.hpp"

#include <Eigen/Eigenvalues>

namespace zwang::lang {

double beside_axis(const solver::RigidInertia& inertia, const solver::Vector3& axis) {
  if (!(inertia.mass > 0.0)) return 0.0;
  const solver::Vector3 com = inertia.first_moment / inertia.mass;
  return (com - axis.dot(com) * axis).norm();
}

// The moments are a <= b < c, and a + b < c. The least change (da, db, dc) with a + da + b + db = c + dc is t
// (1, 1, -1), t = (c - a - b) / 3.
std::optional<CorrectedInertia> corrected(const solver::RigidInertia& inertia) {
  if (!(inertia.mass > 0.0)) return std::nullopt;
  const solver::Vector3 com = inertia.first_moment / inertia.mass;
  const Eigen::SelfAdjointEigenSolver<solver::Matrix3> at_com(inertia.rotational_at_com());
  const solver::Vector3& moments = at_com.eigenvalues();
  constexpr double rounding = 1e-6;  // of the largest moment
  const double lacks = moments(2) - moments(0) - moments(1);
  const double move = (lacks + rounding * moments(2)) / 3.0;
  if (!(moments(0) > 0.0) || lacks <= rounding * moments(2) || move > most_inertia_correction * moments(2))
    return std::nullopt;
  const solver::Vector3 possible = moments + move * solver::Vector3(1.0, 1.0, -1.0);
  const solver::Matrix3 axes = at_com.eigenvectors();
  return CorrectedInertia{
      solver::RigidInertia::from_com(inertia.mass, com, axes * possible.asDiagonal() * axes.transpose()),
      move / moments(2)};
}

}  // namespace zwang::lang
