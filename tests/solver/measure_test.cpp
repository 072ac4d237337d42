// The measures of a constraint, against finite differences along a motion of the robot. They are ds, and the
// velocity products of dds = a.(A_k - A_c) + gamma. The rows of regions, features and speed limits are
// tested, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "law_problem.hpp"
#include "robots.hpp"

namespace zwang::oracle {
namespace {

using solver::AttachedFrame;
using solver::Axis;
using solver::AxisConstraint;
using solver::Measure;
using solver::Quantity;
using solver::Range;
using solver::Row;
using solver::RowKind;
using solver::Vector3;

/// A robot whose joints move with constant accelerations, and a frame in the world that moves on its own.
class Moving {
 public:
  explicit Moving(std::uint64_t seed)
      : random(seed), model(random_model(Robot::arm, random, no_limit)), start(model) {
    for (Eigen::Index j = 0; j < start.q.size(); ++j) {
      start.q[j] = random.uniform(-1.5, 1.5);
      start.qd[j] = random.uniform(-1.0, 1.0);
    }
    qdd = Eigen::VectorXd::NullaryExpr(start.q.size(),
                                       [this](Eigen::Index) { return random.uniform(-1.0, 1.0); });
    hand = {model.body_count() - 1, {random.rotation(), random.vector(0.3)}};
    elbow = {3, {random.rotation(), random.vector(0.3)}};
    object = {-1, {random.rotation(), random.vector(0.5)}, {random.vector(0.6), random.vector(0.6)}};
    fixed = {-1, {random.rotation(), random.vector(0.5)}};
  }

  solver::State at(double t) const {
    solver::State state = start;
    state.q += t * start.qd + 0.5 * t * t * qdd;
    state.qd += t * qdd;
    return state;
  }
  /// With constant spatial velocity about its own origin as it is now: A = 0.
  AttachedFrame later(const AttachedFrame& frame, double t) const {
    if (frame.body >= 0) return frame;
    AttachedFrame moved = frame;
    const Vector3 w = frame.pose.rotation * frame.twist.angular;
    const Vector3 v = frame.pose.rotation * frame.twist.linear;
    const double angle = w.norm();
    // A screw: exp(t (w, v)) about the origin of the frame now, expanded to the order that counts here.
    moved.pose.rotation =
        angle > 0.0 ? Eigen::AngleAxisd(angle * t, w / angle).toRotationMatrix() * frame.pose.rotation
                    : frame.pose.rotation;
    moved.pose.position += t * v + 0.5 * t * t * w.cross(v) + t * t * t / 6.0 * w.cross(w.cross(v));
    const Vector3 velocity = v + t * w.cross(v) + 0.5 * t * t * w.cross(w.cross(v));
    moved.twist.linear = moved.pose.rotation.transpose() * velocity;
    return moved;
  }
  solver::Coordinate coordinate(AxisConstraint c, double t) const {
    c.move = later(c.move, t);
    c.in = later(c.in, t);
    return coordinate_of(c, model, at(t));
  }

