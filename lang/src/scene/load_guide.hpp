/// The guides of an object in a scene: hinges, slides, and its contact with the floor.
#pragma once

#include <string>

#include "spec/shape.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// `hinge`, `slide`, `slides` and `casters` of an object whose `mass`, `fixed` and `motion` were read.
void parse_guide(MapReader& map, SceneObject& object, Diagnostics& diagnostics);

/// A number of an object or a signal that is not below 0; 0 where the key is not there.
double not_negative(MapReader& map, const char* key, const Dimension& expected, Diagnostics& diagnostics);

/// Whether one of the keys stands there that leave an object one way to move.
bool has_guide(const Node& object);

/// An object's travel is an angle, a length, or nothing without a guide. A key that is misspelt was
/// complained of.
enum class TravelOf { nothing, turning, sliding };
TravelOf travel_of(const Node& object);

}  // namespace zwang::lang
