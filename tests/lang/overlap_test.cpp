// How far two objects overlap or stand apart. Expected values are the distances of their nearest points.
#include "zwang/lang/overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace zwang::lang {
namespace {

constexpr double height = 0.1;  // [m]

SceneObject post_at(double x, double y) {
  SceneObject post;
  post.shape = ShapeKind::cylinder;
  post.size = {0.05, 0.0, 1.0};
  post.at = {x, y};
  return post;
}

SceneObject box_at(double x, double y, double yaw = 0.0) {
  SceneObject box;
  box.shape = ShapeKind::box;
  box.size = {0.4, 0.2, 1.0};
  box.at = {x, y};
  box.yaw = yaw;
  return box;
}

TEST(Overlap, OfWhatStandsApartIsMinusTheWayBetween) {
  EXPECT_NEAR(overlap(post_at(0.0, 0.0), post_at(3.0, 4.0), height), -(5.0 - 2.0 * 0.05), 1e-12);
  EXPECT_NEAR(overlap(box_at(0.0, 0.0), post_at(0.1, 0.5), height), -(0.5 - 0.1 - 0.05), 1e-12);
  EXPECT_NEAR(overlap(box_at(0.0, 0.0), box_at(1.0, 0.05), height), -(1.0 - 0.4), 1e-12);
}

// The corner at (0.2, 0.1) is nearest.
TEST(Overlap, MeasuresFromACorner) {
  EXPECT_NEAR(overlap(box_at(0.0, 0.0), post_at(0.5, 0.5), height), -(0.5 - 0.05), 1e-12);
  EXPECT_NEAR(overlap(box_at(0.0, 0.0), box_at(0.7, 0.7), height), -std::hypot(0.3, 0.5), 1e-12);
  // Turned by 45 deg, the corner nearest along x lies (0.2 + 0.1)/sqrt(2) from the middle.
  const double reach = 0.3 / std::numbers::sqrt2;
  EXPECT_NEAR(overlap(box_at(0.0, 0.0), box_at(1.0, 0.0, 0.25 * std::numbers::pi), height),
              -(1.0 - 0.2 - reach), 1e-12);
}

TEST(Overlap, OfWhatOverlapsIsTheLeastWayOut) {
  EXPECT_NEAR(overlap(box_at(0.0, 0.0), box_at(0.3, 0.05), height), 0.1, 1e-12);   // along x: 0.4 - 0.3
  EXPECT_NEAR(overlap(box_at(0.0, 0.0), box_at(0.1, 0.15), height), 0.05, 1e-12);  // along y: 0.2 - 0.15
  EXPECT_NEAR(overlap(box_at(0.0, 0.0), post_at(0.0, 0.0), height), 0.1 + 0.05, 1e-12);
}

}  // namespace
}  // namespace zwang::lang
