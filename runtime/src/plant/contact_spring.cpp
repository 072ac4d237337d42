#include "contact_spring.hpp"

#include <algorithm>
#include <cmath>

#include "refuse.hpp"

namespace zwang::runtime {

namespace {

template <typename Touched>
Touchable::Skin skin_of(const Touched& object, const char* kind) {
  if (!(object.stiffness > 0.0) || !(object.damping >= 0.0) || !(object.friction.value_or(0.0) >= 0.0)) {
    refuse(std::string("stiffness, damping or friction is out of range (") + kind + " `" + object.name +
           "`)");
  }
  return {object.stiffness, object.damping};
}

}  // namespace

Touchable touchable_object(const lang::SceneObject& object) {
  return {object.name, object.inverse_mass(), skin_of(object, "object")};
}

Touchable touchable_robot(const lang::SceneRobot* robot, double mass) {
  if (robot == nullptr) return {"", 1.0 / mass, std::nullopt};
  return {robot->name, 1.0 / mass, skin_of(*robot, "robot")};
}

ContactSpring contact_spring(const Touchable& one, const Touchable& other) {
  const bool first_is_softer =
      one.skin && other.skin ? one.skin->stiffness < other.skin->stiffness : one.skin.has_value();
  const Touchable::Skin& skin = first_is_softer ? *one.skin : *other.skin;
  const double mass = 1.0 / (one.inverse_mass + other.inverse_mass);
  return {skin.stiffness, 2.0 * skin.damping * std::sqrt(skin.stiffness * mass), mass};
}

SteppedSpring stepped(const ContactSpring& spring, double inverse_mass, double period) noexcept {
  constexpr double stiffest = 1e3;  // (h w)^2
  const double h = period;
  const double stiffness = std::min(spring.stiffness, stiffest / (inverse_mass * h * h));
  const double damping = std::min(spring.damping, stiffest / (inverse_mass * h));
  const double hw = h * std::sqrt(stiffness * inverse_mass);
  const double theta =
      std::min(1.0, std::max(0.5 * hw * (1.0 + std::min(1.0, hw * hw)), h * damping * inverse_mass));
  return {stiffness, theta * stiffness * h + damping, theta * (stiffness * h * h + damping * h)};
}

}  // namespace zwang::runtime
