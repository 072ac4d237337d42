/// Pose and twist of single bodies: the chain from a body back to the base.
#pragma once

#include "zwang/solver/constraint.hpp"

namespace zwang::solver {

/// Motion of a body's frame in world axes.
struct BodyMotion : FrameMotion {
  /// Of a frame fixed to the body.
  FrameMotion at(const Pose& pose_in_body) const {
    const Vector3 arm = pose.rotation * pose_in_body.position;
    return {pose * pose_in_body, angular, linear + angular.cross(arm)};
  }
};

/// In the world.
BodyMotion motion_of_base(const Model& model, const State& state) noexcept;

/// A body's from its parent's, `q` and `qd` of the joint between them.
BodyMotion motion_on_parent(const Body& body, double q, double qd, const BodyMotion& parent) noexcept;

/// While the base moves as given: with BodyMotion{} against the base, in its axes.
BodyMotion motion_of_body(int body, const Model& model, const State& state, const BodyMotion& base) noexcept;

}  // namespace zwang::solver
