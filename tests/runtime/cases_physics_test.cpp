// What physics leaves reachable, number by number, judged by the simulated plant. Each test prints its
// figure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::runtime {
namespace {

namespace fs = std::filesystem;
constexpr double period = 1e-3;
constexpr double degree = std::numbers::pi / 180.0;
const fs::path specs = ZWANG_SOURCE_DIR "/specs";

lang::Program load(const fs::path& task, lang::LoadOptions options = {}) {
  lang::Diagnostics diagnostics;
  options.root = "/";
  const auto program = lang::load(task, options, diagnostics);
  std::ostringstream words;
  lang::render_human(diagnostics, words);
  if (!program) throw std::runtime_error(words.str());
  return *program;
}

/// A task file of the test's own.
lang::Program write(const std::string& name, const std::string& text, const fs::path& scene,
                    const std::string& robot = "mecanum_base") {
  const fs::path file = fs::path(testing::TempDir()) / (name + ".yaml");
  std::ofstream(file) << "zwang: 1\nrobot: " << (specs / "robots" / (robot + ".yaml")).string() << "\n"
                      << text;
  lang::LoadOptions options;
  options.scene = scene;
  return load(file, options);
}

double mass_along_x(const lang::Program& program) {
  return solver::analyse_base(program.robot.model, lang::start_state(program.robot)).axes[0].effective_mass;
}

/// One run of a program on the plant.
struct Simulated {
  explicit Simulated(const lang::Program& p, const ScenePlantOptions& options = {})
      : program(p), plant(program, options), runner(program), sensed(program.robot.model, p.signals.size()) {}

  /// `look` sees each tick after the torques are known and before they act.
  void go(double longest, const std::function<void(const Eigen::VectorXd&)>& look) {
    while (!runner.finished() && plant.truth().time < longest) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      prepare();
      const Eigen::VectorXd& tau = runner.step(sensed);
      look(tau);
      ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
    }
  }
  std::string task() const {
    return runner.scheduler().tasks()[static_cast<std::size_t>(runner.scheduler().task())].name;
  }

  const lang::Program program;
  ScenePlant plant;
  Runner runner;
  Sensed sensed;
  std::function<void()> prepare = [] {};
};

class UnexpectedObstacle : public testing::TestWithParam<double> {};

lang::Program obstacle_of(double stiffness) {
  lang::LoadOptions options;
  options.parameters = {{"cruise", "0.30 m/s"}, {"push", "15 N"}};
  lang::Program program = load(specs / "obstacle.yaml", options);
  program.scene->objects.at(0).stiffness =
      stiffness / 2.0;  // of one contact point: two corners meet the face
  return program;
}

// An undamped spring takes the push and the kinetic energy: F + sqrt(F^2 + K m v^2).
TEST_P(UnexpectedObstacle, IsHitOnceWithItsMomentumAndLetGoOfAtOnce) {
  const double stiffness = GetParam();
  Simulated run(obstacle_of(stiffness));
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
  const double bound = 15.0 + std::sqrt(15.0 * 15.0 + stiffness * mass_along_x(run.program) * speed * speed);
  std::printf("K %.0e N/m: peak %.1f N of %.1f N at %.3f m/s, reaction %.0f ms, %d hit\n", stiffness, peak,
              bound, speed, 1e3 * reaction, hits);
  EXPECT_LE(peak, bound);
  EXPECT_GT(peak, 0.5 * bound);
  EXPECT_NEAR(speed, 0.30, 0.003);
  EXPECT_GE(reaction, 0.0);
  EXPECT_LE(reaction, 0.040);
  EXPECT_EQ(hits, 1);
}

// Without anybody to react, the base comes to rest at the obstacle and presses as hard as it may.
TEST_P(UnexpectedObstacle, IsPressedAtRestWithTheForceOfTheRange) {
  lang::Program program = obstacle_of(GetParam());
  for (lang::Task& task : program.tasks) task.exits.clear();
  Simulated run(program);
  double least = 1e9, most = 0.0;
  run.go(16.0, [&](const Eigen::VectorXd&) {
    if (run.plant.truth().time < 15.0) return;
    least = std::min(least, run.plant.truth().objects[0].force);
    most = std::max(most, run.plant.truth().objects[0].force);
  });
  std::printf("K %.0e N/m: at rest %.3f N to %.3f N\n", GetParam(), least, most);
  EXPECT_NEAR(least, 15.0, 0.15);
  EXPECT_NEAR(most, 15.0, 0.15);
}

