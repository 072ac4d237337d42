// A wheel behind a joint about the vertical is on a swivel. Balls and stiff casters stand beside the wheels;
// every other joint that moves has a motor, or is held.
#include "robot/wheel_search.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "diagnostic/wordings_physics.hpp"
#include "diagnostic/wordings_standing.hpp"
#include "robot/placed_urdf.hpp"
#include "robot/wheel_candidates.hpp"
#include "robot/wheel_names.hpp"
#include "robot/wheel_roles.hpp"
#include "zwang/lang/plane.hpp"

namespace zwang::lang {

namespace {

constexpr double slack = PlacedUrdf::slack;

bool moves(const UrdfJoint& joint) {
  return joint.joint.type != solver::JointType::fixed;
}

/// The joint below a link of negligible mass, where it is the only one.
const UrdfJoint* only_joint_below(const Urdf& urdf, const std::string& link) {
  if (!urdf.is_negligible(*urdf.find_link(link))) return nullptr;
  const UrdfJoint* below = nullptr;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.parent != link) continue;
    if (below != nullptr) return nullptr;
    below = &joint;
  }
  return below;
}

/// `base_link` where it is fixed to the root, as it often hangs on a footprint; else the root. Rails that
/// lead to a base and weigh next to nothing are a simulator's.
std::string base_below(const Urdf& urdf, std::vector<std::string>& rails) {
  std::string root = urdf.root;
  std::string link = root;
  for (const UrdfJoint* below = only_joint_below(urdf, link); below != nullptr;
       below = only_joint_below(urdf, link)) {
    link = below->child;
    if (!moves(*below)) continue;
    rails.push_back(below->joint.name);
    root = link;
  }
  if (urdf.find_link("base_link") == nullptr) return root;
  for (const UrdfJoint* above = urdf.joint_above("base_link"); above != nullptr && above->child != root;
       above = urdf.joint_above(above->parent)) {
    if (moves(*above)) return root;
  }
  return "base_link";
}

constexpr double flat_corner = 1e-6;  // [m^2] of a turn of the outline that is none

/// Larger than any: a file in millimetres has wheels of 50 m.
constexpr double most_wheel_radius = 3.0, most_reach = 30.0;  // [m]

class WheelSearch {
 public:
  WheelSearch(const Urdf& urdf, FoundWheels found)
      : urdf_(urdf), found_(std::move(found)), placed_(urdf, found_.base) {}

  FoundWheels find() {
    candidates_ = wheel_candidates(placed_);
    for (const UrdfJoint* joint : candidates_.wheels) add(*joint);
    for (const std::string& roller : candidates_.rollers) note(found_.in_between, roller);
    find_stuck_wheels();
    if (!found_.wheels.empty()) assign_roles(urdf_, found_);
    couple_wheels();
    find_balls();
    find_others();
    find_outline();
    return found_;
  }

 private:
  void add(const UrdfJoint& joint) {
    DraftWheel wheel;
    wheel.joint = joint.joint.name;
    wheel.link = joint.child;
    wheel.mesh = urdf_.find_link(joint.child)->mesh;
    const solver::Vector3& at = placed_.place_of(joint);
    const solver::Vector3 axle = placed_.axis_of(joint);
    wheel.at = {at.x(), at.y(), at.z()};
    wheel.axle = axle.head<2>();
    const auto rim = candidates_.rims.find(&joint);
    wheel.radius = rim != candidates_.rims.end() ? std::optional(rim->second) : placed_.radius_of(joint);
    if (std::isfinite(joint.joint.max_effort)) wheel.effort = joint.joint.max_effort;
    for (const UrdfJoint* above : placed_.carriers(joint.parent)) {
      const bool slides = above->joint.type == solver::JointType::prismatic;
      if (!slides && std::abs(placed_.axis_of(*above).z()) > PlacedUrdf::upright) {
        wheel.swivel = above->joint.name;
        wheel.trail = std::abs((at - placed_.place_of(*above)).cross(axle).z());
      } else {
        note(found_.in_between, above->joint.name);
      }
    }
    found_.wheels.push_back(wheel);
  }

  /// Two plain wheels in line, of one radius: the floor keeps them in step, as the belt does that a <mimic>
  /// stands for. The one that follows has no motor.
  void couple_wheels() {
    const std::vector<DraftWheel> driven = found_.wheels;
    const auto is_coupled = [&](const DraftWheel& wheel) {
      const std::optional<UrdfMimic>& mimic = urdf_.find_joint(wheel.joint)->mimic;
      return mimic && std::any_of(driven.begin(), driven.end(), [&](const DraftWheel& leader) {
               return leader.joint == mimic->joint && are_in_step(leader, wheel, mimic->multiplier);
             });
    };
    for (const DraftWheel& wheel : driven) {
      if (!is_coupled(wheel)) continue;
      found_.idle.push_back(wheel);
      found_.coupled.push_back(wheel.joint);
    }
    std::erase_if(found_.wheels, is_coupled);
  }

