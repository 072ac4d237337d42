// Robot files drafted from URDFs: refused while something is open, good once it is filled in.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "robot/urdf.hpp"
#include "support.hpp"
#include "zwang/lang/format.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/lang/task_draft.hpp"

namespace zwang::lang {
namespace {

const std::filesystem::path real = test::source_dir / "../shared/robots";

/// The text that a user would write in the open places.
std::string filled(std::string text) {
  const std::pair<const char*, const char*> values[] = {
      {"radius: FILL_IN", "radius: 60 mm"},
      {"kind: FILL_IN", "kind: skid"},
      {"effort: FILL_IN", "effort: 5 N m"},
      {"deceleration: FILL_IN", "deceleration: 1 m/s^2"},
      {"force: FILL_IN", "force: 50 N"},
      {"polygon: FILL_IN", "polygon: [[0.3 m, 0.2 m], [-0.3 m, 0.2 m], [-0.3 m, -0.2 m], [0.3 m, -0.2 m]]"}};
  for (const auto& [open, value] : values) text = std::regex_replace(text, std::regex(open), value);
  return text;
}

class Draft : public testing::Test {
 protected:
  std::optional<RobotDraft> draft(const std::filesystem::path& urdf) {
    std::optional<RobotDraft> draft = draft_robot(urdf, urdf.filename().string(), diagnostics_);
    EXPECT_TRUE(draft) << test::rendered(diagnostics_);
    folder_.write(urdf.filename().string(), test::slurp(urdf));
    return draft;
  }
  std::optional<RobotDraft> real_draft(const std::string& name) { return draft(real / (name + ".urdf")); }

  std::string said_of(const std::string& text) {
    Diagnostics diagnostics;
    const bool is_good = load_robot(folder_.write("robot.yaml", text), diagnostics).has_value();
    EXPECT_EQ(is_good, !diagnostics.has_errors());
    return test::rendered(diagnostics);
  }

  void expect_refused_until_filled(const RobotDraft& draft) {
    const bool is_open = draft.text.find(": FILL_IN") != std::string::npos;
    EXPECT_EQ(said_of(draft.text).find("FILL_IN") != std::string::npos, is_open) << draft.text;
    EXPECT_EQ(said_of(filled(draft.text)).find("error"), std::string::npos) << filled(draft.text);
    Diagnostics diagnostics;
    EXPECT_EQ(format_file(folder_.write("robot.yaml", draft.text), diagnostics), draft.text) << "laid out";
  }

  test::Folder folder_;
  Diagnostics diagnostics_;
};

// The posture by hand, specs/robots/mecanum_arm_folded.yaml, has nothing beyond the outline either. A motor
// that holds half of what it can has the other half for motion.
TEST_F(Draft, folds_an_arm_above_the_outline) {
  const auto draft = this->draft(test::source_dir / "specs/robots/mecanum_arm_base.urdf");
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->arm_reach, 0.0);
  Diagnostics diagnostics;
  const auto robot = load_robot(folder_.write("robot.yaml", filled(draft->text)), diagnostics);
  ASSERT_TRUE(robot) << test::rendered(diagnostics) << draft->text;
  const BaseFit fit = base_fit(*robot);
  EXPECT_EQ(fit.arm_reach, 0.0);
  EXPECT_EQ(fit.arm_ahead, 0.0);
  for (int j = 0; j < robot->model.joint_count(); ++j) {
    const solver::Joint& joint = robot->model.joint(j);
    EXPECT_GE(robot->posture(j), joint.lower) << joint.name;
    EXPECT_LE(robot->posture(j), joint.upper) << joint.name;
  }
}

class RealDraft : public Draft {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(real)) GTEST_SKIP() << real << " is not here";
  }
};

TEST_F(Draft, of_the_shipped_urdf_has_its_wheels) {
  const auto draft = this->draft(test::source_dir / "specs/robots/mecanum_base.urdf");
  ASSERT_TRUE(draft);
  ASSERT_EQ(draft->wheels.size(), 4U);
  for (const DraftWheel& wheel : draft->wheels) {
    ASSERT_TRUE(wheel.radius) << wheel.joint;
    EXPECT_NEAR(*wheel.radius, 0.0759, 1e-9);
    EXPECT_TRUE(wheel.effort);
  }
  // A URDF does not tell rollers: both readings are shown.
  ASSERT_EQ(draft->assumed.size(), 2U);
  expect_refused_until_filled(*draft);
}

struct Parts {
  std::set<std::string> wheels, motors;
};

Parts parts_of(const Robot& robot) {
  Parts parts;
  for (const solver::Wheel& wheel : robot.model.wheels())
    parts.wheels.insert(robot.model.joint(wheel.body - 1).name);
  for (int j = 0; j < robot.model.joint_count(); ++j) {
    if (robot.model.joint(j).actuated) parts.motors.insert(robot.model.joint(j).name);
  }
  return parts;
}

