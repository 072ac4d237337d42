#include "robot/draft_frames.hpp"

#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"

namespace zwang::lang {

namespace {

std::string metres(double value) {
  return wording::figure(std::abs(value) < 1e-9 ? 0.0 : value, "m");
}

std::string corner_text(const Eigen::Vector2d& corner) {
  return "[" + metres(corner.x()) + ", " + metres(corner.y()) + "]";
}

std::string polygon_text(const std::vector<Eigen::Vector2d>& corners) {
  std::string text;
  for (const Eigen::Vector2d& corner : corners) text += (text.empty() ? "" : ", ") + corner_text(corner);
  return "[" + text + "]";
}

/// Half of the rectangle around all wheels. [m]
Eigen::Vector2d reach_of(const FoundWheels& found) {
  Eigen::Vector2d most{0.1, 0.1};
  for (const auto* wheels : {&found.wheels, &found.idle, &found.casters}) {
    for (const DraftWheel& wheel : *wheels) {
      most.x() = std::max(most.x(), std::abs(wheel.at[0]) + wheel.radius.value_or(0.1));
      most.y() = std::max(most.y(), std::abs(wheel.at[1]));
    }
  }
  return most;
}

std::vector<Eigen::Vector2d> rectangle(const Eigen::Vector2d& half) {
  return {half, {-half.x(), half.y()}, -half, {half.x(), -half.y()}};
}

}  // namespace

DraftFrames::DraftFrames(const Urdf& urdf, const FoundWheels& found, DriveKind drive,
                         const DraftOptions& options)
    : urdf_(urdf), found_(found), drive_(drive), options_(options) {}

std::vector<Eigen::Vector2d> DraftFrames::outline() const {
  return outline_is_known() ? found_.outline : rectangle(reach_of(found_));
}

std::string DraftFrames::around_wheels() const {
  return polygon_text(rectangle(reach_of(found_)));
}

bool DraftFrames::has_nose() const {
  return outline_is_known() || drive_ == DriveKind::differential;
}

std::string DraftFrames::base_and_lead() const {
  std::string base = "base: " + found_.base, lead = "lead: nose";
  const bool has_lead = drive_ == DriveKind::differential;
  const std::size_t column = has_lead ? std::max(base.size(), lead.size()) : base.size();
  base.resize(column, ' ');
  lead.resize(column, ' ');
  base += "  # the link that floats\n";
  lead += "  # the point that tasks drive: ahead of the axle, for this base cannot go sideways\n";
  return (has_lead ? base + lead : base) + above_base();
}

/// Joints of the URDF that say what `base` does by itself.
std::string DraftFrames::above_base() const {
  const AboveBase& above = urdf_.above_base;
  if (above.joints.empty()) return "";
  const auto listed = [](const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "`" : ", `") + name + "`";
    return text;
  };
  return "# Left out, for the base moves by itself: links " + listed(above.links) + " and joints " +
         listed(above.joints) + " above it.\n";
}

std::string DraftFrames::footprint(const std::string& open) const {
  if (outline_is_known())
    return "\n# The outline from above, counter-clockwise. Proposed: around the wheels and the URDF's "
           "collision "
           "shapes that are\n# fixed to the base.\nfootprint: {polygon: " +
           polygon_text(found_.outline) + "}\n";
  const Eigen::Vector2d half = reach_of(found_);
  return "\n# The outline from above, counter-clockwise. The wheels alone reach " + metres(2.0 * half.x()) +
         " x " + metres(2.0 * half.y()) + ":\n# polygon: " + around_wheels() +
         "\nfootprint: {polygon: " + open + "}\n";
}

/// A line; none where a link has the name.
std::string DraftFrames::frame(const std::string& name, const std::string& at, const char* yaw) const {
  if (urdf_.find_link(name) != nullptr) return "";
  return "  " + name + ": {parent: " + found_.base + ", at: [" + at + ", 0 m]" + yaw + "}\n";
}

/// Where the shipped tasks touch, hook and lead this robot.
std::string DraftFrames::frames(const std::string& open) const {
  double ahead = 0.0, behind = 0.0;
  for (const Eigen::Vector2d& corner : outline()) {
    ahead = std::max(ahead, corner.x());
    behind = std::min(behind, corner.x());
  }
  const char* back = ", yaw: 180 deg";
  if (outline_is_known())
    return "\n# Places that tasks name. Proposed: the middle of the outline's front and back. Of a base that "
           "cannot "
           "drive sideways,\n# `nose` is the point that x and y of a task lead.\nframes:\n" +
           frame("bumper", metres(ahead), "") + frame("hook", metres(behind), back) +
           frame("nose", metres(ahead), "");
  std::string lines;
  // A turn moves the nose sideways by its distance from the axle: a nose close to it hardly moves.
  if (has_nose()) lines += frame("nose", metres(std::max(ahead, reach_of(found_).y())), "");
  if (options_.with_hook) lines += frame("hook", options_.back ? metres(*options_.back) : open, back);
  const std::string example = "bumper: {parent: " + found_.base + ", at: [0.3 m, 0 m]}";
  if (lines.empty()) return "\n# Tasks name places on the robot, as frames: {" + example + "}.\n";
  std::string about = "\n# Places that tasks name, as " + example + ".";
  if (has_nose()) about += " Proposed: `nose`, ahead of the axle.";
  if (options_.with_hook)
    about += "\n# `hook` is the middle of the back, as -0.4 m: what docks points out of it.";
  return about + "\nframes:\n" + lines;
}

}  // namespace zwang::lang
