/// A scene: what stands around a simulated robot.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

enum class ShapeKind { box, cylinder, wall };

struct SceneObject {
  std::string name;
  ShapeKind shape = ShapeKind::wall;
  std::array<double, 3> size{};  ///< [m] full extents of a box; radius, radius, height of a cylinder; length,
                                 ///< thickness, height of a wall
  std::array<double, 2> at{};    ///< [m] world; a wall's `at` is a point of its face, midway along it
  double yaw = 0.0;  ///< [rad] a wall's face looks along its own -x: a robot that drives along +x meets it
                     ///< square at yaw 0
  std::optional<double> mass;  ///< [kg]; none: fixed to the world
  double stiffness = 1e5;      ///< [N/m] of one contact point
  double damping = 0.3;        ///< damping ratio of the contact
  double friction = 0.0;       ///< Coulomb coefficient
  Span span;
};

struct Scene {
  std::array<double, 2> start_at{};  ///< [m] world
  double start_yaw = 0.0;            ///< [rad]
  double floor_friction = 0.9;
  std::vector<SceneObject> objects;
};

std::optional<Scene> load_scene(const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace zwang::lang
