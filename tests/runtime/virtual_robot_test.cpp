// A drive that takes velocities and has torque limits of its own. Its lead is compared with the loop's
// equation, and the virtual robot's correction by samples with its own equation. The plant judges the stop
// and the twist.
#include "drive/virtual_robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "constants.hpp"
#include "recorded_run.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

lang::Program under_law(const std::string& task, const std::string& robot) {
  return zwang::test::shipped_files("laws/" + task + ".yaml", "robots/blind/" + robot + ".yaml");
}

/// v' = (c - v)/T_c + S, S' = (c - v)/(T_c T_i): what VelocityLoop makes of a base alone on the floor.
class Loop {
 public:
  explicit Loop(const lang::Drive& drive) : drive_(drive) {}
  void step(double c, double step) {
    const double off = c - v;
    v += step * (off / drive_.time_constant + sum_);
    if (drive_.integral_time) sum_ += step * off / (drive_.time_constant * *drive_.integral_time);
  }
  double v = 0.0;

 private:
  lang::Drive drive_;
  double sum_ = 0.0;
};

lang::Drive loop_drive(double rate, std::optional<double> integral_time) {
  lang::Drive drive;
  drive.rate = rate;
  drive.time_constant = 20 * ms;
  drive.integral_time = integral_time;
  return drive;
}

const std::optional<double> integral_times[] = {std::nullopt, 0.1, 0.03};

TEST(LoopInput, AVelocityLoopFollowsARampWithoutALag) {
  constexpr double step = 0.1 * ms, a = 1.0;
  for (const std::optional<double>& integral_time : integral_times) {
    const lang::Drive drive = loop_drive(1.0 / step, integral_time);
    LoopInput input(drive, step, 1);
    Loop loop(drive);
    double V = 0.0;
    for (int i = 0; i < 20000; ++i) {
      V += step * (i < 5000 ? a : i < 10000 ? 0.0 : -a);
      input.update(Eigen::VectorXd::Constant(1, V));
      loop.step(input.value()(0), step);
      // A step of Euler's method is off by a h where the acceleration changes. The plain lead T_c V' would be
      // off by T_c a, which is 20 mm/s.
      ASSERT_NEAR(loop.v, V, 3.0 * a * step) << i << ", T_i " << integral_time.value_or(0.0);
    }
  }
}

/// A command is held for a cycle, and V' jumps at any time in it. Without means over a cycle the wheel gains
/// up to 1.44 a h in one.
TEST(LoopInput, AHeldCommandAcceleratesAWheelAsItIsMeantTo) {
  constexpr double a = 1.0;
  for (const double rate : {100.0, 50.0, 20.0}) {
    for (const std::optional<double>& integral_time : integral_times) {
      const lang::Drive drive = loop_drive(rate, integral_time);
      const int cycle = static_cast<int>(std::lround(1000.0 / rate));
      double most = 0.0;
      for (int phase = 0; phase < cycle; phase += 3) {
        LoopInput input(drive, ms, 1);
        Loop loop(drive);
        double V = 0.0, told = 0.0;
        std::vector<double> past(static_cast<std::size_t>(cycle), 0.0);
        for (int i = 0; i < 2000; ++i) {
          V += ms * (i < 500 ? a : i < 1000 ? 0.0 : i < 1400 ? -a : a);
          input.update(Eigen::VectorXd::Constant(1, V));
          if (i % cycle == phase) told = input.value()(0);
          for (int k = 0; k < 10; ++k) loop.step(told, 0.1 * ms);
          double& then = past[static_cast<std::size_t>(i % cycle)];
          most = std::max(most, std::abs(loop.v - then) * rate);
          then = loop.v;
        }
      }
      std::printf("%g Hz, T_i %g: %.3f\n", rate, integral_time.value_or(0.0), most / a);
      EXPECT_LT(most, 1.1 * a) << rate << ", T_i " << integral_time.value_or(0.0);
    }
  }
}

Eigen::VectorXd any_torque(const lang::Program& program) {
  return Eigen::VectorXd::Constant(program.robot.model.joint_count(), solver::infinity);
}

