// Habits of URDFs above a base, between joints and beside their axes, and their place in the drafted robot
// file. Those of masses are in draft_masses_test.cpp.
#include <gtest/gtest.h>

#include <numbers>
#include <regex>

#include "draft_of_habits.hpp"
#include "support.hpp"
#include "zwang/lang/task_draft.hpp"

namespace zwang::lang {
namespace {

std::string joint_between(const std::string& name, const std::string& type, const std::string& parent,
                          const std::string& child) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
         child + "'/><axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='1' velocity='1'/></joint>";
}

const std::string massless_roots = "<link name='world'/><link name='odom'/><link name='base_footprint'/>";

// The joints between world and base are the base's own motion.
TEST_F(DraftOfHabits, leaves_out_free_joints_above_the_base) {
  for (const char* type : {"floating", "planar"}) {
    const std::string urdf =
        below_world(massless_roots + joint_between("world_to_odom", "fixed", "world", "odom") +
                    joint_between("virtual", type, "odom", "base_footprint") +
                    joint_between("stand", "fixed", "base_footprint", "chassis"));
    const auto draft = this->draft(folder_.write("world.urdf", urdf));
    ASSERT_TRUE(draft);
    EXPECT_EQ(draft->base, "base_footprint");
    EXPECT_NE(draft->text.find("links `world`, `odom` and joints `world_to_odom`, `virtual`"),
              std::string::npos)
        << draft->text;
    EXPECT_EQ(said_of(draft->text).find("error"), std::string::npos) << said_of(draft->text);
    EXPECT_EQ(said_of(draft->text + "fixed: [virtual]\n").find("error"), std::string::npos);
  }
}

// A link of 0.1 % of 22 kg counts as none, one of 1 kg is a part of the robot.
TEST_F(DraftOfHabits, refuses_a_free_joint_below_a_link_that_weighs) {
  const auto said = [&](const std::string& mass) {
    const std::string urdf =
        below_world("<link name='odom'>" + inertial_element(mass, "ixx='1e-3' iyy='1e-3' izz='1e-3'") +
                    "</link>" + joint_between("virtual", "floating", "odom", "chassis"));
    Diagnostics diagnostics;
    draft_robot(folder_.write("weighs.urdf", urdf), "weighs.urdf", diagnostics);
    return test::rendered(diagnostics);
  };
  EXPECT_EQ(said("0.021"), "");
  EXPECT_NE(said("1").find("E859"), std::string::npos) << said("1");
}

// Rails of 1 mg, as simulators want them, are rails.
TEST_F(DraftOfHabits, takes_rails_of_a_milligram_for_rails) {
  const std::string urdf = below_world("<link name='map'/><link name='rail'>" +
                                       inertial_element("1e-6", "ixx='1e-9' iyy='1e-9' izz='1e-9'") +
                                       "</link>" + joint_between("slide", "prismatic", "map", "rail") +
                                       joint_between("turn", "continuous", "rail", "chassis"));
  const auto draft = this->draft(folder_.write("rails.urdf", urdf));
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->base, "chassis");
  EXPECT_NE(draft->text.find("fixed: [slide, turn]"), std::string::npos) << draft->text;
  EXPECT_EQ(said_of(draft->text).find("error"), std::string::npos) << said_of(draft->text);
}

std::string follows(const std::string& leader, const std::string& factor = "1") {
  return "<limit effort='8' velocity='9'/><mimic joint='" + leader + "_joint' multiplier='" + factor + "'/>";
}

std::string four_wheels(const std::string& rear_left, const std::string& rear_right) {
  return "<robot name='r'>" + chassis() + wheel_at("front_left", "chassis", ".2 .25 0") +
         wheel_at("front_right", "chassis", ".2 -.25 0") +
         wheel_at("rear_left", "chassis", "-.2 .25 0", rear_left) +
         wheel_at("rear_right", "chassis", "-.2 -.25 0", rear_right) + "</robot>";
}

