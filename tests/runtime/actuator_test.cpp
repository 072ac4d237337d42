// Motors that do not do what they are told, on a real plant: found within 100 ms of when they are told to do
// something. And the estimate of contact forces beside the plant's.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "constants.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

using lang::FaultKind;
using zwang::test::shipped_program;
using zwang::test::specs;

struct Broken {
  const char* robot;
  const char* wheel;
  FaultKind kind;
  const char* task = "obstacle.yaml";
};

void PrintTo(const Broken& broken, std::ostream* out) {
  *out << broken.robot << " " << broken.wheel;
}

class Motor : public testing::TestWithParam<Broken> {};

TEST_P(Motor, ThatDoesNotObeyIsFoundWithin100Milliseconds) {
  const Broken& broken = GetParam();
  const lang::Program program = shipped_program(broken.task, broken.robot);
  ScenePlantOptions options;
  const double at = 0.1;
  lang::Fault fault{.kind = broken.kind, .at = at, .joint = broken.wheel};
  options.faults.push_back(fault);
  ScenePlant plant(program, options);
  Runner runner(program, {.period = period});
  Sensed sensed(program.robot.model, program.signals.size());
  while (!runner.guard().stopped() && plant.truth().time < 3.0) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
  }
  const double found = plant.truth().time - at - period;
  ASSERT_TRUE(runner.guard().stopped());
  const Event& event = runner.guard().stop_event();
  std::printf("%s, %s: %s after %.0f ms, %s misses %.3f N m\n", broken.robot, broken.wheel,
              to_string(event.code), 1e3 * found, runner.event_signal(event).c_str(), event.value);
  EXPECT_LE(found, 0.1);
  EXPECT_EQ(runner.event_signal(event), std::string(broken.wheel) + ".tau");
  const EventCode expected = broken.kind == FaultKind::torque_lost    ? EventCode::torque_lost
                             : broken.kind == FaultKind::torque_stuck ? EventCode::torque_stuck
                                                                      : EventCode::torque_flipped;
  EXPECT_EQ(event.code, expected);
}

INSTANTIATE_TEST_SUITE_P(
    Broken, Motor,
    testing::Values(Broken{"mecanum", "front_left_wheel", FaultKind::torque_lost},
                    Broken{"mecanum", "rear_right_wheel", FaultKind::torque_lost},
                    Broken{"mecanum", "front_right_wheel", FaultKind::torque_flipped},
                    Broken{"mecanum", "front_left_wheel", FaultKind::torque_stuck},
                    Broken{"omni", "front_left_wheel", FaultKind::torque_lost},
                    Broken{"omni", "front_right_wheel", FaultKind::torque_flipped},
                    Broken{"diff", "left_wheel", FaultKind::torque_lost, "wall_align.yaml"},
                    Broken{"diff", "right_wheel", FaultKind::torque_flipped, "wall_align.yaml"},
                    Broken{"kelo", "front_left_left_hub", FaultKind::torque_lost},
                    Broken{"kelo", "rear_right_right_hub", FaultKind::torque_flipped}),
    [](const auto& tested) {
      const Broken& b = tested.param;
      const char* kind = b.kind == FaultKind::torque_lost    ? "_lost"
                         : b.kind == FaultKind::torque_stuck ? "_stuck"
                                                             : "_flipped";
      return std::string(b.robot) + "_" + b.wheel + kind;
    });

/// Steady against the wall the joints stand, and the wheels' friction is 0. So the rest is the model's own
/// error: the difference between the torques' wrench and the wall's.
TEST(EstimatedForce, OfASteadyPushIsThePlantsOwn) {
  for (const char* robot : {"mecanum", "omni", "diff"}) {
    const lang::Program program = shipped_program("wall_align.yaml", robot, "wall");
    ScenePlantOptions options;
    options.simulation.start_yaw = 0.0;
    ScenePlant plant(program, options);
    Runner runner(program, {.period = period});
    Sensed sensed(program.robot.model, program.signals.size());
    double worst = 0.0, worst_free = 0.0;
    std::vector<double> last;
    while (runner.state() == RunState::running && plant.truth().time < 30.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
      const double error = -runner.estimated_force().x() - plant.truth().objects[0].force;
      if (!plant.truth().objects[0].touched) worst_free = std::max(worst_free, std::abs(error));
      last.push_back(error);
    }
    ASSERT_EQ(runner.state(), RunState::done) << robot;
    for (std::size_t i = last.size() - 300; i < last.size(); ++i) worst = std::max(worst, std::abs(last[i]));
    std::printf("%s: estimate off by %.3f N in free motion, by %.3f N in the last 0.3 s at %.2f N\n", robot,
                worst_free, worst, plant.truth().objects[0].force);
    // The plant's own push is within 0.1 N of what is asked of it; the estimate sees it through the same
    // torques.
    EXPECT_LE(worst, 0.2) << robot;
    // In free motion there is nothing: 1 % of the 20 N that the base speeds up with.
    EXPECT_LE(worst_free, 0.2) << robot;
  }
}

