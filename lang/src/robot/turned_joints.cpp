#include "robot/turned_joints.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>

#include "diagnostic/wordings.hpp"
#include "robot/draft_entries.hpp"
#include "robot/joint_axes.hpp"
#include "robot/left_out.hpp"
#include "robot/placed_urdf.hpp"
#include "robot/wheel_names.hpp"
#include "robot/xml_numbers.hpp"

namespace zwang::lang {

namespace {

bool is_zero(const XmlAttribute* numbers) {
  const auto values = numbers != nullptr ? read_numbers(numbers->value, 3) : std::nullopt;
  return values && std::all_of(values->begin(), values->end(), [](double v) { return v == 0.0; });
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The joints from the one above a link up to the base.
std::vector<const UrdfJoint*> joints_above(const Urdf& urdf, const std::string& link,
                                           const std::string& base) {
  std::vector<const UrdfJoint*> above;
  std::string at = link;
  while (at != base && above.size() < most_links) {
    const UrdfJoint* joint = urdf.joint_above(at);
    if (joint == nullptr) break;
    above.push_back(joint);
    at = joint->parent;
  }
  return above;
}

bool points_up(const UrdfJoint& joint, const PlacedUrdf& placed) {
  return std::abs((placed.pose_of(joint.child).rotation * joint.drawn_axis).z()) > PlacedUrdf::upright;
}

/// Whether the joint is fixed and is a swivel: its axis in the URDF points up, or its name says it. An axis
/// that is level tells nothing then: of a fixed joint nobody has ever seen it turn.
bool is_held_swivel(const UrdfJoint& joint, const PlacedUrdf& placed, const UrdfJoint& wheel) {
  if (joint.joint.type != solver::JointType::fixed) return false;
  const bool has_axis = joint.has_axis && !joint.drawn_axis.isZero(0.0);
  return (has_axis && points_up(joint, placed)) || is_called_swivel_of(joint, wheel, placed);
}

/// Held wheels of one axle, as large and as low as a wheel that turns. An example are a car's rear wheels, if
/// its URDF lets only the steered ones turn. A single one may be a caster's.
std::vector<std::string> held_axles(const Urdf& urdf, const FoundWheels& found) {
  const PlacedUrdf placed(urdf, found.base);
  constexpr double one_line = 0.05;  // of the distance of two wheels
  const auto is_alike = [&](const UrdfJoint& held, const DraftWheel& turns) {
    const std::optional<double> radius = placed.radius_of(held);
    const double size = radius.value_or(0.0);
    return radius.has_value() == turns.radius.has_value() &&
           std::abs(size - turns.radius.value_or(0.0)) <= PlacedUrdf::slack * size &&
           std::abs(placed.place_of(held).z() - turns.at[2]) <=
               PlacedUrdf::slack * radius.value_or(one_line * std::hypot(turns.at[0], turns.at[1]));
  };
  std::vector<const UrdfJoint*> held;
  for (const StuckWheel& wheel : found.stuck) {
    const UrdfJoint* joint = urdf.find_joint(wheel.joint);
    if (joint->joint.type == solver::JointType::prismatic) continue;
    const auto is_alike_to = [&](const DraftWheel& turns) { return is_alike(*joint, turns); };
    if (std::any_of(found.wheels.begin(), found.wheels.end(), is_alike_to)) held.push_back(joint);
  }
  std::vector<std::string> names;
  for (const UrdfJoint* joint : held) {
    const auto is_other_side = [&](const UrdfJoint* other) {
      const solver::Vector3 axle(found.wheels.front().axle.x(), found.wheels.front().axle.y(), 0.0);
      const solver::Vector3 between = placed.place_of(*other) - placed.place_of(*joint);
      return other != joint && between.cross(axle).norm() < one_line * between.norm();
    };
    if (std::any_of(held.begin(), held.end(), is_other_side)) names.push_back(joint->joint.name);
  }
  return names;
}

/// More wheels than a base stands on are the rollers of its tracks: those stand on the ground that are as low
/// as the lowest.
void keep_lowest(std::vector<const UrdfJoint*>& wheels, const PlacedUrdf& placed) {
  constexpr std::size_t most_standing = 8;
  constexpr double level_share = 0.05;  // of the distance between the farthest two
  if (wheels.size() <= most_standing) return;
  double lowest = solver::infinity, spread = 0.0;
  for (const UrdfJoint* wheel : wheels) {
    lowest = std::min(lowest, placed.place_of(*wheel).z());
    for (const UrdfJoint* other : wheels)
      spread = std::max(spread, (placed.place_of(*wheel) - placed.place_of(*other)).norm());
  }
  std::erase_if(wheels, [&](const UrdfJoint* wheel) {
    return placed.place_of(*wheel).z() > lowest + level_share * spread;
  });
}

/// Where most wheels have another one across the base, a single one that stands higher is a cover or a
/// sensor.
void keep_pairs(std::vector<const UrdfJoint*>& wheels, const PlacedUrdf& placed) {
  constexpr double same_place = 0.01;  // [m]
  const auto has_partner = [&placed, all = wheels](const UrdfJoint* wheel) {
    const solver::Vector3 at = placed.place_of(*wheel);
    return std::any_of(all.begin(), all.end(), [&](const UrdfJoint* other) {
      const solver::Vector3 across(at.x(), -at.y(), at.z());
      return other != wheel && (placed.place_of(*other) - across).norm() < same_place;
    });
  };
  const auto single = std::stable_partition(wheels.begin(), wheels.end(), has_partner);
  if (single - wheels.begin() < 4) return;
  double highest = -solver::infinity;
  for (auto wheel = wheels.begin(); wheel != single; ++wheel)
    highest = std::max(highest, placed.place_of(**wheel).z());
  wheels.erase(std::remove_if(single, wheels.end(),
                              [&](const UrdfJoint* wheel) {
                                return placed.place_of(*wheel).z() > highest + same_place;
                              }),
               wheels.end());
}

/// The joints that are called wheels, and the swivels that are drawn above them.
std::vector<std::string> wheels_to_turn(const Urdf& urdf, const FoundWheels& found) {
  const PlacedUrdf placed(urdf, found.base);
  std::vector<std::string> stuck;
  for (const StuckWheel& wheel : found.stuck) {
    if (urdf.find_joint(wheel.joint)->joint.type != solver::JointType::prismatic)
      stuck.push_back(wheel.joint);
  }
  if (!found.wheels.empty()) stuck = held_axles(urdf, found);
  std::map<const UrdfJoint*, std::vector<const UrdfJoint*>> wheels_below;  // of the joints above wheels
  std::vector<const UrdfJoint*> wheels;
  for (const std::string& name : stuck) {
    const UrdfJoint* wheel = urdf.find_joint(name);
    const std::vector<const UrdfJoint*> above = joints_above(urdf, wheel->parent, found.base);
    const bool is_part_of_another = std::any_of(
        above.begin(), above.end(), [&](const UrdfJoint* j) { return is_among(stuck, j->joint.name); });
    if (is_part_of_another) continue;
    wheels.push_back(wheel);
    for (const UrdfJoint* joint : above) wheels_below[joint].push_back(wheel);
  }
  if (wheels.size() < 2) return {};
  keep_lowest(wheels, placed);
  keep_pairs(wheels, placed);
  for (const DraftWheel& turns : found.wheels) {
    const UrdfJoint* wheel = urdf.find_joint(turns.joint);
    for (const UrdfJoint* joint : joints_above(urdf, wheel->parent, found.base))
      wheels_below[joint].push_back(wheel);
  }
  std::vector<std::string> turning;
  for (const UrdfJoint& joint : urdf.joints) {
    const auto below = wheels_below.find(&joint);
    if (below != wheels_below.end() && below->second.size() == 1 &&
        is_held_swivel(joint, placed, *below->second.front()))
      turning.push_back(joint.joint.name);
  }
  for (const UrdfJoint* wheel : wheels) turning.push_back(wheel->joint.name);
  return turning;
}

/// Of wheels that have no axis, and whose shape tells none: the base's y, in the frame of the joint. If all
/// held wheels roll sideways, their axes tell nothing: a template's 1 0 0 does no harm at a joint that is
/// fixed.
std::vector<JointAxis> sideways_axles(const Urdf& urdf, const std::string& base,
                                      const std::vector<std::string>& held) {
  const PlacedUrdf placed(urdf, base);
  std::vector<const UrdfJoint*> wheels;
  for (const std::string& name : held) {
    const UrdfJoint* joint = urdf.find_joint(name);
    if (placed.carried_by(*joint).empty()) wheels.push_back(joint);
  }
  const bool roll_sideways = std::all_of(wheels.begin(), wheels.end(), [&](const UrdfJoint* joint) {
    return joint->drawn_axis.isApprox(solver::Vector3::UnitX()) &&
           std::abs(placed.axis_of(*joint).y()) < PlacedUrdf::level &&
           std::abs(placed.axis_of(*joint).z()) < PlacedUrdf::level;
  });
  std::vector<JointAxis> axes;
  for (const UrdfJoint* joint : wheels) {
    if (joint->has_axis && !roll_sideways) continue;
    constexpr double rounding = 1e-3;
    solver::Vector3 axle = placed.pose_of(joint->child).rotation.transpose() * solver::Vector3::UnitY();
    for (double& number : axle) number = std::abs(number) < rounding ? 0.0 : number;
    axes.push_back({joint->joint.name, axle.normalized()});
  }
  return axes;
}

}  // namespace

void let_turn(const std::vector<std::string>& joints, std::vector<XmlElement>& elements) {
  std::set<std::size_t> gone, turned;
  for (std::size_t i = 1; i < elements.size(); ++i) {
    XmlElement& element = elements[i];
    const XmlAttribute* name = element.find("name");
    if (element.parent == 0 && element.name == "joint" && name != nullptr && is_among(joints, name->value)) {
      for (XmlAttribute& attribute : element.attributes) {
        if (attribute.name == "type") attribute.value = "continuous";
      }
      turned.insert(i);
    }
    if (element.name == "axis" && turned.contains(static_cast<std::size_t>(element.parent)) &&
        is_zero(element.find("xyz")))
      gone.insert(i);
  }
  erase_elements(gone, elements);
}

void check_turning(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics) {
  for (const Word& name : file.turning) {
    if (name.exists() && urdf.find_joint(name.text) == nullptr && !urdf.left_out.contains(name.text))
      diagnostics.add(wording::unknown_name(name.span, "joint", name.text, urdf.joint_names()));
  }
}

void turn_wheels(const std::filesystem::path& path, Urdf& urdf, DraftOptions& options, FoundWheels& found) {
  const std::vector<std::string> held = wheels_to_turn(urdf, found);
  if (held.empty()) return;
  DraftOptions turning = options;
  turning.turning.insert(turning.turning.end(), held.begin(), held.end());
  Diagnostics unheard;  // the URDF was read before; what its wheels lack is said when the file is loaded
  std::optional<Urdf> turned = read_urdf(path, {}, unheard, {turning.ignored, turning.turning});
  if (!turned) return;
  turning.axes = find_axes_of(*turned, options.axes);
  const std::vector<JointAxis> sideways = sideways_axles(*turned, found.base, held);
  if (!sideways.empty()) {
    turning.axes.insert(turning.axes.end(), sideways.begin(), sideways.end());
    find_axes_of(*turned, turning.axes);
  }
  FoundWheels now = find_wheels(*turned);
  if (now.wheels.size() <= found.wheels.size()) return;
  urdf = std::move(*turned);
  options = std::move(turning);
  found = std::move(now);
}

std::string turns_entry(const std::vector<std::string>& joints) {
  if (joints.empty()) return "";
  return "\n# The URDF holds these joints: simulators that push a base about draw its wheels so. Here they "
         "turn "
         "without\n# end. A caster's wheel, which has no motor, must not stand in `actuated`.\nturns: " +
         in_brackets(joints) + "\n";
}

}  // namespace zwang::lang
