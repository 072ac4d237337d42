#include "scene/load_guide.hpp"

#include <algorithm>
#include <array>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_guides.hpp"
#include "words/nearest.hpp"

namespace zwang::lang {

namespace {

/// The numbers of a guide measure these.
struct GuideDimensions {
  Dimension travel, force, stiffness, damping;
};
constexpr GuideDimensions of_turning{dimension::angle, dimension::torque, dimension::angular_stiffness,
                                     dimension::angular_damping};
constexpr GuideDimensions of_sliding{dimension::length, dimension::force, dimension::stiffness,
                                     dimension::damping};

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
  guide.axis = text.back() == 'x' ? std::array{sign, 0.0, 0.0} : std::array{0.0, sign, 0.0};
}

/// An upright axis through `at`.
void parse_hinge(MapReader& map, Guide& guide, Diagnostics& diagnostics) {
  guide.axis = {0.0, 0.0, 1.0};
  const Node* at = map.required("at");
  if (at == nullptr) return;
  if (const auto place = parse_place(*at, map.what() + "'s `at`", "", diagnostics))
    guide.at = {(*place)[0], (*place)[1], 0.0};
}

void parse_slide(MapReader& map, Guide& guide, Diagnostics& diagnostics) {
  if (const Node* along = map.required("along")) parse_direction(*along, map.what(), guide, diagnostics);
}

/// A key of an object that leaves it one way to move.
struct GuideKind {
  const char* key;
  bool turns;
  /// Reads where the axis is.
  void (*parse_axis)(MapReader& map, Guide& guide, Diagnostics& diagnostics);
  const char* example;
};
constexpr std::array guide_kinds{
    GuideKind{"hinge", true, parse_hinge, "{at: [0 m, 0.5 m], range: [0 deg, 90 deg]}"},
    GuideKind{"slide", false, parse_slide, "{along: x, range: [-0.4 m, 0 m]}"},
};

Guide parse_guide_of(const Node& node, const GuideKind& kind, const std::string& whose,
                     Diagnostics& diagnostics) {
  Guide guide;
  guide.turns = kind.turns;
  MapReader map(node, whose + "'s `" + kind.key + "`", diagnostics, kind.example);
  if (!map.is_mapping()) return guide;
  const GuideDimensions& measures = kind.turns ? of_turning : of_sliding;
  kind.parse_axis(map, guide, diagnostics);
  if (const Node* range = map.required("range"))
    parse_travel(*range, measures.travel, map.what(), guide, diagnostics);
  guide.preload = not_negative(map, "preload", measures.force, diagnostics);
  guide.stiffness = not_negative(map, "stiffness", measures.stiffness, diagnostics);
  guide.damping = not_negative(map, "damping", measures.damping, diagnostics);
  guide.friction = not_negative(map, "friction", measures.force, diagnostics);
  if (const Node* locked = map.optional("locked"))
    guide.locked = parse_boolean(*locked, map.what() + "'s `locked`", diagnostics).value_or(false);
  if (guide.preload > 0.0 && guide.lower < 0.0 && guide.upper > 0.0)
    diagnostics.add(wording::preload_to_both_sides(map.optional("preload")->span, map.what()));
  map.finish();
  return guide;
}

/// Whether the floor's friction is the object's own matter. `guide`: the key of its guide; empty without one.
void parse_floor_contact(MapReader& map, SceneObject& object, const std::string& guide,
                         Diagnostics& diagnostics) {
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
      diagnostics.add(wording::two_ways_to_move(node->span, map.what(), key, guide));
    } else if (!object.mass && !map.has_misspelt({"mass"})) {
      diagnostics.add(wording::moves_without_mass(node->span, map.what(), key));
    }
  }
}

}  // namespace

double not_negative(MapReader& map, const char* key, const Dimension& expected, Diagnostics& diagnostics) {
  const Node* node = map.optional(key);
  if (node == nullptr) return 0.0;
  return parse_positive(*node, expected, map.what() + "'s `" + key + "`", true, diagnostics).value_or(0.0);
}

void parse_guide(MapReader& map, SceneObject& object, Diagnostics& diagnostics) {
  const GuideKind* given = nullptr;
  const Node* node = nullptr;
  for (const GuideKind& kind : guide_kinds) {
    const Node* found = map.optional(kind.key);
    if (found == nullptr) continue;
    if (given != nullptr) {
      diagnostics.add(wording::two_ways_to_move(found->span, map.what(), kind.key, given->key));
      continue;
    }
    given = &kind;
    node = found;
  }
  if (given != nullptr) {
    object.guide = parse_guide_of(*node, *given, map.what(), diagnostics);
    const Node* fixed = map.optional("fixed");
    const Node* motion = map.optional("motion");
    if (motion != nullptr) {
      diagnostics.add(wording::two_ways_to_move(motion->span, map.what(), "motion", given->key));
    } else if (fixed != nullptr && fixed->text == "true") {
      diagnostics.add(wording::two_ways_to_move(fixed->span, map.what(), "fixed", given->key));
    } else if (!object.mass && !map.has_misspelt({"mass"})) {
      diagnostics.add(wording::moves_without_mass(node->span, map.what(), given->key));
    }
  }
  parse_floor_contact(map, object, given == nullptr ? "" : given->key, diagnostics);
}

bool has_guide(const Node& object) {
  return std::any_of(guide_kinds.begin(), guide_kinds.end(),
                     [&object](const GuideKind& kind) { return object.find(kind.key) != nullptr; });
}

TravelOf travel_of(const Node& object) {
  std::vector<std::string> keys{"at", "mass", "slides"};
  for (const GuideKind& kind : guide_kinds) keys.emplace_back(kind.key);
  for (const Entry& entry : object.entries) {
    const std::string meant = meant_key(entry.key.text, keys);
    for (const GuideKind& kind : guide_kinds) {
      if (entry.key.text == kind.key || meant == kind.key)
        return kind.turns ? TravelOf::turning : TravelOf::sliding;
    }
  }
  return TravelOf::nothing;
}

}  // namespace zwang::lang
