// The samples' clock steps back or ahead, stands, or runs at another rate. The base comes to rest with the
// samples that it still gets. The event names the cause.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "constants.hpp"
#include "guard/clock_rate.hpp"
#include "shipped_program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

using zwang::test::shipped_program;

constexpr double begin = 1.5;  // [s] at 0.5 m/s
constexpr int calls = 1000;    // from then on

struct Clock {
  const char* name;
  std::function<double(double)> stamp;  ///< of the time since `begin`, both [s]
  EventCode reason;
  double value;  ///< of the stop's event
};

const Clock clocks[] = {
    {"back by 2 s", [](double t) { return t - 2.0; }, EventCode::clock_back, -2.0},
    {"back by 10 s", [](double t) { return t - 10.0; }, EventCode::clock_back, -10.0},
    {"back by 2 s, and stands", [](double) { return -2.0; }, EventCode::clock_back, -2.0},
    {"ever farther back", [](double t) { return -t; }, EventCode::clock_back, -0.02},
    {"ahead by 50 ms", [](double t) { return t + 0.05; }, EventCode::lost_ticks, 0.05},
    {"ahead by 10 s", [](double t) { return t + 10.0; }, EventCode::lost_ticks, 10.0},
    {"at half the rate", [](double t) { return 0.5 * t; }, EventCode::clock_rate, 0.5},
    {"at twice the rate", [](double t) { return 2.0 * t; }, EventCode::clock_rate, 2.0},
    {"at four times the rate", [](double t) { return 4.0 * t; }, EventCode::clock_rate, 4.0},
    {"standing", [](double) { return 0.0; }, EventCode::clock_stands, 0.0},
    {"not a number", [](double) { return std::nan(""); }, EventCode::bad_sample, std::nan("")},
};

#ifdef ZWANG_SANITIZED  // on the others it is the same code with other numbers
const char* const clocked_robots[] = {"mecanum"};
#else
const char* const clocked_robots[] = {"mecanum", "omni", "diff", "kelo"};
#endif

struct Loop {
  explicit Loop(const lang::Program& loaded)
      : program(loaded),
        plant(program),
        runner(program, {.period = period}),
        sensed(program.robot.model, program.signals.size()) {}
  void step(const std::function<double(double)>& stamp) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    const double time = sensed.time;
    sensed.time = stamp(time);
    ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
  }
  double speed() const { return plant.truth().velocity.head<2>().norm(); }
  lang::Program program;
  ScenePlant plant;
  Runner runner;
  Sensed sensed;
};

double as_it_is(double time) {
  return time;
}

/// The brake takes v / (F / m), 0.3 to 0.7 s from 0.5 m/s. The 1000 periods are for both, the detection and
/// the brake. Two active casters still roll at 2.5 cm/s then, whatever the reason of the stop:
/// docs/limits.md.
TEST(Clock, ThatIsWrongStopsTheBaseWhichStandsWithinAThousandCalls) {
  for (const char* robot : clocked_robots) {
    for (const Clock& clock : clocks) {
      Loop loop(shipped_program("laws/straight_on.yaml", robot));
      while (loop.plant.truth().time < begin - 0.5 * period) loop.step(as_it_is);
      ASSERT_GT(loop.speed(), 0.4);
      for (int i = 0; i < calls; ++i)
        loop.step([&](double time) { return begin - period + clock.stamp(time + period - begin); });
      const Event& stop = loop.runner.guard().stop_event();
      std::printf("%s, %s: %s, %.3g after %.0f ms, %.4f m/s at the end\n", robot, clock.name,
                  to_string(stop.code), stop.value, 1e3 * (stop.time - begin), loop.speed());
      EXPECT_TRUE(loop.runner.finished()) << robot << ", " << clock.name;
      EXPECT_EQ(stop.code, clock.reason) << robot << ", " << clock.name;
      EXPECT_EQ(loop.runner.event_signal(stop), "time");
      if (!std::isnan(clock.value)) {
        EXPECT_NEAR(stop.value, clock.value, 0.03) << robot << ", " << clock.name;
      }
      EXPECT_LT(loop.speed(), 0.01) << robot << ", " << clock.name;
    }
  }
}