/// Held by its joint, of 1 kg, drawn by a mesh.
std::string held_part(const std::string& name, const std::string& parent, const std::string& xyz) {
  return "<link name='" + name + "'>" + inertial_element("1", "ixx='.002' iyy='.003' izz='.002'") +
         "<collision><geometry><mesh filename='w.stl'/></geometry></collision></link><joint name='" + name +
         "_joint' type='fixed'><parent link='" + parent + "'/><child link='" + name + "'/><origin xyz='" +
         xyz + "'/></joint>";
}

// A carriage that is called a wheel base, with four held wheels, a cover and a scanner whose names say wheel.
TEST_F(DraftOfHabits, finds_held_wheels_on_a_link_that_is_called_a_wheel_base) {
  std::string parts = held_part("wheel_base", "chassis", "0 0 -.1");
  for (const char* at :
       {"front_left .2 .2 0", "front_right .2 -.2 0", "rear_left -.2 .2 0", "rear_right -.2 -.2 0"}) {
    const std::string place = at;
    const std::size_t end = place.find(' ');
    parts += held_part("wheels_" + place.substr(0, end), "wheel_base", place.substr(end + 1));
  }
  parts +=
      held_part("wheels_top", "wheel_base", "0 0 .1") + held_part("wheels_laser", "wheel_base", ".3 0 .1");
  const auto draft =
      this->draft(folder_.write("noid.urdf", "<robot name='r'>" + chassis() + parts + "</robot>"));
  ASSERT_TRUE(draft);
  EXPECT_NE(
      draft->text.find("turns: [wheels_front_left_joint, wheels_front_right_joint, wheels_rear_left_joint, "
                       "wheels_rear_right_joint]"),
      std::string::npos)
      << draft->text;
  EXPECT_EQ(draft->wheels.size(), 4U);
}

// Three held wheels at 120 deg whose links are called drivewhl: each axle points to the middle.
TEST_F(DraftOfHabits, knows_the_short_word_for_a_wheel) {
  std::string parts;
  for (const auto& [number, at] : {std::pair{"1", "xyz='.1 -.1732 0' rpy='0 0 0.523599'"},
                                   {"2", "xyz='-.2 0 0' rpy='0 0 1.570796'"},
                                   {"3", "xyz='.1 .1732 0' rpy='0 0 2.617994'"}}) {
    const std::string name = std::string("drivewhl") + number;
    parts +=
        "<link name='" + name + "'>" + inertial_element("1", "ixx='.002' iyy='.003' izz='.002'") +
        "<collision><origin rpy='1.5707963 0 0'/><geometry><cylinder radius='.08' length='.04'/></geometry>"
        "</collision></link><joint name='" +
        name + "_joint' type='fixed'><parent link='chassis'/><child link='" + name + "'/><origin " + at +
        "/><axis xyz='0 1 0'/></joint>";
  }
  const auto draft =
      this->draft(folder_.write("omni.urdf", "<robot name='r'>" + chassis() + parts + "</robot>"));
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("{joint: drivewhl2_joint, radius: 80 mm, roller: 90 deg}"), std::string::npos)
      << draft->text;
}

// A wheel's hub and tyre are parts of the wheel: they stand where it stands.
TEST_F(DraftOfHabits, takes_held_parts_of_a_wheel_for_no_wheels) {
  std::string parts;
  for (const std::string side : {"left", "right"}) {
    const std::string wheel = side + "_wheel";
    parts += held_part(wheel, "chassis", side == "left" ? "0 .2 0" : "0 -.2 0") +
             held_part(side + "_wheel_hub", wheel, "0 .004 0") +
             held_part(side + "_wheel_tyre", wheel, "0 -.004 0");
  }
  const auto draft =
      this->draft(folder_.write("hubs.urdf", "<robot name='r'>" + chassis() + parts + "</robot>"));
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("turns: [left_wheel_joint, right_wheel_joint]"), std::string::npos)
      << draft->text;
}