  static bool are_in_step(const DraftWheel& leader, const DraftWheel& wheel, double multiplier) {
    constexpr double rounding = 1e-3;
    const Eigen::Vector2d axle = leader.axle.normalized();
    const Eigen::Vector2d between(wheel.at[0] - leader.at[0], wheel.at[1] - leader.at[1]);
    const double radius = leader.radius.value_or(1.0), ratio = radius / wheel.radius.value_or(1.0);
    return leader.swivel.empty() && wheel.swivel.empty() &&
           leader.radius.has_value() == wheel.radius.has_value() && std::abs(between.dot(axle)) < rounding &&
           (ratio * wheel.axle.normalized() - multiplier * axle).norm() < rounding;
  }

  static void note(std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }

  /// [m] The lowest end of a driven wheel, in the base.
  std::optional<double> ground() const {
    std::optional<double> ground;
    for (const DraftWheel& wheel : found_.wheels) {
      const double low = wheel.at[2] - wheel.radius.value_or(0.0);
      if (wheel.radius) ground = std::min(low, ground.value_or(low));
    }
    return ground;
  }

  /// Fixed to the base, and called a ball or a caster; or a sphere as low as the wheels. Some roll by joints
  /// of their own.
  void find_balls() {
    const std::optional<double> ground = this->ground();
    for (const UrdfLink& link : urdf_.links) {
      const UrdfJoint* above = urdf_.joint_above(link.name);
      if (above == nullptr || moves(*above) || placed_.carrier(link.name) != nullptr ||
          link.name == found_.base)
        continue;
      // A joint's name counts for what is round: `caster_mount_joint` may hold a bracket.
      const bool is_named = is_called_caster(link.name) || is_called_ball(link.name) ||
                            (link.radius && is_called_caster(above->joint.name));
      const bool is_sphere = ground && link.radius && !link.cylinder_axis;
      const double low = is_sphere ? (placed_.pose_of(link.name) * link.round_at).z() - *link.radius : 0.0;
      if (is_named || (is_sphere && std::abs(low - *ground) < slack * *link.radius))
        found_.supports.push_back(link.name);
    }
    leave_brackets_out();
    for (const BallCaster& ball : candidates_.balls) {
      if (!ground || std::abs(ball.lowest - *ground) > slack * *urdf_.find_link(ball.link)->radius) continue;
      for (const std::string& joint : ball.joints) note(found_.in_between, joint);
      if (ball.is_on_base) found_.supports.push_back(ball.link);
    }
  }

  /// [m] From above, between a link and what stands on the ground below it.
  double beside(const std::string& link, const solver::Vector3& foot) const {
    return (placed_.pose_of(link).position - foot).head<2>().norm();
  }

  /// On an upright cylinder nothing rolls.
  static bool is_round_foot(const UrdfLink& link) {
    return link.radius && !(link.cylinder_axis && std::abs(link.cylinder_axis->z()) > PlacedUrdf::upright);
  }

  /// A caster may be drawn of several links of its name. A link that does not roll is no support if it holds
  /// a round link, or a wheel of a caster. It holds one that stands nearer than the link is high.
  void leave_brackets_out() {
    const std::optional<double> ground = this->ground();
    std::vector<solver::Vector3> feet;
    for (const std::string& name : found_.supports) {
      if (is_round_foot(*urdf_.find_link(name)))
        feet.push_back(placed_.pose_of(name) * urdf_.find_link(name)->round_at);
    }
    for (const DraftWheel& caster : found_.casters)
      feet.emplace_back(caster.at[0], caster.at[1], caster.at[2]);
    if (!ground) return;
    std::erase_if(found_.supports, [&](const std::string& name) {
      const double height = placed_.pose_of(name).position.z() - *ground;
      return !is_round_foot(*urdf_.find_link(name)) &&
             std::any_of(feet.begin(), feet.end(),
                         [&](const auto& foot) { return beside(name, foot) < height; });
    });
  }

  /// [kg] Of the link that a joint moves, and of all beyond it.
  double mass_beyond(const UrdfJoint& joint) const {
    double mass = 0.0;
    for (const UrdfLink& link : urdf_.links) {
      const std::vector<const UrdfJoint*> above = placed_.carriers(link.name);
      if (std::find(above.begin(), above.end(), &joint) != above.end()) mass += link.inertia.mass;
    }
    return mass;
  }

