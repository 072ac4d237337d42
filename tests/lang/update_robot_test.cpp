// `robot init --update`: what the owner wrote stays, what is new in the URDF comes, what is gone is told.
#include <gtest/gtest.h>

#include <algorithm>

#include "support.hpp"
#include "zwang/lang/friction_update.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/lang/robot_update.hpp"

namespace zwang::lang {
namespace {

constexpr const char* inertial =
    "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' "
    "iyz='0'/></inertial>";

std::string wheel(const std::string& name, const std::string& at, double radius,
                  const std::string& limit = "") {
  return "<link name='" + name + "_link'>" + inertial + "<collision><geometry><cylinder radius='" +
         std::to_string(radius) + "' length='0.05'/></geometry></collision></link><joint name='" + name +
         "' type='continuous'><parent link='base_link'/><child link='" + name + "_link'/><origin xyz='" + at +
         "' rpy='0 0 0'/><axis xyz='0 1 0'/>" + limit + "</joint>";
}

std::string robot(const std::string& parts) {
  return "<robot name='two'><link name='base_link'>" + std::string(inertial) + "</link>" + parts + "</robot>";
}

const std::string two_wheels = wheel("left_wheel", "0 0.2 0", 0.1) + wheel("right_wheel", "0 -0.2 0", 0.1);

class UpdateRobot : public testing::Test {
 protected:
  std::string drafted(const std::string& urdf) {
    Diagnostics diagnostics;
    return draft_robot(folder_.write("two.urdf", urdf), "two.urdf", diagnostics)->text;
  }
  RobotUpdate updated(const std::string& file, const std::string& urdf) {
    Diagnostics diagnostics;
    const auto robot_file = folder_.write("two.yaml", file), urdf_file = folder_.write("two.urdf", urdf);
    const auto draft = draft_robot(urdf_file, "two.urdf", diagnostics, *options_of(robot_file, diagnostics));
    auto update = update_robot_file(robot_file, urdf_file, *draft, diagnostics);
    EXPECT_TRUE(update) << test::rendered(diagnostics);
    return *update;
  }
  /// Every line of `before` is in `after`, in its order.
  static bool keeps(const std::string& before, const std::string& after) {
    std::istringstream kept(before), all(after);
    std::string line, other;
    while (std::getline(kept, line)) {
      do {
        if (!std::getline(all, other)) return false;
      } while (other != line);
    }
    return true;
  }
  static std::string line_of(const std::string& text, int number) {
    std::istringstream lines(text);
    std::string line;
    for (int i = 0; i < number; ++i) std::getline(lines, line);
    return line;
  }