// Two sizes of wheels, drawn by meshes: their axles stand 40 mm apart in height, and the ground is level.
TEST_F(DraftOfHabits, tells_how_much_higher_an_axle_of_unknown_radius_is_drawn) {
  const std::regex shape("<collision><origin[^>]*><geometry><cylinder[^>]*></geometry></collision>");
  const std::string meshes =
      std::regex_replace(two_wheels_and(wheel_at("rear_left_wheel", "chassis", "-.3 .2 .04") +
                                        wheel_at("rear_right_wheel", "chassis", "-.3 -.2 .04")),
                         shape, "");
  const auto draft = this->draft(folder_.write("sizes.urdf", meshes));
  ASSERT_TRUE(draft);
  EXPECT_NE(
      draft->text.find("{joint: rear_left_wheel_joint, radius: FILL_IN}  # from the axle to the ground, "
                       "measured; drawn 40 mm higher than the lowest axle"),
      std::string::npos)
      << draft->text;
  EXPECT_NE(draft->text.find("{joint: left_wheel_joint, radius: FILL_IN}\n"), std::string::npos)
      << draft->text;
}

// A belt turns two wheels in line alike, and so does the floor: the motor of one of them drives both.
TEST_F(DraftOfHabits, couples_wheels_in_line_that_mimic) {
  const auto draft =
      this->draft(folder_.write("belts.urdf", four_wheels(follows("front_left"), follows("front_right"))));
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("mimic: {rear_left_joint: coupled, rear_right_joint: coupled}"),
            std::string::npos)
      << draft->text;
  EXPECT_EQ(draft->wheels.size(), 2U);
  EXPECT_EQ(draft->text.find("FILL_IN"), std::string::npos) << "coupled wheels have no rollers";
  EXPECT_EQ(said_of(draft->text), "");
  EXPECT_NE(why_unfit("wall_align", base_fit(*draft)), "");
  // With a motor of its own it cannot be coupled; it can be one of four.
  const std::string both =
      test::replaced(draft->text, "front_left_joint: {}", "front_left_joint: {}\n  rear_left_joint: {}");
  EXPECT_NE(said_of(both).find("E861"), std::string::npos);
  EXPECT_EQ(said_of(test::replaced(both, "rear_left_joint: coupled", "rear_left_joint: ignore")), "");
}

// Half as fast, or across: no floor makes that.
TEST_F(DraftOfHabits, does_not_couple_wheels_that_the_floor_turns_otherwise) {
  for (const std::string& rear : {follows("front_left", "0.5"), follows("front_right")}) {
    const auto draft = this->draft(folder_.write("odd.urdf", four_wheels(rear, follows("front_right"))));
    ASSERT_TRUE(draft);
    EXPECT_NE(draft->text.find("mimic: {rear_left_joint: ignore, rear_right_joint: coupled}"),
              std::string::npos)
        << draft->text;
    const std::string belts = test::replaced(draft->text, "left_joint: ignore", "left_joint: coupled");
    EXPECT_NE(said_of(test::replaced(belts, "  rear_left_joint: {}\n", "")).find("keep"), std::string::npos);
  }
}

// One motor turns both pivots by a linkage. Here two do, and each wheel rolls as the other lets it.
TEST_F(DraftOfHabits, steers_each_pivot_of_a_linkage) {
  const auto pivot = [](const std::string& name, const std::string& y, const std::string& mimic) {
    return "<link name='" + name + "'>" + inertial_element(".5", "ixx='2e-3' iyy='2e-3' izz='2e-3'") +
           "</link><joint name='" + name + "_joint' type='revolute'><parent link='chassis'/><child link='" +
           name + "'/><origin rpy='0 -.09 0' xyz='.3 " + y +
           " 0'/><axis xyz='0 0 1'/><limit lower='-.6' upper='.6' "
           "effort='20' velocity='2'/>" +
           mimic + "</joint>" + wheel_at(name + "_wheel", name, "0 0 0", "");
  };
  const std::string urdf = "<robot name='r'>" + chassis() + pivot("steer_left", ".2", "") +
                           pivot("steer_right", "-.2", "<mimic joint='steer_left_joint'/>") +
                           wheel_at("rear_left", "chassis", "-.2 .2 0") +
                           wheel_at("rear_right", "chassis", "-.2 -.2 0") + "</robot>";
  const auto draft = this->draft(folder_.write("car.urdf", urdf));
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("mimic: {steer_right_joint: ignore}"), std::string::npos) << draft->text;
  EXPECT_EQ(said_of(draft->text).find("error"), std::string::npos) << said_of(draft->text);
  EXPECT_EQ(base_fit(*draft).freedoms, Freedoms::steered);
}

