// Mobility, redundant rows and motor rank of the drives, against a textbook's table of wheeled bases.
#include "zwang/solver/base_analysis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "robots.hpp"

namespace zwang::solver {
namespace {

using test::base_on;
using test::WheelPlace;

constexpr double quarter = M_PI / 4.0;

WheelPlace roller(double x, double y, double angle) {
  return {.x = x, .y = y, .wheel = {.radius = 0.1, .roller_angle = angle}};
}

BaseAnalysis analyse(const Model& model) {
  return analyse_base(model, State(model));
}

TEST(BaseAnalysis, MecanumMovesEveryWayAndSqueezesOne) {
  const test::MecanumFigures figures;
  const BaseAnalysis base = analyse(test::mecanum(figures));
  EXPECT_EQ(base.mobility, 3);
  EXPECT_EQ(base.base_mobility, 3);
  EXPECT_EQ(base.motor_rank, 3);
  EXPECT_TRUE(base.exact);
  EXPECT_EQ(base.internal_forces, 1);
  EXPECT_EQ(base.redundant_ground_rows, 0);
  EXPECT_FALSE(base.mirrored_rollers);
  EXPECT_NEAR(base.axes[0].effective_mass, figures.apparent_mass(), 1e-8);
  EXPECT_NEAR(base.axes[2].effective_mass, figures.apparent_yaw_inertia(), 1e-8);
  EXPECT_NEAR(base.axes[0].largest_force, 4.0 * figures.effort / figures.radius, 1e-6);
  EXPECT_NEAR(base.axes[1].largest_force, 4.0 * figures.effort / figures.radius, 1e-6);
  EXPECT_NEAR(base.axes[2].largest_force, 4.0 * figures.effort * (figures.lx + figures.ly) / figures.radius,
              1e-6);
}

TEST(BaseAnalysis, MirroredRollersOfASquareBaseLoseYaw) {
  // The rollers' axes all pass through the centre when the tilt is mirrored and lx = ly.
  const BaseAnalysis base = analyse(base_on({roller(0.25, 0.25, -quarter), roller(0.25, -0.25, quarter),
                                             roller(-0.25, 0.25, quarter), roller(-0.25, -0.25, -quarter)}));
  EXPECT_EQ(base.mobility, 3);
  EXPECT_EQ(base.motor_rank, 2);
  EXPECT_FALSE(base.exact);
  EXPECT_TRUE(base.mirrored_rollers);
  EXPECT_FALSE(base.axes[2].reachable);
  EXPECT_TRUE(base.axes[0].reachable);
}

TEST(BaseAnalysis, ThreeOmniWheelsAreExactAndUnique) {
  // Each wheel's axis points outward and its rollers hold the tangent, a right angle from the axis.
  ModelBuilder builder(
      BaseType::ground, "base_link",
      RigidInertia::from_com(20.0, {0.0, 0.0, 0.1}, Matrix3(Vector3(0.5, 0.5, 0.6).asDiagonal())));
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * M_PI * i / 3.0;
    const std::string name = "wheel" + std::to_string(i);
    Joint joint{.name = name, .type = JointType::continuous, .axis = Vector3::UnitY()};
    joint.actuated = true;
    joint.max_effort = 5.0;
    builder.add_link(
        name + "_link", "base_link",
        {rotation_from_rpy(0.0, 0.0, angle - M_PI / 2.0),
         {0.2 * std::cos(angle), 0.2 * std::sin(angle), 0.0}},
        joint,
        RigidInertia::from_com(1.0, Vector3::Zero(), Matrix3(Vector3(0.003, 0.005, 0.003).asDiagonal())));
    Wheel wheel{.radius = 0.1};
    wheel.roller_angle = M_PI / 2.0;
    builder.add_wheel(name, wheel);
  }
  const BaseAnalysis base = analyse(builder.build());
  EXPECT_EQ(base.mobility, 3);
  EXPECT_TRUE(base.exact);
  EXPECT_EQ(base.internal_forces, 0);
}

TEST(BaseAnalysis, DifferentialBaseCannotMoveSideways) {
  const BaseAnalysis base = analyse(base_on({{.x = 0.0, .y = 0.2}, {.x = 0.0, .y = -0.2}}));
  EXPECT_EQ(base.mobility, 2);
  EXPECT_EQ(base.base_mobility, 2);
  EXPECT_TRUE(base.exact);
  EXPECT_EQ(base.redundant_ground_rows, 1) << "two wheels on one axle hold the same sideways direction";
  EXPECT_TRUE(base.axes[0].reachable);
  EXPECT_FALSE(base.axes[1].reachable);
  EXPECT_TRUE(base.axes[2].reachable);
}

WheelPlace kelo_unit(double x, double y, double angle, double offset) {
  return {.x = x,
          .y = y,
          .swivels = true,
          .swivel_angle = angle,
          .hubs = {{-offset, 0.04, 0}, {-offset, -0.04, 0}}};
}

TEST(BaseAnalysis, ActiveCastersAreExactFromTwoUnitsOn) {
  const BaseAnalysis two =
      analyse(base_on({kelo_unit(0.2, 0.1, 0.3, 0.01), kelo_unit(-0.2, -0.1, -0.8, 0.01)}));
  EXPECT_EQ(two.mobility, 3);
  EXPECT_EQ(two.base_mobility, 3);
  EXPECT_TRUE(two.exact);
  EXPECT_EQ(two.redundant_ground_rows, 2) << "one a unit";
  const BaseAnalysis one = analyse(base_on({kelo_unit(0.2, 0.1, 0.3, 0.01)}));
  EXPECT_EQ(one.mobility, 3);
  EXPECT_EQ(one.motor_rank, 2);
  EXPECT_FALSE(one.exact);
}

TEST(BaseAnalysis, SkidSteeringHasNoSidewaysForce) {
  std::vector<WheelPlace> places{
      {.x = 0.2, .y = 0.2}, {.x = 0.2, .y = -0.2}, {.x = -0.2, .y = 0.2}, {.x = -0.2, .y = -0.2}};
  for (WheelPlace& place : places) place.wheel.holds_sideways = false;
  const BaseAnalysis base = analyse(base_on(places));
  EXPECT_EQ(base.mobility, 3);
  EXPECT_EQ(base.motor_rank, 2);
  EXPECT_FALSE(base.axes[1].reachable);
  EXPECT_EQ(base.internal_forces, 2);
}

TEST(BaseAnalysis, SwerveWithCrossedWheelsIsLocked) {
  const auto swerve = [](double x, double y, double angle) {
    return WheelPlace{.x = x, .y = y, .swivels = true, .steered = true, .swivel_angle = angle};
  };
  const BaseAnalysis crossed =
      analyse(base_on({swerve(0.2, 0.2, 0.3), swerve(0.2, -0.2, -0.9), swerve(-0.2, 0.0, 1.1)}));
  EXPECT_EQ(crossed.base_mobility, 0);
  EXPECT_TRUE(crossed.locked);
  EXPECT_EQ(crossed.mobility, 3) << "the three swivels";
  const BaseAnalysis parallel =
      analyse(base_on({swerve(0.2, 0.2, 0.0), swerve(0.2, -0.2, 0.0), swerve(-0.2, 0.0, 0.0)}));
  EXPECT_FALSE(parallel.locked);
  EXPECT_EQ(parallel.base_mobility, 1);
}

TEST(BaseAnalysis, TricycleDrivesAndSteers) {
  const BaseAnalysis base =
      analyse(base_on({{.x = 0.4, .y = 0.0, .swivels = true, .steered = true, .swivel_angle = 0.2},
                       {.x = 0.0, .y = 0.2, .driven = false},
                       {.x = 0.0, .y = -0.2, .driven = false}}));
  EXPECT_EQ(base.mobility, 2);
  EXPECT_EQ(base.base_mobility, 1);
  EXPECT_TRUE(base.exact);
}

}  // namespace
}  // namespace zwang::solver
