/// A URDF as links and joints. The only reader of the format.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "robot/above_base.hpp"
#include "robot/left_out.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::lang {

inline constexpr std::size_t most_links = 256;

/// Of the robot's mass: what a lighter link adds to it is less than anybody knows it by.
inline constexpr double negligible_share = 1e-3;

struct UrdfLink {
  std::string name;
  solver::RigidInertia inertia;  ///< zero where the file gives none
  Span span;
  std::optional<double> radius;  ///< [m] of its largest cylinder or sphere, of what collides if there is any
  std::optional<solver::Vector3> cylinder_axis;        ///< unit vector in the link, where that is a cylinder
  solver::Vector3 round_at = solver::Vector3::Zero();  ///< [m] in the link, the middle of that shape
  std::vector<solver::Vector3> corners;  ///< [m] in the link, of the shapes that collide; a mesh has none
  std::string mesh;  ///< file and scale of the first one: links that share one are as large, whatever that is
};

/// A <mimic>: another joint that this one follows.
struct UrdfMimic {
  std::string joint;
  double multiplier = 1.0;
  Span span;
};

struct UrdfJoint {
  std::string parent;
  std::string child;
  solver::Pose origin;  ///< X_PC at q = 0
  solver::Joint joint;  ///< named; not actuated; max_effort infinite where the file gives none
  std::optional<UrdfMimic> mimic;
  bool has_axis = false;  ///< false: the file has no <axis>, which means 1 0 0
  solver::Vector3 drawn_axis = solver::Vector3::UnitX();  ///< of the file, of joints that are fixed, too
  bool is_turned = false;                                 ///< a robot file lets it turn without end
  double coulomb = 0.0, viscous = 0.0;  ///< [N m], [N m s/rad] or [N], [N s/m] of <dynamics>
  bool has_transmission = false;        ///< a <transmission> or <ros2_control> names it, with a motor
  Span span;
};

/// Checked: one root, every link reached from it exactly once, finite numbers, unit axes, ordered limits.
struct Urdf {
  std::string name;
  std::string root;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::unordered_map<std::string, std::size_t> above;  ///< by link: in `joints`, the one that carries it
  LeftOut left_out;
  AboveBase above_base;
  std::set<std::string> looped;  ///< links that a simulator's own <joint> ties to another: no tree has loops

  const UrdfLink* find_link(const std::string& link) const;
  const UrdfJoint* find_joint(const std::string& joint) const;
  UrdfJoint* find_joint(const std::string& joint);
  const UrdfJoint* joint_above(const std::string& link) const;
  std::vector<std::string> link_names() const;
  std::vector<std::string> joint_names() const;
  double mass() const;  ///< [kg] of all links
  /// At most `negligible_share` of the robot's mass.
  bool is_negligible(const UrdfLink& link) const;
};

/// A robot file changes its URDF so, before that is looked at.
struct UrdfChanges {
  std::vector<std::string> ignored;  ///< links that are left out
  std::vector<std::string> turning;  ///< joints that turn without end
};

std::optional<Urdf> read_urdf(const std::filesystem::path& path, const Span& cause, Diagnostics& diagnostics,
                              const UrdfChanges& changes = {});
/// Of a source that was read already.
std::optional<Urdf> read_urdf(int source, Diagnostics& diagnostics, const UrdfChanges& changes = {});

}  // namespace zwang::lang
