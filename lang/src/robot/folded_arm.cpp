// The arms' points p_i (origins of links, corners of what collides) shall lie above the outline. No motor
// shall hold more than half of its limit. The posture q minimises, joint by joint over its travel,
//
//   sum d_i^2 + sum h_i^2 + w sum max(0, |t_j| / t_j,max - 1/2)^2 + e sum q_j^2
//
//   d_i   the distance of p_i beyond the outline
//   h_i   the depth of p_i below the lowest shoulder
//   t_j   the torque of gravity about joint j
//
// The last term prefers the joints' zeros. Collisions inside of the robot are not known, so the posture is a
// proposal.
#include "robot/folded_arm.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "diagnostic/wordings_physics.hpp"
#include "robot/gravity.hpp"
#include "zwang/lang/plane.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

namespace {

using solver::Pose;
using solver::Vector3;

constexpr double weight_of_torque = 0.1;  // [m^2] w
constexpr double weight_of_zero = 1e-4;   // [m^2] e
constexpr double least_way = 0.1;         // [m] joints that move less than this stay
constexpr double beyond = 0.01;           // [m] an outline is as exact
constexpr double kept_free = 0.05;        // of a joint's travel at each end: the guard stops an arm near it,
constexpr double start_inside = 0.08;     // and where 0 is no place to start, as far inside
constexpr int steps_of_travel = 24, most_sweeps = 6;
constexpr double degree = std::numbers::pi / 180.0;

/// A link of an arm, behind the one that carries it.
struct Part {
  const UrdfLink* link = nullptr;
  const UrdfJoint* joint = nullptr;  ///< above it
  int parent = -1;                   ///< its place among the parts; -1: the base carries it
  Pose before;                       ///< of the joint at 0, in the parent or in the base
  int coordinate = -1;               ///< its place in q; -1: it does not move
};

class ArmFold {
 public:
  ArmFold(const Urdf& urdf, const std::string& base, const std::vector<std::string>& joints,
          const std::vector<Eigen::Vector2d>& outline)
      : urdf_(urdf), joints_(joints), outline_(outline) {
    find_parts(base);
    poses_.resize(parts_.size());
    for (std::size_t j = 0; j < moving_.size(); ++j) start_.push_back(clamped(j, 0.0));
  }

  FoldedArm fold() {
    std::vector<double> q = start_;
    place(q);
    lowest_ = shoulder();
    if (reach(q) > 0.0) descend(q);
    FoldedArm folded;
    for (std::size_t j = 0; j < moving_.size(); ++j) {
      q[j] = rounded(j, q[j]);
      if (q[j] != 0.0) folded.posture[moving_[j]->joint.name] = q[j];
    }
    folded.reach = reach(q);
    return folded;
  }

 private:
  void find_parts(const std::string& base) {
    std::map<std::string, std::pair<int, Pose>> placed;  // by link: the part it belongs to, its pose in it
    placed[base] = {-1, Pose{}};
    Pose above;  // of the links up to the root
    for (const UrdfJoint* joint = urdf_.joint_above(base); joint != nullptr;
         joint = urdf_.joint_above(joint->parent)) {
      above = above * joint->origin.inverse();
      placed[joint->parent] = {-1, above};
    }
    for (bool is_growing = true; is_growing;) {
      is_growing = false;
      for (const UrdfJoint& joint : urdf_.joints) {
        const auto parent = placed.find(joint.parent);
        if (parent == placed.end() || placed.contains(joint.child)) continue;
        const auto [carrier, pose] = parent->second;
        placed[joint.child] = add(joint, carrier, pose * joint.origin);
        is_growing = true;
      }
    }
  }

  std::pair<int, Pose> add(const UrdfJoint& joint, int carrier, const Pose& before) {
    const bool moves = std::find(joints_.begin(), joints_.end(), joint.joint.name) != joints_.end();
    if (!moves && carrier < 0) return {-1, before};
    Part part{urdf_.find_link(joint.child), &joint, carrier, before, -1};
    if (moves) {
      part.coordinate = static_cast<int>(moving_.size());
      moving_.push_back(&joint);
    }
    parts_.push_back(part);
    return {static_cast<int>(parts_.size()) - 1, Pose{}};
  }