// The shipped robot files were written by hand.
TEST_F(Draft, of_shipped_robots_has_the_wheels_and_motors_of_their_files) {
  for (const char* name : {"car_base", "diff_base", "kelo_base", "kelo_two_base", "omni_base", "skid_base",
                           "swerve_base", "tricycle_base"}) {
    const std::filesystem::path robots = test::source_dir / "specs/robots";
    const auto draft = this->draft(robots / (std::string(name) + ".urdf"));
    ASSERT_TRUE(draft) << name;
    Diagnostics diagnostics;
    const auto drafted = load_robot(folder_.write("robot.yaml", filled(draft->text)), diagnostics);
    const auto by_hand = load_robot(robots / (std::string(name) + ".yaml"), diagnostics);
    ASSERT_TRUE(drafted && by_hand) << name << test::rendered(diagnostics);
    EXPECT_EQ(parts_of(*drafted).wheels, parts_of(*by_hand).wheels) << draft->text;
    EXPECT_EQ(parts_of(*drafted).motors, parts_of(*by_hand).motors) << draft->text;
  }
}

TEST_F(Draft, of_a_smaller_urdf_takes_its_efforts) {
  const auto draft = this->draft(test::source_dir / "tests/conformance/robots/mini.urdf");
  ASSERT_TRUE(draft);
  // No joint is called a wheel and no link is round: left and right stand beside each other.
  ASSERT_EQ(draft->wheels.size(), 2U);
  EXPECT_EQ(draft->wheels[0].effort, 5.0);
  EXPECT_FALSE(draft->wheels[0].radius);
}

TEST_F(RealDraft, finds_two_wheels_and_what_only_supports) {
  const auto turtlebot = real_draft("turtlebot3_burger");
  ASSERT_TRUE(turtlebot);
  ASSERT_EQ(turtlebot->wheels.size(), 2U);
  EXPECT_EQ(turtlebot->wheels[0].radius, 0.033);
  EXPECT_EQ(turtlebot->supports, std::vector<std::string>{"caster_back_link"});
  EXPECT_EQ(turtlebot->base, "base_link");

  const auto mir = real_draft("mir100");
  ASSERT_TRUE(mir);
  EXPECT_EQ(mir->wheels.size(), 2U);
  EXPECT_EQ(mir->casters.size(), 4U);  // wheels that nobody drives
  EXPECT_TRUE(mir->supports.empty());

  const auto fetch = real_draft("fetch");
  ASSERT_TRUE(fetch);
  EXPECT_EQ(fetch->wheels.size(), 2U);
  for (const DraftWheel& wheel : fetch->wheels) EXPECT_FALSE(wheel.radius) << "its shape is a mesh";
}

TEST_F(RealDraft, finds_driven_wheels_on_swivels) {
  for (const char* name : {"robile_4wheel", "eddie"}) {
    const auto draft = real_draft(name);
    ASSERT_TRUE(draft) << name;
    EXPECT_EQ(draft->wheels.size(), 8U) << name;
    EXPECT_EQ(draft->drive, "4 swivels with two driven wheels each") << name;
    for (const DraftWheel& wheel : draft->wheels) EXPECT_FALSE(wheel.swivel.empty()) << name;
  }
}

TEST_F(RealDraft, cannot_tell_mecanum_from_skid) {
  for (const char* name : {"panther", "panther_mecanum", "ridgeback"}) {
    const auto draft = real_draft(name);
    ASSERT_TRUE(draft) << name;
    EXPECT_EQ(draft->wheels.size(), 4U) << name;
    EXPECT_EQ(draft->assumed.size(), 2U) << name;
    EXPECT_NE(draft->text.find("each_wheel: {kind: FILL_IN"), std::string::npos) << name;
  }
}

// All but the one that holds macros. No body can have the inertia of TIAGo's first arm link; its base comes
// to one.
TEST_F(RealDraft, comes_to_a_model_for_every_robot) {
  int drafted = 0;
  for (const auto& file : std::filesystem::directory_iterator(real)) {
    if (file.path().extension() != ".urdf" || file.path().stem() == "husky_bullet") continue;
    const auto draft = this->draft(file.path());
    ASSERT_TRUE(draft) << file.path();
    EXPECT_FALSE(draft->assumed.empty()) << file.path();
    ++drafted;
  }
  EXPECT_GE(drafted, 18);
}

TEST_F(RealDraft, is_refused_until_filled_and_good_then) {
  for (const char* name :
       {"turtlebot3_burger", "diffbot", "mir100", "panther", "panther_mecanum", "robile_4wheel"}) {
    const auto draft = real_draft(name);
    ASSERT_TRUE(draft) << name;
    expect_refused_until_filled(*draft);
  }
}

// Rockers, wheel drops, suspensions: they carry wheels and do not steer them.
TEST_F(RealDraft, holds_what_carries_wheels) {
  for (const auto& [name, held] : {std::pair{"ridgeback", "fixed: [front_rocker]"},
                                   {"create3", "fixed: [wheel_drop_left_joint, wheel_drop_right_joint]"},
                                   {"pmb2", "fixed: [suspension_right_joint, suspension_left_joint]"}}) {
    const auto draft = real_draft(name);
    ASSERT_TRUE(draft) << name;
    EXPECT_NE(draft->text.find(held), std::string::npos) << draft->text;
    EXPECT_EQ(said_of(filled(draft->text)).find("error"), std::string::npos) << said_of(filled(draft->text));
  }
}

