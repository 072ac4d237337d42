// Which joints a draft takes for wheels, for steering and for casters, and what it says of those that it
// does not take.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drafted.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/lang/robot_update.hpp"
#include "zwang/lang/task_draft.hpp"

namespace zwang::lang {
namespace {

const std::string motor_limit = "<limit effort='5' velocity='10'/>";
const std::string round_shape =
    "<origin rpy='1.5707963 0 0'/><geometry><cylinder radius='.1' length='.05'/></geometry>";
const std::string mesh_shape = "<geometry><mesh filename='w.stl'/></geometry>";
const std::string ball_shape = "<geometry><sphere radius='.05'/></geometry>";

/// A link of 1 kg below a joint. `axis` empty: the joint has none.
struct DrawnPart {
  std::string name, parent, type, at, axis;
  std::string limit;
  std::string shape;
  std::string rpy = "0 0 0";
};

std::string part_text(const DrawnPart& part) {
  const std::string geometry = part.shape.empty() ? "" : "<collision>" + part.shape + "</collision>";
  const std::string axis = part.axis.empty() ? "" : "<axis xyz='" + part.axis + "'/>";
  return "<link name='" + part.name +
         "'><inertial><mass value='1'/><inertia ixx='.003' iyy='.005' izz='.003' ixy='0' ixz='0' iyz='0'/>"
         "</inertial>" +
         geometry + "</link><joint name='" + part.name + "_joint' type='" + part.type + "'><parent link='" +
         part.parent + "'/><child link='" + part.name + "'/><origin xyz='" + part.at + "' rpy='" + part.rpy +
         "'/>" + axis + part.limit + "</joint>";
}

std::string wheel_text(const std::string& name, const std::string& at, const std::string& shape = round_shape,
                       const std::string& parent = "base_link") {
  return part_text({name, parent, "continuous", at, "0 1 0", motor_limit, shape});
}

std::string robot_text(const std::string& parts) {
  return "<robot name='r'><link name='base_link'><inertial><mass value='20'/><inertia ixx='.5' iyy='.6' "
         "izz='.8' ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry><box size='.6 .4 .2'/></geometry>"
         "</collision></link>" +
         parts + "</robot>";
}

std::string transmission_of(const std::string& joint) {
  return "<transmission name='t_" + joint + "'><joint name='" + joint + "'/></transmission>";
}

class DraftOfWheels : public testing::Test {
 protected:
  RobotDraft drafted(const std::string& urdf) { return test::drafted(folder_, urdf, "robot.urdf"); }
  std::string said_of(const std::string& text) {
    Diagnostics diagnostics;
    load_robot(folder_.write("robot.yaml", text), diagnostics);
    return test::rendered(diagnostics);
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
  static bool is_missing(const RobotDraft& draft, const std::string& part) {
    return std::any_of(draft.missing.begin(), draft.missing.end(),
                       [&](const std::string& line) { return has(line, part); });
  }

  test::Folder folder_;
};

std::string turret_text(const std::string& limit, const std::string& said) {
  return robot_text(part_text({"turret", "base_link", "continuous", "0 0 -.1", "0 0 1", limit, ""}) +
                    wheel_text("left_wheel", "-.1 .15 0", round_shape, "turret") +
                    wheel_text("right_wheel", "-.1 -.15 0", round_shape, "turret") + said);
}

// Two driven wheels turn their swivel by themselves. A limit alone is a simulator's habit, and a
// transmission alone reads an encoder: with both it has a motor.
TEST_F(DraftOfWheels, has_a_motor_that_steers_above_two_wheels_where_the_file_says_both) {
  const std::string said = transmission_of("turret_joint") + transmission_of("left_wheel_joint") +
                           transmission_of("right_wheel_joint");
  const std::string entry = "  turret_joint: {}\n";
  const RobotDraft both = drafted(turret_text("<limit effort='30' velocity='3'/>", said));
  EXPECT_TRUE(has(both.text, entry)) << both.text;
  EXPECT_EQ(said_of(both.text), "");
  ASSERT_EQ(both.assumed.size(), 1U);
  EXPECT_TRUE(both.assumed.front().robot.model.joint(0).actuated);
  EXPECT_EQ(base_fit(both).freedoms, Freedoms::all);
  EXPECT_FALSE(has(drafted(turret_text("<limit effort='30' velocity='3'/>", "")).text, entry));
  EXPECT_FALSE(has(drafted(turret_text("", said)).text, entry));
}

/// Joints about x, y and z in the middle of a ball.
std::string ball_chain(const std::string& name, const std::string& parent, const std::string& at) {
  return part_text({name + "_x", parent, "continuous", at, "1 0 0", motor_limit, ""}) +
         part_text({name + "_y", name + "_x", "continuous", "0 0 0", "0 1 0", motor_limit, ""}) +
         part_text({name + "_wheel", name + "_y", "continuous", "0 0 0", "0 0 1", motor_limit, ball_shape});
}

// A ball rolls every way: as it stands it is a support, and three motors turn nothing.
TEST_F(DraftOfWheels, takes_a_ball_on_crossing_joints_for_a_support) {
  const std::string urdf =
      robot_text(wheel_text("left_wheel", "0 .25 -.1") + wheel_text("right_wheel", "0 -.25 -.1") +
                 ball_chain("rear", "base_link", "-.25 0 -.15"));
  const RobotDraft draft = drafted(urdf);
  EXPECT_EQ(draft.wheels.size(), 2U);
  EXPECT_EQ(draft.supports, std::vector<std::string>{"rear_wheel"});
  EXPECT_TRUE(has(draft.text, "fixed: [rear_wheel_joint, rear_y_joint, rear_x_joint]")) << draft.text;
  EXPECT_FALSE(has(draft.text, "rear_x_joint: {")) << draft.text;
  EXPECT_EQ(said_of(draft.text).find("error"), std::string::npos) << said_of(draft.text);
  const std::string loose =
      test::replaced(draft.text, "fixed: [rear_wheel_joint, rear_y_joint, rear_x_joint]",
                     "fixed: [rear_y_joint, rear_x_joint]");
  EXPECT_TRUE(has(said_of(loose), "list `rear_wheel_joint` under `fixed`")) << said_of(loose);
}

// On a link that steers it moves with the wheels, and no support of the base does.
TEST_F(DraftOfWheels, holds_balls_on_a_steered_link_and_names_no_support) {
  const std::string urdf = test::replaced(turret_text("<limit effort='30' velocity='3'/>", ""), "</robot>",
                                          ball_chain("front", "turret", ".15 0 -.05") + "</robot>");
  const RobotDraft draft = drafted(urdf);
  EXPECT_TRUE(draft.supports.empty());
  EXPECT_FALSE(has(draft.text, "front_x_joint: {")) << draft.text;
  EXPECT_EQ(said_of(draft.text).find("error"), std::string::npos) << said_of(draft.text);
  EXPECT_TRUE(has(said_of(draft.text + "supports: [front_wheel]\n"), "what a steered link carries"));
}

std::string four_text(const std::string& rear_left, const std::string& rear_right, const std::string& rear_x,
                      const std::string& more = "") {
  return robot_text(wheel_text("front_left_wheel", ".2 .25 -.1", mesh_shape) +
                    wheel_text("front_right_wheel", ".2 -.25 -.1", mesh_shape) +
                    wheel_text(rear_left, rear_x + " .25 -.1", mesh_shape) +
                    wheel_text(rear_right, rear_x + " -.25 -.1", mesh_shape) + more);
}

// The word for a wheel stands in half of the names, and the shapes are meshes: places tell.
TEST_F(DraftOfWheels, takes_a_pair_as_high_as_the_named_wheels_for_wheels) {
  const std::string gears =
      part_text({"gear_a", "base_link", "continuous", "-.2 0 -.1", "0 1 0", motor_limit, ""}) +
      part_text({"gear_b", "base_link", "continuous", "-.2 0 -.1", "0 1 0", motor_limit, ""});
  for (const std::string& more : {std::string(), gears}) {
    const RobotDraft draft = drafted(four_text("left_rear", "right_rear", "-.2", more));
    EXPECT_EQ(draft.wheels.size(), 4U) << draft.text;
    EXPECT_EQ(draft.drive, "four wheels that do not steer: mecanum or skid steering");
  }
  const std::string high = four_text("left_rear", "right_rear", "-.2");
  const RobotDraft arms = drafted(
      test::replaced(test::replaced(high, "-.2 .25 -.1", "-.2 .25 .1"), "-.2 -.25 -.1", "-.2 -.25 .1"));
  EXPECT_EQ(arms.wheels.size(), 2U) << "0.2 m higher they are something else";
}

// No name and no shape tells anything: the lowest that are level with each other are wheels.
TEST_F(DraftOfWheels, takes_the_lowest_pair_for_wheels_where_nothing_is_named) {
  const std::string pair =
      wheel_text("lf", "0 .25 -.1", mesh_shape) + wheel_text("rf", "0 -.25 -.1", mesh_shape);
  const RobotDraft draft = drafted(
      robot_text(pair + part_text({"elbow", "base_link", "continuous", "0 .1 .4", "0 1 0", motor_limit, ""}) +
                 part_text({"jaw", "base_link", "continuous", "0 -.1 .4", "0 1 0", motor_limit, ""})));
  ASSERT_EQ(draft.wheels.size(), 2U);
  EXPECT_EQ(draft.wheels[0].joint, "lf_joint");
  EXPECT_EQ(draft.wheels[1].joint, "rf_joint");
  const RobotDraft legs = drafted(
      robot_text(pair + part_text({"foot", "base_link", "revolute", ".3 0 -.5", "1 0 0",
                                   "<limit lower='-1' upper='1' effort='1' velocity='1'/>", mesh_shape})));
  EXPECT_TRUE(legs.wheels.empty()) << "a foot reaches lower";
}

TEST_F(DraftOfWheels, tells_of_wheels_that_the_urdf_holds_beside_those_that_turn) {
  const std::string turns = four_text("rear_left_wheel", "rear_right_wheel", "-.2");
  const std::string held = "<joint name='rear_left_wheel_joint' type='";
  const RobotDraft draft = drafted(test::replaced(turns, held + "continuous'", held + "fixed'"));
  EXPECT_EQ(draft.wheels.size(), 3U);
  ASSERT_EQ(draft.stuck.size(), 1U);
  EXPECT_EQ(draft.stuck.front().joint, "rear_left_wheel_joint");
  EXPECT_TRUE(is_missing(draft, "`rear_left_wheel_joint`, which is `fixed`"));
  EXPECT_TRUE(has(draft.text, "# `rear_left_wheel_joint` is not here: the URDF has it `fixed`"));
  // Once it turns, an update has it.
  const auto file = folder_.write("filled.yaml", draft.text);
  const RobotDraft mended = drafted(turns);
  Diagnostics diagnostics;
  const auto update = update_robot_file(file, folder_.path() / "robot.urdf", mended, diagnostics);
  ASSERT_TRUE(update) << test::rendered(diagnostics);
  EXPECT_TRUE(has(update->text, "  - {joint: rear_left_wheel_joint}")) << update->text;
  // A sensor of the word, a tyre, and what carries a wheel are none.
  const std::string others =
      part_text({"wheel_encoder", "base_link", "fixed", "0 0 .2", "", "", ""}) +
      part_text({"tyre_of_wheel", "rear_left_wheel", "fixed", "0 0 0", "", "", mesh_shape}) +
      part_text({"wheel_mount", "base_link", "fixed", "0 0 -.1", "", "", ""}) +
      wheel_text("spare_wheel", "0 .25 0", mesh_shape, "wheel_mount");
  EXPECT_TRUE(drafted(test::replaced(turns, "</robot>", others + "</robot>")).stuck.empty());
}

// A caster alone drives nothing: the wheels that drive are those that the URDF holds.
TEST_F(DraftOfWheels, a_caster_does_not_drive_beside_wheels_that_are_fixed) {
  const auto fixed = [](const std::string& name, const std::string& at) {
    return part_text({name, "base_link", "fixed", at, "", "", round_shape});
  };
  const std::string caster = part_text({"swivel", "base_link", "continuous", "-.25 0 -.1", "0 0 1", "", ""}) +
                             wheel_text("caster_wheel", "-.03 0 -.05", round_shape, "swivel");
  const RobotDraft draft =
      drafted(robot_text(fixed("left_wheel", ".1 .25 -.1") + fixed("right_wheel", ".1 -.25 -.1") + caster));
  ASSERT_EQ(draft.wheels.size(), 2U) << draft.text;
  EXPECT_EQ(draft.wheels[0].joint, "left_wheel_joint");
  EXPECT_EQ(draft.wheels[1].joint, "right_wheel_joint");
  EXPECT_TRUE(has(draft.text, "turns: [left_wheel_joint, right_wheel_joint]")) << draft.text;
  EXPECT_EQ(draft.casters.size(), 1U);
  // All casters, and nothing else is called a wheel: they drive, as those of the PR2 do.
  EXPECT_EQ(drafted(robot_text(caster)).wheels.size(), 1U);
  // Casters that are fixed are told where there is nothing else.
  const RobotDraft held = drafted(robot_text(fixed("caster_l_wheel", ".1 .2 -.1")));
  ASSERT_EQ(held.stuck.size(), 1U);
  EXPECT_EQ(held.stuck.front().joint, "caster_l_wheel_joint");
}

/// Three wheels on a circle, each with 12 rollers in a ring across its axle.
std::string wheels_with_rollers(const std::string& name, const std::string& roller_shape) {
  std::string parts;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * std::numbers::pi / 3.0 * i;
    const std::string wheel = name + std::to_string(i);
    parts += part_text(
        {wheel, "base_link", "continuous",
         std::to_string(0.2 * std::cos(angle)) + " " + std::to_string(0.2 * std::sin(angle)) + " -.1",
         "1 0 0", motor_limit, mesh_shape, "0 0 " + std::to_string(angle)});
    for (int k = 0; k < 12; ++k) {
      const double turn = 2.0 * std::numbers::pi / 12.0 * k;
      const std::string y = std::to_string(0.04 * std::cos(turn)), z = std::to_string(0.04 * std::sin(turn));
      parts += part_text({wheel + "_roller_" + std::to_string(k), wheel, "continuous", "0 " + y + " " + z,
                          "0 " + std::to_string(-std::sin(turn)) + " " + std::to_string(std::cos(turn)), "",
                          roller_shape});
    }
  }
  return robot_text(parts);
}

TEST_F(DraftOfWheels, finds_a_wheel_whose_rollers_are_joints) {
  const RobotDraft draft =
      drafted(wheels_with_rollers("wheel_", "<geometry><sphere radius='.01'/></geometry>"));
  ASSERT_EQ(draft.wheels.size(), 3U) << draft.text;
  for (const DraftWheel& wheel : draft.wheels) EXPECT_NEAR(*wheel.radius, 0.04 + 0.01, 1e-5);
  EXPECT_TRUE(has(draft.text, "{joint: wheel_0_joint, radius: 50 mm, roller: 90 deg}")) << draft.text;
  EXPECT_FALSE(has(draft.text, "roller_3_joint: {")) << draft.text;
  EXPECT_EQ(said_of(draft.text).find("error"), std::string::npos) << said_of(draft.text);
}

// No name and no shape tells a wheel: the rims stand lowest, but for their own rollers.
TEST_F(DraftOfWheels, finds_rims_by_place_above_their_rollers) {
  const RobotDraft draft = drafted(wheels_with_rollers("rim_", mesh_shape));
  ASSERT_EQ(draft.wheels.size(), 3U) << draft.text;
  EXPECT_TRUE(has(draft.text, "{joint: rim_0_joint, roller: 90 deg}")) << draft.text;
}

// Limits of 0 to 0 leave a finger no travel. A joint without
// limits has no motor where others have them, and one that turns a lidar drives nothing.
TEST_F(DraftOfWheels, asks_for_no_motor_of_what_cannot_move_or_has_none) {
  const std::string pair = wheel_text("left_wheel", "0 .25 -.1") + wheel_text("right_wheel", "0 -.25 -.1");
  const RobotDraft draft =
      drafted(robot_text(pair +
                         part_text({"finger", "base_link", "revolute", "0 0 .3", "0 1 0",
                                    "<limit lower='0' upper='0' effort='0' velocity='0'/>", ""}) +
                         part_text({"gear", "base_link", "continuous", "0 0 .4", "0 0 1", "", ""}) +
                         part_text({"lidar", "base_link", "continuous", "0 0 .4", "0 0 1", "", ""}) +
                         transmission_of("lidar_joint")));
  EXPECT_TRUE(has(draft.text, "fixed: [finger_joint, gear_joint, lidar_joint]")) << draft.text;
  EXPECT_FALSE(has(draft.text, fill_in + std::string("}"))) << draft.text;
  EXPECT_EQ(said_of(draft.text), "");
}

// A pivot that cannot turn steers nothing, and its wheel stands as the base does. It is told.
TEST_F(DraftOfWheels, tells_of_steering_without_travel) {
  const auto steered = [](const std::string& side, const std::string& y) {
    return part_text({side + "_steer", "base_link", "revolute", ".2 " + y + " -.1", "0 0 1",
                      "<limit lower='0' upper='0' effort='100' velocity='1'/>", ""}) +
           wheel_text(side + "_wheel", "0 0 0", round_shape, side + "_steer");
  };
  const RobotDraft draft = drafted(robot_text(steered("left", ".25") + steered("right", "-.25") +
                                              wheel_text("rear_left_wheel", "-.2 .25 -.1") +
                                              wheel_text("rear_right_wheel", "-.2 -.25 -.1")));
  EXPECT_EQ(draft.drive, "four wheels that do not steer: mecanum or skid steering");
  EXPECT_TRUE(has(draft.text, "fixed: [left_steer_joint, right_steer_joint]")) << draft.text;
  EXPECT_TRUE(is_missing(draft, "`left_steer_joint`: its limits leave it no travel"));
}

/// Two wheels without an <axis> on cylinders along `y` of their links, and a ball.
std::string axisless_text(const std::string& rpy, const std::string& shape) {
  const auto wheel = [&](const std::string& name, const std::string& at) {
    return part_text({name, "base_link", "continuous", at, "", motor_limit, shape, rpy});
  };
  return robot_text(wheel("left_wheel", "0 .25 -.1") + wheel("right_wheel", "0 -.25 -.1") +
                    part_text({"ball", "base_link", "fixed", "-.25 0 -.15", "", "", ball_shape}));
}

// A URDF means 1 0 0 by no axis: ahead. The cylinder tells what was meant, in whatever frame the wheel is.
TEST_F(DraftOfWheels, proposes_the_axis_of_the_cylinder_where_the_urdf_has_none) {
  const std::string upright = "<geometry><cylinder radius='.1' length='.05'/></geometry>";
  const std::string lines[] = {"  left_wheel_joint: [0, 1, 0]\n", "  left_wheel_joint: [0, 0, 1]\n"};
  const std::string urdfs[] = {axisless_text("0 0 0", round_shape),
                               axisless_text("-1.5707963267949 0 0", upright)};
  for (std::size_t i = 0; i < 2; ++i) {
    const RobotDraft draft = drafted(urdfs[i]);
    EXPECT_TRUE(has(draft.text, lines[i])) << draft.text;
    EXPECT_EQ(draft.drive, "differential: two plain wheels");
    EXPECT_EQ(draft.heading, 0.0);
    EXPECT_EQ(said_of(draft.text), "");
    Diagnostics diagnostics;
    const auto robot = load_robot(folder_.path() / "robot.yaml", diagnostics);
    ASSERT_TRUE(robot);
    EXPECT_EQ(base_fit(*robot).freedoms, Freedoms::two);
    EXPECT_EQ(base_fit(*robot).heading, 0.0);
  }
}

// A mesh does not tell it. An update keeps the axis that the owner gives.
TEST_F(DraftOfWheels, names_a_wheel_of_which_nothing_tells_the_axis) {
  const std::string urdf = axisless_text("0 0 0", mesh_shape);
  const RobotDraft draft = drafted(urdf);
  EXPECT_TRUE(is_missing(draft, "the axis of `left_wheel_joint`: without an <axis> it is 1 0 0"));
  EXPECT_TRUE(is_missing(draft, "`axes: {left_wheel_joint: [0, 1, 0]}`"));
  Diagnostics diagnostics;
  const auto file = folder_.write(
      "given.yaml", "zwang_robot: 1\naxes: {left_wheel_joint: [0, 2, 0], right_wheel_joint: [0, 1, 0]}\n");
  const auto options = options_of(file, diagnostics);
  ASSERT_TRUE(options) << test::rendered(diagnostics);
  const auto given = draft_robot(folder_.path() / "robot.urdf", "robot.urdf", diagnostics, *options);
  ASSERT_TRUE(given) << test::rendered(diagnostics);
  EXPECT_EQ(given->drive, "differential: two plain wheels");
  EXPECT_EQ(given->heading, 0.0);
  EXPECT_FALSE(is_missing(*given, "the axis of"));
}

// A caster's swivel without an axis would be a rocker.
TEST_F(DraftOfWheels, turns_a_swivel_without_an_axis_upwards) {
  const std::string urdf = robot_text(
      wheel_text("left_wheel", "0 .25 -.1") + wheel_text("right_wheel", "0 -.25 -.1") +
      part_text({"caster_swivel", "base_link", "continuous", "-.25 0 -.1", "", "", ""}) +
      part_text({"caster_wheel", "caster_swivel", "continuous", "-.05 0 -.05", "0 1 0", "",
                 "<origin rpy='1.5707963 0 0'/><geometry><cylinder radius='.05' length='.03'/></geometry>"}));
  const RobotDraft draft = drafted(urdf);
  EXPECT_TRUE(has(draft.text, "axes:\n  caster_swivel_joint: [0, 0, 1]\n")) << draft.text;
  ASSERT_EQ(draft.casters.size(), 1U) << draft.text;
  EXPECT_EQ(draft.casters.front().swivel, "caster_swivel_joint");
}

TEST_F(DraftOfWheels, complains_of_axes_that_are_none) {
  const RobotDraft draft = drafted(axisless_text("0 0 0", round_shape));
  const std::string line = "  left_wheel_joint: [0, 1, 0]\n";
  const auto with = [&](const std::string& text) { return said_of(test::replaced(draft.text, line, text)); };
  EXPECT_TRUE(has(with("  left_wheel_joint: [0, 0, 0]\n"), "has no direction"));
  EXPECT_TRUE(has(with("  left_wheel: [0, 1, 0]\n"), "left_wheel_joint"))
      << with("  left_wheel: [0, 1, 0]\n");
  EXPECT_TRUE(has(with("  ball_joint: [0, 1, 0]\n"), "`ball_joint`"));
  EXPECT_TRUE(has(with("  left_wheel_joint: [0, 1]\n"), "error"));
}

// One torque is asked for, of all joints of an arm that are alike.
TEST_F(DraftOfWheels, asks_once_for_the_torque_of_an_arm) {
  const std::string unknown = "<limit lower='-1' upper='1' effort='0' velocity='1'/>";
  const std::string pair = wheel_text("left_wheel", "0 .25 -.1") + wheel_text("right_wheel", "0 -.25 -.1");
  const RobotDraft draft = drafted(
      robot_text(pair + part_text({"shoulder", "base_link", "revolute", "0 0 .3", "0 1 0", unknown, ""}) +
                 part_text({"elbow", "shoulder", "revolute", ".1 0 0", "0 1 0", unknown, ""}) +
                 part_text({"hand", "elbow", "prismatic", ".1 0 0", "1 0 0", unknown, ""}) +
                 part_text({"wrist", "elbow", "revolute", ".1 0 0", "1 0 0",
                            "<limit lower='-1' upper='1' effort='7' velocity='1'/>", ""})));
  EXPECT_TRUE(has(draft.text, "each_joint: {effort: FILL_IN}")) << draft.text;
  EXPECT_TRUE(has(draft.text,
                  "  shoulder_joint: {}\n  elbow_joint: {}\n  hand_joint: {effort: FILL_IN}  # it slides: "
                  "the largest force, as `20 N`\n"))
      << draft.text;
  std::string filled =
      test::replaced(draft.text, "each_joint: {effort: FILL_IN}", "each_joint: {effort: 3 N m}");
  filled = test::replaced(filled, "hand_joint: {effort: FILL_IN}", "hand_joint: {effort: 20 N}");
  Diagnostics diagnostics;
  const auto robot = load_robot(folder_.write("robot.yaml", filled), diagnostics);
  ASSERT_TRUE(robot) << test::rendered(diagnostics);
  const auto effort_of = [&](const char* joint) {
    return robot->model.joint(*robot->model.find_joint(joint)).max_effort;
  };
  EXPECT_EQ(effort_of("shoulder_joint"), 3.0);
  EXPECT_EQ(effort_of("elbow_joint"), 3.0);
  EXPECT_EQ(effort_of("hand_joint"), 20.0);
  EXPECT_EQ(effort_of("wrist_joint"), 7.0) << "the URDF's";
  EXPECT_EQ(effort_of("left_wheel_joint"), 5.0);
  EXPECT_TRUE(has(said_of(test::replaced(filled, "effort: 3 N m", "effort: 3 kg")), "each_joint.effort"));
  EXPECT_TRUE(has(said_of(test::replaced(filled, "effort: 20 N", "gear: 2")), "hand_joint"))
      << "a torque is for joints that turn";
}

}  // namespace
}  // namespace zwang::lang