INSTANTIATE_TEST_SUITE_P(Stiffness, UnexpectedObstacle, testing::Values(1e4, 1e5, 1e6));

const char* const fenced = R"(
regions:
  room: {polygon: [[-2 m, -3 m], [1.5 m, -3 m], [1.5 m, 3 m], [-2 m, 3 m]]}
always:
  constraints:
    fence: {move: footprint, inside: room}
start: go
tasks:
  go:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: 0.5 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 5 s, goto: done}]
)";

/// How far the footprint gets past the edge at x = 1.5 m. [m]
double overshoot(lang::Program program, double payload, double velocity_noise) {
  program.scene->objects.clear();
  program.scene->state.velocity = velocity_noise;
  ScenePlantOptions options;
  options.simulation.start_at = {0.0, 0.0};
  options.simulation.start_yaw = 15.0 * degree;
  options.seed = 7;
  if (payload != 0.0) options.faults.push_back({.kind = lang::FaultKind::payload, .value = payload});
  Simulated run(program, options);
  double farthest = -1e9;
  run.go(8.0, [&](const Eigen::VectorXd&) {
    const Truth& truth = run.plant.truth();
    for (const solver::Vector3& corner : run.program.robot.footprint) {
      const double x = truth.x + std::cos(truth.yaw) * corner.x() - std::sin(truth.yaw) * corner.y();
      farthest = std::max(farthest, x - 1.5);
    }
  });
  EXPECT_GT(farthest, -0.02) << "it never came near";
  return farthest;
}

TEST(Boundary, IsNotCrossedByMoreThanATenthOfAMillimetreNorByAMillimetreWithAWrongMassOrNoise) {
  const lang::Program program = write("fenced", fenced, specs / "scenes/wall_far.yaml");
  const double third = 0.3 * program.robot.model.total_mass();
  const double ideal = overshoot(program, 0.0, 0.0);
  const double heavy = overshoot(program, third, 0.0);
  const double light = overshoot(program, -third, 0.0);
  const double noisy = overshoot(program, 0.0, 0.01);
  std::printf(
      "boundary: past it by %.4f mm, mass +30 %%: %.4f mm, -30 %%: %.4f mm, 1 cm/s of noise: %.4f mm\n",
      1e3 * ideal, 1e3 * heavy, 1e3 * light, 1e3 * noisy);
  EXPECT_LE(ideal, 1e-4);
  EXPECT_LE(heavy, 1e-3);
  EXPECT_LE(light, 1e-3);
  EXPECT_LE(noisy, 1e-3);
}

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

TEST(VelocityLimit, IsHeldAndWithTenMillisecondsOfDelayNearlyHeld) {
  const lang::Program program = write("fast", fast, specs / "scenes/wall_far.yaml");
  const double limit = 0.4;
  const double prompt = highest_speed(program, 0), late = highest_speed(program, 10);
  std::printf("velocity limit 0.4 m/s: %.5f m/s, 10 ms late %.5f m/s\n", prompt, late);
  EXPECT_GT(prompt, 0.99 * limit);
  EXPECT_LE(prompt, 1.001 * limit);
  EXPECT_LE(late, limit + std::max(0.01 * limit, 0.003));
}

const char* const pressing = R"(
signals:
  wanted: {type: number, unit: N, stale_after: 100 ms}
start: press
tasks:
  press:
    constraints:
      contact: {move: base_link, in: base_link, x: {force: wanted, velocity: [-0.05 m/s, 0.08 m/s]}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 20 s, goto: done}]
)";

/// The force on the wall at the end, each motor held back by 0.1 N m of dry friction; `integral` [1/s] of the
/// measured force's error goes into what is asked for.
double pressed(lang::Program program, double integral) {
  for (int j = 0; j < program.robot.model.joint_count(); ++j) {
    if (program.robot.model.joint(j).actuated)
      program.robot.friction[static_cast<std::size_t>(j)] = {.coulomb = 0.1, .compensate = 0.8};
  }
  ScenePlantOptions options;
  options.simulation.start_yaw = 0.0;
  Simulated run(program, options);
  double wanted = 20.0, force = 0.0;
  run.prepare = [&] {
    force = run.plant.truth().objects[0].force;
    if (force > 0.0) wanted = std::clamp(wanted + integral * period * (20.0 - force), 0.0, 40.0);
    SignalSample& sample = run.sensed.signals[0];
    sample.valid = true;
    sample.stamp = run.sensed.time;
    sample.number = wanted;
  };
  double last = 0.0;
  run.go(40.0, [&](const Eigen::VectorXd&) {
    if (run.runner.state() == RunState::running) last = force;
  });
  return last;
}