/// One wheel that turns by itself while the base and the others stand; then all of them.
TEST(Slip, OfOneWheelAndOfAllIsToldOnceAndWithinASecond) {
  const lang::Program program = shipped_program("wall_align.yaml", "mecanum", "wall_far");
  for (const int slipping : {1, 4}) {
    Runner runner(program, {.period = period});
    Sensed sensed(program.robot.model, program.signals.size());
    sensed.base_measured = true;  // it stands, whatever the wheels say
    double told = -1.0;
    for (int i = 0; i < 1000; ++i) {
      sensed.time = i * period;
      // The free direction of four mecanum wheels is none of these.
      for (int j = 0; j < slipping; ++j) {
        sensed.state.qd(j) = j % 2 == 0 ? 2.0 : -2.0;
        sensed.state.q(j) += sensed.state.qd(j) * period;
      }
      const bool was_told = runner.event_count() > 0;
      runner.step(sensed);
      if (runner.event_count() > 0 && !was_told) told = sensed.time;
    }
    ASSERT_EQ(runner.event_count(), 1U) << slipping;
    EXPECT_EQ(runner.events()[0].code, EventCode::slip);
    std::printf("%d of 4 wheels slip at 0.15 m/s: told after %.0f ms, %s reads %.3f m/s\n", slipping,
                1e3 * told, runner.event_signal(runner.events()[0]).c_str(), runner.events()[0].value);
    EXPECT_LE(told, 1.0);
    EXPECT_FALSE(runner.guard().stopped());
  }
}

/// A force sensor that touches nothing and reads 30 N is told of with the first sample, either way; 2 N are
/// not.
TEST(SensorBias, IsToldAtTheStart) {
  lang::Program program = shipped_program("wall_align.yaml", "mecanum", "wall_far");
  lang::Signal bumper;
  bumper.name = "bumper";
  bumper.type = lang::SignalType::number;
  bumper.measures_force = true;
  bumper.stale_after.constant = 1.0;
  program.signals.push_back(bumper);
  for (const double bias : {30.0, -30.0, 2.0}) {
    Runner runner(program, {.period = period});
    Sensed sensed(program.robot.model, 1);
    for (int i = 0; i < 100; ++i) {
      sensed.time = i * period;
      sensed.signals[0].valid = true;
      sensed.signals[0].stamp = sensed.time;
      sensed.signals[0].number = bias;
      runner.step(sensed);
    }
    if (std::abs(bias) < 5.0) {
      EXPECT_EQ(runner.event_count(), 0U);
      continue;
    }
    ASSERT_EQ(runner.event_count(), 1U) << bias;
    EXPECT_EQ(runner.events()[0].code, EventCode::sensor_bias);
    EXPECT_EQ(runner.events()[0].time, 0.0);
    EXPECT_EQ(runner.events()[0].value, bias);
    EXPECT_EQ(runner.event_signal(runner.events()[0]), "signal.bumper");
  }
}

/// A task that requires its sensor to be quiet is not entered: that has an event of its own, beside the bias.
TEST(SensorBias, ThatATaskDoesNotAllowIsARefusalWithItsOwnCode) {
  const lang::Program program = shipped_program("feel_wall.yaml", "mecanum", "wall_felt_more");
  ScenePlant plant(program);
  Runner runner(program, {.period = period});
  Sensed sensed(program.robot.model, program.signals.size());
  ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
  runner.step(sensed);
  EXPECT_EQ(runner.state(), RunState::failed);
  ASSERT_EQ(runner.event_count(), 2U);
  EXPECT_EQ(runner.events()[0].code, EventCode::sensor_bias);
  EXPECT_EQ(runner.events()[1].code, EventCode::entry_refused);
  EXPECT_EQ(runner.events()[1].time, sensed.time);
  const auto refused = static_cast<std::size_t>(runner.events()[1].value);
  EXPECT_EQ(runner.scheduler().tasks().at(refused).name, "approach");
}

