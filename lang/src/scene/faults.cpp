#include "scene/faults.hpp"

#include "diagnostic/wordings.hpp"
#include "spec/shape.hpp"
#include "zwang/lang/fault_word.hpp"

namespace zwang::lang {

namespace {

/// Reads the value of `key`, which has to be one of the key's words.
void parse_word_of(const char* key, const Node& node, Fault& fault, int& found, Diagnostics& diagnostics) {
  ++found;
  std::vector<std::string> known;
  for (const FaultWord& word : fault_words) {
    if (std::string_view(word.key) != key) continue;
    known.emplace_back(word.word);
    if (node.text != word.word) continue;
    fault.kind = word.kind;
    return;
  }
  if (!node.is_bad) diagnostics.add(wording::unknown_fault(node.span, key, node.text, known));
}

Fault parse_fault(const Node& node, bool of_run, Diagnostics& diagnostics) {
  Fault fault;
  fault.span = node.span;
  MapReader map(node, "a fault", diagnostics);
  if (!map.is_mapping()) return fault;
  if (const Node* at = map.required("at"))
    fault.at = parse_positive(*at, dimension::time, "a fault's `at`", true, diagnostics).value_or(1.0);
  if (const Node* of = of_run ? map.optional("of") : nullptr) {
    fault.of = parse_word(*of, "a fault's `of`", diagnostics).text;
    fault.of_span = of->span;
  }
  const Node* length = map.optional("for");
  if (length != nullptr)
    fault.duration =
        parse_positive(*length, dimension::time, "a fault's `for`", false, diagnostics).value_or(1.0);
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
    fault.value =
        parse_positive(*friction, dimension::none, "`floor_friction`", false, diagnostics).value_or(1.0);
  }
  if (const Node* payload = map.optional("payload")) {
    ++found;
    fault.kind = FaultKind::payload;
    fault.value = parse_plain(*payload, dimension::mass, "`payload`", diagnostics).value_or(0.0);
  }
  if (const Node* offset = map.optional("centre_of_mass")) {
    ++found;
    fault.kind = FaultKind::centre_of_mass;
    fault.value = parse_plain(*offset, dimension::length, "`centre_of_mass`", diagnostics).value_or(0.0);
  }
  if (const Node* share = map.optional("inertia")) {
    ++found;
    fault.kind = FaultKind::inertia;
    fault.value = parse_plain(*share, dimension::none, "`inertia`", diagnostics).value_or(0.0);
    if (fault.value < -most_inertia_less) diagnostics.add(wording::too_nimble(share->span));
  }
  if (const Node* object = map.optional("leaves")) {
    ++found;
    fault.kind = FaultKind::object_leaves;
    fault.object = parse_word(*object, "`leaves`", diagnostics).text;
    fault.object_span = object->span;
    if (length != nullptr) diagnostics.add(wording::leaves_for_good(length->span));
  }
  const bool names_wheel = map.optional("torque") != nullptr;
  if (found != 1 && !map.has_unread_keys()) diagnostics.add(wording::one_fault(node.span));
  if (found == 1 && names_wheel && wheel == nullptr) map.required("wheel");
  const bool may_name_wheel = names_wheel || fault.kind == FaultKind::floor_friction;
  if (found == 1 && !may_name_wheel && wheel != nullptr) diagnostics.add(wording::one_fault(node.span));
  const bool is_the_floors = fault.kind == FaultKind::floor_friction && wheel == nullptr;
  const bool is_the_worlds =
      is_the_floors || fault.kind == FaultKind::plant_diverges || fault.kind == FaultKind::object_leaves;
  if (found == 1 && is_the_worlds && robot != nullptr) diagnostics.add(wording::fault_of_all(robot->span));
  map.finish();
  return fault;
}

}  // namespace

std::vector<Fault> parse_faults(const Node& node, bool of_run, Diagnostics& diagnostics) {
  std::vector<Fault> faults;
  if (!require_sequence(node, "`faults`", diagnostics)) return faults;
  for (const Node& item : node.items) faults.push_back(parse_fault(item, of_run, diagnostics));
  return faults;
}

}  // namespace zwang::lang
