// A motor that turns the wrong way: in a contact, and under the brake of the protective stop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "constants.hpp"
#include "guard/runaway_watch.hpp"
#include "guard/wheel_brake.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

lang::Program beside_a_far_wall(const std::string& robot) {
  return zwang::test::shipped_program("wall_align.yaml", robot, "wall_far");
}

struct Flipped {
  const char* robot;
  const char* wheel;
};

void PrintTo(const Flipped& flipped, std::ostream* out) {
  *out << flipped.robot << " " << flipped.wheel;
}

class MotorInContact : public testing::TestWithParam<Flipped> {};

/// At rest against the wall, 20 N and every speed told to be 0, a motor turns around. The guard has to find a
/// speed of `margin`. Until then each axis gains at most
///   a (dwell + 2) look_every = 0.07 m/s more, a = 1 m/s^2 the limit of a row's demand
TEST_P(MotorInContact, ThatFlipsIsNamedAndTheBaseStands) {
  const lang::Program program = beside_a_far_wall(GetParam().robot);
  const double at = 15.0;
  ScenePlantOptions options;
  options.simulation.start_yaw = 0.0;
  options.faults.push_back(
      lang::Fault{.kind = lang::FaultKind::torque_flipped, .at = at, .joint = GetParam().wheel});
  lang::Program pressing = program;  // for ever, and square
  pressing.tasks[1].exits.clear();
  ScenePlant plant(pressing, options);
  Runner runner(pressing, {.period = period});
  Sensed sensed(program.robot.model, program.signals.size());
  double fastest = 0.0, hardest = 0.0, stopped_at = -1.0;
  while (!runner.finished() && plant.truth().time < at + 3.0) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    if (plant.truth().time < at) continue;
    fastest = std::max(fastest, plant.truth().velocity.head<2>().norm());
    hardest = std::max(hardest, plant.truth().objects[0].force);
    if (runner.guard().stopped() && stopped_at < 0.0) stopped_at = plant.truth().time - at;
  }
  ASSERT_TRUE(runner.guard().stopped());
  const Event& event = runner.guard().stop_event();
  std::printf("%s, %s: %s after %.0f ms; %.3f m/s and %.1f N at most; stands %.0f ms later\n",
              GetParam().robot, GetParam().wheel, to_string(event.code), 1e3 * stopped_at, fastest, hardest,
              1e3 * (plant.truth().time - at - stopped_at));
  // By its own torque, or by the energy; either names the motor.
  EXPECT_TRUE(event.code == EventCode::runaway || event.code == EventCode::torque_flipped)
      << to_string(event.code);
  EXPECT_EQ(runner.event_signal(event).substr(0, std::string(GetParam().wheel).size() + 1),
            std::string(GetParam().wheel) + ".");
  EXPECT_LE(fastest, RunawayWatch::margin + 0.07);
  EXPECT_LE(hardest, 22.0) << "the bound and 10 %";
  EXPECT_TRUE(runner.finished());
  EXPECT_LE(plant.truth().time - at - stopped_at, 1.0) << "stands, and not because the time is up";
}

INSTANTIATE_TEST_SUITE_P(
    Wheels, MotorInContact,
    testing::Values(Flipped{"mecanum", "front_left_wheel"}, Flipped{"mecanum", "front_right_wheel"},
                    Flipped{"mecanum", "rear_left_wheel"}, Flipped{"mecanum", "rear_right_wheel"},
                    Flipped{"omni", "front_left_wheel"}, Flipped{"omni", "front_right_wheel"},
                    Flipped{"diff", "left_wheel"}, Flipped{"diff", "right_wheel"}),
    [](const auto& tested) { return std::string(tested.param.robot) + "_" + tested.param.wheel; });

/// A stop for another reason, on a base of which nobody knows that a motor is flipped: the brake finds it.
TEST(ProtectiveStop, BrakesWithAMotorThatTurnsTheWrongWay) {
  for (const auto& [robot, wheel] : {Flipped{"mecanum", "rear_left_wheel"},
                                     Flipped{"omni", "front_left_wheel"}, Flipped{"diff", "right_wheel"}}) {
    const lang::Program program = beside_a_far_wall(robot);
    ScenePlantOptions options;
    options.simulation.start_yaw = 0.0;
    options.faults.push_back(lang::Fault{.kind = lang::FaultKind::torque_flipped, .at = 3.0, .joint = wheel});
    ScenePlant plant(program, options);
    Runner runner(program, {.period = period});
    Sensed sensed(program.robot.model, program.signals.size());
    double rest_since = -1.0;
    while (plant.truth().time < 6.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      if (plant.truth().time >= 3.0) runner.guard().stop(EventCode::requested);
      ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
      const bool rests = plant.truth().velocity.head<2>().norm() < 0.01;
      if (!rests) rest_since = -1.0;
      if (rests && rest_since < 0.0) rest_since = plant.truth().time;
    }
    std::printf("%s, %s: stands %.2f s after the stop, x %.3f m\n", robot, wheel, rest_since - 3.0,
                plant.truth().x);
    EXPECT_EQ(runner.guard().reason(), EventCode::requested);
    EXPECT_GT(rest_since, 0.0) << robot;
    EXPECT_LT(rest_since, 4.0) << robot;
  }
}

