#include "robot/feels_entry.hpp"

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_feeling.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "robot/contact_loop.hpp"
#include "spec/parse_task.hpp"
#include "spec/shape.hpp"

namespace zwang::lang {

namespace {

double positive(const Node* node, const Dimension& dimension, const std::string& what,
                Diagnostics& diagnostics) {
  if (node == nullptr) return 0.0;
  return parse_positive(*node, dimension, "feels." + what, true, diagnostics).value_or(0.0);
}

void parse_wrench(const Node& node, Feels& feels, Diagnostics& diagnostics) {
  MapReader map(node, "`wrench`", diagnostics, "{frame: bumper, noise: 1 N, filter: 5 ms}");
  if (const Node* frame = map.required("frame"))
    feels.frame = parse_word(*frame, "`frame`", diagnostics).text;
  feels.noise = positive(map.required("noise"), dimension::force, "wrench.noise", diagnostics);
  feels.filter = positive(map.required("filter"), dimension::time, "wrench.filter", diagnostics);
  map.finish();
}

void parse_effort(const Node& node, Feels& feels, Diagnostics& diagnostics) {
  MapReader map(node, "`effort`", diagnostics, "{noise: 0.05 N m, resolution: 0.02 N m, filter: 10 ms}");
  feels.noise = positive(map.required("noise"), dimension::torque, "effort.noise", diagnostics);
  feels.resolution =
      positive(map.optional("resolution"), dimension::torque, "effort.resolution", diagnostics);
  feels.filter = positive(map.required("filter"), dimension::time, "effort.filter", diagnostics);
  map.finish();
}

}  // namespace

Feels parse_feels(const Node& node, Diagnostics& diagnostics) {
  Feels feels;
  MapReader map(node, "`feels`", diagnostics, "{wrench: {frame: bumper, noise: 1 N, filter: 5 ms}}");
  const Node* wrench = map.optional("wrench");
  const Node* effort = map.optional("effort");
  if (wrench != nullptr) {
    feels.by = Feels::By::wrench;
    parse_wrench(*wrench, feels, diagnostics);
  }
  if (effort != nullptr && wrench != nullptr) {
    diagnostics.add(wording::feels_twice(effort->span));
  } else if (effort != nullptr) {
    feels.by = Feels::By::effort;
    parse_effort(*effort, feels, diagnostics);
  }
  if (effort == nullptr && wrench == nullptr && map.is_mapping() && !map.has_unread_keys())
    diagnostics.add(wording::feels_nothing(node.span));
  map.finish();
  return feels;
}

void check_feels(const RobotFile& file, const solver::Model& model, Diagnostics& diagnostics) {
  const Feels& feels = file.drive.feels;
  if (feels.by == Feels::By::nothing) return;
  if (!file.drive.has_virtual_robot()) {
    diagnostics.add(wording::feels_beside_torques(file.feels_span));
    return;
  }
  if (feels.by != Feels::By::wrench || feels.frame.empty()) return;
  const std::optional<int> frame = model.find_frame(feels.frame);
  if (!frame) {
    std::vector<std::string> known;
    for (const solver::Frame& each : model.frames()) {
      if (each.body == 0) known.push_back(each.name);
    }
    diagnostics.add(
        wording::unknown_frame(file.feels_span, "link or frame", feels.frame, known, file.base.text));
  } else if (model.frames()[static_cast<std::size_t>(*frame)].body != 0) {
    diagnostics.add(wording::feels_on_a_joint(file.feels_span, feels.frame));
  }
}

void lead_by_contact(Drive& drive, double mass, const Span& feels, Diagnostics& diagnostics) {
  if (!drive.feels_contact()) return;
  if (const std::optional<VirtualMass> chosen = choose_virtual_mass(drive)) {
    drive.mass_factor = chosen->factor;
    drive.contact_damping = chosen->damping;
    const double fades = chosen->factor * chosen->damping;
    if (fades > slow_in_contact) diagnostics.add(wording::slow_in_contact(feels, fades, mass));
    return;
  }
  diagnostics.add(wording::feels_too_late(feels, felt_after(drive), longest_felt_delay(drive)));
}

}  // namespace zwang::lang
