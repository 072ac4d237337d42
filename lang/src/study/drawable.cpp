#include "study/drawable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "diagnostic/wordings_physics.hpp"
#include "scene/load_signals.hpp"
#include "words/text.hpp"
#include "words/units.hpp"
#include "zwang/lang/fault_word.hpp"

namespace zwang::lang {

namespace {

/// A number of a scene's part that may be drawn, with the values that a scene file takes.
template <typename Owner>
struct DrawnNumber {
  const char* key;
  Dimension dimension;
  bool may_be_zero;
  bool may_be_negative;
  double* (*find)(Owner&);  ///< null where the owner does not have it
  double most = std::numeric_limits<double>::infinity();
};

constexpr double most_dropouts = 1.0 - 0x1p-53;  // a signal of which every sample is lost is none
constexpr bool at_zero = true, not_at_zero = false, signed_too = true, positive = false;

constexpr std::array object_numbers{
    DrawnNumber<SceneObject>{"stiffness", dimension::stiffness, not_at_zero, positive,
                             [](SceneObject& o) { return &o.stiffness; }},
    DrawnNumber<SceneObject>{"damping", dimension::none, at_zero, positive,
                             [](SceneObject& o) { return &o.damping; }},
    DrawnNumber<SceneObject>{"friction", dimension::none, at_zero, positive,
                             [](SceneObject& o) { return o.friction ? &*o.friction : nullptr; }},
    DrawnNumber<SceneObject>{"mass", dimension::mass, not_at_zero, positive,
                             [](SceneObject& o) { return o.mass ? &*o.mass : nullptr; }},
    DrawnNumber<SceneObject>{"x", dimension::length, at_zero, signed_too,
                             [](SceneObject& o) { return o.motion.empty() ? &o.at[0] : nullptr; }},
    DrawnNumber<SceneObject>{"y", dimension::length, at_zero, signed_too,
                             [](SceneObject& o) { return o.motion.empty() ? &o.at[1] : nullptr; }},
    DrawnNumber<SceneObject>{"yaw", dimension::angle, at_zero, signed_too,
                             [](SceneObject& o) { return o.motion.empty() ? &o.yaw : nullptr; }},
};

constexpr std::array partner_numbers{
    DrawnNumber<SceneRobot>{"stiffness", dimension::stiffness, not_at_zero, positive,
                            [](SceneRobot& r) { return &r.stiffness; }},
    DrawnNumber<SceneRobot>{"damping", dimension::none, at_zero, positive,
                            [](SceneRobot& r) { return &r.damping; }},
    DrawnNumber<SceneRobot>{"friction", dimension::none, at_zero, positive,
                            [](SceneRobot& r) { return r.friction ? &*r.friction : nullptr; }},
    DrawnNumber<SceneRobot>{"x", dimension::length, at_zero, signed_too,
                            [](SceneRobot& r) { return &r.at[0]; }},
    DrawnNumber<SceneRobot>{"y", dimension::length, at_zero, signed_too,
                            [](SceneRobot& r) { return &r.at[1]; }},
    DrawnNumber<SceneRobot>{"yaw", dimension::angle, at_zero, signed_too,
                            [](SceneRobot& r) { return &r.yaw; }},
};

constexpr std::array state_numbers{
    DrawnNumber<StateNoise>{"delay", dimension::time, at_zero, positive,
                            [](StateNoise& s) { return &s.delay; }, longest_state_delay},
    DrawnNumber<StateNoise>{"position", dimension::length, at_zero, positive,
                            [](StateNoise& s) { return s.wheels_only ? nullptr : &s.position; }},
    DrawnNumber<StateNoise>{"yaw", dimension::angle, at_zero, positive,
                            [](StateNoise& s) { return s.wheels_only ? nullptr : &s.yaw; }},
    DrawnNumber<StateNoise>{"velocity", dimension::velocity, at_zero, positive,
                            [](StateNoise& s) { return s.wheels_only ? nullptr : &s.velocity; }},
    DrawnNumber<StateNoise>{"turn", dimension::angular_velocity, at_zero, positive,
                            [](StateNoise& s) { return s.wheels_only ? nullptr : &s.turn; }},
};

bool is_seen(const SceneSignal& signal) {
  return signal.kind == SceneSignalKind::pose || signal.kind == SceneSignalKind::distance;
}

bool measures_force(const SceneSignal& signal) {
  return signal.kind == SceneSignalKind::force || signal.kind == SceneSignalKind::wrench;
}

double* noise_of(SceneSignal& signal) {
  return is_seen(signal) || measures_force(signal) ? &signal.noise : nullptr;
}

constexpr std::array signal_numbers{
    DrawnNumber<SceneSignal>{"delay", dimension::time, at_zero, positive,
                             [](SceneSignal& s) { return &s.delay; }, longest_delay},
    DrawnNumber<SceneSignal>{"period", dimension::time, at_zero, positive,
                             [](SceneSignal& s) { return &s.period; }},
    DrawnNumber<SceneSignal>{"dropouts", dimension::none, at_zero, positive,
                             [](SceneSignal& s) { return &s.dropouts; }, most_dropouts},
    DrawnNumber<SceneSignal>{
        "angle_noise", dimension::angle, at_zero, positive,
        [](SceneSignal& s) { return s.kind == SceneSignalKind::pose ? &s.angle_noise : nullptr; }},
    DrawnNumber<SceneSignal>{
        "bias", dimension::force, at_zero, signed_too,
        [](SceneSignal& s) { return s.kind == SceneSignalKind::force ? &s.bias : nullptr; }},
};

/// A number of the simulated robot that differs from the task's during the whole run.
struct RobotNumber {
  const char* key;
  Dimension dimension;
  bool is_factor;
};
constexpr std::array robot_numbers{RobotNumber{"mass", dimension::none, true},
                                   RobotNumber{"payload", dimension::mass, false},
                                   RobotNumber{"inertia", dimension::none, true},
                                   RobotNumber{"centre_of_mass", dimension::length, false},
                                   RobotNumber{"friction", dimension::none, true},
                                   RobotNumber{"wheel_radius", dimension::none, true},
                                   RobotNumber{"encoder_step", dimension::angle, false},
                                   RobotNumber{"encoder_noise", dimension::angle, false}};

template <typename Number, std::size_t N>
const Number* number_named(const std::array<Number, N>& numbers, const std::string& key) {
  const auto found =
      std::find_if(numbers.begin(), numbers.end(), [&](const Number& n) { return key == n.key; });
  return found == numbers.end() ? nullptr : &*found;
}

const RobotNumber* robot_number(const std::string& key) {
  return number_named(robot_numbers, key);
}

/// The dimension of a drawn number, and the values that it can have.
struct NumberRange {
  Dimension dimension;
  bool may_be_zero, may_be_negative;
  double most = std::numeric_limits<double>::infinity();
};

/// As it stands in the scene: `Use` is called with the number's range and its place.
template <typename Use>
bool visit_number(const Drawable& d, Scene& scene, const Use& use) {
  const auto visit = [&](const auto& numbers, auto& owner) {
    const auto* number = number_named(numbers, d.key);
    double* place = number != nullptr ? number->find(owner) : nullptr;
    if (place == nullptr) return false;
    use(NumberRange{number->dimension, number->may_be_zero, number->may_be_negative, number->most}, *place);
    return true;
  };
  if (d.part == DrawnPart::floor) {
    use(NumberRange{dimension::none, not_at_zero, positive}, scene.floor_friction);
    return true;
  }
  if (d.part == DrawnPart::state) return visit(state_numbers, scene.state);
  if (d.part == DrawnPart::signal) {
    for (SceneSignal& signal : scene.signals) {
      if (signal.name != d.owner) continue;
      if (d.key != "noise") return visit(signal_numbers, signal);
      double* noise = noise_of(signal);
      if (noise == nullptr) return false;
      use(NumberRange{measures_force(signal) ? dimension::force : dimension::length, at_zero, positive},
          *noise);
      return true;
    }
    return false;
  }
  for (SceneObject& object : scene.objects) {
    if (object.name == d.owner) return visit(object_numbers, object);
  }
  for (SceneRobot& robot : scene.robots) {
    if (robot.name == d.owner) return visit(partner_numbers, robot);
  }
  return false;
}

std::optional<Dimension> dimension_of_parameter(const std::string& name, const Program& program) {
  for (const Parameter& parameter : program.parameters) {
    if (parameter.name != name) continue;
    std::string unknown;
    const auto unit = parse_unit(parameter.unit, unknown);
    return unit ? unit->dimension : dimension::none;
  }
  return std::nullopt;
}

Fault whole_run(FaultKind kind, double value) {
  Fault fault;
  fault.kind = kind;
  fault.value = value;
  fault.is_drawn = true;
  return fault;
}

/// Why the robot cannot differ so, in the words of a study.
std::optional<BadValue> bad_robot_value(const RobotNumber& number, double value, const Program& program) {
  const std::string name = std::string("`robot.") + number.key + "`";
  const std::string key = number.key;
  if (number.is_factor && !(value > 0.0))
    return BadValue{name + " cannot be " + wording::figure(value, "") + ": a factor is above 0",
                    "draw factors around 1, all above 0"};
  const bool is_of_encoders = key == "encoder_step" || key == "encoder_noise";
  if (is_of_encoders && !(value >= 0.0 && value <= longest_encoder_step))
    return BadValue{name + " cannot be " + wording::figure(value, "rad"),
                    "draw from 0 rad to " + wording::figure(longest_encoder_step, "rad")};
  const double least = key == "mass" ? 1.0 - most_payload_less : 1.0 - most_inertia_less;
  if ((key == "mass" || key == "inertia") && value < least)
    return BadValue{
        name + " cannot be " + wording::figure(value, "") + ": at least " + wording::figure(least, "") +
            " times the base link's own has to stay",
        "draw factors from " + wording::figure(least, "") + " on; a `normal` draw goes far below its mean"};
  const double mass = program.robot.model.bodies().front().inertia.mass;
  if (key == "payload" && value < -most_payload_less * mass)
    return BadValue{name + " cannot be " + wording::figure(value, "kg") + ": the base link has " +
                        wording::figure(mass, "kg") + ", and a quarter of it has to stay",
                    "draw from -" + wording::at_most(most_payload_less * mass, "kg") + " on"};
  return std::nullopt;
}

/// Of a kind of fault the simulation takes one: a second would be without an effect.
std::optional<BadValue> act_all_along(const std::string& key, FaultKind kind, double value, Program& program,
                                      const ScenarioCell& cell) {
  std::vector<Fault>& faults = program.scene->faults;
  const auto is_same = [&](const Fault& fault) { return fault.kind == kind; };
  if (std::ranges::any_of(faults, is_same) || std::ranges::any_of(cell.faults, is_same))
    return BadValue{"`robot." + key + "`: the run has another `" +
                        (kind == FaultKind::payload ? "payload" : key) + "`, and the simulation takes one",
                    "draw one of the two, or delete the fault"};
  faults.push_back(whole_run(kind, value));
  return std::nullopt;
}

std::optional<BadValue> put_into_robot(const std::string& key, double value, Program& program,
                                       ScenarioCell& cell) {
  const RobotNumber* number = robot_number(key);
  if (number == nullptr) return std::nullopt;
  if (auto bad = bad_robot_value(*number, value, program)) return bad;
  const double mass = program.robot.model.bodies().front().inertia.mass;
  if (key == "mass") return act_all_along(key, FaultKind::payload, (value - 1.0) * mass, program, cell);
  if (key == "payload") return act_all_along(key, FaultKind::payload, value, program, cell);
  if (key == "inertia") return act_all_along(key, FaultKind::inertia, value - 1.0, program, cell);
  if (key == "centre_of_mass") return act_all_along(key, FaultKind::centre_of_mass, value, program, cell);
  RobotDeviation& deviation = cell.deviation;
  if (key == "friction") deviation.friction = value;
  if (key == "wheel_radius") deviation.wheel_radius = value;
  if (key == "encoder_step") deviation.encoder_step = value;
  if (key == "encoder_noise") deviation.encoder_noise = value;
  return std::nullopt;
}

}  // namespace

std::optional<Drawable> drawable_named(const std::string& name) {
  if (is_parameter(name)) return Drawable{.part = DrawnPart::parameter, .key = name.substr(7)};
  const std::vector<std::string> parts = split_at_dots(name);
  const std::string& first = parts.front();
  if (parts.size() == 2) {
    for (const auto& [word, part] :
         {std::pair{"start", DrawnPart::start}, {"robot", DrawnPart::robot}, {"state", DrawnPart::state}}) {
      if (first == word) return Drawable{.part = part, .key = parts[1]};
    }
  }
  if (parts.size() != 3) return std::nullopt;
  for (const auto& [word, part] :
       {std::pair{"faults", DrawnPart::onset}, {"scene", DrawnPart::thing}, {"signals", DrawnPart::signal}}) {
    if (first != word) continue;
    return Drawable{
        .part = name == "scene.floor.friction" ? DrawnPart::floor : part, .owner = parts[1], .key = parts[2]};
  }
  return std::nullopt;
}

std::optional<Drawable> find_drawable(const std::string& name, const ScenarioFile& file,
                                      const Program& program) {
  std::optional<Drawable> drawable = drawable_named(name);
  if (!drawable) return std::nullopt;
  std::optional<Dimension> measures;
  if (drawable->part == DrawnPart::parameter) {
    measures = dimension_of_parameter(drawable->key, program);
  } else if (drawable->part == DrawnPart::start) {
    if (drawable->key == "x" || drawable->key == "y") measures = dimension::length;
    if (drawable->key == "yaw") measures = dimension::angle;
  } else if (drawable->part == DrawnPart::onset) {
    const auto is_named = [&](const FaultSet& set) { return set.name == drawable->owner; };
    const bool is_there = std::any_of(file.faults.begin(), file.faults.end(), is_named);
    if (is_there && drawable->key == "at") measures = dimension::time;
  } else if (drawable->part == DrawnPart::robot) {
    if (const RobotNumber* number = robot_number(drawable->key)) {
      measures = number->dimension;
      drawable->is_factor_only = drawable->can_be_factor = number->is_factor;
    }
  } else if (program.scene) {
    Scene scene = *program.scene;
    drawable->can_be_factor = true;
    visit_number(*drawable, scene, [&](const NumberRange& range, double) { measures = range.dimension; });
  }
  if (!measures) return std::nullopt;
  drawable->dimension = *measures;
  return drawable;
}

std::vector<std::string> drawable_names(const ScenarioFile& file, const Program& program) {
  std::vector<std::string> names{"start.x", "start.y", "start.yaw", "robot", "scene", "faults"};
  for (const Parameter& parameter : program.parameters) names.push_back("params." + parameter.name);
  for (const RobotNumber& number : robot_numbers) names.push_back(std::string("robot.") + number.key);
  for (const FaultSet& set : file.faults) names.push_back("faults." + set.name + ".at");
  if (!program.scene) return names;
  names.emplace_back("scene.floor.friction");
  std::vector<std::string> candidates;
  for (const SceneObject& object : program.scene->objects) {
    for (const auto& number : object_numbers) candidates.push_back("scene." + object.name + "." + number.key);
  }
  for (const SceneRobot& robot : program.scene->robots) {
    for (const auto& number : partner_numbers) candidates.push_back("scene." + robot.name + "." + number.key);
  }
  for (const auto& number : state_numbers) candidates.push_back(std::string("state.") + number.key);
  for (const SceneSignal& signal : program.scene->signals) {
    candidates.push_back("signals." + signal.name + ".noise");
    for (const auto& number : signal_numbers)
      candidates.push_back("signals." + signal.name + "." + number.key);
  }
  for (std::string& name : candidates) {
    if (find_drawable(name, file, program)) names.push_back(std::move(name));
  }
  return names;
}

void put_before(const Draw& draw, double value, const std::array<double, 2>& start_at, ScenarioCell& cell) {
  const std::optional<Drawable> drawable = drawable_named(draw.name);
  if (drawable->part == DrawnPart::parameter)
    cell.parameters[drawable->key] = format_number(value) + (draw.unit.empty() ? "" : " " + draw.unit);
  if (drawable->part == DrawnPart::start && drawable->key == "yaw") {
    cell.start_yaw = value;
  } else if (drawable->part == DrawnPart::start) {
    if (!cell.start_at) cell.start_at = start_at;
    (*cell.start_at)[drawable->key == "x" ? 0 : 1] = value;
  }
  if (drawable->part != DrawnPart::onset || cell.fault_set != drawable->owner || cell.faults.empty()) return;
  double first = cell.faults.front().at;
  for (const Fault& fault : cell.faults) first = std::min(first, fault.at);
  for (Fault& fault : cell.faults) fault.at += value - first;
}

std::optional<BadValue> put_after(const Draw& draw, double value, Program& program, ScenarioCell& cell) {
  const std::optional<Drawable> drawable = drawable_named(draw.name);
  const std::string name = "`" + draw.name + "`";
  if (drawable->part == DrawnPart::onset && value < 0.0)
    return BadValue{name + " cannot be " + wording::figure(value, "s"), "let the range begin at 0"};
  if (drawable->part < DrawnPart::robot || !program.scene) return std::nullopt;
  if (drawable->part == DrawnPart::robot) return put_into_robot(drawable->key, value, program, cell);
  std::optional<BadValue> bad =
      BadValue{"the scene of this cell has no " + name, "draw what each scene of the study has"};
  const auto put = [&](const NumberRange& range, double& place) {
    const double number = draw.is_factor ? value * place : value;
    bad.reset();
    if (!range.may_be_negative && (number < 0.0 || (number == 0.0 && !range.may_be_zero)))
      bad = BadValue{name + " cannot be " + wording::figure(value, draw.unit),
                     range.may_be_zero ? "let the range begin at 0" : "let the range begin above 0"};
    if (number > range.most)
      bad = BadValue{name + " cannot be " + wording::figure(value, draw.unit),
                     "let the range end below " + wording::figure(range.most, draw.unit)};
    if (!bad) place = number;
  };
  visit_number(*drawable, *program.scene, put);
  return bad;
}

std::optional<std::string> missing_number(const std::string& name, const Program& program) {
  const std::optional<Drawable> drawable = drawable_named(name);
  if (!drawable || !program.scene) return std::nullopt;
  const auto has = [&](const auto& owners, const auto& numbers) {
    return number_named(numbers, drawable->key) != nullptr &&
           std::any_of(owners.begin(), owners.end(),
                       [&](const auto& o) { return o.name == drawable->owner; });
  };
  const Scene& scene = *program.scene;
  const bool is_of_scene = drawable->part == DrawnPart::thing &&
                           (has(scene.objects, object_numbers) || has(scene.robots, partner_numbers));
  const bool is_of_signal = drawable->part == DrawnPart::signal && has(scene.signals, signal_numbers);
  if (drawable->part == DrawnPart::state && number_named(state_numbers, drawable->key) != nullptr)
    return "`" + name + "` is not measured in the scene: the robot knows where it is from its wheels alone";
  if (!is_of_scene && !is_of_signal) return std::nullopt;
  return "`" + drawable->owner + "` has no `" + drawable->key +
         "` in the scene: nothing is there to be drawn";
}

}  // namespace zwang::lang
