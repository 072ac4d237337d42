// The shipped task files on a base with ideal wheels and exact sensors, with scripted signals. The base's own
// motion and the forces at its contacts are checked against the promises of the language.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <stdexcept>

#include "../is_long.hpp"
#include "../solver/malloc_counter.hpp"
#include "../temporary_folder.hpp"
#include "robots.hpp"
#include "shipped_case.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

/// A stiff face that looks along -x at `x`: springs at the corners of the footprint.
struct Face {
  double x;
  double stiffness;
  double damping_ratio = 0.3;
  double force = 0.0;  ///< [N] now
  double peak = 0.0;
  std::optional<double> touched;

  Eigen::Vector3d press(const Case& run) {
    Eigen::Vector3d total = Eigen::Vector3d::Zero();
    const Eigen::Rotation2Dd R(run.base.pose.z());
    const double k = stiffness / 2,
                 d = 2 * damping_ratio * std::sqrt(stiffness * run.base.inertia()(0, 0)) / 2;
    for (const solver::Vector3& corner : run.program.robot.footprint) {
      const Eigen::Vector2d c = corner.head<2>();
      const double depth = (run.base.pose.head<2>() + R * c).x() - x;
      if (depth <= 0.0) continue;
      const Eigen::Vector2d v = run.base.V.head<2>() + run.base.V.z() * Eigen::Vector2d(-c.y(), c.x());
      const double f = std::max(0.0, k * depth + d * (R * v).x());
      const Eigen::Vector2d local = R.inverse() * Eigen::Vector2d(-f, 0.0);
      total += Eigen::Vector3d(local.x(), local.y(), c.x() * local.y() - c.y() * local.x());
      if (!touched) touched = run.base.time;
    }
    force = (R * total.head<2>()).norm();
    peak = std::max(peak, force);
    return total;
  }
};

TEST(Obstacle, IsMetGentlyAndTheRunFailsAfterThreeAttempts) {
  Case run(load_shipped("obstacle.yaml"));
  Face crate{2.4, 1e5};
  std::vector<double> contact_times, reaction;
  double v_at_contact = 0.0;
  std::size_t hits = 0;
  bool touching = false;
  run.contact = [&] {
    const double v = run.base.V.x();
    const Eigen::Vector3d f = crate.press(run);
    if (crate.force > 0.0 && !touching && run.task() == "drive") {
      touching = true;
      ++hits;
      contact_times.push_back(run.base.time);
      v_at_contact = std::max(v_at_contact, v);
    }
    if (run.task() != "drive") touching = false;
    return f;
  };
  run.look = [&] {
    const auto& t = run.runner.scheduler().transition();
    if (t && run.task() == "yield") reaction.push_back(run.base.time - contact_times.back());
  };
  run.run(120.0);
  EXPECT_EQ(run.runner.state(), RunState::failed);
  EXPECT_EQ(hits, 4u) << run.way();
  EXPECT_EQ(run.runner.transitions().back().refusal, Refusal::attempts);
  EXPECT_EQ(run.runner.scheduler().why(run.runner.transitions().back()).find("abs(back.x.position"), 0u);
  const double m = run.base.inertia()(0, 0);
  const double F = 40.0;
  std::printf("obstacle: peak %.1f N of %.1f N, approach %.3f m/s, reaction %.0f ms, step %.2f N, %s\n",
              crate.peak, F + std::sqrt(F * F + 1e5 * m * v_at_contact * v_at_contact), v_at_contact,
              1e3 * reaction.front(), run.largest_step, run.way().c_str());
  EXPECT_LE(crate.peak, F + std::sqrt(F * F + 1e5 * m * v_at_contact * v_at_contact));
  EXPECT_LE(v_at_contact, 0.15 * 1.001) << "the velocity limit";
  EXPECT_LT(reaction.front(), 0.040) << "under way, found without a sensor";
  EXPECT_LT(*std::max_element(reaction.begin(), reaction.end()), 1.0) << "after a start of 20 cm";
}

