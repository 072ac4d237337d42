// Masses and inertias that URDFs have by habit, and what the drafted robot file makes of them.
#include <algorithm>
#include <regex>

#include "draft_of_habits.hpp"

namespace zwang::lang {
namespace {

/// Fixed to `chassis`, with the inertial element of a frame that something is seen from.
std::string seen_from(const std::string& name, const std::string& inertial) {
  return "<link name='" + name + "'>" + inertial + "</link><joint name='" + name +
         "_joint' type='fixed'><parent link='chassis'/><child link='" + name + "'/></joint>";
}

// 1e-10 kg of an optical frame count as none, which is told once for all. A number that no robot has is a
// slip.
TEST_F(DraftOfHabits, takes_a_mass_of_dust_for_none) {
  const auto frames = [](const std::string& mass) {
    const std::string inertial = inertial_element(mass, "ixx='1e-10' iyy='1e-10' izz='1e-10'");
    return two_wheels_and(seen_from("left_eye", inertial) + seen_from("right_eye", inertial));
  };
  const auto draft = this->draft(folder_.write("eyes.urdf", frames("1e-10")));
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->assumed.size(), 1U);
  const std::string said = said_of(draft->text);
  EXPECT_NE(said.find("warning W863: link `left_eye` has 1e-10 kg, less than a grain of dust: it counts as "
                      "none; so it is with 1 more"),
            std::string::npos)
      << said;
  EXPECT_EQ(said.find("right_eye"), std::string::npos) << said;
  Diagnostics diagnostics;
  EXPECT_FALSE(draft_robot(folder_.write("slip.urdf", frames("1e-310")), "slip.urdf", diagnostics));
  EXPECT_NE(test::rendered(diagnostics).find("E858"), std::string::npos);
}

// A plate of 20 kg and .6 m x .4 m x .1 m: .5 kg m^2 about x and y, and 5 about z, which no body has. The box
// has m (a^2 + b^2 + c^2) / 18 in the mean, a ball 2/5 m r^2: r = 271.3 mm.
TEST_F(DraftOfHabits, gives_every_impossible_inertia_a_ball_at_once) {
  const std::string impossible = inertial_element(".5", "ixx='.001' iyy='.001' izz='.01'");
  std::string urdf = two_wheels_and(seen_from("bumper", impossible));
  urdf = test::replaced(urdf, "ixx='.3' iyy='.5' izz='.6'", "ixx='.5' iyy='.5' izz='5'");
  const auto draft = this->draft(folder_.write("plate.urdf", urdf));
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->assumed.size(), 1U);
  EXPECT_NE(draft->text.find("\ninertias:\n  chassis: {radius: 272 mm}\n  bumper: {radius: 50 mm}\n"),
            std::string::npos)
      << draft->text;
  EXPECT_EQ(said_of(draft->text), "");
  // Without the section both are told in one run, each with what to write.
  const std::string bare = std::regex_replace(draft->text, std::regex("\ninertias:\n.*\n.*\n"), "\n");
  const std::string said = said_of(bare);
  for (const char* link : {"chassis", "bumper"}) {
    EXPECT_NE(said.find(std::string("the inertia of `") + link + "` breaks the triangle rule"),
              std::string::npos)
        << said;
    EXPECT_NE(said.find(std::string("`") + link + ": {radius: 0.1 m}`"), std::string::npos) << said;
  }
}

// An inertia that is drowned in that of a body is none of anybody's business.
TEST_F(DraftOfHabits, asks_nothing_about_a_part_whose_body_can_be) {
  const std::string part = inertial_element("1", "ixx='.001' iyy='.001' izz='.01'");
  const auto draft = this->draft(folder_.write("part.urdf", two_wheels_and(seen_from("bumper", part))));
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->text.find("inertias"), std::string::npos) << draft->text;
}

// Nothing in the URDF weighs anything: the base's mass is asked, too, and the rest can be looked at all the
// same.
TEST_F(DraftOfHabits, asks_for_the_mass_of_a_base_without_any) {
  const std::string urdf = std::regex_replace(two_wheels_and(""), std::regex("<inertial>.*?</inertial>"), "");
  const auto draft = this->draft(folder_.write("light.urdf", urdf));
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->assumed.size(), 1U);
  EXPECT_NE(draft->text.find("  chassis: {mass: FILL_IN, radius: 272 mm}\n"), std::string::npos)
      << draft->text;
  EXPECT_NE(draft->text.find("each_wheel: {mass: FILL_IN}\n"), std::string::npos) << draft->text;
  EXPECT_NE(draft->text.find("  left_wheel: {}\n  right_wheel: {}\n"), std::string::npos) << draft->text;
  const std::string filled =
      std::regex_replace(std::regex_replace(draft->text, std::regex("mass: FILL_IN"), "mass: 1 kg"),
                         std::regex("FILL_IN"), "9 N");
  EXPECT_EQ(said_of(filled).find("error"), std::string::npos) << said_of(filled);
}

