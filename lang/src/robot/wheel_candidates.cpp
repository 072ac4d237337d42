// A wheel turns without end about a level axle, and nothing moves beyond it but its own rollers. It is
// called a wheel, or it is round and stands as low as the named ones. Else its place tells: its axle is as
// high as that of the wheels, and another one like it is on the same line.
#include "robot/wheel_candidates.hpp"

#include <algorithm>
#include <cmath>

#include "robot/wheel_names.hpp"

namespace zwang::lang {

namespace {

/// Of the distance between two axles: as much their heights may differ, where no radius is known.
constexpr double level_share = 0.05;
/// Between base and wheel: a swivel and a spring.
constexpr std::size_t most_carriers = 2;

bool is_named_wheel(const UrdfJoint& joint) {
  return is_called_wheel(joint.joint.name) || is_called_wheel(joint.child) ||
         is_called_caster(joint.joint.name);
}

using Joints = std::vector<const UrdfJoint*>;

bool holds(const Joints& joints, const UrdfJoint* joint) {
  return std::find(joints.begin(), joints.end(), joint) != joints.end();
}

class CandidateSearch {
 public:
  explicit CandidateSearch(const PlacedUrdf& placed) : placed_(placed), urdf_(placed.urdf()) {}

  WheelCandidates search() {
    find_rollers();
    find_ball_casters();
    sort_by_name_and_shape();
    Joints wheels = named_;
    const std::optional<double> ground = ground_of(named_.empty() ? round_ : named_);
    for (const UrdfJoint* joint : round_) {
      if (ground && !holds(wheels, joint) && stands_at(*ground, *joint)) wheels.push_back(joint);
    }
    add_by_place(wheels);
    add_counterparts(wheels);
    for (const UrdfJoint& joint : urdf_.joints) {
      if (holds(wheels, &joint)) found_.wheels.push_back(&joint);
    }
    return found_;
  }

 private:
  /// Joints in a ring around the axle of a wheel, which turn without end and across it.
  void find_rollers() {
    constexpr std::size_t fewest = 3;
    for (const UrdfJoint& joint : urdf_.joints) {
      if (!placed_.turns_about_level_axle(joint)) continue;
      const Joints below = placed_.carried_by(joint);
      double least = 0.0, most = 0.0;
      const bool are_rollers = std::all_of(below.begin(), below.end(), [&](const UrdfJoint* roller) {
        const solver::Vector3 axle = placed_.axis_of(joint);
        const double off = (placed_.place_of(*roller) - placed_.place_of(joint)).cross(axle).norm();
        least = roller == below.front() ? off : std::min(least, off);
        most = std::max(most, off);
        return roller->joint.type == solver::JointType::continuous && placed_.carried_by(*roller).empty() &&
               placed_.axis_of(*roller).cross(axle).norm() > 0.3;
      });
      if (!are_rollers || below.size() < fewest || !(least > 0.8 * most)) continue;
      double rim = most;
      for (const UrdfJoint* roller : below) {
        found_.rollers.push_back(roller->joint.name);
        rim = std::max(rim, most + urdf_.find_link(roller->child)->radius.value_or(0.0));
      }
      const bool is_known = urdf_.find_link(below.front()->child)->radius.has_value();
      if (is_known) found_.rims[&joint] = rim;
    }
  }

  void find_ball_casters() {
    for (const UrdfLink& link : urdf_.links) {
      if (!link.radius || link.cylinder_axis) continue;
      const solver::Vector3 middle = placed_.pose_of(link.name) * link.round_at;
      BallCaster ball{link.name, middle.z() - *link.radius, {}, true};
      std::vector<solver::Vector3> axes;
      for (const UrdfJoint* above : placed_.carriers(link.name)) {
        ball.is_on_base = above->joint.type == solver::JointType::continuous &&
                          (placed_.place_of(*above) - middle).norm() < PlacedUrdf::slack * *link.radius;
        if (!ball.is_on_base) break;
        ball.joints.push_back(above->joint.name);
        const solver::Vector3 axis = placed_.axis_of(*above);
        if (std::abs(axis.z()) <= PlacedUrdf::level) axes.push_back(axis);
      }
      const bool crosses = std::any_of(axes.begin(), axes.end(), [&](const solver::Vector3& axis) {
        return axis.cross(axes.front()).norm() > PlacedUrdf::upright;
      });
      if (crosses && ball.joints.size() >= 3) found_.balls.push_back(ball);
    }
  }

