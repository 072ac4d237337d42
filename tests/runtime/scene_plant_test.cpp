// A scene as it unfolds: scripted motion, signals measured badly, hooks that latch, faults, and friction in
// the joints. Expected values are the formulas of what the scene says.
#include "zwang/runtime/scene_plant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "constants.hpp"
#include "scene_program.hpp"
#include "standing_scene.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

TEST(ScenePlant, ScriptedObjectsFollowTheirScript) {
  const lang::Program program = program_with(cart);
  ScenePlant plant(program);
  follow(plant, program, 2.0, idle, [&](const Sensed&, PlantStatus) {
    const ObjectTruth& object = plant.truth().objects[0];
    const double share = std::clamp(plant.truth().time - period - 0.5, 0.0, 1.0);
    if (plant.truth().time == 0.0) return;
    // The truth is that of the step's end; a script is looked up at its beginning.
    ASSERT_NEAR(object.x, -2.0 - share, 1.5e-3);
    ASSERT_NEAR(object.y, 0.3 + 0.5 * share, 1.5e-3);
    ASSERT_NEAR(object.yaw, 90.0 * degree * share, 3e-3);
  });
}

// It comes from behind at 1 m/s and takes the 46 kg base along.
TEST(ScenePlant, ScriptedObjectsPushWhatStandsInTheirWay) {
  const lang::Program program = program_with(R"(objects:
  cart:
    box: [0.6 m, 0.4 m, 0.5 m]
    at: [-1 m, 0 m]
    motion: [{time: 0 s, at: [-1 m, 0 m]}, {time: 2 s, at: [0 m, 0 m]}]
)");
  ScenePlant plant(program);
  follow(plant, program, 2.0, idle, [](const Sensed&, PlantStatus) {});
  EXPECT_GT(plant.truth().x, 0.69);
  EXPECT_GT(plant.truth().objects[0].peak_force, 10.0);
  EXPECT_NEAR(plant.truth().objects[0].x, 0.0, 2e-3) << "the base does not hold it up";
}

/// Of the mecanum base: its URDF's masses, and what its wheels' spin adds at 45 deg rollers, (I + gear^2 J) /
/// r^2 each.
constexpr double spin = 4.0 * (0.0066249 + 26.0 * 26.0 * 13.5e-6) / (0.0759 * 0.0759);  // [kg]
constexpr double pushed_mass = 46.0 + spin;
constexpr double pushed_inertia =
    2.15157 + 4.0 * (0.0045084 + 2.3 * (0.27 * 0.27 + 0.22 * 0.22)) + spin * 0.49 * 0.49;

TEST(ScenePlant, AHandMovesTheBaseAsItsMassSays) {
  const lang::Program program = program_with("start: {at: [0 m, 0 m], yaw: 30 deg}\n");
  ScenePlant plant(program);
  follow(plant, program, 0.05, idle, [](const Sensed&, PlantStatus) {});
  const solver::Vector3 before = plant.truth().velocity;
  plant.set_push({{0.0, 0.0}, {0.0, 30.0}});  // in the world's y
  follow(plant, program, 0.1, idle, [](const Sensed&, PlantStatus) {});
  const solver::Vector3 gained = plant.truth().velocity - before;
  const double speed = 30.0 * 0.1 / pushed_mass;
  EXPECT_NEAR(gained.x(), speed * std::sin(30.0 * degree), 0.01 * speed);
  EXPECT_NEAR(gained.y(), speed * std::cos(30.0 * degree), 0.01 * speed);
  EXPECT_NEAR(gained.z(), 0.0, 0.01 * speed);
  EXPECT_NEAR(plant.truth().base.contact.head<2>().norm(), 30.0, 1e-9) << "the hand is felt";
  plant.set_push({});
  follow(plant, program, 0.1, idle, [](const Sensed&, PlantStatus) {});
  EXPECT_NEAR((plant.truth().velocity - before - gained).norm(), 0.0, 0.01 * speed)
      << "nobody pushes any more";
}

TEST(ScenePlant, AHandAtItsCornerTurnsTheBase) {
  const lang::Program program = program_with("");
  ScenePlant plant(program);
  plant.set_push({{0.4, 0.0}, {0.0, 10.0}});
  follow(plant, program, 0.1, idle, [](const Sensed&, PlantStatus) {});
  const double turning = 0.4 * 10.0 * 0.1 / pushed_inertia;
  EXPECT_NEAR(plant.truth().velocity.z(), turning, 0.02 * turning);
}