TEST_F(RealDraft, gives_casters_no_motor) {
  const auto draft = real_draft("pmb2");
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->wheels.size(), 2U);
  EXPECT_EQ(draft->casters.size(), 4U);
  EXPECT_EQ(draft->text.find("caster", draft->text.find("actuated:")), std::string::npos) << draft->text;
}

TEST_F(RealDraft, proposes_rollers_where_axles_point_different_ways) {
  const auto draft = real_draft("robotino");
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("roller: 90 deg"), std::string::npos) << draft->text;
  ASSERT_EQ(draft->assumed.size(), 1U);
}

TEST_F(RealDraft, takes_revolute_wheels_of_a_simulator_for_wheels) {
  const auto draft = real_draft("mp_400");  // limits of 1e16
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->wheels.size(), 2U);
}

// A circle of 0.164 m drawn from outside, 1 / cos(180 deg / 16) larger.
TEST_F(RealDraft, proposes_the_outline_of_what_collides) {
  const auto draft = real_draft("create3");
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("[0.167 m, 0 m]"), std::string::npos) << draft->text;
}

// Wheels and swivels of 1 kg without inertia: they get bodies, and the URDF stays as it is.
TEST_F(RealDraft, gives_bodies_to_links_without_inertia) {
  const auto draft = real_draft("eddie");
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("eddie_front_left_struct_link: {radius: 50 mm}"), std::string::npos)
      << draft->text;
  EXPECT_NE(draft->text.find("eddie_front_left_left_wheel_link: {}"), std::string::npos) << draft->text;
  EXPECT_EQ(said_of(filled(draft->text)).find("error"), std::string::npos) << said_of(filled(draft->text));
}

// 1 kg m^2 for a wheel of 10 mg, and 0.09 kg m^2 for one of 10 kg and 51.5 mm: more than on its rim.
TEST_F(RealDraft, gives_discs_to_wheels_that_no_mass_can_turn_so_hard) {
  for (const char* name : {"robile_4wheel", "robotino"}) {
    const auto draft = real_draft(name);
    ASSERT_TRUE(draft) << name;
    EXPECT_EQ(said_of(filled(draft->text)).find("W870"), std::string::npos) << said_of(filled(draft->text));
  }
}

// At 0 the arms of Fetch, TIAGo and Eddie reach 1 m ahead, and would touch a wall before the base does.
TEST_F(RealDraft, folds_arms) {
  for (const char* name : {"fetch", "tiago", "eddie"}) {
    const auto draft = real_draft(name);
    ASSERT_TRUE(draft) << name;
    EXPECT_NE(draft->text.find("\nposture:\n"), std::string::npos) << name;
    EXPECT_LT(draft->arm_reach, 0.5) << name;
    Diagnostics diagnostics;
    const auto robot = load_robot(folder_.write("robot.yaml", filled(draft->text)), diagnostics);
    ASSERT_TRUE(robot) << name << test::rendered(diagnostics);
    EXPECT_EQ(why_unfit("wall_align", base_fit(*robot)), "") << name << draft->text;
  }
}

TEST_F(RealDraft, asks_for_at_most_eight_values) {
  for (const auto& file : std::filesystem::directory_iterator(real)) {
    if (file.path().extension() != ".urdf" || file.path().stem() == "husky_bullet") continue;
    const auto draft = this->draft(file.path());
    ASSERT_TRUE(draft) << file.path();
    int open = 0;
    for (std::size_t at = 0; (at = draft->text.find(": FILL_IN", at)) != std::string::npos; ++at) ++open;
    EXPECT_LE(open, 8) << file.path();
    EXPECT_EQ(said_of(filled(draft->text)).find("error"), std::string::npos)
        << file.path() << said_of(filled(draft->text));
  }
}

// By the sum of torque over radius: MP-400 2 x 1000 N m / 75 mm, the others 3.7 to 1200 times their weight.
// Panther's 64.5 N m are its motors': on its small wheels, 2539 N, they are more than the floor takes up; on
// its tyres not.
TEST_F(RealDraft, is_told_of_torques_of_a_simulator) {
  std::set<std::string> told;
  for (const auto& file : std::filesystem::directory_iterator(real)) {
    if (file.path().extension() != ".urdf" || file.path().stem() == "husky_bullet") continue;
    const auto draft = this->draft(file.path());
    ASSERT_TRUE(draft) << file.path();
    if (said_of(filled(draft->text)).find("W872") != std::string::npos) told.insert(file.path().stem());
  }
  EXPECT_EQ(told, (std::set<std::string>{"diffbot", "mir100", "mp_400", "panther_mecanum", "summit_xl"}));
}

TEST_F(RealDraft, of_an_unexpanded_macro_is_refused) {
  EXPECT_FALSE(draft_robot(real / "husky_bullet.urdf", "husky_bullet.urdf", diagnostics_));
  EXPECT_EQ(diagnostics_.all().at(0).code, "E855");
}

}  // namespace
}  // namespace zwang::lang