  bool is_part_of_another(const UrdfJoint& joint) const {
    const std::string& name = joint.joint.name;
    if (std::find(found_.rollers.begin(), found_.rollers.end(), name) != found_.rollers.end()) return true;
    return std::any_of(found_.balls.begin(), found_.balls.end(), [&](const BallCaster& ball) {
      return std::find(ball.joints.begin(), ball.joints.end(), name) != ball.joints.end();
    });
  }

  bool is_last(const UrdfJoint& joint) const {
    const Joints below = placed_.carried_by(joint);
    return std::all_of(below.begin(), below.end(),
                       [&](const UrdfJoint* other) { return is_part_of_another(*other); });
  }

  void sort_by_name_and_shape() {
    for (const UrdfJoint& joint : urdf_.joints) {
      if (!placed_.turns_about_level_axle(joint) || is_part_of_another(joint) || !is_last(joint)) continue;
      const bool is_named = is_named_wheel(joint), is_round = placed_.lowest_of(joint).has_value();
      if (is_named) named_.push_back(&joint);
      if (is_round) round_.push_back(&joint);
      if (!is_named && !is_round) plain_.push_back(&joint);
    }
  }

  /// The lowest end of those whose radius is known. [m]
  std::optional<double> ground_of(const Joints& joints) const {
    std::optional<double> ground;
    for (const UrdfJoint* joint : joints) {
      const std::optional<double> low = placed_.lowest_of(*joint);
      if (low) ground = std::min(*low, ground.value_or(*low));
    }
    return ground;
  }

  bool stands_at(double ground, const UrdfJoint& joint) const {
    return std::abs(*placed_.lowest_of(joint) - ground) < PlacedUrdf::slack * *placed_.radius_of(joint);
  }

  bool are_level(const UrdfJoint& a, const UrdfJoint& b) const {
    const solver::Vector3 between = placed_.place_of(b) - placed_.place_of(a);
    return std::abs(between.z()) < level_share * between.head<2>().norm();
  }

  /// On one axle line, and apart: left and right.
  bool are_a_pair(const UrdfJoint& a, const UrdfJoint& b) const {
    const solver::Vector3 between = placed_.place_of(b) - placed_.place_of(a);
    const double apart = between.norm();
    return &a != &b && placed_.axis_of(a).cross(placed_.axis_of(b)).norm() < PlacedUrdf::level &&
           between.cross(placed_.axis_of(a)).norm() < level_share * apart;
  }

  /// The largest distance of two of them. [m]
  double spread_of(const Joints& joints) const {
    double most = 0.0;
    for (const UrdfJoint* a : joints) {
      for (const UrdfJoint* b : joints)
        most = std::max(most, (placed_.place_of(*a) - placed_.place_of(*b)).norm());
    }
    return most;
  }

  /// Left and right are alike: where a wheel has no other on its axle, the joint at its mirrored place is
  /// one, too, though its shape is smaller. Some files draw a mark where a tyre is.
  void add_counterparts(Joints& wheels) {
    for (const UrdfJoint* wheel : Joints(wheels)) {
      const auto is_other_side = [&](const UrdfJoint* other) { return are_a_pair(*wheel, *other); };
      if (std::any_of(wheels.begin(), wheels.end(), is_other_side)) continue;
      for (const Joints* joints : {&round_, &plain_}) {
        for (const UrdfJoint* joint : *joints) {
          if (joint->parent != wheel->parent || !are_a_pair(*wheel, *joint) || !is_mirrored(*wheel, *joint))
            continue;
          wheels.push_back(joint);
          const std::optional<double> radius = placed_.radius_of(*wheel), own = placed_.radius_of(*joint);
          if (radius && own.value_or(0.0) < *radius) found_.rims[joint] = *radius;
        }
      }
    }
  }

  /// [m] From the base's middle along the axle, one is as far as the other.
  bool is_mirrored(const UrdfJoint& a, const UrdfJoint& b) const {
    const solver::Vector3& at = placed_.place_of(a);
    const solver::Vector3& other = placed_.place_of(b);
    return std::abs((at + other).dot(placed_.axis_of(a))) < level_share * (at - other).norm();
  }

