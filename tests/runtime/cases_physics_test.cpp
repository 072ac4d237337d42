// The figures that physics leaves reachable, judged by the simulated plant. Each test prints its figure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "../is_long.hpp"
#include "../temporary_folder.hpp"
#include "constants.hpp"
#include "simulated_case.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

struct Meeting {
  const char* robot;
  const char* task;
  double push;       ///< [N] no more than the task's 0.5 m/s^2 of the robot's mass
  double stiffness;  ///< [N/m]
};

void PrintTo(const Meeting& meeting, std::ostream* out) {
  *out << meeting.robot << " against " << meeting.stiffness << " N/m";
}

class UnexpectedObstacle : public testing::TestWithParam<Meeting> {};

lang::Program obstacle_of(const Meeting& meeting) {
  lang::LoadOptions options;
  options.robot = specs / "robots" / (std::string(meeting.robot) + ".yaml");
  options.parameters = {{"cruise", "0.30 m/s"}, {"push", std::to_string(meeting.push) + " N"}};
  lang::Program program = load_file(specs / meeting.task, options);
  program.scene->objects.at(0).stiffness =
      meeting.stiffness / 2.0;  // of one contact point: two corners meet the face
  return program;
}

// An undamped spring takes the push and the kinetic energy: F + sqrt(F^2 + K m v^2).
TEST_P(UnexpectedObstacle, IsHitOnceWithItsMomentumAndLetGoOfAtOnce) {
  const auto [robot, task, push, stiffness] = GetParam();
  Simulated run(obstacle_of(GetParam()));
  double peak = 0.0, speed = 0.0, reaction = -1.0, last_speed = 0.0;
  int hits = 0;
  bool touching = false, over = false;
  run.go(12.0, [&](const Eigen::VectorXd&) {
    const Truth& truth = run.plant.truth();
    over = over || run.task() == "wait";
    if (over) return;  // only the first meeting
    const bool now = truth.objects[0].force > 0.0;
    if (now && !touching && ++hits == 1) speed = last_speed;
    touching = now;
    peak = std::max(peak, truth.objects[0].force);
    last_speed = truth.velocity.x();
    if (reaction < 0.0 && run.task() == "yield") reaction = truth.time - *truth.objects[0].touched;
  });
  const double bound = push + std::sqrt(push * push + stiffness * mass_along_x(run.program) * speed * speed);
  std::printf("%s, K %.0e N/m: peak %.1f N of %.1f N at %.3f m/s, reaction %.0f ms, %d hit\n", robot,
              stiffness, peak, bound, speed, 1e3 * reaction, hits);
  EXPECT_LE(peak, bound);
  EXPECT_GT(peak, 0.5 * bound);
  EXPECT_NEAR(speed, 0.30, 0.003);
  EXPECT_GE(reaction, 0.0);
  EXPECT_LE(reaction, 0.040);
  EXPECT_EQ(hits, 1);
}

// Without anybody to react, the base comes to rest at the obstacle and presses as hard as it may.
TEST_P(UnexpectedObstacle, IsPressedAtRestWithTheForceOfTheRange) {
  const Meeting meeting = GetParam();
  lang::Program program = obstacle_of(meeting);
  for (lang::Task& task : program.tasks) task.exits.clear();
  Simulated run(program);
  double least = 1e9, most = 0.0;
  run.go(16.0, [&](const Eigen::VectorXd&) {
    if (run.plant.truth().time < 15.0) return;
    least = std::min(least, run.plant.truth().objects[0].force);
    most = std::max(most, run.plant.truth().objects[0].force);
  });
  std::printf("%s, K %.0e N/m: at rest %.3f N to %.3f N\n", meeting.robot, meeting.stiffness, least, most);
  EXPECT_NEAR(least, meeting.push, 0.01 * meeting.push);
  EXPECT_NEAR(most, meeting.push, 0.01 * meeting.push);
}

