// Motors that give nothing, keep their torque, or push the wrong way. The faults begin at each moment of the
// task, on every kind of drive that presses against a wall. The tests print when each fault was felt and
// found, and the plant's measurements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "../is_long.hpp"
#include "../temporary_folder.hpp"
#include "constants.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

using lang::FaultKind;

constexpr double deadline = 0.1;        // [s]
constexpr double push = 20.0;           // [N] that the task asks for
constexpr double allowed_speed = 0.08;  // [m/s] by the task
constexpr double beyond = 1.1;          // of every bound
constexpr double stiffness = 100e3;     // [N/m] the wall's
constexpr double wall_at = 1.2;         // [m] its face
const int moments_between_hits = zwang::test::is_long() ? 6 : 2;
constexpr double gap = 0.08;  // [m] to it, at the start

/// What is met, and how.
struct Wall {
  double stiffness = zwang::runtime::stiffness;  ///< [N/m]
  double friction = 0.0;
  double yaw = 5.0 * degree;  ///< the base's, at the start
};

lang::Program load(const std::string& robot, const Wall& wall) {
  lang::Program program = zwang::test::shipped_program("wall_align.yaml", robot, "wall_far");
  program.scene->objects[0].stiffness = wall.stiffness;
  program.scene->objects[0].friction = wall.friction;
  return program;
}

const char* word(FaultKind kind) {
  if (kind == FaultKind::torque_lost) return "lost";
  return kind == FaultKind::torque_stuck ? "stuck" : "flipped";
}

/// The torque that is missing from a motor's command.
class MissedTorque {
 public:
  MissedTorque(FaultKind kind, double at) : kind_(kind), at_(at) {}
  double operator()(double time, double told) {
    if (time < at_) return 0.0;
    if (!kept_) kept_ = told;
    if (kind_ == FaultKind::torque_lost) return told;
    return kind_ == FaultKind::torque_flipped ? 2.0 * told : told - *kept_;
  }

 private:
  FaultKind kind_;
  double at_;
  std::optional<double> kept_;
};

struct Outcome {
  double touched = -1.0;  ///< [s]
  double felt = -1.0;     ///< [s] more than 3 % of the motor's torque is missed
  double found = -1.0;    ///< [s]
  double unseen = 0.0;    ///< [s] the longest that it was missed without a break while nothing was touched
  double fastest = 0.0;   ///< [m/s] since the fault
  double along = 0.0;     ///< [m/s] of it along the base's own x, which the task limits
  double hardest = 0.0;   ///< [N] on the wall, since the fault
  double corner = 0.0;    ///< [m/s] the largest speed of a corner towards the wall
  double ended = 0.0;     ///< [s]
  std::string code;
};

class Pressing {
 public:
  explicit Pressing(const std::string& robot, const Wall& wall = {})
      : name_(robot), wall_(wall), program_(load(robot, wall)) {}

  Outcome run(const lang::Fault* fault, double until) const {
    ScenePlantOptions options;
    double front = 0.0;
    for (const auto& corner : program_.robot.footprint)
      front = std::max(front, corner.x() * std::cos(wall_.yaw) - corner.y() * std::sin(wall_.yaw));
    options.simulation.start_at = {wall_at - gap - front, 0.0};
    options.simulation.start_yaw = wall_.yaw;
    if (fault != nullptr) options.faults.push_back(*fault);
    ScenePlant plant(program_, options);
    Runner runner(program_, {.period = period});
    Sensed sensed(program_.robot.model, program_.signals.size());
    const int joint = fault != nullptr ? joint_named(fault->joint) : -1;
    MissedTorque missed(fault != nullptr ? fault->kind : FaultKind::torque_lost,
                        fault != nullptr ? fault->at : 0.0);
    Outcome out;
    double unseen = 0.0;
    while (!runner.finished() && plant.truth().time < until) {
      if (plant.sense(sensed) != PlantStatus::ok) throw std::runtime_error("no sample");
      const double now = plant.truth().time;
      const Eigen::VectorXd& tau = runner.step(sensed);
      const bool touches = plant.truth().objects[0].force > 0.0;
      if (runner.guard().stopped() && out.found < 0.0) {
        out.found = now;
        out.code = to_string(runner.guard().stop_event().code);
      }
      if (joint >= 0 && out.found < 0.0) {
        const bool is_felt =
            std::abs(missed(now, tau(joint))) > 0.03 * program_.robot.model.joint(joint).max_effort;
        if (is_felt && out.felt < 0.0) out.felt = now;
        unseen = is_felt && !touches ? unseen + period : 0.0;
        out.unseen = std::max(out.unseen, unseen);
      }
      if (plant.apply(tau) != PlantStatus::ok) throw std::runtime_error("no plant");
      const Truth& truth = plant.truth();
      if (truth.objects[0].touched && out.touched < 0.0) out.touched = truth.time;
      out.corner = std::max(out.corner, corner_speed(truth));
      // A stuck motor that the others cannot hold drives the base until somebody takes its power away.
      const bool can_brake = fault == nullptr || fault->kind != FaultKind::torque_stuck || has_spare_motors();
      if ((fault == nullptr || truth.time >= fault->at) && (can_brake || out.found < 0.0)) {
        out.fastest = std::max(out.fastest, truth.velocity.head<2>().norm());
        out.along = std::max(out.along, std::abs(truth.velocity.x()));
        out.hardest = std::max(out.hardest, truth.objects[0].force);
      }
    }
    out.ended = plant.truth().time;
    return out;
  }