/// Samples that differ by d from where the base was led then leave d e^(-t/T) of it.
TEST(VirtualRobot, SamplesCorrectItsPoseWithinASecond) {
  const lang::Program program = under_law("fence", "mecanum_50_hz");
  VirtualRobot robot(program.robot, 1 * ms);
  const solver::Solver solver(program.robot.model);
  solver::State state(program.robot.model);
  const solver::Solution rests(program.robot.model);
  robot.begin(state, 0.0);
  solver::State measured = state;
  measured.base_pose.position.x() = 0.01;
  for (int i = 1; i <= 2000; ++i) {
    robot.move(state, solver, rests, any_torque(program), i * ms);
    if (i % 20 == 0) robot.correct(measured, i * ms);
    robot.put(state);
  }
  const double corrected_for = 2.0 - robot.lag();
  EXPECT_NEAR(state.base_pose.position.x(), 0.01 * (1.0 - std::exp(-corrected_for)), 1e-5);
  EXPECT_EQ(state.base_twist.linear.norm(), 0.0);
}

/// A sample of a base that follows by exactly the lag corrects nothing.
TEST(VirtualRobot, ABaseThatFollowsByTheLagIsNotCorrected) {
  const lang::Program program = under_law("fence", "mecanum_50_hz");
  VirtualRobot robot(program.robot, 1 * ms);
  const solver::Solver solver(program.robot.model);
  solver::State state(program.robot.model);
  const double v = 0.5;
  state.base_twist.linear.x() = v;
  for (const solver::Wheel& wheel : program.robot.model.wheels()) state.qd(wheel.body - 1) = v / wheel.radius;
  const solver::Solution goes_on(program.robot.model);
  robot.begin(state, 0.0);
  solver::State measured = state;
  for (int i = 1; i <= 2000; ++i) {
    robot.move(state, solver, goes_on, any_torque(program), i * ms);
    measured.base_pose.position.x() = v * (i * ms - robot.lag());
    if (i % 20 == 0) robot.correct(measured, i * ms);
    robot.put(state);
    // The nearest pose that is remembered may be half a tick beside.
    ASSERT_NEAR(state.base_pose.position.x(), v * i * ms, 0.5 * v * ms) << i;
  }
}

struct Meeting {
  double touched = 0.0, stopped = 0.0;  ///< [s]
  double push = 0.0;                    ///< [N] while it is not stopped
  double told = 0.0;                    ///< [rad/s] at the end
  double push_after = 0.0;              ///< [N] 3 s later
};

/// `from` [m]: the crate's face is at 2.4 m.
Meeting meet(const std::string& robot, double pace, double from) {
  lang::Program program = under_law("meet_unfelt", robot);
  program.scene->start_at[0] = from;
  ScenePlant plant(program);
  Runner runner(program);
  EXPECT_TRUE(runner.set_parameter("pace", pace));
  Sensed sensed(program);
  Meeting result;
  double finished = solver::infinity;  // [s]
  while (plant.truth().time < std::min(60.0, finished + 3.0)) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    runner.step(sensed);
    EXPECT_EQ(plant.follow(runner.command()), PlantStatus::ok);
    if (runner.finished() && std::isinf(finished)) {
      finished = plant.truth().time;
      result.told = runner.command().velocity.lpNorm<Eigen::Infinity>();
    }
    result.push_after = plant.truth().objects[0].force;
    const ObjectTruth& crate = plant.truth().objects[0];
    if (crate.touched) result.touched = *crate.touched;
    if (!runner.guard().stopped()) result.push = std::max(result.push, crate.force);
    if (runner.guard().stopped() && result.stopped == 0.0) result.stopped = plant.truth().time;
  }
  EXPECT_EQ(runner.guard().reason(), EventCode::not_followed) << robot;
  EXPECT_TRUE(runner.finished());
  return result;
}