  /// The travel without its ends. Where a joint stands at an end at 0, a gripper or a lift, it rests on it.
  std::pair<double, double> free_travel(std::size_t j, double share) const {
    const solver::Joint& joint = moving_[j]->joint;
    if (!std::isfinite(joint.lower) || !std::isfinite(joint.upper)) return {joint.lower, joint.upper};
    const double margin = share * (joint.upper - joint.lower);
    constexpr double rounding = 1e-6;
    return {std::abs(joint.lower) < rounding ? joint.lower : joint.lower + margin,
            std::abs(joint.upper) < rounding ? joint.upper : joint.upper - margin};
  }

  double clamped(std::size_t j, double q) const {
    const auto [low, high] = free_travel(j, start_inside);
    return std::clamp(q, low, high);
  }

  /// To a degree or a millimetre, inside of the travel.
  double rounded(std::size_t j, double q) const {
    const double step = moving_[j]->joint.type == solver::JointType::prismatic ? 1e-3 : degree;
    const auto [low, high] = free_travel(j, kept_free);
    double value = std::round(q / step);
    while (value * step > high && (value - 1.0) * step >= low) --value;
    while (value * step < low && (value + 1.0) * step <= high) ++value;
    return value == 0.0 ? 0.0 : value * step;
  }

  void place(const std::vector<double>& q) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Part& part = parts_[i];
      Pose moved;
      if (part.coordinate >= 0) {
        const double angle = q[static_cast<std::size_t>(part.coordinate)];
        if (part.joint->joint.type == solver::JointType::prismatic) {
          moved.position = angle * part.joint->joint.axis;
        } else {
          moved.rotation = Eigen::AngleAxisd(angle, part.joint->joint.axis).toRotationMatrix();
        }
      }
      const Pose placed = part.before * moved;
      poses_[i] = part.parent < 0 ? placed : poses_[static_cast<std::size_t>(part.parent)] * placed;
    }
  }

  double shoulder() const {
    double lowest = solver::infinity;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].parent < 0) lowest = std::min(lowest, poses_[i].position.z());
    }
    return lowest;
  }

  template <typename Visit>
  void each_point(const Visit& visit) const {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      visit(poses_[i].position);
      for (const Vector3& corner : parts_[i].link->corners) visit(poses_[i] * corner);
    }
  }

  double outside(const Vector3& point) const {
    const Eigen::Vector2d flat = point.head<2>();
    return plane::contains(outline_, flat) ? 0.0 : plane::distance_to_edges(outline_, flat);
  }

  double reach(const std::vector<double>& q) {
    place(q);
    double most = 0.0;
    each_point([&](const Vector3& point) {
      if (outside(point) > beyond) most = std::max(most, point.head<2>().norm());
    });
    return most;
  }

  double cost(const std::vector<double>& q) {
    place(q);
    double sum = 0.0;
    each_point([&](const Vector3& point) {
      const double d = outside(point), h = std::max(0.0, lowest_ - point.z());
      sum += d * d + h * h;
    });
    for (std::size_t j = 0; j < q.size(); ++j)
      sum += weight_of_zero * (q[j] - start_[j]) * (q[j] - start_[j]);
    return sum + weight_of_torque * overload();
  }

  /// sum max(0, |t_j| / t_j,max - 1/2)^2
  double overload() const {
    std::vector<double> mass(parts_.size(), 0.0);
    std::vector<Vector3> moment(parts_.size(), Vector3::Zero());
    double sum = 0.0;
    for (std::size_t i = parts_.size(); i-- > 0;) {
      const Part& part = parts_[i];
      const solver::RigidInertia& inertia = part.link->inertia;
      mass[i] += inertia.mass;
      moment[i] += inertia.mass * poses_[i].position + poses_[i].rotation * inertia.first_moment;
      if (part.parent >= 0) {
        mass[static_cast<std::size_t>(part.parent)] += mass[i];
        moment[static_cast<std::size_t>(part.parent)] += moment[i];
      }
      if (part.coordinate < 0 || !std::isfinite(part.joint->joint.max_effort)) continue;
      const Vector3 axis = poses_[i].rotation * part.joint->joint.axis;
      const Vector3 lever = moment[i] - mass[i] * poses_[i].position;
      const bool slides = part.joint->joint.type == solver::JointType::prismatic;
      const double held = slides ? mass[i] * axis.z() : axis.dot(lever.cross(Vector3::UnitZ()));
      const double excess = std::abs(gravity * held) / part.joint->joint.max_effort - 0.5;
      sum += std::max(0.0, excess) * std::max(0.0, excess);
    }
    return sum;
  }

  /// How far the joint can carry what hangs on it. [m]
  double way(std::size_t j) const {
    double most = 0.0;
    std::vector<bool> hangs(parts_.size(), false);
    const Vector3* at = nullptr;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Part& part = parts_[i];
      const bool is_it = part.coordinate == static_cast<int>(j);
      hangs[i] = is_it || (part.parent >= 0 && hangs[static_cast<std::size_t>(part.parent)]);
      if (is_it) at = &poses_[i].position;
      if (hangs[i] && at != nullptr) most = std::max(most, (poses_[i].position - *at).norm());
    }
    return most;
  }

  /// The values that the search tries of a joint.
  std::vector<double> tried(std::size_t j, double q, double width) const {
    const solver::Joint& joint = moving_[j]->joint;
    double low = joint.lower, high = joint.upper;
    if (!std::isfinite(low) || !std::isfinite(high)) low = -std::numbers::pi, high = std::numbers::pi;
    const double margin = kept_free * (high - low), span = (high - low - 2.0 * margin) * width;
    std::vector<double> values;
    for (int k = 0; k <= steps_of_travel; ++k) {
      const double value = (width < 1.0 ? q - 0.5 * span : low + margin) + span * k / steps_of_travel;
      if (value >= low + margin && value <= high - margin) values.push_back(value);
    }
    return values;
  }

  void descend(std::vector<double>& q) {
    double best = cost(q);
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      const double before = best;
      for (std::size_t j = 0; j < q.size(); ++j) {
        if (way(j) < least_way) continue;
        const double was = q[j];
        double chosen = was;
        for (const double value : tried(j, was, sweep < most_sweeps / 2 ? 1.0 : 0.1)) {
          q[j] = value;
          const double now = cost(q);
          if (now < best - 1e-12) best = now, chosen = value;
        }
        q[j] = chosen;
      }
      if (best > 0.999 * before && sweep >= most_sweeps / 2) return;
    }
  }

  const Urdf& urdf_;
  const std::vector<std::string>& joints_;
  const std::vector<Eigen::Vector2d>& outline_;
  std::vector<Part> parts_;  ///< carriers first
  std::vector<const UrdfJoint*> moving_;
  std::vector<Pose> poses_;  ///< of the parts in the base
  std::vector<double> start_;
  double lowest_ = 0.0;  ///< [m] of the shoulders, in the base
};

std::string value_text(const UrdfJoint& joint, double q) {
  return joint.joint.type == solver::JointType::prismatic ? wording::figure(q * 1e3, "mm")
                                                          : wording::figure(q / degree, "deg");
}

}  // namespace

std::string posture_entry(const Urdf& urdf, const FoldedArm& folded) {
  if (folded.posture.empty()) return "";
  std::string text =
      "\n# How the joints stand at the start. Proposed: an arm folded above the base as far as it goes, "
      "steered "
      "wheels\n# rolling ahead. What would touch inside of the robot is not looked at.\nposture:\n";
  for (const auto& [joint, q] : folded.posture)
    text += "  " + joint + ": " + value_text(*urdf.find_joint(joint), q) + "\n";
  return text;
}

FoldedArm fold_arm(const Urdf& urdf, const std::string& base, const std::vector<std::string>& joints,
                   const std::vector<Eigen::Vector2d>& outline) {
  return ArmFold(urdf, base, joints, outline).fold();
}

}  // namespace zwang::lang
