#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "robots.hpp"
#include "zwang/runtime/safety_guard.hpp"

namespace zwang::runtime {
namespace {

using namespace test;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

struct GuardBench {
  explicit GuardBench(const GuardSettings& settings = {}) : guard(robot, settings), sensed(robot.model) {
    tau = wanted = Eigen::VectorXd::Zero(4);
  }
  SampleStatus admit_after(double dt) {
    sensed.time += dt;
    return guard.admit(sensed);
  }
  lang::Robot robot = mecanum_robot();
  SafetyGuard guard;
  Sensed sensed;
  Eigen::VectorXd tau, wanted;
};

TEST(Guard, RefusesEveryNumberThatIsNotFiniteAndStopsInTheSameTick) {
  std::vector<std::function<double&(Sensed&)>> entries;
  entries.push_back([](Sensed& s) -> double& { return s.time; });
  for (int j = 0; j < 4; ++j) {
    entries.push_back([j](Sensed& s) -> double& { return s.state.q(j); });
    entries.push_back([j](Sensed& s) -> double& { return s.state.qd(j); });
    entries.push_back([j](Sensed& s) -> double& { return s.state.tau_ff(j); });
  }
  for (int i = 0; i < 3; ++i) {
    entries.push_back([i](Sensed& s) -> double& { return s.state.base_pose.position(i); });
    entries.push_back([i](Sensed& s) -> double& { return s.state.base_twist.angular(i); });
    entries.push_back([i](Sensed& s) -> double& { return s.state.base_twist.linear(i); });
    for (int k = 0; k < 3; ++k) {
      entries.push_back([i, k](Sensed& s) -> double& { return s.state.base_pose.rotation(i, k); });
    }
    for (std::size_t body = 0; body < 5; ++body) {
      entries.push_back([i, body](Sensed& s) -> double& { return s.state.f_ext[body].angular(i); });
      entries.push_back([i, body](Sensed& s) -> double& { return s.state.f_ext[body].linear(i); });
    }
  }
  for (const double bad : {nan, inf, -inf, 1e300, -1e300}) {
    for (std::size_t e = 0; e < entries.size(); ++e) {
      GuardBench bench;
      ASSERT_EQ(bench.guard.admit(bench.sensed), SampleStatus::good);
      bench.wanted.setConstant(5.0);
      bench.guard.output(bench.sensed, bench.wanted, bench.tau);
      ASSERT_EQ(bench.tau(0), 5.0);
      bench.sensed.time += period;
      entries[e](bench.sensed) = bad;
      EXPECT_EQ(bench.guard.admit(bench.sensed), SampleStatus::not_finite) << e;
      EXPECT_TRUE(bench.guard.stopped());
      EXPECT_EQ(bench.guard.reason(), EventCode::bad_sample);
      EXPECT_EQ(bench.guard.counters().refused_values, 1u);
      EXPECT_EQ(bench.guard.output_blind(bench.tau), GuardStatus::stopped);
      EXPECT_TRUE(bench.tau.isZero(0.0)) << e;
    }
  }
}

TEST(Guard, ATorqueThatIsNotFiniteStopsAndIsNeverClampedIntoFullTorque) {
  for (const double bad : {nan, inf, -inf}) {
    for (int j = 0; j < 4; ++j) {
      GuardBench bench;
      ASSERT_EQ(bench.guard.admit(bench.sensed), SampleStatus::good);
      bench.wanted(j) = bad;
      EXPECT_EQ(bench.guard.output(bench.sensed, bench.wanted, bench.tau), GuardStatus::stopped);
      EXPECT_TRUE(bench.tau.isZero(0.0)) << "the wheels stand, so the brake has nothing to do";
      EXPECT_EQ(bench.guard.reason(), EventCode::bad_torque);
    }
  }
}

TEST(Guard, RefusesAStateOfTheWrongSize) {
  GuardBench rates, wrenches;
  rates.sensed.state.qd.resize(3);
  EXPECT_EQ(rates.guard.admit(rates.sensed), SampleStatus::not_finite);
  wrenches.sensed.state.f_ext.resize(2);
  EXPECT_EQ(wrenches.guard.admit(wrenches.sensed), SampleStatus::not_finite);
}

// The rotation of a quaternion that nobody normalised, or of a mirrored frame, is refused. A unit quaternion
// with four decimals is accepted.
TEST(Guard, RefusesAPoseWhoseRotationIsNone) {
  const Eigen::Quaterniond quarter(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
  for (const auto& [rotation, status] :
       {std::pair{(1.01 * solver::Matrix3::Identity()).eval(), SampleStatus::not_finite},
        std::pair{solver::Matrix3(Eigen::Vector3d(1, -1, 1).asDiagonal()), SampleStatus::not_finite},
        std::pair{Eigen::Quaterniond(0.7071, 0.0, 0.0, 0.7071).toRotationMatrix().eval(), SampleStatus::good},
        std::pair{Eigen::Quaterniond(-quarter.coeffs()).toRotationMatrix().eval(), SampleStatus::good}}) {
    GuardBench bench;
    bench.sensed.state.base_pose.rotation = rotation;
    EXPECT_EQ(bench.guard.admit(bench.sensed), status) << rotation;
    if (status == SampleStatus::good) continue;
    EXPECT_EQ(bench.guard.reason(), EventCode::bad_sample);
  }
}

TEST(Guard, CutsTorquesToTheJointsLimits) {
  GuardBench bench;
  ASSERT_EQ(bench.guard.admit(bench.sensed), SampleStatus::good);
  bench.wanted << effort, -effort, 1.01 * effort, -1e6;
  EXPECT_EQ(bench.guard.output(bench.sensed, bench.wanted, bench.tau), GuardStatus::limited);
  EXPECT_EQ(bench.tau, Eigen::Vector4d(effort, -effort, effort, -effort));
  EXPECT_EQ(bench.guard.counters().limited, 1u);
  bench.wanted << effort, -effort, 0, 0;
  EXPECT_EQ(bench.guard.output(bench.sensed, bench.wanted, bench.tau), GuardStatus::passed);
}

TEST(Guard, BoundsTheSlewOfEveryTorqueIncludingTheStops) {
  GuardBench bench({.max_slew = 1000.0});  // 1 N m a tick
  ASSERT_EQ(bench.admit_after(0.0), SampleStatus::good);
  bench.wanted << 3, -3, 0.5, 0;
  EXPECT_EQ(bench.guard.output(bench.sensed, bench.wanted, bench.tau), GuardStatus::slewed);
  EXPECT_EQ(bench.tau, Eigen::Vector4d(1, -1, 0.5, 0));
  bench.guard.output(bench.sensed, bench.wanted, bench.tau);
  bench.guard.output(bench.sensed, bench.wanted, bench.tau);
  EXPECT_EQ(bench.tau, Eigen::Vector4d(3, -3, 0.5, 0));
  bench.wanted(0) = nan;
  bench.guard.output(bench.sensed, bench.wanted, bench.tau);
  EXPECT_EQ(bench.tau, Eigen::Vector4d(2, -2, 0, 0));
}

/// Of each joint its own, and the stop keeps to it on its first tick.
TEST(Guard, KeepsToTheSlewOfTheRobotFile) {
  lang::Robot robot = mecanum_robot();
  robot.slew = Eigen::Vector4d(1000.0, 2000.0, 3000.0, solver::infinity);
  SafetyGuard guard(robot);
  PlanarBase base;
  base.V = {0.5, 0.0, 0.0};
  Sensed sensed(robot.model);
  base.sense(sensed);
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(4);
  ASSERT_EQ(guard.admit(sensed), SampleStatus::good);
  EXPECT_EQ(guard.output(sensed, Eigen::Vector4d::Constant(5.0), tau), GuardStatus::slewed);
  EXPECT_EQ(tau, Eigen::Vector4d(1, 2, 3, 5));
  guard.stop(EventCode::requested);
  EXPECT_EQ(guard.output(sensed, Eigen::Vector4d::Constant(5.0), tau), GuardStatus::stopped);
  EXPECT_EQ(tau.head<3>(), Eigen::Vector3d(0, 0, 0));
  EXPECT_LE(tau(3), 0.0);
  // At 0.5 m/s the stop's 1 m/s^2 leave the wheels 0.5 s. These do not slow down: 80 N over four wheels of 75
  // mm, 1.5 N m, in the end.
  for (int i = 0; i < 100; ++i) guard.output(sensed, tau, tau);
  EXPECT_LT(tau.maxCoeff(), -0.5) << "they all brake";
}

TEST(Guard, EventsHaveTheTimeOfTheirSample) {
  GuardBench nan_at;
  ASSERT_EQ(nan_at.admit_after(2.0), SampleStatus::good);
  nan_at.sensed.state.qd(1) = nan;
  EXPECT_EQ(nan_at.admit_after(period), SampleStatus::not_finite);
  EXPECT_EQ(nan_at.guard.stop_event().time, nan_at.sensed.time);

  GuardBench no_time;
  ASSERT_EQ(no_time.admit_after(2.0), SampleStatus::good);
  no_time.sensed.time = nan;
  EXPECT_EQ(no_time.guard.admit(no_time.sensed), SampleStatus::not_finite);
  EXPECT_NEAR(no_time.guard.stop_event().time, 2.0 + period, 1e-9) << "when it was due";

  GuardBench lost;
  ASSERT_EQ(lost.admit_after(2.0), SampleStatus::good);
  for (int i = 1; i <= 3; ++i) {
    EXPECT_EQ(lost.admit_after(0.0), SampleStatus::bad_clock);
    EXPECT_EQ(lost.guard.refusal().code, EventCode::sample_lost);
    EXPECT_NEAR(lost.guard.refusal().time, 2.0 + i * period, 1e-9);
  }
  EXPECT_EQ(lost.admit_after(-0.5), SampleStatus::bad_clock);
  EXPECT_EQ(lost.guard.refusal().code, EventCode::clock_refused);
}

TEST(Guard, AClockThatStandsGoesBackOrJumpsIsRefusedAndCounted) {
  GuardBench bench;
  ASSERT_EQ(bench.admit_after(0.0), SampleStatus::good);
  ASSERT_EQ(bench.admit_after(period), SampleStatus::good);
  EXPECT_EQ(bench.admit_after(0.0), SampleStatus::bad_clock);
  EXPECT_EQ(bench.admit_after(-0.5), SampleStatus::bad_clock);
  EXPECT_EQ(bench.guard.counters().refused_clock, 2u);
  EXPECT_FALSE(bench.guard.stopped());
  bench.wanted.setConstant(2.0);
  EXPECT_EQ(bench.guard.output_blind(bench.tau), GuardStatus::held);
  EXPECT_EQ(bench.admit_after(0.5 + period), SampleStatus::good) << "the clock caught up";
  EXPECT_EQ(bench.admit_after(0.11), SampleStatus::bad_clock);
  EXPECT_EQ(bench.guard.counters().refused_clock, 3u);
  EXPECT_EQ(bench.admit_after(period), SampleStatus::good) << "the clock goes on from where it jumped to";
}

/// Values and stamp are judged apart: once the stop is latched it brakes by the values, whatever the stamp.
TEST(Guard, AStopBrakesByGoodValuesWhateverTheirStamp) {
  GuardBench bench;
  ASSERT_EQ(bench.admit_after(3.0), SampleStatus::good);
  bench.sensed.time = 1.0;
  for (int i = 0; i < 20; ++i) {
    bench.sensed.state.q.array() += 0.01;
    EXPECT_EQ(bench.admit_after(period), SampleStatus::bad_clock) << i;
  }
  EXPECT_EQ(bench.guard.reason(), EventCode::clock_back);
  EXPECT_NEAR(bench.guard.stop_event().value, -2.0 + 20 * period, 1e-9);
  double last = bench.guard.time();
  EXPECT_EQ(last, 3.0);
  const auto brakes = [&](SampleStatus expected) {
    bench.sensed.state.q.array() += 0.01;
    bench.sensed.state.qd.setConstant(10.0);
    EXPECT_EQ(bench.guard.admit(bench.sensed), expected) << bench.sensed.time;
    EXPECT_EQ(bench.guard.output(bench.sensed, bench.wanted, bench.tau), GuardStatus::stopped);
    EXPECT_LT(bench.tau.maxCoeff(), 0.0) << "against 10 rad/s";
    EXPECT_GT(bench.guard.time(), last);
    last = bench.guard.time();
  };
  bench.sensed.time += period;
  brakes(SampleStatus::untimely);
  bench.sensed.time += period;
  brakes(SampleStatus::good);  // the stamp that went back is the clock's zero
  EXPECT_NEAR(bench.guard.clock_shift(), 2.0, 1e-9);
  for (const double stamp : {bench.sensed.time, -5.0, 1e3, nan, inf, -5.0}) {
    bench.sensed.time = stamp;
    brakes(SampleStatus::untimely);
  }
  bench.sensed.state.qd(2) = nan;
  EXPECT_EQ(bench.guard.admit(bench.sensed), SampleStatus::not_finite);
  bench.guard.reset();
  bench.sensed.state.qd(2) = 0.0;
  bench.sensed.time = -50.0;
  EXPECT_EQ(bench.guard.admit(bench.sensed), SampleStatus::good);
  EXPECT_GT(bench.guard.time(), last) << "after a reset, too";
}

/// Under one stamp: other values are samples of a clock that stands, the same ones are no sample.
TEST(Guard, AClockThatStandsIsToldFromSamplesThatStayAway) {
  GuardBench stands, silent;
  for (GuardBench* bench : {&stands, &silent}) {
    ASSERT_EQ(bench->admit_after(0.0), SampleStatus::good);
    for (int i = 0; i < 20; ++i) {
      if (bench == &stands) bench->sensed.state.q.array() += 1e-3;
      EXPECT_EQ(bench->admit_after(0.0), SampleStatus::bad_clock);
    }
  }
  EXPECT_EQ(stands.guard.reason(), EventCode::clock_stands);
  EXPECT_EQ(silent.guard.reason(), EventCode::lost_ticks);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(silent.admit_after(0.0), SampleStatus::bad_clock) << "the brake goes by memory";
    EXPECT_EQ(silent.guard.refusal().code, EventCode::sample_lost);
    stands.sensed.state.q.array() += 1e-3;
    EXPECT_EQ(stands.admit_after(0.0), SampleStatus::untimely);
  }
  EXPECT_EQ(stands.admit_after(0.0), SampleStatus::untimely) << "it has come to rest";
}

TEST(Guard, ARefusedSampleHoldsTheLastTorques) {
  GuardBench bench;
  ASSERT_EQ(bench.admit_after(0.0), SampleStatus::good);
  bench.wanted << 1, 2, 3, 4;
  bench.guard.output(bench.sensed, bench.wanted, bench.tau);
  ASSERT_EQ(bench.admit_after(0.0), SampleStatus::bad_clock);
  bench.tau.setZero();
  EXPECT_EQ(bench.guard.output_blind(bench.tau), GuardStatus::held);
  EXPECT_EQ(bench.tau, bench.wanted);
}

TEST(Guard, AFewLostTicksGoOnTwentyStop) {
  GuardBench few;
  ASSERT_EQ(few.admit_after(0.0), SampleStatus::good);
  EXPECT_EQ(few.admit_after(5 * period), SampleStatus::good);
  EXPECT_EQ(few.admit_after(20 * period), SampleStatus::good);
  EXPECT_FALSE(few.guard.stopped());
  EXPECT_EQ(few.admit_after(21 * period), SampleStatus::good);
  EXPECT_EQ(few.guard.reason(), EventCode::lost_ticks);

  GuardBench frozen;
  ASSERT_EQ(frozen.admit_after(0.0), SampleStatus::good);
  for (int i = 1; i <= 20; ++i) {
    EXPECT_FALSE(frozen.guard.stopped()) << i;
    EXPECT_EQ(frozen.admit_after(0.0), SampleStatus::bad_clock);
  }
  EXPECT_EQ(frozen.guard.reason(), EventCode::lost_ticks);
}

/// A driver that hears nothing any more repeats the last positions, and rates computed from them.
TEST(Guard, PositionsThatStopFromOneSampleToTheNextAreFrozen) {
  // Speeds up to 1 rad/s, rolls evenly, stands after so many ticks; how long until the stop.
  const auto roll_and_stand = [](GuardBench& bench, double encoder_step, int braking_ticks) {
    bench.wanted.setConstant(1.0);
    double q = 0.0;
    const auto tick = [&](double rate) {
      q += rate * period;
      bench.sensed.state.qd.setConstant(rate);
      bench.sensed.state.q.setConstant(encoder_step > 0.0 ? std::round(q / encoder_step) * encoder_step : q);
      EXPECT_EQ(bench.admit_after(period), SampleStatus::good);
      bench.guard.output(bench.sensed, bench.wanted, bench.tau);
    };
    for (int i = 1; i <= 100; ++i) tick(0.01 * i);
    for (int i = 0; i < 100; ++i) tick(1.0);
    for (int i = braking_ticks; i > 0; --i) tick(static_cast<double>(i) / (braking_ticks + 1));
    int ticks = 0;
    for (; !bench.guard.stopped() && ticks < 200; ++ticks) tick(0.0);
    return ticks;
  };
  GuardBench dies, hits, coarse, fine;
  EXPECT_EQ(roll_and_stand(dies, 0.0, 0), 20);
  EXPECT_EQ(dies.guard.reason(), EventCode::frozen);
  EXPECT_NEAR(dies.guard.stop_event().value, 1.0, 0.01);
  EXPECT_GE(event_signal::joint_of(dies.guard.stop_event().signal), 0);
  EXPECT_EQ(roll_and_stand(hits, 0.0, 3), 200) << "3 ms is a hard wall: 46 kg on 10 MN/m";
  EXPECT_EQ(roll_and_stand(coarse, 1e-3, 0), 200) << "a hit would look the same";
  EXPECT_EQ(roll_and_stand(fine, 1e-4, 0), 20);
}

TEST(Guard, TheStopIsLatchedUntilAnExplicitReset) {
  GuardBench bench;
  ASSERT_EQ(bench.admit_after(0.0), SampleStatus::good);
  bench.guard.stop(EventCode::requested);
  bench.guard.stop(EventCode::plant);
  EXPECT_EQ(bench.guard.reason(), EventCode::requested);
  bench.wanted.setConstant(5.0);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(bench.admit_after(period), SampleStatus::good);
    EXPECT_EQ(bench.guard.output(bench.sensed, bench.wanted, bench.tau), GuardStatus::stopped);
    EXPECT_TRUE(bench.tau.isZero(0.0));
  }
  bench.guard.reset();
  ASSERT_EQ(bench.admit_after(period), SampleStatus::good);
  EXPECT_EQ(bench.guard.output(bench.sensed, bench.wanted, bench.tau), GuardStatus::passed);
}

TEST(Guard, TheStopBrakesAMovingBaseWithinItsForceToRest) {
  GuardBench bench;
  PlanarBase base;
  base.V = {0.5, 0.2, 0.0};
  bench.guard.stop(EventCode::requested);
  double last_speed = base.V.norm();
  while (base.time < 2.0) {
    base.sense(bench.sensed);
    ASSERT_EQ(bench.guard.admit(bench.sensed), SampleStatus::good);
    bench.guard.output(bench.sensed, bench.wanted, bench.tau);
    // Each wheel presses the ground with at most its share of the stop's 80 N.
    EXPECT_LE(bench.tau.cwiseAbs().maxCoeff(), 80.0 * wheel_radius / 4 + 1e-12);
    base.step(bench.tau);
    EXPECT_LE(base.V.norm(), last_speed + 1e-12) << "at " << base.time;
    last_speed = base.V.norm();
  }
  EXPECT_LT(last_speed, 0.01);
}

TEST(Guard, RefusesSettingsThatCannotGuard) {
  const lang::Robot robot = mecanum_robot();
  EXPECT_THROW(SafetyGuard(robot, {.period = 0.0}), std::invalid_argument);
  EXPECT_THROW(SafetyGuard(robot, {.period = nan}), std::invalid_argument);
  EXPECT_THROW(SafetyGuard(robot, {.max_step = 0.0}), std::invalid_argument);
  EXPECT_THROW(SafetyGuard(robot, {.max_lost_ticks = 0}), std::invalid_argument);
  EXPECT_THROW(SafetyGuard(robot, {.max_slew = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace zwang::runtime
