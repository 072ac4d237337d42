#include "robot/draft_frames.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

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

std::vector<DraftWheel> all_wheels(const FoundWheels& found) {
  std::vector<DraftWheel> all = holding_wheels(found);
  all.insert(all.end(), found.casters.begin(), found.casters.end());
  return all;
}

/// Around the base's origin, as far to each side as the farthest wheel: what a body that nobody drew may
/// fill.
Eigen::AlignedBox2d body_around(const FoundWheels& found) {
  Eigen::Vector2d most{0.1, 0.1};
  for (const DraftWheel& wheel : all_wheels(found)) {
    most.x() = std::max(most.x(), std::abs(wheel.at[0]) + wheel.radius.value_or(0.1));
    most.y() = std::max(most.y(), std::abs(wheel.at[1]));
  }
  return {-most, most};
}

/// Around the wheels alone, each as long as it is high. Casters often stand behind the base's origin only.
/// Fewer than three wheels tell nothing of a body that stands on something else, too.
Eigen::AlignedBox2d around_wheels_of(const FoundWheels& found) {
  constexpr double narrowest = 0.02;  // [m] as narrow as no base is
  const std::vector<DraftWheel> all = all_wheels(found);
  if (all.size() < 3) return body_around(found);
  Eigen::AlignedBox2d axles, wheels;
  for (const DraftWheel& wheel : all) axles.extend(Eigen::Vector2d(wheel.at[0], wheel.at[1]));
  // A mesh has no radius, and its wheel hardly reaches to the middle of the base.
  const double unknown = std::min(0.1, 0.5 * axles.diagonal().norm());
  for (const DraftWheel& wheel : all) {
    const Eigen::Vector2d at(wheel.at[0], wheel.at[1]);
    const Eigen::Vector2d ahead =
        wheel.radius.value_or(unknown) * Eigen::Vector2d(wheel.axle.y(), -wheel.axle.x()).normalized();
    wheels.extend(Eigen::Vector2d(at + ahead));
    wheels.extend(Eigen::Vector2d(at - ahead));
  }
  const Eigen::Vector2d wider =
      (0.5 * (Eigen::Vector2d(narrowest, narrowest) - wheels.sizes())).cwiseMax(0.0);
  return {wheels.min() - wider, wheels.max() + wider};
}

std::vector<Eigen::Vector2d> rectangle(const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2d &low = box.min(), &high = box.max();
  return {high, {low.x(), high.y()}, low, {high.x(), low.y()}};
}

}  // namespace

DraftFrames::DraftFrames(const Urdf& urdf, const FoundWheels& found, DriveKind drive,
                         const DraftOptions& options)
    : urdf_(urdf), found_(found), drive_(drive), options_(options) {}

std::vector<Eigen::Vector2d> DraftFrames::outline() const {
  return outline_is_known() ? found_.outline : rectangle(body_around(found_));
}

std::string DraftFrames::assumed_outline() const {
  return polygon_text(rectangle(body_around(found_)));
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
  const Eigen::AlignedBox2d wheels = around_wheels_of(found_);
  const Eigen::Vector2d sides = wheels.sizes();
  return "\n# The outline from above, counter-clockwise. The wheels alone reach " + metres(sides.x()) +
         " x " + metres(sides.y()) + ":\n# polygon: " + polygon_text(rectangle(wheels)) +
         "\nfootprint: {polygon: " + open + "}\n";
}

double DraftFrames::heading() const {
  return heading_of(drive_, found_.wheels);
}

std::string DraftFrames::base_ahead() const {
  if (heading() == 0.0) return "";
  return urdf_.find_link("base") == nullptr ? "base" : "ahead";
}

Eigen::Vector2d DraftFrames::along_heading(const Eigen::Vector2d& point) const {
  return Eigen::Rotation2Dd(-heading()) * point;
}

/// A line; none where a link has the name. `ahead`: metres along the heading, or an open place.
std::string DraftFrames::frame(const std::string& name, const std::string& ahead, double yaw) const {
  if (urdf_.find_link(name) != nullptr) return "";
  std::string at = ahead + ", 0 m";
  const double turned = heading();
  if (turned != 0.0 && ahead.ends_with(" m")) {
    const double far = std::stod(ahead);
    at = metres(far * std::cos(turned)) + ", " + metres(far * std::sin(turned));
  }
  double degrees = std::round((turned + yaw) * 180.0 / std::numbers::pi);
  if (degrees > 180.0) degrees -= 360.0;
  return "  " + name + ": {parent: " + found_.base + ", at: [" + at + "]" +
         (degrees == 0.0 ? "" : ", yaw: " + wording::figure(degrees, "deg")) + "}\n";
}

// A turn moves a point sideways by its distance from the axle: one close to it hardly moves.
double DraftFrames::nose(double front) const {
  double axle = 0.0, track = 0.0;
  for (const DraftWheel& wheel : found_.wheels) {
    const Eigen::Vector2d at = along_heading({wheel.at[0], wheel.at[1]});
    axle += at.x() / static_cast<double>(found_.wheels.size());
    track = std::max(track, std::abs(at.y()));
  }
  if (drive_ != DriveKind::differential) return front;
  return std::max(front, axle + (outline_is_known() ? 0.5 : 1.0) * track);
}

/// Where the shipped tasks touch, hook and lead this robot.
std::string DraftFrames::frames(const std::string& open) const {
  double ahead = 0.0, behind = 0.0;
  for (const Eigen::Vector2d& corner : outline()) {
    ahead = std::max(ahead, along_heading(corner).x());
    behind = std::min(behind, along_heading(corner).x());
  }
  constexpr double back = std::numbers::pi;
  std::string turned, about_turned;
  if (!base_ahead().empty()) {
    turned = frame(base_ahead(), metres(0.0), 0.0);
    about_turned = "\n# The wheels do not roll along x: `" + base_ahead() +
                   "` is the base for tasks, its x ahead. Which way is ahead, a URDF does not tell.";
  }
  if (outline_is_known())
    return "\n# Places that tasks name. Proposed: the middle of the outline's front and back. Of a base that "
           "cannot "
           "drive sideways,\n# `nose` is the point that x and y of a task lead." +
           about_turned + "\nframes:\n" + turned + frame("bumper", metres(ahead), 0.0) +
           frame("hook", metres(behind), back) + frame("nose", metres(nose(ahead)), 0.0);
  std::string lines = turned;
  if (has_nose()) lines += frame("nose", metres(nose(ahead)), 0.0);
  if (options_.with_hook) lines += frame("hook", options_.back ? metres(*options_.back) : open, back);
  const std::string example = "bumper: {parent: " + found_.base + ", at: [0.3 m, 0 m]}";
  if (lines.empty()) return "\n# Tasks name places on the robot, as frames: {" + example + "}.\n";
  std::string about = "\n# Places that tasks name, as " + example + ".";
  if (has_nose()) about += " Proposed: `nose`, ahead of the axle.";
  if (options_.with_hook)
    about += "\n# `hook` is the middle of the back, as -0.4 m: what docks points out of it.";
  return about + about_turned + "\nframes:\n" + lines;
}

}  // namespace zwang::lang
