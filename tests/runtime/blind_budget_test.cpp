// Motion that motors make and no encoder confirms is bounded by what they were told, whatever encoders say.
#include "guard/blind_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "blind_course.hpp"
#include "guard/hook_latch.hpp"
#include "robots.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime::test {
namespace {

/// v^2 = 2 a S; then the base stands again, but for a tenth and the torque that counts as friction.
TEST(BlindBudget, FromRestABaseIsAsFastAsItsWayOfTheBudget) {
  Failing encoders;
  const Course course =
      go(sets_out(0.5), 1.0, {}, [&](PlanarBase&, Sensed& sensed) { encoders.spoil(sensed); });
  const double fastest = std::sqrt(2.0 * acceleration * BlindBudget::least_budget);
  EXPECT_EQ(course.reason, EventCode::frozen);
  EXPECT_NEAR(course.fastest, fastest, 0.1 * fastest);
  EXPECT_LT(course.at_end, 0.15 * fastest);
}

/// [kg] along x, of a body of this mass: the wheels roll and spin with it.
double apparent_mass(double body) {
  return body + 4.0 * (wheel_mass + (wheel_spin + rotor_inertia) / (wheel_radius * wheel_radius));
}

/// The motors give back the rates that the model gained, whatever the mass. So a base of another mass stands
/// again, too.
TEST(BlindBudget, ABaseOfAnotherMassStandsAgain) {
  for (const double share : {0.5, 1.5}) {
    lang::Robot robot = mecanum_robot();
    solver::ModelBuilder builder(
        solver::BaseType::ground, "base_link",
        solver::RigidInertia::from_com(share * body_mass, solver::Vector3(0, 0, 0.1),
                                       (share * solver::Vector3(2.0, 2.0, body_yaw)).asDiagonal()));
    for (int i = 0; i < 4; ++i) {
      const solver::Body& body = robot.model.bodies()[static_cast<std::size_t>(i) + 1];
      builder.add_link(body.name, "base_link", body.pose_in_parent, body.joint, body.inertia);
      builder.add_wheel(body.joint.name, robot.model.wheels()[static_cast<std::size_t>(i)]);
    }
    robot.model = builder.build();
    Failing encoders;
    const Course course = go(sets_out(0.5), 1.0, PlanarBase(robot),
                             [&](PlanarBase&, Sensed& sensed) { encoders.spoil(sensed); });
    const double k = apparent_mass(body_mass) / apparent_mass(share * body_mass);
    const double fastest = k * std::sqrt(2.0 * acceleration * BlindBudget::least_budget);
    EXPECT_EQ(course.reason, EventCode::frozen) << share;
    EXPECT_LT(course.fastest, 1.1 * fastest) << share;
    EXPECT_LT(course.at_end, 0.15 * fastest) << share;
  }
}

/// 90 steps a turn, which are 5 mm of way: it sets out, and when the encoders are dead it goes on for four
/// steps.
TEST(BlindBudget, ACoarseEncoderThatTheRobotFileTellsIsNotFrozen) {
  lang::Program told = sets_out(0.05);
  told.robot.encoder_step = 2.0 * std::numbers::pi / 90.0;
  const auto count = [&](Sensed& sensed) {
    const double step = told.robot.encoder_step;
    for (double& q : sensed.state.q) q = std::floor(q / step) * step;
  };
  const auto counting = [&](PlanarBase&, Sensed& sensed) { count(sensed); };
  const Course healthy = go(told, 3.0, {}, counting);
  EXPECT_EQ(healthy.reason, EventCode::none);
  EXPECT_EQ(healthy.probed, 0);
  lang::Program silent = told;
  silent.robot.encoder_step = 0.0;
  EXPECT_EQ(go(silent, 3.0, {}, counting).reason, EventCode::frozen) << "nobody said that a step is so long";

  lang::Program fast = sets_out(0.5);
  fast.robot.encoder_step = told.robot.encoder_step;
  Failing encoders;
  const Course dead = go(fast, 2.0, {}, [&](PlanarBase&, Sensed& sensed) {
    count(sensed);
    encoders.spoil(sensed);
  });
  const double way = BlindBudget::steps * fast.robot.encoder_step * wheel_radius;
  EXPECT_EQ(dead.reason, EventCode::frozen);
  EXPECT_LT(dead.fastest, 1.1 * std::sqrt(2.0 * acceleration * way));
  EXPECT_GT(dead.fastest, std::sqrt(2.0 * acceleration * BlindBudget::least_budget));
}

/// Under way the rates of the last sign count on: v - slowest covers S, whatever is told.
TEST(BlindBudget, UnderWayTheBaseIsBrakedByWhatItsEncodersSaidLast) {
  Failing encoders;
  const Course course = go(sets_out(0.3), 4.0, {}, [&](PlanarBase& base, Sensed& sensed) {
    if (base.time > 2.0) encoders.spoil(sensed);
  });
  const double delay = BlindBudget::least_budget / (0.29 - BlindBudget::slowest);
  EXPECT_EQ(course.reason, EventCode::frozen);
  EXPECT_NEAR(course.stopped_at, 2.0 + delay + BlindBudget::ridden_through, 0.003);
  EXPECT_LT(course.fastest, 0.3 * 1.02);
  EXPECT_LT(course.at_end, 2.0 * BlindBudget::slowest) << "less than the brake is told";
}

/// A base that stood at a wall without a gap was never held by it: told back, it comes off, and goes on. A
/// wall that gives nothing stops it within a tick, so that no step is counted while it is hit: only the look
/// finds it.
TEST(BlindBudget, ABaseAtAWallAnswersTheLook) {
  const auto wall = [](PlanarBase& base) {
    if (base.pose.x() < 0.0 || base.V.x() < 0.0) return;
    hold(base, {0.0, base.V.y(), base.V.z()});
    base.pose.x() = 0.0;
  };
  const Course course = go(
      sets_out(0.2), 3.0, {}, [](PlanarBase&, Sensed&) {}, wall);
  EXPECT_EQ(course.reason, EventCode::none);
  EXPECT_GE(course.probed, 1);
  const double between = BlindBudget::most_lean / acceleration + BlindBudget::slackens_for;
  EXPECT_LE(course.probed, 3.0 / between) << "a wall that gives nothing is asked each time";
}

/// A contact that a look has found is one of that place: a base that has left it is stopped as any other.
TEST(BlindBudget, WhatALookHasFoundIsLeftBehind) {
  Failing encoders;
  const auto wall = [](PlanarBase& base) {
    if (base.time > 0.5 || base.pose.x() < 0.0 || base.V.x() < 0.0) return;
    hold(base, {0.0, base.V.y(), base.V.z()});
    base.pose.x() = 0.0;
  };
  const Course course = go(
      sets_out(0.2), 3.0, {},
      [&](PlanarBase& base, Sensed& sensed) {
        if (base.pose.x() > 0.1) encoders.spoil(sensed);
      },
      wall);
  EXPECT_GE(course.probed, 1);
  EXPECT_EQ(course.reason, EventCode::frozen);
  EXPECT_LT(course.fastest, 1.1 * 0.2);
}

/// Samples that stay the same for 10 ms under way cost a little speed, as lost ones do.
TEST(BlindBudget, AShortFreezeUnderWayIsRiddenThrough) {
  Failing encoders;
  double slowest = 1.0;
  const Course course = go(
      sets_out(0.3), 4.0, {},
      [&](PlanarBase& base, Sensed& sensed) {
        if (base.time > 3.0 && base.time < 3.01) encoders.spoil(sensed);
      },
      [&](const PlanarBase& base) {
        if (base.time > 3.0) slowest = std::min(slowest, base.V.x());
      });
  EXPECT_EQ(course.reason, EventCode::none);
  EXPECT_EQ(course.probed, 1);
  EXPECT_LT(course.fastest, 0.3 * 1.02);
  EXPECT_GT(slowest, 0.25);
}

/// Ten seconds after the stop the run is finished, and says that nobody saw the base stand.
TEST(BlindBudget, AStopWithoutEncodersSaysThatTheBaseMayStillMove) {
  const lang::Program program_ = sets_out(0.5);
  for (const bool is_dead : {true, false}) {
    Runner runner(program_);
    Sensed sensed(program_.robot.model, program_.signals.size());
    Failing encoders;
    PlanarBase base;
    while (base.time < 12.0) {
      base.sense(sensed);
      sensed.base_measured = false;
      if (is_dead) encoders.spoil(sensed);
      if (!is_dead && base.time > 1.0) runner.guard().stop(EventCode::requested);
      base.step(runner.step(sensed));
      if (is_dead && base.time < 10.0) {
        ASSERT_FALSE(runner.finished());
      }
    }
    EXPECT_TRUE(runner.finished());
    EXPECT_EQ(runner.may_still_move(), is_dead);
  }
}

struct Press {
  double fastest = 0.0;     ///< [m/s] after the encoders died
  double least = press;     ///< [N] of the wall's force from 2 s on, until then and its end
  double mean = 0.0;        ///< [N] of it
  double at_end = 0.0;      ///< [m/s]
  bool is_doubted = false;  ///< the report says that the base may still move
  EventCode reason = EventCode::none;
};

/// A base that presses on a wall; its encoders die, and the wall goes away.
Press press_on_a_wall(double dead_at, double gone_at, double stiffness = 1e5, double step = 0.0,
                      double seconds = 8.0) {
  constexpr double damping = 2e3, wall = 0.02;  // [N s/m], [m]
  const lang::Program program_ = presses();
  Runner runner(program_);
  Sensed sensed(program_.robot.model, program_.signals.size());
  Failing encoders;
  PlanarBase base;
  Press result;
  int ticks = 0;
  while (base.time < seconds && !runner.finished()) {
    base.sense(sensed);
    sensed.base_measured = false;
    for (double& q : sensed.state.q) {
      if (step > 0.0) q = std::floor(q / step) * step;
    }
    const bool is_dead = base.time > dead_at;
    if (is_dead) encoders.spoil(sensed);
    const double depth = base.pose.x() - wall;
    const bool is_there = depth > 0.0 && base.time < gone_at;
    const double held = is_there ? std::max(0.0, stiffness * depth + damping * base.V.x()) : 0.0;
    base.step(runner.step(sensed), {-held, 0.0, 0.0});
    if (is_dead) result.fastest = std::max(result.fastest, std::abs(base.V.x()));
    if (base.time < 2.0 || base.time > 3.9 || is_dead) continue;
    result.least = std::min(result.least, held);
    result.mean += (held - result.mean) / ++ticks;
  }
  result.at_end = std::abs(base.V.x());
  result.is_doubted = runner.may_still_move();
  result.reason = runner.guard().reason();
  return result;
}

/// Suppose that the wall goes with the last count. Then the base gains `most_lean` until the press is
/// slackened, and more until the slackened press is let go. This model is exact: k = 1, and c = 1 along x.
TEST(BlindBudget, APressThatNoEncoderConfirmsGainsNoMoreThanItsLean) {
  const double a = press / apparent_mass(body_mass);
  const double bound = BlindBudget::most_lean + 2.0 / 3.0 * a * BlindBudget::slackens_for;
  for (const double gone_after : {0.0, 0.05, 0.15, 0.3, never}) {
    const Press result = press_on_a_wall(2.5, 2.5 + gone_after);
    EXPECT_EQ(result.reason, EventCode::frozen) << gone_after;
    EXPECT_LT(result.fastest, 1.1 * bound) << gone_after;
  }
}

/// F (t / T)^2 of the press are missing when a rim has gone one step x: t^4 = 12 m T^2 x / F, at V = 4 x / t.
/// Then the press is back, and the wall has lost K (x + V sqrt(m / K)) at most.
TEST(BlindBudget, APressThatIsAskedGoesOn) {
  constexpr double step = 5e-5;  // [rad]
  const double m = apparent_mass(body_mass), x = step * wheel_radius, T = BlindBudget::slackens_for;
  const double V = 4.0 * x / std::pow(12.0 * m * T * T * x / press, 0.25);
  for (const double stiffness : {2e3, 1e5, 1e6}) {
    const Press result = press_on_a_wall(never, never, stiffness, step);
    EXPECT_EQ(result.reason, EventCode::none) << stiffness;
    EXPECT_GT(result.least, press - stiffness * (x + V * std::sqrt(m / stiffness))) << stiffness;
    EXPECT_GT(result.mean, 0.98 * press) << stiffness;
    if (stiffness > 1e4) {
      EXPECT_LT(result.least, press - 0.5) << "nobody asks";
    }
  }
}

/// Encoders that die just before the end, or after it, leave no time for a slackened press. After the end the
/// wall that is let go moves the base back by 0.2 mm. A run that ends while the base moves says that it may
/// still move.
TEST(BlindBudget, AnEndBehindAPressThatNoEncoderConfirmsIsTrue) {
  const Press healthy = press_on_a_wall(never, never);
  EXPECT_EQ(healthy.reason, EventCode::none);
  EXPECT_FALSE(healthy.is_doubted);
  for (const double dead_at : {3.5, 3.9, 3.97, 4.05}) {
    const Press result = press_on_a_wall(dead_at, dead_at, 1e5, 0.0, 16.0);
    EXPECT_TRUE(result.at_end < BlindBudget::slowest || result.is_doubted) << dead_at << " " << result.at_end;
  }
}

/// A motion that no encoder confirmed before a swap of programs is not confirmed after it.
TEST(BlindBudget, ASwapOfProgramsDoesNotFillIt) {
  const lang::Program program_ = sets_out(0.5);
  Runner runner(program_);
  Sensed sensed(program_.robot.model, program_.signals.size());
  Failing encoders;
  PlanarBase base;
  double fastest = 0.0;
  for (int tick = 0; tick < 500; ++tick) {
    base.sense(sensed);
    sensed.base_measured = false;
    encoders.spoil(sensed);
    Runner next(program_);
    if (tick == 15) {
      ASSERT_TRUE(runner.swap_program(next));
    }
    base.step(runner.step(sensed));
    fastest = std::max(fastest, std::abs(base.V.x()));
  }
  EXPECT_EQ(runner.guard().reason(), EventCode::frozen);
  EXPECT_LT(fastest, 1.1 * std::sqrt(2.0 * acceleration * BlindBudget::least_budget));
}

}  // namespace
}  // namespace zwang::runtime::test
