#include "robot/robot_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "diagnostic/wordings_standing.hpp"
#include "robot/drive_entry.hpp"
#include "robot/each_wheel.hpp"
#include "robot/feels_entry.hpp"
#include "robot/inertias.hpp"
#include "robot/joint_axes.hpp"
#include "robot/pads_entry.hpp"
#include "spec/parse_task.hpp"
#include "spec/shape.hpp"
#include "words/text.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

namespace {

/// Where a drafted file waits for its owner.
void add_open_places(const Node& node, std::vector<Span>& places) {
  if (node.is_scalar() && node.text == fill_in) places.push_back(node.span);
  for (const Node& item : node.items) add_open_places(item, places);
  for (const Entry& entry : node.entries) add_open_places(entry.value, places);
}

/// `each_has_radius`: a wheel may leave it to `each_wheel`.
WheelText parse_wheel(const Node& node, bool each_has_radius, Diagnostics& diagnostics) {
  WheelText wheel;
  wheel.span = node.span;
  MapReader map(node, "a wheel", diagnostics,
                "{joint: " + (node.is_scalar() ? node.text : "left_wheel") + ", radius: 75 mm}");
  if (const Node* joint = map.required("joint")) wheel.joint = parse_word(*joint, "`joint`", diagnostics);
  const std::string what = "wheel `" + wheel.joint.text + "`";
  wheel.gives_radius = map.node().find("radius") != nullptr;
  if (const Node* radius = each_has_radius ? map.optional("radius") : map.required("radius")) {
    wheel.radius = parse_positive(*radius, dimension::length, what + "'s radius", false, diagnostics);
  }
  if (const Node* roller = map.optional("roller")) {
    wheel.roller = parse_plain(*roller, dimension::angle, what + "'s roller", diagnostics);
    // At 0 deg it would roll away under the wheel's turning: the wheel could drive nothing.
    if (wheel.roller && std::abs(std::sin(*wheel.roller)) < 1e-3) {
      diagnostics.add(wording::roller_angle(roller->span, what));
    }
  }
  if (const Node* drop = map.optional("drop"))
    wheel.drop = parse_positive(*drop, dimension::length, what + "'s drop", true, diagnostics);
  const Node* holds = map.optional("holds");
  wheel.gives_holds = holds != nullptr;
  if (holds != nullptr && require_sequence(*holds, what + "'s `holds`", diagnostics)) {
    wheel.holds_rolling = wheel.holds_sideways = false;
    for (const Node& item : holds->items) {
      if (item.text == "rolling") {
        wheel.holds_rolling = true;
      } else if (item.text == "sideways") {
        wheel.holds_sideways = true;
      } else if (!item.is_bad) {
        diagnostics.add(wording::unknown_direction(item.span, item.text));
      }
    }
    if (map.optional("roller") != nullptr) diagnostics.add(wording::holds_and_roller(holds->span, what));
    if (holds->items.empty()) diagnostics.add(wording::holds_nothing(holds->span, what));
  }
  map.finish();
  return wheel;
}

/// The mapping that the author of `left: 2 N m` may have meant. An entry without a value leaves the effort to
/// the URDF.
std::string actuator_example(const Node& node) {
  if (node.kind == NodeKind::null) return "{}";
  const std::string text = trimmed(node.text);
  const bool is_quantity = node.is_scalar() && parse_quantity(text).error == QuantityError::none;
  return "{effort: " + (is_quantity ? wording::with_unit(text, dimension::torque) : "2 N m") + "}";
}

/// `[left, right]` as a mapping.
std::string actuators_example(const Node& node) {
  std::string line;
  for (const Node& item : node.items) line += (line.empty() ? "" : ", ") + item.text + ": {}";
  return "{" + (line.empty() ? "left_wheel: {}" : line) + "}";
}

/// `26:1` and `1/26` for `26`. Whether it was so.
bool complain_of_ratio(const Node& gear, Diagnostics& diagnostics) {
  const std::size_t sign = gear.text.find_first_of(":/");
  if (gear.is_bad || sign == std::string::npos) return false;
  const QuantityResult first = parse_quantity(trimmed(gear.text.substr(0, sign)));
  const QuantityResult second = parse_quantity(trimmed(gear.text.substr(sign + 1)));
  const double a = first.quantity.value, b = second.quantity.value;
  if (first.error != QuantityError::none || second.error != QuantityError::none || a <= 0.0 || b <= 0.0)
    return false;
  diagnostics.add(wording::gear_as_a_ratio(gear.span, format_number(std::max(a / b, b / a))));
  return true;
}

/// `is_told`: who writes one as a plain number writes all so, and hears of it once.
ActuatorText parse_actuator(const Entry& entry, bool is_told, Diagnostics& diagnostics) {
  ActuatorText actuator;
  actuator.joint = {entry.key.text, entry.key.span};
  const std::string what = "actuator `" + entry.key.text + "`";
  if (!entry.value.is_mapping()) actuator.effort_text = ValueText{};  // given, and not to be read
  if (!entry.value.is_mapping() && is_told) return actuator;
  MapReader map(entry.value, what, diagnostics, actuator_example(entry.value));
  // Whether it is a torque or a force is the joint's to say.
  if (const Node* effort = map.optional("effort")) {
    actuator.effort_text = parse_value(*effort, what + "'s effort", diagnostics);
  }
  if (const Node* slew = map.optional("slew")) {
    actuator.slew_text = parse_value(*slew, what + "'s slew", diagnostics);
  }
  const Node* gear = map.optional("gear");
  if (gear != nullptr && !complain_of_ratio(*gear, diagnostics)) {
    actuator.gear = parse_positive(*gear, dimension::none, what + "'s gear", false, diagnostics);
  }
  if (const Node* inertia = map.optional("rotor_inertia")) {
    actuator.rotor_inertia =
        parse_positive(*inertia, dimension::inertia, what + "'s rotor_inertia", true, diagnostics);
  }
  map.finish();
  return actuator;
}

FrictionText parse_friction(const Entry& entry, Diagnostics& diagnostics) {
  FrictionText friction;
  friction.joint = {entry.key.text, entry.key.span};
  const std::string what = "friction of `" + entry.key.text + "`";
  MapReader map(entry.value, what, diagnostics, "{coulomb: 0.1 N m, compensate: 80 %}");
  // Whether the joint turns or slides is the URDF's to say.
  const auto part = [&](const char* key) -> std::optional<ValueText> {
    const Node* node = map.optional(key);
    if (node == nullptr) return std::nullopt;
    return parse_value(*node, what + ", " + key, diagnostics);
  };
  friction.coulomb = part("coulomb");
  friction.presliding = part("presliding");
  friction.viscous = part("viscous");
  if (const Node* node = map.optional("compensate")) {
    const double fraction =
        parse_positive(*node, dimension::none, what + ", compensate", true, diagnostics).value_or(0.0);
    if (fraction >= 1.0) diagnostics.add(wording::compensation_too_large(node->span, what));
    friction.compensate = fraction;
  }
  map.finish();
  return friction;
}

MimicText parse_mimic(const Entry& entry, Diagnostics& diagnostics) {
  MimicText mimic{{entry.key.text, entry.key.span}};
  const Word word = parse_word(entry.value, "mimic of `" + entry.key.text + "`", diagnostics);
  mimic.is_coupled = word.text == "coupled";
  if (word.exists() && !mimic.is_coupled && word.text != "ignore")
    diagnostics.add(wording::unknown_mimic(word.span, word.text, entry.key.text));
  return mimic;
}

void parse_limits(const Node& node, RobotFile& file, Diagnostics& diagnostics) {
  MapReader map(node, "`limits`", diagnostics);
  for (const solver::Quantity quantity : {solver::Quantity::acceleration, solver::Quantity::velocity}) {
    const Node* axes = map.optional(word_of(quantity));
    if (axes == nullptr) continue;
    const std::string what = std::string("limits.") + word_of(quantity);
    const std::string value =
        wording::with_unit(axes->is_scalar() ? axes->text : "1", dimension_of(solver::Axis::x, quantity));
    MapReader axis_map(*axes, "`" + what + "`", diagnostics, "{x: +-" + value + "}");
    bool is_told = false;  // who writes one limit as a single value writes all so
    for (const char* name : {"x", "y", "rz"}) {
      const Node* range = axis_map.optional(name);
      if (range == nullptr) continue;
      const bool is_single = range->is_scalar() && !range->text.starts_with("+-");
      if (is_single && std::exchange(is_told, true)) continue;
      const solver::Axis axis = *axis_named(name);
      const std::string path = what + "." + name;
      const StatementText text = parse_range(*range, path, diagnostics);
      const Dimension expected = dimension_of(axis, quantity);
      const bool is_good = require_quantity(text.low, expected, path, diagnostics) &&
                           require_quantity(text.high, expected, path, diagnostics);
      if (!is_good) continue;
      const solver::Range values{text.low.quantity.value, text.high.quantity.value};
      if (values.low > 0.0 || values.high < 0.0) {
        diagnostics.add(wording::limit_without_rest(range->span, path));
      } else if (values.low == values.high) {
        diagnostics.add(wording::limit_without_width(range->span, path));
      }
      file.limits.push_back({axis, quantity, values, range->span});
    }
    axis_map.finish();
  }
  map.finish();
}

void parse_stop(const Node& node, RobotFile& file, Diagnostics& diagnostics) {
  MapReader map(node, "`stop`", diagnostics, "{deceleration: 1 m/s^2, force: 80 N}");
  if (const Node* value = map.required("deceleration")) {
    file.stop.deceleration =
        parse_positive(*value, dimension::acceleration, "stop.deceleration", false, diagnostics)
            .value_or(1.0);
  }
  if (const Node* value = map.required("force")) {
    file.stop.force =
        parse_positive(*value, dimension::force, "stop.force", false, diagnostics).value_or(1.0);
  }
  map.finish();
}

void parse_footprint(const Node& node, RobotFile& file, Diagnostics& diagnostics) {
  if (!node.is_mapping() && !node.is_bad) {
    diagnostics.add(wording::footprint_without_polygon(node.span));
    return;
  }
  MapReader map(node, "`footprint`", diagnostics);
  const Node* polygon = map.required("polygon");
  if (polygon != nullptr) {
    file.footprint_span = polygon->span;
    if (const auto corners = parse_polygon(*polygon, "the footprint", diagnostics)) {
      for (const auto& [x, y] : *corners) file.footprint.emplace_back(x, y, 0.0);
      if (corners->size() < 3) diagnostics.add(wording::too_few_corners(polygon->span, "footprint"));
    }
  }
  map.finish();
}

void parse_bumper(const Node& node, RobotFile& file, Diagnostics& diagnostics) {
  MapReader map(node, "`bumper`", diagnostics, "{stiffness: 20 kN/m, height: 0.15 m}");
  if (const Node* value = map.optional("stiffness")) {
    file.bumper_stiffness =
        parse_positive(*value, dimension::stiffness, "bumper.stiffness", false, diagnostics);
  }
  if (const Node* value = map.optional("height")) {
    file.bumper_height = parse_positive(*value, dimension::length, "bumper.height", true, diagnostics);
  }
  map.finish();
}

std::optional<double> parse_control_period(const Node& node, Diagnostics& diagnostics) {
  const auto period = parse_positive(node, dimension::time, "control_period", false, diagnostics);
  if (!period || (*period >= shortest_control_period && *period <= longest_control_period)) return period;
  diagnostics.add(wording::control_period_outside(node.span, *period));
  return std::nullopt;
}

/// The largest step [rad] of an encoder without a warning. While the base slides along a wall, a wheel that
/// the wall holds turns by less than a coarser step. Such a wheel looks like one whose encoder is dead.
/// docs/limits.md has the share of false stops.
constexpr double coarse_encoder_step = 2e-4;

/// Behind the wheels, whose radii say how far a step is.
std::optional<double> parse_encoder_step(const Node& node, const RobotFile& file, Diagnostics& diagnostics) {
  const auto step = parse_positive(node, dimension::angle, "encoder_step", false, diagnostics);
  if (!step) return std::nullopt;
  if (*step > longest_encoder_step) {
    diagnostics.add(wording::encoder_step_outside(node.span, *step));
    return std::nullopt;
  }
  double radius = 0.0;
  for (const WheelText& wheel : file.wheels) radius = std::max(radius, wheel.radius.value_or(0.0));
  if (*step > coarse_encoder_step || blind_steps * *step * radius > least_blind_way)
    diagnostics.add(wording::coarse_encoders(node.span, *step, radius));
  return step;
}

/// Each entry of the mapping below `key`.
template <typename Use>
void for_each_entry(MapReader& map, const char* key, Diagnostics& diagnostics, const Use& use) {
  const Node* node = map.optional(key);
  if (node == nullptr || !require_mapping(*node, "`" + std::string(key) + "`", diagnostics)) return;
  for (const Entry& entry : node->entries) {
    if (!entry.key.is_bad) use(entry);
  }
}

std::vector<Word> parse_words(MapReader& map, const char* key, Diagnostics& diagnostics) {
  std::vector<Word> list;
  const Node* node = map.optional(key);
  const std::string what = std::string("`") + key + "`";
  if (node == nullptr || !require_sequence(*node, what, diagnostics)) return list;
  for (const Node& item : node->items) list.push_back(parse_word(item, what, diagnostics));
  return list;
}

void parse_wheels(MapReader& map, RobotFile& file, Diagnostics& diagnostics) {
  if (const Node* each_wheel = map.optional("each_wheel"))
    file.each_wheel = parse_each_wheel(*each_wheel, diagnostics);
  if (const Node* each_joint = map.optional("each_joint"))
    file.each_joint = parse_each_joint(*each_joint, diagnostics);
  const Node* wheels = map.required("wheels");
  if (wheels == nullptr || !require_sequence(*wheels, "`wheels`", diagnostics)) return;
  for (const Node& item : wheels->items) {
    file.wheels.push_back(parse_wheel(item, file.each_wheel.gives_radius, diagnostics));
    // An author who writes one wheel as a bare name writes all so. One diagnostic is enough.
    if (item.is_scalar()) break;
  }
  if (wheels->items.empty()) diagnostics.add(wording::no_wheels(wheels->span));
}

void parse_actuated(MapReader& map, RobotFile& file, Diagnostics& diagnostics) {
  const Node* actuated = map.required("actuated");
  if (actuated == nullptr ||
      !require_mapping(*actuated, "`actuated`", diagnostics, actuators_example(*actuated)))
    return;
  bool is_told = false;
  for (const Entry& entry : actuated->entries) {
    if (entry.key.is_bad) continue;
    file.actuators.push_back(parse_actuator(entry, is_told, diagnostics));
    is_told = is_told || !entry.value.is_mapping();
  }
}

/// The entries of joints and links besides wheels and motors.
void parse_joints_and_links(MapReader& map, RobotFile& file, Diagnostics& diagnostics) {
  for_each_entry(map, "axes", diagnostics, [&](const Entry& e) {
    if (auto axis = parse_axis_of_joint(e, diagnostics)) file.axes.push_back(std::move(*axis));
  });
  for_each_entry(map, "inertias", diagnostics,
                 [&](const Entry& e) { file.inertias.push_back(parse_inertia(e, diagnostics)); });
  for_each_entry(map, "posture", diagnostics, [&](const Entry& e) {
    file.posture.push_back(
        {{e.key.text, e.key.span}, parse_value(e.value, posture_name(e.key.text), diagnostics)});
  });
}

/// How fast the robot is told and told of, and what it feels.
void parse_control(MapReader& map, RobotFile& file, Diagnostics& diagnostics) {
  if (const Node* period = map.optional("control_period"))
    file.control_period = parse_control_period(*period, diagnostics);
  if (const Node* step = map.optional("encoder_step"))
    file.encoder_step = parse_encoder_step(*step, file, diagnostics);
  if (const Node* drive = map.optional("drive")) {
    file.drive = parse_drive(*drive, diagnostics);
    file.drive_span = drive->span;
  }
  if (const Node* feels = map.optional("feels")) {
    file.drive.feels = parse_feels(*feels, diagnostics);
    file.feels_span = feels->span;
  }
}

}  // namespace

