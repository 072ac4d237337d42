/// The robot as the solver sees it: a tree of rigid bodies, and the wheels that tie it to the ground.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::solver {

/// The motion of a joint. `continuous` turns without end.
enum class JointType { fixed, revolute, continuous, prismatic };

/// A joint of one freedom between a body and its parent.
struct Joint {
  std::string name;
  JointType type = JointType::fixed;
  Vector3 axis = Vector3::UnitX();  ///< unit vector, in the body's frame
  double rotor_inertia = 0.0;  ///< d [kg m^2] or [kg], reflected to the joint: gear^2 times the rotor's own
  bool actuated = false;       ///< a motor turns or slides it
  double max_effort = std::numeric_limits<double>::infinity();    ///< [N m] or [N], limit of |tau|
  double max_velocity = std::numeric_limits<double>::infinity();  ///< [rad/s] or [m/s]
  double lower = -std::numeric_limits<double>::infinity();        ///< [rad] or [m] least q
  double upper = std::numeric_limits<double>::infinity();         ///< [rad] or [m] largest q
};

/// A moving body. Body 0 is the base; body i > 0 hangs on its parent by the joint number i - 1.
struct Body {
  std::string name;
  int parent = -1;      ///< index of the parent body, smaller than the own one; -1 for the base
  Pose pose_in_parent;  ///< X_PJ at q = 0
  Joint joint;
  RigidInertia inertia;  ///< about the body frame's origin; links on fixed joints are merged in
};

/// A named frame fixed to a body: every link of the robot's description (merged ones too), and declared ones.
struct Frame {
  std::string name;
  int body = 0;
  Pose pose_in_body;  ///< X_BF
};

/// A wheel on flat ground (normal +z of the world). It adds one sliding constraint for each direction that it
/// holds.
struct Wheel {
  int body = 0;         ///< the body that rolls
  double radius = 0.0;  ///< [m]
  bool holds_rolling = true;
  bool holds_sideways = true;
  /// A mecanum or omni wheel holds one direction only: the axis of the roller at the ground. The angle goes
  /// from the wheel's axis to that direction, about the vertical. [rad]
  std::optional<double> roller_angle;

  int held_directions() const {
    return roller_angle ? 1 : static_cast<int>(holds_rolling) + static_cast<int>(holds_sideways);
  }
};

/// The support of a base, which decides which of its freedoms are left.
enum class BaseType {
  fixed,     ///< bolted to the world
  floating,  ///< six freedoms
  ground,    ///< floating, with z, rx and ry held by the ground: the partially constrained floating base of a
             ///< mobile robot
};

/// A tree of rigid bodies. Build it with `ModelBuilder`; const afterwards.
class ZWANG_EXPORT Model {
 public:
  BaseType base_type() const { return base_type_; }
  bool has_fixed_base() const { return base_type_ == BaseType::fixed; }
  const std::vector<Body>& bodies() const { return bodies_; }
  const std::vector<Frame>& frames() const { return frames_; }
  const std::vector<Wheel>& wheels() const { return wheels_; }
  const Vector3& gravity() const { return gravity_; }  ///< [m/s^2] in the world
  /// [rad] By which a wheel that a motor steers may point aside and hold nothing. 0: the ground is exact.
  double steering_error() const { return steering_error_; }

  /// Number of joints: entries of q, qd, qdd, tau. Joint j moves body j + 1.
  int joint_count() const { return static_cast<int>(bodies_.size()) - 1; }
  int body_count() const { return static_cast<int>(bodies_.size()); }
  const Joint& joint(int j) const { return bodies_[static_cast<std::size_t>(j) + 1].joint; }
  /// Whether the joints of the other model have the same names in the same order.
  bool has_joints_of(const Model& other) const;
  double total_mass() const;  ///< [kg], moving bodies

  /// The index into `frames()`; nullopt if no frame has this name.
  std::optional<int> find_frame(std::string_view name) const;
  /// The index j of `joint(j)`, q, qd and tau; nullopt if no joint has this name.
  std::optional<int> find_joint(std::string_view name) const;

 private:
  friend class ModelBuilder;
  BaseType base_type_ = BaseType::ground;
  Vector3 gravity_{0.0, 0.0, -9.81};
  double steering_error_ = 0.0;
  std::vector<Body> bodies_;
  std::vector<Frame> frames_;
  std::vector<Wheel> wheels_;
};

/// Builds a model link by link, parents first. Throws std::invalid_argument on a model that dynamics cannot
/// use. The functions that add throw on an unknown parent, a doubled name, a zero axis or a non-finite
/// number. `build` throws if a moving body has mass <= 0, or an inertia that is not positive definite or
/// breaks the triangle rule.
class ZWANG_EXPORT ModelBuilder {
 public:
  /// `base_inertia` is about the origin of the base's frame, in its axes.
  ModelBuilder(BaseType base_type, std::string base_name, const RigidInertia& base_inertia);

  /// Adds a link that hangs on the link (or frame) `parent`. A fixed joint merges it into the body it is
  /// fixed to; its name stays as a frame. `pose_in_parent` is X_PJ at q = 0. The axis need not have the
  /// length 1. `inertia` is about the link's origin, in its axes.
  ModelBuilder& add_link(const std::string& name, const std::string& parent, const Pose& pose_in_parent,
                         const Joint& joint, const RigidInertia& inertia);
  /// Names a frame fixed to the link (or frame) `parent`.
  ModelBuilder& add_frame(const std::string& name, const std::string& parent, const Pose& pose_in_parent);
  /// Declares the body moved by the joint `joint` a wheel; `wheel.body` is filled in. The joint turns, and
  /// the radius is above 0.
  ModelBuilder& add_wheel(const std::string& joint, Wheel wheel);
  /// [m/s^2] in the world; without a call (0, 0, -9.81).
  ModelBuilder& set_gravity(const Vector3& gravity);
  /// [rad] from 0 to 0.1; without a call 0. The lines of steered wheels that nearly depend on each other do.
  ModelBuilder& set_steering_error(double angle);

  /// Checks the inertias. The builder may go on.
  Model build() const;

 private:
  const Frame& frame(const std::string& name) const;
  Model model_;
};

}  // namespace zwang::solver
