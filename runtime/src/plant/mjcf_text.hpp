/// Words of MuJoCo's XML.
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

#include "outline.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::runtime::mjcf {

/// The shortest text that reads back as the same number, whatever the locale.
inline std::string text_of(double number) {
  if (!std::isfinite(number))
    throw std::invalid_argument("plant: a number of the robot or the scene is not finite");
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  return {buffer.data(), end};
}

template <typename... Numbers>
inline std::string list_of(double first, Numbers... rest) {
  std::string text = text_of(first);
  ((text += ' ' + text_of(rest)), ...);
  return text;
}

inline std::string list_of(const solver::Vector3& v) {
  return list_of(v.x(), v.y(), v.z());
}

inline std::string attribute(const std::string& name, const std::string& value) {
  return ' ' + name + "=\"" + value + '"';
}

inline std::string numbered(const std::string& name, std::size_t number) {
  return name + '_' + std::to_string(number);
}

inline std::string quaternion_of(const solver::Matrix3& rotation) {
  const Eigen::Quaterniond q(rotation);
  return list_of(q.w(), q.x(), q.y(), q.z());
}

/// About its principal axes, as MuJoCo finds those of a `fullinertia` to a part in a million only.
inline std::string inertial(const solver::RigidInertia& inertia) {
  const solver::Vector3 com = inertia.first_moment / inertia.mass;
  const Eigen::SelfAdjointEigenSolver<solver::Matrix3> principal(inertia.rotational_at_com());
  solver::Matrix3 axes = principal.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  // A flat body has A + B = C. Rounding makes C larger, and MuJoCo refuses that.
  solver::Vector3 moments = principal.eigenvalues();
  moments(2) = std::min(moments(2), moments(0) + moments(1));
  return "<inertial" + attribute("pos", list_of(com)) + attribute("mass", text_of(inertia.mass)) +
         attribute("quat", quaternion_of(axes)) + attribute("diaginertia", list_of(moments)) + "/>\n";
}

inline std::string sphere_geom(const std::string& name, const solver::Vector3& at, double radius) {
  return "<geom" + attribute("name", name) + attribute("type", "sphere") + attribute("pos", list_of(at)) +
         attribute("size", text_of(radius)) + "/>\n";
}

/// A wheel whose contact's first direction is turned by `turn` from its rolling direction, about the
/// ground's normal; simulator.cpp reads it.
inline std::string wheel_geom(const std::string& name, double radius, double turn) {
  if (turn == 0.0) return sphere_geom(name, solver::Vector3::Zero(), radius);
  return "<geom" + attribute("name", name) + attribute("type", "sphere") +
         attribute("size", text_of(radius)) + attribute("user", text_of(turn)) + "/>\n";
}

/// A corner of an outline that was moved by `shift`; simulator.cpp reads its heading and its half angle.
inline std::string corner_geom(const std::string& name, const Corner& corner, const solver::Vector3& shift) {
  return "<geom" + attribute("name", name) + attribute("type", "sphere") +
         attribute("pos", list_of(corner.centre + shift)) +
         attribute("euler", list_of(0.0, 0.0, corner.outward)) + attribute("size", text_of(corner_radius)) +
         attribute("user", text_of(corner.half_angle)) + "/>\n";
}

/// The same on a body that leans: `turn` is a quaternion, whose x axis points outwards.
inline std::string corner_geom(const std::string& name, const solver::Vector3& at, const std::string& turn,
                               double half_angle) {
  return "<geom" + attribute("name", name) + attribute("type", "sphere") + attribute("pos", list_of(at)) +
         attribute("quat", turn) + attribute("size", text_of(corner_radius)) +
         attribute("user", text_of(half_angle)) + "/>\n";
}

/// Of contacts with the floor, and of ties.
inline std::string stiff() {
  return "solref=\"0.004 1\" solimp=\"0.95 0.99 0.001\"";
}

}  // namespace zwang::runtime::mjcf
