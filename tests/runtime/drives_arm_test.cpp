// An arm that nobody commands, on the plant: it stays where it is, and the base under it keeps its newtons.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "../temporary_folder.hpp"
#include "constants.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

namespace fs = std::filesystem;

lang::Program load(const fs::path& task, const fs::path& scene,
                   const char* robot = "robots/mecanum_arm_base.yaml") {
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  options.robot = zwang::test::specs(robot);
  options.scene = scene;
  options.root = "/";
  const auto program = lang::load(task, options, diagnostics);
  std::ostringstream words;
  lang::render_human(diagnostics, words);
  if (!program) throw std::runtime_error(words.str());
  return *program;
}

/// Of a task file's text, whose robot is one of specs/.
lang::Program load_text(std::string text, const fs::path& scene) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "task.yaml";
  text.replace(text.find("robots/"), 7, zwang::test::specs("robots/"));
  std::ofstream(file) << text;
  return load(file, scene);
}

/// The largest way of an arm joint from where it stood at `since`. [rad]
class ArmWatch {
 public:
  explicit ArmWatch(const lang::Program& program) : posture_(program.robot.posture) {
    for (int j = 0; j < program.robot.model.joint_count(); ++j) {
      if (program.robot.model.joint(j).name.rfind("arm_", 0) == 0) joints_.push_back(j);
    }
    EXPECT_EQ(joints_.size(), 7u);
  }
  void start(const solver::State& state) { posture_ = state.q; }
  double way(const solver::State& state) const {
    double most = 0.0;
    for (const int j : joints_) most = std::max(most, std::abs(state.q(j) - posture_(j)));
    return most;
  }

 private:
  Eigen::VectorXd posture_;
  std::vector<int> joints_;
};

// Under way a held arm moves only because the plant's contacts and integration differ from the model. At the
// wall the model predicts that the arm accelerates with the base by 20 N / 54 kg, but it does not. So the arm
// bends by T^2 times that over a link's pendulum length of 0.1 m or more:
//   0.0025 s^2 x 3.7 rad/s^2 = 0.53 deg
// The base presses with all 20 N. With a model of an arm that hangs loose, and falls, it would be 12 N.
TEST(UnusedArm, StaysWhereItIsAndTheBaseKeepsItsNewtons) {
  lang::Program program =
      load(zwang::test::specs("wall_align.yaml"), zwang::test::specs("scenes/wall_far.yaml"),
           "robots/mecanum_arm_folded.yaml");  // stretched out, the arm would touch the wall first: E621
  program.robot.posture.setZero();             // the arm points straight up, and would fall to any side
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program.robot.model, program.signals.size());
  const ArmWatch arm(program);
  double way = 0.0, at_end = 0.0, force = 0.0;
  while (!runner.finished() && plant.truth().time < 30.0) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    at_end = arm.way(plant.true_state());
    if (!plant.truth().objects[0].touched) way = std::max(way, at_end);
    const Eigen::VectorXd& tau = runner.step(sensed);
    if (runner.state() == RunState::running) force = plant.truth().objects[0].force;
    ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
  }
  std::printf(
      "arm moved by %.3f deg before the wall, %.3f deg at the end, wall pressed with %.3f N, yaw %.4f deg\n",
      way / degree, at_end / degree, force, plant.truth().yaw / degree);
  EXPECT_EQ(runner.state(), RunState::done);
  EXPECT_LT(way, 0.1 * degree);
  EXPECT_LT(at_end, 0.53 * degree);
  EXPECT_NEAR(force, 20.0, 0.1);
  EXPECT_LT(std::abs(plant.truth().yaw), 0.1 * degree);
}

const char* const reach_text = R"(zwang: 1
robot: robots/mecanum_arm_base.yaml
start: reach
tasks:
  reach:
    constraints:
      stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
      lift: {move: tool, in: base_link, x: {position: here}, y: {position: here}, z: {velocity: 0.1 m/s},
             rx: {velocity: 0 rad/s}, ry: {velocity: 0 rad/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 1 s, goto: drive}]
  drive:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: 0.3 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 2 s, goto: done}]
)";

// Let go of while it moves at 0.1 m/s, the arm comes back to where it was then, and stays; it does not drop.
// A position reaches 2 % of its way after 5.8 time constants.
TEST(UnusedArm, IsTakenOverWhenATaskLetsGoOfIt) {
  const lang::Program program = load_text(reach_text, zwang::test::specs("scenes/wall_far.yaml"));
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program.robot.model, program.signals.size());
  ArmWatch arm(program);
  const auto frame = program.robot.model.find_frame("tool");
  ASSERT_TRUE(frame);
  const solver::Frame& tool = program.robot.model.frames()[static_cast<std::size_t>(*frame)];
  const auto height = [&] {
    return solver::motion_of({tool.body, tool.pose_in_body, {}}, program.robot.model, plant.true_state())
        .pose.position.z();
  };
  double at_switch = 0.0, lowest = 1e9, highest = -1e9, way = 0.0;
  while (!runner.finished() && plant.truth().time < 10.0) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    const double time = plant.truth().time;
    if (time < 0.9995) at_switch = height();
    if (std::abs(time - 2.0) < 1e-6) arm.start(plant.true_state());
    if (time > 1.0) lowest = std::min(lowest, height()), highest = std::max(highest, height());
    if (time > 2.0) way = std::max(way, arm.way(plant.true_state()));
    ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
  }
  std::printf("tool at %.4f m when let go of, then between %.4f m and %.4f m; joints later by %.3f deg\n",
              at_switch, lowest, highest, way / degree);
  EXPECT_EQ(runner.state(), RunState::done);
  // It was lifted at 0.1 m/s, and a fall of 0.2 s would be 20 cm.
  EXPECT_LT(highest, at_switch + 0.02);
  EXPECT_GT(lowest, at_switch - 0.02);
  EXPECT_LT(way, 0.5 * degree);
}

