#include "zwang/runtime/runner.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "../solver/malloc_counter.hpp"
#include "../temporary_folder.hpp"
#include "robots.hpp"
#include "runner_loop.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

TEST(Runner, RunsAProgramToItsEnd) {
  Loop loop(errand());
  loop.run();
  EXPECT_EQ(loop.runner.state(), RunState::done);
  EXPECT_TRUE(loop.runner.finished());
  ASSERT_EQ(loop.runner.transitions().size(), 3u);
  EXPECT_EQ(loop.runner.scheduler().why(loop.runner.transitions()[1]), "moved(base_link) > 20 cm");
  EXPECT_LT(loop.base.V.norm(), 0.02);
}

TEST(Runner, ReportsEachLimitsWorstValueAndMargin) {
  Loop loop(errand());
  loop.run();
  const LimitReport speed = loop.limit("go.go.x.velocity");
  EXPECT_EQ(speed.limit, 0.2);
  EXPECT_EQ(speed.unit, "m/s");
  EXPECT_NEAR(speed.worst, 0.2, 0.2 * 0.001);
  EXPECT_NEAR(speed.margin, speed.limit - speed.worst, 1e-12);
  const LimitReport acceleration = loop.limit("go.go.x.acceleration");
  EXPECT_NEAR(acceleration.worst, 0.5, 1e-6) << "0.5 m/s with a time constant of 50 ms asks for 10 m/s^2";
  const LimitReport push = loop.limit("push.go.x.nu");
  EXPECT_EQ(push.unit, "N");
  EXPECT_NEAR(push.worst, 10.0, 1e-9);
  EXPECT_EQ(push.limit, 10.0);
  EXPECT_NEAR(loop.limit("limits.rz.velocity").margin, 1.0, 1e-6);
  const LimitReport torque = loop.limit("front_left_wheel.tau");
  EXPECT_EQ(torque.limit, effort);
  // The largest demand is the brake's, which has the stop's 1 m/s^2: m a = sum over the wheels of tau / r.
  const double expected = PlanarBase().inertia()(0, 0) * 1.0 * wheel_radius / 4;
  EXPECT_NEAR(torque.worst, expected, 1e-3 * expected);
}

/// A loop whose host measures a force at the bumper, from the first tick on.
struct PressedLoop : Loop {
  using Loop::Loop;
  void tick(const solver::Vector3& force) {
    base.sense(sensed);
    sensed.state.f_ext[0].linear = force;
    base.step(runner.step(sensed));
  }
  double pushes(Axis axis) const {  // [N] of the row that drives the axis
    const auto& rows = runner.scheduler().constraints().rows();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto& c =
          runner.scheduler().constraints().constraints()[static_cast<std::size_t>(rows[i].constraint)];
      if (rows[i].kind == solver::RowKind::driver && c.axis == axis) return runner.solution().rows[i].nu;
    }
    ADD_FAILURE() << "no such row";
    return 0.0;
  }
};

/// The row that knew of the 15 N would press 15 N harder to get its acceleration.
TEST(ForceFromOutside, IsRefusedAlongAnAxisWhoseForceIsLimited) {
  lang::Task go = task("go", {drive("go.x", Axis::x, Quantity::velocity, 0.05),
                              drive("go.y", Axis::y, Quantity::velocity, 0.0),
                              drive("go.rz", Axis::rz, Quantity::velocity, 0.0)});
  go.groups[0].axes[0].force = between(-40, 40);
  go.blend.constant = 0.0;
  const lang::Program p = program({go});
  PressedLoop free(p), ahead(p), across(p);
  across.tick({0, -15, 0});
  for (int i = 0; i < 5; ++i) {
    free.tick({0, 0, 0});
    ahead.tick({-15, 0, 0});
  }
  EXPECT_GT(free.pushes(Axis::x), 1.0);
  EXPECT_NEAR(ahead.pushes(Axis::x), free.pushes(Axis::x), 1e-9);
  ASSERT_EQ(ahead.runner.events().size(), 1u) << "once, not on every tick";
  const Event& event = ahead.runner.events()[0];
  EXPECT_EQ(event.code, EventCode::wrench_refused);
  EXPECT_EQ(ahead.runner.event_signal(event), "base_link.f_ext");
  EXPECT_NEAR(event.value, 15.0, 1e-9);
  EXPECT_EQ(ahead.runner.state(), RunState::running);
  EXPECT_NEAR(across.pushes(Axis::y), free.pushes(Axis::y) + 15.0, 1e-6) << "known, and made up for";
  EXPECT_TRUE(across.runner.events().empty());
}

