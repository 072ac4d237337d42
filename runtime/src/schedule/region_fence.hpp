/// Keeps a point or the robot's footprint inside a region. Each row keeps one pair of features apart that
/// come near each other: one of the moved frame, and one of the region's edge.
///
/// With d the signed distance of a pair, every pair asks d >= margin:
///   corner and edge     the corner's place along the edge's inward normal
///   corner and vertex   their distance; only at vertices where the region turns around an obstacle (reflex)
///   vertex and side     the reflex vertex's place along the outward normal of a side of the footprint
///   corner and circle   the corner's distance from the centre, at most radius - margin
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::runtime {

class ZWANG_EXPORT RegionFence {
 public:
  /// `corners`: what moves, in the frame that `move` names [m]; one point, or a footprint counter-clockwise.
  RegionFence(const lang::Region& region, std::vector<solver::Vector3> corners);

  std::size_t pair_count() const noexcept { return pairs_.size(); }
  /// The most pairs that are put in force at once: the nearest.
  static constexpr int most_near = 12;

  /// Takes over where both are. `move` and `in`: of the moved frame and of the region's parent.
  void update(const solver::FrameMotion& move, const solver::FrameMotion& in, double margin) noexcept;

  /// The speed of the fastest corner, as the region sees it. No pair that faces each other comes nearer
  /// faster: across a side, a vertex meets a point between two corners. [m/s]
  double fastest() const noexcept { return fastest_; }
  /// Looks for the pairs that face each other and have no more left before `margin` [m] than this, of edges
  /// and of vertices. Only such pairs have to be kept apart. Costs what the near stretches of the polygon
  /// have, not the whole polygon.
  void find_facing(double edge_reach, double vertex_reach) noexcept;
  /// The pairs that were found, in their order.
  std::span<const std::size_t> facing() const noexcept { return facing_; }
  /// The distance that a found pair has left before `margin`, and how fast it shrinks.
  struct Approach {
    double left = 0.0;   ///< [m]
    double speed = 0.0;  ///< [m/s]
  };
  const Approach& approach(std::size_t pair) const noexcept { return approaches_[pair]; }
  /// a_brk before a pair. Edges that can be active together share the braking acceleration. The share is the
  /// smallest one over the headings that the base sweeps before it stops. `to_base`: from the world into the
  /// base's axes. `box`: the accelerations that its ranges leave along x and y [m/s^2]. `turning`: the base's
  /// yaw rate [rad/s].
  double braking(std::size_t pair, const solver::Matrix3& to_base, const Eigen::Vector2d& box,
                 double turning) noexcept;
  /// No pair brakes with less, however the base is turned. [m/s^2]
  double weakest_braking(const Eigen::Vector2d& box) const noexcept;
  /// A vertex shares with nobody: no pair of one brakes with less than this. [m/s^2]
  static double least_alone(const Eigen::Vector2d& box) noexcept;
  bool is_braked_for_alone(std::size_t pair) const noexcept {
    return pairs_[pair].kind == PairKind::corner_vertex || pairs_[pair].kind == PairKind::vertex_side;
  }
  /// The direction in the world in which what moves would brake.
  solver::Vector3 normal(std::size_t pair) const noexcept;
  /// "edge2", "vertex3", "circle": the feature of the region, counted from 1 as they are written. Allocates.
  std::string name(std::size_t pair) const;
  /// The pair's constraint between the two frames, without level, braking and fading.
  solver::AxisConstraint constraint(std::size_t pair, const solver::AttachedFrame& move,
                                    const solver::AttachedFrame& in) const noexcept;

 private:
  using Point = Eigen::Vector2d;
  enum class PairKind { corner_edge, corner_vertex, vertex_side, corner_circle };
  struct Pair {
    PairKind kind;
    int first, second;
  };
  /// A side from `begin` along `along`, with `left` pointing to its left.
  struct Side {
    Point begin, along, left;
    double length = 0.0;
    double before = 0.0, after = 0.0;  ///< how far it also counts beyond its ends [m]
  };
  struct Moving {
    Point place = Point::Zero();     ///< seen from the other frame
    double height = 0.0;             ///< likewise
    Point velocity = Point::Zero();  ///< of the two against each other, in the other frame's axes
  };
  /// Edges or reflex vertices that follow each other, from `begin` to `end`, and a circle around them.
  struct Stretch {
    int begin, end;
    Point centre = Point::Zero();
    double radius = 0.0;
    Point axis = Point::UnitX();      ///< along which the edges run, one way or the other
    double cosine = 0.0, sine = 1.0;  ///< of the largest angle between an edge and the axis
  };
  void list_pairs();
  void list_stretches();
  void put_axis(Stretch& stretch) const;
  void find_meeting();
  double edge_braking(std::size_t edge, const solver::Matrix3& to_base, const Point& box,
                      double turning) noexcept;
  double braking_at_any_heading(std::size_t edge, const Point& box) noexcept;
  double least_braking(std::size_t edge, const Eigen::Matrix2d& in_base, double arc,
                       const Point& box) const noexcept;
  static std::vector<Side> sides_of(const std::vector<Point>& polygon);
  static double distance_to(const Side& side, const Point& p) noexcept;
  static bool points_at(const Stretch& stretch, const Point& offset) noexcept;
  Approach of_edge(const Moving& corner, const Side& edge) const noexcept;
  Approach of_vertex(const Moving& corner, const Point& vertex) const noexcept;
  Approach of_side(const Moving& vertex, const Side& side) const noexcept;
  Approach of_circle(const Moving& corner) const noexcept;
  Moving seen(const solver::FrameMotion& f, const solver::Vector3& point) const noexcept;
  bool contains(const Point& p) const noexcept;
  int nearest_edge(const Point& p) const noexcept;
  void note(std::size_t pair, const Approach& approach, double reach) noexcept;
  void find_facing_edges(std::size_t first, const Moving& corner, double reach) noexcept;
  void find_facing_vertices(std::size_t first, const Moving& corner, double reach) noexcept;
  void find_facing_sides(double reach) noexcept;
  Point centre() const noexcept { return {region_.centre[0], region_.centre[1]}; }
  solver::Pose level_with(std::size_t corner, const Point& p) const noexcept;

  lang::Region region_;
  std::vector<Point> polygon_;                     ///< the region's, in its parent
  std::vector<Side> edges_;                        ///< of the region
  std::vector<std::vector<std::size_t>> meeting_;  ///< of each edge those that can bind together with it
  std::vector<double> over_quarter_turn_;   ///< by edge: the least braking then; infinite before it is known
  Point quarter_turn_box_ = Point::Zero();  ///< the box for which it was worked out
  double least_cosine_ = 1.0;  ///< of half the angle between the normals of two that meet; of a circle, too
  std::vector<int> reflex_;    ///< vertices of the region
  std::vector<solver::Vector3> corners_;
  std::vector<Point> outline_;  ///< of what moves, in its own frame
  double reach_ = 0.0;          ///< from its origin to its farthest corner [m]
  std::vector<Side> sides_;     ///< of the footprint
  std::vector<Pair> pairs_;     ///< of each corner those with edges and vertices, then vertices and sides
  std::vector<Stretch> edge_stretches_, vertex_stretches_;

  // As of the last update.
  solver::Matrix3 to_world_ = solver::Matrix3::Identity();  ///< from the region's parent
  solver::Matrix3 move_to_world_ = solver::Matrix3::Identity();
  double margin_ = 0.0;
  std::vector<Moving> corner_now_;  ///< in the region's parent
  solver::FrameMotion in_seen_;     ///< the region's parent in the moved frame
  std::vector<Moving> vertex_now_;  ///< reflex vertices in the moved frame, of those that were near
  std::vector<std::size_t> facing_;
  std::vector<Approach> approaches_;  ///< of these pairs
  double fastest_ = 0.0;
};

}  // namespace zwang::runtime
