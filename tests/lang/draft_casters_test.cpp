// The parts of a URDF beside the driven wheels. They are casters of several links, small stiff wheels, wheels
// without motors, and marks that weigh next to nothing.
#include <gtest/gtest.h>

#include <algorithm>

#include "drafted.hpp"
#include "zwang/lang/open_places.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/lang/task_draft.hpp"

namespace zwang::lang {
namespace {

std::string beside_inertial(const std::string& mass, const std::string& moment) {
  return "<inertial><mass value='" + mass + "'/><inertia ixx='" + moment + "' iyy='" + moment + "' izz='" +
         moment + "' ixy='0' ixz='0' iyz='0'/></inertial>";
}

const std::string beside_chassis =
    "<link name='base_link'>" + beside_inertial("20", ".6") +
    "<collision><geometry><box size='.6 .4 .1'/></geometry></collision></link>";

/// A link `name` on `parent` at `xyz`, by `name`_joint; `more` stands in the joint.
std::string beside_part(const std::string& name, const std::string& parent, const std::string& xyz,
                        const std::string& type, const std::string& body, const std::string& more = "") {
  return "<link name='" + name + "'>" + body + "</link><joint name='" + name + "_joint' type='" + type +
         "'><parent link='" + parent + "'/><child link='" + name + "'/><origin xyz='" + xyz + "'/>" + more +
         "</joint>";
}

std::string beside_wheel(const std::string& name, const std::string& xyz, const std::string& radius = ".08",
                         const std::string& limit = "", const std::string& parent = "base_link") {
  return beside_part(name, parent, xyz, "continuous",
                     beside_inertial("1", ".003") +
                         "<collision><origin rpy='1.5707963 0 0'/><geometry><cylinder radius='" + radius +
                         "' length='.04'/></geometry></collision>",
                     "<axis xyz='0 1 0'/>" + limit);
}

class DraftOfCasters : public testing::Test {
 protected:
  RobotDraft draft(const std::string& parts) {
    return test::drafted(folder_, "<robot name='r'>" + beside_chassis + parts + "</robot>");
  }
  static std::vector<std::string> joints(const std::vector<DraftWheel>& wheels) {
    std::vector<std::string> names;
    for (const DraftWheel& wheel : wheels) names.push_back(wheel.joint);
    return names;
  }