  void find_others() {
    for (const UrdfJoint& joint : urdf_.joints) {
      if (moves(joint) && !has_travel(joint)) note(found_.in_between, joint.joint.name);
    }
    std::set<std::string> known(found_.in_between.begin(), found_.in_between.end());
    for (const auto* wheels : {&found_.wheels, &found_.idle, &found_.casters}) {
      for (const DraftWheel& wheel : *wheels) known.insert({wheel.joint, wheel.swivel});
    }
    const auto says_motor = [](const UrdfJoint& joint) {
      return joint.has_transmission || std::isfinite(joint.joint.max_effort);
    };
    const bool some_say = std::any_of(urdf_.joints.begin(), urdf_.joints.end(), says_motor);
    for (const UrdfJoint& joint : urdf_.joints) {
      if (!moves(joint) || known.contains(joint.joint.name)) continue;
      // A gear, a screw, or what turns a lidar.
      const bool says_nothing = some_say && !says_motor(joint) && !joint.mimic;
      const bool is_linked = urdf_.looped.contains(joint.child) && !joint.has_transmission;
      // A mark of a controller, as the mean of two steering angles: nothing that moves depends on it.
      const bool is_light = !says_motor(joint) && !joint.mimic && urdf_.mass() > 0.0 &&
                            mass_beyond(joint) < negligible_share * urdf_.mass();
      const bool turns_sensor = is_called_sensor(joint.child) && !std::isfinite(joint.joint.max_effort);
      const bool is_idle =
          joint.joint.type == solver::JointType::continuous && (says_nothing || turns_sensor);
      (is_idle || is_light || is_linked ? found_.in_between : found_.others).push_back(joint.joint.name);
    }
  }

  /// Called a wheel, and no wheel of the draft. Beside wheels that drive, only what stands as they do: names
  /// of sensors and covers have the word, too.
  void find_stuck_wheels() {
    std::vector<StuckWheel> casters;
    const bool are_all_casters =
        std::all_of(candidates_.wheels.begin(), candidates_.wheels.end(),
                    [](const UrdfJoint* wheel) { return is_called_caster(wheel->joint.name); });
    for (const UrdfJoint& joint : urdf_.joints) {
      const std::string& name = joint.joint.name;
      const bool is_part_of_wheel =
          (!moves(joint) && is_called_wheel(joint.parent) && !stands_between_wheels(joint.parent)) ||
          is_on_a_wheel(joint);
      const bool is_named = is_called_wheel(name) || is_called_wheel(joint.child);
      if (is_part_of_wheel || !is_named || is_a_wheel(joint)) continue;
      const bool turns = joint.joint.type == solver::JointType::continuous;
      if (turns || carries_a_wheel(joint) || stands_between_wheels(joint.child)) continue;
      if (are_all_casters ? !is_called_wheel(name) : !stands_beside_wheels(joint)) continue;
      const bool slides = joint.joint.type == solver::JointType::prismatic;
      (is_called_caster(name) ? casters : found_.stuck)
          .push_back({name, !moves(joint) ? "`fixed`"
                            : slides      ? "`prismatic`"
                                          : "`revolute` with limits"});
    }
    if (!found_.wheels.empty()) return;
    if (found_.stuck.empty()) found_.stuck = casters;
    if (found_.stuck.empty()) find_rails();
    if (found_.stuck.empty()) find_upright_wheels();
  }

  /// Planners move a whole robot by two slides and a turn, or by fewer, and leave its wheels out.
  void find_rails() {
    std::vector<StuckWheel> rails;
    std::string link = urdf_.root;
    for (std::size_t i = 0; i < most_links; ++i) {
      const auto is_below = [&](const UrdfJoint& joint) { return joint.parent == link; };
      const auto below = std::find_if(urdf_.joints.begin(), urdf_.joints.end(), is_below);
      if (below == urdf_.joints.end() ||
          std::count_if(urdf_.joints.begin(), urdf_.joints.end(), is_below) > 1)
        break;
      const bool slides = below->joint.type == solver::JointType::prismatic;
      const double up = std::abs(placed_.axis_of(*below).z());
      if (moves(*below) && (slides ? up > PlacedUrdf::level : up < PlacedUrdf::upright)) break;
      if (moves(*below)) rails.push_back({below->joint.name, "a rail that moves the whole robot"});
      link = below->child;
    }
    if (rails.size() > 1) found_.stuck = rails;
  }

  /// On the base, and turning without end about an axis that no wheel has.
  void find_upright_wheels() {
    for (const UrdfJoint& joint : urdf_.joints) {
      const bool is_on_base = placed_.carriers(joint.parent).empty();
      if (joint.joint.type != solver::JointType::continuous || !is_on_base) continue;
      if (!placed_.turns_about_level_axle(joint))
        found_.stuck.push_back({joint.joint.name, "`continuous` about an axis that is not level"});
    }
  }

  bool is_a_wheel(const UrdfJoint& joint) const {
    return std::find(candidates_.wheels.begin(), candidates_.wheels.end(), &joint) !=
           candidates_.wheels.end();
  }

