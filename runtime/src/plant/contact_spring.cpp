#include "contact_spring.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace zwang::runtime {

namespace {

const lang::SceneObject& object_of(const lang::Scene& scene, int index) {
  return scene.objects[static_cast<std::size_t>(index)];
}

const lang::SceneObject& softer_object(const lang::Scene& scene, int one, int other) {
  if (one < 0 || other < 0) return object_of(scene, std::max(one, other));
  const lang::SceneObject& a = object_of(scene, one);
  const lang::SceneObject& b = object_of(scene, other);
  return a.stiffness < b.stiffness ? a : b;
}

double inverse_mass(const lang::Scene& scene, double robot_mass, int index) {
  if (index < 0) return 1.0 / robot_mass;
  const auto& mass = object_of(scene, index).mass;
  return mass ? 1.0 / *mass : 0.0;
}

void require_spring(const lang::SceneObject& object) {
  const auto refuse = [&object](const char* what) {
    throw std::invalid_argument("plant: " + std::string(what) + " (object `" + object.name + "`)");
  };
  if (!(object.stiffness > 0.0) || !(object.damping >= 0.0) || !(object.friction >= 0.0)) {
    refuse("stiffness, damping or friction is out of range");
  }
  // The contact's damping is also what resists sliding until the friction limit is reached.
  if (object.friction > 0.0 && object.damping < 0.01)
    refuse("friction needs a damping ratio of at least 0.01");
}

}  // namespace

ContactSpring contact_spring(const lang::Scene& scene, double robot_mass, int one, int other) {
  const lang::SceneObject& object = softer_object(scene, one, other);
  require_spring(object);
  const double mass = 1.0 / (inverse_mass(scene, robot_mass, one) + inverse_mass(scene, robot_mass, other));
  return {object.stiffness, 2.0 * object.damping * std::sqrt(object.stiffness * mass)};
}

}  // namespace zwang::runtime
