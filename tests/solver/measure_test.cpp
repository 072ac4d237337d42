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

class PlanarRows : public testing::Test {
 protected:
  PlanarRows() {
    state.base_pose.rotation = solver::rotation_from_rpy(0.0, 0.0, 0.7);
    state.base_pose.position = {0.3, -0.2, 0.0};
    base.move.body = 0;
  }
  const solver::Coordinate& only() const { return set.coordinates()[0]; }
  solver::Model model = solver::test::mecanum({});
  solver::State state{model};
  solver::ConstraintSet set;
  AxisConstraint base;
};

TEST_F(PlanarRows, TheSpeedHasOneRowAlongTheMotion) {
  state.base_twist.linear = {0.3, 0.4, 0.0};
  base.measure = Measure::speed;
  base.velocity = Range{0.0, 0.6};
  ASSERT_TRUE(set.add(base));
  ASSERT_TRUE(set.fill(model, state));
  // The lower end, 0, says nothing of a length.
  ASSERT_EQ(set.rows().size(), 1u);
  const Row& row = set.rows()[0];
  EXPECT_EQ(row.kind, RowKind::upper);
  EXPECT_NEAR((row.a.linear - Vector3(0.6, 0.8, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(only().velocity, 0.5, 1e-12);
  EXPECT_NEAR(row.b + only().acceleration_bias, (0.6 - 0.5) / 0.010, 1e-9);
  state.base_twist.linear *= 0.5;
  ASSERT_TRUE(set.fill(model, state));
  EXPECT_TRUE(set.rows().empty()) << "0.25 m/s is below half of the limit";
}

TEST_F(PlanarRows, ACornerOfTheFootprintAtAnEdge) {
  // d = n.(p - e), kept at or above the margin: one lower row with the braking curve.
  const double slope = std::numbers::pi / 6.0;
  base.move.pose.position = {0.4, 0.25, 0.0};
  base.in.pose.position = {2.0, 0.0, 0.0};
  base.measure = Measure::direction;
  base.coefficients = {-std::cos(slope), -std::sin(slope), 0, 0, 0, 0};
  base.position = Range{0.1, solver::infinity};
  base.braking = 0.5;
  ASSERT_TRUE(set.add(base));
  ASSERT_TRUE(set.fill(model, state));
  ASSERT_EQ(set.rows().size(), 1u);
  const Vector3 corner = state.base_pose * base.move.pose.position;
  const double d = -std::cos(slope) * (corner.x() - 2.0) - std::sin(slope) * corner.y();
  EXPECT_NEAR(only().position, d, 1e-12);
  EXPECT_EQ(set.rows()[0].kind, RowKind::lower);
  EXPECT_NEAR(set.rows()[0].b, -solver::braking_speed(d - 0.1, 0.5, 0.010) / 0.010, 1e-9);
}

TEST_F(PlanarRows, OutsideOfAPositionRangeTheWayBackHasItsSpeed) {
  // d < 0: b = min(-v/h, max((-min(v_brk(|d|), v_ret) - v)/h, -a_brk)), v the speed outwards.
  state.base_twist.linear = {0.2, 0.0, 0.0};
  base.position = Range{-solver::infinity, 0.0};
  base.move.pose.position = {1000.0, 0.0, 0.0};
  ASSERT_TRUE(set.add(base));
  ASSERT_TRUE(set.fill(model, state));
  const double h = 0.010, v = only().velocity;
  for (const double braking : {0.5, 1e3}) {
    for (const double v_ret : {0.0, 0.1, solver::infinity}) {
      set[0].braking = braking;
      set[0].return_speed = v_ret;
      ASSERT_TRUE(set.fill(model, state));
      const double d = only().position;
      ASSERT_GT(d, 100.0);
      const double back = std::min(std::sqrt(2.0 * 0.72 * braking * d), v_ret);
      const double asked = set.rows()[0].b + only().acceleration_bias;
      EXPECT_NEAR(asked, std::min(-v / h, std::max((-back - v) / h, -braking)),
                  1e-3 * (1.0 + std::abs(asked)));
    }
  }
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

constexpr double horizon = 0.010;  // [s]

// Along the curve v dv/dd is the deceleration: 0.72 of what may be used, less where d < d0 = 16 a h^2.
TEST(BrakingCurve, DeceleratesWithItsShareAndStopsAtTheBound) {
  const double most = 0.5, a = 0.72 * most, d0 = 16.0 * a * horizon * horizon;
  const auto v = [&](double d) { return solver::braking_speed(d, most, horizon); };
  for (const double d : {1.01 * d0, 2.0 * d0, 0.1, 1.0, 10.0}) {
    EXPECT_NEAR(d, 0.5 * v(d) * v(d) / a + 0.5 * d0, 1e-12 * d) << "v^2 / 2a, and the end";
    const double step = 1e-5 * d;
    EXPECT_NEAR(v(d) * (v(d + step) - v(d - step)) / (2.0 * step), a, 1e-6 * a);
  }
  EXPECT_NEAR(v(0.5 * d0), 0.5 * d0 / (4.0 * horizon), 1e-15);
  EXPECT_NEAR(v(d0 * (1.0 - 1e-9)), v(d0 * (1.0 + 1e-9)), 1e-10);
  EXPECT_EQ(v(0.0), 0.0);
  EXPECT_EQ(v(-0.3), -v(0.3));
}

TEST(BrakingCurve, IsReadTheOtherWayByTheDistance) {
  for (const double braking : {0.05, 0.5, 3.0}) {
    for (const double v : {0.0, 1e-4, 0.003, 0.02, 0.3, 2.0, -0.3}) {
      const double d = solver::braking_distance(v, braking, horizon);
      EXPECT_NEAR(solver::braking_speed(d, braking, horizon), v, 1e-12 * std::abs(v)) << braking << " " << v;
    }
  }
}

/// How far a base gets past a bound when it does 1/heavier of what its row asks for, which is not more than
/// `most`. [m]
double past_the_bound(double heavier, double most) {
  const double tick = 0.001;
  double d = 1.0, v = 0.5, least = d;
  for (int i = 0; i < 10000; ++i) {
    const double asked = (solver::braking_speed(d, most, horizon) - v) / horizon;
    v += tick * std::clamp(asked, -most, 0.0) / heavier;
    d -= tick * v;
    least = std::min(least, d);
  }
  EXPECT_LT(least, 0.01) << "it never came there";
  return std::max(0.0, -least);
}

TEST(BrakingCurve, LeavesABaseThatIsThirtyPercentHeavierEnoughToFollowIt) {
  for (const double most : {0.3, 0.5, 1.0, 2.0}) {
    EXPECT_LE(past_the_bound(1.3, most), 1e-3) << most;
    EXPECT_LE(past_the_bound(1.0, most), 1e-4) << most;
    EXPECT_LE(past_the_bound(0.7, most), 1e-4) << most;
    EXPECT_GT(past_the_bound(1.5, most), 1e-3) << "1.5 x 0.72 is more than the range, " << most;
  }
}

TEST_F(PlanarRows, ACornerOfTheRegionAtAnEdgeOfTheFootprint) {
  // F in the world, T on the base: the row acts on the base with the opposite force.
  AxisConstraint c;
  c.move.pose.position = {1.5, 0.4, 0.0};
  c.in = {0, {solver::Matrix3::Identity(), {0.4, 0.0, 0.0}}};
  c.position = Range{0.05, solver::infinity};
  ASSERT_TRUE(set.add(c));
  ASSERT_TRUE(set.fill(model, state));
  ASSERT_EQ(set.rows().size(), 1u);
  const Row& row = set.rows()[0];
  EXPECT_EQ(row.body, 0);
  EXPECT_EQ(row.reference_body, -1);
  EXPECT_NEAR((row.a.linear - Vector3(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
  // Two frames of the world concern no body.
  set[0].in.body = -1;
  ASSERT_TRUE(set.fill(model, state));
  EXPECT_TRUE(set.rows().empty());
}

TEST_F(PlanarRows, AForceRangeWithoutADriverIsASum) {
  base.force = Range{-40.0, 40.0};
  base.level = 0;
  ASSERT_TRUE(set.add(base));
  ASSERT_TRUE(set.fill(model, state));
  ASSERT_EQ(set.rows().size(), 1u);
  EXPECT_EQ(set.rows()[0].kind, RowKind::sum);
  EXPECT_EQ(set.rows()[0].hi, 40.0);
  set[0].driver = solver::Driver{.target = 0.2, .force = {-60.0, 30.0}};
  ASSERT_TRUE(set.fill(model, state));
  ASSERT_EQ(set.rows().size(), 1u);
  EXPECT_EQ(set.rows()[0].kind, RowKind::driver);
  EXPECT_EQ(set.rows()[0].lo, -40.0);
  EXPECT_EQ(set.rows()[0].hi, 30.0);
}

TEST_F(PlanarRows, AnAxisAndItsSumPressWithTheSumAtMost) {
  AxisConstraint limit = base;
  limit.force = Range{-40.0, 40.0};
  limit.level = 0;
  AxisConstraint drive = base;
  drive.driver = solver::Driver{.target = 5.0, .force = {-60.0, 60.0}};
  AxisConstraint push = base;
  push.driver = solver::Driver{.quantity = Quantity::force, .target = 15.0};
  for (const AxisConstraint& c : {limit, drive, push}) ASSERT_TRUE(set.add(c));
  ASSERT_TRUE(set.fill(model, state));
  solver::Solver solver(model);
  solver::Solution solution(model);
  ASSERT_EQ(solver.solve(state, set.rows(), solution), solver::Status::ok);
  EXPECT_NEAR(solution.rows[0].nu, 40.0, 1e-9);
  EXPECT_NEAR(solution.rows[1].nu, 25.0, 1e-9);
  EXPECT_NEAR(solution.rows[2].nu, 15.0, 1e-9);
}

TEST_F(PlanarRows, ASpringIsAForceRow) {
  base.driver = solver::Driver{.quantity = Quantity::position, .target = 0.5, .force = {-30.0, 30.0}};
  base.driver->stiffness = 100.0;
  base.driver->damping = 20.0;
  state.base_twist.linear = {0.1, 0.0, 0.0};
  ASSERT_TRUE(set.add(base));
  ASSERT_TRUE(set.fill(model, state));
  ASSERT_EQ(set.rows().size(), 1u);
  EXPECT_EQ(set.rows()[0].kind, RowKind::force);
  EXPECT_NEAR(set.rows()[0].force, 100.0 * (0.5 - 0.3) - 20.0 * 0.1 * std::cos(0.7), 1e-12);
  set[0].driver->target = 3.0;
  ASSERT_TRUE(set.fill(model, state));
  EXPECT_EQ(set.rows()[0].force, 30.0);
}

}  // namespace
}  // namespace zwang::oracle
