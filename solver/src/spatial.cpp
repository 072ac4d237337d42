#include "zwang/solver/spatial.hpp"

namespace zwang::solver {

Matrix3 rotation_from_rpy(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
          Eigen::AngleAxisd(roll, Vector3::UnitX()))
      .toRotationMatrix();
}

// Rodrigues' formula with v = from x to and c = from . to:  R = I + [v] + [v]^2 / (1 + c).
// It divides by 0 where the two are opposite. There half a turn about a perpendicular comes first.
Matrix3 rotation_between(const Vector3& from, const Vector3& to) {
  constexpr double nearly_opposite = 1e-3;  // of 1 + c: 2.6 deg, and 13 digits of R are left
  const double c = from.dot(to);
  if (1.0 + c < nearly_opposite) {
    const Vector3 across = from.unitOrthogonal();
    const Matrix3 half_turn = 2.0 * across * across.transpose() - Matrix3::Identity();
    return rotation_between(-from, to) * half_turn;
  }
  const Matrix3 v = skew(Vector3(from.cross(to)));
  return Matrix3::Identity() + v + v * v / (1.0 + c);
}

}  // namespace zwang::solver
