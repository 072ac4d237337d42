// A wheel turns without end about a level axle, and nothing moves beyond it. It is called a wheel, or it is
// round and stands on the ground. A wheel behind a joint about the vertical is on a swivel.
#include "robot/wheel_search.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "diagnostic/wordings_physics.hpp"
#include "diagnostic/wordings_standing.hpp"
#include "robot/wheel_names.hpp"
#include "robot/wheel_roles.hpp"

namespace zwang::lang {

namespace {

constexpr double level = 0.1;    // |z| of an axle's direction
constexpr double upright = 0.9;  // |z| of a swivel's
constexpr double slack = 0.2;    // of a radius: as far off a round shape is drawn beside its place

bool moves(const UrdfJoint& joint) {
  return joint.joint.type != solver::JointType::fixed;
}

/// Counter-clockwise (Andrew's monotone chain). Empty where the points span no area.
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  constexpr double flat = 1e-6;  // [m^2] of a turn that is none
  const auto by_x_then_y = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  };
  std::sort(points.begin(), points.end(), by_x_then_y);
  std::vector<Eigen::Vector2d> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= start + 2) {
        const Eigen::Vector2d last = hull.back() - hull[hull.size() - 2];
        const Eigen::Vector2d next = *point - hull.back();
        if (last.x() * next.y() - last.y() * next.x() > flat) break;
        hull.pop_back();
      }
      hull.push_back(*point);
    }
    if (!hull.empty()) hull.pop_back();  // the other chain's first
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull.size() >= 3 ? hull : std::vector<Eigen::Vector2d>{};
}

/// Larger than any: a file in millimetres has wheels of 50 m.
constexpr double most_wheel_radius = 3.0, most_reach = 30.0;  // [m]

class WheelSearch {
 public:
  explicit WheelSearch(const Urdf& urdf) : urdf_(urdf) {
    found_.base = base();
    place_links();
  }

  FoundWheels find() {
    for (const UrdfJoint* joint : candidates()) add(*joint);
    if (!found_.wheels.empty()) assign_roles(urdf_, found_);
    couple_wheels();
    find_balls();
    find_others();
    if (found_.wheels.empty()) find_stuck_wheels();
    find_outline();
    return found_;
  }

 private:
  /// `base_link` where it is fixed to the root, as it often hangs on a footprint; else the root. Rails that
  /// lead to a base and weigh next to nothing are a simulator's.
  std::string base() {
    std::string root = urdf_.root;
    std::string link = root;
    for (const UrdfJoint* below = only_joint(link); below != nullptr; below = only_joint(link)) {
      link = below->child;
      if (!moves(*below)) continue;
      found_.in_between.push_back(below->joint.name);
      root = link;
    }
    if (urdf_.find_link("base_link") == nullptr) return root;
    for (const UrdfJoint* above = urdf_.joint_above("base_link"); above != nullptr && above->child != root;
         above = urdf_.joint_above(above->parent)) {
      if (moves(*above)) return root;
    }
    return "base_link";
  }

  /// The joint below a link of negligible mass, where it is the only one.
  const UrdfJoint* only_joint(const std::string& link) const {
    if (!urdf_.is_negligible(*urdf_.find_link(link))) return nullptr;
    const UrdfJoint* below = nullptr;
    for (const UrdfJoint& joint : urdf_.joints) {
      if (joint.parent != link) continue;
      if (below != nullptr) return nullptr;
      below = &joint;
    }
    return below;
  }

  void place_links() {
    std::map<std::string, solver::Pose> in_root{{urdf_.root, {}}};
    for (bool is_growing = true; is_growing;) {
      is_growing = false;
      for (const UrdfJoint& joint : urdf_.joints) {
        const auto parent = in_root.find(joint.parent);
        if (parent == in_root.end() || in_root.contains(joint.child)) continue;
        in_root[joint.child] = parent->second * joint.origin;
        is_growing = true;
      }
    }
    const solver::Pose to_base = in_root.at(found_.base).inverse();
    for (const auto& [name, pose] : in_root) in_base_[name] = to_base * pose;
  }

