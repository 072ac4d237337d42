#include <algorithm>
#include <array>
#include <cmath>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_outputs.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/in_one_line.hpp"
#include "spec/parse_task.hpp"
#include "words/nearest.hpp"
#include "words/text.hpp"
#include "zwang/lang/plane.hpp"

namespace zwang::lang {

namespace {

/// The mapping that the author of `door: bool` may have meant.
std::string signal_example(const std::string& type) {
  const std::string age = ", stale_after: 500 ms}";
  if (type == "number") return "{type: number, unit: m" + age;
  if (type == "pose" || type == "wrench") return "{type: " + type + ", in: base_link" + age;
  return "{type: bool" + age;
}

/// `std_msgs/Bool`, `double` and `PoseStamped` in our words.
std::string type_meant(const std::string& written, const std::vector<std::string>& types) {
  const std::string word = lower_case(written.substr(written.rfind('/') + 1));
  for (const std::string& type : types) {
    if (word.starts_with(type)) return type;
  }
  for (const char* number : {"float", "double", "int", "real", "range"}) {
    if (word.starts_with(number)) return "number";
  }
  return nearest(written, types);
}

/// `twist: measured`, or the time over which it is fitted.
void parse_twist(const Node& node, const std::string& what, SignalText& signal, Diagnostics& diagnostics) {
  signal.twist_span = node.span;
  if (node.is_scalar() && trimmed(node.text) == "measured") {
    signal.twist = SignalTwist::measured;
    return;
  }
  const auto window = parse_positive(node, dimension::time, what + "'s `twist`", false, diagnostics);
  if (!window) return;
  signal.twist = SignalTwist::fitted;
  signal.twist_window = *window;
}

/// `unit` of a signal or an output.
std::optional<Unit> parse_unit_of(const Node& node, Diagnostics& diagnostics) {
  std::string unknown;
  const std::optional<Unit> unit = parse_unit(node.text, unknown);
  if (!unit && !node.is_bad)
    diagnostics.add(wording::unknown_unit(node.span, node.text, unknown, nearest_unit(unknown)));
  return unit;
}

SignalText parse_signal(const Entry& entry, Diagnostics& diagnostics) {
  SignalText signal;
  signal.name = parse_name(entry.key, "a signal's name", diagnostics);
  const std::string what = "signal `" + entry.key.text + "`";
  MapReader map(entry.value, what, diagnostics, signal_example(entry.value.text));
  static const std::vector<std::string> types{"bool", "number", "pose", "wrench"};
  if (const Node* type = map.required("type")) {
    signal.type = parse_word(*type, what + "'s `type`", diagnostics);
    const bool is_known = std::find(types.begin(), types.end(), signal.type.text) != types.end();
    if (signal.type.exists() && !is_known) {
      diagnostics.add(wording::unknown_signal_type(type->span, type->text, type_meant(type->text, types)));
      signal.type = {};
    }
  }
  if (const Node* unit = map.optional("unit")) {
    signal.unit = parse_unit_of(*unit, diagnostics);
    signal.is_bad = !signal.unit && !unit->is_bad;
  }
  if (map.has_misspelt({"unit"})) signal.is_bad = true;  // what it measures is not known
  if (const Node* in = map.optional("in")) signal.in = parse_word(*in, what + "'s `in`", diagnostics);
  if (const Node* twist = map.optional("twist")) parse_twist(*twist, what, signal, diagnostics);
  if (const Node* holds = map.optional("holds"))
    signal.holds = parse_word(*holds, what + "'s `holds`", diagnostics);
  const Node* stale = map.optional("stale_after");
  if (stale != nullptr) {
    signal.stale_after = parse_value(*stale, what + "'s `stale_after`", diagnostics);
  } else if (map.is_mapping() && !map.has_misspelt({"stale_after"})) {
    diagnostics.add(wording::signal_without_age(entry.key.span, entry.key.text));
  }
  signal.is_bad = signal.is_bad || !signal.type.exists();
  map.finish();
  return signal;
}

/// `true`, `false` or a number with its unit; a parameter or `here` is none.
std::optional<ValueText> parse_output_value(const Node& node, const std::string& what,
                                            Diagnostics& diagnostics) {
  const ValueText value = parse_value(node, what, diagnostics);
  if (value.kind == ValueKind::bad) return std::nullopt;
  return value;
}

OutputText parse_output(const Entry& entry, Diagnostics& diagnostics) {
  OutputText output;
  output.name = parse_name(entry.key, "an output's name", diagnostics);
  const std::string what = "output `" + entry.key.text + "`";
  MapReader map(entry.value, what, diagnostics, "{type: bool, stop: keep}");
  if (const Node* type = map.required("type")) {
    const std::string word = parse_word(*type, what + "'s `type`", diagnostics).text;
    output.is_number = word == "number";
    output.is_bad = word != "number" && word != "bool";
    if (output.is_bad && !word.empty())
      diagnostics.add(wording::unknown_name(type->span, "type of output", word, {"bool", "number"}));
  }
  if (const Node* unit = map.optional("unit")) {
    output.unit = parse_unit_of(*unit, diagnostics);
    output.is_bad = output.is_bad || !output.unit;
  }
  if (const Node* start = map.optional("start"))
    output.start = parse_output_value(*start, what + "'s `start`", diagnostics);
  const Node* stop = map.optional("stop");
  if (stop != nullptr) {
    output.keeps = stop->is_scalar() && trimmed(stop->text) == "keep";
    if (!output.keeps) output.stop = parse_output_value(*stop, what + "'s `stop`", diagnostics);
  } else if (map.is_mapping() && !map.has_misspelt({"stop"})) {
    diagnostics.add(wording::output_without_stop(entry.key.span, entry.key.text));
  }
  output.is_bad = output.is_bad || !map.is_mapping() || map.has_unread_keys();
  map.finish();
  return output;
}

RegionText parse_region(const Entry& entry, Diagnostics& diagnostics) {
  RegionText region;
  region.name = parse_name(entry.key, "a region's name", diagnostics);
  const std::string what = "region `" + entry.key.text + "`";
  const std::string listed = entry.value.is_sequence() && !entry.value.items.empty()
                                 ? in_one_line(entry.value, dimension::length)
                                 : "[[0 m, 0 m], [2 m, 0 m], [2 m, 1 m]]";
  MapReader map(entry.value, what, diagnostics, "{polygon: " + listed + "}");
  const Node* polygon = map.optional("polygon");
  const Node* circle = map.optional("circle");
  if (const Node* parent = map.optional("parent")) {
    region.parent = parse_word(*parent, what + "'s `parent`", diagnostics);
  }
  const bool is_one = (polygon != nullptr) != (circle != nullptr);
  if (map.is_mapping() && !is_one && (polygon != nullptr || !map.has_unread_keys())) {
    diagnostics.add(wording::one_region_shape(entry.key.span, what));
  } else if (const auto corners =
                 polygon != nullptr ? parse_polygon(*polygon, what, diagnostics) : std::nullopt) {
    double area = 0.0;
    region.polygon = *corners;
    const auto& p = region.polygon;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto& next = p[(i + 1) % p.size()];
      area += 0.5 * (p[i][0] * next[1] - next[0] * p[i][1]);
    }
    if (p.size() < 3 || std::abs(area) < 1e-6) {
      diagnostics.add(wording::flat_region(polygon->span, what));
    } else if (plane::crosses_itself(p)) {
      diagnostics.add(wording::crossing_edges("E410", polygon->span, what));
    }
    if (area < 0.0) std::reverse(region.polygon.begin(), region.polygon.end());
  } else if (circle != nullptr) {
    MapReader circle_map(*circle, what + "'s circle", diagnostics);
    const Node* at = circle_map.required("at");
    const Node* radius = circle_map.required("radius");
    if (at != nullptr && radius != nullptr && count_bare_numbers(*at) > 0 &&
        count_bare_numbers(*radius) > 0) {
      diagnostics.add(
          wording::needs_units(circle->span, what + "'s circle", in_one_line(*circle, dimension::length)));
      at = radius = nullptr;
    }
    if (at != nullptr) {
      if (const auto centre = parse_place(*at, what + "'s centre", "", diagnostics)) region.centre = *centre;
    }
    if (radius != nullptr) {
      region.radius =
          parse_positive(*radius, dimension::length, what + "'s radius", false, diagnostics).value_or(1.0);
    }
    circle_map.finish();
  }
  map.finish();
  return region;
}

/// `hook` or `hook.x`.
Word parse_end(const Node& node, const std::string& what, std::optional<solver::Axis>* axis,
               Diagnostics& diagnostics) {
  Word word = parse_word(node, what, diagnostics);
  if (axis == nullptr || !word.exists()) return word;
  const std::size_t dot = word.text.rfind('.');
  if (dot != std::string::npos) *axis = axis_named(word.text.substr(dot + 1));
  if (!*axis || is_rotation(**axis)) {
    diagnostics.add(wording::not_an_axis_of_a_frame(node.span, word.text));
    return {};
  }
  word.text.resize(dot);
  return word;
}

FeatureText parse_feature(const Entry& entry, Diagnostics& diagnostics) {
  FeatureText feature;
  feature.name = parse_name(entry.key, "a feature's name", diagnostics);
  const std::string what = "feature `" + entry.key.text + "`";
  const std::string listed =
      entry.value.items.size() == 2 ? in_one_line(entry.value, dimension::none) : "[base_link, goal]";
  MapReader map(entry.value, what, diagnostics, "{distance: " + listed + "}");
  const Node* distance = map.optional("distance");
  const Node* angle = map.optional("angle");
  const Node* direction = map.optional("direction");
  const Node* bearing = map.optional("bearing");
  const int count = (distance != nullptr ? 1 : 0) + (angle != nullptr ? 1 : 0) +
                    (direction != nullptr ? 1 : 0) + (bearing != nullptr ? 1 : 0);
  if (map.is_mapping() && count != 1 && (count > 1 || !map.has_unread_keys())) {
    diagnostics.add(wording::one_feature_kind(entry.key.span, what));
    feature.is_bad = true;
  } else if (count == 0) {
    feature.is_bad = true;  // which kind it is to be is not known
  } else if (direction != nullptr) {
    feature.kind = FeatureKind::direction;
    MapReader direction_map(*direction, what + "'s direction", diagnostics);
    if (const Node* move = direction_map.required("move")) {
      feature.first = parse_word(*move, "`move`", diagnostics);
    }
    if (const Node* in = direction_map.required("in")) feature.second = parse_word(*in, "`in`", diagnostics);
    bool is_zero = true;
    for (const char* name : {"x", "y", "z", "rx", "ry", "rz"}) {
      const Node* node = direction_map.optional(name);
      if (node == nullptr) continue;
      const double value = parse_plain(*node, dimension::none, what + "." + name, diagnostics).value_or(1.0);
      feature.direction[static_cast<std::size_t>(*axis_named(name))] = value;
      is_zero = is_zero && value == 0.0;
    }
    if (is_zero) diagnostics.add(wording::feature_without_direction(direction->span, what));
    direction_map.finish();
  } else if (const Node* ends = distance != nullptr  ? distance
                                : bearing != nullptr ? bearing
                                                     : angle;
             ends != nullptr) {
    feature.kind = distance != nullptr  ? FeatureKind::distance
                   : bearing != nullptr ? FeatureKind::bearing
                                        : FeatureKind::angle;
    const bool is_angle = feature.kind == FeatureKind::angle;
    if (require_sequence(*ends, what, diagnostics)) {
      if (ends->items.size() != 2) {
        diagnostics.add(wording::wrong_count(ends->span, what, 2, 2, ends->items.size()));
        feature.is_bad = true;
      } else {
        feature.first =
            parse_end(ends->items[0], what, is_angle ? &feature.first_axis : nullptr, diagnostics);
        feature.second =
            parse_end(ends->items[1], what, is_angle ? &feature.second_axis : nullptr, diagnostics);
      }
    }
  }
  map.finish();
  return feature;
}

template <typename Item>
std::vector<Item> parse_each(const Node& node, const char* what, Item (*parse)(const Entry&, Diagnostics&),
                             Diagnostics& diagnostics) {
  std::vector<Item> items;
  if (!require_mapping(node, what, diagnostics)) return items;
  for (const Entry& entry : node.entries) {
    if (!entry.key.is_bad) items.push_back(parse(entry, diagnostics));
  }
  return items;
}

}  // namespace

std::vector<SignalText> parse_signals(const Node& node, Diagnostics& diagnostics) {
  return parse_each(node, "`signals`", parse_signal, diagnostics);
}

std::vector<OutputText> parse_outputs(const Node& node, Diagnostics& diagnostics) {
  return parse_each(node, "`outputs`", parse_output, diagnostics);
}

std::vector<RegionText> parse_regions(const Node& node, Diagnostics& diagnostics) {
  return parse_each(node, "`regions`", parse_region, diagnostics);
}

std::vector<FeatureText> parse_features(const Node& node, Diagnostics& diagnostics) {
  return parse_each(node, "`features`", parse_feature, diagnostics);
}

}  // namespace zwang::lang