// Stiction takes up to the sum of tau_c / R from a push without a sensor: 2 x 0.1 N m / 0.130 m = 1.5 N on
// the differential base, 4 x 0.1 N m / 0.0759 m = 5.3 N on the mecanum base. Compensation ends where motion
// ends.
TEST(Push, WithStictionMissesByNoMoreThanItsShareAndWithForceFeedbackByOnePercent) {
  for (const auto& [robot, share] : {std::pair{"diff_base", 0.2 / 0.130}, {"mecanum_base", 0.4 / 0.0759}}) {
    const lang::Program program = write("pressing", pressing, specs / "scenes/wall_far.yaml", robot);
    const double without = pressed(program, 0.0), with = pressed(program, 2.0);
    std::printf(
        "%s, 20 N against 0.1 N m of stiction a motor: %.2f N (%.1f %%), with force feedback %.3f N\n", robot,
        without, 5.0 * (without - 20.0), with);
    EXPECT_NEAR(without, 20.0, 1.01 * share);
    if (share < 2.0) {
      EXPECT_NEAR(without, 20.0, 2.0);
    }
    EXPECT_NEAR(with, 20.0, 0.2);
  }
}

struct Steps {
  double largest = 0.0;  ///< [N] of the commanded planar force, from the tick before a switch to its own
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

/// The step of the commanded force at each switch, against that of the tick before.
Steps steps_of(lang::Program program, bool blended) {
  for (std::size_t t = 0; t < program.tasks.size(); ++t) {
    lang::Task& task = program.tasks[t];
    if (!blended) task.blend.constant = 0.0;
    if (static_cast<int>(t) == program.start) continue;
    for (lang::Group& group : task.groups) {
      for (lang::AxisStatements& axis : group.axes) {
        // A bound that tightens acts at once, and may step.
        if (axis.driver == solver::Quantity::force) axis.velocity.reset();
      }
    }
  }
  Simulated run(program);
  Steps steps;
  Eigen::Vector2d last = Eigen::Vector2d::Zero(), change = last;
  run.go(80.0, [&](const Eigen::VectorXd& tau) {
    const Eigen::Vector2d force = planar_force(run.program.robot, tau);
    const auto& transition = run.runner.scheduler().transition();
    const bool between_tasks =
        transition && transition->from >= 0 && transition->to < run.runner.scheduler().program_task_count();
    if (between_tasks) {
      // What the force did in the tick before goes on: contacts and braking change it, too.
      steps.largest = std::max(steps.largest, (force - last - change).norm());
      ++steps.switches;
    }
    change = force - last;
    last = force;
  });
  return steps;
}

// A row that fades has at most its force range to give away, over the blend: dt/blend of it in a tick.
TEST(Switches, OfTheFourCasesStepByTheBlendsShareOnThePlantAndHarderWithoutIt) {
  struct Case {
    const char* file;
    std::map<std::string, std::string> parameters;
    double fades;  ///< [N] largest range on each of two axes, of a row that leaves and one that enters
  };
  const double both = 2.0 * std::sqrt(2.0);
  for (const Case& c : {Case{"obstacle.yaml", {}, both * 40.0}, Case{"wall_align.yaml", {}, both * 20.0},
                        Case{"docking.yaml", {{"seat_force", "10 N"}}, both * 80.0},
                        Case{"hospital.yaml", {}, both * 60.0}}) {
    lang::LoadOptions options;
    options.parameters = c.parameters;
    const lang::Program program = load(specs / c.file, options);
    const Steps smooth = steps_of(program, true), hard = steps_of(program, false);
    std::printf("%-16s %2d switches: at most %.3f N a tick, %.2f N without a blend (allowed %.2f N)\n",
                c.file, smooth.switches, smooth.largest, hard.largest, period / 0.2 * c.fades);
    EXPECT_GT(smooth.switches, 0);
    EXPECT_LE(smooth.largest, period / 0.2 * c.fades) << c.file;
    // From `press` to `hold` the same push goes on: nothing of it steps either way.
    if (std::string(c.file) != "wall_align.yaml") {
      EXPECT_GT(hard.largest, 3.0 * smooth.largest) << c.file;
    }
  }
}

}  // namespace
}  // namespace zwang::runtime
