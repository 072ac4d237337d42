/// The places of a drafted robot file: the outline, and the frames that tasks name.
#pragma once

#include <string>
#include <vector>

#include "robot/drive_kind.hpp"
#include "robot/urdf.hpp"
#include "robot/wheel_search.hpp"

namespace zwang::lang {

class DraftFrames {
 public:
  DraftFrames(const Urdf& urdf, const FoundWheels& found, DriveKind drive, const DraftOptions& options);

  bool outline_is_known() const { return !found_.outline.empty(); }
  /// [m] In the base, counter-clockwise; around the wheels alone where nobody knows.
  std::vector<Eigen::Vector2d> outline() const;

  /// [rad] Where the wheels roll to, in the base.
  double heading() const;
  /// The frame on the base whose x is ahead; empty: the base.
  std::string base_ahead() const;

  /// The lines `base` and, where tasks drive another point, `lead`.
  std::string base_and_lead() const;
  /// With `open` in the place of an outline that nobody knows.
  std::string footprint(const std::string& open) const;
  /// With `open` in the place of the back, where nobody knows the outline.
  std::string frames(const std::string& open) const;
  /// The outline of the wheels, as a file has it.
  std::string assumed_outline() const;

 private:
  bool has_nose() const;
  std::string above_base() const;
  std::string frame(const std::string& name, const std::string& ahead, double yaw) const;
  /// [m] Of a point in the base, along the heading and to the left of it.
  Eigen::Vector2d along_heading(const Eigen::Vector2d& point) const;
  /// [m] Ahead, where a turn moves it sideways.
  double nose(double front) const;

  const Urdf& urdf_;
  const FoundWheels& found_;
  DriveKind drive_;
  const DraftOptions& options_;
};

}  // namespace zwang::lang
