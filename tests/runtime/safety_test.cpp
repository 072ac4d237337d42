// Faults of samples, motors, floor and plant while a task runs: what must happen, and by when. On every tick
// each torque is finite and within its limit, and after a latched stop nothing moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "constants.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"
#include "zwang/runtime/watchdog.hpp"

namespace zwang::runtime {
namespace {

using lang::FaultKind;

constexpr double begin = 2.0;  // [s] under way to the wall, at 0.08 m/s

struct Injected {
  const char* name;
  FaultKind kind;
  double duration;  // [s]
  const char* joint = "";
  double value = 0.0;
  EventCode reason = EventCode::none;  ///< none: the run goes on
  int deadline = 0;                    ///< ticks from the begin to the stop
};

void PrintTo(const Injected& injected, std::ostream* out) {
  *out << injected.name;
}

const lang::Program& program() {
  static const lang::Program loaded = [] {
    lang::Diagnostics diagnostics;
    lang::LoadOptions options;
    options.scene = ZWANG_SOURCE_DIR "/specs/scenes/wall_far.yaml";
    auto read = lang::load(ZWANG_SOURCE_DIR "/specs/wall_align.yaml", options, diagnostics);
    if (!read) throw std::runtime_error("specs/wall_align.yaml does not load");
    return *read;
  }();
  return loaded;
}

struct Observed {
  int ticks_to_stop = -1;
  double worst_share = 0.0;  ///< of a torque's limit
  double worst_step = 0.0;   ///< of a torque in a tick, of what its slew allows
  bool always_finite = true;
  double speed_at_end = 0.0, moved_after_rest = 0.0;
  PlantStatus status = PlantStatus::ok;
};

Observed run_with(const Injected& injected, Runner& runner) {
  ScenePlantOptions options;
  options.simulation.start_yaw = 0.0;
  options.faults.push_back(lang::Fault{.kind = injected.kind,
                                       .at = begin,
                                       .duration = injected.duration,
                                       .joint = injected.joint,
                                       .value = injected.value});
  ScenePlant plant(program(), options);
  Sensed sensed(program().robot.model, program().signals.size());
  Observed observed;
  double x_at_rest = 0.0;
  const Eigen::VectorXd most = period * program().robot.slew;
  Eigen::VectorXd last = Eigen::VectorXd::Zero(most.size());
  bool stood = false;
  // Two seconds behind the fault; the brake from 0.08 m/s takes a tenth.
  for (int i = 0; i < 4000; ++i) {
    observed.status = plant.sense(sensed);
    if (observed.status == PlantStatus::diverged) break;
    const bool was_stopped = runner.guard().stopped();
    const Eigen::VectorXd& tau = runner.step(sensed);
    const int since = i - static_cast<int>(std::lround(begin / period));
    if (runner.guard().stopped() && !was_stopped) observed.ticks_to_stop = since;
    observed.worst_step =
        std::max(observed.worst_step, ((tau - last).cwiseAbs().cwiseQuotient(most)).maxCoeff());
    last = tau;
    for (Eigen::Index j = 0; j < tau.size(); ++j) {
      observed.always_finite = observed.always_finite && std::isfinite(tau(j));
      observed.worst_share =
          std::max(observed.worst_share,
                   std::abs(tau(j)) / program().robot.model.joint(static_cast<int>(j)).max_effort);
    }
    observed.status = plant.apply(tau);
    if (observed.status != PlantStatus::ok) break;
    const Truth& truth = plant.truth();
    if (!runner.guard().stopped()) continue;
    if (!stood && truth.velocity.head<2>().norm() < 0.005) {
      stood = true;
      x_at_rest = truth.x;
    }
    if (stood) observed.moved_after_rest = std::max(observed.moved_after_rest, std::abs(truth.x - x_at_rest));
  }
  observed.speed_at_end = plant.truth().velocity.head<2>().norm();
  return observed;
}

class SafetyUnder : public testing::TestWithParam<Injected> {};

TEST_P(SafetyUnder, AFault) {
  const Injected& injected = GetParam();
  Runner runner(program(), {.period = period});
  const Observed observed = run_with(injected, runner);
  std::printf(
      "%s: %s after %d ticks, torque at most %.0f %% of its limit and %.0f %% of its slew, %.1f mm moved "
      "after rest\n",
      injected.name, describe(runner.guard().reason()), observed.ticks_to_stop, 100.0 * observed.worst_share,
      100.0 * observed.worst_step, 1e3 * observed.moved_after_rest);
  EXPECT_TRUE(observed.always_finite);
  EXPECT_LE(observed.worst_share, 1.0 + 1e-12);
  EXPECT_LE(observed.worst_step, 1.0 + 1e-9);
  EXPECT_EQ(runner.guard().reason(), injected.reason) << describe(runner.guard().reason());
  if (injected.reason == EventCode::none) {
    EXPECT_EQ(runner.state(), RunState::running);
    return;
  }
  EXPECT_GE(observed.ticks_to_stop, 0);
  EXPECT_LE(observed.ticks_to_stop, injected.deadline);
  EXPECT_LT(observed.speed_at_end, 0.01);
  EXPECT_LT(observed.moved_after_rest, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Injected, SafetyUnder,
    testing::Values(
        Injected{"nan for one sample", FaultKind::samples_nan, 0.001, "", 0.0, EventCode::bad_sample, 0},
        Injected{"infinity for one sample", FaultKind::samples_inf, 0.001, "", 0.0, EventCode::bad_sample, 0},
        Injected{"1e300 for one sample", FaultKind::samples_huge, 0.001, "", 0.0, EventCode::bad_sample, 0},
        Injected{"4 samples lost", FaultKind::samples_lost, 0.004},
        Injected{"19 samples lost", FaultKind::samples_lost, 0.019},
        Injected{"100 samples lost", FaultKind::samples_lost, 0.100, "", 0.0, EventCode::lost_ticks, 20},
        Injected{"frozen for 10 ms", FaultKind::samples_frozen, 0.010},
        Injected{"frozen for 200 ms", FaultKind::samples_frozen, 0.200, "", 0.0, EventCode::frozen, 20},
        Injected{"clock backwards for 5 ms", FaultKind::clock_backwards, 0.005},
        Injected{"clock backwards", FaultKind::clock_backwards, 0.100, "", 0.0, EventCode::clock_back, 20},
        Injected{"floor of ice for 1 s", FaultKind::floor_friction, 1.0, "", 0.05},
        Injected{"23 kg of payload", FaultKind::payload, 10.0, "", 23.0},
        Injected{"23 kg less", FaultKind::payload, 10.0, "", -23.0}),
    [](const auto& tested) {
      std::string name;
      for (const char c : std::string(tested.param.name))
        name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
      return name;
    });

TEST(Safety, ADivergedPlantEndsTheRunOnTheSameTick) {
  Runner runner(program(), {.period = period});
  const Observed observed = run_with({"diverged", FaultKind::plant_diverges, 1.0}, runner);
  EXPECT_EQ(observed.status, PlantStatus::diverged);
  EXPECT_TRUE(observed.always_finite);
}

// A control thread that is blocked for 200 ms: the watchdog has called by then.
TEST(Watchdog, CallsWhenItIsNoLongerFed) {
  using Clock = std::chrono::steady_clock;
  std::atomic<int> calls{0};
  std::atomic<Clock::rep> called_at{0};
  Watchdog watchdog(0.1, [&] {
    called_at = Clock::now().time_since_epoch().count();
    ++calls;
    throw std::runtime_error("the host's mistake");
  });
  for (int i = 0; i < 50; ++i) {
    watchdog.feed();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_FALSE(watchdog.expired()) << "fed for 250 ms";
  watchdog.feed();
  const auto fed_last = Clock::now();
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  EXPECT_TRUE(watchdog.expired());
  EXPECT_EQ(calls, 1) << "once, whatever the callback does";
  const double after =
      std::chrono::duration<double>(Clock::time_point(Clock::duration(called_at.load())) - fed_last).count();
  std::printf("watchdog: called %.0f ms after it was fed last\n", 1e3 * after);
  EXPECT_GE(after, 0.099);
  EXPECT_LE(after, 0.2);
  watchdog.feed();
  EXPECT_TRUE(watchdog.expired()) << "latched";
}

TEST(Watchdog, LimitsMustBePositive) {
  EXPECT_THROW(Watchdog(0.0, [] {}), std::invalid_argument);
  EXPECT_THROW(Watchdog(std::nan(""), [] {}), std::invalid_argument);
}

}  // namespace
}  // namespace zwang::runtime
