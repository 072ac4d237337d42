// A wrench from outside that nothing can press with counts as 0, is told, and stops the robot if it goes on.
#include "guard/wrench_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "robots.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

constexpr double whole_mass = body_mass + 4.0 * wheel_mass;
constexpr double at_rest = whole_mass * 9.81 + 4.0 * effort / wheel_radius;  // [N] m g + sum tau_max / r
constexpr double footprint_radius = 0.5;                                     // [m] of the footprint
constexpr int longest = 20;

/// The base stands softly, and feels a wrench at its bumper.
lang::Program felt() {
  lang::Program p = program({task("go", {drive("go.x", Axis::x, Quantity::velocity, 0.0)})});
  lang::Signal feels;
  feels.name = "feels";
  feels.type = lang::SignalType::wrench;
  feels.in = 2;
  feels.stale_after.constant = 1.0;
  p.signals.push_back(feels);
  return p;
}

struct BoundBench {
  BoundBench() { sensed.signals[0].valid = true; }
  std::optional<Event> look() { return bound.look(sensed.state, sensed.signals, time += period); }
  lang::Program program = felt();
  WrenchBound bound{program, period, longest};
  Sensed sensed{program};
  double time = 0.0;
};

TEST(WrenchBound, IsWeightAndMotorsAtRest) {
  BoundBench bench;
  EXPECT_FALSE(bench.look());
  EXPECT_NEAR(bench.bound.force(), at_rest, 1e-9);
  EXPECT_NEAR(bench.bound.moment(), at_rest * footprint_radius, 1e-9);
}

/// 1.5 v sqrt(K m): a hit presses hardest when the base stands already.
TEST(WrenchBound, KnowsTheHitOfTheSpeedThatTheBaseHad) {
  BoundBench bench;
  bench.sensed.state.base_twist.linear = {0.3, 0.4, 0.0};
  bench.look();
  const double hit = 1.5 * 0.5 * std::sqrt(1e6 * whole_mass);
  EXPECT_NEAR(bench.bound.force(), at_rest + hit, 1e-6);
  bench.sensed.state.base_twist = {};
  // pi/2 sqrt(m / K) until the largest force, on 2 kN/m.
  const double compresses = 0.5 * M_PI * std::sqrt(whole_mass / 2e3);
  for (double t = 0.0; t < compresses; t += period) bench.look();
  EXPECT_GT(bench.bound.force(), at_rest + 0.5 * std::sqrt(2e3 * whole_mass)) << "what that hit presses with";
  for (int i = 0; i < 5000; ++i) bench.look();
  EXPECT_NEAR(bench.bound.force(), at_rest, 1.0) << "forgotten";
}

TEST(WrenchBound, RefusesWhatIsBeyondItAndNothingElse) {
  const std::function<solver::ForceVector&(Sensed&)> places[] = {
      [](Sensed& s) -> solver::ForceVector& { return s.state.f_ext[0]; },
      [](Sensed& s) -> solver::ForceVector& { return s.state.f_ext[3]; },
      [](Sensed& s) -> solver::ForceVector& { return s.signals[0].wrench; }};
  for (const auto& place : places) {
    for (const double share : {0.99, 1.01, 1e3}) {
      BoundBench force, moment;
      place(force.sensed).linear = share * at_rest * solver::Vector3(0.6, 0.0, 0.8);
      place(moment.sensed).angular.z() = -share * at_rest * footprint_radius;
      for (BoundBench* bench : {&force, &moment}) {
        const auto told = bench->look();
        EXPECT_EQ(told.has_value(), share > 1.0) << share;
        EXPECT_EQ(place(bench->sensed).is_zero(), share > 1.0) << share;
        if (told) {
          EXPECT_EQ(told->code, EventCode::wrench_impossible);
        }
      }
    }
  }
}

/// Told when it begins; twenty ticks of it are a stop.
TEST(WrenchBound, StopsTheRobotWhenItGoesOn) {
  for (const int ticks : {19, 20}) {
    const lang::Program p = felt();
    Runner runner(p), undisturbed(p);
    Sensed sensed(p), quiet(p);
    PlanarBase base;
    for (int i = 0; i < 100; ++i) {
      base.sense(sensed);
      base.sense(quiet);
      const bool is_broken = i >= 50 && i < 50 + ticks;
      sensed.state.f_ext[0].linear.x() = is_broken ? -5e4 : 0.0;
      const Eigen::VectorXd tau = runner.step(sensed);
      EXPECT_EQ(tau, undisturbed.step(quiet)) << "it counts as 0, and the base stands";
      base.step(tau);
    }
    EXPECT_EQ(runner.guard().stopped(), ticks == 20);
    ASSERT_GE(runner.event_count(), 1U);
    const Event& told = runner.events()[0];
    EXPECT_EQ(told.code, EventCode::wrench_impossible);
    EXPECT_EQ(runner.event_signal(told), "base_link.f_ext");
    EXPECT_EQ(told.value, 5e4);
    EXPECT_NEAR(told.time, 0.05, 1e-9);
    if (ticks == 20) {
      EXPECT_EQ(runner.guard().reason(), EventCode::wrench_impossible);
    }
    EXPECT_EQ(runner.event_count(), ticks == 20 ? 3U : 1U);
  }
}

}  // namespace
}  // namespace zwang::runtime