/// A task file that changes under way. The new file takes over between two ticks without a jump of a torque.
/// If the new file does not load, the old program runs on.
TEST(HotReload, SwapsAtATickWithoutAJump) {
  const lang::Program drive = shipped_program("obstacle.yaml", "mecanum");
  lang::Program faster = drive;
  ASSERT_EQ(faster.parameters[0].name, "cruise");
  faster.parameters[0].value = 0.4;
  ScenePlant plant(drive);
  Runner runner(drive, {.period = period});
  Runner next(faster, {.period = period});
  Sensed sensed(drive.robot.model, drive.signals.size());
  Eigen::VectorXd last = Eigen::VectorXd::Zero(4);
  double before = 0.0, after = 0.0, apart = 0.0;
  for (int i = 0; i < 600; ++i) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    if (i == 150) {  // speeding up with 0.5 m/s^2
      ASSERT_TRUE(runner.swap_program(next));
    }
    const Eigen::VectorXd tau = runner.step(sensed);
    const double jump = (tau - last).lpNorm<Eigen::Infinity>();
    if (i > 0 && i < 150) before = std::max(before, jump);
    if (i >= 150) after = std::max(after, jump);
    if (i == 149) apart = tau.lpNorm<Eigen::Infinity>();
    last = tau;
    ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
  }
  std::printf("largest step of a torque in a tick: %.4f N m before, %.4f N m after the swap at %.3f N m\n",
              before, after, apart);
  EXPECT_EQ(runner.state(), RunState::running);
  EXPECT_EQ(runner.scheduler().parameters()[0], 0.4);
  EXPECT_GT(plant.truth().velocity.x(), 0.16) << "the new program's pace, not the old one's 0.15 m/s";
  // All that fades at a switch is less than the largest torque; it has 0.2 s to do so, twice over.
  EXPECT_LE(after, 2.0 * 2.0 * apart * period / Runner::handover);

  Runner other(shipped_program("obstacle.yaml", "omni"), {.period = period});
  EXPECT_EQ(runner.swap_program(other).refusal, SwapRefusal::joints);
  EXPECT_EQ(runner.swap_program(next).refusal, SwapRefusal::has_run);
  Runner slower(drive, {.period = 2.0 * period});
  EXPECT_EQ(runner.swap_program(slower).refusal, SwapRefusal::period);
  runner.guard().stop(EventCode::requested);
  Runner late(drive, {.period = period});
  const SwapResult refused = runner.swap_program(late);
  EXPECT_EQ(refused.refusal, SwapRefusal::stopped);
  EXPECT_EQ(describe(refused), "the protective stop is latched");
}

TEST(HotReload, AHalfWrittenFileIsRefusedOrWholeInItself) {
  std::ifstream in(specs("obstacle.yaml"));
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("zwang_half_written_" + std::to_string(getpid()) + ".yaml");
  lang::LoadOptions options;
  options.root = "/";
  options.robot = specs("robots/mecanum_base.yaml");
  options.scene = specs("scenes/obstacle.yaml");
  const lang::Program drive = shipped_program("obstacle.yaml", "mecanum");
  int refused = 0, read = 0;
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    std::ofstream(file) << whole.substr(0, size);
    lang::Diagnostics diagnostics;
    const auto program = lang::load(file, options, diagnostics);
    program ? ++read : ++refused;
    EXPECT_TRUE(program.has_value() || diagnostics.has_errors()) << size;
    if (!program) continue;
    // A cut can leave fewer tasks or exits that make sense together: they are swapped in like any others.
    Runner next(*program, {.period = period});
    ScenePlant plant(drive);
    Runner runner(drive, {.period = period});
    Sensed sensed(drive.robot.model, drive.signals.size());
    for (int i = 0; i < 20; ++i) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      if (i == 10) {
        EXPECT_TRUE(runner.swap_program(next)) << size;
      }
      ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    }
    EXPECT_EQ(runner.event_count(), 0U) << size;
  }
  std::filesystem::remove(file);
  EXPECT_GT(refused, read);
  std::printf("half-written: %d of %d refused\n", refused, refused + read);
}