  solver::Vector3 axis_of(const UrdfJoint& joint) const {
    return in_base_.at(joint.child).rotation * joint.joint.axis;
  }

  /// The nearest moving joint above a link; nullptr when it is fixed to the base.
  const UrdfJoint* carrier(const std::string& link) const {
    const auto next = [&](const std::string& l) { return l == found_.base ? nullptr : urdf_.joint_above(l); };
    const UrdfJoint* above = next(link);
    while (above != nullptr && !moves(*above)) above = next(above->parent);
    return above;
  }

  bool is_last(const UrdfJoint& joint) const {
    return std::none_of(urdf_.joints.begin(), urdf_.joints.end(), [&](const UrdfJoint& other) {
      return moves(other) && carrier(other.parent) == &joint;
    });
  }

  static bool is_named(const UrdfJoint& joint) {
    return is_called_wheel(joint.joint.name) || is_called_wheel(joint.child) ||
           is_called_caster(joint.joint.name);
  }

  /// A wheel has the name of one, or is round and stands as low as the named ones. Without names the lowest
  /// round links are wheels.
  std::vector<const UrdfJoint*> candidates() const {
    std::vector<const UrdfJoint*> named, round, result;
    for (const UrdfJoint& joint : urdf_.joints) {
      const bool turns_for_ever = joint.joint.type == solver::JointType::continuous;
      if (!turns_for_ever || std::abs(axis_of(joint).z()) > level || !is_last(joint)) continue;
      if (is_named(joint)) named.push_back(&joint);
      if (lowest_of(joint)) round.push_back(&joint);
    }
    std::optional<double> ground;
    for (const UrdfJoint* joint : named.empty() ? round : named) {
      const std::optional<double> low = lowest_of(*joint);
      if (low) ground = std::min(*low, ground.value_or(*low));
    }
    for (const UrdfJoint& joint : urdf_.joints) {
      const auto is_in = [&](const std::vector<const UrdfJoint*>& joints) {
        return std::find(joints.begin(), joints.end(), &joint) != joints.end();
      };
      if (is_in(named) || (is_in(round) && ground && stands_at(*ground, joint))) result.push_back(&joint);
    }
    return result;
  }

  /// Its height in the base. [m]
  std::optional<double> lowest_of(const UrdfJoint& joint) const {
    const std::optional<double> radius = radius_of(joint);
    if (!radius) return std::nullopt;
    return in_base_.at(joint.child).position.z() - *radius;
  }

  bool stands_at(double ground, const UrdfJoint& joint) const {
    return std::abs(*lowest_of(joint) - ground) < slack * *radius_of(joint);
  }

  /// Of a wheel, whose tyre may be a link of its own.
  std::optional<double> radius_of(const UrdfJoint& joint) const {
    std::optional<double> radius = urdf_.find_link(joint.child)->radius;
    for (const UrdfLink& link : urdf_.links) {
      if (link.name == joint.child || !link.radius || carrier(link.name) != &joint) continue;
      const bool is_on_axle = (in_base_.at(link.name) * link.round_at - in_base_.at(joint.child).position)
                                  .cross(axis_of(joint))
                                  .norm() < slack * *link.radius;
      const bool lies_flat =
          link.cylinder_axis &&
          (in_base_.at(link.name).rotation * *link.cylinder_axis).cross(axis_of(joint)).norm() > level;
      if (is_on_axle && !lies_flat) radius = std::max(radius.value_or(0.0), *link.radius);
    }
    return radius;
  }

