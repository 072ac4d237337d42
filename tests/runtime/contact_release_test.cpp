// The protective stop of a robot that feels, on a drive with torque limits of its own. The plant judges the
// force that is left at a wall, and how far a sensor that lies moves the base.
#include "drive/contact_release.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "constants.hpp"
#include "drive/led_program.hpp"
#include "recorded_run.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

lang::Program near_far_wall(const std::string& robot) {
  lang::Program program = zwang::test::feeling_program("wall_align", robot, "wall_far");
  program.scene->start_at = {0.72, 0.0};
  program.scene->start_yaw = 0.0;
  return program;
}

constexpr double pressing = 4.0;  ///< [s] by then the base leans on the wall

struct Released {
  double pressed = 0.0;       ///< [N] when the stop began
  double force = 0.0;         ///< [N] the largest of the third second after it
  double way = 0.0;           ///< [m] of the base in the stop, at most
  double told = 0.0;          ///< [rad/s] of the last command
  double last_told_at = 0.0;  ///< [s] after the stop began that it was not 0
  bool is_finished = false;
};

/// A person stops the run at `at` [s]. From then on a sensor tells `lie` [N] beside.
Released stop_at(const lang::Program& program, double at, EventCode reason, double lie = 0.0,
                 double lasting = 3.0) {
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program);
  Released result;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  while (plant.truth().time < at + lasting) {
    const Truth& truth = plant.truth();
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    if (!runner.guard().stopped() && truth.time >= at) {
      EXPECT_EQ(runner.state(), RunState::running);
      runner.guard().stop(reason);
      result.pressed = truth.objects[0].force;
      from = {truth.x, truth.y};
    }
    if (runner.guard().stopped() && sensed.contact_wrench) sensed.contact_wrench->linear.x() += lie;
    runner.step(sensed);
    EXPECT_EQ(plant.follow(runner.command()), PlantStatus::ok);
    if (!runner.guard().stopped()) continue;
    result.told = runner.command().velocity.lpNorm<Eigen::Infinity>();
    if (result.told != 0.0) result.last_told_at = truth.time - at;
    result.way = std::max(result.way, (Eigen::Vector2d(truth.x, truth.y) - from).norm());
    if (truth.time >= at + 2.0) result.force = std::max(result.force, truth.objects[0].force);
  }
  result.is_finished = runner.finished();
  return result;
}

/// w_on of ContactResponse.
double threshold(const lang::Program& program) {
  return ContactResponse(led_program(program).robot, ms).threshold();
}

/// Told 0, the loops' integrals go on pressing: that is what a stop does whose reason leaves no sensor to be
/// trusted. At 2 kN/m the base is 10 mm deep in the wall.
TEST(ContactRelease, AStopByAPersonLetsGoOfTheWall) {
  for (const char* robot : {"mecanum_wrench_50_hz", "mecanum_effort_1_khz", "diff_wrench_50_hz"}) {
    for (const double stiffness : {2e3, 1e6}) {
      lang::Program program = near_far_wall(robot);
      program.scene->objects[0].stiffness = stiffness;
      const Released held = stop_at(program, pressing, EventCode::clock_rate);
      const Released released = stop_at(program, pressing, EventCode::requested);
      std::printf("%s, %g N/m: %.1f N, then %.2f N, not %.2f N; %.1f mm in %.2f s\n", robot, stiffness,
                  released.pressed, released.force, held.force, released.way * 1e3, released.last_told_at);
      EXPECT_GT(held.force, 15.0) << robot;
      EXPECT_LT(released.force, threshold(program)) << robot;
      EXPECT_LT(released.way, ContactRelease::farthest) << robot;
      EXPECT_EQ(released.told, 0.0) << robot;
      EXPECT_TRUE(released.is_finished) << robot;
    }
  }
}

class ContactReleaseAfter : public testing::TestWithParam<EventCode> {};

