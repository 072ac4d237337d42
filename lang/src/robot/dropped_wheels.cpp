// Springs give, rockers turn and drawings are rounded: a wheel may be drawn above the ground that it stands
// on.
#include "robot/dropped_wheels.hpp"

#include <algorithm>
#include <cmath>

#include "robot/placed_urdf.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {

namespace {

/// [m] Below it a difference of heights is a rounding.
constexpr double least_drop = 1e-4;

/// [m] Of wheels without a known radius: most are larger.
constexpr double unknown_radius = 0.1;

/// Without a known radius the axle's own height: of wheels of one size it differs by as much.
double end_of(const DraftWheel& wheel) {
  return wheel.at[2] - wheel.radius.value_or(0.0);
}

}  // namespace

/// Let d be the drop, and R turn the parent link's axes into the base's. The joint's origin is at
///   p' = p - d R^T e_z.
void drop_wheels(const RobotFile& file, Urdf& urdf) {
  const auto drops = [](const WheelText& wheel) { return wheel.drop.has_value(); };
  if (std::none_of(file.wheels.begin(), file.wheels.end(), drops)) return;
  if (!file.base.exists() || urdf.find_link(file.base.text) == nullptr) return;
  const PlacedUrdf drawn(urdf, file.base.text);
  for (const WheelText& wheel : file.wheels) {
    const auto joint = std::find_if(urdf.joints.begin(), urdf.joints.end(),
                                    [&](const UrdfJoint& j) { return j.joint.name == wheel.joint.text; });
    if (!wheel.drop || joint == urdf.joints.end()) continue;
    const solver::Vector3 down = -*wheel.drop * solver::Vector3::UnitZ();
    joint->origin.position += drawn.pose_of(joint->parent).rotation.transpose() * down;
  }
}

bool share_mesh(const std::vector<DraftWheel>& wheels) {
  return !wheels.empty() && !wheels.front().mesh.empty() &&
         std::all_of(wheels.begin(), wheels.end(), [&](const DraftWheel& wheel) {
           return !wheel.radius && wheel.mesh == wheels.front().mesh;
         });
}

std::map<std::string, double> drops_of(const std::vector<DraftWheel>& wheels) {
  std::map<std::string, double> drops;
  const auto lacks_radius = [](const DraftWheel& wheel) { return !wheel.radius; };
  if (wheels.empty()) return drops;
  if (std::any_of(wheels.begin(), wheels.end(), lacks_radius) && !share_mesh(wheels)) return drops;
  double lowest = solver::infinity, highest = -solver::infinity, mean = 0.0, smallest = solver::infinity;
  for (const DraftWheel& wheel : wheels) {
    lowest = std::min(lowest, end_of(wheel));
    highest = std::max(highest, end_of(wheel));
    mean += end_of(wheel) / static_cast<double>(wheels.size());
    smallest = std::min(smallest, wheel.radius.value_or(unknown_radius));
  }
  const double most_lift = std::max(least_wheel_lift, wheel_lift_share * smallest);
  if (mean - lowest <= most_lift && highest - mean <= most_lift) return drops;
  for (const DraftWheel& wheel : wheels) {
    const double above = end_of(wheel) - lowest;
    if (above > wheel.radius.value_or(unknown_radius)) return {};
    if (above > least_drop) drops[wheel.joint] = above;
  }
  return drops;
}

}  // namespace zwang::lang
