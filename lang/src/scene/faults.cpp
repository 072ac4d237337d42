#include "scene/faults.hpp"

#include <algorithm>
#include <array>

#include "diagnostic/nearest.hpp"
#include "diagnostic/wordings.hpp"
#include "spec/shape.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

namespace {

struct FaultWord {
  const char* key;
  const char* word;
  FaultKind kind;
};
constexpr std::array words{
    FaultWord{"samples", "lost", FaultKind::samples_lost},
    FaultWord{"samples", "nan", FaultKind::samples_nan},
    FaultWord{"samples", "frozen", FaultKind::samples_frozen},
    FaultWord{"clock", "backwards", FaultKind::clock_backwards},
    FaultWord{"torque", "lost", FaultKind::torque_lost},
    FaultWord{"torque", "stuck", FaultKind::torque_stuck},
    FaultWord{"torque", "flipped", FaultKind::torque_flipped},
    FaultWord{"plant", "diverges", FaultKind::plant_diverges},
};

/// What `key` says, one of its words.
void parse_word_of(const char* key, const Node& node, Fault& fault, int& found, Diagnostics& diagnostics) {
  ++found;
  std::vector<std::string> known;
  for (const FaultWord& word : words) {
    if (std::string_view(word.key) != key) continue;
    known.emplace_back(word.word);
    if (node.text != word.word) continue;
    fault.kind = word.kind;
    return;
  }
  if (!node.is_bad) diagnostics.add(wording::unknown_fault(node.span, key, node.text, known));
}

double positive(const Node& node, const Dimension& expected, const std::string& what, bool zero_allowed,
                Diagnostics& diagnostics) {
  const double value = parse_plain(node, expected, what, diagnostics).value_or(1.0);
  if (value < 0.0 || (value == 0.0 && !zero_allowed))
    diagnostics.add(wording::not_positive(node.span, what, zero_allowed));
  return value;
}

Fault parse_fault(const Node& node, Diagnostics& diagnostics) {
  Fault fault;
  fault.span = node.span;
  MapReader map(node, "a fault", diagnostics);
  if (!map.is_mapping()) return fault;
  if (const Node* at = map.required("at"))
    fault.at = positive(*at, dimension::time, "a fault's `at`", true, diagnostics);
  if (const Node* length = map.optional("for"))
    fault.duration = positive(*length, dimension::time, "a fault's `for`", false, diagnostics);
  const Node* wheel = map.optional("wheel");
  if (wheel != nullptr) {
    fault.joint = parse_word(*wheel, "`wheel`", diagnostics).text;
    fault.joint_span = wheel->span;
  }
  const Node* robot = map.optional("robot");
  if (robot != nullptr) {
    fault.robot = parse_word(*robot, "`robot`", diagnostics).text;
    fault.robot_span = robot->span;
  }
  int found = 0;
  for (const char* key : {"samples", "clock", "torque", "plant"}) {
    if (const Node* word = map.optional(key)) parse_word_of(key, *word, fault, found, diagnostics);
  }
  if (const Node* friction = map.optional("floor_friction")) {
    ++found;
    fault.kind = FaultKind::floor_friction;
    fault.value = positive(*friction, dimension::none, "`floor_friction`", false, diagnostics);
  }
  if (const Node* payload = map.optional("payload")) {
    ++found;
    fault.kind = FaultKind::payload;
    fault.value = positive(*payload, dimension::mass, "`payload`", false, diagnostics);
  }
  const bool names_wheel = fault.kind == FaultKind::torque_lost || fault.kind == FaultKind::torque_stuck ||
                           fault.kind == FaultKind::torque_flipped;
  if (found != 1 && !map.has_unread_keys()) diagnostics.add(wording::one_fault(node.span));
  if (found == 1 && names_wheel && wheel == nullptr) map.required("wheel");
  if (found == 1 && !names_wheel && wheel != nullptr) diagnostics.add(wording::one_fault(node.span));
  const bool is_the_worlds =
      fault.kind == FaultKind::floor_friction || fault.kind == FaultKind::plant_diverges;
  if (found == 1 && is_the_worlds && robot != nullptr) diagnostics.add(wording::fault_of_all(robot->span));
  map.finish();
  return fault;
}

void check_motor(const Fault& fault, const Robot& robot, Diagnostics& diagnostics) {
  if (fault.joint.empty()) return;
  std::vector<std::string> motors;
  for (int j = 0; j < robot.model.joint_count(); ++j) {
    const solver::Joint& joint = robot.model.joint(j);
    if (!joint.actuated) continue;
    if (joint.name == fault.joint) return;
    motors.push_back(joint.name);
  }
  diagnostics.add(
      wording::unknown_name(fault.joint_span, "motor", fault.joint, nearest(fault.joint, motors)));
}

}  // namespace

std::vector<Fault> parse_faults(const Node& node, Diagnostics& diagnostics) {
  std::vector<Fault> faults;
  if (!require_sequence(node, "`faults`", diagnostics)) return faults;
  for (const Node& item : node.items) faults.push_back(parse_fault(item, diagnostics));
  return faults;
}

void check_faults_of_partners(const std::vector<Fault>& faults, const Scene& scene,
                              Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const SceneRobot& robot : scene.robots) names.push_back(robot.name);
  for (const Fault& fault : faults) {
    if (fault.robot.empty()) continue;
    const auto named = std::find(names.begin(), names.end(), fault.robot);
    if (named == names.end()) {
      diagnostics.add(
          wording::unknown_name(fault.robot_span, "robot", fault.robot, nearest(fault.robot, names)));
      continue;
    }
    const SceneRobot& robot = scene.robots[static_cast<std::size_t>(named - names.begin())];
    if (robot.program) check_motor(fault, robot.program->robot, diagnostics);
  }
}

void check_faults_of(const std::vector<Fault>& faults, const Robot& robot, Diagnostics& diagnostics) {
  for (const Fault& fault : faults) {
    if (fault.robot.empty()) check_motor(fault, robot, diagnostics);
  }
}

}  // namespace zwang::lang
