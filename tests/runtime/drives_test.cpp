// Every drive that ships, model against plant. The solver finds torques for sine demands. Without any
// feedback they accelerate the simulated base as demanded.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>

#include "../temporary_folder.hpp"
#include "constants.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/solver/base_analysis.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {
namespace {

namespace fs = std::filesystem;
using solver::Axis;
using solver::AxisConstraint;

constexpr double frequency = 1.0;  // [Hz]
const fs::path robots = ZWANG_SOURCE_DIR "/specs/robots";

lang::Robot load(const fs::path& file) {
  lang::Diagnostics diagnostics;
  const auto robot = lang::load_robot(file, diagnostics);
  if (!robot) throw std::runtime_error(file.string() + " does not load");
  return *robot;
}

/// The KELO base with its wheels 30 mm off the swivel axis instead of 10 mm.
lang::Robot kelo_with_long_casters() {
  const zwang::test::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  fs::copy_file(robots / "kelo_base.yaml", folder / "kelo_base.yaml");
  std::ifstream in(robots / "kelo_base.urdf");
  std::stringstream text;
  text << in.rdbuf();
  const std::string longer = std::regex_replace(text.str(), std::regex("xyz=\"-0.01 "), "xyz=\"-0.03 ");
  std::ofstream(folder / "kelo_base.urdf") << longer;
  return load(folder / "kelo_base.yaml");
}

AxisConstraint accelerate(int move, int in, const solver::Pose& in_pose, Axis axis, double target) {
  AxisConstraint constraint;
  constraint.move.body = move;
  constraint.in.body = in;
  constraint.in.pose = in_pose;
  constraint.axis = axis;
  constraint.driver = solver::Driver{.quantity = solver::Quantity::acceleration, .target = target};
  return constraint;
}

/// Joints of the robot with a motor that turn no wheel: steerings and arms. The test keeps them at rest.
std::vector<int> held_joints(const solver::Model& model) {
  std::vector<int> joints;
  for (int j = 0; j < model.joint_count(); ++j) {
    bool turns_wheel = false;
    for (const solver::Wheel& wheel : model.wheels()) turns_wheel = turns_wheel || wheel.body == j + 1;
    if (model.joint(j).actuated && !turns_wheel) joints.push_back(j);
  }
  return joints;
}

AxisConstraint hold(const solver::Model& model, int joint) {
  const solver::Body& body = model.bodies()[static_cast<std::size_t>(joint) + 1];
  // z along the joint's axis, which is the frame's own in every robot here.
  EXPECT_EQ(body.joint.axis, solver::Vector3::UnitZ());
  return accelerate(joint + 1, body.parent, body.pose_in_parent, Axis::rz, 0.0);
}

struct OpenLoopCase {
  const char* name;
  double bound;  ///< of the relative rms error
  std::vector<Eigen::Vector3d> amplitudes;
  double swivel = 0.0;  ///< where unpowered swivels and steerings start [rad]
};

void PrintTo(const OpenLoopCase& drive, std::ostream* out) {
  *out << drive.name;
}

/// The rms error over two periods, relative to the demand's.
double relative_error(const lang::Robot& robot, const Eigen::Vector3d& amplitude) {
  MujocoPlant plant(robot, lang::Scene{}, {.period = period});
  Sensed sensed(robot.model);
  solver::Solver solver(robot.model);
  solver::Solution solution(robot.model);
  solver::ConstraintSet set;
  const std::vector<int> held = held_joints(robot.model);
  constexpr std::array axes{Axis::x, Axis::y, Axis::rz};
  double error = 0.0, demand = 0.0, share = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double phase = std::sin(2.0 * std::numbers::pi * frequency * i * period);
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    EXPECT_EQ(solver.project_velocity(sensed.state), solver::Status::ok);
    set.clear();
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const double a = amplitude(static_cast<Eigen::Index>(k));
      if (a == 0.0) continue;
      EXPECT_TRUE(set.add(accelerate(0, 0, {}, axes[k], a * phase)));
    }
    for (const int joint : held) EXPECT_TRUE(set.add(hold(robot.model, joint)));
    EXPECT_TRUE(set.fill(robot.model, sensed.state));
    EXPECT_EQ(solver.solve(sensed.state, set.rows(), solution), solver::Status::ok);
    EXPECT_EQ(plant.apply(solution.tau), PlantStatus::ok);
    for (int j = 0; j < robot.model.joint_count(); ++j) {
      if (robot.model.joint(j).actuated)
        share = std::max(share, std::abs(solution.tau(j)) / robot.model.joint(j).max_effort);
    }
    if (i < 50) continue;  // the contacts under the wheels settle to their first load
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (amplitude(k) == 0.0) continue;
      error += std::pow(plant.truth().acceleration(k) - amplitude(k) * phase, 2);
      demand += std::pow(amplitude(k) * phase, 2);
    }
  }
  std::printf("  torque at most %.0f %% of its limit\n", 100.0 * share);
  EXPECT_LT(share, 1.0) << "a saturated motor cannot follow";
  return std::sqrt(error / demand);
}

