// `each_wheel` and `inertias`: what a robot file says once for all wheels, and of bodies that the URDF lacks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang {
namespace {

Robot loaded(const test::Folder& folder, const std::string& urdf, const std::string& text) {
  folder.write("robot.urdf", test::slurp(test::source_dir / urdf));
  Diagnostics diagnostics;
  const auto robot = load_robot(folder.write("robot.yaml", text), diagnostics);
  EXPECT_TRUE(robot) << test::rendered(diagnostics);
  return *robot;
}

const std::string rest =
    "stop: {deceleration: 1 m/s^2, force: 50 N}\n"
    "footprint: {polygon: [[0.3 m, 0.2 m], [-0.3 m, 0.2 m], [-0.3 m, -0.2 m], [0.3 m, -0.2 m]]}\n";
const std::string mini = "zwang_robot: 1\nurdf: robot.urdf\nbase: base_link\n";

TEST(EachWheel, says_for_all_what_an_entry_says_for_one) {
  const test::Folder folder;
  const Robot robot =
      loaded(folder, "tests/conformance/robots/mini.urdf",
             mini +
                 "each_wheel: {radius: 80 mm, effort: 3 N m, gear: 10, rotor_inertia: 2 kg mm^2}\n"
                 "wheels: [{joint: left}, {joint: right, radius: 80.5 mm}]\nactuated: {left: {}, right: "
                 "{effort: 4 N m, gear: 5}}\n" +
                 rest);
  const auto& model = robot.model;
  EXPECT_DOUBLE_EQ(model.wheels()[0].radius, 0.08);
  EXPECT_DOUBLE_EQ(model.wheels()[1].radius, 0.0805);
  EXPECT_DOUBLE_EQ(model.joint(*model.find_joint("left")).max_effort, 3.0);
  EXPECT_DOUBLE_EQ(model.joint(*model.find_joint("right")).max_effort, 4.0);
  EXPECT_DOUBLE_EQ(model.joint(*model.find_joint("left")).rotor_inertia, 10 * 10 * 2e-6);
  EXPECT_DOUBLE_EQ(model.joint(*model.find_joint("right")).rotor_inertia, 5 * 5 * 2e-6);
}

// The shipped base states its rollers one by one.
TEST(EachWheel, of_kind_mecanum_has_the_rollers_of_the_shipped_base) {
  const test::Folder folder;
  Diagnostics diagnostics;
  const auto shipped = load_robot(test::source_dir / "specs/robots/mecanum_base.yaml", diagnostics);
  ASSERT_TRUE(shipped);
  const Robot robot =
      loaded(folder, "specs/robots/mecanum_base.urdf",
             mini +
                 "each_wheel: {kind: mecanum, radius: 75.9 mm}\nwheels:\n  - {joint: front_left_wheel}\n  - "
                 "{joint: front_right_wheel}\n  - {joint: rear_left_wheel}\n  - {joint: rear_right_wheel}\n"
                 "actuated: {front_left_wheel: {}, front_right_wheel: {}, rear_left_wheel: {}, "
                 "rear_right_wheel: {}}\n" +
                 rest);
  ASSERT_EQ(robot.model.wheels().size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_DOUBLE_EQ(*robot.model.wheels()[i].roller_angle, *shipped->model.wheels()[i].roller_angle) << i;
}

/// Wheels at the corners of a rectangle that is longer than it is wide, all turned about z by `angle`. Of
/// each second one the axle points to the other side.
std::string turned_rectangle(double angle) {
  std::string urdf =
      "<robot name='r'><link name='base_link'><inertial><mass value='20'/><inertia ixx='.5' iyy='.6' "
      "izz='.8' "
      "ixy='0' ixz='0' iyz='0'/></inertial></link>";
  const double c = std::cos(angle), s = std::sin(angle);
  int number = 0;
  for (const double x : {0.3, -0.3}) {
    for (const double y : {0.2, -0.2}) {
      const std::string name = "wheel_" + std::to_string(number);
      const double side = number % 2 == 0 ? 1.0 : -1.0;
      urdf +=
          "<link name='" + name +
          "'><inertial><mass value='1'/><inertia ixx='.003' iyy='.003' izz='.003' ixy='0' ixz='0' iyz='0'/>"
          "</inertial></link><joint name='" +
          name + "_joint' type='continuous'><parent link='base_link'/><child link='" + name +
          "'/><origin xyz='" + std::to_string(c * x - s * y) + " " + std::to_string(s * x + c * y) +
          " -.1'/><axis xyz='" + std::to_string(-side * s) + " " + std::to_string(side * c) +
          " 0'/><limit effort='5' velocity='10'/></joint>";
      ++number;
    }
  }
  return urdf + "</robot>";
}

// The rolling direction decides which wheels lie on a diagonal. A base that looks along y has the same
// rollers as one that looks along x.
TEST(EachWheel, of_kind_mecanum_has_the_same_rollers_whichever_way_the_base_looks) {
  const test::Folder folder;
  const std::string text =
      mini +
      "each_wheel: {kind: mecanum, radius: 80 mm}\nwheels: [{joint: wheel_0_joint}, {joint: wheel_1_joint}, "
      "{joint: wheel_2_joint}, {joint: wheel_3_joint}]\nactuated: {wheel_0_joint: {}, wheel_1_joint: {}, "
      "wheel_2_joint: {}, wheel_3_joint: {}}\n" +
      rest;
  const double eighth = std::numbers::pi / 4.0;
  for (int turn = 0; turn < 8; ++turn) {
    folder.write("robot.urdf", turned_rectangle(turn * eighth));
    Diagnostics diagnostics;
    const auto robot = load_robot(folder.write("robot.yaml", text), diagnostics);
    ASSERT_TRUE(robot) << test::rendered(diagnostics);
    EXPECT_EQ(test::count(diagnostics, "W868"), 0) << test::rendered(diagnostics);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_DOUBLE_EQ(*robot->model.wheels()[i].roller_angle, (i == 0 || i == 3 ? 1.0 : -1.0) * eighth)
          << turn << " eighths, wheel " << i;
  }
}

TEST(EachWheel, of_kind_skid_slides_sideways) {
  const test::Folder folder;
  const Robot robot =
      loaded(folder, "tests/conformance/robots/mini.urdf",
             mini +
                 "each_wheel: {kind: skid, radius: 0.1 m}\nwheels: [{joint: left}, {joint: right, "
                 "holds: [rolling, sideways]}]\nactuated: {left: {}, right: {}}\n" +
                 rest);
  EXPECT_FALSE(robot.model.wheels()[0].holds_sideways);
  EXPECT_TRUE(robot.model.wheels()[1].holds_sideways) << "its own entry says so";
}

// A solid cylinder of 3 kg and 0.1 m: m r^2 / 2 about its axis. The base as a ball of 20 kg and 0.3 m: 2 m
// r^2 / 5.
TEST(Inertias, are_those_of_a_disc_and_a_ball) {
  const test::Folder folder;
  const Robot robot =
      loaded(folder, "tests/conformance/robots/mini.urdf",
             mini +
                 "wheels: [{joint: left, radius: 0.1 m}, {joint: right, radius: 0.1 m}]\nactuated: "
                 "{left: {}, right: {}}\ninertias: {left_link: {mass: 3 kg}, base_link: {radius: 0.3 m}}\n" +
                 rest);
  const auto& model = robot.model;
  const auto body_of = [&](const char* joint) {
    return model.bodies()[static_cast<std::size_t>(*model.find_joint(joint)) + 1];
  };
  const solver::Body left = body_of("left"), right = body_of("right");
  EXPECT_DOUBLE_EQ(left.inertia.mass, 3.0);
  EXPECT_NEAR(left.joint.axis.dot(left.inertia.rotational * left.joint.axis), 0.5 * 3.0 * 0.01, 1e-12);
  EXPECT_DOUBLE_EQ(right.inertia.mass, 1.0) << "the URDF's";
  EXPECT_NEAR(model.bodies()[0].inertia.rotational_at_com()(2, 2), 0.4 * 20.0 * 0.09, 1e-9);
  EXPECT_NEAR(model.bodies()[0].inertia.first_moment.z(), 20.0 * 0.1, 1e-12) << "its centre of mass stays";
}

}  // namespace
}  // namespace zwang::lang
