/// Spatial algebra in Featherstone's form ("Rigid Body Dynamics Algorithms", 2008): the angular part comes
/// first.
///
/// Motion and force vectors are different types; the only number made from the two is their dot product, a
/// power.
///
/// The types are templates over their number, of which zwang uses double alone. Nearly every file sees this
/// header, and few use its algebra: of a template, a compiler works out those members only that a file uses.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "zwang/export.hpp"

namespace zwang::solver {

using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

template <typename Real>
using Vector3Of = Eigen::Matrix<Real, 3, 1>;
template <typename Real>
using Vector6Of = Eigen::Matrix<Real, 6, 1>;
template <typename Real>
using Matrix3Of = Eigen::Matrix<Real, 3, 3>;
template <typename Real>
using Matrix6Of = Eigen::Matrix<Real, 6, 6>;

/// The matrix of the cross product: skew(a) b = a x b.
template <typename Real>
inline Matrix3Of<Real> skew(const Vector3Of<Real>& a) {
  Matrix3Of<Real> m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}
template <typename Expression>
inline auto skew(const Eigen::MatrixBase<Expression>& a) {
  return skew(Vector3Of<typename Expression::Scalar>(a));
}

/// A pose X_AB: the frame B seen from the frame A. A point's coordinates map as p_A = rotation * p_B +
/// position.
template <typename Real>
struct BasicPose {
  Matrix3Of<Real> rotation = Matrix3Of<Real>::Identity();  ///< R_AB, columns are the axes of B in A
  Vector3Of<Real> position = Vector3Of<Real>::Zero();      ///< [m] origin of B in A

