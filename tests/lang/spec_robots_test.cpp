// The robots that ship. The mobility of each drive is that of a textbook's table of wheeled bases. Its wheels
// turn by the textbook's formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "robot/wheel_speed.hpp"
#include "support.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/solver/base_analysis.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::lang {
namespace {

using solver::BaseAnalysis;
using solver::State;
using solver::Vector3;
using test::rendered;

const std::filesystem::path folder = test::source_dir / "specs/robots";

Robot shipped(const std::string& name) {
  Diagnostics diagnostics;
  auto robot = load_robot(folder / (name + ".yaml"), diagnostics);
  if (!robot) throw std::runtime_error(rendered(diagnostics));
  return *robot;
}

int joint_of(const Robot& robot, const std::string& name) {
  return robot.model.find_joint(name).value();
}

TEST(SpecRobots, all_of_them_validate_without_a_word) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".yaml") continue;
    Diagnostics diagnostics;
    EXPECT_TRUE(load_robot(file.path(), diagnostics)) << rendered(diagnostics);
    EXPECT_TRUE(diagnostics.all().empty()) << rendered(diagnostics);
    ++count;
  }
  EXPECT_GE(count, 10);
}

struct Expected {
  const char* robot;
  int mobility, base_mobility, motor_rank, internal_forces, redundant_rows;
  bool x, y, rz;  // reachable
  bool exact;
};

void PrintTo(const Expected& expected, std::ostream* out) {
  *out << expected.robot;
}

class DriveTable : public testing::TestWithParam<Expected> {};

TEST_P(DriveTable, holds) {
  const Expected& expected = GetParam();
  const Robot robot = shipped(expected.robot);
  const BaseAnalysis base = solver::analyse_base(robot.model, start_state(robot));
  EXPECT_EQ(base.mobility, expected.mobility);
  EXPECT_EQ(base.base_mobility, expected.base_mobility);
  EXPECT_EQ(base.motor_rank, expected.motor_rank);
  EXPECT_EQ(base.internal_forces, expected.internal_forces);
  EXPECT_EQ(base.redundant_ground_rows, expected.redundant_rows);
  EXPECT_EQ(base.axes[0].reachable, expected.x);
  EXPECT_EQ(base.axes[1].reachable, expected.y);
  EXPECT_EQ(base.axes[2].reachable, expected.rz);
  EXPECT_EQ(base.exact, expected.exact);
  EXPECT_FALSE(base.mirrored_rollers);
  EXPECT_FALSE(base.locked);
}

// Freedoms less independent rows; e.g. four active casters: 6 + 12 joints, 3 + 16 rows of which 4 are
// redundant.
INSTANTIATE_TEST_SUITE_P(Drives, DriveTable,
                         testing::Values(Expected{"mecanum_base", 3, 3, 3, 1, 0, true, true, true, true},
                                         Expected{"omni_base", 3, 3, 3, 0, 0, true, true, true, true},
                                         Expected{"diff_base", 2, 2, 2, 0, 1, true, false, true, true},
                                         Expected{"kelo_base", 3, 3, 3, 5, 4, true, true, true, true},
                                         Expected{"kelo_two_base", 3, 3, 3, 1, 2, true, true, true, true},
                                         Expected{"skid_base", 3, 3, 2, 2, 0, true, false, true, false},
                                         Expected{"tricycle_base", 2, 1, 2, 0, 1, true, false, false, true},
                                         Expected{"car_base", 2, 1, 2, 1, 2, true, false, false, true},
                                         Expected{"swerve_base", 5, 1, 5, 3, 2, true, false, false, true},
                                         Expected{"mecanum_arm_base", 10, 3, 10, 1, 0, true, true, true,
                                                  true}));

TEST(SpecRobots, a_swerve_base_whose_wheels_cross_is_locked) {
  const Robot robot = shipped("swerve_base");
  State state = start_state(robot);
  const double angles[] = {0.3, -0.9, 1.1, 0.2};
  int i = 0;
  for (const char* name : {"front_left", "front_right", "rear_left", "rear_right"})
    state.q(joint_of(robot, std::string(name) + "_steering")) = angles[i++];
  const BaseAnalysis base = solver::analyse_base(robot.model, state);
  EXPECT_TRUE(base.locked);
  EXPECT_EQ(base.base_mobility, 0);
  EXPECT_EQ(base.mobility, 4) << "the swivels";
}

