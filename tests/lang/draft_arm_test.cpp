// Bases with arms, and with wheels on rockers, that are drafted from a URDF: how they start and what is said
// of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>

#include "support.hpp"
#include "urdf_text.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/lang/task_draft.hpp"

namespace zwang::lang {
namespace {

using test::JointShape;
using test::LinkShape;
using test::UrdfText;

void add_driven_wheel(UrdfText& urdf, const std::string& name, const std::string& parent,
                      const std::array<double, 3>& at) {
  urdf.add(LinkShape{
      name, 1.0, {}, {2e-3, 3e-3, 2e-3}, urdf.cylinder(0.08, 0.04, {std::numbers::pi / 2.0, 0.0, 0.0})});
  urdf.add(JointShape{
      name + "_joint", "continuous", parent, name, at, {}, {0, 1, 0}, "effort='8' velocity='9'", ""});
}

/// A base of 20 kg on two wheels, and 1 kg on a joint about y that is 0.3 m long and stands up at 0.
std::string with_shoulder(double lower, double upper, double effort) {
  UrdfText urdf(7, 1.0);
  urdf.add(LinkShape{"base_link", 20.0, {}, {0.3, 0.5, 0.6}, urdf.box(0.6, 0.4, 0.1)});
  add_driven_wheel(urdf, "left_wheel", "base_link", {0.0, 0.2, 0.0});
  add_driven_wheel(urdf, "right_wheel", "base_link", {0.0, -0.2, 0.0});
  urdf.add(LinkShape{"upper_arm", 1.0, {0.0, 0.0, 0.3}, {1e-3, 1e-3, 1e-3}, ""});
  const std::string limit = "lower='" + UrdfText::number(lower) + "' upper='" + UrdfText::number(upper) +
                            "' effort='" + UrdfText::number(effort) + "' velocity='2'";
  urdf.add(JointShape{
      "shoulder", "revolute", "base_link", "upper_arm", {0.1, 0.0, 0.1}, {}, {0, 1, 0}, limit, ""});
  return urdf.robot("r");
}

struct Drafted {
  std::string text, said;
  std::optional<Robot> robot;
};

Drafted drafted_from(const std::string& urdf, const std::string& extra = "") {
  const test::Folder folder;
  Diagnostics diagnostics;
  const auto draft = draft_robot(folder.write("r.urdf", urdf), "r.urdf", diagnostics);
  EXPECT_TRUE(draft) << test::rendered(diagnostics);
  Drafted drafted{draft->text + extra, "", {}};
  drafted.robot = load_robot(folder.write("r.yaml", drafted.text), diagnostics);
  drafted.said = test::rendered(diagnostics);
  return drafted;
}

double start_of(const Drafted& drafted, const char* joint) {
  EXPECT_TRUE(drafted.robot) << drafted.said;
  return drafted.robot ? drafted.robot->posture(*drafted.robot->model.find_joint(joint)) : -1e9;
}

// Travel that does not hold 0: the joint starts as far inside as the guard wants it.
TEST(DraftOfAnArm, keeps_away_from_the_end_of_its_travel) {
  constexpr double lower = 0.0087, upper = 1.56;
  const Drafted above = drafted_from(with_shoulder(lower, upper, 10.0)),
                below = drafted_from(with_shoulder(-upper, -lower, 10.0));
  const double least = 0.05 * (upper - lower), most = 0.1 * (upper - lower);
  EXPECT_GE(start_of(above, "shoulder"), lower + least);
  EXPECT_LE(start_of(above, "shoulder"), lower + most);
  EXPECT_NEAR(start_of(below, "shoulder"), -start_of(above, "shoulder"), 1e-9);
  EXPECT_EQ(above.said + below.said, "");
}

// At an end it rests, as a gripper that is closed; near to it the guard would stop it.
TEST(DraftOfAnArm, stands_still_at_the_end_where_0_is_the_end) {
  const std::string urdf = with_shoulder(0.0, 1.5, 10.0);
  const Drafted resting = drafted_from(urdf);
  EXPECT_EQ(resting.text.find("posture"), std::string::npos) << resting.text;
  EXPECT_EQ(resting.said, "");
  EXPECT_EQ(start_of(resting, "shoulder"), 0.0);
  const Drafted near = drafted_from(urdf, "posture: {shoulder: 1 deg}\n");
  EXPECT_NE(near.said.find("W809: joint `shoulder` starts 1 deg from an end of its travel, 0 deg"),
            std::string::npos)
      << near.said;
  EXPECT_EQ(drafted_from(urdf, "posture: {shoulder: 5 deg}\n").said, "");
}

// 1 kg at 0.3 m, leaned over by 30 deg: 9.81 x 0.3 x sin 30 deg = 1.47 N m.
TEST(DraftOfAnArm, tells_of_a_motor_that_cannot_hold_it) {
  const std::string leaned = "posture: {shoulder: 30 deg}\n";
  const std::string said = drafted_from(with_shoulder(-1.0, 1.0, 1.4), leaned).said;
  EXPECT_NE(said.find("W874: the motor of `shoulder` cannot hold what hangs on it: that is 1.47 N m at the "
                      "start, and the motor has 1.4 N m"),
            std::string::npos)
      << said;
  EXPECT_EQ(drafted_from(with_shoulder(-1.0, 1.0, 1.5), leaned).said, "");
}

// Wheels that slide sideways, on rockers that are turned by pi, rounded to four digits. The rounding leaves a
// small part of their direction sideways. This part is no grip that a stop could keep to.
TEST(DraftOfABase, on_turned_rockers_is_told_of_no_grip_that_rounding_leaves) {
  UrdfText urdf(4, 1.0);
  urdf.add(LinkShape{"base_link", 10.0, {}, {0.2, 0.3, 0.4}, urdf.box(0.4, 0.3, 0.1)});
  for (const auto& [side, y] : {std::pair("left", 0.2), {"right", -0.2}}) {
    const std::string rocker = std::string(side) + "_rocker";
    urdf.add(LinkShape{rocker, 1.0, {}, {1e-2, 1e-2, 1e-2}, ""});
    urdf.add(JointShape{rocker + "_joint",
                        "fixed",
                        "base_link",
                        rocker,
                        {0.0, y, 0.0},
                        {std::numbers::pi, 0.0, std::numbers::pi},
                        {},
                        "",
                        ""});
    add_driven_wheel(urdf, std::string("front_") + side + "_wheel", rocker, {-0.15, 0.0, 0.0});
    add_driven_wheel(urdf, std::string("rear_") + side + "_wheel", rocker, {0.15, 0.0, 0.0});
  }
  const test::Folder folder;
  Diagnostics diagnostics;
  const auto draft = draft_robot(folder.write("r.urdf", urdf.robot("r")), "r.urdf", diagnostics);
  ASSERT_TRUE(draft) << test::rendered(diagnostics);
  const std::string text = std::regex_replace(draft->text, std::regex("kind: FILL_IN"), "kind: skid");
  folder.write("robot.yaml", text);
  const auto specs = test::source_dir / "specs";
  const TaskTexts shipped{test::slurp(specs / "feel_wall.yaml"), test::slurp(specs / "scenes/corridor.yaml")};
  const TaskTexts texts = draft_task("feel_wall", shipped, base_fit(*draft), "robot.yaml", "scene.yaml");
  folder.write("scene.yaml", texts.scene);
  EXPECT_TRUE(load(folder.write("task.yaml", texts.task), {}, diagnostics)) << test::rendered(diagnostics);
  EXPECT_EQ(test::rendered(diagnostics).find("W642"), std::string::npos) << test::rendered(diagnostics);
}

/// 5 kg on a slide that goes up by 0.5 m.
std::string with_lift(double effort) {
  UrdfText urdf(7, 1.0);
  urdf.add(LinkShape{"base_link", 20.0, {}, {0.3, 0.5, 0.6}, urdf.box(0.6, 0.4, 0.1)});
  add_driven_wheel(urdf, "left_wheel", "base_link", {0.0, 0.2, 0.0});
  add_driven_wheel(urdf, "right_wheel", "base_link", {0.0, -0.2, 0.0});
  urdf.add(LinkShape{"carriage", 5.0, {0.0, 0.0, 0.1}, {1e-2, 1e-2, 1e-2}, ""});
  const std::string limit = "lower='0' upper='0.5' effort='" + UrdfText::number(effort) + "' velocity='1'";
  urdf.add(
      JointShape{"lift", "prismatic", "base_link", "carriage", {0.0, 0.0, 0.1}, {}, {0, 0, 1}, limit, ""});
  return urdf.robot("r");
}

// 5 kg weigh 49.05 N. A URDF whose motor makes 1 N means a screw that holds, or knows no better: the lift
// stays.
TEST(DraftOfAnArm, holds_a_lift_that_the_motor_of_the_urdf_does_not) {
  const test::Folder folder;
  Diagnostics diagnostics;
  const auto weak = draft_robot(folder.write("r.urdf", with_lift(1.0)), "r.urdf", diagnostics);
  ASSERT_TRUE(weak);
  EXPECT_NE(weak->text.find("fixed: [lift]"), std::string::npos) << weak->text;
  EXPECT_EQ(weak->text.find("  lift: {"), std::string::npos) << weak->text;
  const std::string told = "a motor that holds `lift`: it bears 49.1 N, the URDF's makes 1 N";
  EXPECT_TRUE(std::any_of(weak->missing.begin(), weak->missing.end(),
                          [&](const std::string& line) { return line.find(told) != std::string::npos; }));
  EXPECT_EQ(drafted_from(with_lift(1.0)).said, "");
  const auto strong = draft_robot(folder.write("s.urdf", with_lift(50.0)), "s.urdf", diagnostics);
  EXPECT_NE(strong->text.find("  lift: {}"), std::string::npos) << strong->text;
}

}  // namespace
}  // namespace zwang::lang
