/// Where the links of a URDF stand in its base while all joints are at 0, and what moves them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "robot/urdf.hpp"

namespace zwang::lang {

/// False of a joint whose limits leave it no travel, as exporters write them who do not know.
bool has_travel(const UrdfJoint& joint);

class PlacedUrdf {
 public:
  static constexpr double level = 0.1;    ///< |z| of an axle's direction
  static constexpr double upright = 0.9;  ///< |z| of a swivel's
  static constexpr double slack = 0.2;    ///< of a radius: as far off a round shape is drawn beside its place

  PlacedUrdf(const Urdf& urdf, std::string base);

  const Urdf& urdf() const { return urdf_; }
  const std::string& base() const { return base_; }
  const solver::Pose& pose_of(const std::string& link) const { return in_base_.at(link); }
  /// [m] Of the link that a joint moves.
  const solver::Vector3& place_of(const UrdfJoint& joint) const { return in_base_.at(joint.child).position; }
  solver::Vector3 axis_of(const UrdfJoint& joint) const {
    return in_base_.at(joint.child).rotation * joint.joint.axis;
  }

  /// The nearest joint above a link that has travel; nullptr when the link is fixed to the base.
  const UrdfJoint* carrier(const std::string& link) const;
  /// All of them, from the link up to the base.
  std::vector<const UrdfJoint*> carriers(const std::string& link) const;
  /// Joints with travel whose carrier is this one.
  std::vector<const UrdfJoint*> carried_by(const UrdfJoint& joint) const;

  /// [m] Of a wheel, whose tyre may be a link of its own.
  std::optional<double> radius_of(const UrdfJoint& joint) const;
  /// [m] The height at which that wheel ends.
  std::optional<double> lowest_of(const UrdfJoint& joint) const;
  bool turns_about_level_axle(const UrdfJoint& joint) const;

 private:
  const Urdf& urdf_;
  std::string base_;
  std::map<std::string, solver::Pose> in_base_;
};

}  // namespace zwang::lang
