// Wheels that a URDF draws above the ground: springs that give, rockers, drawings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "draft_of_habits.hpp"
#include "zwang/lang/open_places.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {
namespace {

using DroppedWheels = DraftOfHabits;

std::string raised_rear(const std::string& z) {
  return "<robot name='r'>" + chassis() + wheel_at("front_left_wheel", "chassis", ".2 .25 0") +
         wheel_at("front_right_wheel", "chassis", ".2 -.25 0") +
         wheel_at("rear_left_wheel", "chassis", "-.2 .25 " + z) +
         wheel_at("rear_right_wheel", "chassis", "-.2 -.25 " + z) + "</robot>";
}

std::string as_skid(std::string text) {
  const std::size_t at = text.find("kind: FILL_IN");
  return at == std::string::npos ? text : text.replace(at, 13, "kind: skid");
}

// The front ends at -80 mm, the rear at 20 - 80 mm. All stand on one level once the rear is 20 mm lower.
TEST_F(DroppedWheels, are_drafted_where_a_drawing_ends_them_above_the_others) {
  const auto draft = this->draft(folder_.write("raised.urdf", raised_rear(".02")));
  ASSERT_TRUE(draft);
  for (const char* joint : {"rear_left_wheel_joint", "rear_right_wheel_joint"})
    EXPECT_NE(draft->text.find(std::string(joint) + ", radius: 80 mm, drop: 20 mm}"), std::string::npos)
        << draft->text;
  EXPECT_EQ(draft->text.find("front_left_wheel_joint, radius: 80 mm, drop"), std::string::npos);
  const auto places = open_places(draft->text).to_check;
  EXPECT_EQ(
      std::count_if(places.begin(), places.end(),
                    [](const OpenPlace& place) { return place.entry.find("drop") != std::string::npos; }),
      2);
  Diagnostics diagnostics;
  const auto robot = load_robot(folder_.write("robot.yaml", as_skid(draft->text)), diagnostics);
  ASSERT_TRUE(robot) << test::rendered(diagnostics);
  for (const double end : wheel_level(robot->model).ends) EXPECT_NEAR(end, -0.08, 1e-9);
}

// 2 mm about the middle are levelled out: nobody has to decide.
TEST_F(DroppedWheels, are_none_within_what_is_levelled_out) {
  const auto draft = this->draft(folder_.write("level.urdf", raised_rear(".003")));
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->text.find("drop"), std::string::npos) << draft->text;
}

// A wheel that ends higher than it is large stands on nothing.
TEST_F(DroppedWheels, are_none_above_their_own_radius) {
  const auto draft = this->draft(folder_.write("high.urdf", raised_rear(".09")));
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->text.find("drop"), std::string::npos) << draft->text;
  const std::string said = said_of(as_skid(draft->text));
  EXPECT_NE(said.find("E810"), std::string::npos) << said;
  EXPECT_NE(said.find("`drop: 90 mm`"), std::string::npos) << said;
}

// Down is down, however the link that carries the wheel is turned: here by 0.6 rad about y.
TEST_F(DroppedWheels, go_down_below_a_tilted_rocker) {
  const std::string rocker =
      "<link name='rocker'>" + inertial_element("1", "ixx='.01' iyy='.01' izz='.01'") +
      "</link><joint name='rocker_joint' type='revolute'><parent link='chassis'/><child "
      "link='rocker'/><origin "
      "xyz='-.2 0 .02' rpy='0 .6 0'/><axis xyz='0 1 0'/><limit effort='0' velocity='1' lower='-.4' "
      "upper='.4'/></joint>";
  const std::string urdf = "<robot name='r'>" + chassis() +
                           wheel_at("front_left_wheel", "chassis", ".2 .25 0") +
                           wheel_at("front_right_wheel", "chassis", ".2 -.25 0") + rocker +
                           wheel_at("rear_left_wheel", "rocker", "0 .25 0") +
                           wheel_at("rear_right_wheel", "rocker", "0 -.25 0") + "</robot>";
  const auto draft = this->draft(folder_.write("rocker.urdf", urdf));
  ASSERT_TRUE(draft);
  Diagnostics diagnostics;
  const auto robot = load_robot(folder_.write("robot.yaml", as_skid(draft->text)), diagnostics);
  ASSERT_TRUE(robot) << test::rendered(diagnostics) << draft->text;
  int rear = 0;
  for (const solver::Wheel& wheel : robot->model.wheels()) {
    const solver::Vector3 at = pose_in_base(robot->model, wheel.body).position;
    if (at.x() > 0.0) continue;
    ++rear;
    EXPECT_NEAR(at.x(), -0.2, 1e-9);
    EXPECT_NEAR(at.z(), 0.0, 1e-9);
  }
  EXPECT_EQ(rear, 2);
}

/// Meshes tell no radius. Each wheel is of the file `mesh` + its number.
std::string meshes_at(const std::string& rear_z, bool is_one) {
  std::string text = raised_rear(rear_z);
  int number = 0;
  for (std::size_t at = 0;
       (at = text.find("<cylinder radius='.08' length='.04'/>", at)) != std::string::npos;) {
    const std::string file = is_one ? "wheel" : "wheel" + std::to_string(number++);
    text.replace(at, 37, "<mesh filename='" + file + ".stl'/>");
  }
  return std::regex_replace(text, std::regex("collision"), "visual");
}

// Wheels of one mesh are as large as each other: one radius is asked for, and their axles tell the drops.
TEST_F(DroppedWheels, of_one_mesh_have_one_radius) {
  const auto draft = this->draft(folder_.write("mesh.urdf", meshes_at(".03", true)));
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("each_wheel: {kind: FILL_IN, radius: FILL_IN}"), std::string::npos)
      << draft->text;
  EXPECT_NE(draft->text.find("{joint: front_left_wheel_joint}"), std::string::npos) << draft->text;
  EXPECT_NE(draft->text.find("{joint: rear_left_wheel_joint, drop: 30 mm}"), std::string::npos)
      << draft->text;
  const auto others = this->draft(folder_.write("meshes.urdf", meshes_at(".03", false)));
  EXPECT_NE(others->text.find("{joint: rear_left_wheel_joint, radius: FILL_IN}"), std::string::npos)
      << others->text;
}

// All that has to be written is said at once.
TEST_F(DroppedWheels, are_told_together) {
  std::string text = as_skid(this->draft(folder_.write("raised.urdf", raised_rear(".02")))->text);
  text = std::regex_replace(text, std::regex(", drop: 20 mm"), "");
  const std::string said = said_of(text);
  EXPECT_NE(said.find("`drop: 20 mm`: `rear_left_wheel_joint` 20 mm, `rear_right_wheel_joint` 20 mm"),
            std::string::npos)
      << said;
}

// A wheel that is drawn too low is raised by the others: each drop is a way down.
TEST_F(DroppedWheels, are_lengths_and_not_below_zero) {
  const auto draft = this->draft(folder_.write("raised.urdf", raised_rear(".02")));
  ASSERT_TRUE(draft);
  std::string text = as_skid(draft->text);
  text.replace(text.find("drop: 20 mm"), 11, "drop: -20 mm");
  EXPECT_NE(said_of(text).find("drop cannot be below 0"), std::string::npos) << said_of(text);
}

}  // namespace
}  // namespace zwang::lang