/// The wheels stand. A command is c = 0.15 m/s. The stop comes after 0.3 s, once the sample has come and the
/// envelope of commands tells nothing else. The envelope fades with T_c + delay + 1/rate.
TEST(BlindDrive, StopsAtWhatItsWheelsDoNotPass) {
  for (const char* robot : {"mecanum_50_hz", "mecanum_20_hz", "diff_50_hz", "mecanum_twist"}) {
    const lang::Drive drive = under_law("fence", robot).robot.drive;
    const double samples = drive.delay + 2.0 / drive.rate;
    const Meeting meeting = meet(robot, 0.15, 1.0);
    std::printf("%s: stopped %.3f s after contact, %.0f N until then, %.0f N 3 s after the stop\n", robot,
                meeting.stopped - meeting.touched, meeting.push, meeting.push_after);
    EXPECT_GT(meeting.touched, 1.0);
    EXPECT_LT(meeting.stopped - meeting.touched, 0.3 + samples + 0.1) << robot;
    EXPECT_EQ(meeting.told, 0.0) << robot;
  }
}

/// 2 cm/s cannot differ by 2 cm/s and 30 %: the slow allowance finds it.
TEST(BlindDrive, StopsWhenItCreepsAgainstAnObstacle) {
  const Meeting meeting = meet("mecanum_50_hz", 0.02, 1.9);
  std::printf("stopped %.3f s after contact, %.0f N until then, %.0f N 3 s after the stop\n",
              meeting.stopped - meeting.touched, meeting.push, meeting.push_after);
  EXPECT_GT(meeting.touched, 1.0);
  EXPECT_LT(meeting.stopped - meeting.touched, 1.2 + 0.2);
}

struct Stopping {
  double past = -solver::infinity;  ///< [m] that the front was beyond the edge, at most
  double fastest = 0.0;             ///< [m/s]
  bool is_stopped = false;
};

/// Before the edge of a region, on a drive whose loop is another than the robot file says.
Stopping stop_before_the_edge(const lang::Drive& true_loop, double payload) {
  const lang::Program program = under_law("fence", "mecanum_50_hz");
  lang::Program as_it_is = program;
  as_it_is.robot.drive = true_loop;
  ScenePlantOptions options;
  if (payload != 0.0)
    options.faults.push_back({.kind = lang::FaultKind::payload, .at = 0.0, .value = payload});
  ScenePlant plant(as_it_is, options);
  Runner runner(program);
  Sensed sensed(program);
  Stopping result;
  while (plant.truth().time < 6.0) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    runner.step(sensed);
    EXPECT_EQ(plant.follow(runner.command()), PlantStatus::ok);
    result.past = std::max(result.past, plant.truth().x + 0.4 - 1.5);
    result.fastest = std::max(result.fastest, plant.truth().velocity.norm());
  }
  result.is_stopped = runner.guard().stopped();
  return result;
}

/// If the loop's T_c is wrong by dT, the lead is wrong by dT. So the base is behind or ahead of its lead by v
/// dT at most. The integral or the pose's correction makes up for it.
TEST(BlindDrive, ALoopThatIsKnownBadlyPassesAnEdgeByItsOwnErrorOnly) {
  const lang::Drive known = under_law("fence", "mecanum_50_hz").robot.drive;
  for (const double factor : {0.5, 1.0, 2.0}) {
    for (const std::optional<double>& integral_time : {std::optional(0.05), std::optional(0.2)}) {
      lang::Drive drive = known;
      drive.time_constant *= factor;
      drive.integral_time = integral_time;
      const Stopping stopping = stop_before_the_edge(drive, 0.0);
      std::printf("T_c %g ms, T_i %g ms: %.2f mm, %.4f m/s\n", drive.time_constant * 1e3,
                  *integral_time * 1e3, stopping.past * 1e3, stopping.fastest);
      EXPECT_FALSE(stopping.is_stopped);
      EXPECT_LT(stopping.past, 0.5 * known.time_constant);
    }
  }
  const Stopping loaded = stop_before_the_edge(known, 25.0);
  std::printf("25 kg more: %.2f mm, %.4f m/s\n", loaded.past * 1e3, loaded.fastest);
  EXPECT_LT(loaded.past, 5e-3);
  EXPECT_FALSE(loaded.is_stopped);
}