  /// More motors than the three freedoms of a base; a differential one has two of both.
  bool has_spare_motors() const { return motors() > 3; }
  int motors() const {
    int count = 0;
    for (const solver::Wheel& wheel : program_.robot.model.wheels())
      count += program_.robot.model.joint(wheel.body - 1).actuated ? 1 : 0;
    return count;
  }
  /// [kg] that a hit meets at most: the base's, and what turns with its wheels.
  double mass() const {
    double m = program_.robot.model.total_mass();
    for (const solver::Wheel& wheel : program_.robot.model.wheels()) {
      const solver::Joint& joint = program_.robot.model.joint(wheel.body - 1);
      m += joint.rotor_inertia / (wheel.radius * wheel.radius);
    }
    return m;
  }

 private:
  int joint_named(const std::string& wheel) const {
    for (int j = 0; j < program_.robot.model.joint_count(); ++j) {
      if (program_.robot.model.joint(j).name == wheel) return j;
    }
    throw std::runtime_error(name_ + " has no " + wheel);
  }
  double corner_speed(const Truth& truth) const {
    double fastest = 0.0;
    for (const auto& corner : program_.robot.footprint) {
      const double vx = truth.velocity.x() - truth.velocity.z() * corner.y();
      const double vy = truth.velocity.y() + truth.velocity.z() * corner.x();
      fastest = std::max(fastest, vx * std::cos(truth.yaw) - vy * std::sin(truth.yaw));
    }
    return fastest;
  }

  std::string name_;
  Wall wall_;
  lang::Program program_;
};

struct Drive {
  const char* robot;
  std::vector<const char*> wheels;
};

void PrintTo(const Drive& drive, std::ostream* out) {
  *out << drive.robot;
}

class MotorFaults : public testing::TestWithParam<Drive> {};

TEST_P(MotorFaults, AreFoundInTimeAndForceAndSpeedStayBounded) {
  const Drive& drive = GetParam();
  const Pressing pressing(drive.robot);
  const Outcome sound = pressing.run(nullptr, 30.0);
  ASSERT_GT(sound.touched, 0.0);
  ASSERT_LT(sound.found, 0.0) << sound.code;
  struct Moment {
    const char* name;
    double at;
  };
  const Moment standing{"standing", 0.0}, cruising{"cruising", 0.6}, onset{"onset", sound.touched + 0.02},
      pressed{"pressing", sound.ended - 1.0};
  ASSERT_LT(cruising.at, sound.touched - 0.1);
  std::printf("%s: touches after %.2f s, %.0f N at most\n", drive.robot, sound.touched, sound.hardest);
  for (const char* wheel : drive.wheels) {
    for (const FaultKind kind :
         {FaultKind::torque_lost, FaultKind::torque_stuck, FaultKind::torque_flipped}) {
      for (const Moment& moment : {standing, cruising, onset, pressed}) {
        const lang::Fault fault{.kind = kind, .at = moment.at, .joint = wheel};
        const Outcome out = pressing.run(&fault, moment.at + 5.0);
        std::printf(
            "  %-17s %-8s %-9s at %5.2f s: felt %6.3f s, %-14s %6.3f s, unseen %3.0f ms, %.4f m/s, x %.4f "
            "m/s, %5.1f N\n",
            wheel, word(kind), moment.name, moment.at, out.felt,
            out.found < 0.0 ? "not found" : out.code.c_str(), out.found, 1e3 * out.unseen, out.fastest,
            out.along, out.hardest);
        SCOPED_TRACE(std::string(drive.robot) + " " + wheel + " " + word(kind) + " " + moment.name);
        // A stuck motor pushes on until it is found, as hard as the task commanded before. Possibly no other
        // motor can brake it.
        const bool is_held = kind != FaultKind::torque_stuck || pressing.has_spare_motors();
        const double more = is_held ? 0.0 : deadline * push / pressing.mass();
        EXPECT_LE(out.fastest, beyond * allowed_speed + more);
        EXPECT_LE(out.along, beyond * allowed_speed + more);
        // F + sqrt(F^2 + K m v^2), the most that a contact of stiffness K can press with.
        const double energy = stiffness * pressing.mass() * out.corner * out.corner;
        EXPECT_LE(out.hardest, beyond * (push + std::sqrt(push * push + energy)));
        if (moment.name == pressed.name) {
          EXPECT_LE(out.hardest, beyond * push);
        }
        // Whether a torque that stays is stuck shows when the command has changed.
        if (kind != FaultKind::torque_stuck || moment.name == standing.name) {
          EXPECT_LE(out.unseen, deadline + period);
        }
        if (kind == FaultKind::torque_flipped && moment.name == pressed.name && out.felt >= 0.0) {
          EXPECT_GE(out.found, 0.0);
          EXPECT_LE(out.found - out.felt, deadline);
        }
        // Where a motor is lost of as many as there are freedoms, one motion of the base has no brake.
        if (out.found >= 0.0 && (kind == FaultKind::torque_flipped || pressing.has_spare_motors())) {
          EXPECT_LE(out.ended - out.found, 2.0) << "it stands";
        }
      }
    }
  }
}

