/// How a base comes to rest on a wall that it is pushed to.
#pragma once

#include <optional>

#include "physics/push.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

class Remarks;

/// The wall that a base meets straight on from its start.
struct WallAhead {
  double askew = 0.0;     ///< [rad] of the base to it
  double friction = 0.0;  ///< Coulomb coefficient
  const SceneObject* object = nullptr;
};
/// nullopt: nothing stands there, or something that is no straight wall, gives way, or is met by its edge.
std::optional<WallAhead> wall_ahead(const std::optional<Scene>& scene, const Push& push, Probe& probe);

/// A base that is pushed to a wall.
struct PushedToWall {
  Push push;
  double floor = 0.0;             ///< [N m] with which the floor holds its heading
  double row = 0.0;               ///< [N m] below which a row makes it seem to rest
  double speed = 0.0;             ///< [m/s] at most, with which it arrives
  std::optional<WallAhead> wall;  ///< none: nobody knows how the base comes to it
};
/// E621, W621: the base rests askew. `exit`: asks for the rest of the heading.
void ask_rest(const PlannedAxis& axis, const PushedToWall& pushed, const Span& exit, Probe& probe,
              Remarks& remarks);

}  // namespace zwang::lang
