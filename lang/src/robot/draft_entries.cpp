#include "robot/draft_entries.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>

#include "diagnostic/wordings_physics.hpp"
#include "robot/gravity.hpp"
#include "robot/placed_urdf.hpp"
#include "robot/wheel_names.hpp"
#include "zwang/lang/footing.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::lang {

namespace {

double step_of_two_digits(double value) {
  return std::pow(10.0, std::floor(std::log10(value)) - 1.0);
}

/// The first two digits, the next above.
double two_digits_above(double value) {
  const double step = step_of_two_digits(value);
  return std::ceil(value / step - 1e-9) * step;
}

double two_digits_below(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return value;
  const double step = step_of_two_digits(value);
  return std::floor(value / step + 1e-9) * step;
}

/// A wheel of the draft hangs on it.
bool carries_a_wheel(const Urdf& urdf, const FoundWheels& found, const std::string& joint) {
  for (const auto* wheels : {&found.wheels, &found.idle, &found.casters}) {
    for (const DraftWheel& wheel : *wheels) {
      const UrdfJoint* above = urdf.find_joint(wheel.joint);
      for (std::size_t i = 0; above != nullptr && i < most_links; ++i) {
        if (above->joint.name == joint) return true;
        above = urdf.joint_above(above->parent);
      }
    }
  }
  return false;
}

/// A tyre that scrubs resists a steering by at most its load times its radius, m g r / n, and a steering is
/// as strong. With that torque it turns no faster than by 150 rad/s^2, a quarter turn in 0.14 s:
///   J = m g r / (150 n)
/// A lighter one gives way to the base's least sway, and wheels that toe by more than 0.5 deg hold the base.
double slowest_rotor(const Urdf& urdf, const FoundWheels& found, const std::string& joint) {
  constexpr double fastest = 150.0;  // [rad/s^2]
  const auto wheel = std::find_if(found.wheels.begin(), found.wheels.end(),
                                  [&](const DraftWheel& other) { return other.swivel == joint; });
  const std::size_t count = holding_wheels(found).size() + found.casters.size();
  if (wheel == found.wheels.end()) return 0.0;
  return urdf.mass() * gravity * wheel->radius.value_or(0.1) / (fastest * static_cast<double>(count));
}

/// A ball weighs about no axis less than the disc that a wheel counts as does across its own.
solver::RigidInertia as_ball(const DraftBody& body, const UrdfLink& link, const FoundWheels& found) {
  double radius = body.radius;
  for (const DraftWheel& wheel : found.wheels) {
    if (wheel.link == link.name) radius = wheel.radius.value_or(0.1);
  }
  const double mass = link.inertia.mass;
  return solver::RigidInertia::from_com(mass, link.inertia.first_moment / mass,
                                        0.4 * mass * radius * radius * solver::Matrix3::Identity());
}

}  // namespace

std::string in_brackets(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return "[" + text + "]";
}

std::string fixed_entry(const std::vector<std::string>& joints) {
  if (joints.empty()) return "";
  return "\n# They do not move here. They carry wheels and do not steer them, as rockers and springs do; "
         "follow "
         "another joint\n# by a <mimic>; have no travel, no motor, one too weak to hold them, or next to no "
         "inertia behind them; or are\n# stiff casters, balls and rollers, a simulator's rails, or parts of "
         "a "
         "linkage that a simulator's own <joint> closes.\nfixed: " +
         in_brackets(joints) + "\n";
}