// The body of .6 m x .4 m x .1 m is 24 dm^3, of foam 0.48 kg. A scanner beside it that weighs 0.3 kg does not
// stand for it, nor does a battery, less than half as large each way. A frame without shape may.
TEST_F(DraftOfHabits, asks_for_the_mass_of_a_body_that_only_its_parts_weigh_for) {
  const std::string moments = "ixx='.002' iyy='.002' izz='.002'";
  const auto with = [&](const std::string& body, const std::string& mass, const std::string& shape) {
    const std::string part =
        inertial_element(mass, moments) +
        (shape.empty() ? "" : "<collision><geometry>" + shape + "</geometry></collision>");
    std::string urdf = test::replaced(two_wheels_and(seen_from("part", part)), chassis(),
                                      "<link name='chassis'>" + body + "</link>");
    return this->draft(folder_.write("body.urdf", urdf));
  };
  const std::string box = "<collision><geometry><box size='.6 .4 .1'/></geometry></collision>";
  const std::string mesh = "<visual><geometry><mesh filename='body.stl'/></geometry></visual>";
  const std::string battery = "<box size='.29 .19 .05'/>", half = "<box size='.4 .3 .1'/>";
  const auto asks = [](const std::optional<RobotDraft>& draft) {
    return draft && draft->text.find("  chassis: {mass: FILL_IN, radius: ") != std::string::npos;
  };
  EXPECT_TRUE(asks(with(box, "0.3", "")));
  EXPECT_TRUE(asks(with(box, "5", battery)));
  EXPECT_FALSE(asks(with(box, "0.5", "")));
  EXPECT_FALSE(asks(with(box, "5", half)));
  EXPECT_FALSE(asks(with(box + inertial_element("0.3", moments), "5", battery)));
  // Of a mesh nobody knows the size. Both wheels weigh 2 kg.
  EXPECT_TRUE(asks(with(mesh, "1.9", battery)));
  EXPECT_FALSE(asks(with(mesh, "2.1", battery)));

  const auto draft = with(box, "0.3", battery);
  EXPECT_NE(
      std::ranges::find(draft->missing,
                        "the mass of `chassis`, the body of the base: what is fixed to it weighs 0.3 kg"),
      draft->missing.end());
  EXPECT_EQ(draft->assumed.size(), 1U);
  // A brake of those 2.3 kg would be a guess.
  EXPECT_NE(draft->text.find("stop: {deceleration: 1 m/s^2, force: FILL_IN}"), std::string::npos)
      << draft->text;
  const std::string weighed = test::replaced(draft->text, "mass: FILL_IN", "mass: 20 kg");
  EXPECT_EQ(said_of(test::replaced(weighed, "force: FILL_IN", "force: 22 N")), "");
}

// Nobody knows where the mass of this base lies. Above the axle it would fall over its ball, 0.3 m behind. In
// the middle of three feet it lies 0.1 m behind, inside of them.
TEST_F(DraftOfHabits, proposes_the_middle_of_the_feet_for_a_mass_of_unknown_place) {
  const std::string ball =
      "<link name='ball'><collision><geometry><sphere radius='.02'/></geometry></collision></link><joint "
      "name='ball_joint' type='fixed'><parent link='chassis'/><child link='ball'/><origin xyz='-.3 0 "
      "-.06'/></joint>";
  const std::string bare =
      std::regex_replace(two_wheels_and(ball), std::regex("<inertial>.*?</inertial>"), "");
  const auto draft = this->draft(folder_.write("bare.urdf", bare));
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("at: [-100 mm, 0 mm, 0 mm]"), std::string::npos) << draft->text;
  ASSERT_EQ(draft->assumed.size(), 1U);
  std::string filled = draft->text;
  for (const auto& [open, value] : {std::pair{"chassis: \\{mass: FILL_IN", "chassis: {mass: 3 kg"},
                                    {"mass: FILL_IN", "mass: 0.2 kg"},
                                    {"force: FILL_IN", "force: 3 N"}})
    filled = std::regex_replace(filled, std::regex(open), value);
  EXPECT_EQ(said_of(filled).find("error"), std::string::npos) << said_of(filled);
  EXPECT_NE(said_of(std::regex_replace(filled, std::regex(", at: [^}]*"), "")).find("E640"),
            std::string::npos);
}