  /// As gears of an axle are, between its wheels.
  bool is_between(const UrdfJoint& joint, const Joints& wheels) const {
    double least = 0.0, most = 0.0;
    for (const Joints* joints : {&plain_, &wheels}) {
      for (const UrdfJoint* other : *joints) {
        if (!are_a_pair(joint, *other)) continue;
        const double along = (placed_.place_of(*other) - placed_.place_of(joint)).dot(placed_.axis_of(joint));
        least = std::min(least, along);
        most = std::max(most, along);
      }
    }
    return least < 0.0 && most > 0.0;
  }

  bool is_carried_as_a_wheel(const UrdfJoint& joint) const {
    return placed_.carriers(joint.parent).size() <= most_carriers;
  }

  void add_by_place(Joints& wheels) const {
    if (wheels.empty()) return add_lowest(wheels);
    const Joints known = wheels;
    const double spread = spread_of(known);
    for (const UrdfJoint* joint : plain_) {
      const auto is_level_with = [&](const UrdfJoint* wheel) { return are_level(*joint, *wheel); };
      const auto is_other_side = [&](const UrdfJoint* other) {
        return are_a_pair(*joint, *other) &&
               (placed_.place_of(*joint) - placed_.place_of(*other)).norm() > 0.2 * spread;
      };
      if (is_carried_as_a_wheel(*joint) && !is_between(*joint, known) &&
          std::all_of(known.begin(), known.end(), is_level_with) &&
          std::any_of(plain_.begin(), plain_.end(), is_other_side))
        wheels.push_back(joint);
    }
  }

  /// Pairs, each on an axle of its own, are wheels of another size where they hang nearly as low.
  void add_other_axles(Joints& level) const {
    constexpr double other_size = 0.1;  // of the distance of two axles, their heights may differ
    const Joints known = level;
    for (const UrdfJoint* joint : plain_) {
      const auto hangs_as_low = [&](const UrdfJoint* wheel) {
        const solver::Vector3 between = placed_.place_of(*joint) - placed_.place_of(*wheel);
        return joint->parent == wheel->parent &&
               placed_.axis_of(*joint).cross(placed_.axis_of(*wheel)).norm() < PlacedUrdf::level &&
               std::abs(between.z()) < other_size * between.head<2>().norm();
      };
      const auto is_other_side = [&](const UrdfJoint* other) {
        return are_a_pair(*joint, *other) && is_mirrored(*joint, *other);
      };
      if (!holds(known, joint) && std::all_of(known.begin(), known.end(), hangs_as_low) &&
          std::any_of(plain_.begin(), plain_.end(), is_other_side) && !is_between(*joint, {}))
        level.push_back(joint);
    }
  }

  /// For a URDF in which no link is called a wheel and none is round. Adds all links that are level with the
  /// lowest pair, if no other moving link reaches as low.
  void add_lowest(Joints& wheels) const {
    const UrdfJoint* lowest = nullptr;
    for (const UrdfJoint* joint : plain_) {
      const bool has_partner = std::any_of(plain_.begin(), plain_.end(), [&](const UrdfJoint* other) {
        return other != joint && are_level(*joint, *other);
      });
      if (!has_partner || !is_carried_as_a_wheel(*joint)) continue;
      if (lowest == nullptr || placed_.place_of(*joint).z() < placed_.place_of(*lowest).z()) lowest = joint;
    }
    if (lowest == nullptr) return;
    Joints level{lowest};
    for (const UrdfJoint* joint : plain_) {
      if (joint != lowest && is_carried_as_a_wheel(*joint) && are_level(*lowest, *joint) &&
          !is_between(*joint, {}))
        level.push_back(joint);
    }
    add_other_axles(level);
    const double below = placed_.place_of(*lowest).z() - level_share * spread_of(level);
    const bool is_pair_there = std::any_of(level.begin(), level.end(), [&](const UrdfJoint* a) {
      return std::any_of(level.begin(), level.end(), [&](const UrdfJoint* b) { return are_a_pair(*a, *b); });
    });
    const bool is_undercut =
        std::any_of(urdf_.joints.begin(), urdf_.joints.end(), [&](const UrdfJoint& other) {
          return has_travel(other) && !is_part_of_another(other) && placed_.place_of(other).z() < below;
        });
    if (is_undercut || (!is_pair_there && level.size() < 3)) return;
    wheels = level;
  }

  const PlacedUrdf& placed_;
  const Urdf& urdf_;
  WheelCandidates found_;
  Joints named_, round_, plain_;
};

}  // namespace

WheelCandidates wheel_candidates(const PlacedUrdf& placed) {
  return CandidateSearch(placed).search();
}

}  // namespace zwang::lang