// Four wheels that turn about the base's middle: tangent to the circle through them.
TEST(SpecRobots, a_swerve_base_turns_once_its_wheels_are_steered_for_it) {
  const Robot robot = shipped("swerve_base");
  State state = start_state(robot);
  const double quarter = M_PI / 4.0;
  state.q(joint_of(robot, "front_left_steering")) = 3.0 * quarter;
  state.q(joint_of(robot, "rear_left_steering")) = -3.0 * quarter;
  state.q(joint_of(robot, "rear_right_steering")) = -quarter;
  state.q(joint_of(robot, "front_right_steering")) = quarter;
  const BaseAnalysis base = solver::analyse_base(robot.model, state);
  EXPECT_EQ(base.base_mobility, 1);
  EXPECT_TRUE(base.axes[2].reachable);
  EXPECT_FALSE(base.axes[0].reachable);
}

// wz = vx tan(delta) / L: rz is the row x times L / tan(delta).
TEST(SpecRobots, steered_wheels_make_yaw_a_multiple_of_driving) {
  const struct {
    const char* robot;
    double wheelbase;
  } steered[] = {{"tricycle_base", 0.50}, {"car_base", 0.33020}};
  for (const auto& base : steered) {
    const Robot robot = shipped(base.robot);
    State state = start_state(robot);
    const double delta = 0.3;
    state.q(joint_of(robot, "steering")) = delta;
    const BaseAnalysis analysis = solver::analyse_base(robot.model, state);
    EXPECT_TRUE(analysis.axes[0].reachable);
    EXPECT_TRUE(analysis.axes[2].reachable);
    EXPECT_FALSE(analysis.axes[1].reachable);
    const double ratio = base.wheelbase / std::tan(delta);
    EXPECT_NEAR(analysis.axes[2].effective_mass / analysis.axes[0].effective_mass, ratio * ratio,
                1e-6 * ratio * ratio)
        << base.robot;
  }
}

/// A motion that the ground allows, near a random one, with swivels and steerings anywhere.
class RollingState {
 public:
  RollingState(const Robot& robot, unsigned seed) : state(start_state(robot)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (Eigen::Index j = 0; j < state.q.size(); ++j) {
      state.q(j) = 3.0 * any(random);
      state.qd(j) = 5.0 * any(random);
    }
    state.base_twist = {{0.0, 0.0, any(random)}, {any(random), any(random), 0.0}};
    solver::Solver solver(robot.model);
    EXPECT_EQ(solver.project_velocity(state), solver::Status::ok);
  }
  Vector3 velocity_at(double x, double y) const {
    return state.base_twist.linear + state.base_twist.angular.cross(Vector3(x, y, 0.0));
  }
  double turn() const { return state.base_twist.angular.z(); }
  State state;
};

// Any mirrored rollers of a base on four mecanum wheels are named. Four mirrored ones are told by the lever
// with which they turn the base. Omni wheels mirror into themselves.
TEST(SpecRobots, mirrored_rollers_are_named) {
  const test::Folder place;
  place.write("mecanum_base.urdf", test::slurp(folder / "mecanum_base.urdf"));
  const std::string text = test::slurp(folder / "mecanum_base.yaml");
  const std::vector<std::string> wheels{"front_left_wheel", "front_right_wheel", "rear_left_wheel",
                                        "rear_right_wheel"};
  for (unsigned flipped = 1; flipped < 16; ++flipped) {
    std::string changed = text;
    int count = 0;
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      if (((flipped >> i) & 1U) == 0U) continue;
      ++count;
      const std::size_t at = changed.find("roller: ", changed.find("joint: " + wheels[i])) + 8;
      changed[at] == '-' ? changed.erase(at, 1) : changed.insert(at, "-");
    }
    Diagnostics diagnostics;
    load_robot(place.write("mecanum_base.yaml", changed), diagnostics);
    ASSERT_EQ(test::count(diagnostics, "W868"), 1) << flipped << rendered(diagnostics);
    for (const Diagnostic& d : diagnostics.all()) {
      if (d.code != "W868") continue;
      for (std::size_t i = 0; i < wheels.size(); ++i) {
        const bool is_named = d.message.find(wheels[i]) != std::string::npos;
        EXPECT_EQ(is_named, count < 4 && ((flipped >> i) & 1U) != 0U) << flipped << " " << d.message;
      }
    }
  }
}

// qd = u' [1 0 -y; 0 1 x] V / (R u_x), u the roller's axis at the ground.
TEST(SpecRobots, rollers_turn_their_wheels_by_the_formula) {
  for (const char* name : {"mecanum_base", "omni_base"}) {
    const Robot robot = shipped(name);
    const RollingState rolling(robot, 1);
    for (const solver::Wheel& wheel : robot.model.wheels()) {
      const solver::Body& body = robot.model.bodies()[static_cast<std::size_t>(wheel.body)];
      const Vector3 axis = body.pose_in_parent.rotation * Vector3::UnitY();
      const Vector3 u = Eigen::AngleAxisd(*wheel.roller_angle, Vector3::UnitZ()) * axis;
      const Vector3 along = axis.cross(Vector3::UnitZ());
      const Vector3& p = body.pose_in_parent.position;
      const double expected = u.dot(rolling.velocity_at(p.x(), p.y())) / (wheel.radius * u.dot(along));
      EXPECT_NEAR(rolling.state.qd(wheel.body - 1), expected, 1e-9) << name << ' ' << body.name;
    }
    EXPECT_GT(rolling.state.qd.norm(), 0.1);
  }
}