// 1 kg that lies e beside the axle of a wheel of 80 mm drives the base by e/80 mm of its weight. Of 22 kg
// that is 1 % at 17.6 mm. A disc has its centre on the axle.
TEST_F(DraftOfHabits, puts_the_centre_of_a_wheel_on_its_axle) {
  const auto beside = [](const std::string& metres) {
    return std::regex_replace(two_wheels_and(""), std::regex("<inertial><mass value='1'/>"),
                              "<inertial><origin xyz='" + metres + " .01 0'/><mass value='1'/>");
  };
  EXPECT_EQ(this->draft(folder_.write("wheel.urdf", beside(".017")))->text.find("inertias"),
            std::string::npos);
  const auto draft = this->draft(folder_.write("wheel.urdf", beside(".018")));
  ASSERT_TRUE(draft);
  const std::string entry = "inertias:\n  left_wheel: {}\n  right_wheel: {}\n";
  ASSERT_NE(draft->text.find(entry), std::string::npos) << draft->text;
  Diagnostics diagnostics;
  const auto robot = load_robot(folder_.write("robot.yaml", draft->text), diagnostics);
  ASSERT_TRUE(robot) << test::rendered(diagnostics);
  EXPECT_EQ(test::rendered(diagnostics), "");
  for (const solver::Wheel& wheel : robot->model.wheels()) {
    const solver::RigidInertia& inertia = robot->model.bodies()[static_cast<std::size_t>(wheel.body)].inertia;
    EXPECT_LT((inertia.first_moment / inertia.mass - solver::Vector3(0.0, 0.01, 0.0)).norm(), 1e-12);
  }
  const std::string said = said_of(test::replaced(draft->text, entry, ""));
  EXPECT_NE(said.find("W875: wheel `left_wheel_joint` has its centre of mass 18 mm beside its axle"),
            std::string::npos)
      << said;
}

// All of a fork's 1 kg lies within 3 (30 mm + 50 mm) of its swivel's axis: at most 0.0576 kg m^2.
TEST_F(DraftOfHabits, gives_a_swivel_with_too_much_inertia_a_ball) {
  const auto on_fork = [](const std::string& moment) {
    return two_wheels_and(
        "<link name='fork'>" + inertial_element("1", "ixx='.5' iyy='.5' izz='" + moment + "'") +
        "</link><joint name='fork_joint' type='continuous'><parent link='chassis'/><child link='fork'/>"
        "<origin xyz='-.3 0 0'/><axis xyz='0 0 1'/></joint>" +
        std::regex_replace(std::regex_replace(wheel_at("caster_wheel", "fork", "-.03 0 -.03", ""),
                                              std::regex("iyy='.003'"), "iyy='.002'"),
                           std::regex("radius='.08'"), "radius='.05'"));
  };
  const auto draft = this->draft(folder_.write("fork.urdf", on_fork("0.717")));
  ASSERT_TRUE(draft);
  EXPECT_NE(draft->text.find("inertias:\n  fork: {radius: 80 mm}\n"), std::string::npos) << draft->text;
  EXPECT_EQ(said_of(draft->text), "");
  const std::string said =
      said_of(test::replaced(draft->text, "  fork: {radius: 80 mm}", "  caster_wheel: {}"));
  EXPECT_NE(said.find("W870: swivel `fork_joint` has 0.717 kg m^2 about its axis"), std::string::npos)
      << said;
  EXPECT_EQ(this->draft(folder_.write("fork.urdf", on_fork("0.056")))->text.find("inertias"),
            std::string::npos);
}

// Simulators are calmed by friction that nobody measured: it is told and not taken.
TEST_F(DraftOfHabits, tells_the_friction_of_the_urdf) {
  const std::string urdf =
      std::regex_replace(two_wheels_and(""), std::regex("<limit effort='8' velocity='9'/>"),
                         "$&<dynamics damping='0.1' friction='0.2'/>");
  const auto draft = this->draft(folder_.write("rubs.urdf", urdf));
  ASSERT_TRUE(draft);
  const std::string note =
      "# friction:\n"
      "#   left_wheel_joint: {coulomb: 0.2 N m, viscous: 0.1 N m s/rad}\n"
      "#   right_wheel_joint: {coulomb: 0.2 N m, viscous: 0.1 N m s/rad}\n";
  ASSERT_NE(draft->text.find(note), std::string::npos) << draft->text;
  EXPECT_EQ(
      std::count_if(draft->missing.begin(), draft->missing.end(),
                    [](const std::string& line) { return line.find("<dynamics>") != std::string::npos; }),
      1);
  // Without the comment's marks it is an entry of the file.
  const std::string taken = std::regex_replace(note, std::regex("# ?"), "");
  EXPECT_EQ(said_of(test::replaced(draft->text, note, taken)).find("error"), std::string::npos)
      << said_of(test::replaced(draft->text, note, taken));
  const auto still = this->draft(folder_.write("still.urdf", two_wheels_and("")));
  EXPECT_EQ(still->text.find("<dynamics>"), std::string::npos);
}

}  // namespace
}  // namespace zwang::lang