/// Pushes all wheels ahead (or back) with this force [N].
Eigen::VectorXd push(double force) {
  return Eigen::VectorXd::Constant(4, force * 0.0759 / 4.0);
}

// The base backs up into a dock 0.1 m behind its hook; once latched, it cannot be pulled away.
TEST(ScenePlant, AHookLatchesInItsDockAndHolds) {
  const lang::Program program = program_with(R"(objects:
  dock:
    box: [0.4 m, 0.4 m, 0.5 m]
    at: [-0.70 m, 0 m]
    fixed: true
    dock: {at: [0.2 m, 0 m], reach: 1 cm, hook: hook}
signals: {latch: {latch: dock}}
)");
  ScenePlant plant(program);
  double latched_at = -1.0;
  follow(plant, program, 2.0, push(-20.0), [&](const Sensed& sensed, PlantStatus) {
    if (sensed.signals[2].boolean && latched_at < 0.0) {
      latched_at = sensed.time;
      EXPECT_NEAR(plant.truth().x, -0.09, 2e-3) << "within reach of the socket at -0.5 m";
    }
  });
  ASSERT_GT(latched_at, 0.0);
  ASSERT_TRUE(plant.truth().objects[0].latched);
  EXPECT_NEAR(*plant.truth().objects[0].latched, latched_at, 1.5 * period)
      << "the signal comes with the tick";
  EXPECT_NEAR(plant.truth().objects[0].pull, -20.0, 0.1) << "still pushing";
  EXPECT_EQ(plant.truth().objects[0].force, 0.0) << "no contact";
  const double before = plant.truth().x;
  follow(plant, program, 1.0, push(30.0), [](const Sensed&, PlantStatus) {});
  EXPECT_NEAR(plant.truth().x, before, 2e-3);
  EXPECT_NEAR(plant.truth().objects[0].pull, 30.0, 0.1);
}

ScenePlantOptions with_fault(lang::FaultKind kind, double at, double duration, const char* joint = "",
                             double value = 0.0) {
  ScenePlantOptions options;
  options.faults.push_back(
      lang::Fault{.kind = kind, .at = at, .duration = duration, .joint = joint, .value = value});
  return options;
}

TEST(ScenePlant, SamplesAreLostSpoiltAndFrozenForAsLongAsTheFaultLasts) {
  const lang::Program program = program_with("");
  using lang::FaultKind;
  for (const FaultKind kind :
       {FaultKind::samples_lost, FaultKind::samples_nan, FaultKind::samples_inf, FaultKind::samples_huge,
        FaultKind::samples_frozen, FaultKind::clock_backwards}) {
    ScenePlant plant(program, with_fault(kind, 0.1, 0.05));
    double frozen = 0.0;
    follow(plant, program, 0.2, push(20.0), [&](const Sensed& sensed, PlantStatus status) {
      const int tick = static_cast<int>(std::lround(plant.truth().time / period));
      const bool faulty = tick >= 100 && tick < 150;
      const double vx = sensed.state.base_twist.linear.x();
      if (tick == 100) frozen = vx;
      EXPECT_EQ(status == PlantStatus::unreachable, faulty && kind == FaultKind::samples_lost) << tick;
      EXPECT_EQ(std::isnan(vx), faulty && kind == FaultKind::samples_nan) << tick;
      EXPECT_EQ(std::isinf(vx), faulty && kind == FaultKind::samples_inf) << tick;
      EXPECT_EQ(vx == 1e300, faulty && kind == FaultKind::samples_huge) << tick;
      if (faulty && kind == FaultKind::samples_frozen) {
        EXPECT_EQ(vx, frozen);
      }
      if (faulty && kind == FaultKind::clock_backwards) {
        EXPECT_NEAR(sensed.time, 0.09, 1e-9);
      }
    });
    EXPECT_GT(plant.truth().velocity.x(), 0.0);
  }
}