// 20 kg in a box of 1 m above wheels and a ball 0.1 m ahead and behind: a h = g d.
TEST_F(DraftOfHabits, brakes_no_harder_than_what_tips_it) {
  const auto brake = [&](double height) {
    const std::string z = std::to_string(height);
    const std::string urdf =
        "<robot name='r'><link name='base_link'><inertial><origin xyz='0 0 " + z +
        "'/><mass value='20'/><inertia ixx='.3' iyy='.3' izz='.3' ixy='0' ixz='0' iyz='0'/></inertial>"
        "<collision><geometry><box size='.4 .4 .1'/></geometry></collision></link>" +
        wheel_at("left_wheel", "base_link", ".1 .2 .08") +
        wheel_at("right_wheel", "base_link", ".1 -.2 .08") +
        "<link name='caster_ball'/><joint name='b' type='fixed'><parent link='base_link'/><child "
        "link='caster_ball'/><origin xyz='-.1 0 0'/></joint></robot>";
    const auto draft = this->draft(folder_.write("tall.urdf", urdf));
    Diagnostics diagnostics;
    const auto robot = load_robot(folder_.write("robot.yaml", draft->text), diagnostics);
    EXPECT_TRUE(robot) << test::rendered(diagnostics) << draft->text;
    return robot->stop;
  };
  EXPECT_EQ(brake(0.3).deceleration, 1.0);
  // The centre of all 22 kg: (20 z + 2 x 0.08) / 22 up and 0.2 / 22 ahead of the middle.
  const double height = (20.0 * 2.0 + 2.0 * 0.08) / 22.0, tips = 9.81 * (0.1 - 0.2 / 22.0) / height;
  const Stop stop = brake(2.0);
  EXPECT_LE(stop.deceleration, tips);
  EXPECT_GT(stop.deceleration, 0.9 * tips);
  EXPECT_NEAR(stop.force, 22.0 * stop.deceleration, 0.1 * stop.force);
}

// A ball without the name of one, on a joint that is called a caster.
TEST_F(DraftOfHabits, stands_on_the_ball_of_a_joint_that_is_called_a_caster) {
  const std::string parts = wheel_at("left_wheel", "chassis", ".1 .2 0") +
                            wheel_at("right_wheel", "chassis", ".1 -.2 0") +
                            "<link name='rear_link'><collision><geometry><sphere radius='.015'/></geometry>"
                            "</collision></link><joint name='rear_castor_joint' type='fixed'><parent "
                            "link='chassis'/><child link='rear_link'/><origin xyz='-.13 0 0'/></joint>";
  const auto draft =
      this->draft(folder_.write("ball.urdf", "<robot name='r'>" + chassis() + parts + "</robot>"));
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->supports, std::vector<std::string>{"rear_link"});
}

// SDF and Gazebo write -1 for no limit: nobody says how strong the motor is.
TEST_F(DraftOfHabits, asks_for_an_effort_of_minus_one) {
  const auto with_effort = [](const std::string& effort) {
    return std::regex_replace(two_wheels_and(""), std::regex("effort='8' velocity='9'"),
                              "effort='" + effort + "' velocity='-1'");
  };
  const auto draft = this->draft(folder_.write("minus.urdf", with_effort("-1.0")));
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("each_wheel: {effort: FILL_IN}"), std::string::npos) << draft->text;
  Diagnostics diagnostics;
  EXPECT_FALSE(draft_robot(folder_.write("minus.urdf", with_effort("-2")), "minus.urdf", diagnostics));
  EXPECT_NE(test::rendered(diagnostics).find("E859"), std::string::npos);
}

