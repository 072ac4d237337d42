// A rover on six wheels, four of them steered, from its URDF to a wall in the simulated plant.
#include <cmath>
#include <numbers>
#include <regex>

#include "cli_plan_fixture.hpp"

namespace zwang {
namespace {

using namespace test;

constexpr double wheel_radius = 0.08;  // [m]

std::string body_element(double mass, double moment) {
  const std::string m = std::to_string(moment);
  return "<inertial><mass value='" + std::to_string(mass) + "'/><inertia ixx='" + m + "' iyy='" + m +
         "' izz='" + m + "' ixy='0' ixz='0' iyz='0'/></inertial>";
}

std::string joint_element(const std::string& child, const std::string& parent, const std::string& kind,
                          const std::string& xyz, const std::string& axis) {
  return "<joint name='" + child + "_joint' type='" + kind + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin xyz='" + xyz + "'/><axis xyz='" + axis +
         "'/><limit lower='-0.6' upper='0.6' effort='2' velocity='6'/></joint>";
}

/// Of 0.6 kg and 80 mm.
std::string wheel_element(const std::string& name, const std::string& parent, const std::string& xyz) {
  return "<link name='" + name + "'>" + body_element(0.6, 0.0019) +
         "<collision><origin rpy='1.5707963 0 0'/><geometry><cylinder radius='0.08' "
         "length='0.06'/></geometry>"
         "</collision></link>" +
         joint_element(name, parent, "continuous", xyz, "0 1 0");
}

/// A body of 8 kg. On each side a rocker carries the rear wheel and a bogie, which carries the middle and the
/// front wheel. Front and rear wheels hang below steerings. The sides' linkage is not drawn, as in many
/// files.
std::string rover() {
  std::string urdf = "<robot name='rover'><link name='body'>" + body_element(8.0, 0.2) +
                     "<collision><geometry><box size='0.5 0.3 0.12'/></geometry></collision></link>";
  for (const std::string side : {"left", "right"}) {
    const std::string y = side == "left" ? "0.2" : "-0.2", out = side == "left" ? "0.05" : "-0.05";
    const auto link = [&](const std::string& name, double mass, const std::string& parent,
                          const std::string& kind, const std::string& xyz, const std::string& axis) {
      urdf += "<link name='" + side + "_" + name + "'>" + body_element(mass, 0.004) + "</link>" +
              joint_element(side + "_" + name, parent, kind, xyz, axis);
    };
    link("rocker", 0.5, "body", "revolute", "0 " + y + " 0", "0 1 0");
    link("bogie", 0.4, side + "_rocker", "revolute", "0.12 0 -0.05", "0 1 0");
    link("front_steering", 0.3, side + "_bogie", "revolute", "0.14 0 0.05", "0 0 1");
    link("rear_steering", 0.3, side + "_rocker", "revolute", "-0.26 0 0", "0 0 1");
    urdf += wheel_element(side + "_front_wheel", side + "_front_steering", "0 " + out + " -0.15") +
            wheel_element(side + "_middle_wheel", side + "_bogie", "-0.12 " + out + " -0.1") +
            wheel_element(side + "_rear_wheel", side + "_rear_steering", "0 " + out + " -0.15");
  }
  return urdf + "</robot>";
}

using CliRover = CliPlan;

// The wall stands 5 cm ahead of the outline. The rover creeps there at 1 cm/s and stays. It bounces back with
// 1 cm/s at most, which the row takes away within its time constant of 0.5 s: 5 mm.
TEST_F(CliRover, SteeredOnFourOfSixWheelsFeelsAWall) {
  write("rover.urdf", rover());
  const Result made = zwang("robot init rover.urdf --task feel_wall -o rover.yaml");
  ASSERT_EQ(made.code, 0) << made.out;
  const std::string text = read(folder_ / "rover.yaml");
  EXPECT_EQ(text.find("FILL_IN"), std::string::npos) << text;
  for (const char* held :
       {"left_rocker_joint", "right_rocker_joint", "left_bogie_joint", "right_bogie_joint"})
    EXPECT_TRUE(std::regex_search(text, std::regex(std::string("\nfixed: .*") + held))) << held << text;
  const json inspected = zwang_json("robot inspect rover.yaml");
  EXPECT_EQ(inspected.at("wheels").size(), 6U);
  EXPECT_NEAR(inspected.at("mass").get<double>(), 8.0 + 2.0 * (0.5 + 0.4 + 2 * 0.3 + 3 * 0.6), 1e-6);
  EXPECT_NEAR(inspected.at("analysis").at("axes").at("x").at("largest_force").at(0).get<double>(),
              6.0 * 2.0 / wheel_radius, 1.0);
  const json report = zwang_json("run --quiet rover_feel_wall.yaml");
  EXPECT_EQ(report.at("outcome"), "done");
  const json& base = report.at("truth").at("base");
  EXPECT_NEAR(base.at("x").get<double>(), 0.05, 5e-3);
  EXPECT_NEAR(base.at("yaw").get<double>(), 0.0, 0.1 * std::numbers::pi / 180.0);
  EXPECT_NEAR(base.at("y").get<double>(), 0.0, 1e-3);
}

// Six axles of which four steer hold the heading: no wall turns it, and nothing is written but the robot
// file.
TEST_F(CliRover, SteeredOnFourOfSixWheelsIsRefusedTheAlignment) {
  write("rover.urdf", rover());
  const Result refused = zwang("robot init rover.urdf --task wall_align -o rover.yaml");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.out.find("E621"), std::string::npos) << refused.out;
}

}  // namespace
}  // namespace zwang
