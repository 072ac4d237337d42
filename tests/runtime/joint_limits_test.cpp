// The travel and the speed of an arm's joints. The plant's joints have no end stops: only the guard keeps a
// joint inside.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "../temporary_folder.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

namespace fs = std::filesystem;
constexpr double joint_speed = 0.8727;  // [rad/s] of every joint of the arm
constexpr double resolution = 2e-3;     // [rad] as docs/language.md says
constexpr double turn_around = 0.011;   // [s] of a motor's torque from one limit to the other, and a tick

std::string read(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

struct ArmJoint {
  std::string name, parent, child, origin;
  double lower, upper;
};
// As mecanum_arm_base.urdf has them.
const ArmJoint shoulder{
    "arm_2", "shoulder_link", "upper_arm_1_link", "at: [0 m, 0.005375 m, -0.12838 m]", -2.41, 2.41};
const ArmJoint elbow{"arm_4", "upper_arm_2_link", "forearm_link", "at: [0 m, 0.006375 m, -0.21038 m]", -2.66,
                     2.66};
const ArmJoint wrist{"arm_6", "wrist_1_link", "wrist_2_link", "at: [0 m, 0.000175 m, -0.10593 m]", -2.23,
                     2.23};

/// The base stands, and one joint is driven as `statements` say.
struct JointRun {
  /// `travel` stands in the place of the shoulder's own.
  JointRun(const ArmJoint& arm_joint, const std::string& statements, const std::string& travel = "")
      : what(arm_joint) {
    const test::TemporaryFolder temporary;
    const fs::path& folder = temporary.path();
    std::ofstream(folder / "task.yaml")
        << "zwang: 1\nrobot: robot.yaml\nframes:\n  axle: {parent: " << what.parent << ", " << what.origin
        << ", rpy: [90 deg, 0 deg, 0 deg]}\nstart: turn\ntasks:\n  turn:\n    constraints:\n"
        << "      stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: "
           "{velocity: 0 rad/s}}\n"
        << "      turn: {move: " << what.child << ", in: axle, rz: {" << statements << "}}\n"
        << "    exits: [{when: elapsed > 12 s, goto: done}]\n";
    std::ofstream(folder / "robot.yaml") << read(zwang::test::specs("robots/mecanum_arm_base.yaml"));
    const std::string urdf = read(zwang::test::specs("robots/mecanum_arm_base.urdf"));
    std::string endless = urdf;
    for (const char* end : {"2.41", "2.66", "2.23"})
      replace_all(endless, std::string("lower=\"-") + end + "\" upper=\"" + end, "lower=\"-9\" upper=\"9");
    EXPECT_NE(endless, urdf);
    std::string own = urdf;
    if (!travel.empty()) replace_all(own, "lower=\"-2.41\" upper=\"2.41\"", travel);
    const lang::Program limited = load(folder, own), unlimited = load(folder, endless);
    run(limited, unlimited);
  }

  static lang::Program load(const fs::path& folder, const std::string& urdf) {
    std::ofstream(folder / "mecanum_arm_base.urdf") << urdf;
    lang::Diagnostics diagnostics;
    lang::LoadOptions options;
    options.scene = zwang::test::specs("scenes/wall_far.yaml");
    options.root = "/";
    const auto program = lang::load(folder / "task.yaml", options, diagnostics);
    std::ostringstream words;
    lang::render_human(diagnostics, words);
    if (!program) throw std::runtime_error(words.str());
    return *program;
  }

  /// Until a second after the stop, or the end of the task.
  void run(const lang::Program& limited, const lang::Program& unlimited) {
    ScenePlant plant(unlimited);
    Runner runner(limited);
    Sensed sensed(limited.robot.model, limited.signals.size());
    j = *limited.robot.model.find_joint(what.name);
    lowest = highest = plant.true_state().q(j);
    double stopped_at = 1e9;
    while (plant.truth().time < 13.0 && plant.truth().time < stopped_at + 1.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      const double q = plant.true_state().q(j), qd = plant.true_state().qd(j);
      lowest = std::min(lowest, q), highest = std::max(highest, q), fastest = std::max(fastest, std::abs(qd));
      if (first_too_fast == 0.0 && std::abs(qd) > 1.1 * joint_speed) first_too_fast = plant.truth().time;
      const Eigen::VectorXd& tau = runner.step(sensed);
      if (runner.state() == RunState::stopped && stopped_at > 1e8)
        stopped_at = plant.truth().time, at_stop = qd;
      rate_at_end = qd;
      ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
    }
    stop = runner.guard().stop_event();
    if (stop.code != EventCode::none) signal = runner.event_signal(stop);
    events = runner.events().size();
    std::printf(
        "%s: %s at %.3f s, %s = %.4f; q from %.4f to %.4f, %.3f rad/s at most, %.3f rad/s at the stop\n",
        what.name.c_str(), to_string(stop.code), stop.time, signal.c_str(), stop.value, lowest, highest,
        fastest, at_stop);
  }

  ArmJoint what;
  int j = 0;
  Event stop;
  std::string signal;
  std::size_t events = 0;
  double lowest = 0.0, highest = 0.0, fastest = 0.0, at_stop = 0.0, rate_at_end = 0.0, first_too_fast = 0.0;
};

// With any driver and at any speed the joint comes to rest in its travel. The stop comes no sooner than
// needed. The way of a stop has three parts. The joint swings by v / (20 rad/s e), goes on at v while the
// torque turns around, and brakes with 20 rad/s^2 at least. The 20 rad/s^2 are the shoulder's 39 N m less 10
// N m of weight on 1.4 kg m^2. The sum of the three parts bounds the travel that is left at the stop.
TEST(JointLimits, AStopKeepsADrivenJointInItsTravel) {
  for (const char* drive : {"velocity: 0.5 rad/s", "velocity: -0.5 rad/s", "velocity: 0.85 rad/s",
                            "velocity: -0.85 rad/s", "force: 4 N m, velocity: +-0.8 rad/s"}) {
    for (const ArmJoint& joint : {shoulder, elbow, wrist}) {
      const std::string statements = std::string(drive) + ", time_constant: 0.1 s";
      SCOPED_TRACE(joint.name + ", " + statements);
      const JointRun run(joint, statements);
      EXPECT_EQ(run.stop.code, EventCode::joint_travel);
      EXPECT_EQ(run.signal, joint.name + ".q");
      EXPECT_EQ(run.events, 1u);
      EXPECT_LE(run.highest, joint.upper + resolution);
      EXPECT_GE(run.lowest, joint.lower - resolution);
      const double v = std::abs(run.at_stop);
      const double needs = v * turn_around + v / (20.0 * std::numbers::e) + v * v / 40.0;
      const double left = v == run.at_stop ? joint.upper - run.stop.value : run.stop.value - joint.lower;
      EXPECT_LT(left, needs) << "not stopped sooner than it has to be";
      EXPECT_LT(std::abs(run.rate_at_end), 0.01);
    }
  }
}

// A joint that the task brakes by itself is not stopped, up to the very end. A range is kept with 0.72 of the
// acceleration. The guard counts on all of it, so it stops later.
TEST(JointLimits, ARangeThatEndsWithTheTravelIsLeftAlone) {
  for (const ArmJoint& joint : {shoulder, elbow, wrist}) {
    const std::string end = std::to_string(joint.upper) + " rad";
    const JointRun run(
        joint, "velocity: 0.6 rad/s, acceleration: +-3 rad/s^2, position: [-" + end + ", " + end + "]");
    EXPECT_EQ(run.stop.code, EventCode::none);
    EXPECT_NEAR(run.highest, joint.upper, 0.01);
    EXPECT_LE(run.highest, joint.upper + resolution);
  }
}

// Where a joint stands at the start it rests, though nothing is sent yet that bears its weight, and may give
// a little. The end is an end for all that: it is not gone through.
TEST(JointLimits, AJointMayRestOnItsEnd) {
  constexpr double start = std::numbers::pi / 12.0;  // the posture of the shoulder
  const std::string up = "lower=\"-2.41\" upper=\"" + std::to_string(start + 1e-3) + "\"";
  const std::string down = "lower=\"" + std::to_string(start - 1e-3) + "\" upper=\"2.41\"";
  for (const std::string& travel : {up, down}) {
    SCOPED_TRACE(travel);
    const JointRun held(shoulder, "position: here, time_constant: 0.1 s", travel);
    EXPECT_EQ(held.stop.code, EventCode::none);
    const std::string onwards = travel == up ? "velocity: 0.5 rad/s" : "velocity: -0.5 rad/s";
    const JointRun driven(shoulder, onwards + ", time_constant: 0.1 s", travel);
    EXPECT_EQ(driven.stop.code, EventCode::joint_travel);
    EXPECT_LT(std::max(driven.highest - start, start - driven.lowest), 1e-3 + 10.0 * resolution);
    // Once it has left the end, it is watched as any other.
    const std::string away = travel == up ? "force: -14 N m" : "force: 14 N m";
    const JointRun left(shoulder, away + ", velocity: +-0.8 rad/s, time_constant: 0.1 s", travel);
    EXPECT_EQ(left.stop.code, EventCode::joint_travel);
    EXPECT_LE(left.highest, 2.41 + resolution);
    EXPECT_GE(left.lowest, -2.41 - resolution);
  }
}

// The stop comes with the first sample beyond a tenth too much. The driver goes on for as long as the torque
// takes to turn around, at 1.3 / 0.5 rad/s^2 at most.
TEST(JointLimits, AJointThatIsTooFastIsStopped) {
  for (const ArmJoint& joint : {shoulder, wrist}) {
    const JointRun run(joint, "velocity: 1.3 rad/s, time_constant: 0.5 s");
    EXPECT_EQ(run.stop.code, EventCode::joint_speed);
    EXPECT_EQ(run.signal, joint.name + ".qd");
    EXPECT_EQ(run.stop.time, run.first_too_fast);
    EXPECT_LT(run.fastest, 1.1 * joint_speed + 1.3 / 0.5 * turn_around);
    EXPECT_LT(std::abs(run.rate_at_end), 0.01);
  }
  const JointRun within(wrist, "velocity: 0.95 rad/s, position: [-2 rad, 2 rad]");
  EXPECT_EQ(within.stop.code, EventCode::none)
      << "less than a tenth too fast: the range of speeds is for motion that is planned";
}

}  // namespace
}  // namespace zwang::runtime