  test::Folder folder_;
};

TEST_F(UpdateRobot, of_the_same_urdf_changes_nothing) {
  const std::string draft = drafted(robot(two_wheels));
  const RobotUpdate update = updated(draft, robot(two_wheels));
  EXPECT_EQ(update.text, draft);
  EXPECT_TRUE(update.added.empty() && update.vanished.empty() && update.differ.empty());
}

TEST_F(UpdateRobot, keeps_every_line_and_adds_a_new_joint_with_its_line) {
  std::string file = test::replaced(drafted(robot(two_wheels)), "left_wheel: {}",
                                    "left_wheel: {effort: 3 N m, gear: 20}  # measured on the bench");
  file += "\n# mine\nlimits: {velocity: {x: +-0.5 m/s}}\n";
  const std::string lift = "<link name='fork'>" + std::string(inertial) +
                           "</link><joint name='lift' type='prismatic'><parent link='base_link'/><child "
                           "link='fork'/><axis xyz='0 0 1'/>"
                           "<limit lower='0' upper='0.3' effort='200' velocity='0.1'/></joint>";
  const RobotUpdate update = updated(file, robot(two_wheels + lift));
  EXPECT_TRUE(keeps(file, update.text)) << update.text;
  ASSERT_EQ(update.added.size(), 1U) << update.text;
  EXPECT_EQ(line_of(update.text, update.added[0].line), "  lift: {}") << update.text;
  EXPECT_EQ(updated(update.text, robot(two_wheels + lift)).text, update.text) << "once more changes nothing";
}

TEST_F(UpdateRobot, tells_what_vanished_with_its_line_and_keeps_it) {
  const std::string file = drafted(robot(two_wheels));
  const RobotUpdate update =
      updated(file, robot(wheel("left_wheel", "0 0.2 0", 0.1) + wheel("wheel_right", "0 -0.2 0", 0.1)));
  EXPECT_TRUE(keeps(file, update.text)) << update.text;
  ASSERT_EQ(update.vanished.size(), 2U);
  for (const UpdateNote& note : update.vanished)
    EXPECT_NE(line_of(update.text, note.line).find("right_wheel"), std::string::npos)
        << note.line << update.text;
  ASSERT_EQ(update.added.size(), 2U);
  for (const UpdateNote& note : update.added)
    EXPECT_NE(line_of(update.text, note.line).find("wheel_right"), std::string::npos)
        << note.line << update.text;
}

TEST_F(UpdateRobot, leaves_out_what_a_comment_names) {
  const std::string draft = drafted(robot(two_wheels));
  const std::string file = test::replaced(draft, "  right_wheel: {}", "  # right_wheel: none");
  EXPECT_EQ(updated(file, robot(two_wheels)).text, file);
}

TEST_F(UpdateRobot, adds_to_lists_in_brackets) {
  const std::string ball =
      "<link name='ball_caster'/><joint name='ball_joint' type='fixed'><parent link='base_link'/><child "
      "link='ball_caster'/></joint>";
  const std::string second =
      "<link name='rear_caster'/><joint name='rear_joint' type='fixed'><parent link='base_link'/><child "
      "link='rear_caster'/></joint>";
  const std::string file = drafted(robot(two_wheels + ball));
  ASSERT_NE(file.find("supports: [ball_caster]"), std::string::npos) << file;
  EXPECT_NE(
      updated(file, robot(two_wheels + ball + second)).text.find("supports: [ball_caster, rear_caster]"),
      std::string::npos);
  const std::string without = drafted(robot(two_wheels));
  const RobotUpdate update = updated(without, robot(two_wheels + ball));
  ASSERT_EQ(update.added.size(), 1U);
  EXPECT_EQ(line_of(update.text, update.added[0].line), "supports: [ball_caster]") << update.text;
}

TEST_F(UpdateRobot, fills_what_the_urdf_says_now_and_tells_what_it_says_otherwise) {
  const std::string draft = drafted(robot(two_wheels));
  std::string file = test::replaced(draft, "right_wheel, radius: 100 mm", "right_wheel, radius: 98 mm");
  file = test::replaced(file, "left_wheel, radius: 100 mm", "left_wheel, radius: FILL_IN");
  const RobotUpdate update = updated(file, robot(two_wheels));
  EXPECT_EQ(update.text, test::replaced(draft, "right_wheel, radius: 100 mm", "right_wheel, radius: 98 mm"));
  ASSERT_EQ(update.differ.size(), 1U);
  EXPECT_EQ(update.differ[0].text, "radius of `right_wheel`: 98 mm here, 100 mm in the URDF");
  EXPECT_NE(line_of(update.text, update.differ[0].line).find("98 mm"), std::string::npos);
}

/// The shipped file with these frictions, read again.
std::optional<Robot> with_measured(const char* name, const std::vector<MeasuredFriction>& frictions,
                                   std::string& text) {
  const std::filesystem::path robots = test::source_dir / "specs/robots";
  const test::Folder folder;
  Diagnostics diagnostics;
  text = with_friction(robots / (std::string(name) + ".yaml"), frictions, diagnostics).value_or("");
  folder.write("mecanum_base.urdf", test::slurp(robots / "mecanum_base.urdf"));
  std::optional<Robot> robot = load_robot(folder.write("robot.yaml", text), diagnostics);
  EXPECT_TRUE(robot) << test::rendered(diagnostics) << text;
  return robot;
}

TEST(FrictionUpdate, keeps_what_is_not_measured) {
  std::string text;
  const auto measured = with_measured("mecanum_rough", {{"rear_left_wheel", 0.25, 0.03}}, text);
  ASSERT_TRUE(measured);
  const auto friction = [&](const char* joint) {
    return measured->friction.at(static_cast<std::size_t>(*measured->model.find_joint(joint)));
  };
  EXPECT_DOUBLE_EQ(friction("rear_left_wheel").coulomb, 0.25);
  EXPECT_DOUBLE_EQ(friction("rear_left_wheel").viscous, 0.03);
  EXPECT_DOUBLE_EQ(friction("rear_left_wheel").presliding, 0.2e-3);
  EXPECT_DOUBLE_EQ(friction("rear_left_wheel").compensate, 0.9);
  EXPECT_DOUBLE_EQ(friction("rear_right_wheel").coulomb, 0.1);
}

TEST(FrictionUpdate, adds_the_section_where_there_is_none) {
  std::string text;
  const auto measured = with_measured("mecanum_base", {{"rear_left_wheel", 0.25, 0.03}}, text);
  ASSERT_TRUE(measured);
  EXPECT_TRUE(text.starts_with(test::slurp(test::source_dir / "specs/robots/mecanum_base.yaml")));
  EXPECT_DOUBLE_EQ(
      measured->friction.at(static_cast<std::size_t>(*measured->model.find_joint("rear_left_wheel"))).coulomb,
      0.25);
}

/// A line cannot be put into braces, and a section would hide that of the file that it is based on.
TEST(FrictionUpdate, leaves_a_file_that_could_not_be_read_any_more) {
  const test::Folder folder;
  const auto refused = [&](const std::string& text) {
    Diagnostics diagnostics;
    EXPECT_FALSE(with_friction(folder.write("robot.yaml", text), {{"right_wheel", 0.25, 0.03}}, diagnostics));
    return test::count(diagnostics, "E816") == 1;
  };
  EXPECT_TRUE(refused("zwang_robot: 1\nfriction: {left_wheel: {coulomb: 0.1 N m}}\nname: two\n"));
  EXPECT_TRUE(refused("zwang_robot: 1\nfriction:\n    left_wheel: {coulomb: 0.1 N m}\n"));
  EXPECT_TRUE(refused("zwang_robot: 1\nbased_on: other.yaml\n"));
}

TEST_F(UpdateRobot, is_of_robot_files_alone) {
  Diagnostics diagnostics;
  EXPECT_FALSE(options_of(folder_.write("task.yaml", "zwang: 1\nrobot: two.yaml\n"), diagnostics));
  EXPECT_TRUE(diagnostics.has_errors());
}

}  // namespace
}  // namespace zwang::lang
