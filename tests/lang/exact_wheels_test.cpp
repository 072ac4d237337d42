// Wheels that are drawn a little beside their axle. The oracle is the robot whose wheels are drawn exactly.
// The freedoms are the same. The apparent masses and largest forces differ as little as the drawing.
#include "robot/exact_wheels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../deviating_robot.hpp"
#include "support.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/solver/base_analysis.hpp"
#include "zwang/solver/wheel_odometry.hpp"

namespace zwang::lang {
namespace {

using solver::BaseAnalysis;
using test::rendered;
using zwang::test::DrawnDeviation;

constexpr double degree = std::numbers::pi / 180.0;
const std::filesystem::path shipped = test::source_dir / "specs/robots";

struct Loaded {
  Robot robot;
  bool is_told = false;  // W812
};

Loaded load_file(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  std::optional<Robot> robot = load_robot(path, diagnostics);
  if (!robot) throw std::runtime_error(rendered(diagnostics));
  return {std::move(*robot), test::count(diagnostics, "W812") > 0};
}

Loaded deviating(const std::string& robot, const DrawnDeviation& most, unsigned seed) {
  const test::Folder folder;
  return load_file(zwang::test::write_deviating_robot(folder.path(), robot, most, seed));
}

BaseAnalysis analysed(const Robot& robot) {
  return solver::analyse_base(robot.model, start_state(robot));
}

struct Drive {
  const char* robot;
  double lever;  // [m] shortest distance that its inertia depends on: half a track, or a caster's trail
};

void PrintTo(const Drive& drive, std::ostream* out) {
  *out << drive.robot;
}

class NearlyExact : public testing::TestWithParam<Drive> {
 protected:
  void expect_as_exact(const DrawnDeviation& most, unsigned seed) {
    const Robot exact = load_file(shipped / (std::string(GetParam().robot) + ".yaml")).robot;
    const Robot drawn = deviating(GetParam().robot, most, seed).robot;
    const BaseAnalysis is = analysed(drawn), should = analysed(exact);
    EXPECT_EQ(is.mobility, should.mobility);
    EXPECT_EQ(is.base_mobility, should.base_mobility);
    EXPECT_EQ(is.motor_rank, should.motor_rank);
    EXPECT_EQ(is.exact, should.exact);
    EXPECT_EQ(is.redundant_ground_rows, should.redundant_ground_rows);
    // An inertia m l^2 changes by 2 dl / l; both wheels of a pair, and a force, which goes with 1 / l.
    const double share = 4.0 * (most.distance / GetParam().lever + most.angle);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(is.axes[k].reachable, should.axes[k].reachable) << k;
      if (!should.axes[k].reachable) continue;
      EXPECT_NEAR(is.axes[k].effective_mass / should.axes[k].effective_mass, 1.0, share) << k;
      EXPECT_NEAR(is.axes[k].largest_force / should.axes[k].largest_force, 1.0, share) << k;
    }
    EXPECT_EQ(solver::WheelOdometry(drawn.model).twist(start_state(drawn)).rank,
              solver::WheelOdometry(exact.model).twist(start_state(exact)).rank);
  }
};

TEST_P(NearlyExact, AMillimetreAndHalfADegreeChangeNothing) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    expect_as_exact({1e-3, 0.5 * degree}, seed);
  }
}

// Below what is told, and where a rank is decided by rounding: 13 um are 1e-10 of a row's square.
TEST_P(NearlyExact, RoundedNumbersChangeNothing) {
  for (const double scale : {1e-1, 1.3e-2, 1e-3, 1e-5}) {
    SCOPED_TRACE(scale);
    expect_as_exact({scale * 1e-3, scale * 0.5 * degree}, 1);
    EXPECT_FALSE(deviating(GetParam().robot, {scale * 0.9e-3, scale * 0.4 * degree}, 1).is_told);
  }
}

TEST_P(NearlyExact, FiveMillimetresAndTwoDegreesRunAndAreTold) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    const Loaded drawn = deviating(GetParam().robot, {3.5e-3, 1.4 * degree}, seed);
    EXPECT_TRUE(drawn.is_told);
    const Robot exact = load_file(shipped / (std::string(GetParam().robot) + ".yaml")).robot;
    EXPECT_EQ(analysed(drawn.robot).mobility, analysed(exact).mobility);
  }
}