  test::Folder folder_;
};

using JointNames = std::vector<std::string>;

const std::string beside_pair = beside_wheel("left_wheel", "0 .2 0") + beside_wheel("right_wheel", "0 -.2 0");
const std::string beside_ball = "<collision><geometry><sphere radius='.03'/></geometry></collision>";

// Of a caster that is drawn of a bracket, a fork and a ball, the ball alone stands on the ground.
TEST_F(DraftOfCasters, the_bracket_of_a_ball_is_no_support) {
  const RobotDraft drawn =
      draft(beside_pair + beside_part("caster_base", "base_link", "-.2 0 -.02", "fixed", "") +
            beside_part("caster_fork", "base_link", "-.21 0 -.03", "fixed", "") +
            beside_part("caster_wheel", "base_link", "-.22 0 -.05", "fixed", beside_ball) +
            beside_part("front_caster", "base_link", ".2 0 -.05", "fixed", ""));
  EXPECT_EQ(drawn.supports, (JointNames{"caster_wheel", "front_caster"})) << drawn.text;
}

TEST_F(DraftOfCasters, the_bracket_of_a_caster_that_turns_is_no_support) {
  const RobotDraft drawn =
      draft(beside_pair + beside_part("caster_base", "base_link", "-.2 0 -.02", "fixed", "") +
            beside_part("caster_fork", "base_link", "-.2 0 -.03", "continuous",
                        beside_inertial(".1", ".0001"), "<axis xyz='0 0 1'/>") +
            beside_wheel("caster_wheel", "-.02 0 -.02", ".03", "", "caster_fork"));
  EXPECT_EQ(drawn.supports, JointNames{}) << drawn.text;
  EXPECT_EQ(joints(drawn.casters), JointNames{"caster_wheel_joint"});
}

// Right below its swivel a free wheel has no trail that turns it: it would hold the base sideways. It is a
// ball.
TEST_F(DraftOfCasters, a_wheel_right_below_its_free_swivel_is_a_ball) {
  const std::string bracket =
      "<collision><geometry><cylinder radius='.01' length='.03'/></geometry></collision>";
  const auto caster = [&](const std::string& behind) {
    return draft(beside_pair + beside_part("caster_base", "base_link", "-.2 0 -.02", "fixed", bracket) +
                 beside_part("caster_fork", "base_link", "-.2 0 -.03", "continuous",
                             beside_inertial(".1", ".0001"), "<axis xyz='0 0 1'/>") +
                 beside_wheel("caster_wheel", behind + " 0 -.02", ".03", "", "caster_fork"));
  };
  const RobotDraft below = caster("0");
  EXPECT_EQ(below.supports, JointNames{"caster_wheel"}) << below.text;
  EXPECT_NE(below.text.find("fixed: [caster_fork_joint, caster_wheel_joint]"), std::string::npos)
      << below.text;
  ASSERT_FALSE(below.assumed.empty());
  EXPECT_EQ(below.assumed.front().robot.model.wheels().size(), 2U);
  EXPECT_EQ(joints(caster("-.02").casters), JointNames{"caster_wheel_joint"});
}

// A file may draw all parts in the base's frame, each link at 0 0 0: a mesh stands where its mass is.
TEST_F(DraftOfCasters, a_caster_of_a_mesh_carries_where_its_mass_is) {
  const std::string body =
      "<inertial><origin xyz='-.2 0 -.05'/><mass value='.1'/><inertia ixx='1e-5' iyy='1e-5' izz='1e-5' "
      "ixy='0' "
      "ixz='0' iyz='0'/></inertial><collision><origin xyz='-.2 0 -.05'/><geometry><mesh filename='c.stl'/>"
      "</geometry></collision>";
  const RobotDraft drawn = draft(beside_pair + beside_part("caster", "base_link", "0 0 0", "fixed", body));
  EXPECT_EQ(drawn.supports, JointNames{"caster"}) << drawn.text;
  ASSERT_FALSE(drawn.assumed.empty());
  const Robot& robot = drawn.assumed.front().robot;
  ASSERT_EQ(robot.supports.size(), 1U);
  const auto frame = robot.model.find_frame(robot.supports.front());
  ASSERT_TRUE(frame);
  EXPECT_NEAR(robot.model.frames()[static_cast<std::size_t>(*frame)].pose_in_body.position.x(), -0.2, 1e-9);
}

// The wheels' rectangle reaches as far behind as the casters do, and ahead as far as the wheels.
TEST_F(DraftOfCasters, the_outline_of_wheels_ends_where_they_end) {
  const std::string mesh = "<link name='base_link'>" + beside_inertial("20", ".6") +
                           "<collision><geometry><mesh filename='a.stl'/></geometry></collision></link>";
  const RobotDraft drawn = test::drafted(
      folder_, "<robot name='r'>" + mesh + beside_pair +
                   beside_part("caster_fork", "base_link", "-.4 0 -.03", "continuous",
                               beside_inertial(".1", ".0001"), "<axis xyz='0 0 1'/>") +
                   beside_wheel("caster_wheel", "-.02 0 -.02", ".03", "", "caster_fork") + "</robot>");
  EXPECT_NE(
      drawn.text.find("# polygon: [[0.08 m, 0.2 m], [-0.45 m, 0.2 m], [-0.45 m, -0.2 m], [0.08 m, -0.2 m]]"),
      std::string::npos)
      << drawn.text;
  EXPECT_NE(drawn.text.find("The wheels alone reach 0.53 m x 0.4 m"), std::string::npos) << drawn.text;
}

// Stiff wheels of two sizes on one base would drag: the small ones are casters that are drawn without
// swivels.
TEST_F(DraftOfCasters, small_wheels_that_do_not_steer_carry_the_base) {
  const std::string small = beside_wheel("front_left_wheel", ".2 .1 -.04", ".04") +
                            beside_wheel("front_right_wheel", ".2 -.1 -.04", ".04");
  const RobotDraft drawn = draft(beside_pair + small);
  EXPECT_EQ(joints(drawn.wheels), (JointNames{"left_wheel_joint", "right_wheel_joint"})) << drawn.text;
  EXPECT_EQ(drawn.supports, (JointNames{"front_left_wheel", "front_right_wheel"}));
  EXPECT_NE(drawn.text.find("lead: nose"), std::string::npos) << "two plain wheels on one axle";
}

// Some files draw a mark where a tyre is. Left and right are alike: the larger one tells both radii, and the
// small wheels behind are casters without swivels.
TEST_F(DraftOfCasters, a_wheel_whose_shape_is_a_mark_is_as_its_counterpart) {
  const RobotDraft drawn =
      draft(beside_wheel("fl", ".13 .13 -.1275", ".01") + beside_wheel("fr", ".13 -.13 -.1275", ".05") +
            beside_wheel("rr", "-.12 -.125 -.1505", ".03") + beside_wheel("rl", "-.12 .125 -.1505", ".01"));
  EXPECT_EQ(joints(drawn.wheels), (JointNames{"fl_joint", "fr_joint"})) << drawn.text;
  for (const DraftWheel& wheel : drawn.wheels) EXPECT_NEAR(wheel.radius.value_or(0.0), 0.05, 1e-9);
  std::vector<std::string> supports = drawn.supports;
  std::sort(supports.begin(), supports.end());
  EXPECT_EQ(supports, (JointNames{"rl", "rr"})) << drawn.text;
}

// Meshes that nobody calls wheels: a pair that hangs 23 mm higher has larger wheels, and no arm's motors.
// Each radius is asked for.
TEST_F(DraftOfCasters, pairs_of_two_sizes_are_wheels_each_with_its_radius) {
  const auto part = [](const std::string& name, const std::string& xyz) {
    return beside_part(name, "base_link", xyz, "continuous", beside_inertial("1", ".003"),
                       "<axis xyz='0 1 0'/>");
  };
  const RobotDraft drawn = draft(part("fl", ".129 .105 -.1275") + part("fr", ".129 -.105 -.1275") +
                                 part("rr", "-.124 -.125 -.1505") + part("rl", "-.124 .125 -.1505"));
  EXPECT_EQ(joints(drawn.wheels), (JointNames{"fl_joint", "fr_joint", "rr_joint", "rl_joint"})) << drawn.text;
  for (const char* name : {"fl", "fr", "rr", "rl"})
    EXPECT_NE(drawn.text.find("{joint: " + std::string(name) + "_joint, radius: FILL_IN}"), std::string::npos)
        << drawn.text;
}

// A simulator's own joint closes the loop of a brace: what it ties has no motor of its own.
TEST_F(DraftOfCasters, a_linkage_that_a_simulator_closes_does_not_move) {
  const std::string brace =
      beside_part("brace", "base_link", "0 0 .07", "revolute", beside_inertial(".4", ".001"),
                  "<axis xyz='0 0 1'/><limit effort='100' lower='-.8' upper='.8' velocity='1'/>");
  const std::string tie =
      "<gazebo><joint name='tie' type='ball'><parent>brace</parent><child>rod</child></joint></gazebo>";
  EXPECT_NE(draft(beside_pair + brace).text.find("  brace_joint: {}"), std::string::npos);
  const std::string text = draft(beside_pair + brace + tie).text;
  EXPECT_NE(text.find("\nfixed: [brace_joint]"), std::string::npos) << text;
  EXPECT_EQ(text.find("brace_joint: {"), std::string::npos) << text;
}

// Wheels of 80 mm beside some of 70 mm are worn tyres of one kind.
TEST_F(DraftOfCasters, wheels_of_nearly_one_size_drive) {
  EXPECT_EQ(draft(beside_pair + beside_wheel("front_left_wheel", ".2 .2 -.01", ".07") +
                  beside_wheel("front_right_wheel", ".2 -.2 -.01", ".07"))
                .wheels.size(),
            4U);
}

// Rollers need a motor at each wheel: where the URDF gives two of four one, they skid, and nobody is asked.
TEST_F(DraftOfCasters, wheels_beside_some_without_a_motor_skid) {
  const std::string limit = "<limit effort='8' velocity='9'/>";
  const RobotDraft drawn =
      draft(beside_wheel("rear_left_wheel", "-.2 .2 0", ".08", limit) +
            beside_wheel("rear_right_wheel", "-.2 -.2 0", ".08", limit) +
            beside_wheel("front_left_wheel", ".2 .2 0") + beside_wheel("front_right_wheel", ".2 -.2 0"));
  EXPECT_EQ(joints(drawn.idle), (JointNames{"front_left_wheel_joint", "front_right_wheel_joint"}));
  EXPECT_NE(drawn.text.find("each_wheel: {kind: skid}"), std::string::npos) << drawn.text;
  EXPECT_EQ(drawn.text.find("kind: FILL_IN"), std::string::npos) << drawn.text;
}

// A wheel of 0.003 kg m^2 and a fork of 0.0001 kg m^2 and 1 kg, 20 cm beside the pivot's axis:
// 0.0031 + 1 x 0.2^2 = 0.0431 kg m^2, and two digits above.
// Below it: 26 kg on four wheels of 80 mm take 26 x 9.81 x 0.08 / 4 = 5.1 N m to scrub a tyre around. With
// 150 rad/s^2 that is a rotor of 0.034 kg m^2, however light the fork.
TEST_F(DraftOfCasters, a_cars_steering_has_as_much_rotor_inertia_as_it_turns) {
  const auto steered = [](const std::string& name, const std::string& xyz, const std::string& beside) {
    const std::string fork = "<inertial><origin xyz='" + beside +
                             " 0 0'/><mass value='1'/><inertia ixx='.0001' iyy='.0001' "
                             "izz='.0001' ixy='0' ixz='0' iyz='0'/></inertial>";
    return beside_part(name + "_steering", "base_link", xyz, "revolute", fork,
                       "<axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='5' velocity='5'/>") +
           beside_wheel(name + "_wheel", "0 0 0", ".08", "", name + "_steering");
  };
  for (const auto& [beside, rotor] : {std::pair{".2", "0.044"}, {".1", "0.035"}}) {
    const RobotDraft drawn = draft(beside_pair + steered("front_left", ".4 .2 0", beside) +
                                   steered("front_right", ".4 -.2 0", beside));
    EXPECT_NE(
        drawn.text.find("front_left_steering_joint: {rotor_inertia: " + std::string(rotor) + " kg m^2}"),
        std::string::npos)
        << drawn.text;
  }
}

// Wheels with rollers hold no side force, and a base on them turns about its origin.
TEST_F(DraftOfCasters, a_base_on_one_axle_turns_about_the_axle) {
  const std::string behind =
      beside_wheel("left_wheel", "-.2 .2 0") + beside_wheel("right_wheel", "-.2 -.2 0");
  EXPECT_NEAR(base_fit(draft(behind)).axle, -0.2, 1e-9);
  EXPECT_EQ(base_fit(draft(behind + beside_wheel("front_left_wheel", ".1 .2 0") +
                           beside_wheel("front_right_wheel", ".1 -.2 0")))
                .axle,
            0.0);
}

// A fork that reaches beyond the outline touches a wall first, whatever joint moves it.
TEST_F(DraftOfCasters, a_fork_that_reaches_ahead_is_told) {
  const std::string lift =
      beside_part("lift", "base_link", ".4 0 0", "prismatic", beside_inertial("1", ".01"),
                  "<axis xyz='0 0 1'/><limit lower='0' upper='1' effort='100' velocity='1'/>");
  const std::string fork = beside_part("fork", "lift", ".5 0 0", "fixed", beside_inertial("1", ".01"));
  const BaseFit fit = base_fit(draft(beside_pair + lift + fork));
  EXPECT_NEAR(fit.arm_ahead, 0.9, 1e-9);
  EXPECT_NE(why_unfit("wall_align", fit).find("0.9 m ahead"), std::string::npos)
      << why_unfit("wall_align", fit);
}

// The draft asks for the force of a sliding joint's motor, not for a torque.
TEST_F(DraftOfCasters, a_lift_is_asked_for_its_force) {
  const std::string lift =
      beside_part("lift", "base_link", "0 0 .1", "prismatic", beside_inertial("1", ".01"),
                  "<axis xyz='0 0 1'/><limit lower='0' upper='1' effort='0' velocity='1'/>");
  const OpenPlaces places = open_places(draft(beside_pair + lift).text);
  const auto asked = std::find_if(
      places.to_fill_in.begin(), places.to_fill_in.end(),
      [](const OpenPlace& place) { return place.entry.find("lift_joint") != std::string::npos; });
  ASSERT_NE(asked, places.to_fill_in.end());
  EXPECT_NE(asked->what_to.find("force"), std::string::npos) << asked->what_to;
}

// Four swivels whose wheels roll along y as they are drawn: turned by 90 deg they roll ahead, as tasks drive.
TEST_F(DraftOfCasters, steered_wheels_start_as_they_roll_ahead) {
  std::string modules;
  for (const auto& [name, xyz] :
       {std::pair{"fl", ".2 .15 0"}, {"fr", ".2 -.15 0"}, {"rl", "-.2 .15 0"}, {"rr", "-.2 -.15 0"}}) {
    const std::string n = name;
    modules += beside_part(n + "_steer", "base_link", xyz, "continuous", beside_inertial("1", ".001"),
                           "<axis xyz='0 0 1'/><limit effort='5' velocity='5'/>") +
               test::replaced(beside_wheel(n + "_wheel", "0 0 0", ".08", "<limit effort='5' velocity='5'/>",
                                           n + "_steer"),
                              "<axis xyz='0 1 0'/>", "<axis xyz='1 0 0'/>");
  }
  const std::string text = draft(modules).text;
  for (const char* name : {"fl", "fr", "rl", "rr"})
    EXPECT_NE(text.find(std::string(name) + "_steer_joint: 90 deg"), std::string::npos) << text;
}

// 10 g on a joint of a robot of 22 kg, without a limit: a mark for a controller. With a limit it is a motor.
TEST_F(DraftOfCasters, a_joint_of_next_to_no_mass_is_held) {
  const auto held = [&](const std::string& limit) {
    const std::string mark =
        beside_part("front_steer", "base_link", ".2 0 0", "revolute", beside_inertial(".01", "1e-6"),
                    "<axis xyz='0 0 1'/><limit lower='-1' upper='1' velocity='1' " + limit + "/>");
    return draft(beside_pair + mark).text.find("fixed: [front_steer_joint]") != std::string::npos;
  };
  EXPECT_TRUE(held("effort='0'"));
  EXPECT_FALSE(held("effort='2'"));
}

}  // namespace
}  // namespace zwang::lang
