// A drive that takes velocities and torque limits, with the shipped tasks. It is as gentle as a drive that
// takes torques, at any rate and delay. Its forces are bounded where it does not follow its command. The
// plant is the judge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "constants.hpp"
#include "drive/loop_gain.hpp"
#include "drive/velocity_drive.hpp"
#include "recorded_run.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

lang::Program in_scene(const std::string& task, const std::string& robot, const std::string& scene) {
  return zwang::test::shipped_files(task + ".yaml", "robots/" + robot + ".yaml", "scenes/" + scene + ".yaml");
}

struct Alignment {
  RunState state = RunState::running;
  double took = 0.0;  ///< [s] from the first contact to 0.1 deg for good
  double peak = 0.0;  ///< [N] within half a second of that contact
  double force = 0.0;
};

Alignment align(const std::string& robot) {
  const lang::Program program = in_scene("wall_align", robot, "wall_far");
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program);
  Alignment result;
  while (!runner.finished() && plant.truth().time < 30.0) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    runner.step(sensed);
    EXPECT_EQ(plant.follow(runner.command()), PlantStatus::ok);
    const ObjectTruth& wall = plant.truth().objects[0];
    if (!wall.touched) continue;
    if (plant.truth().time < *wall.touched + 0.5) result.peak = wall.peak_force;
    if (std::abs(plant.truth().yaw) > 0.1 * degree) result.took = plant.truth().time - *wall.touched;
    if (runner.state() == RunState::running) result.force = wall.force;
  }
  result.state = runner.state();
  return result;
}

TEST(LimitedDrive, AlignsAsGentlyAndNearlyAsSoonAsTorques) {
  const Alignment torques = align("mecanum_base");
  for (const char* robot : {"mecanum_1_khz", "mecanum_100_hz", "mecanum_50_hz", "mecanum_20_hz"}) {
    const Alignment limited = align(std::string("limited/") + robot);
    std::printf("%s: %.2f s (%.2f s), peak %.1f N (%.1f N), %.3f N\n", robot, limited.took, torques.took,
                limited.peak, torques.peak, limited.force);
    EXPECT_EQ(limited.state, RunState::done) << robot;
    EXPECT_LE(limited.peak, 1.03 * torques.peak) << robot;
    EXPECT_NEAR(limited.force, 20.0, 0.02) << robot;
    // Each time the base bounces, the velocity range slows it down within the drive's horizon, up to 0.12 s.
    EXPECT_LE(limited.took, 2.0 * torques.took) << robot;
  }
}

/// Behind the drive's loop nobody sees a motor's torque. A motor that is lost or stuck leaves the others in
/// their bounds. A flipped motor drives its wheel away from its command. In the 0.3 s until the guard tells
/// it, the task's forces, 40 N along x and along y, speed the base up.
TEST(LimitedDrive, AMotorThatIsBrokenIsStoppedOrStaysInItsBounds) {
  constexpr double cruise = 0.15, push = 40.0;  // [m/s], [N] of obstacle.yaml
  for (const lang::FaultKind kind :
       {lang::FaultKind::torque_flipped, lang::FaultKind::torque_stuck, lang::FaultKind::torque_lost}) {
    const lang::Program program = in_scene("obstacle", "limited/mecanum_50_hz", "obstacle");
    ScenePlantOptions options;
    options.faults.push_back({.kind = kind, .at = 1.0, .joint = "front_left_wheel"});
    ScenePlant plant(program, options);
    Runner runner(program);
    Sensed sensed(program);
    double fastest = 0.0;
    while (!runner.finished() && plant.truth().time < 20.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      runner.step(sensed);
      ASSERT_EQ(plant.follow(runner.command()), PlantStatus::ok);
      fastest = std::max(fastest, plant.truth().velocity.head<2>().norm());
    }
    std::printf("fault %d: %s (%s) at %.2f s, fastest %.2f m/s, crate %.0f N\n", static_cast<int>(kind),
                to_string(runner.state()), to_string(runner.guard().reason()), plant.truth().time, fastest,
                plant.truth().objects[0].peak_force);
    if (kind == lang::FaultKind::torque_flipped) {
      const double gained = 0.3 * 2.0 * push / driven_mass(program.robot);
      EXPECT_EQ(runner.guard().reason(), EventCode::not_followed);
      EXPECT_TRUE(runner.finished());
      EXPECT_LT(fastest, 1.3 * cruise + 0.02 + gained);
      EXPECT_LT(plant.truth().velocity.norm(), 0.02);
    } else {
      EXPECT_LT(fastest, 1.1 * cruise);
      EXPECT_LT(plant.truth().objects[0].peak_force, 548.0) << "as limited_obstacle.yaml allows";
    }
  }
}

