// Bases that tip over: the plant says so, the floor holds them, and statics says beforehand when.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "../temporary_folder.hpp"
#include "plant_robots.hpp"
#include "zwang/lang/footing.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

using namespace testing;

BaseDesign tall(double ahead, double height) {
  BaseDesign design;
  design.body_com = {ahead, 0.0, height};
  return design;
}

lang::Robot low_bumper(lang::Robot robot) {
  robot.bumper_height = 0.08;
  return robot;
}

// Its mass is ahead of its front wheels, at 0.26 m, and behind its bumper, at 0.40 m.
TEST(Fall, ABaseThatIsTopHeavyLiesOnTheFloor) {
  MujocoPlant plant(low_bumper(mecanum_base(tall(0.34, 0.1))), {});
  EXPECT_TRUE(plant.truth().base.fallen) << "it fell while it settled";
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(4);
  for (int i = 0; i < 2000; ++i) ASSERT_EQ(plant.apply(rest), PlantStatus::ok);
  Sensed sensed(mecanum_base().model);
  ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
  EXPECT_GT(sensed.state.base_pose.position.z(), -0.05) << "and not through it";
  EXPECT_GT(plant.truth().base.pitch, 0.1) << "on its nose";
  EXPECT_LT(plant.truth().base.pitch, 0.6);
}

TEST(Fall, NoneOfABaseThatStands) {
  for (const lang::Robot& robot : {mecanum_base(), omni_base(), differential_base()}) {
    MujocoPlant plant(robot, {});
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(robot.model.joint_count());
    for (int i = 0; i < 200; ++i) ASSERT_EQ(plant.apply(rest), PlantStatus::ok);
    EXPECT_FALSE(plant.truth().base.fallen);
    EXPECT_LT(std::hypot(plant.truth().base.roll, plant.truth().base.pitch), 0.01);
  }
}

// The floor carries what starts: without torque nothing moves, not even by what a step of MuJoCo rounds off.
TEST(Fall, ABaseStartsWhereTheFloorCarriesIt) {
  for (const lang::Robot& robot : {mecanum_base(), omni_base(), differential_base()}) {
    MujocoPlant plant(robot, {});
    Sensed first(robot.model), later(robot.model);
    ASSERT_EQ(plant.sense(first), PlantStatus::ok);
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(robot.model.joint_count());
    for (int i = 0; i < 200; ++i) ASSERT_EQ(plant.apply(rest), PlantStatus::ok);
    ASSERT_EQ(plant.sense(later), PlantStatus::ok);
    EXPECT_LT((later.state.base_pose.position - first.state.base_pose.position).norm(), 1e-10);
    EXPECT_LT((later.state.base_pose.rotation - first.state.base_pose.rotation).norm(), 1e-10);
  }
}

// The ball is drawn 0.25 m behind its link, which lies at the base's origin; the mass is 0.1 m behind the
// axle.
TEST(Fall, NoneOfABaseOnABallThatIsDrawnBesideItsLink) {
  const zwang::test::TemporaryFolder folder;
  std::ofstream urdf(folder.path() / "ball.urdf");
  const auto inertial = [](const char* at, const char* mass, const char* moment) {
    return std::string("<inertial><origin xyz='") + at + "'/><mass value='" + mass + "'/><inertia ixx='" +
           moment + "' iyy='" + moment + "' izz='" + moment + "' ixy='0' ixz='0' iyz='0'/></inertial>";
  };
  urdf << "<robot name='r'><link name='base_link'>" << inertial("-0.1 0 0", "20", "0.5") << "</link>";
  for (const auto& [name, y] : {std::pair("left", "0.2"), {"right", "-0.2"}})
    urdf << "<link name='" << name << "_link'>" << inertial("0 0 0", "1", "0.004") << "</link><joint name='"
         << name << "' type='continuous'><parent link='base_link'/><child link='" << name
         << "_link'/><origin xyz='0 " << y
         << " -0.1'/><axis xyz='0 1 0'/><limit effort='5' velocity='9'/></joint>";
  urdf << "<link name='ball'><collision><origin xyz='-0.25 0 -0.15'/><geometry><sphere "
          "radius='0.05'/></geometry>"
          "</collision></link><joint name='b' type='fixed'><parent link='base_link'/><child "
          "link='ball'/></joint>"
          "</robot>";
  urdf.close();
  std::ofstream(folder.path() / "ball.yaml")
      << "zwang_robot: 1\nurdf: ball.urdf\nbase: base_link\nsupports: [ball]\n"
         "wheels: [{joint: left, radius: 0.1 m}, {joint: right, radius: 0.1 m}]\nactuated: {left: {}, right: "
         "{}}\n"
         "stop: {deceleration: 1 m/s^2, force: 30 N}\n"
         "footprint: {polygon: [[0.3 m, 0.2 m], [-0.3 m, 0.2 m], [-0.3 m, -0.2 m], [0.3 m, -0.2 m]]}\n";
  lang::Diagnostics diagnostics;
  const auto robot = lang::load_robot(folder.path() / "ball.yaml", diagnostics);
  ASSERT_TRUE(robot);
  MujocoPlant plant(*robot, {});
  for (int i = 0; i < 500; ++i) ASSERT_EQ(plant.apply(Eigen::VectorXd::Zero(2)), PlantStatus::ok);
  EXPECT_FALSE(plant.truth().base.fallen);
  EXPECT_LT(std::abs(plant.truth().base.pitch), 0.01);
}