INSTANTIATE_TEST_SUITE_P(Stiffness, UnexpectedObstacle,
                         testing::Values(Meeting{"mecanum_base", "obstacle.yaml", 15.0, 1e4},
                                         Meeting{"mecanum_base", "obstacle.yaml", 15.0, 1e5},
                                         Meeting{"mecanum_base", "obstacle.yaml", 15.0, 1e6},
                                         Meeting{"omni_base", "obstacle.yaml", 10.0, 1e4},
                                         Meeting{"omni_base", "obstacle.yaml", 10.0, 1e5},
                                         Meeting{"omni_base", "obstacle.yaml", 10.0, 1e6},
                                         Meeting{"diff_base", "obstacle.yaml", 15.0, 1e4},
                                         Meeting{"diff_base", "obstacle.yaml", 15.0, 1e5},
                                         Meeting{"diff_base", "obstacle.yaml", 15.0, 1e6}));

/// Ahead at `speed` in a room with the corners of `polygon`.
std::string fenced(const std::string& polygon, const std::string& speed) {
  return "regions:\n  room: {polygon: " + polygon + R"(}
always:
  constraints:
    fence: {move: footprint, inside: room}
start: go
tasks:
  go:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: )" +
         speed + R"(}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 5 s, goto: done}]
)";
}

const std::string wide = fenced("[[-2 m, -3 m], [1.5 m, -3 m], [1.5 m, 3 m], [-2 m, 3 m]]", "0.5 m/s");
// Both edges of a corner at once: at 45 deg neither has the braking to itself.
const std::string cornered =
    fenced("[[-2 m, -2 m], [1.5 m, -2 m], [1.5 m, 1.5 m], [-2 m, 1.5 m]]", "0.8 m/s");

/// How far the footprint, turned by yaw, gets past the edges at x = 1.5 m and y = 1.5 m. [m]
double overshoot(lang::Program program, double yaw, double payload, double velocity_noise) {
  program.scene->objects.clear();
  program.scene->state.velocity = velocity_noise;
  program.scene->state.wheels_only = false;  // what wheels alone believe of the way is another matter
  ScenePlantOptions options;
  options.simulation.start_at = {0.0, 0.0};
  options.simulation.start_yaw = yaw;
  options.seed = 7;
  if (payload != 0.0) options.faults.push_back({.kind = lang::FaultKind::payload, .value = payload});
  Simulated run(program, options);
  double farthest = -1e9;
  run.go(8.0, [&](const Eigen::VectorXd&) {
    const Truth& truth = run.plant.truth();
    for (const solver::Vector3& corner : run.program.robot.footprint) {
      const double x = truth.x + std::cos(truth.yaw) * corner.x() - std::sin(truth.yaw) * corner.y();
      const double y = truth.y + std::sin(truth.yaw) * corner.x() + std::cos(truth.yaw) * corner.y();
      farthest = std::max({farthest, x - 1.5, y - 1.5});
    }
  });
  EXPECT_GT(farthest, -0.02) << "it never came near";
  return farthest;
}

class Boundary : public testing::TestWithParam<const char*> {};

TEST_P(Boundary, IsNotCrossedByMoreThanATenthOfAMillimetreNorByAMillimetreWithAWrongMassOrNoise) {
  const lang::Program program = write(wide, specs / "scenes/wall_far.yaml", GetParam());
  const double third = 0.3 * program.robot.model.total_mass();
  for (const double yaw : {0.0, 15.0 * degree}) {  // met by an edge of the footprint, and by a corner
    const double ideal = overshoot(program, yaw, 0.0, 0.0);
    const double heavy = overshoot(program, yaw, third, 0.0);
    const double light = overshoot(program, yaw, -third, 0.0);
    const double noisy = overshoot(program, yaw, 0.0, 0.01);
    std::printf(
        "%s, boundary at %.0f deg: past it by %.4f mm, mass +30 %%: %.4f mm, -30 %%: %.4f mm, 1 cm/s of "
        "noise: %.4f mm\n",
        GetParam(), yaw / degree, 1e3 * ideal, 1e3 * heavy, 1e3 * light, 1e3 * noisy);
    EXPECT_LE(ideal, 1e-4);
    EXPECT_LE(heavy, 1e-3);
    EXPECT_LE(light, 1e-3);
    EXPECT_LE(noisy, 1e-3);
    EXPECT_NE(noisy, ideal) << "there was no noise";
  }
}

