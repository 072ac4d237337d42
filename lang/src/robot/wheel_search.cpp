// A wheel turns without end about a level axle, and nothing moves beyond it. Which of those do is told by the
// name
// (`wheel`), else by a round shape. A wheel behind a joint about the vertical is steered; alone on one that
// is called a caster, it has no motor.
#include "robot/wheel_search.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "tree/text.hpp"

namespace zwang::lang {

namespace {

constexpr double level = 0.1;    // |z| of an axle's direction
constexpr double upright = 0.9;  // |z| of a swivel's

bool moves(const UrdfJoint& joint) {
  return joint.joint.type != solver::JointType::fixed;
}

bool mentions(const std::string& name, const char* word) {
  return lower_case(name).find(word) != std::string::npos;
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

class WheelSearch {
 public:
  explicit WheelSearch(const Urdf& urdf) : urdf_(urdf) {
    found_.base = base();
    place_links();
  }

  FoundWheels find() {
    std::vector<const UrdfJoint*> wheels = candidates(true);
    if (wheels.empty()) wheels = candidates(false);
    for (const UrdfJoint* joint : wheels) add(*joint);
    drop_casters();
    find_balls();
    find_others();
    find_arm_reach();
    if (found_.wheels.empty()) find_wheels_that_stand();
    find_outline();
    return found_;
  }

 private:
  /// `base_link` where it is fixed to the root, as it often hangs on a footprint; else the root.
  std::string base() const {
    if (urdf_.find_link("base_link") == nullptr) return urdf_.root;
    for (const UrdfJoint* above = urdf_.joint_above("base_link"); above != nullptr;
         above = urdf_.joint_above(above->parent)) {
      if (moves(*above)) return urdf_.root;
    }
    return "base_link";
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
    const UrdfJoint* above = urdf_.joint_above(link);
    while (above != nullptr && !moves(*above)) above = urdf_.joint_above(above->parent);
    return above;
  }

  bool is_last(const UrdfJoint& joint) const {
    return std::none_of(urdf_.joints.begin(), urdf_.joints.end(), [&](const UrdfJoint& other) {
      return moves(other) && carrier(other.parent) == &joint;
    });
  }

  std::vector<const UrdfJoint*> candidates(bool by_name) const {
    std::vector<const UrdfJoint*> result;
    for (const UrdfJoint& joint : urdf_.joints) {
      const bool turns_for_ever = joint.joint.type == solver::JointType::continuous;
      if (!turns_for_ever || std::abs(axis_of(joint).z()) > level || !is_last(joint)) continue;
      const bool is_named = mentions(joint.joint.name, "wheel") || mentions(joint.child, "wheel") ||
                            mentions(joint.joint.name, "caster");
      if (by_name ? is_named : urdf_.find_link(joint.child)->radius.has_value()) result.push_back(&joint);
    }
    return result;
  }

  void add(const UrdfJoint& joint) {
    DraftWheel wheel;
    wheel.joint = joint.joint.name;
    wheel.link = joint.child;
    const solver::Vector3& at = in_base_.at(joint.child).position;
    wheel.at = {at.x(), at.y(), at.z()};
    wheel.axle = axis_of(joint).head<2>();
    wheel.radius = urdf_.find_link(joint.child)->radius;
    if (std::isfinite(joint.joint.max_effort)) wheel.effort = joint.joint.max_effort;
    for (const UrdfJoint* above = carrier(joint.parent); above != nullptr; above = carrier(above->parent)) {
      const bool slides = above->joint.type == solver::JointType::prismatic;
      if (!slides && std::abs(axis_of(*above).z()) > upright) {
        wheel.swivel = above->joint.name;
      } else {
        note(found_.in_between, above->joint.name);
      }
    }
    found_.wheels.push_back(wheel);
  }

  static void note(std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }

  void drop_casters() {
    std::map<std::string, int> on_swivel;
    for (const DraftWheel& wheel : found_.wheels) ++on_swivel[wheel.swivel];
    std::erase_if(found_.wheels, [&](const DraftWheel& wheel) {
      const bool is_caster = !wheel.swivel.empty() && on_swivel[wheel.swivel] == 1 &&
                             (mentions(wheel.swivel, "caster") || mentions(wheel.joint, "caster"));
      if (!is_caster) return false;
      found_.casters.push_back(wheel);
      passive_.insert({wheel.joint, wheel.swivel});
      return true;
    });
  }

  void find_balls() {
    for (const UrdfLink& link : urdf_.links) {
      const UrdfJoint* above = urdf_.joint_above(link.name);
      const bool is_ball = above != nullptr && !moves(*above) && carrier(above->parent) == nullptr &&
                           (mentions(link.name, "caster") || mentions(link.name, "ball"));
      if (is_ball) found_.supports.push_back(link.name);
    }
  }

  void find_others() {
    for (const UrdfJoint& joint : urdf_.joints) {
      const std::string& name = joint.joint.name;
      const bool is_known =
          !moves(joint) || passive_.contains(name) ||
          std::find(found_.in_between.begin(), found_.in_between.end(), name) != found_.in_between.end() ||
          std::any_of(found_.wheels.begin(), found_.wheels.end(),
                      [&](const DraftWheel& wheel) { return wheel.joint == name || wheel.swivel == name; });
      if (!is_known) found_.others.push_back(name);
    }
  }

  void find_arm_reach() {
    for (const UrdfLink& link : urdf_.links) {
      const UrdfJoint* above = carrier(link.name);
      if (above == nullptr || above == carrier(found_.base)) continue;
      const auto& others = found_.others;
      if (std::find(others.begin(), others.end(), above->joint.name) == others.end()) continue;
      found_.arm_reach = std::max(found_.arm_reach, in_base_.at(link.name).position.head<2>().norm());
    }
  }

  void find_wheels_that_stand() {
    for (const UrdfJoint& joint : urdf_.joints) {
      if (!moves(joint) && mentions(joint.joint.name, "wheel") && !mentions(joint.joint.name, "caster"))
        found_.wheels_that_stand.push_back(joint.joint.name);
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
    for (const DraftWheel& wheel : found_.wheels) {
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
  std::set<std::string> passive_;
};

}  // namespace

FoundWheels find_wheels(const Urdf& urdf) {
  return WheelSearch(urdf).find();
}

}  // namespace zwang::lang
