// A fence looks at the near stretches of its polygon alone. The oracle looks at every pair of features.
#include "schedule/region_fence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "zwang/lang/plane.hpp"

namespace zwang::runtime {
namespace {

using Point = Eigen::Vector2d;

constexpr double look_ahead = 1.0;  // [m] that an edge counts beyond a convex vertex

struct Edge {
  Point begin, along, left;
  double length = 0.0, before = 0.0, after = 0.0;
};

double turn(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

std::vector<Edge> edges_of(const std::vector<Point>& polygon) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point whole = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Point along = whole.normalized();
    edges.push_back({polygon[i], along, {-along.y(), along.x()}, whole.norm(), 0.0, 0.0});
  }
  return edges;
}

bool is_beside(const Edge& edge, const Point& p) {
  const double along = edge.along.dot(p - edge.begin);
  return along >= -edge.before && along <= edge.length + edge.after;
}

std::size_t nearest_of(const std::vector<Edge>& edges, const Point& p) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double along = std::clamp(edges[i].along.dot(p - edges[i].begin), 0.0, edges[i].length);
    const double distance = (p - edges[i].begin - along * edges[i].along).norm();
    if (distance < least) nearest = i;
    least = std::min(least, distance);
  }
  return nearest;
}

/// A polygon around the origin, with as many vertices that turn around an obstacle as it comes.
std::vector<Point> drawn_polygon(std::mt19937& random) {
  const int count = std::uniform_int_distribution(3, 90)(random);
  std::vector<Point> polygon;
  for (int i = 0; i < count; ++i) {
    const double radius = std::uniform_real_distribution(2.0, 6.0)(random);
    const double angle = 2.0 * std::numbers::pi * i / count;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

struct Drawn {
  std::vector<Point> polygon, footprint, corners;  ///< corners: of the footprint, in the world
  solver::FrameMotion base;
  double margin = 0.0;
};

Drawn drawn_case(std::mt19937& random) {
  const auto number = [&](double most) { return std::uniform_real_distribution(-most, most)(random); };
  Drawn drawn;
  drawn.polygon = drawn_polygon(random);
  drawn.footprint = {{0.4, 0.3}, {-0.4, 0.3}, {-0.4, -0.3}, {0.4, -0.3}};
  drawn.margin = 0.1 * std::uniform_int_distribution(0, 1)(random);
  const Eigen::Rotation2Dd turned(number(3.0));
  drawn.base.pose.position = {number(6.0), number(6.0), 0.0};
  drawn.base.pose.rotation.topLeftCorner<2, 2>() = turned.toRotationMatrix();
  drawn.base.linear = {number(1.0), number(1.0), 0.0};
  drawn.base.angular = {0.0, 0.0, number(1.0)};
  for (const Point& p : drawn.footprint)
    drawn.corners.emplace_back(turned * p + drawn.base.pose.position.head<2>());
  return drawn;
}

/// What each facing pair has left, by its index.
std::map<std::size_t, double> all_facing(const Drawn& drawn) {
  std::map<std::size_t, double> left;
  std::vector<Edge> edges = edges_of(drawn.polygon);
  const std::size_t n = edges.size();
  std::vector<std::size_t> reflex;
  for (std::size_t i = 0; i < n; ++i) {
    Edge& last = edges[(i + n - 1) % n];
    if (turn(last.along, edges[i].along) < 0.0) {
      reflex.push_back(i);
    } else {
      edges[i].before = std::min(look_ahead, last.length);
      last.after = std::min(look_ahead, edges[i].length);
    }
  }
  std::size_t pair = 0;
  for (const Point& corner : drawn.corners) {
    const bool inside = lang::plane::contains(drawn.polygon, corner);
    const std::size_t nearest = nearest_of(edges, corner);
    for (std::size_t e = 0; e < n; ++e, ++pair) {
      const double distance = edges[e].left.dot(corner - edges[e].begin);
      const bool faces = inside ? distance >= 0.0 && is_beside(edges[e], corner) : e == nearest;
      if (faces) left[pair] = distance - drawn.margin;
    }
    for (const std::size_t v : reflex) {
      const Point offset = corner - drawn.polygon[v];
      const bool is_past = edges[v].along.dot(offset) < 0.0;
      if (inside && is_past && edges[(v + n - 1) % n].along.dot(offset) > 0.0)
        left[pair] = offset.norm() - drawn.margin;
      ++pair;
    }
  }
  const std::vector<Edge> sides = edges_of(drawn.corners);
  for (const std::size_t v : reflex) {
    const Point& vertex = drawn.polygon[v];
    const bool inside = lang::plane::contains(drawn.corners, vertex);
    const std::size_t nearest = nearest_of(sides, vertex);
    for (std::size_t s = 0; s < sides.size(); ++s, ++pair) {
      const double distance = -sides[s].left.dot(vertex - sides[s].begin);
      const bool faces = inside ? s == nearest : distance >= 0.0 && is_beside(sides[s], vertex);
      if (faces) left[pair] = distance - drawn.margin;
    }
  }
  return left;
}

RegionFence fence_of(const Drawn& drawn) {
  lang::Region region;
  for (const Point& p : drawn.polygon) region.polygon.push_back({p.x(), p.y()});
  std::vector<solver::Vector3> corners;
  for (const Point& p : drawn.footprint) corners.emplace_back(p.x(), p.y(), 0.0);
  return {region, corners};
}

TEST(RegionFence, FindsThePairsThatALookAtAllOfThemFinds) {
  std::mt19937 random(1);
  std::size_t found = 0;
  for (int i = 0; i < 500; ++i) {
    const Drawn drawn = drawn_case(random);
    RegionFence fence = fence_of(drawn);
    fence.update(drawn.base, {}, drawn.margin);
    const auto all = all_facing(drawn);
    for (const double reach : {0.2, 1.0, 3.0, std::numeric_limits<double>::infinity()}) {
      const double vertex_reach = 0.5 * reach;
      fence.find_facing(reach, vertex_reach);
      std::vector<std::size_t> expected;
      for (const auto& [pair, left] : all) {
        if (left <= (fence.is_braked_for_alone(pair) ? vertex_reach : reach)) expected.push_back(pair);
      }
      ASSERT_EQ(std::vector<std::size_t>(fence.facing().begin(), fence.facing().end()), expected)
          << "case " << i << ", reach " << reach;
      for (const std::size_t pair : expected) {
        ASSERT_NEAR(fence.approach(pair).left, all.at(pair), 1e-12);
        ASSERT_LE(fence.approach(pair).speed, fence.fastest() + 1e-12);
      }
      found += expected.size();
    }
  }
  EXPECT_GT(found, 5000u);
}

}  // namespace
}  // namespace zwang::runtime