  Random random;
  solver::Model model;
  solver::State start;
  Eigen::VectorXd qdd;
  AttachedFrame hand, elbow, object, fixed;
};

/// a . (A_k - A_c) of a row under the robot's motion.
double spatial_acceleration_along(const Moving& robot, const Row& row) {
  const DenseDynamics dense(robot.model, robot.start);
  const Vector vdot = robot.qdd.cast<Real>();
  const auto along = [&](int body, const solver::ForceVector& a) {
    return static_cast<double>(a.vector().cast<Real>().dot(dense.spatial_acceleration(body, vdot)));
  };
  double sum = along(row.body, row.a);
  if (row.reference_body >= 0) sum -= along(row.reference_body, row.a_reference);
  return sum;
}

/// `stretch`: of the velocity to the rate of the position.
void expect_derivatives(const Moving& robot, AxisConstraint c, const std::string& what,
                        double stretch = 1.0) {
  const solver::Coordinate now = robot.coordinate(c, 0.0);
  // Central differences of fourth order.
  const auto derivative = [&](double solver::Coordinate::*quantity) {
    constexpr double h = 2e-4;
    const auto at = [&](double t) { return robot.coordinate(c, t).*quantity; };
    return (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
  };
  const bool has_position = c.measure != Measure::speed && c.in.body != c.move.body;
  if (has_position) {
    EXPECT_NEAR(stretch * derivative(&solver::Coordinate::position), now.velocity, 1e-8) << what;
  }
  const double dds = derivative(&solver::Coordinate::velocity);
  c.driver = solver::Driver{.quantity = Quantity::acceleration, .target = 0.0};
  if (c.measure == Measure::speed || c.measure == Measure::turn) {
    c.driver.reset();
    c.velocity = Range{-solver::infinity, 1e-3};
  }
  solver::ConstraintSet set(1, 2);
  ASSERT_TRUE(set.add(c));
  ASSERT_TRUE(set.fill(robot.model, robot.start));
  ASSERT_EQ(set.rows().size(), 1u) << what;
  EXPECT_NEAR(dds, spatial_acceleration_along(robot, set.rows()[0]) + now.acceleration_bias, 1e-7) << what;
}

/// [m] Of the origin of `in` from the z axis of `move`.
double beside_the_z_axis(const Moving& robot, const AttachedFrame& move, const AttachedFrame& in) {
  AxisConstraint c;
  c.move = in;
  c.in = move;
  c.axis = Axis::x;
  const double x = robot.coordinate(c, 0.0).position;
  c.axis = Axis::y;
  return std::hypot(x, robot.coordinate(c, 0.0).position);
}

TEST(Measures, HaveTheDerivativesThatTheirRowsSay) {
  int bearings = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Moving robot(seed);
    const struct {
      const char* name;
      AttachedFrame move, in;
    } pairs[] = {{"hand in a moving object", robot.hand, robot.object},
                 {"hand in elbow", robot.hand, robot.elbow},
                 {"hand in the world", robot.hand, robot.fixed},
                 {"object in hand", robot.object, robot.hand},
                 {"hand in own axes", robot.hand, {robot.hand.body, {}}}};
    for (const auto& pair : pairs) {
      const bool own = pair.in.body == pair.move.body;
      AxisConstraint c;
      c.move = pair.move;
      c.in = pair.in;
      const std::string where = std::string(pair.name) + ", seed " + std::to_string(seed) + ": ";
      c.measure = Measure::speed;
      expect_derivatives(robot, c, where + "speed");
      c.measure = Measure::axis;
      for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
        c.axis = axis;
        expect_derivatives(robot, c, where + "axis");
      }
      c.measure = Measure::direction;
      c.coefficients = {0.6, -0.3, 0.2, 0.0, 0.0, 0.0};
      expect_derivatives(robot, c, where + "direction");
      c.measure = Measure::turn;
      if (own) expect_derivatives(robot, c, where + "turn");
      if (own) continue;
      c.measure = Measure::distance;
      expect_derivatives(robot, c, where + "distance");
      c.measure = Measure::bearing;
      if (beside_the_z_axis(robot, pair.move, pair.in) > solver::nearest_bearing) {
        expect_derivatives(robot, c, where + "bearing");
        ++bearings;
      }
      c.measure = Measure::angle;
      c.axis = Axis::z;
      c.other_axis = Axis::x;
      expect_derivatives(robot, c, where + "angle");
    }
  }
  EXPECT_GT(bearings, 40);  // of 80: few stand on the other's z axis
}

// Of x the velocity is the frame's own along the tangent, u = (1 - k o) ds.
TEST(Measures, AlongAPathHaveTheDerivativesThatTheirRowsSay) {
  int arcs = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Moving robot(seed);
    const struct {
      const char* name;
      AttachedFrame in;
    } paths[] = {{"a moving object", robot.object}, {"elbow", robot.elbow}, {"the world", robot.fixed}};
    for (const auto& path : paths) {
      for (const double curvature : {0.0, 0.8, -1.3}) {
        AxisConstraint c;
        c.move = robot.hand;
        c.in = path.in;
        c.measure = Measure::path;
        c.curvature = curvature;
        c.axis = Axis::y;
        const double share = 1.0 - curvature * robot.coordinate(c, 0.0).position;
        if (share < 0.3) continue;
        arcs += curvature != 0.0 ? 1 : 0;
        const std::string where = std::string(path.name) + ", seed " + std::to_string(seed) + ": ";
        expect_derivatives(robot, c, where + "across");
        c.axis = Axis::z;
        expect_derivatives(robot, c, where + "above");
        c.axis = Axis::x;
        c.arc_length = 5.0;
        expect_derivatives(robot, c, where + "along", share);
      }
    }
  }
  EXPECT_GT(arcs, 60);  // of 120: few stand near the centre
}

