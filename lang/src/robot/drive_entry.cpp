#include "robot/drive_entry.hpp"

#include <algorithm>
#include <string>

#include "diagnostic/wordings.hpp"
#include "spec/parse_task.hpp"
#include "spec/shape.hpp"

namespace zwang::lang {

namespace {

/// One of `words`; the first one where there is none.
std::string parse_choice(const Node* node, const std::string& key, const std::vector<std::string>& words,
                         Diagnostics& diagnostics) {
  if (node == nullptr) return words.front();
  const Word word = parse_word(*node, "`" + key + "`", diagnostics);
  if (!word.exists()) return words.front();
  if (std::find(words.begin(), words.end(), word.text) != words.end()) return word.text;
  diagnostics.add(wording::unknown_drive_word(word.span, key, word.text, words));
  return words.front();
}

/// Refuses the keys that a drive which takes torques has no use for.
void refuse_beside_torque(MapReader& map, Diagnostics& diagnostics) {
  for (const char* key : {"as", "rate", "delay", "time_constant", "integral_time", "torque_limit"}) {
    if (const Node* node = map.optional(key))
      diagnostics.add(wording::drive_key_beside_torque(node->span, key));
  }
}

void parse_rate_and_delay(MapReader& map, Drive& drive, Diagnostics& diagnostics) {
  if (const Node* rate = map.required("rate")) {
    drive.rate = parse_positive(*rate, dimension::frequency, "drive.rate", false, diagnostics).value_or(1e3);
    if (drive.rate < slowest_drive_rate) diagnostics.add(wording::drive_too_slow(rate->span, drive.rate));
  }
  if (const Node* delay = map.required("delay")) {
    drive.delay = parse_positive(*delay, dimension::time, "drive.delay", true, diagnostics).value_or(0.0);
    if (drive.delay > longest_drive_delay) diagnostics.add(wording::drive_too_late(delay->span, drive.delay));
  }
}

void parse_loop(MapReader& map, Drive& drive, Diagnostics& diagnostics) {
  if (const Node* time = map.required("time_constant"))
    drive.time_constant =
        parse_positive(*time, dimension::time, "drive.time_constant", false, diagnostics).value_or(20e-3);
  const Node* integral = map.required("integral_time");
  if (integral != nullptr && !(integral->is_scalar() && integral->text == "none"))
    drive.integral_time =
        parse_positive(*integral, dimension::time, "drive.integral_time", false, diagnostics);
}

}  // namespace

Drive parse_drive(const Node& node, Diagnostics& diagnostics) {
  Drive drive;
  MapReader map(node, "`drive`", diagnostics, "{command: torque}");
  const std::string command =
      parse_choice(map.required("command"), "command", {"torque", "velocity"}, diagnostics);
  drive.takes_velocity = command == "velocity";
  if (!drive.takes_velocity) {
    refuse_beside_torque(map, diagnostics);
    map.finish();
    return drive;
  }
  const Node* as = map.optional("as");
  drive.takes_twist = parse_choice(as, "as", {"wheels", "twist"}, diagnostics) == "twist";
  const Node* limit = map.required("torque_limit");
  drive.limit_is_fixed = parse_choice(limit, "torque_limit", {"each_cycle", "fixed"}, diagnostics) == "fixed";
  if (limit != nullptr && drive.takes_twist && !drive.limit_is_fixed)
    diagnostics.add(wording::limit_beside_twist(limit->span));
  parse_rate_and_delay(map, drive, diagnostics);
  parse_loop(map, drive, diagnostics);
  map.finish();
  return drive;
}

void check_drive(const RobotFile& file, Diagnostics& diagnostics) {
  if (!file.drive.takes_velocity) return;
  for (const ActuatorText& actuator : file.actuators) {
    const bool turns_wheel = std::any_of(file.wheels.begin(), file.wheels.end(), [&](const WheelText& wheel) {
      return wheel.joint.text == actuator.joint.text;
    });
    if (!turns_wheel)
      diagnostics.add(
          wording::drive_without_wheel(actuator.joint.span, actuator.joint.text, file.drive_span));
  }
}

void check_twist(const RobotFile& file, const solver::Model& model, Diagnostics& diagnostics) {
  if (!file.drive.takes_twist) return;
  for (const solver::Wheel& wheel : model.wheels()) {
    const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
    if (!body.joint.actuated || body.parent == 0) continue;
    const auto text = std::find_if(file.wheels.begin(), file.wheels.end(),
                                   [&](const WheelText& w) { return w.joint.text == body.joint.name; });
    if (text != file.wheels.end())
      diagnostics.add(wording::twist_of_swivels(text->joint.span, body.joint.name, file.drive_span));
  }
}

}  // namespace zwang::lang