/// In axes of the world, and the base has turned: what lies ahead of it lies across the row.
TEST(ForceFromOutside, IsRefusedInTheAxesOfTheRow) {
  lang::Task go =
      task("go",
           {drive("go.x", Axis::x, Quantity::velocity, 0.05), drive("go.y", Axis::y, Quantity::velocity, 0.0),
            drive("go.rz", Axis::rz, Quantity::velocity, 0.0)},
           base_link, world_frame);
  go.groups[0].axes[0].force = between(-40, 40);
  PressedLoop free(program({go})), pressed(program({go}));
  free.base.pose.z() = pressed.base.pose.z() = 0.5 * std::numbers::pi;
  free.tick({0, 0, 0});
  pressed.tick({-20, 15, 0});  // in the world x -15 N, y -20 N
  ASSERT_EQ(pressed.runner.events().size(), 1u);
  EXPECT_NEAR(pressed.runner.events()[0].value, 15.0, 1e-9);
  EXPECT_NEAR(pressed.pushes(Axis::x), free.pushes(Axis::x), 1e-6);
  EXPECT_NEAR(pressed.pushes(Axis::y), free.pushes(Axis::y) + 20.0, 1e-6);
}

/// Knows the wheels only, and where the base stands in the first tick.
struct ReckoningLoop : Loop {
  using Loop::Loop;
  void tick() {
    const bool first = base.time == 0.0;
    const solver::Pose start = sensed.state.base_pose;
    base.sense(sensed);
    sensed.base_measured = false;
    if (!first) {
      sensed.state.base_pose = start;
      sensed.state.base_twist = {};
    }
    base.step(runner.step(sensed));
  }
};

TEST(Runner, ReckonsTheBaseFromTheWheelsWhereItIsNotMeasured) {
  Loop measured(errand());
  ReckoningLoop reckoned(errand());
  measured.base.pose = reckoned.base.pose = {1.0, -2.0, 0.7};
  measured.run();
  while (!reckoned.runner.finished() && reckoned.base.time < 20.0) reckoned.tick();
  EXPECT_EQ(reckoned.runner.state(), RunState::done);
  ASSERT_EQ(reckoned.runner.transitions().size(), 3u);
  // The plant's wheels do not slip: both runs are the same but for the integration's rounding.
  EXPECT_NEAR(reckoned.base.time, measured.base.time, 2 * period);
  EXPECT_LT((reckoned.base.pose - measured.base.pose).norm(), 1e-4);
}

// A host that says nothing of the base fills in the joints alone: the wheels say how it moves.
TEST(Runner, ReckonsTheBaseOfAHostThatFillsInTheJointsAlone) {
  Loop loop(errand());
  Sensed joints(errand().robot.model);
  double fastest = 0.0;
  while (!loop.runner.finished() && loop.base.time < 20.0) {
    loop.base.sense(loop.sensed);
    joints.time = loop.sensed.time;
    joints.state.q = loop.sensed.state.q;
    joints.state.qd = loop.sensed.state.qd;
    loop.base.step(loop.runner.step(joints));
    fastest = std::max(fastest, loop.base.V.x());
  }
  EXPECT_EQ(loop.runner.state(), RunState::done);
  EXPECT_LE(fastest, 0.3 * 1.001);
}