/// Two wheels of `chassis` that roll along y, and a ball behind.
std::string sideways(const std::string& base) {
  std::string text = "<robot name='r'>" + chassis() + wheel_at("left_wheel", "chassis", "-.22 0 0") +
                     wheel_at("right_wheel", "chassis", ".22 0 0") +
                     "<link name='caster_ball'/><joint name='b' type='fixed'><parent link='chassis'/><child "
                     "link='caster_ball'/><origin xyz='0 -.25 -.08'/></joint></robot>";
  text = std::regex_replace(text, std::regex("axis xyz='0 1 0'"), "axis xyz='1 0 0'");
  text = std::regex_replace(text, std::regex("rpy='1.5707963 0 0'"), "rpy='0 1.5707963 0'");
  text = std::regex_replace(text, std::regex("size='.6 .4 .1'"), "size='.4 .6 .1'");
  // Above the axle the mass would lie on the edge of what carries it.
  text = std::regex_replace(text, std::regex("<mass value='20'/>"),
                            "<origin xyz='0 -.02 0'/><mass value='20'/>");
  return std::regex_replace(text, std::regex("chassis"), base);
}

// Of a base whose y is ahead tasks see a turned one.
TEST_F(DraftOfHabits, turns_the_base_that_rolls_along_y) {
  for (const auto& [link, name] : {std::pair{"base_link", "base"}, {"base", "ahead"}}) {
    const auto draft = this->draft(folder_.write("sideways.urdf", sideways(link)));
    ASSERT_TRUE(draft);
    const std::string parent = std::string(": {parent: ") + link;
    EXPECT_NE(draft->text.find(name + parent + ", at: [0 m, 0 m], yaw: 90 deg}"), std::string::npos)
        << draft->text;
    EXPECT_NE(draft->text.find("nose" + parent + ", at: [0 m, 0.3 m], yaw: 90 deg}"), std::string::npos);
    EXPECT_NE(draft->text.find("hook" + parent + ", at: [0 m, -0.3 m], yaw: -90 deg}"), std::string::npos);
    EXPECT_EQ(said_of(draft->text), "");
    Diagnostics diagnostics;
    const auto robot = load_robot(folder_.write("robot.yaml", draft->text), diagnostics);
    ASSERT_TRUE(robot);
    for (const BaseFit& fit : {base_fit(*draft), base_fit(*robot)}) {
      EXPECT_EQ(fit.freedoms, Freedoms::two);
      EXPECT_EQ(fit.base, name);
      EXPECT_NEAR(fit.heading, std::numbers::pi / 2.0, 1e-9);
      EXPECT_NEAR(fit.front_lever, 0.2, 1e-9);
      EXPECT_EQ(why_unfit("wall_align", fit), "");
    }
  }
}

// The point that helps lies where the wheels roll to, not along x.
TEST_F(DraftOfHabits, of_a_base_that_rolls_along_y_is_told_of_a_point_ahead) {
  const auto draft = this->draft(folder_.write("sideways.urdf", sideways("base_link")));
  ASSERT_TRUE(draft);
  folder_.write("robot.yaml", draft->text);
  const auto task = folder_.write(
      "task.yaml",
      "zwang: 1\nrobot: robot.yaml\nstart: go\ntasks:\n  go:\n    constraints: {go: {move: base_link, in: "
      "base_link, x: {velocity: 0.1 m/s}}}\n    timeout: {after: 1 s, goto: done}\n");
  Diagnostics diagnostics;
  EXPECT_FALSE(load(task, {}, diagnostics));
  EXPECT_NE(test::rendered(diagnostics).find("`nose: {parent: base_link, at: [0 m, 0.3 m], yaw: 90 deg}`"),
            std::string::npos)
      << test::rendered(diagnostics);
}

