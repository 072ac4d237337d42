// `zwang plan` and `zwang robot`, as processes. Expected numbers come from the robot file and the URDF.

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <sstream>

#include "cli_plan_fixture.hpp"
#include "program.hpp"

namespace zwang {
namespace {

using nlohmann::json;
using namespace test;

TEST_F(CliPlan, tells_how_many_freedoms_are_left) {
  // The push asks for no acceleration, and the heading is free.
  EXPECT_NE(zwang("plan wall_align.yaml --task press")
                .out.find("their rank 1; 2 freedoms that no driver of motion holds"),
            std::string::npos);
  // The push on the board.
  EXPECT_NE(zwang("plan wipe.yaml --task left").out.find("1 freedom that no driver"), std::string::npos);
  EXPECT_EQ(zwang("plan laws/straight_on.yaml").out.find("that no driver"), std::string::npos);
}

TEST_F(CliPlan, shows_the_rows_as_the_solver_gets_them) {
  const json plan = zwang_json("plan wall_align.yaml");
  EXPECT_EQ(plan.at("mobility"), 3);
  ASSERT_EQ(plan.at("tasks").size(), 2U);
  const json& press = plan.at("tasks")[0];

  const json force = row(press, "contact.x", "presses");
  EXPECT_EQ(force.at("force"), 20.0);
  EXPECT_EQ(force.at("a"), json({0.0, 0.0, 0.0, 1.0, 0.0, 0.0}));
  EXPECT_EQ(force.at("level"), 1);
  EXPECT_TRUE(force.at("b").is_null());

  // (v - ds)/h at rest, h = 10 ms
  EXPECT_NEAR(row(press, "contact.x", "at most").at("b").get<double>(), 0.08 / 0.01, 1e-9);
  EXPECT_NEAR(row(press, "contact.x", "at least").at("b").get<double>(), -0.05 / 0.01, 1e-9);
  EXPECT_EQ(row(press, "contact.x", "at most").at("hi"), 0.0);
  EXPECT_EQ(row(press, "limits.y", "at most").at("level"), 0);
  EXPECT_EQ(press.at("equality_rows"), 1);
  EXPECT_EQ(press.at("rank"), 1);

  // `hold` pushes along the wall's x; the scene starts the base 20 deg askew.
  const json askew = row(plan.at("tasks")[1], "contact.x", "presses").at("a");
  EXPECT_NEAR(askew[3].get<double>(), std::cos(20.0 * std::numbers::pi / 180.0), 1e-9);
  EXPECT_NEAR(askew[4].get<double>(), -std::sin(20.0 * std::numbers::pi / 180.0), 1e-9);
  EXPECT_EQ(plan.at("tasks")[1].at("rank"), 2);
}

TEST_F(CliPlan, a_row_names_the_line_that_it_comes_from) {
  const json plan = zwang_json("plan wall_align.yaml --task press");
  const std::string from = row(plan.at("tasks")[0], "contact.y", "drives").at("from");
  const std::string file = read(folder_ / "wall_align.yaml");
  const std::size_t at = file.find("y:  {velocity: 0 m/s}");
  const auto line = 1 + std::count(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  EXPECT_EQ(from, "wall_align.yaml:" + std::to_string(line));
}

TEST_F(CliPlan, the_effective_mass_has_wheels_and_rotors_in_it) {
  const json plan = zwang_json("plan wall_align.yaml --task press");
  // 4 (I + gear^2 I_rotor) / r^2 beside the masses; the smooth rollers of the model do not turn.
  const json axis = plan.at("tasks")[0].at("axes")[0];
  const double rolling = 4.0 * (26.0 * 26.0 * 13.5e-6) / (0.0759 * 0.0759);
  const double mass = axis.at("effective_mass");
  EXPECT_GT(mass, 46.0 + rolling);
  EXPECT_LT(mass, 46.0 + rolling + 4.0 * 2.3);  // a wheel's own spin weighs less than the wheel once more
  // The impact's note tells the same mass.
  bool is_told = false;
  for (const json& note : plan.at("tasks")[0].at("notes")) is_told = is_told || note.at("code") == "N603";
  EXPECT_TRUE(is_told);
}

TEST_F(CliPlan, one_task_of_the_file) {
  const json plan = zwang_json("plan wall_align.yaml --task hold");
  ASSERT_EQ(plan.at("tasks").size(), 1U);
  EXPECT_EQ(plan.at("tasks")[0].at("task"), "hold");
  const Result unknown = zwang("plan wall_align.yaml --task press_on");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.out.find("press_on"), std::string::npos);
}

TEST_F(CliPlan, a_parameter_reaches_the_rows) {
  const json plan = zwang_json("plan wall_align.yaml -p push=30N");
  EXPECT_EQ(row(plan.at("tasks")[0], "contact.x", "presses").at("force"), 30.0);
}

TEST_F(CliPlan, a_bad_file_has_no_plan) {
  write("bad.yaml", "zwang: 1\nrobot: robots/mecanum_base.yaml\nstart: go\ntasks: {}\n");
  const Result result = zwang("plan bad.yaml");
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("E104"), std::string::npos) << result.out;
}

TEST_F(CliPlan, inspect_tells_what_the_base_can_do) {
  const json robot = zwang_json("robot inspect robots/mecanum_base.yaml");
  EXPECT_EQ(robot.at("wheels").size(), 4U);
  const json& analysis = robot.at("analysis");
  EXPECT_EQ(analysis.at("mobility"), 3);
  EXPECT_EQ(analysis.at("exact"), true);
  EXPECT_EQ(analysis.at("internal_forces"), 1);
  EXPECT_EQ(analysis.at("mirrored_rollers"), false);
  // Each of four wheels pushes with effort / radius along x when all turn ahead.
  const double effort = robot.at("wheels")[0].at("effort");
  EXPECT_NEAR(analysis.at("axes").at("x").at("largest_force")[1].get<double>(), 4.0 * effort / 0.0759, 1e-6);
}

TEST_F(CliPlan, inspect_says_what_tips_the_base_over) {
  const json statics = zwang_json("robot inspect robots/mecanum_base.yaml").at("statics");
  const double inside = statics.at("inside"), height = statics.at("height");
  const json& tips = statics.at("tips_beyond");
  // a = g d / h, over the nearest edge.
  const double least =
      std::min({tips[0].get<double>(), tips[1].get<double>(), tips[2].get<double>(), tips[3].get<double>()});
  EXPECT_NEAR(least, 9.81 * inside / height, 1e-3 * least);
  EXPECT_NE(zwang("robot inspect robots/mecanum_base.yaml").out.find(" inside its wheels and supports, "),
            std::string::npos);
}

// The hook of the robot file: 0.40 m behind, turned by 180 deg about the vertical.
TEST_F(CliPlan, inspect_says_where_frames_point) {
  const json hook = zwang_json("robot inspect robots/mecanum_base.yaml").at("frames").at("hook");
  EXPECT_NEAR(hook.at("at")[0].get<double>(), -0.40, 1e-12);
  EXPECT_NEAR(hook.at("x")[0].get<double>(), -1.0, 1e-12);
  EXPECT_NEAR(hook.at("y")[1].get<double>(), -1.0, 1e-12);
  EXPECT_NE(zwang("robot inspect robots/mecanum_base.yaml").out.find(" m, x back, y right, z up\n"),
            std::string::npos);
}

TEST_F(CliPlan, inspect_finds_rollers_that_were_read_from_above) {
  std::string file = read(folder_ / "robots/mecanum_base.yaml");
  for (std::size_t at = 0; (at = file.find("roller: ", at)) != std::string::npos; ++at) {
    const bool is_negative = file[at + 8] == '-';
    file = is_negative ? file.erase(at + 8, 1) : file.insert(at + 8, "-");
  }
  write("robots/mirrored.yaml", file);
  const Result result = zwang("robot inspect robots/mirrored.yaml");
  EXPECT_EQ(result.code, 0);
  const json analysis = zwang_json("robot inspect robots/mirrored.yaml").at("analysis");
  // A square wheelbase loses its yaw; another one keeps some.
  EXPECT_EQ(analysis.at("mirrored_rollers"), !analysis.at("axes").at("rz").at("reachable").get<bool>());
}

/// Its wheels stand 1.3 mm ahead of its origin: turning moves that sideways, with a thousand tons of mass.
TEST_F(CliPlan, inspect_says_what_cannot_move) {
  const std::string fetch = ZWANG_SOURCE_DIR "/../shared/robots/fetch.urdf";
  if (!std::filesystem::exists(fetch)) GTEST_SKIP() << fetch << " is not here";
  const Result result = zwang("robot inspect " + fetch);
  EXPECT_NE(result.out.find("  y   cannot move: the wheels hold it\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("turned from there by 45, 90 and 135 deg"), std::string::npos) << result.out;
  const json analysis = zwang_json("robot inspect " + fetch).at("assumed").at(0).at("analysis");
  EXPECT_EQ(analysis.at("axes").at("y").at("held"), true);
  EXPECT_TRUE(analysis.at("axes").at("y").at("effective_mass").is_null());
  EXPECT_EQ(analysis.at("axes").at("x").at("held"), false);
  EXPECT_EQ(analysis.at("exact"), true);
}

TEST_F(CliPlan, init_writes_a_file_that_is_refused_until_it_is_filled) {
  const Result made = zwang("robot init robots/mecanum_base.urdf -o robots/mine.yaml");
  EXPECT_EQ(made.code, 0) << made.out;
  const Result refused = zwang("validate robots/mine.yaml");
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.out.find("FILL_IN"), std::string::npos) << refused.out;
  EXPECT_EQ(zwang("robot init robots/mecanum_base.urdf -o robots/mine.yaml").code, 2) << "never overwritten";
  EXPECT_EQ(zwang("robot init robots/none.urdf").code, 2);
}

/// From the URDF to a task that is done, on three kinds of drives; what the URDF does not tell is filled in.
TEST_F(CliPlan, init_with_a_task_runs_once_the_robot_file_is_filled_in) {
  for (const std::string robot : {"mecanum_base", "diff_base", "omni_base"}) {
    const std::string file = "robots/my_" + robot + ".yaml", task = "robots/my_" + robot + "_wall_align.yaml";
    const Result made = zwang("robot init robots/" + robot + ".urdf --task wall_align -o " + file);
    ASSERT_EQ(made.code, 0) << made.out;
    std::string text = read(folder_ / file);
    const std::string open = "kind: FILL_IN";
    if (const std::size_t at = text.find(open); at != std::string::npos) {
      EXPECT_EQ(zwang("validate " + task).code, 1) << "still open";
      EXPECT_NE(made.out.find(open), std::string::npos) << made.out;
      write(file, text.replace(at, open.size(), "kind: mecanum"));
    }
    const Result good = zwang("validate --deny warnings " + task);
    EXPECT_EQ(good.code, 0) << good.out;
    const json report = zwang_json("run --quiet " + task);
    EXPECT_NEAR(report.at("truth").at("base").at("yaw").get<double>(), 0.0, 0.1 * std::numbers::pi / 180.0)
        << robot;
  }
}

/// Two wheels and a ball behind them, and `load` on top. [kg, m]
std::string loaded_base(const std::string& mass, const std::string& at) {
  const auto link = [](const std::string& name, const std::string& kilograms, const std::string& moments,
                       const std::string& shape) {
    return "<link name='" + name + "'><inertial><mass value='" + kilograms + "'/><inertia " + moments +
           " ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry>" + shape +
           "</geometry></collision></link>";
  };
  const auto joint = [](const std::string& name, const std::string& type, const std::string& xyz) {
    return "<joint name='" + name + "_joint' type='" + type + "'><parent link='base_link'/><child link='" +
           name + "'/><origin xyz='" + xyz +
           "'/><axis xyz='0 1 0'/><limit effort='8' velocity='20'/></joint>";
  };
  const std::string disc = "ixx='.003' iyy='.005' izz='.003'", ball = "<sphere radius='.08'/>";
  return "<robot name='loaded'>" +
         link("base_link", "30", "ixx='.5' iyy='.8' izz='1'", "<box size='.6 .4 .1'/>") +
         link("left_wheel", "1.5", disc, ball) + joint("left_wheel", "continuous", "0 .22 0") +
         link("right_wheel", "1.5", disc, ball) + joint("right_wheel", "continuous", "0 -.22 0") +
         "<link name='caster_ball'/>" + joint("caster_ball", "fixed", "-.28 0 -.08") +
         link("load", mass, "ixx='.1' iyy='.1' izz='.1'", "<box size='.1 .1 .1'/>") +
         joint("load", "fixed", at) + "</robot>";
}

/// With a free heading these bases spin at up to 140 deg/s on their way to the wall, by I w' = -m x v w + m y
/// v'.
TEST_F(CliPlan, init_with_a_task_aligns_bases_whose_mass_is_beside_or_behind_the_axle) {
  for (const auto& [mass, at] : {std::pair{"20", "-.1 .1 .1"}, {"60", "-.2 .02 .1"}}) {
    write("loaded.urdf", loaded_base(mass, at));
    ASSERT_EQ(zwang("robot init loaded.urdf --task wall_align").code, 0);
    for (const char* yaw : {"-20deg", "5deg", "20deg"}) {
      const json report = zwang_json(std::string("run --quiet loaded_wall_align.yaml --start-yaw ") + yaw);
      EXPECT_NEAR(report.at("truth").at("base").at("yaw").get<double>(), 0.0, 0.1 * std::numbers::pi / 180.0)
          << at << yaw;
    }
    for (const char* file : {"loaded.yaml", "loaded_wall_align.yaml", "loaded_wall_align_scene.yaml"})
      fs::remove(folder_ / file);
  }
}

TEST_F(CliPlan, init_overwrites_nothing_and_updates_what_it_is_told_to) {
  ASSERT_EQ(zwang("robot init robots/diff_base.urdf --task obstacle -o robots/mine.yaml").code, 0);
  const std::string robot = read(folder_ / "robots/mine.yaml"),
                    scene = read(folder_ / "robots/mine_obstacle_scene.yaml");
  const Result again = zwang("robot init robots/diff_base.urdf --task obstacle -o robots/mine.yaml");
  EXPECT_EQ(again.code, 2) << again.out;
  EXPECT_NE(again.out.find("--update robots/mine.yaml"), std::string::npos) << again.out;
  // A scene that stands in the way of a new robot file is told before anything is written.
  write("robots/other_docking_scene.yaml", "mine\n");
  EXPECT_EQ(zwang("robot init robots/diff_base.urdf --task docking -o robots/other.yaml").code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "robots/other.yaml"));
  write("robots/mine_obstacle_scene.yaml", scene + "# mine\n");
  const Result updated = zwang("robot init robots/diff_base.urdf --task obstacle --update robots/mine.yaml");
  EXPECT_EQ(updated.code, 0) << updated.out;
  EXPECT_EQ(read(folder_ / "robots/mine.yaml"), robot);
  EXPECT_EQ(read(folder_ / "robots/mine_obstacle_scene.yaml"), scene + "# mine\n");
}

// A URDF without masses and torques: the shipped 41 N are more than these motors make, 2 x 0.2 N m / 0.08 m =
// 5 N. Filled in, 0.9 m/s^2 x 3 kg = 2.7 N are asked. What its owner changed stays.
TEST_F(CliPlan, update_fits_the_task_to_the_masses_and_torques_that_were_filled_in) {
  std::string urdf = loaded_base("20", "0 0 .1");
  urdf = std::regex_replace(urdf, std::regex("<inertial>.*?</inertial>|<limit[^>]*>"), "");
  write("loaded.urdf", urdf);
  const Result made = zwang("robot init loaded.urdf --task feel_wall");
  ASSERT_EQ(made.code, 0) << made.out;
  const std::string fit = "zwang robot init loaded.urdf --update loaded.yaml --task feel_wall";
  EXPECT_NE(made.out.find(fit), std::string::npos) << made.out;
  const std::string first = read(folder_ / "loaded_feel_wall.yaml");
  EXPECT_NE(first.find("force: 41"), std::string::npos) << first;
  std::string text = read(folder_ / "loaded.yaml");
  for (const auto& [open, value] : {std::pair{"effort: FILL_IN", "effort: 0.2 N m"},
                                    {"base_link: \\{mass: FILL_IN", "base_link: {mass: 2.6 kg"},
                                    {"mass: FILL_IN", "mass: 0.2 kg"},
                                    {"force: FILL_IN", "force: 3 N"}})
    text = std::regex_replace(text, std::regex(open), value);
  write("loaded.yaml", text);
  const Result updated = zwang(fit.substr(6));
  EXPECT_EQ(updated.code, 0) << updated.out;
  EXPECT_NE(updated.out.find("fitted to what you filled in"), std::string::npos) << updated.out << text;
  const std::string fitted = read(folder_ / "loaded_feel_wall.yaml");
  EXPECT_NE(fitted.find("force: 2.7 N"), std::string::npos) << fitted;
  EXPECT_EQ(zwang("validate --deny warnings loaded_feel_wall.yaml").code, 0);
  write("loaded_feel_wall.yaml", first + "# mine\n");
  EXPECT_EQ(zwang(fit.substr(6)).code, 0);
  EXPECT_EQ(read(folder_ / "loaded_feel_wall.yaml"), first + "# mine\n");
}

// The robot file may not read it (E109) before a folder above both is marked: that is the first of what to
// do.
TEST_F(CliPlan, init_tells_how_to_reach_a_urdf_in_another_folder) {
  fs::remove(folder_ / ".zwang-root");
  for (const char* part : {"away/u", "away/r"}) fs::create_directories(folder_ / part);
  write("away/u/base.urdf", read(folder_ / "robots/diff_base.urdf"));
  const Result made = zwang("robot init away/u/base.urdf --task wall_align -o away/r/base.yaml");
  ASSERT_EQ(made.code, 0) << made.out;
  EXPECT_NE(made.out.find("then\n  touch away/.zwang-root "), std::string::npos) << made.out;
  EXPECT_EQ(zwang("validate away/r/base_wall_align.yaml").code, 1);
  write("away/.zwang-root", "");
  EXPECT_EQ(zwang("validate away/r/base_wall_align.yaml").code, 0);
  const Result again = zwang("robot init away/u/base.urdf --update away/r/base.yaml");
  EXPECT_EQ(again.out.find("touch"), std::string::npos) << again.out;
}

// As drafted it falls over its ball; with the skid that its owner names it stands.
TEST_F(CliPlan, update_judges_the_robot_as_it_is_filled_in) {
  const std::string skid =
      "<link name='runner'/><joint name='runner_joint' type='fixed'><parent link='base_link'/><child "
      "link='runner'/><origin xyz='-.9 0 -.08'/></joint></robot>";
  std::string urdf = loaded_base("60", "-.6 0 .1");
  write("loaded.urdf", urdf.replace(urdf.find("</robot>"), 8, skid));
  const Result made = zwang("robot init loaded.urdf --task wall_align");
  EXPECT_EQ(made.code, 2) << made.out;
  EXPECT_NE(made.out.find("falls over"), std::string::npos) << made.out;
  std::string text = read(folder_ / "loaded.yaml");
  const std::string ball = "supports: [caster_ball]";
  ASSERT_NE(text.find(ball), std::string::npos) << text;
  write("loaded.yaml", text.replace(text.find(ball), ball.size(), "supports: [caster_ball, runner]"));
  const Result updated = zwang("robot init loaded.urdf --update loaded.yaml --task wall_align");
  EXPECT_EQ(updated.code, 0) << updated.out;
  EXPECT_TRUE(fs::exists(folder_ / "loaded_wall_align.yaml"));
}

TEST_F(CliPlan, init_refuses_a_task_that_the_base_cannot_do) {
  const Result refused = zwang("robot init robots/tricycle_base.urdf --task wall_align -o robots/mine.yaml");
  EXPECT_EQ(refused.code, 2) << refused.out;
  EXPECT_NE(refused.out.find("E621"), std::string::npos) << refused.out;
  EXPECT_TRUE(fs::exists(folder_ / "robots/mine.yaml")) << "the robot file is good without a task";
  EXPECT_FALSE(fs::exists(folder_ / "robots/mine_wall_align.yaml"));
  EXPECT_EQ(zwang("robot init robots/diff_base.urdf --task wall_aling -o robots/mine.yaml").code, 2);
}

// Without -o the files are called after the robot.
TEST_F(CliPlan, init_with_a_task_names_the_files_itself) {
  const Result made = zwang("robot init robots/diff_base.urdf --task wall_align");
  ASSERT_EQ(made.code, 0) << made.out;
  EXPECT_EQ(zwang("validate diff_base_wall_align.yaml").code, 0);
  const Result again = zwang("robot init robots/diff_base.urdf --task wall_align");
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.out.find("diff_base.yaml: is there already"), std::string::npos) << again.out;
}

TEST_F(CliPlan, inspect_refuses_what_is_no_robot) {
  write("robots/broken.urdf", "<robot name='x'><link/></robot>");
  const Result result = zwang("robot inspect robots/broken.urdf");
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("error E8"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace zwang