/// Three omni wheels, or two of a differential base, do not brake every motion without one of them. A motor
/// that is taken for reversed, and is not, is found by its torque, and brakes again. The base stands then,
/// and the event tells it. A motor that really gives nothing, or the reverse, is never said to obey.
TEST(ProtectiveStop, BrakesAgainWithAMotorThatIsTakenForReversed) {
  struct Case {
    const char *robot, *wheel;
    std::optional<lang::FaultKind> fault;
  };
  const Case cases[] = {{"omni", "front_left_wheel", {}},
                        {"omni", "rear_wheel", {}},
                        {"diff", "right_wheel", {}},
                        {"mecanum", "rear_left_wheel", {}},
                        {"omni", "front_left_wheel", lang::FaultKind::torque_flipped},
                        {"omni", "front_left_wheel", lang::FaultKind::torque_lost},
                        {"diff", "right_wheel", lang::FaultKind::torque_flipped}};
  for (const Case& one : cases) {
    const lang::Program program = zwang::test::shipped_program("laws/circle.yaml", one.robot);
    ScenePlantOptions options;
    if (one.fault) options.faults.push_back({.kind = *one.fault, .at = 3.0, .joint = one.wheel});
    ScenePlant plant(program, options);
    Runner runner(program, {.period = period});
    Sensed sensed(program.robot.model, program.signals.size());
    const int joint = *program.robot.model.find_joint(one.wheel);
    while (!runner.finished() && plant.truth().time < 14.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      if (plant.truth().time >= 3.0) {
        runner.guard().stop(EventCode::torque_flipped, event_signal::of_joint(joint, event_signal::tau), 0.1);
      }
      ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    }
    const auto obeyed = std::ranges::count(runner.events(), EventCode::motor_obeyed, &Event::code);
    const double speed = plant.truth().velocity.head<2>().norm();
    std::printf("%s, %s: stands %.2f s after the stop, %.4f m/s, obeyed %d\n", one.robot, one.wheel,
                plant.truth().time - 3.0, speed, static_cast<int>(obeyed));
    EXPECT_EQ(obeyed > 0, runner.guard().motor_obeyed());
    if (one.fault) {
      EXPECT_EQ(obeyed, 0) << one.robot;
      continue;
    }
    EXPECT_LT(speed, 0.02) << one.robot << " " << one.wheel;
    EXPECT_FALSE(runner.may_still_move()) << one.robot << " " << one.wheel;
    EXPECT_LE(obeyed, 1) << one.robot;
    if (obeyed > 0) {
      EXPECT_NE(runner.because().find("obeyed"), std::string::npos) << runner.because();
    }
  }
}

/// Somebody pushes the base for 0.6 s of each second, from 0.1 s or from 3 s after the onset of its stop.
struct Pushed {
  double fastest = 0.0;  ///< [m/s] from 3 s after the onset
  bool obeyed = false;
};

Pushed push_in_the_stop(const char* robot, const lang::Fault* fault, double force, double way, double from) {
  const lang::Program program = zwang::test::shipped_program("laws/circle.yaml", robot);
  ScenePlantOptions options;
  if (fault != nullptr) options.faults.push_back(*fault);
  ScenePlant plant(program, options);
  Runner runner(program, {.period = period});
  Sensed sensed(program.robot.model, program.signals.size());
  Pushed pushed;
  for (double now = 0.0; now < 12.0; now = plant.truth().time) {
    const bool is_pushed = now > 3.0 + from && std::fmod(now, 1.0) < 0.6;
    plant.set_push({{0.0, 0.0}, (is_pushed ? force : 0.0) * Eigen::Vector2d(std::cos(way), std::sin(way))});
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    if (now >= 3.0 && fault == nullptr) {
      runner.guard().stop(EventCode::requested, 0, 0.0);
    } else if (now >= 3.0) {
      const int joint = *program.robot.model.find_joint(fault->joint);
      runner.guard().stop(EventCode::torque_flipped, event_signal::of_joint(joint, event_signal::tau), 0.1);
    }
    EXPECT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    if (now > 6.0) pushed.fastest = std::max(pushed.fastest, plant.truth().velocity.head<2>().norm());
  }
  pushed.obeyed = runner.guard().motor_obeyed();
  return pushed;
}