TEST_P(NearlyExact, AnExactRobotIsTakenAsDrawn) {
  const Loaded exact = load_file(shipped / (std::string(GetParam().robot) + ".yaml"));
  EXPECT_FALSE(exact.is_told);
  EXPECT_TRUE(exact_places(exact.robot.model).empty()) << "its logs would not replay";
  EXPECT_TRUE(exact_places(deviating(GetParam().robot, {1e-3, 0.5 * degree}, 1).robot.model).empty())
      << "once is enough";
}

// Trails of 10 mm are the smallest lever of the casters.
INSTANTIATE_TEST_SUITE_P(Drives, NearlyExact,
                         testing::Values(Drive{"mecanum_base", 0.2}, Drive{"omni_base", 0.1},
                                         Drive{"diff_base", 0.25}, Drive{"kelo_base", 0.01},
                                         Drive{"kelo_two_base", 0.01}, Drive{"skid_base", 0.25},
                                         Drive{"tricycle_base", 0.2}, Drive{"car_base", 0.1},
                                         Drive{"swerve_base", 0.25}, Drive{"mecanum_arm_base", 0.2}));

std::string mini_with_wheels(const std::string& left, const std::string& right) {
  std::string text = test::slurp(test::source_dir / "tests/conformance/robots/mini.urdf");
  text = test::replaced(text, "<origin xyz=\"0 0.2 0.1\"/>", left);
  return test::replaced(text, "<origin xyz=\"0 -0.2 0.1\"/>", right);
}

Loaded load_mini(const std::string& left, const std::string& right) {
  const test::Folder folder;
  folder.write("mini.urdf", mini_with_wheels(left, right));
  return load_file(
      folder.write("mini.yaml", test::slurp(test::source_dir / "tests/conformance/robots/mini.yaml")));
}

TEST(ExactWheels, BeyondFiveMillimetresARobotIsWhatItIs) {
  const Loaded askew = load_mini(R"(<origin xyz="0.012 0.2 0.1"/>)", R"(<origin xyz="0 -0.2 0.1"/>)");
  EXPECT_FALSE(askew.is_told);
  EXPECT_EQ(analysed(askew.robot).mobility, 1) << "each wheel holds the other's sideways motion";
  const Loaded ahead = load_mini(R"(<origin xyz="0.006 0.2 0.1"/>)", R"(<origin xyz="0.006 -0.2 0.1"/>)");
  EXPECT_TRUE(analysed(ahead.robot).axes[1].reachable) << "6 mm before the origin, which turning moves";
}

TEST(ExactWheels, AnAxleBesideTheOriginIsOneAxle) {
  const Loaded drawn =
      load_mini(R"(<origin xyz="0.30001 0.2 0.1"/>)", R"(<origin xyz="0.3 -0.2 0.1" rpy="0 0 3.1416"/>)");
  EXPECT_EQ(analysed(drawn.robot).mobility, 2);
  EXPECT_TRUE(analysed(drawn.robot).axes[1].reachable) << "300 mm before the origin";
}

TEST(ExactWheels, ABaseThatIsTurnedAgainstItsAxleKeepsTheAxle) {
  // Both wheels 30 deg askew, one of them 0.1 deg more: parallel, and neither x nor y is held alone.
  const Loaded drawn = load_mini(R"(<origin xyz="-0.1 0.1732050808 0.1" rpy="0 0 0.5235987756"/>)",
                                 R"(<origin xyz="0.1 -0.1732050808 0.1" rpy="0 0 0.5253441048"/>)");
  EXPECT_TRUE(drawn.is_told);
  EXPECT_EQ(analysed(drawn.robot).mobility, 2);
}

// A steering whose axis is 0.5 mm off its wheel would be a caster that swings 2 rad/s for each mm/s.
TEST(ExactWheels, ASteeringThatNearlyMeetsItsAxleIsNoCaster) {
  const Robot tricycle = deviating("tricycle_base", {1e-3, 0.0}, 3).robot;
  solver::State state = start_state(tricycle);
  state.q(tricycle.model.find_joint("steering").value()) = 0.3;
  EXPECT_EQ(solver::analyse_base(tricycle.model, state).base_mobility, 1);
}

}  // namespace
}  // namespace zwang::lang
