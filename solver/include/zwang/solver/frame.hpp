/// Frames on the robot's bodies and in the world, and how they move.
#pragma once

#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

/// A frame fixed to a body, or to the world (body = -1).
struct AttachedFrame {
  int body = -1;
  Pose pose;           ///< in the body's frame, or in the world
  MotionVector twist;  ///< of a frame in the world that moves (an observed object), in its own axes and at
                       ///< its origin; its acceleration counts as 0. Ignored on a body.
};

/// Pose and twist of a frame in the world: X_WF, and in world axes the twist with the linear part of the
/// frame's origin.
struct FrameMotion {
  Pose pose;
  Vector3 angular = Vector3::Zero();  ///< [rad/s]
  Vector3 linear = Vector3::Zero();   ///< [m/s]

  /// In the frame's own axes, at its origin.
  MotionVector own_twist() const {
    return {pose.rotation.transpose() * angular, pose.rotation.transpose() * linear};
  }

  /// Of a frame that this one carries at X_FG.
  FrameMotion at(const Pose& pose_in_frame) const {
    const Vector3 arm = pose.rotation * pose_in_frame.position;
    return {
        {pose.rotation * pose_in_frame.rotation, pose.position + arm}, angular, linear + angular.cross(arm)};
  }
};

/// The motion of bodies at one state, each worked out when it is first asked for: bodies share their
/// carriers, and those who ask share bodies. After construction nothing allocates, locks, throws or prints.
class ZWANG_EXPORT BodyMotions {
 public:
  /// Remembers `capacity` bodies; more are worked out anew each time.
  explicit BodyMotions(std::size_t capacity);

  /// Forgets what it knew. Model and state must live, unchanged, as long as they are asked about. Call it
  /// before the first question.
  void start(const Model& model, const State& state) noexcept;
  /// Of a body of the model, from 0 on. To be read before the next question.
  const FrameMotion& of(int body) noexcept;
  /// Of a frame on a body or in the world.
  FrameMotion of(const AttachedFrame& frame) noexcept;
  /// A body's, in its own axes and at its origin.
  MotionVector twist_of(int body) noexcept;
  /// Without a copy where the frame is a body's own; else in `place`.
  const FrameMotion& of(const AttachedFrame& frame, FrameMotion& place) noexcept;
  /// X_WF alone, likewise.
  const Pose& pose_of(const AttachedFrame& frame, Pose& place) noexcept;

 private:
  struct Known {
    int body = 0;
    FrameMotion motion;
  };
  const Model* model_ = nullptr;
  const State* state_ = nullptr;
  std::vector<Known> known_;
  Known forgotten_;  ///< the last that found no room
};

/// Of a single frame. Does not allocate, lock, throw or print.
ZWANG_EXPORT FrameMotion motion_of(const AttachedFrame& frame, const Model& model,
                                   const State& state) noexcept;

}  // namespace zwang::solver