/// While hits follow each other, or corners press, the guard promises no time until a motor's fault is found.
/// The task's own promises hold all the same: the axis that it limits, and each hit's force. The exception is
/// a stuck motor on a base without a spare one: no other motor can hold it, as above. A flipped motor of two
/// is found whenever it is felt.
TEST_P(MotorFaults, BoundForceAndSpeedWhereverBetweenHitsTheyBegin) {
  const Drive& drive = GetParam();
  const Pressing pressing(drive.robot);
  const Outcome sound = pressing.run(nullptr, 30.0);
  ASSERT_GT(sound.touched, 0.0);
  const double lasting = std::max(sound.ended - 2.5 - sound.touched, 0.1);  // until the corners rest
  for (const FaultKind kind : {FaultKind::torque_lost, FaultKind::torque_stuck, FaultKind::torque_flipped}) {
    // With two freedoms a corner that presses looks most like a motor: more often.
    const bool is_close = kind == FaultKind::torque_flipped && pressing.motors() == 2;
    const int moments = (is_close ? 3 : 1) * moments_between_hits;
    double along = 0.0, force = 0.0, share = 0.0, longest = 0.0;
    int found = 0, felt = 0, missed = 0;
    for (const char* wheel : drive.wheels) {
      for (int i = 0; i < moments; ++i) {
        const double at = sound.touched + lasting * i / moments;
        const lang::Fault fault{.kind = kind, .at = at, .joint = wheel};
        const Outcome out = pressing.run(&fault, at + 3.0);
        const double energy = stiffness * pressing.mass() * out.corner * out.corner;
        const double most = push + std::sqrt(push * push + energy);
        along = std::max(along, out.along);
        force = std::max(force, out.hardest);
        share = std::max(share, out.hardest / most);
        felt += out.felt >= 0.0 ? 1 : 0;
        found += out.found >= 0.0 ? 1 : 0;
        missed += out.felt >= 0.0 && out.found < 0.0 ? 1 : 0;
        if (out.found >= 0.0 && out.felt >= 0.0) longest = std::max(longest, out.found - out.felt);
      }
    }
    std::printf(
        "%-9s %-8s between hits: %2d felt, %2d found, %4.0f ms at most; x %.4f m/s, %5.1f N, %.2f of F + "
        "sqrt(F^2 + K m v^2)\n",
        drive.robot, word(kind), felt, found, 1e3 * longest, along, force, share);
    const bool is_held = kind != FaultKind::torque_stuck || pressing.has_spare_motors();
    const double more = is_held ? 0.0 : deadline * push / pressing.mass();
    EXPECT_LE(along, beyond * allowed_speed + more) << word(kind);
    EXPECT_LE(share, beyond) << word(kind);
    if (is_close) {
      EXPECT_EQ(missed, 0) << word(kind);
    }
  }
}

/// A soft wall presses slowly, first with its damping and then with its spring. Its force looks like a failed
/// motor: as steady, as far out as a wheel, and answered by a command of its size. But it pressed before it
/// was answered, and 1 mm more is little of the depth that it was pressed in by.
TEST(SoftWall, IsNoFaultOfADifferentialBasesMotors) {
  const bool is_long = zwang::test::is_long();
  for (const double soft : is_long ? std::vector{1e3, 2e3, 5e3, 10e3} : std::vector{1e3, 5e3}) {
    for (const double yaw :
         is_long ? std::vector{-20.0, -12.0, -5.0, 5.0, 12.0, 20.0} : std::vector{-12.0, 5.0, 20.0}) {
      const double friction = yaw < 0.0 ? 0.15 : 0.0;  // the base is as wide to the left as to the right
      const Pressing pressing("diff", {.stiffness = soft, .friction = friction, .yaw = yaw * degree});
      const Outcome out = pressing.run(nullptr, 8.0);
      ASSERT_GT(out.touched, 0.0);
      EXPECT_LT(out.found, 0.0) << out.code << " at " << out.found << " s, " << soft << " N/m, " << yaw
                                << " deg, friction " << friction;
    }
  }
}