class OpenLoopDrive : public testing::TestWithParam<OpenLoopCase> {};

TEST_P(OpenLoopDrive, AcceleratesAsDemanded) {
  const OpenLoopCase& drive = GetParam();
  const std::string name = drive.name;
  lang::Robot robot = name == "kelo30" ? kelo_with_long_casters() : load(robots / (name + ".yaml"));
  for (int j = 0; j < robot.model.joint_count(); ++j) {
    const bool upright = robot.model.bodies()[static_cast<std::size_t>(j) + 1].parent == 0 &&
                         robot.model.joint(j).axis == solver::Vector3::UnitZ();
    if (upright && name != "mecanum_arm_base") robot.posture(j) = drive.swivel;
  }
  for (const Eigen::Vector3d& amplitude : drive.amplitudes) {
    const double error = relative_error(robot, amplitude);
    std::printf("%s, %.1f m/s^2 %.1f m/s^2 %.1f rad/s^2: rms error %.3f %% of the demand\n", drive.name,
                amplitude.x(), amplitude.y(), amplitude.z(), 100.0 * error);
    EXPECT_LE(error, drive.bound) << amplitude.transpose();
  }
}

const Eigen::Vector3d x{0.5, 0.0, 0.0}, y{0.0, 0.5, 0.0}, turn{0.0, 0.0, 1.0};

INSTANTIATE_TEST_SUITE_P(Shipped, OpenLoopDrive,
                         testing::Values(OpenLoopCase{"mecanum_base", 0.002, {x, y, turn, x + y + turn}},
                                         OpenLoopCase{"omni_base", 0.002, {x, y, turn, x + y + turn}},
                                         OpenLoopCase{"diff_base", 0.005, {x, turn, x + turn}},
                                         OpenLoopCase{"kelo_base", 0.02, {x, y, turn, x + y + turn}, 0.6},
                                         OpenLoopCase{"kelo30", 0.01, {x, y, turn, x + y + turn}, 0.6},
                                         OpenLoopCase{"kelo_two_base", 0.02, {x, y, turn}, 0.6},
                                         OpenLoopCase{"skid_base", 0.005, {x}},
                                         OpenLoopCase{"tricycle_base", 0.005, {x}, 0.3},
                                         OpenLoopCase{"car_base", 0.005, {x}, 0.3},
                                         OpenLoopCase{"swerve_base", 0.005, {x}},
                                         OpenLoopCase{"mecanum_arm_base", 0.005, {x, y, turn}}));

