// Wheels that a URDF holds: simulators that push a base about draw them so. The robot file lets them turn.
#include <gtest/gtest.h>

#include <regex>

#include "drafted.hpp"
#include "robot/urdf.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/lang/robot_update.hpp"
#include "zwang/lang/task_draft.hpp"

namespace zwang::lang {
namespace {

const std::string held_chassis =
    "<link name='chassis'><inertial><mass value='20'/><inertia ixx='.3' iyy='.5' izz='.6' ixy='0' ixz='0' "
    "iyz='0'/></inertial><collision><geometry><box size='.6 .4 .1'/></geometry></collision></link>";

const std::string held_disc =
    "<inertial><mass value='1'/><inertia ixx='.002' iyy='.003' izz='.002' ixy='0' ixz='0' "
    "iyz='0'/></inertial>";
const std::string held_tyre =
    "<collision><origin rpy='1.5707963 0 0'/><geometry><cylinder radius='.08' length='.04'/></geometry>"
    "</collision>";

/// A link with a joint of its name, of type `type`, with `more` in it.
std::string held_part(const std::string& name, const std::string& parent, const std::string& xyz,
                      const std::string& type, const std::string& body, const std::string& more) {
  return "<link name='" + name + "'>" + body + "</link><joint name='" + name + "_joint' type='" + type +
         "'><parent link='" + parent + "'/><child link='" + name + "'/><origin xyz='" + xyz + "'/>" + more +
         "</joint>";
}

const std::string held_limit = "<limit effort='8' velocity='9' lower='-3' upper='3'/>";

std::string held_wheels(const std::string& type, const std::string& axis,
                        const std::string& shape = held_tyre) {
  return "<robot name='r'>" + held_chassis +
         held_part("left_wheel", "chassis", "0 .2 0", type, held_disc + shape, axis + held_limit) +
         held_part("right_wheel", "chassis", "0 -.2 0", type, held_disc + shape, axis + held_limit) +
         "</robot>";
}

class TurnedJoints : public testing::Test {
 protected:
  RobotDraft draft(const std::string& urdf) { return test::drafted(folder_, urdf); }
  std::optional<Robot> robot(const std::string& text) {
    diagnostics_ = Diagnostics();
    return load_robot(folder_.write("r.yaml", text), diagnostics_);
  }

