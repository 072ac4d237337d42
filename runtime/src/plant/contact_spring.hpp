/// What a contact in the bumper's plane is as a spring.
#pragma once

#include "zwang/lang/scene.hpp"

namespace zwang::runtime {

struct ContactSpring {
  double stiffness = 0.0;  ///< K [N/m]
  double damping = 0.0;    ///< c = 2 zeta sqrt(K m) [N s/m], m the reduced mass of the two that meet
};

/// Between two objects of the scene, or an object and the robot (index -1). Two objects meet with the
/// stiffness and damping ratio of the softer one. Throws std::invalid_argument on numbers that make no
/// spring.
ContactSpring contact_spring(const lang::Scene& scene, double robot_mass, int one, int other);

}  // namespace zwang::runtime