// Four wheels push with 20 N. Without one of them three push, and the base turns; with one flipped two are
// left over. A tenth of a second: afterwards the turning base's own axes matter.
TEST(ScenePlant, MotorsFailAsTold) {
  const lang::Program program = program_with("");
  const auto speed = [&](lang::FaultKind kind, double at) {
    ScenePlant plant(program, with_fault(kind, at, 10.0, "front_left_wheel"));
    follow(plant, program, 0.1, push(20.0), [](const Sensed&, PlantStatus) {});
    return plant.truth().velocity.x();
  };
  const double whole = speed(lang::FaultKind::torque_lost, 9.0);
  EXPECT_NEAR(speed(lang::FaultKind::torque_lost, 0.0), 0.75 * whole, 0.02 * whole);
  EXPECT_NEAR(speed(lang::FaultKind::torque_flipped, 0.0), 0.5 * whole, 0.02 * whole);
  EXPECT_NEAR(speed(lang::FaultKind::torque_stuck, 0.02), whole, 1e-9) << "the command does not change";
}

TEST(ScenePlant, APayloadMakesTheBaseHeavierAndASlipperyFloorLetsItSlip) {
  const lang::Program program = program_with("");
  const auto speed = [&](const ScenePlantOptions& options, double force) {
    ScenePlant plant(program, options);
    follow(plant, program, 0.5, push(force), [](const Sensed&, PlantStatus) {});
    return plant.truth().velocity.x();
  };
  // 46 kg, and of each wheel half its mass and its rotor: 4 (0.0066249 + 26^2 13.5e-6) / 0.0759^2 = 10.94 kg.
  const double apparent = 46.0 + 4.0 * (0.0066249 + 676.0 * 13.5e-6) / (0.0759 * 0.0759);
  const double light = speed({}, 20.0);
  EXPECT_NEAR(light, 20.0 / apparent * 0.5, 0.01 * light);
  const double heavy = speed(with_fault(lang::FaultKind::payload, 0.0, 10.0, "", 15.0), 20.0);
  EXPECT_NEAR(heavy, 20.0 / (apparent + 15.0) * 0.5, 0.01 * heavy);
  const double half = speed(with_fault(lang::FaultKind::payload, 0.0, 10.0, "", -23.0), 20.0);
  EXPECT_NEAR(half, 20.0 / (apparent - 23.0) * 0.5, 0.01 * half);
  // 60 N asked of a floor that gives 0.05 m g = 22.6 N.
  const double slipping = speed(with_fault(lang::FaultKind::floor_friction, 0.0, 10.0, "", 0.05), 60.0);
  EXPECT_LT(slipping, 1.15 * 0.05 * 9.81 * 0.5);
  EXPECT_GT(slipping, 0.5 * 0.05 * 9.81 * 0.5);
}

// If the centre of mass lies c ahead, a force F sideways at the base's origin also turns the base. About that
// origin M (vy, wz) = (F t, 0). Its first row is m vy + m_b c wz = F t, with the mass m_b of the base link.
TEST(ScenePlant, ACentreOfMassFartherAheadTurnsABaseThatIsPushedSideways) {
  const lang::Program program = program_with("");
  ASSERT_NEAR(program.robot.model.bodies().front().inertia.mass, 36.8, 1e-9);
  Eigen::VectorXd left = push(20.0);
  for (const char* joint : {"front_left_wheel", "rear_right_wheel"})
    left[*program.robot.model.find_joint(joint)] *= -1.0;
  const auto pushed = [&](double ahead) {
    ScenePlant plant(program, with_fault(lang::FaultKind::centre_of_mass, 0.0, 10.0, "", ahead));
    follow(plant, program, 0.1, left, [](const Sensed&, PlantStatus) {});
    return plant.truth().velocity;
  };
  const double apparent = 46.0 + 4.0 * (0.0066249 + 676.0 * 13.5e-6) / (0.0759 * 0.0759);
  const double straight = pushed(0.0).z();
  EXPECT_NEAR(apparent * pushed(0.0).y(), 2.0, 0.02 * 2.0);
  for (const double ahead : {0.1, -0.1}) {
    const Eigen::Vector3d v = pushed(ahead);
    EXPECT_GT(std::abs(36.8 * ahead * v.z()), 0.02) << "it tells";
    EXPECT_LT((v.z() - straight) * ahead, 0.0) << "the end with the mass lags behind";
    EXPECT_NEAR(apparent * v.y() + 36.8 * ahead * v.z(), 2.0, 0.02 * 2.0);
  }
}