TEST(Runner, AFixThatIsStampedAheadKeepsOutNoneThatFollows) {
  ReckoningLoop loop(errand());
  const auto tick_with_fix = [&](double stamp) {
    loop.sensed.base_fix = MeasuredPose{stamp, {solver::Matrix3::Identity(), {5.0, 0.0, 0.0}}};
    loop.tick();
  };
  for (int i = 0; i < 10; ++i) loop.tick();
  tick_with_fix(1e6);
  for (int i = 0; i < 100; ++i) loop.tick();
  EXPECT_EQ(loop.runner.transitions().size(), 1u);
  for (int i = 0; i < 200; ++i) tick_with_fix(loop.base.time - period);
  EXPECT_LT(loop.base.pose.x(), 0.1);
  EXPECT_GE(loop.runner.transitions().size(), 2u) << "drawn to 5 m, it has moved by more than 20 cm";
}

/// Never taken over, it would leave the base to its wheels without a word.
TEST(Runner, AFixThatCannotBeTakenIsToldOnce) {
  const solver::Pose pose{solver::Matrix3::Identity(), {5.0, 0.0, 0.0}};
  solver::Pose no_rotation = pose;
  no_rotation.rotation *= 1.1;
  const struct {
    double off;
    solver::Pose pose;
    std::size_t told;
  } cases[] = {{0.2, pose, 1}, {1.7e9, pose, 1}, {-0.6, pose, 1}, {0.0, no_rotation, 1}, {-0.3, pose, 0}};
  for (const auto& [off, measured, told] : cases) {
    ReckoningLoop loop(errand());
    for (int i = 0; i < 50; ++i) {
      loop.sensed.base_fix = MeasuredPose{loop.base.time + off, measured};
      loop.tick();
    }
    ASSERT_EQ(loop.runner.events().size(), told) << off;
    if (told == 0) continue;
    EXPECT_EQ(loop.runner.events()[0].code, EventCode::signal_refused);
    EXPECT_EQ(loop.runner.event_signal(loop.runner.events()[0]), "base.pose");
    EXPECT_NEAR(loop.runner.events()[0].value, off, 1e-6 * std::abs(off));
  }
}

// The second stop of a run waits for the base to stand as the first does.
TEST(Runner, AStopAfterAResetBrakesToRest) {
  Loop loop(errand());
  for (const char* which : {"first", "second"}) {
    for (int i = 0; i < 400; ++i) loop.tick();
    ASSERT_GT(loop.base.V.x(), 0.05) << which;
    loop.runner.guard().stop(EventCode::requested);
    loop.tick();
    EXPECT_FALSE(loop.runner.finished()) << which;
    while (!loop.runner.finished() && loop.base.time < 20.0) loop.tick();
    EXPECT_LT(loop.base.V.norm(), 0.02) << which;
    loop.runner.guard().reset();
  }
}

// Where the springs of its wheels let the body lean, gravity along its own x is the floor's to hold.
TEST(Runner, ABaseThatLeansOnItsWheelsPushesAsOneThatIsLevel) {
  for (const bool measured : {true, false}) {
    Loop level(errand()), leaning(errand());
    for (int i = 0; i < 50; ++i) {
      level.base.sense(level.sensed);
      level.sensed.base_measured = measured;
      Sensed& sensed = leaning.sensed;
      sensed = level.sensed;
      sensed.state.base_pose.rotation =
          level.sensed.state.base_pose.rotation * solver::rotation_from_rpy(-0.01, 0.02, 0.0);
      const Eigen::VectorXd expected = level.runner.step(level.sensed);
      ASSERT_GT(expected.norm(), 0.0);
      ASSERT_LT((leaning.runner.step(sensed) - expected).norm(), 1e-12) << "in tick " << i;
      level.base.step(expected);
    }
  }
}

