/// Spatial algebra in Featherstone's form ("Rigid Body Dynamics Algorithms", 2008): the angular part comes
/// first.
///
/// Motion and force vectors are different types; the only number made from the two is their dot product, a
/// power.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace zwang::solver {

using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The matrix of the cross product: skew(a) b = a x b.
inline Matrix3 skew(const Vector3& a) {
  Matrix3 m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

/// A pose X_AB: the frame B seen from the frame A. A point's coordinates map as p_A = rotation * p_B +
/// position.
struct Pose {
  Matrix3 rotation = Matrix3::Identity();  ///< R_AB, columns are the axes of B in A
  Vector3 position = Vector3::Zero();      ///< [m] origin of B in A

  Pose operator*(const Pose& other) const {
    return {rotation * other.rotation, rotation * other.position + position};
  }
  Vector3 operator*(const Vector3& point) const { return rotation * point + position; }
  Pose inverse() const { return {rotation.transpose(), -(rotation.transpose() * position)}; }
};

/// Yaw of a rotation, about the fixed z. [rad]
inline double yaw_of(const Matrix3& rotation) {
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

/// Rotation by roll, pitch, yaw about the fixed axes x, y, z, as in URDF: Rz(yaw) Ry(pitch) Rx(roll). [rad]
inline Matrix3 rotation_from_rpy(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
          Eigen::AngleAxisd(roll, Vector3::UnitX()))
      .toRotationMatrix();
}

/// A twist or a spatial acceleration, in the coordinates of a frame and at its origin.
struct MotionVector {
  Vector3 angular = Vector3::Zero();  ///< [rad/s] or [rad/s^2]
  Vector3 linear = Vector3::Zero();   ///< [m/s] or [m/s^2], of the point at the origin

  MotionVector operator+(const MotionVector& o) const { return {angular + o.angular, linear + o.linear}; }
  MotionVector operator-(const MotionVector& o) const { return {angular - o.angular, linear - o.linear}; }
  MotionVector operator*(double s) const { return {angular * s, linear * s}; }
  MotionVector& operator+=(const MotionVector& o) {
    angular += o.angular;
    linear += o.linear;
    return *this;
  }
  Vector6 vector() const { return (Vector6() << angular, linear).finished(); }
};

/// A wrench, in the coordinates of a frame and about its origin.
struct ForceVector {
  Vector3 angular = Vector3::Zero();  ///< [N m] moment about the origin
  Vector3 linear = Vector3::Zero();   ///< [N] force

  ForceVector operator+(const ForceVector& o) const { return {angular + o.angular, linear + o.linear}; }
  ForceVector operator-(const ForceVector& o) const { return {angular - o.angular, linear - o.linear}; }
  ForceVector operator-() const { return {-angular, -linear}; }
  ForceVector operator*(double s) const { return {angular * s, linear * s}; }
  ForceVector& operator+=(const ForceVector& o) {
    angular += o.angular;
    linear += o.linear;
    return *this;
  }
  ForceVector& operator-=(const ForceVector& o) {
    angular -= o.angular;
    linear -= o.linear;
    return *this;
  }
  Vector6 vector() const { return (Vector6() << angular, linear).finished(); }
  bool is_zero() const { return angular == Vector3::Zero() && linear == Vector3::Zero(); }
};

/// Power of a force along a motion. [W]
inline double dot(const ForceVector& f, const MotionVector& v) {
  return f.angular.dot(v.angular) + f.linear.dot(v.linear);
}
inline double dot(const MotionVector& v, const ForceVector& f) {
  return dot(f, v);
}

/// v x m, the rate of change of a motion vector that moves with the twist v (RBDA 2.31).
inline MotionVector cross(const MotionVector& v, const MotionVector& m) {
  return {v.angular.cross(m.angular), v.angular.cross(m.linear) + v.linear.cross(m.angular)};
}

/// v x* f, the rate of change of a force vector that moves with the twist v (RBDA 2.32).
inline ForceVector cross(const MotionVector& v, const ForceVector& f) {
  return {v.angular.cross(f.angular) + v.linear.cross(f.linear), v.angular.cross(f.linear)};
}

/// Pluecker transform X_BA from A to B coordinates, kept as the pose of B in A: E = R_AB', r = p_AB
/// (RBDA 2.24).
struct PluckerTransform {
  Matrix3 E = Matrix3::Identity();  ///< rotates coordinates from A to B
  Vector3 r = Vector3::Zero();      ///< [m] origin of B in A coordinates

  PluckerTransform() = default;
  PluckerTransform(const Matrix3& rotation, const Vector3& origin) : E(rotation), r(origin) {}
  /// The transform from A to B for the pose X_AB of B in A.
  explicit PluckerTransform(const Pose& pose) : E(pose.rotation.transpose()), r(pose.position) {}

  /// A to B.
  MotionVector operator*(const MotionVector& v) const {
    return {E * v.angular, E * (v.linear - r.cross(v.angular))};
  }
  /// A to B: X_BA^* f.
  ForceVector operator*(const ForceVector& f) const {
    return {E * (f.angular - r.cross(f.linear)), E * f.linear};
  }
  /// B to A: X^-1 v.
  MotionVector inverse_apply(const MotionVector& v) const {
    const Vector3 w = E.transpose() * v.angular;
    return {w, E.transpose() * v.linear + r.cross(w)};
  }
  /// B to A: X' f, the transposed motion transform, which is the inverse force transform.
  ForceVector transpose_apply(const ForceVector& f) const {
    const Vector3 n = E.transpose() * f.linear;
    return {E.transpose() * f.angular + r.cross(n), n};
  }
  /// The 6 x 6 matrix that takes motion vectors from A to B.
  Matrix6 motion_matrix() const {
    Matrix6 X;
    X.topLeftCorner<3, 3>() = E;
    X.topRightCorner<3, 3>().setZero();
    X.bottomLeftCorner<3, 3>() = -E * skew(r);
    X.bottomRightCorner<3, 3>() = E;
    return X;
  }
  /// (this * other): A -> B after other: Z -> A.
  PluckerTransform operator*(const PluckerTransform& other) const {
    return {E * other.E, other.r + other.E.transpose() * r};
  }
};

/// Inertia of a rigid body about the origin of its frame.
struct RigidInertia {
  double mass = 0.0;                       ///< [kg]
  Vector3 first_moment = Vector3::Zero();  ///< [kg m] mass times centre of mass
  Matrix3 rotational = Matrix3::Zero();    ///< [kg m^2] about the frame's origin

  /// From the inertia about the centre of mass `com`, in axes parallel to the body frame's (RBDA 2.63).
  static RigidInertia from_com(double mass, const Vector3& com, const Matrix3& inertia_at_com) {
    const Matrix3 c = skew(com);
    return {mass, mass * com, inertia_at_com - mass * c * c};
  }
  ForceVector operator*(const MotionVector& v) const {
    return {rotational * v.angular + first_moment.cross(v.linear),
            mass * v.linear - first_moment.cross(v.angular)};
  }
  RigidInertia operator+(const RigidInertia& o) const {
    return {mass + o.mass, first_moment + o.first_moment, rotational + o.rotational};
  }
  /// The same inertia in the coordinates of a frame A in which the body frame B has the pose X_AB. With h the
  /// first moment in A's axes, about B, the parallel axis theorem reads J_A = R J R' - (h p' + p h') - m p p'
  /// + (2 p.h + m p.p) 1.
  RigidInertia expressed_in(const Pose& pose) const {
    const Matrix3& R = pose.rotation;
    const Vector3& p = pose.position;
    const Vector3 h = R * first_moment;
    const Vector3 half = h + 0.5 * mass * p;
    const Matrix3 mixed = half * p.transpose();
    Matrix3 J = -mixed - mixed.transpose();
    const Matrix3 turned = R * rotational;
    J.noalias() += turned * R.transpose();
    J.diagonal().array() += 2.0 * p.dot(half);
    return {mass, h + mass * p, J};
  }
  Matrix6 matrix() const {
    Matrix6 I;
    const Matrix3 h = skew(first_moment);
    I << rotational, h, h.transpose(), mass * Matrix3::Identity();
    return I;
  }
};

}  // namespace zwang::solver