/// A soft wall gives back its energy. Its force hardly slackens over the way that a base needs to get too
/// fast.
TEST(SoftWall, IsNoRunawayOfAnOmniBaseAsItGivesBack) {
  for (const double yaw : {-15.0, -10.0, -5.0, 5.0, 10.0, 15.0}) {
    const Pressing pressing("omni", {.stiffness = 1e3, .friction = 0.15, .yaw = yaw * degree});
    const Outcome out = pressing.run(nullptr, 8.0);
    ASSERT_GT(out.touched, 0.0);
    EXPECT_LT(out.found, 0.0) << out.code << " at " << out.found << " s, " << yaw << " deg";
  }
}

/// Rough ones turn the base as they give back; so one wheel does all of the work, as a reversed motor would.
TEST(SoftWall, IsNoReversedMotorOfAMecanumBaseAsItGivesBack) {
  const Wall walls[] = {{.stiffness = 1e3, .friction = 0.15, .yaw = 15.0 * degree},
                        {.stiffness = 2e3, .friction = 0.15, .yaw = -10.0 * degree},
                        {.stiffness = 2e3, .friction = 0.15, .yaw = 10.0 * degree}};
  for (const Wall& wall : walls) {
    const Outcome out = Pressing("mecanum", wall).run(nullptr, 8.0);
    ASSERT_GT(out.touched, 0.0);
    EXPECT_LT(out.found, 0.0) << out.code << " at " << out.found << " s, " << wall.stiffness << " N/m";
  }
}

/// A differential base slides along a wall and turns, as a bounded moment holds its heading. Its corner comes
/// off, and meets the wall again half a second later. The limit of its speed gives way to the wall as far out
/// as one wheel. So that wheel's torque and the wall's keep an even sum, as those of a stuck motor do.
TEST(MetAgain, AWallIsNoFaultOfTheWheelBesideIt) {
  const zwang::test::TemporaryFolder folder;
  const auto put = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path() / name) << text;
  };
  put("robot.yaml", "zwang_robot: 1\nbased_on: " + zwang::test::specs("robots/diff_base.yaml") + R"(
footprint: {polygon: [[296 mm, 222 mm], [0 m, 296 mm], [-527 mm, 296 mm], [-527 mm, -296 mm], [0 m, -296 mm], [296 mm, -222 mm]]}
)");
  put("scene.yaml", R"(zwang_scene: 1
start: {at: [0.8 m, 0.3677 m], yaw: 24.7 deg}
floor: {friction: 0.9}
objects:
  wall: {wall: {length: 6 m}, at: [1.2 m, 0 m], fixed: true, friction: 0.2}
)");
  put("task.yaml", R"(zwang: 2
robot: robot.yaml
scene: scene.yaml
start: press
tasks:
  press:
    constraints:
      contact: {move: base, in: base, x: {force: 40 N, velocity: [-0.05 m/s, 0.04 m/s]}, rz: {velocity: 0 rad/s, force: +-0.888 N m}}
    timeout: {after: 5 s, goto: done}
)");
  lang::Diagnostics diagnostics;
  const auto program = lang::load(folder.path() / "task.yaml", {.root = "/"}, diagnostics);
  ASSERT_TRUE(program);
  ScenePlant plant(*program);
  Runner runner(*program, {.period = period});
  Sensed sensed(program->robot.model, program->signals.size());
  double off_since = -1.0, longest = 0.0;
  while (!runner.finished() && plant.truth().time < 5.0) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    ASSERT_FALSE(runner.guard().stopped()) << to_string(runner.guard().stop_event().code);
    const auto& wall = plant.truth().objects[0];
    if (wall.force > 0.0 && off_since > 0.0) longest = std::max(longest, plant.truth().time - off_since);
    if (wall.force > 0.0) off_since = -1.0;
    if (wall.touched && wall.force == 0.0 && off_since < 0.0) off_since = plant.truth().time;
  }
  EXPECT_GT(longest, 0.3) << "it did not come off";
}

INSTANTIATE_TEST_SUITE_P(Drives, MotorFaults,
                         testing::Values(Drive{"mecanum", {"front_left_wheel", "rear_right_wheel"}},
                                         Drive{"omni",
                                               {"front_left_wheel", "rear_wheel", "front_right_wheel"}},
                                         Drive{"diff", {"left_wheel", "right_wheel"}},
                                         Drive{"kelo_two", {"front_left_hub", "rear_right_hub"}}),
                         [](const auto& tested) { return std::string(tested.param.robot); });

}  // namespace
}  // namespace zwang::runtime