TEST(Obstacle, ThatGoesAwayLetsTheRobotReachItsGoal) {
  Case run(load_shipped("obstacle.yaml", {{"cruise", "0.40 m/s"}}));
  Face crate{2.4, 1e4};
  int yields = 0;
  run.contact = [&]() -> Eigen::Vector3d {
    if (yields >= 2) return Eigen::Vector3d::Zero();
    return crate.press(run);
  };
  run.look = [&] {
    if (run.runner.scheduler().transition() && run.task() == "yield") ++yields;
  };
  run.run(120.0);
  EXPECT_EQ(run.runner.state(), RunState::done) << run.way();
  EXPECT_EQ(yields, 2);
  EXPECT_NEAR(run.base.pose.x(), 6.0, 0.02 + 1e-3);
}

struct HospitalRun : Case {
  explicit HospitalRun(lang::Program p = load_shipped("hospital.yaml")) : Case(std::move(p)) {
    script = [this] {
      if (task() == "load" || task() == "unload") {
        if (stop_began < 0.0) stop_began = base.time;
      } else {
        stop_began = -1.0;
      }
      const bool attended = stop_began >= 0.0 && base.time - stop_began > 2.0;
      if (attended) loaded = task() == "load";
      hear_boolean("loaded", loaded);
      if (scanner) hear_number("nearest", nearest(base.time));
      hear_boolean("stop_key", stop_key);
    };
    look = [this] {
      const Eigen::Rotation2Dd R(base.pose.z());
      for (const solver::Vector3& corner : program.robot.footprint) {
        const Eigen::Vector2d c = base.pose.head<2>() + R * Eigen::Vector2d(corner.head<2>());
        least_left = std::min({least_left, c.x() - 0.1, 17.9 - c.x(), c.y() + 1.1, 1.1 - c.y()});
      }
      fastest = std::max(fastest, base.V.head<2>().norm());
      also();
    };
  }
  std::function<double(double)> nearest = [](double) { return 5.0; };
  std::function<void()> also = [] {};
  bool scanner = true, stop_key = false, loaded = false;
  double stop_began = -1.0;
  double least_left = 10.0, fastest = 0.0;
};

TEST(Hospital, VisitsItsStopsInsideTheCorridorAndWithinItsSpeed) {
  HospitalRun run;
  double hardest = 0.0;
  run.also = [&] {
    hardest =
        std::max(hardest, run.base.commanded(run.runner.solution().tau).head<2>().cwiseAbs().maxCoeff());
  };
  run.run(200.0);
  EXPECT_EQ(run.runner.state(), RunState::done);
  EXPECT_EQ(run.way(), "to_pharmacy -> load -> to_door -> through_door -> unload -> done");
  std::printf("hospital: %.1f s, left %.3f mm, fastest %.5f m/s, hardest %.2f N, step %.2f N\n",
              run.base.time, 1e3 * run.least_left, run.fastest, hardest, run.largest_step);
  EXPECT_GT(run.least_left, -1e-4);
  EXPECT_LT(run.fastest, 0.6 * 1.001);
  EXPECT_GT(run.fastest, 0.59);
  EXPECT_LT(hardest, 80.0 + 1e-6) << "`soft` is for the whole robot";
}

TEST(Hospital, APersonTooCloseInterruptsAndTheTaskIsResumed) {
  HospitalRun run;
  // 0.5 m for two seconds, then between threshold and release for three, then gone.
  run.nearest = [](double t) { return t < 20.0 || t > 25.0 ? 5.0 : t < 22.0 ? 0.5 : 1.0; };
  std::optional<double> paused, resumed, stood;
  run.also = [&] {
    const auto& t = run.runner.scheduler().transition();
    if (t && run.task() == "pause") paused = run.base.time - period;
    if (t && t->resumes) resumed = run.base.time - period;
    if (paused && !stood && run.base.V.norm() < 0.01) stood = run.base.time;
  };
  run.run(200.0);
  EXPECT_EQ(run.runner.state(), RunState::done);
  ASSERT_TRUE(paused && resumed && stood);
  EXPECT_NEAR(*paused, 20.0 + 0.1, 2 * period) << "for: 0.1 s";
  EXPECT_NEAR(*resumed, 25.0 + 1.0, 2 * period) << "held by `release`, then for: 1 s";
  EXPECT_LT(*stood - *paused, 3.0);
  EXPECT_NE(run.way().find("-> pause -> "), std::string::npos);
  std::printf("hospital, person: stood after %.2f s, step %.2f N, %s\n", *stood - *paused, run.largest_step,
              run.way().c_str());
}