const char* const press_text = R"(
zwang: 1
robot: robots/mecanum_arm_base.yaml
frames:
  shoulder: {parent: shoulder_link, rpy: [180 deg, 0 deg, 0 deg]}
start: go
always:
  constraints:
    held: {move: tool, in: base_link, level: 1, time_constant: 0.1 s, x: {position: here}, y: {position: here}, z: {position: here}, rx: {position: here}, ry: {position: here}, rz: {position: here}}
    elbow: {move: shoulder, in: base_link, level: 1, rz: {position: here, time_constant: 0.1 s}}
tasks:
  go:
    constraints:
      go: {move: base_link, in: world, level: 2, x: {velocity: 0.05 m/s, force: +-30 N, time_constant: 0.1 s}, y: {position: here}, rz: {position: here}}
    exits: [{when: elapsed > 10 s, goto: done}]
)";

// The arm gives way by its own rows, as a soft spring does, and gives back what was pressed into it.
TEST(HeldArm, ThatIsPressedIntoABoardIsNoRunaway) {
  const lang::Program program = load_text(press_text, zwang::test::specs("scenes/board.yaml"));
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program.robot.model, program.signals.size());
  double force = 0.0;
  while (!runner.finished() && plant.truth().time < 15.0) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    const Eigen::VectorXd& tau = runner.step(sensed);
    if (runner.state() == RunState::running) force = plant.truth().objects[0].force;
    ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
  }
  EXPECT_FALSE(runner.guard().stopped());
  EXPECT_EQ(runner.state(), RunState::done);
  EXPECT_NEAR(force, 30.0, 0.01 * 30.0);
}

const char* const lower_text = R"(
zwang: 2
robot: robots/mecanum_arm_base.yaml
frames: {shoulder: {parent: shoulder_link, rpy: [180 deg, 0 deg, 0 deg]}}
start: lower
always:
  constraints:
    stand: {move: base, in: world, time_constant: 0.15 s, x: {position: here}, y: {position: here}, rz: {position: here}}
    elbow: {move: shoulder, in: base, rz: {position: here, time_constant: 50 ms}}
    upright: {move: tool, in: tool, rx: {position: here}, ry: {position: here}, rz: {position: here}, time_constant: 50 ms}
tasks:
  lower:
    constraints:
      hand: {move: tool, in: world, time_constant: 50 ms, x: {position: here}, y: {position: here}, z: {velocity: -4 cm/s, force: +-8 N, build_up: 200 ms}}
    timeout: {after: 5 s, goto: done}
)";

// The tool stands 0.68 m high above objects of 0.6 m: nothing is touched on the first 6 cm. Then the driver
// presses down with its 8 N, and F/K deep: 8 N/(100 kN/m) = 0.08 mm.
TEST(HeldArm, PressesOnTheTopOfWhatStandsBelowIt) {
  for (const char* shape : {"box: [0.4 m, 0.4 m, 0.6 m]", "cylinder: {radius: 0.2 m, height: 0.6 m}"}) {
    const test::TemporaryFolder folder;
    const fs::path scene = folder.path() / "scene.yaml";
    std::ofstream(scene) << "zwang_scene: 1\nobjects:\n  table: {" << shape
                         << ", at: [0.65 m, 0 m], fixed: true}\n";
    const lang::Program program = load_text(lower_text, scene);
    ScenePlant plant(program);
    Runner runner(program);
    Sensed sensed(program.robot.model, program.signals.size());
    const auto frame = program.robot.model.find_frame("tool");
    ASSERT_TRUE(frame);
    const solver::Frame& tool = program.robot.model.frames()[static_cast<std::size_t>(*frame)];
    double force = 0.0, height = 0.0;
    while (!runner.finished() && plant.truth().time < 10.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      const Eigen::VectorXd& tau = runner.step(sensed);
      height = solver::motion_of({tool.body, tool.pose_in_body, {}}, program.robot.model, plant.true_state())
                   .pose.position.z();
      if (height > 0.62) {
        ASSERT_FALSE(plant.truth().objects[0].touched) << shape;
      }
      if (runner.state() == RunState::running) force = plant.truth().objects[0].force;
      ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
    }
    EXPECT_EQ(runner.state(), RunState::done) << shape;
    EXPECT_NEAR(force, 8.0, 0.1) << shape;
    EXPECT_NEAR(height, 0.6 - 8.0 / 100e3, 0.5e-3) << shape;
  }
}

}  // namespace
}  // namespace zwang::runtime