/// None of these reasons says that samples, wheels or motors are not what they seem.
TEST_P(ContactReleaseAfter, AStopLetsGoOfTheWall) {
  const lang::Program program = near_far_wall("mecanum_wrench_50_hz");
  const Released released = stop_at(program, pressing, GetParam());
  EXPECT_GT(released.pressed, 15.0);
  EXPECT_LT(released.force, threshold(program));
  EXPECT_LT(released.way, ContactRelease::farthest);
  EXPECT_EQ(released.told, 0.0);
  EXPECT_TRUE(released.is_finished);
}

INSTANTIATE_TEST_SUITE_P(Stop, ContactReleaseAfter,
                         testing::Values(EventCode::requested, EventCode::watchdog, EventCode::solver,
                                         EventCode::bad_torque),
                         [](const auto& tested) { return std::string(to_string(tested.param)); });

/// c = V + T_c V' goes T_c V farther than V, and the ramp v^2/(2 a).
TEST(ContactRelease, ASensorThatLiesMovesTheBaseByItsBoundOnly) {
  const lang::Program program = near_far_wall("mecanum_wrench_50_hz");
  const double v = ContactRelease::fastest, a = program.robot.stop.deceleration;
  const double beyond = v * program.robot.drive.time_constant + 0.5 * v * v / a + 0.5e-3;
  for (const double lie : {-30.0, -500.0}) {
    const Released r = stop_at(program, pressing, EventCode::requested, lie, 4.0);
    std::printf("%.0f N: %.1f mm in %.2f s\n", lie, r.way * 1e3, r.last_told_at);
    EXPECT_GT(r.way, 0.8 * ContactRelease::farthest);
    EXPECT_LT(r.way, ContactRelease::farthest + beyond);
    EXPECT_EQ(r.told, 0.0);
    EXPECT_TRUE(r.is_finished);
  }
}

/// A pull towards the wall is no answer to the push: nothing is told. Else the motors would press with 101 N.
TEST(ContactRelease, ASensorThatLiesDoesNotPressTheBaseOnTheWall) {
  const Released r = stop_at(near_far_wall("mecanum_wrench_50_hz"), pressing, EventCode::requested, 500.0);
  EXPECT_LT(r.force, 21.0);
  EXPECT_LT(r.way, 1e-3);
}

/// 0.08 m/s, and the sensor's noise.
TEST(ContactRelease, ABaseThatPressesOnNothingOnlyBrakes) {
  for (const char* robot : {"mecanum_wrench_50_hz", "mecanum_effort_1_khz", "omni_effort_100_hz"}) {
    const lang::Program program = near_far_wall(robot);
    const Released r = stop_at(program, 0.8, EventCode::requested);
    EXPECT_EQ(r.pressed, 0.0) << robot;
    EXPECT_LT(r.last_told_at, 0.08 / program.robot.stop.deceleration + 5 * ms) << robot;
    EXPECT_TRUE(r.is_finished) << robot;
  }
}

/// In the midst of it. The run goes on, and the base presses again.
TEST(ContactRelease, AResetEndsIt) {
  const lang::Program program = near_far_wall("mecanum_wrench_1_khz");
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program);
  for (int i = 0; i < 3400; ++i) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    if (i == 2000) runner.guard().stop(EventCode::requested);
    if (i == 2200) {
      EXPECT_NE(runner.command().velocity.lpNorm<Eigen::Infinity>(), 0.0);
      runner.guard().reset();
    }
    runner.step(sensed);
    ASSERT_EQ(plant.follow(runner.command()), PlantStatus::ok);
  }
  EXPECT_EQ(runner.state(), RunState::running);
  EXPECT_NEAR(plant.truth().objects[0].force, 20.0, 1.5);  // the noise
}

TEST(ContactRelease, ReplaysBitByBitAndAllocatesNothing) {
  test::expect_replay_without_heap_calls(near_far_wall("mecanum_effort_100_hz"), 5000, 4000);
}

}  // namespace
}  // namespace zwang::runtime