  /// Carries links that are called wheels, to both sides of it: a `wheel_base` is none itself. A wheel's tyre
  /// and hub stand where the wheel stands.
  bool stands_between_wheels(const std::string& link) const {
    std::vector<Eigen::Vector2d> sides;
    for (const UrdfJoint& joint : urdf_.joints) {
      if (joint.parent != link || !is_called_wheel(joint.child) || is_called_sensor(joint.child)) continue;
      sides.push_back((placed_.pose_of(joint.child).position - placed_.pose_of(link).position).head<2>());
    }
    constexpr double apart = 1e-4;  // [m^2] 1 cm to either side
    return std::any_of(sides.begin(), sides.end(), [&](const Eigen::Vector2d& one) {
      return std::any_of(sides.begin(), sides.end(),
                         [&](const Eigen::Vector2d& other) { return one.dot(other) < -apart; });
    });
  }

  bool is_on_a_wheel(const UrdfJoint& joint) const {
    const std::vector<const UrdfJoint*> above = placed_.carriers(joint.parent);
    return std::any_of(above.begin(), above.end(), [&](const UrdfJoint* j) { return is_a_wheel(*j); });
  }

  bool carries_a_wheel(const UrdfJoint& joint) const {
    return std::any_of(candidates_.wheels.begin(), candidates_.wheels.end(), [&](const UrdfJoint* wheel) {
      const UrdfJoint* above = urdf_.joint_above(wheel->parent);
      for (std::size_t i = 0; above != nullptr && above != &joint && i < most_links; ++i)
        above = urdf_.joint_above(above->parent);
      return above == &joint;
    });
  }

  /// Its middle is as high as a wheel's, or it is round and ends as low.
  bool stands_beside_wheels(const UrdfJoint& joint) const {
    const double height = placed_.place_of(joint).z();
    const std::optional<double> low = placed_.lowest_of(joint), ground = this->ground();
    const bool is_low = low && ground && std::abs(*low - *ground) < slack * *placed_.radius_of(joint);
    return is_low || std::any_of(found_.wheels.begin(), found_.wheels.end(), [&](const DraftWheel& wheel) {
             const double reach = std::hypot(wheel.at[0], wheel.at[1]);
             return std::abs(wheel.at[2] - height) < wheel.radius.value_or(0.2 * reach) * slack;
           });
  }

  /// Around what collides with the base and around the wheels. Where the heaviest link of the base is a mesh,
  /// nobody knows.
  void find_outline() {
    std::vector<Eigen::Vector2d> corners;
    const UrdfLink* heaviest = nullptr;
    for (const UrdfLink& link : urdf_.links) {
      if (placed_.carrier(link.name) != nullptr) continue;
      if (heaviest == nullptr || link.inertia.mass > heaviest->inertia.mass) heaviest = &link;
      for (const solver::Vector3& corner : link.corners)
        corners.emplace_back((placed_.pose_of(link.name) * corner).head<2>());
    }
    if (heaviest == nullptr || heaviest->corners.empty()) return;
    for (const DraftWheel& wheel : holding_wheels(found_)) {
      const Eigen::Vector2d ahead =
          wheel.radius.value_or(0.0) * Eigen::Vector2d(wheel.axle.y(), -wheel.axle.x());
      for (const double side : {-1.0, 1.0})
        corners.emplace_back(Eigen::Vector2d(wheel.at[0], wheel.at[1]) + side * ahead);
    }
    found_.outline = plane::convex_hull(std::move(corners), flat_corner);
  }

  const Urdf& urdf_;
  FoundWheels found_;
  PlacedUrdf placed_;
  WheelCandidates candidates_;
};

}  // namespace

std::vector<DraftWheel> holding_wheels(const FoundWheels& found) {
  std::vector<DraftWheel> wheels = found.wheels;
  wheels.insert(wheels.end(), found.idle.begin(), found.idle.end());
  return wheels;
}

bool has_wheels_in_metres(const FoundWheels& found, const Urdf& urdf, Diagnostics& diagnostics) {
  for (const DraftWheel& wheel : holding_wheels(found)) {
    const double reach = std::hypot(wheel.at[0], wheel.at[1]), radius = wheel.radius.value_or(0.0);
    if (radius <= most_wheel_radius && reach <= most_reach) continue;
    const bool is_large = radius > most_wheel_radius;
    diagnostics.add(wording::beyond_all_bodies(urdf.find_joint(wheel.joint)->span, wheel.link,
                                               is_large ? "a wheel's radius" : "a place",
                                               wording::figure(is_large ? radius : reach, "m")));
    return false;
  }
  return true;
}

FoundWheels find_wheels(const Urdf& urdf) {
  FoundWheels found;
  found.base = base_below(urdf, found.in_between);
  return WheelSearch(urdf, std::move(found)).find();
}

}  // namespace zwang::lang
