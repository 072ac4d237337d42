/// Pose and twist of single bodies: the chain from a body back to the base.
#pragma once

#include "zwang/solver/frame.hpp"

namespace zwang::solver {

/// In the world.
FrameMotion motion_of_base(const Model& model, const State& state) noexcept;

/// A body's from its parent's, `q` and `qd` of the joint between them.
FrameMotion motion_on_parent(const Body& body, double q, double qd, const FrameMotion& parent) noexcept;

/// While the base moves as given: with FrameMotion{} against the base, in its axes.
FrameMotion motion_of_body(int body, const Model& model, const State& state,
                           const FrameMotion& base) noexcept;

}  // namespace zwang::solver