/// Each push makes the base faster, whatever the torque of the accused motor is. A motor that gives nothing,
/// or the reverse, is not said to obey for that.
TEST(ProtectiveStop, TakesNoPushForAMotorThatObeys) {
  using enum lang::FaultKind;
  struct Case {
    const char *robot, *wheel;
    lang::FaultKind fault;
    double force;  ///< [N] that the brakes hold
  };
  const Case cases[] = {{"mecanum", "front_left_wheel", torque_lost, 40.0},
                        {"mecanum", "rear_left_wheel", torque_flipped, 40.0},
                        {"omni", "front_left_wheel", torque_lost, 10.0},
                        {"omni", "rear_wheel", torque_flipped, 10.0},
                        {"diff", "right_wheel", torque_lost, 40.0},
                        {"diff", "left_wheel", torque_flipped, 40.0}};
  for (const Case& one : cases) {
    const lang::Fault fault = {.kind = one.fault, .at = 3.0, .joint = one.wheel};
    for (const double way : {0.0, 0.5 * std::numbers::pi, std::numbers::pi}) {
      for (const double from : {0.1, 3.0}) {
        const Pushed pushed = push_in_the_stop(one.robot, &fault, one.force, way, from);
        std::printf("%s, %s %s, pushed to %3.0f deg from %.1f s on: %.4f m/s\n", one.robot, one.wheel,
                    one.fault == torque_lost ? "lost" : "reversed", way * 180.0 / std::numbers::pi, from,
                    pushed.fastest);
        EXPECT_FALSE(pushed.obeyed) << one.robot << " " << one.wheel << " " << way << " " << from;
      }
    }
  }
}

/// A push looks like a motor that turns the wrong way, whichever motor the brake leaves out. With all of them
/// left out it can only be a push: they brake again. A search tries N + 2 choices for at most two looks each.
/// Without any brake for so long the push P of a mass m makes P (N + 2) 40 ms / m.
TEST(ProtectiveStop, BrakesABaseThatIsPushedAgainAndAgain) {
  struct Case {
    const char* robot;
    double wheels, force, mass;  ///< [N] below the 80 N of the brakes; [kg]
  };
  for (const Case& one : {Case{"diff", 2, 60.0, 68.0}, Case{"mecanum", 4, 70.0, 56.9}}) {
    for (const double way : {0.0, 0.5 * std::numbers::pi, std::numbers::pi}) {
      const double fastest = push_in_the_stop(one.robot, nullptr, one.force, way, 3.0).fastest;
      std::printf("%s, pushed to %3.0f deg with %.0f N: %.4f m/s\n", one.robot,
                  way * 180.0 / std::numbers::pi, one.force, fastest);
      EXPECT_LT(fastest, one.force * (one.wheels + 2.0) * 2.0 * WheelBrake::look_every / one.mass)
          << one.robot;
    }
  }
}

/// All of them from the same moment on, or all encoders: no single one that is left out makes it better.
TEST(ProtectiveStop, BrakesWithAllMotorsThatTurnTheWrongWay) {
  for (const char* robot : {"mecanum", "omni", "diff", "kelo"}) {
    const lang::Program program = beside_a_far_wall(robot);
    ScenePlantOptions options;
    options.simulation.start_yaw = 0.0;
    ScenePlant plant(program, options);
    Runner runner(program, {.period = period});
    Sensed sensed(program.robot.model, program.signals.size());
    double fastest = 0.0;
    while (!runner.finished() && plant.truth().time < 10.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      const bool is_broken = plant.truth().time >= 3.0;
      if (is_broken) runner.guard().stop(EventCode::requested);
      const Eigen::VectorXd& tau = runner.step(sensed);
      ASSERT_EQ(plant.apply(is_broken ? Eigen::VectorXd(-tau) : tau), PlantStatus::ok);
      fastest = std::max(fastest, plant.truth().velocity.head<2>().norm());
    }
    std::printf("%s: stands %.2f s after the stop, %.3f m/s at most\n", robot, plant.truth().time - 3.0,
                fastest);
    EXPECT_LT(plant.truth().velocity.head<2>().norm(), 0.02) << robot;
    EXPECT_LT(plant.truth().time, 6.0) << robot;
    // One look finds it, and each motor is left out for one, while the others speed the base up with the
    // stop's force. A motion that begins between two looks is seen by the next but one.
    const double looks = static_cast<double>(program.robot.model.wheels().size()) + 3.0;
    const double a = program.robot.stop.force / program.robot.model.total_mass();
    EXPECT_LT(fastest, 0.08 + a * looks * 0.02) << robot;
  }
}

}  // namespace
}  // namespace zwang::runtime