TEST(Hospital, ALostScannerStopsTheRobotAtOnceAndALostStopKeyFails) {
  HospitalRun scanner;
  scanner.also = [&] { scanner.scanner = scanner.base.time < 20.0; };
  scanner.run(21.0);
  EXPECT_EQ(scanner.task(), "pause");
  const Transition& t = scanner.runner.transitions().back();
  EXPECT_EQ(t.cause, Cause::always);
  EXPECT_NEAR(t.time, 20.0 + 0.2, 2 * period) << "stale_after 200 ms, and no waiting for `for`";

  HospitalRun key;
  key.also = [&] { key.stop_key = key.base.time > 20.0; };
  key.run(40.0);
  EXPECT_EQ(key.runner.state(), RunState::failed);
  EXPECT_LT(key.base.time, 23.0);
}

TEST(Hospital, ADriverThatWantsOutIsHeldAtTheBoundaryWhichIsNamed) {
  lang::Program p = load_shipped("hospital.yaml");
  for (lang::FrameDeclaration& f : p.frames) {
    if (f.name == "pharmacy") f.pose.position = {3.0, 2.0, 0.0};
  }
  HospitalRun run(p);
  run.run(15.0);
  std::printf("hospital, outside: left %.4f mm\n", 1e3 * run.least_left);
  EXPECT_GT(run.least_left, -1e-4);
  EXPECT_LT(run.least_left, 1e-3);
  const auto shortfall = run.runner.shortfall();
  ASSERT_TRUE(shortfall.has_value());
  // The pharmacy's x is the corridor's y. To come nearer, the base also gives up its heading, which has
  // level 2.
  EXPECT_TRUE(shortfall->row == "to_pharmacy.go.x" || shortfall->row == "to_pharmacy.go.rz")
      << shortfall->row;
  ASSERT_FALSE(shortfall->held_back_by.empty());
  EXPECT_EQ(shortfall->held_back_by[0], "always.boundary.edge3");
}

TEST(Tick, MakesNoHeapCallWithSignalsRegionsAndInterruptions) {
  if (!zwang::test::can_count_heap_calls()) GTEST_SKIP() << "a sanitizer owns malloc";
  const zwang::test::TemporaryFolder folder;
  const auto path = folder.path() / "heap.csv";
  long calls = 0;
  std::uint64_t ticks = 0;
  // A million ticks when asked for: round after round of the same task file.
  const std::uint64_t wanted = zwang::test::is_long() ? 1'000'000 : 30'000;
  while (ticks < wanted) {
    HospitalRun round;
    round.nearest = [](double t) { return t < 10.0 || t > 12.0 ? 5.0 : 0.5; };
    Recorder recorder(path, round.runner.columns());
    round.runner.record_to(&recorder);
    while (!round.runner.finished() && ticks < wanted) {
      round.base.sense(round.sensed);
      round.script();
      zwang::test::start_counting_heap_calls();
      const Eigen::VectorXd& tau = round.runner.step(round.sensed);
      calls += zwang::test::stop_counting_heap_calls();
      round.base.step(tau);
      ++ticks;
    }
  }
  EXPECT_EQ(calls, 0);
}

TEST(Switches, StepTheTorqueByNoMoreThanTheirShareOfWhatFades) {
  // Without blending the same run steps harder.
  HospitalRun smooth;
  smooth.nearest = [](double t) { return t < 20.0 || t > 22.0 ? 5.0 : 0.5; };
  lang::Program p = load_shipped("hospital.yaml");
  for (lang::Task& t : p.tasks) t.blend.constant = 0.0;
  HospitalRun hard(p);
  hard.nearest = smooth.nearest;
  smooth.run(40.0);
  hard.run(40.0);
  // Most that fades at once: a driver and what opposes it on each planar axis, each within the range of 60 N.
  const double fades = std::hypot(2 * 60.0, 2 * 60.0);
  std::printf("switches: %.2f N a tick blended, %.2f N hard\n", smooth.largest_step, hard.largest_step);
  EXPECT_LE(smooth.largest_step, period / 0.2 * fades);
  EXPECT_GT(hard.largest_step, 3.0 * smooth.largest_step);
}

}  // namespace
}  // namespace zwang::runtime