/// After a reset all that remembers a time goes on: the clock went back, the runner's time does not.
TEST(Clock, ThatWentBackIsTheRunnersClockAfterAReset) {
  Loop loop(shipped_program("laws/straight_on.yaml", "mecanum"));
  while (loop.plant.truth().time < begin) loop.step(as_it_is);
  const auto back = [](double time) { return time - 10.0; };
  for (int i = 0; i < calls; ++i) loop.step(back);
  ASSERT_TRUE(loop.runner.finished());
  const double stopped = loop.runner.guard().time();
  EXPECT_GT(stopped, begin) << "while it brakes, too";
  loop.runner.guard().reset();
  for (int i = 0; i < calls; ++i) loop.step(back);
  EXPECT_EQ(loop.runner.state(), RunState::running);
  EXPECT_NEAR(loop.runner.guard().time(), stopped + calls * period, 0.5 * period);
  EXPECT_GT(loop.speed(), 0.3);
}

/// A clock that is off by a fifth makes every rate wrong by as much. It is told, once, and no stop.
TEST(Clock, ThatDriftsIsTold) {
  for (const double rate : {0.8, 1.25}) {
    Loop loop(shipped_program("laws/straight_on.yaml", "mecanum"));
    for (int i = 0; i < 2 * calls; ++i) loop.step([rate](double time) { return rate * time; });
    EXPECT_EQ(loop.runner.state(), RunState::running);
    ASSERT_EQ(loop.runner.event_count(), 1U) << rate;
    EXPECT_EQ(loop.runner.events()[0].code, EventCode::clock_drift);
    EXPECT_NEAR(loop.runner.events()[0].value, rate, 1e-3);
    EXPECT_LE(loop.runner.events()[0].time, rate * (ClockRate::window + period));
  }
}

/// What the host has seen is an event of the next step, and no stop.
TEST(Clock, OfAHostThatWasLateIsTold) {
  Loop loop(shipped_program("laws/straight_on.yaml", "mecanum"));
  loop.step(as_it_is);
  loop.runner.tell(EventCode::overrun, event_signal::time, 0.012);
  loop.runner.tell(EventCode::watchdog);  // that is for SafetyGuard::stop
  EXPECT_EQ(loop.runner.event_count(), 0U);
  loop.step(as_it_is);
  loop.step(as_it_is);
  ASSERT_EQ(loop.runner.event_count(), 1U);
  EXPECT_EQ(loop.runner.events()[0].code, EventCode::overrun);
  EXPECT_NEAR(loop.runner.events()[0].time, period, 1e-9);
  EXPECT_EQ(loop.runner.events()[0].value, 0.012);
  EXPECT_EQ(loop.runner.event_signal(loop.runner.events()[0]), "time");
  EXPECT_EQ(loop.runner.state(), RunState::running);
}

/// Jitter by less than half a period, steps of 4 ms, and samples that stay away are no other rate.
TEST(Clock, ThatIsUnevenIsOfNoOtherRate) {
  ClockRate jittering(period), coarse(period), losing(period), early(period);
  unsigned state = 1;
  for (int i = 0; i < 3000; ++i) {
    state = 1664525U * state + 1013904223U;
    const double noise = static_cast<double>(state >> 8) / (1 << 24) - 0.5;  // [-0.5, 0.5]
    const double time = i * period;
    EXPECT_FALSE(jittering.look(time + 0.49 * period * noise));
    EXPECT_FALSE(coarse.look(4.0 * period * std::floor(time / (4.0 * period))));
    EXPECT_FALSE(losing.look(i % 50 < 19 ? (i - i % 50) * period : time));
    EXPECT_FALSE(early.look(i % 2 == 0 ? time : time - 0.6 * period)) << "pairs of samples";
  }
  EXPECT_FALSE(jittering.is_off() || coarse.is_off() || losing.is_off() || early.is_off());
}

}  // namespace
}  // namespace zwang::runtime
