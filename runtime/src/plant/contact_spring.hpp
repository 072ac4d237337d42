/// The spring of a contact in the bumper's plane.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "zwang/lang/scene.hpp"

namespace zwang::runtime {

/// An object of the scene or a robot that others can touch.
struct Touchable {
  struct Skin {
    double stiffness = 0.0, damping = 0.0;
  };
  std::string name;
  double inverse_mass = 0.0;  ///< [1/kg]; 0: nothing pushes it
  std::optional<Skin> skin;   ///< none: of the first robot, which feels as what it meets
};
/// Throw std::invalid_argument on numbers that make no spring.
Touchable touchable_object(const lang::SceneObject& object);
/// `robot` null: the first one.
Touchable touchable_robot(const lang::SceneRobot* robot, double mass);

struct ContactSpring {
  double stiffness = 0.0;  ///< K [N/m]
  double damping = 0.0;    ///< c = 2 zeta sqrt(K m) [N s/m]
  double mass = 0.0;       ///< m [kg], the reduced mass of the two that meet

  double impedance() const noexcept { return std::sqrt(stiffness * mass); }  ///< sqrt(K m) [N s/m]
  /// pi sqrt(m/K) [s]: as long as a hit without damping.
  double half_swing() const noexcept { return std::numbers::pi * std::sqrt(mass / stiffness); }
};

/// The two meet with the stiffness and damping ratio of the softer one; at least one has a skin.
ContactSpring contact_spring(const Touchable& one, const Touchable& other);

/// The spring in a step of h = `period`. A share theta of the step is implicit:
///     f = K (x + theta h v') + c ((1 - theta) v + theta v'),   v' = v + h a,
///       = K x + (theta K h + c) v + theta (K h^2 + c h) a.
/// x is the depth, v and a are its rates, and v' is the rate at the end of the step. The share is
///     theta = min(1, max(h w/2, h c/m)),   w = sqrt(K/m),   h w/2 doubled for h w >= 1.
/// It is next to nothing where the step resolves the spring, and all where it does not. It damps by a ratio
/// of theta h w/2, which takes (h w)^2 pi/8 of a peak. So no contact gives back more than it took, at any
/// stiffness. The depth x0 < h v at which a contact is found costs nothing, and the first step takes more
/// than K x0^2/2. A step cannot tell springs beyond h w = 30 from a rigid wall, so they are cut to it.
struct SteppedSpring {
  double stiffness = 0.0;  ///< K [N/m]
  double damping = 0.0;    ///< theta K h + c [N s/m]
  double mass = 0.0;       ///< theta (K h^2 + c h) [kg]
};
/// `inverse_mass` [1/kg] of what moves at the contact.
SteppedSpring stepped(const ContactSpring& spring, double inverse_mass, double period) noexcept;

}  // namespace zwang::runtime