/// v^2/2a and what it rolls on until the drive's loop is told and follows: v (delay + 2/rate + T_c).
/// A wheel that is told 1 rad/s turns the other way, at 0.5 rad/s and faster by `growth` [rad/s^2].
std::optional<Event> look_at_a_wheel(const lang::Robot& robot, double growth) {
  VelocityDrive drive(robot, robot.control_period, 1);
  Command command(robot.model.joint_count());
  solver::State state(robot.model);
  const int joint = *robot.model.find_joint("front_left_left_hub");
  const double cycle = 1.0 / robot.drive.rate;
  std::optional<Event> found;
  for (double t = 0.0; t < 2.0 && !found; t += cycle) {
    state.qd(joint) = -0.5 - growth * t;
    command.velocity(joint) = 1.0;
    drive.brake(&state.qd, -1, command);
    found = drive.look(state, t);
  }
  return found;
}

/// Other motors and a wall turn a wheel that rests on its small torque limit. Told 1 rad/s within the lead of
/// 70 ms, a sound motor asks for 21 rad/s^2, and a reversed one gives them the other way.
TEST(LimitedDrive, AWheelThatOthersTurnIsNoFaultOfItsMotor) {
  const lang::Robot robot = in_scene("wall_align", "limited/kelo_20_hz", "wall_far").robot;
  EXPECT_FALSE(look_at_a_wheel(robot, 0.0));
  EXPECT_FALSE(look_at_a_wheel(robot, 1.0));
  const std::optional<Event> found = look_at_a_wheel(robot, 21.0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->code, EventCode::not_followed);
  EXPECT_LE(found->time, VelocityDrive::fast.time + 2.0 / robot.drive.rate);
}

TEST(LimitedDrive, TheProtectiveStopRampsTheVelocityDown) {
  for (const char* robot : {"limited/mecanum_1_khz", "limited/mecanum_20_hz"}) {
    const lang::Program program = in_scene("obstacle", robot, "obstacle");
    ScenePlant plant(program);
    Runner runner(program);
    Sensed sensed(program);
    double from = 0.0, v = 0.0;
    while (!runner.finished() && plant.truth().time < 10.0) {
      if (plant.truth().time >= 3.0 && !runner.guard().stopped()) {
        runner.guard().stop(EventCode::requested);
        from = plant.truth().x;
        v = plant.truth().velocity.x();
      }
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      runner.step(sensed);
      ASSERT_EQ(plant.follow(runner.command()), PlantStatus::ok);
    }
    const lang::Drive& drive = program.robot.drive;
    const double rolls_on = v * (drive.delay + 2.0 / drive.rate + drive.time_constant);
    EXPECT_TRUE(runner.finished());
    EXPECT_GT(v, 0.14);
    EXPECT_LT(plant.truth().velocity.norm(), 0.01);
    EXPECT_LE(plant.truth().x - from, v * v / (2.0 * program.robot.stop.deceleration) + rolls_on) << robot;
  }
}

/// In the stop torques may only take energy: a base that stands at a wall is let go of.
TEST(LimitedDrive, AProtectiveStopAtAWallPressesNoMore) {
  const lang::Program program = in_scene("wall_align", "limited/mecanum_50_hz", "wall_far");
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program);
  const ObjectTruth& wall = plant.truth().objects[0];
  double stopped = 0.0;
  while (plant.truth().time < 30.0 && !(stopped > 0.0 && plant.truth().time > stopped + 2.0)) {
    const bool has_settled = wall.touched && plant.truth().time > *wall.touched + 2.5 && wall.force > 15.0;
    if (has_settled && stopped == 0.0) {
      runner.guard().stop(EventCode::requested);
      stopped = plant.truth().time;
    }
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    runner.step(sensed);
    ASSERT_EQ(plant.follow(runner.command()), PlantStatus::ok);
  }
  EXPECT_GT(stopped, 0.0);
  EXPECT_LT(wall.force, 0.5);
}

TEST(LimitedDrive, StopsWhenItsSamplesStayAway) {
  const lang::Program program = in_scene("wall_align", "limited/mecanum_50_hz", "wall_far");
  Runner runner(program);
  Sensed sensed(program);
  sensed.measured_at = 0.0;
  const lang::Drive& drive = program.robot.drive;
  const double longest = 0.5 * drive.delay + 3.0 / drive.rate + 0.05;
  for (int i = 0; i < 1000 && !runner.guard().stopped(); ++i) {
    sensed.time = 1e-3 * i;
    runner.step(sensed);
  }
  EXPECT_EQ(runner.guard().reason(), EventCode::lost_ticks);
  EXPECT_NEAR(sensed.time, longest, 1.5e-3);
}

TEST(LimitedDrive, ReplaysBitByBitAndAllocatesNothing) {
  test::expect_replay_without_heap_calls(in_scene("wall_align", "limited/mecanum_50_hz", "wall_far"), 2000);
}

}  // namespace
}  // namespace zwang::runtime
