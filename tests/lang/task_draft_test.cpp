// Shipped use cases fitted to a base: names, forces, distances.
#include "zwang/lang/task_draft.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {
namespace {

const std::filesystem::path specs = test::source_dir / "specs";

Robot shipped(const char* name) {
  Diagnostics diagnostics;
  auto robot = load_robot(specs / "robots" / (std::string(name) + ".yaml"), diagnostics);
  EXPECT_TRUE(robot) << test::rendered(diagnostics);
  return *robot;
}

TaskTexts drafted(const std::string& task, const BaseFit& fit) {
  const TaskTexts texts{test::slurp(specs / (task + ".yaml")), test::slurp(specs / "scenes/corridor.yaml")};
  return draft_task(task, texts, fit, "robot.yaml", "scene.yaml");
}

/// The diagnostics of a task and scene that were drafted for a shipped robot.
std::string said_of(const std::string& task, const char* robot) {
  const test::Folder folder;
  const std::string urdf = std::string(robot) + ".urdf", file = std::string(robot) + ".yaml";
  folder.write(urdf, test::slurp(specs / "robots" / urdf));
  folder.write("robot.yaml", test::slurp(specs / "robots" / file));
  const TaskTexts texts = drafted(task, base_fit(shipped(robot)));
  folder.write("scene.yaml", texts.scene);
  Diagnostics diagnostics;
  EXPECT_TRUE(load(folder.write("task.yaml", texts.task), {}, diagnostics)) << texts.task;
  return test::rendered(diagnostics);
}

TEST(TaskDraft, of_every_use_case_is_good_for_the_bases_that_it_is_drafted_for) {
  int drafted_tasks = 0;
  for (const char* robot : {"mecanum_base", "diff_base", "omni_base", "kelo_base", "skid_base", "car_base"}) {
    for (const std::string& task : fitted_tasks()) {
      if (!why_unfit(task, base_fit(shipped(robot))).empty()) continue;
      EXPECT_EQ(said_of(task, robot).find("error"), std::string::npos)
          << robot << task << said_of(task, robot);
      ++drafted_tasks;
    }
  }
  EXPECT_GE(drafted_tasks, 18);
}

// A base that the draft refuses by name is refused by the task's own check, too.
TEST(TaskDraft, is_refused_for_a_base_that_the_task_would_refuse) {
  for (const auto& [robot, task, code] :
       {std::tuple{"skid_base", "wall_align", "E621"}, std::tuple{"skid_base", "obstacle", "E404"},
        std::tuple{"tricycle_base", "wall_align", "E621"}, std::tuple{"tricycle_base", "docking", "E406"}}) {
    EXPECT_NE(why_unfit(task, base_fit(shipped(robot))).find(code), std::string::npos) << robot << task;
    Diagnostics diagnostics;
    const LoadOptions options{.robot = specs / "robots" / (std::string(robot) + ".yaml")};
    EXPECT_FALSE(load(specs / (std::string(task) + ".yaml"), options, diagnostics));
    EXPECT_NE(test::rendered(diagnostics).find(code), std::string::npos) << test::rendered(diagnostics);
  }
}

TEST(TaskDraft, of_two_freedoms_leads_the_lead) {
  const BaseFit fit = base_fit(shipped("diff_base"));
  EXPECT_EQ(fit.freedoms, Freedoms::two);
  const TaskTexts texts = drafted("obstacle", fit);
  EXPECT_NE(texts.task.find("move: lead"), std::string::npos) << texts.task;
  EXPECT_EQ(texts.task.find("nose"), std::string::npos);
  EXPECT_EQ(texts.task.find("base_link"), std::string::npos);
}

// Where the URDF calls another link `base`, the task names the base link. What it tells people stays.
TEST(TaskDraft, names_the_base_link_where_base_is_another_link) {
  BaseFit fit = base_fit(shipped("mecanum_base"));
  fit.base = "chassis";
  const std::string task = drafted("obstacle", fit).task;
  EXPECT_EQ(task.find("move: base\n"), std::string::npos) << task;
  for (const char* part : {"move: chassis\n", "in: chassis\n", "moved(chassis) > 1 m",
                           "frames.touch: chassis}", "help: most force the base may ever press with"})
    EXPECT_NE(task.find(part), std::string::npos) << part << "\n" << task;
}

// 0.4 m x cos 20 deg + 0.28 m x sin 20 deg + 0.5 m = 0.972 m, as in the shipped scene of the same base.
TEST(TaskDraft, puts_the_wall_ahead_of_the_corner_that_touches_first) {
  const TaskTexts texts = drafted("wall_align", base_fit(shipped("mecanum_base")));
  EXPECT_NE(texts.scene.find("at: [0.972 m, 0 m]"), std::string::npos) << texts.scene;
}

// A tenth of the mass has a tenth of the weight, which the floor holds.
TEST(TaskDraft, presses_with_the_same_share_of_the_weight) {
  BaseFit fit = base_fit(shipped("mecanum_base"));
  fit.mass = 4.6;
  EXPECT_NE(drafted("wall_align", fit).task.find("value: 2 N, range: [0.5 N, 4 N]"), std::string::npos);
  fit.mass = 460.0;
  EXPECT_NE(drafted("wall_align", fit).task.find("value: 20 N, range: [5 N, 40 N]"), std::string::npos);
}

// Motors of 23 N are those of half of the shipped mass at 1 m/s^2.
TEST(TaskDraft, asks_no_more_than_the_motors_have) {
  BaseFit fit = base_fit(shipped("mecanum_base"));
  EXPECT_NE(drafted("feel_wall", fit).task.find("force: 41 N"), std::string::npos);  // 0.9 m/s^2 x 46 kg
  fit.largest_force = 23.0;
  EXPECT_NE(drafted("feel_wall", fit).task.find("force: 21 N"), std::string::npos);
  EXPECT_NE(drafted("wall_align", fit).task.find("value: 10 N, range: [2.5 N, 20 N]"), std::string::npos);
  fit.mass = 0.0;  // not known
  EXPECT_NE(drafted("wall_align", fit).task.find("value: 10 N, range: [2.5 N, 20 N]"), std::string::npos);
}

// Half of 20 N times the lever of the corner that touches first, 18 deg askew at sqrt(0.1^2 + 0.3^2) m:
// atan(0.1 / 0.3) = 18.43 deg. A start of 15 deg leaves 3.43 deg: 0.5 x 20 N x 0.3162 m x sin(3.43 deg).
TEST(TaskDraft, holds_a_narrow_front_with_less_than_the_wall_turns_it_with_at_first) {
  BaseFit fit = base_fit(shipped("diff_base"));
  fit.outline = {{0.3, -0.1}, {0.3, 0.1}, {-0.3, 0.1}, {-0.3, -0.1}};
  fit.axle = 0.0;
  fit.front_lever = 0.1;
  constexpr double degree = std::numbers::pi / 180.0;
  ASSERT_NEAR(*start_askew(fit), 15.0 * degree, 1e-12);
  EXPECT_NE(drafted("wall_align", fit).task.find("force: +-0.19 N m"), std::string::npos)
      << drafted("wall_align", fit).task;
}

// The least push, 5 N, turns the base about the corner 0.296 m beside the middle. Its moment is twice the one
// that holds the heading on the way.
TEST(TaskDraft, holds_the_heading_by_half_of_what_the_wall_turns_it_with) {
  const std::string task = drafted("wall_align", base_fit(shipped("diff_base"))).task;
  EXPECT_NE(task.find("rz: {velocity: 0 rad/s, force: +-0.74 N m}"), std::string::npos) << task;
  const std::string anywhere = drafted("wall_align", base_fit(shipped("mecanum_base"))).task;
  EXPECT_NE(anywhere.find("rz: free"), std::string::npos) << anywhere;
}

// 20 N stop 1000 kg from 5 mm/s and bring them back within 2 x 1000 kg x 5 mm/s / 20 N = 0.5 s.
TEST(TaskDraft, waits_longer_than_a_heavy_base_takes_to_bounce) {
  BaseFit fit = base_fit(shipped("mecanum_base"));
  fit.effective_mass = 1000.0;
  fit.effective_inertia = 1.0;
  EXPECT_NE(drafted("wall_align", fit).task.find("for: 0.8 s"), std::string::npos);
}

std::vector<Eigen::Vector2d> regular(int corners, double turned) {
  std::vector<Eigen::Vector2d> outline;
  for (int k = 0; k < corners; ++k) {
    const double angle = turned + 2.0 * std::numbers::pi * k / corners;
    outline.emplace_back(std::cos(angle), std::sin(angle));
  }
  return outline;
}

// A regular polygon of n sides rests on the side that is nearest: every 360 deg / n.
TEST(RestingYaw, of_a_polygon_is_that_of_its_nearest_side) {
  constexpr double degree = std::numbers::pi / 180.0;
  const std::vector<Eigen::Vector2d> square = regular(4, std::numbers::pi / 4.0);
  for (const double yaw : {-40.0, -20.0, 20.0, 40.0})
    EXPECT_NEAR(*resting_yaw(square, yaw * degree), 0.0, 1e-6);
  const std::vector<Eigen::Vector2d> round = regular(16, 0.0);  // sides at 11.25 deg, 33.75 deg, ...
  EXPECT_NEAR(*resting_yaw(round, 20.0 * degree), 11.25 * degree, 1e-6);
  EXPECT_NEAR(*resting_yaw(round, -30.0 * degree), -33.75 * degree, 1e-6);
  // Chamfered in front: the sides' ends lie on one side of the origin, and nothing rests there.
  const std::vector<Eigen::Vector2d> chamfered = {{0.4, -0.2}, {0.4, 0.2},   {0.35, 0.3},
                                                  {-0.4, 0.3}, {-0.4, -0.3}, {0.35, -0.3}};
  EXPECT_NEAR(*resting_yaw(chamfered, 20.0 * degree), 0.0, 1e-6);
}

// A corner at the angle b = atan(0.2 / 0.3) = 33.7 deg. From the yaw t it slides along a wall whose friction
// is less than tan(b - t), and is held by more.
TEST(RestingYaw, is_where_it_comes_if_the_friction_of_the_wall_holds_the_corner) {
  constexpr double degree = std::numbers::pi / 180.0;
  const std::vector<Eigen::Vector2d> front = {{0.3, -0.2}, {0.3, 0.2}, {-0.3, 0.2}, {-0.3, -0.2}};
  const double corner = std::atan(0.2 / 0.3);
  for (const double yaw : {-25.0 * degree, -8.0 * degree, 3.0 * degree, 20.0 * degree}) {
    const double holds = std::tan(corner - std::abs(yaw));
    EXPECT_NEAR(*resting_yaw(front, yaw, {.friction = 0.99 * holds}), 0.0, 1e-9) << yaw;
    EXPECT_NEAR(*resting_yaw(front, yaw, {.friction = 1.01 * holds}), yaw, 1e-12) << yaw;
  }
}

// A wall turns a sliding base away from a yaw t beyond b, unless the friction is more than tan(t - b). Then
// the wall's force points past the base's origin to the other side.
TEST(RestingYaw, is_square_beyond_the_corner_if_the_friction_turns_a_base_that_slides) {
  constexpr double degree = std::numbers::pi / 180.0;
  const std::vector<Eigen::Vector2d> front = {{0.3, -0.1}, {0.3, 0.1}, {-0.3, 0.3}, {-0.3, -0.3}};
  const double corner = std::atan(0.1 / 0.3);  // 18.4 deg
  for (const double yaw : {-35.0 * degree, 20.0 * degree, 30.0 * degree}) {
    const double turns = std::tan(std::abs(yaw) - corner);
    const auto rest = [&](double friction) {
      return std::abs(resting_yaw(front, yaw, {.friction = friction, .slides = true}).value_or(3.0));
    };
    EXPECT_NEAR(rest(1.01 * turns), 0.0, 1e-6) << yaw;
    EXPECT_GT(rest(0.99 * turns), std::abs(yaw)) << yaw;
  }
}

// The corner is sqrt(0.13) m out: its lever from the yaw t is sqrt(0.13) m x sin(b - t).
TEST(RestingYaw, is_where_it_comes_if_a_row_holds_the_heading_harder_than_the_wall_turns_it) {
  constexpr double degree = std::numbers::pi / 180.0;
  const std::vector<Eigen::Vector2d> front = {{0.3, -0.2}, {0.3, 0.2}, {-0.3, 0.2}, {-0.3, -0.2}};
  for (const double yaw : {-25.0 * degree, 20.0 * degree}) {
    const double lever = std::sqrt(0.13) * std::sin(std::atan(0.2 / 0.3) - std::abs(yaw));
    EXPECT_NEAR(*resting_yaw(front, yaw, {.lever = 0.99 * lever}), 0.0, 1e-9) << yaw;
    EXPECT_NEAR(*resting_yaw(front, yaw, {.lever = 1.01 * lever}), yaw, 1e-12) << yaw;
  }
}

// The same base with its arm stretched ahead and with its arm folded.
TEST(TaskDraft, aligns_no_base_whose_arm_touches_first) {
  EXPECT_NE(why_unfit("wall_align", base_fit(shipped("mecanum_arm_base"))).find("`posture`"),
            std::string::npos);
  EXPECT_EQ(why_unfit("wall_align", base_fit(shipped("mecanum_arm_folded"))), "");
}

// A flat front 160 mm wide, 150 mm ahead of the origin. About an axle there it comes to rest square from
// up to atan(80 / 150) = 28 deg; about one 90 mm behind the origin from up to atan(80 / 240) = 18.4 deg.
TEST(TaskDraft, starts_less_askew_where_the_axle_is_behind_the_origin) {
  constexpr double degree = std::numbers::pi / 180.0;
  BaseFit fit = base_fit(shipped("diff_base"));
  fit.outline = {{0.15, -0.08}, {0.15, 0.08}, {-0.15, 0.08}, {-0.15, -0.08}};
  fit.axle = 0.0;
  EXPECT_NEAR(*start_askew(fit), 20.0 * degree, 1e-12);
  fit.axle = -0.09;
  EXPECT_NEAR(*start_askew(fit), 15.0 * degree, 1e-12);
}

// A flat front 124 mm wide, 253 mm ahead: its ends lie on both sides of the origin up to atan(62 / 253)
// = 13.8 deg.
TEST(TaskDraft, starts_less_askew_where_the_front_is_narrow) {
  constexpr double degree = std::numbers::pi / 180.0;
  BaseFit fit = base_fit(shipped("mecanum_base"));
  EXPECT_NEAR(*start_askew(fit), 20.0 * degree, 1e-12);
  fit.outline = {{0.253, -0.062}, {0.253, 0.062}, {-0.2, 0.2}, {-0.2, -0.2}};
  EXPECT_NEAR(*start_askew(fit), 10.0 * degree, 1e-12);
  EXPECT_EQ(why_unfit("wall_align", fit), "");
  const TaskTexts texts = drafted("wall_align", fit);
  EXPECT_NE(texts.scene.find("the base 10 deg askew"), std::string::npos) << texts.scene;
  EXPECT_NE(texts.scene.find("yaw: 10 deg"), std::string::npos) << texts.scene;
  for (Eigen::Vector2d& corner : fit.outline) {
    if (corner.x() > 0.2) corner.y() *= 0.3;  // up to 4.2 deg
  }
  EXPECT_NE(why_unfit("wall_align", fit).find("its front is too narrow: pressed to a wall from 5 deg"),
            std::string::npos)
      << why_unfit("wall_align", fit);
}

// A mass d beside the origin turns a free base by m d s / I on its way of s = 0.5 m. At m d = 0.0349 I / m
// this is 1 deg.
TEST(TaskDraft, holds_the_heading_of_a_base_that_its_mass_turns) {
  BaseFit fit = base_fit(shipped("mecanum_base"));
  ASSERT_EQ(fit.freedoms, Freedoms::all);
  const double turns = std::numbers::pi / 180.0 * fit.effective_inertia / (0.5 * fit.mass);
  fit.centre = {0.0, 0.9 * turns};
  EXPECT_NE(drafted("wall_align", fit).task.find("rz: free"), std::string::npos);
  fit.centre = {-1.1 * turns, 0.0};
  EXPECT_NE(drafted("wall_align", fit).task.find("rz: {velocity: 0 rad/s, force: +-"), std::string::npos);
}

// Half of what 5 N square up on half of the front.
TEST(TaskDraft, holds_a_base_on_heavy_casters_more_gently_than_the_wall_does) {
  BaseFit fit = base_fit(shipped("mecanum_base"));
  fit.mass = 60.0;
  fit.front_lever = 0.2;
  const std::string shipped_row = "rz: {velocity: 0 rad/s, time_constant: 0.4 s}";
  fit.effective_mass = 1.9 * fit.mass;
  EXPECT_NE(drafted("wall_align", fit).task.find(shipped_row), std::string::npos);
  fit.effective_mass = 2.1 * fit.mass;
  const std::string task = drafted("wall_align", fit).task;
  EXPECT_NE(task.find("rz: {velocity: 0 rad/s, time_constant: 0.4 s, force: +-0.5 N m}"), std::string::npos)
      << task;
}

// Round ahead: the shipped omni base is a hexagon or the like; a circle of 16 corners is none that a wall
// turns.
TEST(TaskDraft, aligns_no_round_base) {
  BaseFit fit = base_fit(shipped("mecanum_base"));
  EXPECT_EQ(why_unfit("wall_align", fit), "");
  fit.outline = regular(16, 0.0);
  EXPECT_NE(why_unfit("wall_align", fit).find("11.3 deg"), std::string::npos) << why_unfit("wall_align", fit);
  // However its corners lie: from a smaller angle a polygon would rest on a side that a round base does not
  // have.
  fit.outline = regular(16, std::numbers::pi / 16.0);
  EXPECT_NE(why_unfit("wall_align", fit).find("round ahead"), std::string::npos)
      << why_unfit("wall_align", fit);
}

// 7 m at 1 cm/s take longer than the shipped task lets anybody wait.
TEST(TaskDraft, waits_no_longer_than_the_range_of_its_parameter) {
  BaseFit fit = base_fit(shipped("mecanum_base"));
  fit.outline = {{7.0, 1.0}, {-7.0, 1.0}, {-7.0, -1.0}, {7.0, -1.0}};
  fit.outline_is_known = false;
  const std::string text = drafted("feel_wall", fit).task;
  EXPECT_NE(text.find("timeout: {value: 600 s, range: [2 s, 10 min]"), std::string::npos) << text;
}

}  // namespace
}  // namespace zwang::lang