// A joint moves between its limits, whichever stands first.
TEST_F(DraftOfHabits, takes_limits_in_the_wrong_order_for_the_travel_between_them) {
  const std::string blade = "<link name='blade'>" + inertial_element("1", "ixx='.01' iyy='.01' izz='.01'") +
                            "</link><joint name='tilt' type='revolute'><parent link='chassis'/><child "
                            "link='blade'/><axis xyz='0 1 0'/><limit lower='0' upper='-0.5' effort='9' "
                            "velocity='1'/></joint>";
  const auto draft = this->draft(folder_.write("blade.urdf", two_wheels_and(blade)));
  ASSERT_TRUE(draft);
  Diagnostics diagnostics;
  const auto robot = load_robot(folder_.write("robot.yaml", draft->text), diagnostics);
  ASSERT_TRUE(robot) << test::rendered(diagnostics);
  const solver::Joint& tilt = robot->model.joint(*robot->model.find_joint("tilt"));
  EXPECT_EQ(tilt.lower, -0.5);
  EXPECT_EQ(tilt.upper, 0.0);
  EXPECT_NE(test::rendered(diagnostics).find("W876"), std::string::npos) << test::rendered(diagnostics);
}

/// Two steered wheels of 1 kg ahead of two that roll, `moments` about each axis.
std::string steered_with(const std::string& moments) {
  std::string text = "<robot name='r'>" + chassis() + wheel_at("rear_left_wheel", "chassis", "-.2 .2 0") +
                     wheel_at("rear_right_wheel", "chassis", "-.2 -.2 0");
  for (const auto& [side, y] : {std::pair{"left", ".2"}, {"right", "-.2"}}) {
    const std::string fork = std::string("fork_") + side;
    text += "<link name='" + fork + "'>" + inertial_element(".01", "ixx='1e-5' iyy='1e-5' izz='1e-5'") +
            "</link><joint name='steer_" + side + "' type='revolute'><parent link='chassis'/><child link='" +
            fork + "'/><origin xyz='.2 " + y +
            " 0'/><axis xyz='0 0 1'/><limit lower='-.5' upper='.5' effort='5' velocity='2'/></joint>" +
            std::regex_replace(wheel_at(std::string("front_") + side, fork, "0 0 0"),
                               std::regex("ixx='.002' iyy='.003' izz='.002'"), moments);
  }
  return text + "</robot>";
}

// 1 kg m^2 of a wheel of 1 kg and 80 mm is a simulator's: under `inertias` the wheel counts as a disc, and no
// rotor is as heavy as that. 24.02 kg x 9.81 m/s^2 x 0.08 m / 4 / 150 rad/s^2 = 0.0314 kg m^2.
TEST_F(DraftOfHabits, a_steering_has_the_rotor_of_a_wheel_that_can_be) {
  const auto draft = this->draft(folder_.write("steer.urdf", steered_with("ixx='1' iyy='1' izz='1'")));
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("front_left: {}"), std::string::npos) << draft->text;
  EXPECT_NE(draft->text.find("steer_left: {rotor_inertia: 0.032 kg m^2}"), std::string::npos) << draft->text;
}

// Planners' files move the whole robot on rails, and have no wheels.
TEST_F(DraftOfHabits, tells_rails_that_stand_for_wheels) {
  const std::string link = inertial_element("1", "ixx='.1' iyy='.1' izz='.1'");
  const std::string urdf = "<robot name='r'><link name='world'/><link name='along'>" + link + "</link>" +
                           chassis() + joint_between("slide_x", "prismatic", "world", "along") +
                           joint_between("slide_y", "prismatic", "along", "chassis") + "</robot>";
  const auto draft = this->draft(folder_.write("rails.urdf", urdf));
  ASSERT_TRUE(draft);
  ASSERT_EQ(draft->stuck.size(), 2U) << draft->text;
  EXPECT_EQ(draft->stuck.front().joint, "slide_x");
  EXPECT_EQ(draft->stuck.front().how, "a rail that moves the whole robot");
}

}  // namespace
}  // namespace zwang::lang