// The wheel that is nearest to its limit, by the velocities that the solver's ground rows leave.
TEST(SpecRobots, the_wheels_bound_the_speed_of_the_base) {
  for (const char* name : {"mecanum_base", "omni_base", "diff_base"}) {
    const Robot robot = shipped(name);
    for (const unsigned seed : {1u, 2u, 3u}) {
      const RollingState rolling(robot, seed);
      double least = solver::infinity;
      for (const solver::Wheel& wheel : robot.model.wheels()) {
        const solver::Joint& joint = robot.model.joint(wheel.body - 1);
        if (joint.actuated)
          least = std::min(least, joint.max_velocity / std::abs(rolling.state.qd(wheel.body - 1)));
      }
      const WheelSpeed speed = wheel_speed(robot, rolling.velocity_at(0.0, 0.0), rolling.turn());
      ASSERT_TRUE(std::isfinite(least)) << name;
      EXPECT_NEAR(speed.most, least, 1e-6 * least) << name << ' ' << seed;
    }
  }
}

// left and right (vx -+ b wz) / R; a caster swivels with n'v / c - wz and rolls with e'v / R.
TEST(SpecRobots, a_differential_base_turns_wheels_and_casters_by_the_formulas) {
  const Robot robot = shipped("diff_base");
  const RollingState rolling(robot, 2);
  const auto rate = [&](const char* joint) { return rolling.state.qd(joint_of(robot, joint)); };
  EXPECT_NEAR(rate("left_wheel"), rolling.velocity_at(0.0, 0.25).x() / 0.13, 1e-9);
  EXPECT_NEAR(rate("right_wheel"), rolling.velocity_at(0.0, -0.25).x() / 0.13, 1e-9);
  EXPECT_NEAR(rolling.velocity_at(0.0, 0.0).y(), 0.0, 1e-12);
  for (const auto& [side, y] : {std::pair{"left", 0.18}, std::pair{"right", -0.18}}) {
    const std::string caster = std::string(side) + "_caster";
    const double q = rolling.state.q(joint_of(robot, caster));
    const Vector3 e(std::cos(q), std::sin(q), 0.0), n(-std::sin(q), std::cos(q), 0.0);
    const Vector3 v = rolling.velocity_at(-0.42, y);
    EXPECT_NEAR(rate(caster.c_str()), n.dot(v) / 0.04 - rolling.turn(), 1e-8);
    EXPECT_NEAR(rate((caster + "_wheel").c_str()), e.dot(v) / 0.0625, 1e-8);
  }
}

// (1/R) (e -+ s/(2c) n)' v at the swivel axis, left and right; the swivel n'v / c - wz.
TEST(SpecRobots, active_casters_turn_their_hubs_by_the_formula) {
  const Robot robot = shipped("kelo_base");
  const RollingState rolling(robot, 3);
  const struct {
    const char* unit;
    double x, y;
  } units[] = {{"front_left", 0.25, 0.20},
               {"rear_left", -0.25, 0.20},
               {"rear_right", -0.25, -0.20},
               {"front_right", 0.25, -0.20}};
  const double c = 0.010, s = 2.0 * 0.0393, R = 0.0535;
  for (const auto& unit : units) {
    const std::string name = unit.unit;
    const double q = rolling.state.q(joint_of(robot, name + "_drive"));
    const Vector3 e(std::cos(q), std::sin(q), 0.0), n(-std::sin(q), std::cos(q), 0.0);
    const Vector3 v = rolling.velocity_at(unit.x, unit.y);
    const auto rate = [&](const std::string& joint) { return rolling.state.qd(joint_of(robot, joint)); };
    EXPECT_NEAR(rate(name + "_left_hub"), (e - s / (2.0 * c) * n).dot(v) / R, 1e-7);
    EXPECT_NEAR(rate(name + "_right_hub"), (e + s / (2.0 * c) * n).dot(v) / R, 1e-7);
    EXPECT_NEAR(rate(name + "_drive"), n.dot(v) / c - rolling.turn(), 1e-7);
  }
}

TEST(SpecRobots, a_posture_is_where_the_joints_start) {
  const Robot robot = shipped("mecanum_arm_base");
  const State state = start_state(robot);
  EXPECT_NEAR(state.q(joint_of(robot, "arm_4")), -130.0 * M_PI / 180.0, 1e-12);
  EXPECT_EQ(state.q(joint_of(robot, "arm_1")), 0.0);
}

}  // namespace
}  // namespace zwang::lang
