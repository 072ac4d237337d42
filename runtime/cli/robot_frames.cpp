// The places and directions of a robot's frames. A force at a frame, `estimated.FRAME.x`, counts along its
// axes. A URDF turns the frames of an arm as its joints need it: the x axis of a tool may point to the left.
#include "robot_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "zwang/solver/frame.hpp"

namespace zwang::cli {

/// Frames of wheels turn with them, and a link's own frame is one of a joint: only what is fixed beside.
std::vector<SeenFrame> frames_at_start(const lang::Robot& robot) {
  const solver::State state = lang::start_state(robot);
  const solver::Pose to_base = state.base_pose.inverse();
  std::vector<SeenFrame> all;
  for (const solver::Frame& frame : robot.model.frames()) {
    const bool turns = std::ranges::any_of(robot.model.wheels(),
                                           [&](const solver::Wheel& w) { return w.body == frame.body; });
    const bool is_a_link = frame.pose_in_body.position.isZero(1e-12) &&
                           frame.pose_in_body.rotation.isApprox(solver::Matrix3::Identity());
    if (turns || is_a_link) continue;
    const solver::AttachedFrame attached{frame.body, frame.pose_in_body, {}};
    all.push_back({frame.name, to_base * solver::motion_of(attached, robot.model, state).pose});
  }
  return all;
}

namespace {

std::string figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", std::abs(value) < 5e-4 ? 0.0 : value);
  return text;
}

std::string triple(const solver::Vector3& v) {
  return "(" + figure(v.x()) + ", " + figure(v.y()) + ", " + figure(v.z()) + ")";
}

/// "ahead", "left", "up" or their opposites; its parts where it lies more than 2.6 deg beside each of them.
std::string pointing(const solver::Vector3& axis) {
  constexpr std::array words{"ahead", "left", "up", "back", "right", "down"};
  constexpr double least_cosine = 0.999;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(axis(k)) >= least_cosine) return words[static_cast<std::size_t>(axis(k) > 0.0 ? k : k + 3)];
  }
  return triple(axis);
}

}  // namespace

std::string frames_text(const lang::Robot& robot) {
  std::string text;
  for (const SeenFrame& frame : frames_at_start(robot)) {
    text += "  " + frame.name + ": at " + triple(frame.pose.position) + " m, x " +
            pointing(frame.pose.rotation.col(0)) + ", y " + pointing(frame.pose.rotation.col(1)) + ", z " +
            pointing(frame.pose.rotation.col(2)) + "\n";
  }
  return text.empty() ? "" : "\nframes, in the base at the start\n" + text;
}

}  // namespace zwang::cli
