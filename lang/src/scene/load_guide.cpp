#include "scene/load_guide.hpp"

#include <algorithm>

#include "diagnostic/nearest.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_guides.hpp"

namespace zwang::lang {

namespace {

/// What the numbers of a hinge or a slide measure.
struct GuideDimensions {
  Dimension travel, force, stiffness, damping;
};
constexpr GuideDimensions of_hinge{dimension::angle, dimension::torque, dimension::angular_stiffness,
                                   dimension::angular_damping};
constexpr GuideDimensions of_slide{dimension::length, dimension::force, dimension::stiffness,
                                   dimension::damping};

double guide_number(MapReader& map, const char* key, const Dimension& expected, Diagnostics& diagnostics) {
  const Node* node = map.optional(key);
  if (node == nullptr) return 0.0;
  return parse_positive(*node, expected, map.what() + "'s `" + key + "`", true, diagnostics).value_or(0.0);
}

/// The object stands at 0 as it was written, so its range holds 0.
void parse_travel(const Node& node, const Dimension& expected, const std::string& what, Guide& guide,
                  Diagnostics& diagnostics) {
  const StatementText range = parse_range(node, what + "'s `range`", diagnostics);
  if (range.low.kind == ValueKind::bad || range.high.kind == ValueKind::bad) return;
  if (!require_quantity(range.low, expected, what + "'s `range`", diagnostics) ||
      !require_quantity(range.high, expected, what + "'s `range`", diagnostics))
    return;
  guide.lower = range.low.quantity.value;
  guide.upper = range.high.quantity.value;
  if (guide.lower > 0.0 || guide.upper < 0.0 || !(guide.lower < guide.upper))
    diagnostics.add(wording::range_without_start(node.span, what, guide.turns));
}

/// `x`, `-x`, `y` or `-y`.
void parse_direction(const Node& node, const std::string& what, Guide& guide, Diagnostics& diagnostics) {
  const std::vector<std::string> known{"x", "-x", "y", "-y"};
  const std::string text = parse_word(node, what + "'s `along`", diagnostics).text;
  if (text.empty()) return;
  if (std::find(known.begin(), known.end(), text) == known.end()) {
    diagnostics.add(wording::unknown_name(node.span, "axis of the object", text, known));
    return;
  }
  const double sign = text.front() == '-' ? -1.0 : 1.0;
  guide.along = text.back() == 'x' ? std::array{sign, 0.0} : std::array{0.0, sign};
}

Guide parse_guide_of(const Node& node, bool turns, const std::string& whose, Diagnostics& diagnostics) {
  Guide guide;
  guide.turns = turns;
  MapReader map(node, whose + (turns ? "'s `hinge`" : "'s `slide`"), diagnostics,
                turns ? "{at: [0 m, 0.5 m], range: [0 deg, 90 deg]}" : "{along: x, range: [-0.4 m, 0 m]}");
  if (!map.is_mapping()) return guide;
  const GuideDimensions& measures = turns ? of_hinge : of_slide;
  if (const Node* at = turns ? map.required("at") : nullptr)
    guide.at = parse_place(*at, map.what() + "'s `at`", "", diagnostics).value_or(guide.at);
  if (const Node* along = turns ? nullptr : map.required("along"))
    parse_direction(*along, map.what(), guide, diagnostics);
  if (const Node* range = map.required("range"))
    parse_travel(*range, measures.travel, map.what(), guide, diagnostics);
  guide.preload = guide_number(map, "preload", measures.force, diagnostics);
  guide.stiffness = guide_number(map, "stiffness", measures.stiffness, diagnostics);
  guide.damping = guide_number(map, "damping", measures.damping, diagnostics);
  guide.friction = guide_number(map, "friction", measures.force, diagnostics);
  if (const Node* locked = map.optional("locked"))
    guide.locked = parse_boolean(*locked, map.what() + "'s `locked`", diagnostics).value_or(false);
  if (guide.preload > 0.0 && guide.lower < 0.0 && guide.upper > 0.0)
    diagnostics.add(wording::preload_to_both_sides(map.optional("preload")->span, map.what()));
  map.finish();
  return guide;
}

/// Whether the floor's friction is the object's own matter.
void parse_floor_contact(MapReader& map, SceneObject& object, Diagnostics& diagnostics) {
  if (const Node* slides = map.optional("slides"))
    object.slides = parse_positive(*slides, dimension::none, map.what() + "'s `slides`", true, diagnostics);
  if (const Node* casters = map.optional("casters"))
    object.caster_trail =
        parse_positive(*casters, dimension::length, map.what() + "'s `casters`", false, diagnostics)
            .value_or(0.0);
  for (const char* key : {"slides", "casters"}) {
    const Node* node = map.optional(key);
    if (node == nullptr) continue;
    if (object.guide) {
      diagnostics.add(
          wording::two_ways_to_move(node->span, map.what(), key, object.guide->turns ? "hinge" : "slide"));
    } else if (!object.mass && !map.has_misspelt({"mass"})) {
      diagnostics.add(wording::moves_without_mass(node->span, map.what(), key));
    }
  }
}

}  // namespace

void parse_guide(MapReader& map, SceneObject& object, Diagnostics& diagnostics) {
  const Node* hinge = map.optional("hinge");
  const Node* slide = map.optional("slide");
  if (hinge != nullptr && slide != nullptr)
    diagnostics.add(wording::two_ways_to_move(slide->span, map.what(), "slide", "hinge"));
  const Node* given = hinge != nullptr ? hinge : slide;
  if (given != nullptr) {
    const char* key = hinge != nullptr ? "hinge" : "slide";
    object.guide = parse_guide_of(*given, hinge != nullptr, map.what(), diagnostics);
    const Node* fixed = map.optional("fixed");
    const Node* motion = map.optional("motion");
    if (motion != nullptr) {
      diagnostics.add(wording::two_ways_to_move(motion->span, map.what(), "motion", key));
    } else if (fixed != nullptr && fixed->text == "true") {
      diagnostics.add(wording::two_ways_to_move(fixed->span, map.what(), "fixed", key));
    } else if (!object.mass && !map.has_misspelt({"mass"})) {
      diagnostics.add(wording::moves_without_mass(given->span, map.what(), key));
    }
  }
  parse_floor_contact(map, object, diagnostics);
}

TravelOf travel_of(const Node& object) {
  for (const Entry& entry : object.entries) {
    const std::string meant = meant_key(entry.key.text, {"at", "hinge", "mass", "slide", "slides"});
    if (entry.key.text == "hinge" || meant == "hinge") return TravelOf::hinge;
    if (entry.key.text == "slide" || meant == "slide") return TravelOf::slide;
  }
  return TravelOf::nothing;
}

}  // namespace zwang::lang