// A corner of the region: both edges ask for the one acceleration that the base has.
TEST_P(Boundary, IsNotCrossedAtACornerWhereTwoEdgesBrakeAtOnce) {
  const lang::Program program = write(cornered, specs / "scenes/wall_far.yaml", GetParam());
  const double third = 0.3 * program.robot.model.total_mass();
  for (const double yaw : {30.0 * degree, 45.0 * degree}) {
    const double ideal = overshoot(program, yaw, 0.0, 0.0);
    const double heavy = overshoot(program, yaw, third, 0.0);
    const double noisy = overshoot(program, yaw, 0.0, 0.01);
    std::printf(
        "%s, corner at %.0f deg: past it by %.4f mm, mass +30 %%: %.4f mm, 1 cm/s of noise: %.4f mm\n",
        GetParam(), yaw / degree, 1e3 * ideal, 1e3 * heavy, 1e3 * noisy);
    EXPECT_LE(ideal, 1e-4);
    EXPECT_LE(heavy, 1e-3);
    EXPECT_LE(noisy, 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(Drives, Boundary, testing::Values("mecanum_base", "omni_base", "diff_base"));

const char* const fast = R"(
start: go
tasks:
  go:
    constraints:
      go: {move: base_link, in: base_link, x: {acceleration: 0.5 m/s^2, velocity: +-0.4 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 2 s, goto: done}]
)";

/// The highest speed of a run whose samples come `delay` ticks late. [m/s]
double highest_speed(lang::Program program, std::size_t delay) {
  program.scene->objects.clear();
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program.robot.model, program.signals.size());
  std::deque<Sensed> on_way;
  double highest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    on_way.push_back(sensed);
    if (on_way.size() > delay + 1) on_way.pop_front();
    const bool arrived = on_way.size() == delay + 1;
    const Eigen::VectorXd tau = arrived ? runner.step(on_way.front())
                                        : Eigen::VectorXd::Zero(program.robot.model.joint_count()).eval();
    EXPECT_EQ(plant.apply(tau), PlantStatus::ok);
    highest = std::max(highest, plant.truth().velocity.head<2>().norm());
  }
  return highest;
}

class VelocityLimit : public testing::TestWithParam<const char*> {};

TEST_P(VelocityLimit, IsHeldAndWithTenMillisecondsOfDelayNearlyHeld) {
  const lang::Program program = write(fast, specs / "scenes/wall_far.yaml", GetParam());
  const double limit = 0.4;
  const double prompt = highest_speed(program, 0), late = highest_speed(program, 10);
  std::printf("%s, velocity limit 0.4 m/s: %.5f m/s, 10 ms late %.5f m/s\n", GetParam(), prompt, late);
  EXPECT_GT(prompt, 0.99 * limit);
  EXPECT_LE(prompt, 1.001 * limit);
  EXPECT_LE(late, limit + std::max(0.01 * limit, 0.003));
}

INSTANTIATE_TEST_SUITE_P(Drives, VelocityLimit, testing::Values("mecanum_base", "omni_base", "diff_base"));

struct Steps {
  double at_switch = 0.0;  ///< [N] of the commanded planar force, from the tick before a switch to its own
  double in_blend = 0.0;   ///< [N] in a tick, from then until the blend is over
  int switches = 0;
};

/// J' tau of four 45 degree mecanum wheels, x and y.
Eigen::Vector2d planar_force(const lang::Robot& robot, const Eigen::VectorXd& tau) {
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const double torque = tau(wheel.body - 1);
    force += torque / wheel.radius * Eigen::Vector2d(1.0, -1.0 / std::tan(*wheel.roller_angle));
  }
  return force;
}

lang::Program without_blends(lang::Program program) {
  for (lang::Task& task : program.tasks) task.blend.constant = 0.0;
  return program;
}

/// Velocity ranges beside a force act at once and may tighten: with none of them, only what fades is left.
lang::Program without_ranges(lang::Program program) {
  for (lang::Task& task : program.tasks) {
    for (lang::Group& group : task.groups) {
      for (lang::AxisStatements& axis : group.axes) {
        if (&task != &program.tasks[static_cast<std::size_t>(program.start)] &&
            axis.driver == solver::Quantity::force)
          axis.velocity.reset();
      }
    }
  }
  return program;
}

/// Whether only the switch changes the commands. The partner has not just been seen anew, and nothing throws
/// the base harder than its motors do.
bool is_quiet(const Sensed& sensed, const Truth& truth, std::vector<double>& stamps) {
  bool is_new = false;
  stamps.resize(sensed.signals.size(), -1.0);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const bool is_rare = sensed.signals[i].stamp != sensed.time && sensed.signals[i].stamp != stamps[i];
    is_new = is_new || is_rare;
    stamps[i] = sensed.signals[i].stamp;
  }
  return !is_new && truth.acceleration.head<2>().norm() < 1.0;
}

