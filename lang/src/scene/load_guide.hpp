/// What lets an object of a scene move besides a push: hinges, slides, and how it stands on the floor.
#pragma once

#include <string>

#include "spec/shape.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// `hinge`, `slide`, `slides` and `casters` of an object whose `mass`, `fixed` and `motion` were read.
void parse_guide(MapReader& map, SceneObject& object, Diagnostics& diagnostics);

/// What an object's travel measures: an angle, a length, or nothing without a hinge or a slide. One that is
/// misspelt was complained of.
enum class TravelOf { nothing, hinge, slide };
TravelOf travel_of(const Node& object);

}  // namespace zwang::lang