  BasicPose<Real> operator*(const BasicPose<Real>& other) const {
    return {rotation * other.rotation, rotation * other.position + position};
  }
  Vector3Of<Real> operator*(const Vector3Of<Real>& point) const { return rotation * point + position; }
  BasicPose<Real> inverse() const { return {rotation.transpose(), -(rotation.transpose() * position)}; }
};

/// Yaw of a rotation, about the fixed z. [rad]
inline double yaw_of(const Matrix3& rotation) {
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

/// Rotation by roll, pitch, yaw about the fixed axes x, y, z, as in URDF: Rz(yaw) Ry(pitch) Rx(roll). [rad]
ZWANG_EXPORT Matrix3 rotation_from_rpy(double roll, double pitch, double yaw);

/// A rotation that takes the unit vector `from` to the unit vector `to`: the smallest one, unless the two are
/// opposite to within 2.6 deg.
ZWANG_EXPORT Matrix3 rotation_between(const Vector3& from, const Vector3& to);

/// A twist or a spatial acceleration, in the coordinates of a frame and at its origin.
template <typename Real>
struct BasicMotionVector {
  Vector3Of<Real> angular = Vector3Of<Real>::Zero();  ///< [rad/s] or [rad/s^2]
  Vector3Of<Real> linear = Vector3Of<Real>::Zero();   ///< [m/s] or [m/s^2], of the point at the origin

  BasicMotionVector<Real> operator+(const BasicMotionVector<Real>& o) const {
    return {angular + o.angular, linear + o.linear};
  }
  BasicMotionVector<Real> operator-(const BasicMotionVector<Real>& o) const {
    return {angular - o.angular, linear - o.linear};
  }
  BasicMotionVector<Real> operator*(Real s) const { return {angular * s, linear * s}; }
  BasicMotionVector<Real>& operator+=(const BasicMotionVector<Real>& o) {
    angular += o.angular;
    linear += o.linear;
    return *this;
  }
  Vector6Of<Real> vector() const { return (Vector6Of<Real>() << angular, linear).finished(); }
};

/// A wrench, in the coordinates of a frame and about its origin.
template <typename Real>
struct BasicForceVector {
  Vector3Of<Real> angular = Vector3Of<Real>::Zero();  ///< [N m] moment about the origin
  Vector3Of<Real> linear = Vector3Of<Real>::Zero();   ///< [N] force

  BasicForceVector<Real> operator+(const BasicForceVector<Real>& o) const {
    return {angular + o.angular, linear + o.linear};
  }
  BasicForceVector<Real> operator-(const BasicForceVector<Real>& o) const {
    return {angular - o.angular, linear - o.linear};
  }
  BasicForceVector<Real> operator-() const { return {-angular, -linear}; }
  BasicForceVector<Real> operator*(Real s) const { return {angular * s, linear * s}; }
  BasicForceVector<Real>& operator+=(const BasicForceVector<Real>& o) {
    angular += o.angular;
    linear += o.linear;
    return *this;
  }
  BasicForceVector<Real>& operator-=(const BasicForceVector<Real>& o) {
    angular -= o.angular;
    linear -= o.linear;
    return *this;
  }
  Vector6Of<Real> vector() const { return (Vector6Of<Real>() << angular, linear).finished(); }
  bool is_zero() const { return angular == Vector3Of<Real>::Zero() && linear == Vector3Of<Real>::Zero(); }
};

/// Power of a force along a motion. [W]
template <typename Real>
inline Real dot(const BasicForceVector<Real>& f, const BasicMotionVector<Real>& v) {
  return f.angular.dot(v.angular) + f.linear.dot(v.linear);
}
template <typename Real>
inline Real dot(const BasicMotionVector<Real>& v, const BasicForceVector<Real>& f) {
  return dot(f, v);
}

/// v x m, the rate of change of a motion vector that moves with the twist v (RBDA 2.31).
template <typename Real>
inline BasicMotionVector<Real> cross(const BasicMotionVector<Real>& v, const BasicMotionVector<Real>& m) {
  return {v.angular.cross(m.angular), v.angular.cross(m.linear) + v.linear.cross(m.angular)};
}

/// v x* f, the rate of change of a force vector that moves with the twist v (RBDA 2.32).
template <typename Real>
inline BasicForceVector<Real> cross(const BasicMotionVector<Real>& v, const BasicForceVector<Real>& f) {
  return {v.angular.cross(f.angular) + v.linear.cross(f.linear), v.angular.cross(f.linear)};
}

/// Pluecker transform X_BA from A to B coordinates, kept as the pose of B in A: E = R_AB', r = p_AB
/// (RBDA 2.24).
template <typename Real>
struct BasicPluckerTransform {
  Matrix3Of<Real> E = Matrix3Of<Real>::Identity();  ///< rotates coordinates from A to B
  Vector3Of<Real> r = Vector3Of<Real>::Zero();      ///< [m] origin of B in A coordinates

  BasicPluckerTransform() = default;
  BasicPluckerTransform(const Matrix3Of<Real>& rotation, const Vector3Of<Real>& origin)
      : E(rotation), r(origin) {}
  /// The transform from A to B for the pose X_AB of B in A.
  explicit BasicPluckerTransform(const BasicPose<Real>& pose)
      : E(pose.rotation.transpose()), r(pose.position) {}

  /// A to B.
  BasicMotionVector<Real> operator*(const BasicMotionVector<Real>& v) const {
    return {E * v.angular, E * (v.linear - r.cross(v.angular))};
  }
  /// A to B: X_BA^* f.
  BasicForceVector<Real> operator*(const BasicForceVector<Real>& f) const {
    return {E * (f.angular - r.cross(f.linear)), E * f.linear};
  }
  /// B to A: X^-1 v.
  BasicMotionVector<Real> inverse_apply(const BasicMotionVector<Real>& v) const {
    const Vector3Of<Real> w = E.transpose() * v.angular;
    return {w, E.transpose() * v.linear + r.cross(w)};
  }
  /// B to A: X' f, the transposed motion transform, which is the inverse force transform.
  BasicForceVector<Real> transpose_apply(const BasicForceVector<Real>& f) const {
    const Vector3Of<Real> n = E.transpose() * f.linear;
    return {E.transpose() * f.angular + r.cross(n), n};
  }
  /// The 6 x 6 matrix that takes motion vectors from A to B.
  Matrix6Of<Real> motion_matrix() const {
    Matrix6Of<Real> X;
    X.template topLeftCorner<3, 3>() = E;
    X.template topRightCorner<3, 3>().setZero();
    X.template bottomLeftCorner<3, 3>() = -E * skew(r);
    X.template bottomRightCorner<3, 3>() = E;
    return X;
  }
  /// (this * other): A -> B after other: Z -> A.
  BasicPluckerTransform<Real> operator*(const BasicPluckerTransform<Real>& other) const {
    return {E * other.E, other.r + other.E.transpose() * r};
  }
};

/// Inertia of a rigid body about the origin of its frame.
template <typename Real>
struct BasicRigidInertia {
  Real mass = 0.0;                                         ///< [kg]
  Vector3Of<Real> first_moment = Vector3Of<Real>::Zero();  ///< [kg m] mass times centre of mass
  Matrix3Of<Real> rotational = Matrix3Of<Real>::Zero();    ///< [kg m^2] about the frame's origin

  /// From the inertia about the centre of mass `com`, in axes parallel to the body frame's (RBDA 2.63).
  static BasicRigidInertia<Real> from_com(Real mass, const Vector3Of<Real>& com,
                                          const Matrix3Of<Real>& inertia_at_com) {
    const Matrix3Of<Real> c = skew(com);
    return {mass, mass * com, inertia_at_com - mass * c * c};
  }
  /// About the centre of mass, in the body frame's axes; the mass is not 0. [kg m^2]
  Matrix3Of<Real> rotational_at_com() const {
    const Matrix3Of<Real> c = skew(first_moment / mass);
    return rotational + mass * c * c;
  }
  BasicForceVector<Real> operator*(const BasicMotionVector<Real>& v) const {
    return {rotational * v.angular + first_moment.cross(v.linear),
            mass * v.linear - first_moment.cross(v.angular)};
  }
  BasicRigidInertia<Real> operator+(const BasicRigidInertia<Real>& o) const {
    return {mass + o.mass, first_moment + o.first_moment, rotational + o.rotational};
  }
  /// The same inertia in the coordinates of a frame A in which the body frame B has the pose X_AB. h is the
  /// first moment in A's axes, about B. The parallel axis theorem then reads
  ///   J_A = R J R' - (h p' + p h') - m p p' + (2 p.h + m p.p) 1
  BasicRigidInertia<Real> expressed_in(const BasicPose<Real>& pose) const {
    const Matrix3Of<Real>& R = pose.rotation;
    const Vector3Of<Real>& p = pose.position;
    const Vector3Of<Real> h = R * first_moment;
    const Vector3Of<Real> half = h + 0.5 * mass * p;
    const Matrix3Of<Real> mixed = half * p.transpose();
    Matrix3Of<Real> J = -mixed - mixed.transpose();
    const Matrix3Of<Real> turned = R * rotational;
    J.noalias() += turned * R.transpose();
    J.diagonal().array() += 2.0 * p.dot(half);
    return {mass, h + mass * p, J};
  }
  Matrix6Of<Real> matrix() const {
    Matrix6Of<Real> I;
    const Matrix3Of<Real> h = skew(first_moment);
    I << rotational, h, h.transpose(), mass * Matrix3Of<Real>::Identity();
    return I;
  }
};

using Pose = BasicPose<double>;
using MotionVector = BasicMotionVector<double>;
using ForceVector = BasicForceVector<double>;
using PluckerTransform = BasicPluckerTransform<double>;
using RigidInertia = BasicRigidInertia<double>;

}  // namespace zwang::solver