// A torque T_z about the vertical for a time t turns the base: J w = T_z t. J is the inertia of the base
// link, of the wheels at their places, and of the turning wheels and rotors. The last part counts with the
// squared ratio of the rates, (lx + ly) / R.
TEST(ScenePlant, AnotherInertiaTurnsTheBaseOtherwiseAndPushesItTheSame) {
  const lang::Program program = program_with("");
  const auto after = [&](double more, const Eigen::VectorXd& torque) {
    ScenePlant plant(program, with_fault(lang::FaultKind::inertia, 0.0, 10.0, "", more));
    follow(plant, program, 0.2, torque, [](const Sensed&, PlantStatus) {});
    return plant.truth().velocity;
  };
  Eigen::VectorXd turn = push(20.0);
  for (const char* joint : {"front_left_wheel", "rear_left_wheel"})
    turn[*program.robot.model.find_joint(joint)] *= -1.0;
  const double slow = after(0.5, turn).z(), as_said = after(0.0, turn).z(), fast = after(-0.5, turn).z();
  // T_z t / w = J, and the base link's own part of it is half as much more, or less.
  const double own = 2.15157;
  const double impulse = 20.0 * (0.27 + 0.22) * 0.2;  // four wheels at 45 deg: lx + ly is the arm of each rim
  EXPECT_NEAR(impulse / slow - impulse / as_said, 0.5 * own, 0.02 * own);
  EXPECT_NEAR(impulse / as_said - impulse / fast, 0.5 * own, 0.02 * own);
  EXPECT_NEAR(after(0.5, push(20.0)).x(), after(0.0, push(20.0)).x(), 1e-6);
}

// Three wheels push on a dry floor, the one on ice gives 0.02 of what it carries.
TEST(ScenePlant, OneWheelOnIceSlipsAlone) {
  const lang::Program program = program_with("");
  ScenePlant plant(program, with_fault(lang::FaultKind::floor_friction, 0.0, 10.0, "front_left_wheel", 0.02));
  Sensed last(program.robot.model, program.signals.size());
  follow(plant, program, 0.1, push(100.0), [&](const Sensed& sensed, PlantStatus) { last = sensed; });
  const auto slid = [&](int wheel) { return last.state.qd[wheel] * 0.0759 - plant.truth().velocity.x(); };
  const Eigen::Index icy = *program.robot.model.find_joint("front_left_wheel");
  const Eigen::Index dry = *program.robot.model.find_joint("rear_left_wheel");
  EXPECT_GT(slid(static_cast<int>(icy)), 0.5) << "it spins";
  EXPECT_LT(std::abs(slid(static_cast<int>(dry))), 0.1);
}

TEST(ScenePlant, ADivergedPlantStaysDiverged) {
  const lang::Program program = program_with("");
  ScenePlant plant(program, with_fault(lang::FaultKind::plant_diverges, 0.1, 0.001));
  follow(plant, program, 0.3, idle, [](const Sensed&, PlantStatus) {});
  EXPECT_NEAR(plant.truth().time, 0.1, 1e-9);
  Sensed sensed(program.robot.model);
  EXPECT_EQ(plant.sense(sensed), PlantStatus::diverged);
}

// 0.1 N m in each of four wheels: below 4 x 0.1 N m / R = 5.27 N nothing moves, above it the rest
// accelerates.
TEST(ScenePlant, DryFrictionOfTheJointsHoldsAndThenYields) {
  lang::Program program = program_with("");
  for (lang::JointFriction& friction : program.robot.friction) friction.coulomb = 0.1;
  const double held = 0.4 / 0.0759;
  const auto moved = [&](double force) {
    ScenePlant plant(program);
    follow(plant, program, 1.0, push(force), [](const Sensed&, PlantStatus) {});
    return plant.truth();
  };
  EXPECT_LT(std::abs(moved(0.9 * held).x), 1e-4);
  const double apparent = 46.0 + 4.0 * (0.0066249 + 676.0 * 13.5e-6) / (0.0759 * 0.0759);
  const double v = moved(held + 10.0).velocity.x();
  EXPECT_NEAR(v, 10.0 / apparent, 0.02 * v);
}

}  // namespace
}  // namespace zwang::runtime