/// How far the commanded force goes in one tick, at each switch between tasks and in the blend after it.
Steps steps_of(const lang::Program& program) {
  Simulated run(program);
  Steps steps;
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  std::vector<double> stamps;
  double until = -1.0;
  run.go(80.0, [&](const Eigen::VectorXd& tau) {
    const Eigen::Vector2d force = planar_force(run.program.robot, tau);
    const double step = (force - last).norm(), time = run.plant.truth().time;
    const auto& transition = run.runner.scheduler().transition();
    const bool between_tasks =
        transition && transition->from >= 0 && transition->to < run.runner.scheduler().program_task_count();
    const bool quiet = is_quiet(run.sensed, run.plant.truth(), stamps);
    if (between_tasks && quiet) {
      steps.at_switch = std::max(steps.at_switch, step);
      ++steps.switches;
    } else if (time < until && quiet) {
      steps.in_blend = std::max(steps.in_blend, step);
    }
    if (between_tasks)
      until = time + run.program.tasks[static_cast<std::size_t>(transition->to)].blend.constant;
    last = force;
  });
  return steps;
}

// A row that fades gives away at most its force range over the blend, so dt/blend of it in a tick. It is
// twice that if a leaving row and an entering row oppose each other. A velocity range beside a force enters
// at once, to be kept when the blend is over. It takes m (range - v) / blend from the push of a faster base,
// and nothing from that of a slower one.
TEST(Switches, OfTheFourCasesStepByTheBlendsShareOnThePlantAndHarderWithoutIt) {
  struct Case {
    const char* file;
    std::map<std::string, std::string> parameters;
    double fades;   ///< [N] largest force range of a row that leaves or enters
    double blend;   ///< [s] the shortest
    double capped;  ///< [N] what a velocity range that enters takes from the force at once
  };
  const double mass = mass_along_x(load_file(specs / "wall_align.yaml"));
  for (const Case& c :
       {Case{"obstacle.yaml", {}, 40.0, 0.2, 0.0}, Case{"wall_align.yaml", {}, 20.0, 0.3, 0.0},
        Case{"docking.yaml", {{"seat_force", "10 N"}}, 80.0, 0.2, mass * (0.08 - 0.05) / 0.2},
        Case{"hospital.yaml", {}, 60.0, 0.2, 0.0}}) {
    if (std::string(c.file) == "hospital.yaml" && !zwang::test::is_long()) continue;  // 70 s, three times
    lang::LoadOptions options;
    options.parameters = c.parameters;
    const lang::Program program = load_file(specs / c.file, options);
    const Steps smooth = steps_of(program), hard = steps_of(without_blends(program));
    const Steps faded = steps_of(without_ranges(program));
    const double share = period / c.blend * c.fades;
    std::printf(
        "%-16s %2d switches: at most %.3f N from the tick before, %.3f N a tick in the blend, %.3f N and "
        "%.3f N "
        "without ranges beside forces; without a blend %.2f N; dt/blend F = %.2f N, a range takes %.2f N\n",
        c.file, smooth.switches, smooth.at_switch, smooth.in_blend, faded.at_switch, faded.in_blend,
        hard.at_switch, share, c.capped);
    EXPECT_GT(faded.switches, 0) << c.file;
    EXPECT_LE(faded.at_switch, share) << c.file;
    EXPECT_LE(faded.in_blend, 2.0 * share * (1.0 + 1e-6)) << c.file;
    EXPECT_LE(smooth.at_switch, share + c.capped) << c.file;
    EXPECT_LE(smooth.in_blend, 2.0 * share * (1.0 + 1e-6)) << c.file;
    // From `press` to `hold` the same push goes on: nothing of it steps either way.
    // Without a blend a force steps as far as the slew of the motors lets it.
    if (std::string(c.file) != "wall_align.yaml") {
      EXPECT_GT(hard.at_switch, smooth.at_switch) << c.file;
      EXPECT_GT(hard.at_switch, 3.0 * faded.at_switch) << c.file;
    }
  }
}

}  // namespace
}  // namespace zwang::runtime