/// The controller's robot has another mass, inertia and centre of mass than the plant's. It has a folder of
/// its own, with the first body of the URDF changed.
class WrongRobot {
 public:
  WrongRobot(double scale, double ahead) {
    folder_ = std::filesystem::temp_directory_path() / ("zwang_wrong_robot_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    std::string urdf = read(specs("robots/mecanum_base.urdf"));
    for (const char* name : {"mass value=\"", "ixx=\"", "iyy=\"", "izz=\"", "ixy=\"", "ixz=\"", "iyz=\""}) {
      change(urdf, name, [scale](double x) { return scale * x; });
    }
    change(urdf, "xyz=\"", [ahead](double x) { return x + ahead; });
    std::ofstream(folder_ / "mecanum_base.urdf") << urdf;
    std::ofstream(folder_ / "robot.yaml") << read(specs("robots/mecanum_base.yaml"));
  }
  ~WrongRobot() { std::filesystem::remove_all(folder_); }
  lang::Program program() const {
    lang::Diagnostics diagnostics;
    lang::LoadOptions options;
    options.root = "/";
    options.robot = folder_ / "robot.yaml";
    auto program = lang::load(specs("wall_align.yaml"), options, diagnostics);
    if (!program) throw std::runtime_error("the changed robot does not load");
    return *program;
  }

 private:
  static std::string read(const std::string& path) {
    std::ifstream in(path);
    return {(std::istreambuf_iterator<char>(in)), {}};
  }
  template <typename Change>
  static void change(std::string& urdf, const std::string& key, const Change& to) {
    const std::size_t at = urdf.find(key, urdf.find("<inertial")) + key.size();
    std::size_t length = 0;
    const double value = std::stod(urdf.substr(at), &length);
    urdf.replace(at, length, std::to_string(to(value)));
  }
  std::filesystem::path folder_;
};

TEST(WrongModel, KeepsItsForceAndArrives) {
  struct Case {
    const char* name;
    double scale, ahead;
  };
  for (const Case& wrong :
       {Case{"mass and inertia +50 %", 1.5, 0.0}, Case{"mass and inertia -50 %", 0.5, 0.0},
        Case{"centre of mass 10 cm off", 1.0, 0.1}}) {
    const WrongRobot robot(wrong.scale, wrong.ahead);
    const lang::Program believed = robot.program();
    const lang::Program actual = shipped_program("wall_align.yaml", "mecanum");
    ASSERT_TRUE(wrong.ahead != 0.0 ||
                std::abs(believed.robot.model.total_mass() / actual.robot.model.total_mass() - 1.0) > 0.2);
    ScenePlant plant(actual);
    Runner runner(believed, {.period = period});
    Sensed sensed(believed.robot.model, 0);
    double pressed = 0.0;
    while (!runner.finished() && plant.truth().time < 60.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      const Eigen::VectorXd& tau = runner.step(sensed);
      if (runner.state() == RunState::running) pressed = plant.truth().objects[0].force;
      ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
    }
    std::printf("%s: %s, pressed with %.2f N\n", wrong.name, to_string(runner.state()), pressed);
    EXPECT_EQ(runner.state(), RunState::done) << wrong.name;
    EXPECT_LE(pressed, 22.0) << "the bound and 10 %";
  }
}

/// Without torque this arm would fall: 10 deg in a fifth of a second. The stop holds it, told or blind.
TEST(ProtectiveStop, HoldsAnArmWhereItWas) {
  const lang::Program program = shipped_program("obstacle.yaml", "mecanum_arm");
  const int joints = program.robot.model.joint_count();
  for (const bool blind : {false, true}) {
    ScenePlant plant(program);
    Runner runner(program, {.period = period});
    Sensed sensed(program.robot.model, program.signals.size());
    Eigen::VectorXd start;
    double worst = 0.0;
    for (int i = 0; i < (blind ? 200 : 2000); ++i) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      if (i == 0) start = sensed.state.q;
      // The wheels may roll out.
      for (int j = 0; j < joints; ++j) {
        const bool of_arm = program.robot.model.joint(j).name.rfind("arm", 0) == 0;
        if (of_arm) worst = std::max(worst, std::abs(sensed.state.q(j) - start(j)));
      }
      if (i == 2 && !blind) runner.guard().stop(EventCode::requested);
      if (i >= 2 && blind) sensed.state.qd(0) = std::nan("");
      const Eigen::VectorXd& tau = runner.step(sensed);
      for (int j = 0; j < joints; ++j) {
        ASSERT_LE(std::abs(tau(j)), program.robot.model.joint(j).max_effort);
      }
      ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
    }
    EXPECT_TRUE(runner.guard().stopped());
    std::printf("%s: the arm moved by %.3f deg at most\n", blind ? "blind for 0.2 s" : "2 s",
                worst * 180.0 / M_PI);
    EXPECT_LE(worst, 1.0 * M_PI / 180.0);
  }
}

}  // namespace
}  // namespace zwang::runtime