// A base that goes around the centre of the arc keeps its place across the arc and its heading against it. A
// unit force along the arc is one newton, at any distance of the base from the arc.
TEST(Measures, AroundTheCentreOfAnArcNothingButTheWayAlongItGrows) {
  const solver::Model model = solver::test::mecanum({});
  for (const double radius : {0.5, 2.0, 3.0}) {
    solver::State state(model);
    constexpr double angle = 0.7, speed = 0.4, heading = 0.2;
    state.base_pose.rotation = solver::rotation_from_rpy(0.0, 0.0, angle + heading);
    state.base_pose.position = {radius * std::sin(angle), 2.0 - radius * std::cos(angle), 0.0};
    state.base_twist.angular.z() = speed / radius;
    state.base_twist.linear = {speed * std::cos(heading), -speed * std::sin(heading), 0.0};
    AxisConstraint c;
    c.move = {0, {}};
    c.in = {-1, {}};
    c.measure = Measure::path;
    c.curvature = 0.5;
    c.arc_length = 1.0;
    const auto along = [&](Axis axis) {
      c.axis = axis;
      return coordinate_of(c, model, state);
    };
    EXPECT_NEAR(along(Axis::x).position, 1.0 + 2.0 * angle, 1e-12);
    EXPECT_NEAR(along(Axis::x).velocity, speed, 1e-12);
    EXPECT_NEAR(along(Axis::y).position, 2.0 - radius, 1e-12);
    EXPECT_NEAR(along(Axis::y).velocity, 0.0, 1e-12);
    EXPECT_NEAR(along(Axis::rz).position, heading, 1e-12);
    EXPECT_NEAR(along(Axis::rz).velocity, 0.0, 1e-12);
    c.axis = Axis::x;
    c.driver = solver::Driver{.quantity = Quantity::acceleration, .target = 0.0};
    solver::ConstraintSet set(1, 1);
    ASSERT_TRUE(set.add(c));
    ASSERT_TRUE(set.fill(model, state));
    EXPECT_NEAR(set.rows()[0].a.linear.norm(), 1.0, 1e-12);
    c.driver.reset();
  }
}

// Axes that the body carries move as fixed ones do that coincide with them now; where they are counts for
// nothing.
TEST(Measures, AlongCarriedAxesAreTheVelocityAlongFixedOnes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Moving robot(seed);
    const AttachedFrame carried{robot.hand.body, robot.fixed.pose};
    const solver::FrameMotion now = motion_of(carried, robot.model, robot.start);
    AxisConstraint c;
    c.move = robot.hand;
    for (int axis = 0; axis < 6; ++axis) {
      c.axis = static_cast<Axis>(axis);
      c.in = carried;
      const solver::Coordinate own = coordinate_of(c, robot.model, robot.start);
      c.in = {-1, now.pose};
      EXPECT_NEAR(own.velocity, coordinate_of(c, robot.model, robot.start).velocity, 1e-12) << axis;
      EXPECT_EQ(own.position, 0.0);
    }
  }
}

TEST(Measures, ThePositionAloneIsThatOfTheCoordinate) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Moving robot(seed);
    solver::BodyMotions motions(2);
    motions.start(robot.model, robot.start);
    for (const AttachedFrame& in : {robot.object, robot.elbow, AttachedFrame{robot.hand.body, {}}}) {
      for (int axis = 0; axis < 6; ++axis) {
        const auto along = static_cast<Axis>(axis);
        EXPECT_NEAR(position_of(robot.hand, in, along, motions),
                    coordinate_of(robot.hand, in, along, robot.model, robot.start).position, 1e-13);
      }
    }
  }
}