TEST(Runner, MakesNoHeapCallInAStep) {
  if (!zwang::test::can_count_heap_calls()) GTEST_SKIP() << "a sanitizer owns malloc";
  const zwang::test::TemporaryFolder folder;
  const auto path = folder.path() / "heap.csv";
  long calls = 0;
  {
    lang::Program program = errand();
    program.robot.friction.assign(4, {.coulomb = 1e-3, .presliding = 1e-4, .compensate = 0.5});
    Loop loop(program);
    Recorder recorder(path, loop.runner.columns());
    loop.runner.record_to(&recorder);
    int ticks = 0;
    while (!loop.runner.finished() && ticks < 10'000) {
      loop.base.sense(loop.sensed);
      zwang::test::start_counting_heap_calls();
      const Eigen::VectorXd& tau = loop.runner.step(loop.sensed);
      calls += zwang::test::stop_counting_heap_calls();
      loop.base.step(tau);
      ++ticks;
    }
    EXPECT_EQ(loop.runner.state(), RunState::done) << "all switches must have been among the steps";
    // A bad sample and the protective stop, too.
    loop.base.sense(loop.sensed);
    loop.sensed.state.q(0) = std::nan("");
    zwang::test::start_counting_heap_calls();
    loop.runner.step(loop.sensed);
    calls += zwang::test::stop_counting_heap_calls();
  }
  EXPECT_EQ(calls, 0);
}

/// A billion ticks a second would be a memory of as many poses.
TEST(Runner, RefusesPeriodsThatItCannotKeep) {
  const lang::Program program = errand();
  for (const double period : {0.0, -1e-3, std::nan(""), 1e-9, 5e-5, 0.011})
    EXPECT_THROW(Runner(program, {.period = period}), std::invalid_argument) << period;
  EXPECT_NO_THROW(Runner(program, {.period = 1e-4}));
  EXPECT_NO_THROW(Runner(program, {.period = 1e-2}));
}

TEST(Runner, ABadSampleStopsTheRunAndTheRestBrakes) {
  Loop loop(errand());
  for (int i = 0; i < 500; ++i) loop.tick();
  ASSERT_GT(loop.base.V.x(), 0.1);
  loop.base.sense(loop.sensed);
  loop.sensed.state.base_twist.linear.x() = std::nan("");
  loop.base.step(loop.runner.step(loop.sensed));
  EXPECT_EQ(loop.runner.state(), RunState::stopped);
  EXPECT_FALSE(loop.runner.finished());
  loop.run();
  EXPECT_TRUE(loop.runner.finished());
  EXPECT_LT(loop.base.V.norm(), 0.02);
  EXPECT_EQ(loop.runner.guard().reason(), EventCode::bad_sample);
}

/// As ROS stamps: the same run, and its log tells one tick from the next.
TEST(Runner, GoesByAClockThatCountsFrom1970) {
  constexpr double begin = 1'800'000'000.0;  // [s] in January 2027
  const zwang::test::TemporaryFolder folder;
  const lang::Program program = errand();
  const auto run = [&](double clock, const char* name) {
    Loop loop(program);
    std::vector<std::unique_ptr<LogSink>> sinks;
    sinks.push_back(csv_sink(folder.path() / name));
    Recorder recorder(std::move(sinks), loop.runner.columns());
    loop.runner.record_to(&recorder);
    double ended = -1.0;
    while (!loop.runner.finished() && loop.base.time < 20.0) {
      loop.base.sense(loop.sensed);
      loop.sensed.time += clock;
      loop.base.step(loop.runner.step(loop.sensed));
      if (loop.runner.state() == RunState::done && ended < 0.0) ended = loop.base.time;
    }
    recorder.close();
    EXPECT_EQ(loop.runner.state(), RunState::done) << loop.runner.event_count();
    EXPECT_EQ(loop.runner.event_count(), 0u);
    return ended;
  };
  // Its resolution is 0.24 us, and so is what dt is off by.
  EXPECT_NEAR(run(begin, "dated.csv"), run(0.0, "plain.csv"), 2e-3);
  std::ifstream log(folder.path() / "dated.csv");
  std::string line;
  std::getline(log, line);
  double last = begin - period;
  int lines = 0;
  while (std::getline(log, line)) {
    const double time = std::stod(line.substr(0, line.find(',')));
    EXPECT_NEAR(time - last, period, 1e-5);
    last = time;
    ++lines;
  }
  EXPECT_GT(lines, 1000);
}

}  // namespace
}  // namespace zwang::runtime