// Sped up along x for 1 s: at 0.85 of the limit of statics it stays down, at 1.2 it goes over backwards.
TEST(Fall, TheLimitOfStaticsIsThePlants) {
  const lang::Robot robot = low_bumper(mecanum_base(tall(0.0, 0.9)));
  const auto footing = lang::footing_of(robot);
  ASSERT_TRUE(footing);
  const double limit = footing->tipping_acceleration(Vector3::UnitX());
  ASSERT_LT(limit, 0.7 * 9.81) << "below what the floor holds";
  for (const double share : {0.85, 1.2}) {
    MujocoPlant plant(robot, {});
    const PlanarReference reference(robot.model);
    bool fell = false;
    for (int i = 0; i < 1000 && !fell; ++i) {
      ASSERT_EQ(plant.apply(reference.torque({share * limit, 0.0, 0.0}, plant.truth().velocity)),
                PlantStatus::ok);
      fell = plant.truth().base.fallen.has_value();
    }
    EXPECT_EQ(fell, share > 1.0) << share << " of " << limit << " m/s^2, pitch " << plant.truth().base.pitch;
    if (fell) {
      EXPECT_LT(plant.truth().base.pitch, 0.0) << "backwards";
    }
  }
}

lang::Program alignment_of_omni_base() {
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  options.robot = ZWANG_SOURCE_DIR "/specs/robots/omni_base.yaml";
  return lang::load(ZWANG_SOURCE_DIR "/specs/wall_align.yaml", options, diagnostics).value();
}

// A run that ends 20 ms after its mass went 15 cm ahead: it leans by less than a degree then, and falls.
TEST(Fall, ABaseThatTipsAsTheRunEndsHasFallen) {
  for (const double ahead : {0.0, 0.15}) {
    lang::Fault shift{};
    shift.kind = lang::FaultKind::centre_of_mass;
    shift.value = ahead;
    ScenePlantOptions options;
    options.faults = {shift};
    options.faults[0].at = 0.05;
    const lang::Program program = alignment_of_omni_base();
    ScenePlant plant(program, options);
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(program.robot.model.joint_count());
    while (plant.truth().time < 0.0695) ASSERT_EQ(plant.apply(rest), PlantStatus::ok);
    EXPECT_FALSE(plant.truth().base.fallen);
    EXPECT_LT(plant.truth().base.pitch, std::numbers::pi / 180.0);
    plant.end_lean();
    EXPECT_EQ(plant.truth().base.fallen.has_value(), ahead > 0.0);
  }
}

/// Of a differential base that is driven by 60 N on this floor: `slip` of the truth, and by hand.
std::pair<double, double> slip_on(double friction) {
  lang::Scene scene;
  scene.floor_friction = friction;
  const lang::Robot robot = differential_base();
  MujocoPlant plant(robot, scene);
  const PlanarReference reference(robot.model);
  Sensed sensed(robot.model);
  for (int i = 0; i < 1000; ++i)
    EXPECT_EQ(plant.apply(reference.torque_of_wrench({60.0, 0.0, 0.0})), PlantStatus::ok);
  EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
  const solver::Wheel& wheel = robot.model.wheels().front();
  const double rim = wheel.radius * sensed.state.qd(wheel.body - 1);
  return {plant.truth().base.slip, 0.9 * std::abs(rim) - plant.truth().velocity.x()};
}

TEST(FloorSlip, IsTheRimsSpeedLessTheBases) {
  const auto [told, by_hand] = slip_on(0.02);
  EXPECT_GT(by_hand, 0.1);
  EXPECT_NEAR(told, by_hand, 0.1 * by_hand);  // low-passed with 50 ms
  EXPECT_LT(slip_on(0.9).first, told_slip);
}

}  // namespace
}  // namespace zwang::runtime