// `zwang robot init` drafts robot files from the URDFs of real robots. With its open places filled, each
// draft is a robot that can be simulated.
TEST(RealRobots, AreSimulatedAsTheyAreDrafted) {
  const fs::path real = ZWANG_SOURCE_DIR "/../shared/robots";
  if (!fs::is_directory(real)) GTEST_SKIP() << real << " is not here";
  for (const char* name :
       {"turtlebot3_burger", "diffbot", "mir100", "panther", "panther_mecanum", "robile_4wheel"}) {
    SCOPED_TRACE(name);
    const zwang::test::TemporaryFolder temporary;
    fs::copy_file(real / (std::string(name) + ".urdf"), temporary.path() / "robot.urdf");
    lang::Diagnostics diagnostics;
    const auto draft = lang::draft_robot(temporary.path() / "robot.urdf", "robot.urdf", diagnostics);
    ASSERT_TRUE(draft);
    std::string text = draft->text;
    for (const auto& [open, value] : {std::pair{"kind: FILL_IN", "kind: skid"},
                                      {"effort: FILL_IN", "effort: 5 N m"},
                                      {"deceleration: FILL_IN", "deceleration: 1 m/s^2"},
                                      {"force: FILL_IN", "force: 50 N"},
                                      {"FILL_IN", "[[0.3 m, 0.2 m], [-0.3 m, 0.2 m], [0 m, -0.2 m]]"}}) {
      text = std::regex_replace(text, std::regex(open), value);
    }
    std::ofstream(temporary.path() / "robot.yaml") << text;
    EXPECT_NO_THROW(MujocoPlant(load(temporary.path() / "robot.yaml"), lang::Scene{}));
  }
}

// A skidding base turns if the moment of the wheels' push about its middle exceeds that of the floor. The
// floor's moment is the sum of mu N times the distance ahead or behind. Here 50 kg stand on four equal wheels
// 0.256 m ahead and behind: mu m g 0.256 m.
TEST(Skidding, TheFloorHoldsABaseBackFromTurning) {
  const lang::Robot robot = load(robots / "skid_base.yaml");
  lang::Scene scene;
  scene.floor_friction = 0.3;
  const double breakaway = 0.3 * robot.model.total_mass() * 9.81 * 0.256;
  const auto turned = [&](double moment) {
    MujocoPlant plant(robot, scene, {.period = period});
    Eigen::VectorXd tau(4);
    const double torque = moment / (4.0 * 0.2854) * 0.1651;  // front left, front right, rear left, rear right
    tau << -torque, torque, -torque, torque;
    for (int i = 0; i < 500; ++i) EXPECT_EQ(plant.apply(tau), PlantStatus::ok);
    return plant.truth();
  };
  EXPECT_LT(std::abs(turned(0.9 * breakaway).yaw), 1e-3);
  // Past it, what exceeds the friction accelerates the base and its wheels and rotors. Not far past it: the
  // same floor lets the wheels spin at 0.2854 m / 0.256 m = 1.115 of it.
  const double excess = 0.08;
  const Truth moving = turned((1.0 + excess) * breakaway);
  const solver::BaseAnalysis base = solver::analyse_base(robot.model, lang::start_state(robot));
  const double expected = excess * breakaway / base.axes[2].effective_mass * 0.5;
  EXPECT_NEAR(moving.velocity.z(), expected, 0.1 * expected);
}

// Level ground and no torque: whatever the drive, the base stays.
TEST(Drives, StandStillWithoutTorque) {
  for (const char* name : {"omni_base", "diff_base", "kelo_base", "kelo_two_base", "skid_base",
                           "tricycle_base", "car_base", "swerve_base"}) {
    const lang::Robot robot = load(robots / (std::string(name) + ".yaml"));
    MujocoPlant plant(robot, lang::Scene{}, {.period = period});
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(robot.model.joint_count());
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(plant.apply(zero), PlantStatus::ok) << name;
    EXPECT_LT(std::hypot(plant.truth().x, plant.truth().y), 1e-4) << name;
    EXPECT_LT(std::abs(plant.truth().yaw), 1e-4) << name;
  }
}

}  // namespace
}  // namespace zwang::runtime
