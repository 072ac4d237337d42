// The solver gets each pair of RegionFence as a constraint that keeps both sides apart, with a name.
#include "schedule/frame_table.hpp"
#include "schedule/in_plane.hpp"
#include "schedule/region_fence.hpp"

namespace zwang::runtime {

namespace {

/// A frame whose y points along the side's left (or right) and whose x-y plane is the ground.
solver::Pose side_pose(const Eigen::Vector2d& begin, const Eigen::Vector2d& y) {
  solver::Pose pose;
  pose.position = high(begin);
  pose.rotation.col(0) = solver::Vector3(y.y(), -y.x(), 0.0);
  pose.rotation.col(1) = high(y);
  pose.rotation.col(2) = solver::Vector3::UnitZ();
  return pose;
}

solver::Pose point_pose(const solver::Vector3& p) {
  solver::Pose pose;
  pose.position = p;
  return pose;
}

}  // namespace

std::string RegionFence::name(std::size_t index) const {
  const Pair& pair = pairs_[index];
  switch (pair.kind) {
    case PairKind::corner_edge:
      return "edge" + std::to_string(pair.second + 1);
    case PairKind::corner_vertex:
      return "vertex" + std::to_string(reflex_[static_cast<std::size_t>(pair.second)] + 1);
    case PairKind::vertex_side:
      return "vertex" + std::to_string(reflex_[static_cast<std::size_t>(pair.first)] + 1);
    case PairKind::corner_circle:
      break;
  }
  return "circle";
}

/// At the height of a corner, so that the distance is one in the plane.
solver::Pose RegionFence::level_with(std::size_t corner, const Point& p) const noexcept {
  return point_pose({p.x(), p.y(), corner_now_[corner].height});
}

solver::AxisConstraint RegionFence::constraint(std::size_t index, const solver::AttachedFrame& move,
                                               const solver::AttachedFrame& in) const noexcept {
  const Pair& pair = pairs_[index];
  const auto first = static_cast<std::size_t>(pair.first);
  const auto second = static_cast<std::size_t>(pair.second);
  solver::AxisConstraint c;
  c.axis = solver::Axis::y;
  c.position = solver::Range{margin_, solver::infinity};
  switch (pair.kind) {
    case PairKind::corner_edge:
      c.move = carried(move, point_pose(corners_[first]));
      c.in = carried(in, side_pose(edges_[second].begin, edges_[second].left));
      break;
    case PairKind::corner_vertex:
      c.measure = solver::Measure::distance;
      c.move = carried(move, point_pose(corners_[first]));
      c.in = carried(in, level_with(first, polygon_[static_cast<std::size_t>(reflex_[second])]));
      break;
    case PairKind::vertex_side:
      c.move = carried(in, point_pose(high(polygon_[static_cast<std::size_t>(reflex_[first])])));
      c.in = carried(move, side_pose(sides_[second].begin, -sides_[second].left));
      break;
    case PairKind::corner_circle:
      c.measure = solver::Measure::distance;
      c.move = carried(move, point_pose(corners_[first]));
      c.in = carried(in, level_with(first, centre()));
      c.position = solver::Range{-solver::infinity, region_.radius - margin_};
      break;
  }
  return c;
}

}  // namespace zwang::runtime
