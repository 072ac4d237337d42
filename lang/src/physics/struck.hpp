/// Objects and robots of a scene that a hit may meet, and how they give way.
#pragma once

#include <string>

#include "physics/arrival.hpp"

namespace zwang::lang {

struct Struck {
  DrivenHit hit;
  double stiffness = 0.0;  ///< [N/m] of all points
  std::string name;        ///< of the object or robot; empty: the robot's own bumper
  int points = 1;          ///< that strike together
  bool is_bound = false;   ///< the hit may be gentler, or there is none
  std::string uncounted;   ///< what may make it harder, and is not in it
  /// Where the way ends on which it gives way. It is a wall from there on.
  std::optional<DrivenHit> at_end;

  /// The harder one of both hits. [N]
  double most() const { return std::max(hit.peak(), at_end ? at_end->peak() : 0.0); }
  /// The same at another speed. [N]
  double most_at(double speed) const;
};

/// The robot as it comes.
struct Comer {
  const Robot& robot;
  double mass = 0.0;  ///< [kg] along the axis
  DriverPush push;
  const Arrival& arrival;
  int corners = 1;  ///< of its footprint that lie foremost
};

/// The hardest hit that the scene has on the way; none: nothing is there.
std::optional<Struck> struck_in(const Scene& scene, const Comer& comer);
/// Something rigid, without a scene.
Struck struck_bumper(const Comer& comer);

}  // namespace zwang::lang