std::string posture_name(const std::string& joint) {
  return "the posture of `" + joint + "`";
}

std::optional<RobotFile> parse_robot_file(const Document& document, Diagnostics& diagnostics) {
  MapReader map(document.root, "a robot file", diagnostics);
  if (!map.is_mapping() || !check_version(map, "zwang_robot", 1, diagnostics)) return std::nullopt;
  std::vector<Span> open;
  add_open_places(document.root, open);
  if (!open.empty()) {
    diagnostics.add(wording::still_to_fill_in(open.front(), {open.begin() + 1, open.end()}));
    return std::nullopt;
  }
  RobotFile file;
  map.optional("based_on");  // what that file says is here already
  if (const Node* urdf = map.required("urdf")) file.urdf = parse_word(*urdf, "`urdf`", diagnostics);
  if (const Node* base = map.required("base")) file.base = parse_word(*base, "`base`", diagnostics);
  if (const Node* lead = map.optional("lead")) file.lead = parse_word(*lead, "`lead`", diagnostics);
  parse_wheels(map, file, diagnostics);
  file.fixed = parse_words(map, "fixed", diagnostics);
  file.turning = parse_words(map, "turns", diagnostics);
  for_each_entry(map, "mimic", diagnostics,
                 [&](const Entry& e) { file.mimics.push_back(parse_mimic(e, diagnostics)); });
  file.ignored = parse_words(map, "ignore", diagnostics);
  file.supports = parse_words(map, "supports", diagnostics);
  parse_actuated(map, file, diagnostics);
  complete_wheels(file, diagnostics);
  parse_joints_and_links(map, file, diagnostics);
  if (const Node* limits = map.optional("limits")) parse_limits(*limits, file, diagnostics);
  if (const Node* stop = map.required("stop")) parse_stop(*stop, file, diagnostics);
  for_each_entry(map, "friction", diagnostics,
                 [&](const Entry& e) { file.friction.push_back(parse_friction(e, diagnostics)); });
  if (const Node* footprint = map.required("footprint")) parse_footprint(*footprint, file, diagnostics);
  if (const Node* bumper = map.optional("bumper")) parse_bumper(*bumper, file, diagnostics);
  parse_control(map, file, diagnostics);
  for_each_entry(map, "pads", diagnostics,
                 [&](const Entry& e) { file.pads.push_back(parse_pad(e, diagnostics)); });
  for_each_entry(map, "frames", diagnostics,
                 [&](const Entry& e) { file.frames.push_back(parse_frame(e, diagnostics)); });
  map.finish();
  return file;
}

}  // namespace zwang::lang