/// A driver turns the twist into wheels' velocities: the base goes so, as the plant has it.
TEST(BlindDrive, ABaseThatIsToldATwistGoesSo) {
  for (const char* robot : {"mecanum_twist", "diff_twist"}) {
    const lang::Program program = under_law("fence", robot);
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == 1 && std::string(robot) == "diff_twist") continue;
      ScenePlant plant(program);
      Command command(program.robot.model.joint_count());
      command.twist(axis) = 0.2;
      while (plant.truth().time < 1.5) ASSERT_EQ(plant.follow(command), PlantStatus::ok);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(plant.truth().velocity(i), command.twist(i), 0.002) << robot << axis << i;
    }
  }
}

/// Its torque limits are its own: those that are sent bound nothing.
TEST(BlindDrive, TorqueLimitsThatAreSentBoundNothing) {
  const lang::Program program = under_law("fence", "mecanum_50_hz");
  ScenePlant plant(program);
  Command command(program.robot.model.joint_count());
  for (const solver::Wheel& wheel : program.robot.model.wheels())
    command.velocity(wheel.body - 1) = 0.2 / wheel.radius;
  while (plant.truth().time < 1.5) ASSERT_EQ(plant.follow(command), PlantStatus::ok);
  EXPECT_NEAR(plant.truth().velocity.x(), 0.2, 0.002);
}

/// v^2/2a, and what it rolls on until the drive's loop is told and follows: v (delay + 2/rate + T_c).
TEST(BlindDrive, TheProtectiveStopRampsTheVelocityDown) {
  for (const char* robot : {"mecanum_50_hz", "mecanum_20_hz", "diff_twist"}) {
    const lang::Program program = under_law("fence", robot);
    ScenePlant plant(program);
    Runner runner(program);
    Sensed sensed(program);
    double from = 0.0, v = 0.0;
    while (!runner.finished() && plant.truth().time < 6.0) {
      if (plant.truth().time >= 1.5 && !runner.guard().stopped()) {
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
    std::printf("%s: from %.3f m/s in %.3f m\n", robot, v, plant.truth().x - from);
    EXPECT_TRUE(runner.finished());
    EXPECT_GT(v, 0.4);
    EXPECT_LT(plant.truth().velocity.norm(), 0.01);
    EXPECT_LE(plant.truth().x - from, v * v / (2.0 * program.robot.stop.deceleration) + rolls_on) << robot;
  }
}

/// After a stop was reset the virtual robot begins where the base is: nothing is told to jump.
TEST(BlindDrive, BeginsAnewAfterAStop) {
  const lang::Program program = under_law("fence", "mecanum_50_hz");
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program);
  bool was_reset = false;
  while (plant.truth().time < 3.0) {
    const double time = plant.truth().time;
    if (time >= 1.0 && time < 2.0 && !runner.guard().stopped()) runner.guard().stop(EventCode::requested);
    if (time >= 2.0 && !was_reset) {
      EXPECT_LT(plant.truth().velocity.norm(), 5 * ms);
      runner.guard().reset();
      was_reset = true;
    }
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    runner.step(sensed);
    // 1 m/s^2, and a lead of 20 ms of it.
    if (was_reset && time < 2.1) {
      const double fastest = (time - 2.0 + 0.025) * 1.0;
      EXPECT_LE(runner.command().velocity.lpNorm<Eigen::Infinity>() * 0.0759, fastest + 5 * ms);
    }
    ASSERT_EQ(plant.follow(runner.command()), PlantStatus::ok);
  }
  EXPECT_GT(plant.truth().velocity.x(), 0.3);
}

TEST(BlindDrive, ReplaysBitByBitAndAllocatesNothing) {
  test::expect_replay_without_heap_calls(under_law("fence", "mecanum_twist"), 2000);
}

}  // namespace
}  // namespace zwang::runtime