  void add(const UrdfJoint& joint) {
    DraftWheel wheel;
    wheel.joint = joint.joint.name;
    wheel.link = joint.child;
    const solver::Vector3& at = in_base_.at(joint.child).position;
    wheel.at = {at.x(), at.y(), at.z()};
    wheel.axle = axis_of(joint).head<2>();
    wheel.radius = radius_of(joint);
    if (std::isfinite(joint.joint.max_effort)) wheel.effort = joint.joint.max_effort;
    for (const UrdfJoint* above = carrier(joint.parent); above != nullptr; above = carrier(above->parent)) {
      const bool slides = above->joint.type == solver::JointType::prismatic;
      if (!slides && std::abs(axis_of(*above).z()) > upright) {
        wheel.swivel = above->joint.name;
        wheel.trail = std::abs((at - in_base_.at(above->child).position).cross(axis_of(joint)).z());
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

  /// Fixed to the base, and called a ball or a caster; or a sphere as low as the wheels.
  void find_balls() {
    std::optional<double> ground;
    for (const DraftWheel& wheel : found_.wheels) {
      const double low = wheel.at[2] - wheel.radius.value_or(0.0);
      if (wheel.radius) ground = std::min(low, ground.value_or(low));
    }
    for (const UrdfLink& link : urdf_.links) {
      const UrdfJoint* above = urdf_.joint_above(link.name);
      if (above == nullptr || moves(*above) || carrier(link.name) != nullptr || link.name == found_.base)
        continue;
      const bool is_named = is_called_caster(link.name) || is_called_ball(link.name);
      const bool is_sphere = ground && link.radius && !link.cylinder_axis;
      const double low = is_sphere ? (in_base_.at(link.name) * link.round_at).z() - *link.radius : 0.0;
      if (is_named || (is_sphere && std::abs(low - *ground) < slack * *link.radius))
        found_.supports.push_back(link.name);
    }
  }

  void find_others() {
    std::set<std::string> known(found_.in_between.begin(), found_.in_between.end());
    for (const auto* wheels : {&found_.wheels, &found_.idle, &found_.casters}) {
      for (const DraftWheel& wheel : *wheels) known.insert({wheel.joint, wheel.swivel});
    }
    for (const UrdfJoint& joint : urdf_.joints) {
      if (moves(joint) && !known.contains(joint.joint.name)) found_.others.push_back(joint.joint.name);
    }
  }

  void find_stuck_wheels() {
    for (const UrdfJoint& joint : urdf_.joints) {
      const bool turns = joint.joint.type == solver::JointType::continuous;
      const std::string& name = joint.joint.name;
      const bool is_tyre = !moves(joint) && is_called_wheel(joint.parent);
      if (turns || is_tyre || !is_called_wheel(name) || is_called_caster(name)) continue;
      const bool slides = joint.joint.type == solver::JointType::prismatic;
      found_.stuck.push_back({name, !moves(joint) ? "`fixed`"
                                    : slides      ? "`prismatic`"
                                                  : "`revolute` with limits"});
    }
  }

  /// Around what collides with the base and around the wheels. Where the heaviest link of the base is a mesh,
  /// nobody knows.
  void find_outline() {
    std::vector<Eigen::Vector2d> corners;
    const UrdfLink* heaviest = nullptr;
    for (const UrdfLink& link : urdf_.links) {
      if (carrier(link.name) != carrier(found_.base)) continue;
      if (heaviest == nullptr || link.inertia.mass > heaviest->inertia.mass) heaviest = &link;
      for (const solver::Vector3& corner : link.corners)
        corners.emplace_back((in_base_.at(link.name) * corner).head<2>());
    }
    if (heaviest == nullptr || heaviest->corners.empty()) return;
    for (const DraftWheel& wheel : holding_wheels(found_)) {
      const Eigen::Vector2d ahead =
          wheel.radius.value_or(0.0) * Eigen::Vector2d(wheel.axle.y(), -wheel.axle.x());
      for (const double side : {-1.0, 1.0})
        corners.emplace_back(Eigen::Vector2d(wheel.at[0], wheel.at[1]) + side * ahead);
    }
    found_.outline = convex_hull(std::move(corners));
  }

  const Urdf& urdf_;
  FoundWheels found_;
  std::map<std::string, solver::Pose> in_base_;
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
  return WheelSearch(urdf).find();
}

}  // namespace zwang::lang