std::string steering_rotor(const Urdf& urdf, const FoundWheels& found, const std::vector<DraftBody>& bodies,
                           const std::string& joint) {
  const auto is_on_it = [&](const DraftWheel& wheel) { return wheel.swivel == joint; };
  if (std::count_if(found.wheels.begin(), found.wheels.end(), is_on_it) > 1) return "";
  const PlacedUrdf placed(urdf, found.base);
  const UrdfJoint* swivel = urdf.find_joint(joint);
  const solver::Vector3 axis = placed.axis_of(*swivel), at = placed.place_of(*swivel);
  double inertia = 0.0;
  for (const UrdfLink& link : urdf.links) {
    const std::vector<const UrdfJoint*> above = placed.carriers(link.name);
    if (!(link.inertia.mass > 0.0) || std::find(above.begin(), above.end(), swivel) == above.end()) continue;
    solver::Pose from_swivel = placed.pose_of(link.name);
    from_swivel.position -= at;
    const auto body = std::find_if(bodies.begin(), bodies.end(),
                                   [&](const DraftBody& other) { return other.link == link.name; });
    const solver::RigidInertia own = body == bodies.end() ? link.inertia : as_ball(*body, link, found);
    inertia += axis.dot(own.expressed_in(from_swivel).rotational * axis);
  }
  inertia = std::max(inertia, slowest_rotor(urdf, found, joint));
  return inertia > 0.0 ? "rotor_inertia: " + wording::figure(two_digits_above(inertia), "kg m^2") : "";
}

std::map<std::string, double> steered_ahead(const Urdf& urdf, const FoundWheels& found) {
  constexpr double drawn = std::numbers::pi / 180.0;  // [rad] as exact
  const PlacedUrdf placed(urdf, found.base);
  std::map<std::string, double> posture;
  for (const DraftWheel& wheel : found.wheels) {
    const UrdfJoint* swivel = urdf.find_joint(wheel.swivel);
    const auto& steering = found.steering;
    if (swivel == nullptr || std::find(steering.begin(), steering.end(), wheel.swivel) == steering.end())
      continue;
    // By which the axle must turn to lie along y, either way.
    double turn = std::numbers::pi / 2.0 - std::atan2(wheel.axle.y(), wheel.axle.x());
    turn = std::remainder(turn, std::numbers::pi);
    const double q = placed.axis_of(*swivel).z() > 0.0 ? turn : -turn;
    if (std::abs(q) > drawn && q > swivel->joint.lower && q < swivel->joint.upper) posture[wheel.swivel] = q;
  }
  return posture;
}

std::string in_millimetres(double metres) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g mm", metres * 1e3);
  return text;
}

std::string friction_note(const Urdf& urdf, const FoundWheels& found, const std::vector<std::string>& held) {
  std::vector<std::string> joints;
  for (const DraftWheel& wheel : found.wheels) joints.push_back(wheel.joint);
  joints.insert(joints.end(), found.steering.begin(), found.steering.end());
  std::copy_if(
      found.others.begin(), found.others.end(), std::back_inserter(joints),
      [&](const std::string& name) { return std::find(held.begin(), held.end(), name) == held.end(); });
  std::string text;
  for (const std::string& name : joints) {
    const UrdfJoint& joint = *urdf.find_joint(name);
    if (!(joint.coulomb > 0.0 || joint.viscous > 0.0)) continue;
    const bool slides = joint.joint.type == solver::JointType::prismatic;
    const auto part = [&](const char* key, double value, const char* unit) {
      return value > 0.0 ? key + (": " + wording::figure(value, unit)) : std::string();
    };
    const std::string coulomb = part("coulomb", joint.coulomb, slides ? "N" : "N m");
    const std::string viscous = part("viscous", joint.viscous, slides ? "N s/m" : "N m s/rad");
    text +=
        "#   " + name + ": {" + coulomb + (coulomb.empty() || viscous.empty() ? "" : ", ") + viscous + "}\n";
  }
  if (text.empty()) return text;
  return "\n# The URDF's <dynamics> are not taken: many are made up, to calm a simulator. If these were "
         "measured, take "
         "them:\n# friction:\n" +
         text;
}

std::vector<std::string> missing_of_joints(const Urdf& urdf, const FoundWheels& found, bool has_none) {
  std::vector<std::string> lines;
  if (has_none)
    lines.push_back(
        "wheels: no joint turns without end about a level axle and is called a wheel, is round, or has "
        "another "
        "one beside it");
  for (const StuckWheel& wheel : found.stuck)
    lines.push_back("a `continuous` joint about a level axle where the URDF has `" + wheel.joint +
                    "`, which is " + wheel.how);
  for (const std::string& name : found.in_between) {
    const bool is_named = is_called_steering(name) || is_called_caster(name);
    if (!is_named || !carries_a_wheel(urdf, found, name)) continue;
    const bool is_stiff = !has_travel(*urdf.find_joint(name));
    lines.push_back("a joint that steers where the URDF has `" + name +
                    "`: " + (is_stiff ? "its limits leave it no travel" : "its axis does not point up") +
                    ", and it stands in `fixed`");
  }
  return lines;
}

