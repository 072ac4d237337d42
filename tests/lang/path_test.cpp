// Paths of lines and fillets, against the geometry of circles that touch two lines.
#include "zwang/lang/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "zwang/solver/constraint.hpp"

namespace zwang::lang {
namespace {

using Points = std::vector<std::array<double, 2>>;
constexpr double pi = std::numbers::pi;

Path along(const Points& points, double fillet) {
  Path path;
  if (auto pieces = path_through(points, fillet)) path.pieces = *pieces;
  return path;
}

solver::Pose end_of(const PathPiece& piece) {
  const double turn = piece.curvature * piece.length;
  const double k = piece.curvature;
  const solver::Vector3 ahead = k == 0.0
                                    ? solver::Vector3(piece.length, 0.0, 0.0)
                                    : solver::Vector3(std::sin(turn) / k, (1.0 - std::cos(turn)) / k, 0.0);
  return piece.pose * solver::Pose{solver::rotation_from_rpy(0.0, 0.0, turn), ahead};
}

double heading_of(const solver::Pose& pose) {
  return std::atan2(pose.rotation(1, 0), pose.rotation(0, 0));
}

TEST(PathGeometry, ARightAngleIsAQuarterOfACircle) {
  constexpr double r = 0.6;
  const Path path = along({{0, 0}, {3, 0}, {3, 2}}, r);
  ASSERT_EQ(path.pieces.size(), 3u);
  EXPECT_NEAR(path.length(), 3.0 + 2.0 - 2.0 * r + r * pi / 2.0, 1e-12);
  EXPECT_NEAR(path.pieces[1].start, 3.0 - r, 1e-12);
  EXPECT_NEAR(path.pieces[1].curvature, 1.0 / r, 1e-12);
  const solver::Pose end = end_of(path.pieces.back());
  EXPECT_NEAR((end.position - solver::Vector3(3, 2, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(heading_of(end), pi / 2.0, 1e-12);
  EXPECT_NEAR(path.least_radius(), r, 1e-12);
}

// A corner takes r tan(turn/2) of the lines on its two sides, and gives r turn of the arc.
TEST(PathGeometry, AnyChainIsAsLongAsItsLinesAndArcsAndNeverJumps) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> length(1.0, 3.0), turn(-2.5, 2.5);
  for (int draw = 0; draw < 200; ++draw) {
    Points points{{0, 0}};
    double heading = 0.0, lines = 0.0, saved = 0.0;
    std::vector<double> cuts{0.0}, lengths;
    for (int i = 0; i < 5; ++i) {
      const double l = length(random), t = i == 4 ? 0.0 : turn(random);
      points.push_back({points.back()[0] + l * std::cos(heading), points.back()[1] + l * std::sin(heading)});
      heading += t;
      lines += l;
      lengths.push_back(l);
      cuts.push_back(std::tan(std::abs(t) / 2.0));
      saved += 2.0 * cuts.back() - std::abs(t);
    }
    double most = solver::infinity;
    for (std::size_t i = 0; i < 5; ++i) most = std::min(most, lengths[i] / (cuts[i] + cuts[i + 1]));
    EXPECT_NEAR(largest_fillet(points), most, 1e-9 * most);
    const Path path = along(points, 0.9 * most);
    ASSERT_FALSE(path.pieces.empty());
    EXPECT_NEAR(path.length(), lines - 0.9 * most * saved, 1e-9);
    for (std::size_t i = 0; i + 1 < path.pieces.size(); ++i) {
      const solver::Pose end = end_of(path.pieces[i]);
      EXPECT_NEAR((end.position - path.pieces[i + 1].pose.position).norm(), 0.0, 1e-9);
      EXPECT_NEAR((end.rotation - path.pieces[i + 1].pose.rotation).norm(), 0.0, 1e-9);
    }
    const solver::Pose end = end_of(path.pieces.back());
    EXPECT_NEAR(std::hypot(end.position.x() - points[5][0], end.position.y() - points[5][1]), 0.0, 1e-9);
    EXPECT_FALSE(path_through(points, 1.001 * most));
  }
}

TEST(PathGeometry, PointsOnALineMakeOneLine) {
  const Path path = along({{1, 1}, {2, 2}, {4, 4}}, 0.0);
  ASSERT_EQ(path.pieces.size(), 1u);
  EXPECT_NEAR(path.length(), 3.0 * std::numbers::sqrt2, 1e-12);
  EXPECT_TRUE(std::isinf(path.least_radius()));
  EXPECT_TRUE(std::isinf(largest_fillet({{1, 1}, {2, 2}, {4, 4}})));
}

TEST(PathGeometry, AFilletMayTakeAWholeLineAndNoMore) {
  const Points corner{{0, 0}, {3, 0}, {3, 2}};
  EXPECT_NEAR(largest_fillet(corner), 2.0, 1e-12);
  const Path path = along(corner, 2.0);
  ASSERT_EQ(path.pieces.size(), 3u) << "it ends with a line, of no length, to go straight on";
  EXPECT_EQ(path.pieces.back().curvature, 0.0);
  EXPECT_NEAR(path.pieces.back().length, 0.0, 1e-12);
}

TEST(PathGeometry, NothingTurnsBack) {
  const Points back{{0, 0}, {3, 0}, {1, 0}};
  EXPECT_EQ(largest_fillet(back), 0.0);
  EXPECT_FALSE(path_through(back, 0.1));
}

// A quarter of a circle of 2 m to the left, and to the right.
TEST(PathGeometry, APlaceOnAnArcIsItsAngleAndItsRadius) {
  for (const double side : {1.0, -1.0}) {
    PathPiece arc;
    arc.curvature = side / 2.0;
    arc.length = pi;
    for (const double angle : {-0.4, 0.3, 1.5}) {
      for (const double radius : {0.5, 2.0, 3.0}) {
        const PlaceOnPiece place =
            place_on(arc, radius * std::sin(angle), side * (2.0 - radius * std::cos(angle)));
        EXPECT_NEAR(place.along, 2.0 * angle, 1e-12);
        EXPECT_NEAR(place.offset, side * (2.0 - radius), 1e-12);
        EXPECT_NEAR(place.share, radius / 2.0, 1e-12);
      }
    }
  }
}

// A square of side a with rounded corners: four lines of a - 2 r and one circle. It ends where it begins.
TEST(PathGeometry, AClosedSquareIsAsLongAsItsLinesAndOneCircle) {
  constexpr double a = 2.0, r = 0.5;
  const Points square{{0, 0}, {a, 0}, {a, a}, {0, a}};
  EXPECT_NEAR(largest_fillet(square, true), a / 2.0, 1e-12);
  EXPECT_FALSE(path_through(square, 0.51 * a, true));
  Path path;
  path.pieces = path_through(square, r, true).value();
  ASSERT_EQ(path.pieces.size(), 8u);
  EXPECT_NEAR(path.length(), 4.0 * (a - 2.0 * r) + 2.0 * pi * r, 1e-12);
  EXPECT_NEAR((path.pieces[0].pose.position - solver::Vector3(r, 0, 0)).norm(), 0.0, 1e-12);
  const solver::Pose end = end_of(path.pieces.back());
  EXPECT_NEAR((end.position - path.pieces[0].pose.position).norm(), 0.0, 1e-12);
  EXPECT_NEAR((end.rotation - path.pieces[0].pose.rotation).norm(), 0.0, 1e-12);
  // Chords of 1 deg fall short of the circle by 1 - sin(x)/x, x = half a degree.
  double chords = 0.0;
  const std::vector<solver::Vector3> points = path.points(pi / 180.0);
  for (std::size_t i = 1; i < points.size(); ++i) chords += (points[i] - points[i - 1]).norm();
  const double half = pi / 360.0;
  EXPECT_NEAR(chords, 4.0 * (a - 2.0 * r) + 2.0 * pi * r * std::sin(half) / half, 1e-9);
}

// The sum of the turns of any simple polygon is a whole turn, so that the last tangent is the first one.
TEST(PathGeometry, AnyClosedPathEndsWhereItBegins) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> radius(1.0, 3.0);
  for (int draw = 0; draw < 100; ++draw) {
    Points points;
    for (int i = 0; i < 7; ++i) {
      const double angle = 2.0 * pi * i / 7.0, r = radius(random);
      points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    const double most = largest_fillet(points, true);
    const auto pieces = path_through(points, 0.9 * most, true);
    ASSERT_TRUE(pieces);
    for (std::size_t i = 0; i < pieces->size(); ++i) {
      const solver::Pose end = end_of((*pieces)[i]), &next = (*pieces)[(i + 1) % pieces->size()].pose;
      EXPECT_NEAR((end.position - next.position).norm(), 0.0, 1e-9) << draw << ", piece " << i;
      EXPECT_NEAR((end.rotation - next.rotation).norm(), 0.0, 1e-9) << draw << ", piece " << i;
    }
  }
}

TEST(PathGeometry, AClosedPathOfTwoPointsTurnsBack) {
  EXPECT_EQ(largest_fillet({{0, 0}, {1, 0}}, true), 0.0);
  EXPECT_FALSE(path_through({{0, 0}, {1, 0}}, 0.1, true));
}

}  // namespace
}  // namespace zwang::lang
