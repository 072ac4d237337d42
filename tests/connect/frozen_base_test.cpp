// A base whose odometry is stuck. The wheels of a mecanum base that rolls ahead turn by v / R each.
#include "frozen_base.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "../solver/robots.hpp"

namespace zwang::connect {
namespace {

constexpr double tick = 0.01, stale_after = 0.1;  // [s]
constexpr double odometry_period = 0.05;          // [s]
const solver::test::MecanumFigures figures;

/// x [m] and speed [m/s] of a base that has stood for a second and then drives at v, at 1 m/s^2.
struct Ride {
  double v = 0.4;

  double since_start(double time) const { return std::max(0.0, time - 1.0); }
  double speed(double time) const { return std::min(v, since_start(time)); }
  double way(double time) const {
    const double t = since_start(time);
    return t < v ? 0.5 * t * t : v * t - 0.5 * v * v;
  }
};

BaseSample live_sample(const Ride& ride, double stamp, double lateness = 0.0) {
  BaseSample sample;
  sample.stamp = stamp;
  sample.arrival = stamp + lateness;
  sample.pose.position.x() = ride.way(stamp);
  sample.twist.linear.x() = ride.speed(stamp);
  return sample;
}

struct Found {
  double time = 0.0, contradiction = 0.0;
};

/// Drives for `seconds`. `measured` gives the sample of the odometry that was made at a stamp.
std::optional<Found> drive(FrozenBase& watch, const Ride& ride, double seconds,
                           const std::function<BaseSample(double)>& measured, double lateness = 0.0) {
  for (int i = 1; i * tick < seconds; ++i) {
    const double time = i * tick;
    const double stamp = std::floor((time - lateness) / odometry_period + 1e-9) * odometry_period;
    const Eigen::VectorXd q = Eigen::VectorXd::Constant(4, ride.way(time) / figures.radius);
    const Eigen::VectorXd qd = Eigen::VectorXd::Constant(4, ride.speed(time) / figures.radius);
    if (const auto found = watch.look(measured(std::max(0.0, stamp)), q, qd, time))
      return Found{time, *found};
  }
  return std::nullopt;
}

class StuckOdometry : public testing::TestWithParam<double> {
 protected:
  StuckOdometry() : watch(solver::test::mecanum(figures), stale_after), ride{GetParam()} {}

  /// The wheels may carry the base on by `least_way`, and at its speed for the patience and two ticks.
  void expect_found_in_time(const std::optional<Found>& found, double stuck_since) const {
    ASSERT_TRUE(found);
    const double patience = std::max(stale_after, 3.0 * odometry_period);
    EXPECT_LE(ride.way(found->time) - ride.way(stuck_since),
              FrozenBase::least_way + ride.v * (patience + odometry_period + 2.0 * tick));
  }

  FrozenBase watch;
  Ride ride;
};

TEST_P(StuckOdometry, ThatRepeatsOneMessageIsFound) {
  const auto found = drive(watch, ride, 20.0, [&](double stamp) {
    BaseSample sample = live_sample(ride, std::min(stamp, 1.5));
    sample.arrival = stamp;
    return sample;
  });
  expect_found_in_time(found, 1.5);
}

TEST_P(StuckOdometry, ThatStampsItAnewIsFound) {
  const auto found = drive(watch, ride, 20.0, [&](double stamp) {
    BaseSample sample = live_sample(ride, std::min(stamp, 1.5));
    sample.stamp = sample.arrival = stamp;
    return sample;
  });
  expect_found_in_time(found, 1.5);
}

TEST_P(StuckOdometry, ThatFallsSilentIsFound) {
  const auto found =
      drive(watch, ride, 20.0, [&](double stamp) { return live_sample(ride, std::min(stamp, 1.5)); });
  expect_found_in_time(found, 1.5);
}

TEST_P(StuckOdometry, WhoseTwistAloneIsStuckIsFound) {
  const auto found = drive(watch, ride, 20.0, [&](double stamp) {
    BaseSample sample = live_sample(ride, stamp);
    sample.twist = {};
    return sample;
  });
  const bool is_fast = ride.v > FrozenBase::least_change;
  ASSERT_EQ(found.has_value(), is_fast);  // a robot that is slower than that loses little by it
  if (is_fast) {
    EXPECT_LE(ride.since_start(found->time), FrozenBase::least_change + 3.0 * odometry_period + 2.0 * tick);
  }
}

TEST_P(StuckOdometry, IsNotOneThatLives) {
  EXPECT_FALSE(drive(watch, ride, 20.0, [&](double stamp) { return live_sample(ride, stamp); }));
}

TEST_P(StuckOdometry, IsNotOneThatIsLate) {
  constexpr double late = 0.2;
  EXPECT_FALSE(drive(
      watch, ride, 20.0, [&](double stamp) { return live_sample(ride, stamp, late); }, late));
}

TEST_P(StuckOdometry, IsNotOneOfCoarseSteps) {
  EXPECT_FALSE(drive(watch, ride, 20.0, [&](double stamp) {
    BaseSample sample = live_sample(ride, stamp);
    sample.pose.position.x() = std::floor(sample.pose.position.x() / 5e-3) * 5e-3;
    sample.twist.linear.x() = std::floor(sample.twist.linear.x() / 0.02) * 0.02;
    return sample;
  }));
}

INSTANTIATE_TEST_SUITE_P(At, StuckOdometry, testing::Values(0.02, 0.4, 1.5));

TEST(StuckOdometry, InATurnIsFoundByTheFarthestPoint) {
  FrozenBase watch(solver::test::mecanum(figures), stale_after);
  const double rate = 0.5, reach = figures.lx + figures.ly;  // [rad/s], [m]
  const Eigen::Vector4d sides(-1.0, 1.0, -1.0, 1.0);
  std::optional<double> found;
  double time = 0.0;
  for (; !found && time < 5.0; time += tick) {
    BaseSample sample;
    sample.arrival = std::floor(time / odometry_period) * odometry_period;
    const Eigen::VectorXd qd = sides * (rate * reach / figures.radius);
    found = watch.look(sample, qd * time, qd, time);
  }
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, FrozenBase::lever * rate * (time - tick), 1e-9);
}

TEST(StuckOdometry, OfABaseThatStandsIsNoFault) {
  FrozenBase watch(solver::test::mecanum(figures), stale_after);
  for (int i = 0; i < 10'000; ++i) {
    // One step of 4096 to and fro, as an encoder at rest between two of them.
    const double step = 2.0 * M_PI / 4096.0 * (i % 2);
    const Eigen::VectorXd q = Eigen::VectorXd::Constant(4, step);
    const Eigen::VectorXd qd = Eigen::VectorXd::Constant(4, i % 2 == 0 ? -0.1 : 0.1);
    BaseSample sample;
    sample.arrival = i * tick;
    ASSERT_FALSE(watch.look(sample, q, qd, i * tick));
  }
}

}  // namespace
}  // namespace zwang::connect