TEST(Measures, WithoutADirectionStayFinite) {
  const Moving robot(3);
  AxisConstraint c;
  c.move = robot.hand;
  c.in = robot.hand;
  for (const Measure measure : {Measure::distance, Measure::angle, Measure::bearing, Measure::speed}) {
    c.measure = measure;
    const solver::Coordinate now = coordinate_of(c, robot.model, solver::State(robot.model));
    // A processor that fuses a product with a sum leaves the last bit of R'R.
    EXPECT_NEAR(now.position, 0.0, std::numeric_limits<double>::epsilon());
    EXPECT_TRUE(std::isfinite(now.velocity));
    EXPECT_TRUE(std::isfinite(now.acceleration_bias));
  }
}

// Seen from F at (1, 1), turned by 30 deg, a mark at 2 m in the direction of 75 deg stands 45 deg to the
// left.
TEST(Measures, ABearingIsSignedFromTheXAxisAndWraps) {
  const solver::Model model = solver::test::mecanum({});
  const solver::State rest(model);
  AxisConstraint c;
  c.measure = Measure::bearing;
  c.move = {0, {solver::rotation_from_rpy(0.0, 0.0, std::numbers::pi / 6.0), {1.0, 1.0, 0.0}}};
  const auto mark_at = [&](double direction, double distance) {
    c.in = {-1, {}};
    c.in.pose.position = {1.0 + distance * std::cos(direction), 1.0 + distance * std::sin(direction), 0.4};
    return coordinate_of(c, model, rest).position;
  };
  EXPECT_NEAR(mark_at(75.0 / 180.0 * std::numbers::pi, 2.0), std::numbers::pi / 4.0, 1e-12);
  EXPECT_NEAR(mark_at(0.0, 2.0), -std::numbers::pi / 6.0, 1e-12);
  // Behind, 179 deg to the right: the short way to 170 deg on the left is on to the right.
  const double behind = mark_at(-149.0 / 180.0 * std::numbers::pi, 2.0);
  EXPECT_NEAR(behind, -179.0 / 180.0 * std::numbers::pi, 1e-12);
  c.driver = solver::Driver{.quantity = Quantity::position, .target = 170.0 / 180.0 * std::numbers::pi};
  solver::ConstraintSet set(1, 2);
  ASSERT_TRUE(set.add(c));
  ASSERT_TRUE(set.fill(model, rest));
  ASSERT_EQ(set.rows().size(), 1u);
  EXPECT_NEAR(set.rows()[0].b, -11.0 / 180.0 * std::numbers::pi / (0.5 * 0.5), 1e-9);
  // 4 cm from F's z axis it points nowhere.
  mark_at(1.0, 0.04);
  set[0].in = c.in;
  ASSERT_TRUE(set.fill(model, rest));
  EXPECT_TRUE(set.rows().empty());
}

/// e . p'' of the point, by fourth-order differences of its velocity in the world.
double acceleration_of_point(const Moving& robot, const AxisConstraint& c, const Vector3& e) {
  constexpr double h = 2e-4;
  const auto velocity = [&](double t) { return motion_of(c.move, robot.model, robot.at(t)).linear.dot(e); };
  return (8.0 * (velocity(h) - velocity(-h)) - (velocity(2.0 * h) - velocity(-2.0 * h))) / (12.0 * h);
}

// Axes that turn with the body: the acceleration of an axis is the rate of its velocity, that of a side is
// the point's own.
TEST(Measures, ASideHasTheAccelerationOfThePoint) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Moving robot(seed);
    for (const AttachedFrame& in :
         {AttachedFrame{robot.hand.body, {robot.hand.pose.rotation, {}}}, robot.fixed}) {
      AxisConstraint c;
      c.move = robot.hand;
      c.in = in;
      c.measure = Measure::side;
      c.coefficients = {0.6, -0.8, 0.0, 0.0, 0.0, 0.0};
      c.acceleration = Range{-1.0, solver::infinity};
      const solver::Pose axes = motion_of(in, robot.model, robot.start).pose;
      const Vector3 e = axes.rotation * Vector3(0.6, -0.8, 0.0);
      solver::ConstraintSet set(1, 2);
      ASSERT_TRUE(set.add(c));
      ASSERT_TRUE(set.fill(robot.model, robot.start));
      ASSERT_EQ(set.rows().size(), 1u);
      EXPECT_NEAR(acceleration_of_point(robot, c, e),
                  spatial_acceleration_along(robot, set.rows()[0]) + set.coordinates()[0].acceleration_bias,
                  1e-7)
          << seed;
    }
  }
}

}  // namespace
}  // namespace zwang::oracle
