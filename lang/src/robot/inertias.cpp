#include "robot/inertias.hpp"

#include <algorithm>

#include "diagnostic/wordings.hpp"
#include "spec/shape.hpp"

namespace zwang::lang {

namespace {

const WheelText* wheel_on(const RobotFile& file, const UrdfJoint* joint) {
  if (joint == nullptr) return nullptr;
  const auto wheel = std::find_if(file.wheels.begin(), file.wheels.end(),
                                  [&](const WheelText& w) { return w.joint.text == joint->joint.name; });
  return wheel == file.wheels.end() ? nullptr : &*wheel;
}

bool is_driven(const RobotFile& file, const WheelText* wheel) {
  return wheel != nullptr &&
         std::any_of(file.actuators.begin(), file.actuators.end(),
                     [&](const ActuatorText& motor) { return motor.joint.text == wheel->joint.text; });
}

// A solid cylinder of mass m, radius r and length r / 2 about its axis a, and across it:
//   I_a = m r^2 / 2,   I_t = m (3 r^2 + (r / 2)^2) / 12
solver::Matrix3 disc(double mass, double radius, const solver::Vector3& axis) {
  const double along = 0.5 * mass * radius * radius;
  const double across = mass * radius * radius * (3.0 + 0.25) / 12.0;
  return across * solver::Matrix3::Identity() + (along - across) * axis * axis.transpose();
}

// A solid ball: 2 m r^2 / 5 about each axis.
solver::Matrix3 ball(double mass, double radius) {
  return 0.4 * mass * radius * radius * solver::Matrix3::Identity();
}

}  // namespace

InertiaText parse_inertia(const Entry& entry, Diagnostics& diagnostics) {
  InertiaText inertia;
  inertia.link = {entry.key.text, entry.key.span};
  const std::string what = "inertia of `" + entry.key.text + "`";
  MapReader map(entry.value, what, diagnostics, "{mass: 1 kg, radius: 60 mm}");
  if (const Node* mass = map.optional("mass"))
    inertia.mass = parse_positive(*mass, dimension::mass, what + ", mass", false, diagnostics);
  if (const Node* radius = map.optional("radius"))
    inertia.radius = parse_positive(*radius, dimension::length, what + ", radius", false, diagnostics);
  if (const Node* at = map.optional("at")) {
    inertia.at = parse_vector(*at, dimension::length, 3, 3, what + ", at", diagnostics)
                     .value_or(std::vector<double>{});
    inertia.at_span = at->span;
  }
  map.finish();
  return inertia;
}

void apply_inertias(const RobotFile& file, Urdf& urdf, Diagnostics& diagnostics) {
  for (const InertiaText& text : file.inertias) {
    const auto link = std::find_if(urdf.links.begin(), urdf.links.end(),
                                   [&](const UrdfLink& l) { return l.name == text.link.text; });
    if (link == urdf.links.end()) {
      if (!urdf.left_out.contains(text.link.text))
        diagnostics.add(wording::unknown_name(text.link.span, "link", text.link.text, urdf.link_names()));
      continue;
    }
    const UrdfJoint* joint = urdf.joint_above(link->name);
    const WheelText* wheel = wheel_on(file, joint);
    const double known = link->inertia.mass;
    const std::optional<double> mass = text.mass                ? text.mass
                                       : known > 0.0            ? std::optional(known)
                                       : is_driven(file, wheel) ? file.each_wheel.mass
                                                                : std::nullopt;
    const std::optional<double> radius = text.radius        ? text.radius
                                         : wheel != nullptr ? wheel->radius
                                                            : std::nullopt;
    const std::string what = "inertia of `" + text.link.text + "`";
    if (!mass) diagnostics.add(wording::missing_key(text.link.span, what, "mass"));
    if (!radius) diagnostics.add(wording::missing_key(text.link.span, what, "radius"));
    if (!mass || !radius) continue;
    solver::Vector3 com =
        known > 0.0 ? solver::Vector3(link->inertia.first_moment / known) : solver::Vector3::Zero();
    if (!text.at.empty()) com = {text.at[0], text.at[1], text.at[2]};
    if (wheel != nullptr) com = joint->joint.axis.dot(com) * joint->joint.axis;
    link->inertia = solver::RigidInertia::from_com(
        *mass, com, wheel != nullptr ? disc(*mass, *radius, joint->joint.axis) : ball(*mass, *radius));
  }
}

}  // namespace zwang::lang