std::string stuck_wheels_note(const FoundWheels& found) {
  std::string lines;
  for (const StuckWheel& wheel : found.stuck)
    lines += "# `" + wheel.joint + stands_nowhere + wheel.how + ". If it rolls, list it under `turns`.\n";
  return lines;
}

std::string mimic_entry(const Urdf& urdf, const FoundWheels& found) {
  std::string entries;
  const auto add = [&](const std::string& joint, const char* word) {
    if (joint.empty() || !urdf.find_joint(joint)->mimic) return;
    const std::string entry = joint + ": " + word;
    if ((", " + entries + ",").find(", " + entry + ",") == std::string::npos)
      entries += (entries.empty() ? "" : ", ") + entry;
  };
  for (const auto* wheels : {&found.wheels, &found.idle, &found.casters}) {
    for (const DraftWheel& wheel : *wheels) {
      const auto& coupled = found.coupled;
      const bool is_coupled = std::find(coupled.begin(), coupled.end(), wheel.joint) != coupled.end();
      add(wheel.joint, is_coupled ? "coupled" : "ignore");
      add(wheel.swivel, "ignore");
    }
  }
  if (entries.empty()) return "";
  return "\n# They follow another joint by a <mimic>. coupled: a belt or chain turns both, and the floor "
         "keeps "
         "them in step.\n# ignore: each moves by itself, as two motors do; a steering linkage is simulated "
         "so, "
         "too.\nmimic: {" +
         entries + "}\n";
}

std::string stop_entry(double mass, double deceleration, const std::string& open) {
  const std::string a = wording::figure(deceleration, "m/s^2");
  const std::string force = mass > 0.0 ? wording::figure(two_digits_above(mass * deceleration), "N") : open;
  const std::string why = deceleration < 1.0 ? ": harder, and the base could tip (W640);" : ",";
  return "\n# The one brake of `done`, `failed` and the protective stop. Proposed: " + a + why +
         " and the force that it takes,\n# " + (mass > 0.0 ? wording::figure(mass, "kg") : "mass") + " x " +
         a + ".\nstop: {deceleration: " + a + ", force: " + force + "}\n";
}

void add_edge_note(RobotDraft& draft) {
  for (const AssumedRobot& assumed : draft.assumed) {
    const std::optional<Footing> footing = footing_of(assumed.robot);
    if (!footing || !footing->is_on_edge()) continue;
    const std::string where = wording::figure(std::abs(footing->inside) * 1e3, "mm") +
                              (footing->inside < 0.0 ? " outside" : " inside");
    draft.missing.push_back("a centre of mass well inside the supports: it lies " + where +
                            " their edge and " + wording::figure(footing->height * 1e3, "mm") +
                            " high, and the base tips over (W640); name more `supports`, or mend the masses");
    return;
  }
}

double steady_deceleration(const RobotDraft& draft) {
  double least = solver::infinity;
  for (const AssumedRobot& assumed : draft.assumed) {
    const Robot& robot = assumed.robot;
    const std::optional<Footing> footing = footing_of(robot);
    if (!footing || footing->is_on_edge()) continue;  // no brake is gentle enough
    // On fewer points than three the base stands on its outline.
    const bool is_known = draft.outline_is_known || footing->wheels + robot.supports.size() >= 3;
    const bool has_swivels = std::any_of(draft.wheels.begin(), draft.wheels.end(),
                                         [](const DraftWheel& wheel) { return !wheel.swivel.empty(); });
    const bool goes_sideways =
        has_swivels || solver::analyse_base(robot.model, start_state(robot)).base_mobility == 3;
    if (is_known) least = std::min(least, footing->tipping_deceleration(goes_sideways));
  }
  return two_digits_below(least);
}

}  // namespace zwang::lang