  test::Folder folder_;
  Diagnostics diagnostics_;
};

// Each way to hold a wheel drafts the differential base that the same URDF is with `continuous` joints. The
// radius, the torques and the freedoms of the base are the same.
TEST_F(TurnedJoints, wheels_that_are_held_are_drafted_as_if_they_turned) {
  const RobotDraft free = draft(held_wheels("continuous", "<axis xyz='0 1 0'/>"));
  ASSERT_EQ(free.text.find("turns:"), std::string::npos) << free.text;
  for (const std::string& urdf :
       {held_wheels("fixed", "<axis xyz='0 1 0'/>"), held_wheels("revolute", "<axis xyz='0 1 0'/>"),
        held_wheels("fixed", ""), held_wheels("fixed", "<axis xyz='0 0 0'/>")}) {
    const RobotDraft held = draft(urdf);
    EXPECT_NE(held.text.find("turns: [left_wheel_joint, right_wheel_joint]"), std::string::npos) << held.text;
    EXPECT_EQ(held.drive, free.drive);
    const auto robot = this->robot(held.text);
    ASSERT_TRUE(robot) << test::rendered(diagnostics_) << held.text;
    EXPECT_EQ(base_fit(*robot).freedoms, Freedoms::two);
    ASSERT_EQ(robot->model.wheels().size(), 2U);
    for (const solver::Wheel& wheel : robot->model.wheels()) {
      EXPECT_NEAR(wheel.radius, 0.08, 1e-6);
      EXPECT_EQ(robot->model.joint(wheel.body - 1).max_effort, 8.0);
    }
  }
}

// Meshes without an <axis>: the axle is the base's y, in a frame that exporters turn by 90 deg.
TEST_F(TurnedJoints, a_wheel_of_which_nothing_tells_the_axle_rolls_ahead) {
  const std::string urdf =
      std::regex_replace(held_wheels("fixed", "", ""), std::regex("<origin xyz='([^']*)'/>"),
                         "<origin xyz='$1' rpy='1.5707963 0 0'/>");
  const RobotDraft held = draft(urdf);
  const auto robot = this->robot(test::replaced(held.text, "radius: FILL_IN", "radius: 80 mm"));
  ASSERT_TRUE(robot) << test::rendered(diagnostics_) << held.text;
  EXPECT_EQ(base_fit(*robot).freedoms, Freedoms::two) << held.text;
}

// A fixed joint that is drawn with an upright axis and carries one wheel is a swivel.
TEST_F(TurnedJoints, swivels_between_a_held_wheel_and_the_base_turn_too) {
  std::string parts;
  for (const auto& [name, xyz] : {std::pair{"fl", "'.2 .15 0'"},
                                  {"fr", "'.2 -.15 0'"},
                                  {"bl", "'-.2 .15 0'"},
                                  {"br", "'-.2 -.15 0'"}}) {
    const std::string at = std::string(xyz).substr(1, std::string(xyz).size() - 2), n = name;
    parts += held_part(n + "_head", "chassis", at, "fixed", held_disc, "<axis xyz='0 0 -1'/>") +
             held_part(n + "_wheel", n + "_head", "-.04 0 0", "fixed", held_disc + held_tyre,
                       "<axis xyz='0 1 0'/>" + held_limit);
  }
  const RobotDraft held = draft("<robot name='r'>" + held_chassis + parts + "</robot>");
  ASSERT_EQ(held.wheels.size(), 4U) << held.text;
  for (const DraftWheel& wheel : held.wheels) {
    EXPECT_EQ(wheel.swivel, wheel.joint.substr(0, 2) + "_head_joint");
    EXPECT_NEAR(wheel.trail, 0.04, 1e-9);
  }
}

// Beside wheels that turn a held one is a caster's, or a cover: it is named, and stays as it is.
TEST_F(TurnedJoints, beside_wheels_that_turn_a_held_one_is_only_named) {
  std::string urdf = held_wheels("continuous", "<axis xyz='0 1 0'/>");
  urdf.insert(urdf.find("</robot>"),
              held_part("rear_wheel", "chassis", "-.25 0 0", "fixed", held_disc + held_tyre, ""));
  const std::string text = draft(urdf).text;
  EXPECT_EQ(text.find("\nturns:"), std::string::npos) << text;
  EXPECT_NE(text.find("`rear_wheel_joint` is not here"), std::string::npos) << text;
}

// Vendors leave a template's 1 0 0 at joints that they never turn. A swivel whose axis is its wheel's axle
// steers nothing. Held and free, the base has four steered wheels, and each rolls ahead.
TEST_F(TurnedJoints, a_swivel_with_the_axle_of_its_wheel_has_no_axis) {
  const std::string ball = "<collision><geometry><sphere radius='.05'/></geometry></collision>";
  for (const char* type : {"fixed", "continuous"}) {
    std::string parts;
    for (const auto& [name, xyz] : {std::pair{"fl", ".24 .23 .12"},
                                    {"fr", ".24 -.23 .12"},
                                    {"bl", "-.24 .23 .12"},
                                    {"br", "-.24 -.23 .12"}}) {
      const std::string caster = "caster_" + std::string(name);
      parts += held_part(caster, "chassis", xyz, type, held_disc, "<axis xyz='1 0 0'/>") +
               held_part("wheel_" + std::string(name), caster, "0 0 -.07", type, held_disc + ball,
                         "<axis xyz='1 0 0'/>");
    }
    const RobotDraft drawn = draft("<robot name='r'>" + held_chassis + parts + "</robot>");
    ASSERT_EQ(drawn.wheels.size(), 4U) << drawn.text;
    for (const DraftWheel& wheel : drawn.wheels) {
      EXPECT_EQ(wheel.swivel, "caster_" + wheel.link.substr(6) + "_joint") << drawn.text;
      EXPECT_NEAR(std::abs(wheel.axle.y()), 1.0, 1e-9) << drawn.text;
    }
    EXPECT_EQ(drawn.heading, 0.0) << drawn.text;
  }
}

// Nobody has seen a fixed joint turn: where all wheels would roll sideways, the template's axis is not meant.
TEST_F(TurnedJoints, held_wheels_that_all_roll_sideways_have_no_axis) {
  const RobotDraft held = draft(held_wheels("fixed", "<axis xyz='1 0 0'/>", ""));
  ASSERT_EQ(held.wheels.size(), 2U) << held.text;
  for (const DraftWheel& wheel : held.wheels) EXPECT_NEAR(wheel.axle.y(), 1.0, 1e-9) << held.text;
  // A wheel that turns is as the file says: such a base drives along y.
  for (const DraftWheel& wheel : draft(held_wheels("continuous", "<axis xyz='1 0 0'/>", "")).wheels)
    EXPECT_NEAR(std::abs(wheel.axle.x()), 1.0, 1e-9);
}

// A car that is drawn to be looked at: only the front wheels turn, below hinges that are fixed.
TEST_F(TurnedJoints, a_held_axle_beside_wheels_that_turn_makes_a_car) {
  std::string parts;
  for (const auto& [name, y] : {std::pair{"left", ".12"}, {"right", "-.12"}}) {
    const std::string side = name, at = y;
    parts += held_part("back_" + side + "_wheel", "chassis", "0 " + at + " .08", "fixed",
                       held_disc + held_tyre, "") +
             held_part("front_" + side + "_hinge", "chassis", ".33 " + at + " .08", "fixed", "", "") +
             held_part("front_" + side + "_wheel", "front_" + side + "_hinge", "0 0 0", "continuous",
                       held_disc + held_tyre, "");
  }
  const RobotDraft car = draft("<robot name='r'>" + held_chassis + parts + "</robot>");
  EXPECT_EQ(car.drive, "as a car: 2 of 4 wheels steer") << car.text;
  for (const DraftWheel& wheel : car.wheels) {
    const bool is_front = wheel.joint.starts_with("front");
    EXPECT_EQ(wheel.swivel,
              is_front ? wheel.joint.substr(0, wheel.joint.find("_wheel")) + "_hinge_joint" : "");
    EXPECT_NEAR(std::abs(wheel.axle.y()), 1.0, 1e-9);
    EXPECT_NEAR(wheel.radius.value_or(0.0), 0.08, 1e-9);
  }
  const std::string filled = std::regex_replace(car.text, std::regex("effort: FILL_IN"), "effort: 2 N m");
  const auto robot = this->robot(std::regex_replace(filled, std::regex("mass: FILL_IN"), "mass: 0.1 kg"));
  ASSERT_TRUE(robot) << test::rendered(diagnostics_) << car.text;
  EXPECT_EQ(robot->model.wheels().size(), 4U);
}

// `<insert_block>` without its prefix: a newer xacro leaves it, and each joint loses its place.
TEST_F(TurnedJoints, an_old_macro_that_was_left_is_told) {
  const std::string urdf =
      std::regex_replace(held_wheels("continuous", "<axis xyz='0 1 0'/>"),
                         std::regex("<origin xyz='0 .2 0'/>"), "<insert_block name='origin'/>");
  Diagnostics diagnostics;
  EXPECT_FALSE(draft_robot(folder_.write("r.urdf", urdf), "r.urdf", diagnostics));
  EXPECT_EQ(test::count(diagnostics, "E855"), 1) << test::rendered(diagnostics);
}

TEST_F(TurnedJoints, an_update_keeps_them_turning) {
  const std::string text = draft(held_wheels("fixed", "<axis xyz='0 1 0'/>")).text;
  const std::filesystem::path file = folder_.write("r.yaml", text);
  Diagnostics diagnostics;
  const auto options = options_of(file, diagnostics);
  ASSERT_TRUE(options);
  const auto again = draft_robot(folder_.path() / "r.urdf", "r.urdf", diagnostics, *options);
  ASSERT_TRUE(again) << test::rendered(diagnostics);
  const auto update = update_robot_file(file, folder_.path() / "r.urdf", *again, diagnostics);
  ASSERT_TRUE(update) << test::rendered(diagnostics);
  EXPECT_EQ(update->text, text);
}

TEST_F(TurnedJoints, a_name_that_the_urdf_lacks_is_told) {
  const std::string text = draft(held_wheels("fixed", "<axis xyz='0 1 0'/>")).text;
  EXPECT_FALSE(robot(test::replaced(text, "turns: [left_wheel_joint", "turns: [left_weel_joint")));
  EXPECT_NE(test::rendered(diagnostics_).find("`left_wheel_joint`"), std::string::npos)
      << test::rendered(diagnostics_);
}

}  // namespace
}  // namespace zwang::lang
