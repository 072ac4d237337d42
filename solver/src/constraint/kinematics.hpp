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

BodyMotion motion_of_body(int body, const Model& model, const State& state) noexcept;

/// X_PB(q): the body's frame in its parent's.
Pose pose_in_parent(const Body& body, double q) noexcept;

}  // namespace zwang::solver
