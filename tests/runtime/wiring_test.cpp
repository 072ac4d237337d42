// Mistakes of the first hour on a new robot, made by the host between a simulated robot and the runner.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "constants.hpp"
#include "guard/blind_budget.hpp"
#include "guard/frozen_wheel.hpp"
#include "guard/joint_rates.hpp"
#include "robots.hpp"
#include "shipped_program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

using zwang::test::shipped_program;

/// With what is sensed, and with what is sent.
struct Mistake {
  std::function<void(solver::State&)> sensed = [](solver::State&) {};
  std::function<void(Eigen::VectorXd&)> sent = [](Eigen::VectorXd&) {};
};

struct Trial {
  EventCode reason = EventCode::none;
  std::string signal;
  double found = 0.0;         ///< [s]
  double fastest = 0.0;       ///< [m/s] of the base, by the plant
  double speed_at_end = 0.0;  ///< [m/s] when the runner says that it is over
};

Trial drive(const char* task, const char* robot, const Mistake& mistake, double longest = 10.0) {
  const lang::Program program = shipped_program(task, robot);
  ScenePlant plant(program);
  Runner runner(program, {.period = period});
  Sensed sensed(program.robot.model, program.signals.size());
  Trial run;
  while (!runner.finished() && plant.truth().time < longest) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    mistake.sensed(sensed.state);
    Eigen::VectorXd tau = runner.step(sensed);
    mistake.sent(tau);
    EXPECT_EQ(plant.apply(tau), PlantStatus::ok);
    run.fastest = std::max(run.fastest, plant.truth().velocity.head<2>().norm());
  }
  run.reason = runner.guard().reason();
  run.signal = runner.event_signal(runner.guard().stop_event());
  run.found = runner.guard().stop_event().time;
  run.speed_at_end = plant.truth().velocity.head<2>().norm();
  std::printf("%s, %s: %s by %s after %.2f s, %.3f m/s at most, %.4f m/s at the end\n", task, robot,
              to_string(run.reason), run.signal.c_str(), run.found, run.fastest, run.speed_at_end);
  return run;
}

#ifdef ZWANG_SANITIZED  // on the others it is the same code with other numbers
const char* const wired_robots[] = {"mecanum"};
#else
const char* const wired_robots[] = {"mecanum", "omni", "diff", "kelo_two", "kelo"};
#endif
const char* task_of(const std::string& robot) {
  return robot == "diff" ? "wall_align.yaml" : "obstacle.yaml";
}

/// Rates of 0 tell that the base stands, so it would be sped up for ever. Until the mistake is found the base
/// speeds up with the tasks' 0.5 m/s^2. The rates count from 0.04 rad in a window on. That window may be
/// under way then, and three follow.
TEST(Wiring, RatesThatAreNeverFilledInStopTheBase) {
  for (const char* robot : wired_robots) {
    const Trial run =
        drive(task_of(robot), robot, {.sensed = [](solver::State& state) { state.qd.setZero(); }});
    EXPECT_EQ(run.reason, EventCode::rate_contradicts) << robot;
    const double counts = 2.0 * JointRates::resolution / JointRates::window;
    const double radius = shipped_program(task_of(robot), robot).robot.model.wheels()[0].radius;
    EXPECT_LE(run.fastest, counts * radius + 0.5 * (1 + JointRates::windows) * JointRates::window) << robot;
    EXPECT_LT(run.speed_at_end, 0.02) << robot << " stands by what its positions say";
  }
}

/// All encoders at once, under way: their driver repeats the last positions, and the rates are 0 then. A base
/// that pushes blindly looks like one that stands at the wall, and got to 0.25 m/s and `done`.
TEST(Wiring, EncodersThatAllDieUnderWayStopTheBase) {
  for (const char* robot : wired_robots) {
    int tick = 0;
    Eigen::VectorXd kept;
    const Trial run = drive(task_of(robot), robot, {.sensed = [&](solver::State& state) {
                              if (++tick <= 1500) {
                                kept = state.q;
                                return;
                              }
                              state.q = kept;
                              state.qd.setZero();
                            }});
    EXPECT_EQ(run.reason, EventCode::frozen) << robot;
    EXPECT_LE(run.found, 1.5 + 20 * period + 1e-9) << robot;
    EXPECT_LE(run.fastest, 1.1 * (task_of(robot) == std::string("wall_align.yaml") ? 0.08 : 0.15)) << robot;
    EXPECT_LT(run.speed_at_end, 0.6 * run.fastest) << robot << " brakes from memory";
  }
}

/// From a standstill, v^2 = 2 a S, a what the task drives with at most.
TEST(Wiring, EncodersThatAreDeadFromTheStartStopTheBase) {
  for (const char* robot : wired_robots) {
    const Trial run = drive(task_of(robot), robot, {.sensed = [](solver::State& state) {
                              state.q.setZero();
                              state.qd.setZero();
                            }});
    EXPECT_EQ(run.reason, EventCode::frozen) << robot;
    EXPECT_LE(run.fastest, 1.05 * std::sqrt(2.0 * 1.0 * BlindBudget::least_budget)) << robot;
    EXPECT_LT(run.speed_at_end, 0.01) << robot << " stands again";
  }
}

/// Encoders of 4096 steps behind a gear of 20: what they do at a wall is no freeze.
TEST(Wiring, EncodersThatCountInStepsAreNotFrozenByAWall) {
  const double step = 2.0 * std::numbers::pi / 4096 / 20;
  for (const char* robot : {"mecanum", "omni", "diff"}) {
    const Trial run = drive("wall_align.yaml", robot,
                            {.sensed =
                                 [step](solver::State& state) {
                                   for (double& q : state.q) q = std::round(q / step) * step;
                                 }},
                            30.0);
    EXPECT_EQ(run.reason, EventCode::none) << robot;
  }
}

/// In degrees, in turns, with the other sign.
TEST(Wiring, RatesInAnotherUnitStopTheBase) {
  for (const double factor : {180.0 / std::numbers::pi, 0.5 / std::numbers::pi, -1.0}) {
    const Trial run =
        drive("obstacle.yaml", "mecanum", {.sensed = [factor](solver::State& state) { state.qd *= factor; }});
    EXPECT_NE(run.reason, EventCode::none) << factor;
    EXPECT_LE(run.fastest, 0.3) << factor;
    EXPECT_LT(run.speed_at_end, 0.02) << factor;
  }
}

/// On a base with more wheels than freedoms the other encoders show the mistake. On a base with as many, all
/// signs tell that the motor turns the wrong way.
TEST(Wiring, AnEncoderThatCountsTheOtherWayRoundStopsTheBase) {
  struct {
    const char *task, *robot;
  } const of[] = {{"obstacle.yaml", "mecanum"}, {"docking.yaml", "mecanum"},   {"obstacle.yaml", "omni"},
                  {"wall_align.yaml", "diff"},  {"obstacle.yaml", "kelo_two"}, {"obstacle.yaml", "kelo"}};
  for (const auto& [task, robot] : of) {
    const int wheel = shipped_program(task, robot).robot.model.wheels()[0].body - 1;
    const Trial run = drive(task, robot, {.sensed = [wheel](solver::State& state) {
                              state.q(wheel) = -state.q(wheel);
                              state.qd(wheel) = -state.qd(wheel);
                            }});
    EXPECT_NE(run.reason, EventCode::none) << robot;
    EXPECT_LE(run.fastest, 0.2) << robot;
    EXPECT_LT(run.speed_at_end, 0.02) << robot;
  }
}

TEST(Wiring, AReversedEncoderIsNamed) {
  const Trial run = drive("obstacle.yaml", "mecanum", {.sensed = [](solver::State& state) {
                            state.q(1) = -state.q(1);
                            state.qd(1) = -state.qd(1);
                          }});
  EXPECT_EQ(run.reason, EventCode::wheel_reversed);
  EXPECT_EQ(run.signal.substr(run.signal.size() - 3), ".qd");
}

/// The sign of all torques, or of all encoders: the base speeds up against its own brake. The first torques
/// show the mistake, 0.04 s and the observer's delay after they count. The speed is then at most 0.5 m/s^2
/// for 0.1 s.
TEST(Wiring, MotorsThatAllTurnTheOtherWayStopTheBase) {
  const Mistake torques{.sent = [](Eigen::VectorXd& tau) { tau = -tau; }};
  const Mistake encoders{.sensed = [](solver::State& state) {
    state.q = -state.q;
    state.qd = -state.qd;
  }};
  for (const char* robot : wired_robots) {
    for (const Mistake& mistake : {torques, encoders}) {
      const Trial run = drive(task_of(robot), robot, mistake);
      EXPECT_EQ(run.reason, EventCode::motors_reversed) << robot;
      EXPECT_LE(run.fastest, 0.05) << robot;
      EXPECT_LT(run.speed_at_end, 0.01) << robot;
    }
  }
}

/// Each of two motors gets the command of the other. No single motor explains the motion, and forward the
/// base goes as it should. The guard stops the base when it is far faster than allowed: by 0.2 m/s, or twice
/// the 0.15 m/s. By then the base has gained speed for a `dwell` with 1 m/s^2 at most. It gains more during
/// the choices of the brake, 6 x 0.04 s. None of them is right: they drive the base with the force of the
/// stop.
TEST(Wiring, TwoMotorsInEachOthersPlaceAreNotDrivenOn) {
  for (const auto& [task, robot] : {std::pair{"obstacle.yaml", "omni"},
                                    {"wall_align.yaml", "omni"},
                                    {"obstacle.yaml", "mecanum"},
                                    {"wall_align.yaml", "mecanum"}}) {
    const Mistake swapped{.sent = [](Eigen::VectorXd& tau) { std::swap(tau(0), tau(1)); }};
    const Trial run = drive(task, robot, swapped, 30.0);
    // Sideways, one of the two can look reversed before the base is far too fast.
    EXPECT_TRUE(run.reason == EventCode::runaway || run.reason == EventCode::torque_flipped) << task;
    const lang::Robot model = shipped_program(task, robot).robot;
    const double driven = model.stop.force / model.model.total_mass();  // [m/s^2]
    EXPECT_LE(run.fastest, 0.15 + 0.2 + 1.0 * 0.05 + driven * 6 * 0.04) << task;
  }
}

/// Its position stays what it is, to the bit, and its rate is 0. Three windows later it is told, and the base
/// has sped up with 0.5 m/s^2 at most until then.
TEST(Wiring, AnEncoderThatDiesStopsTheBase) {
  struct {
    const char *task, *robot;
    double at;  // [s] under way
  } const of[] = {{"obstacle.yaml", "mecanum", 1.5},   {"docking.yaml", "mecanum", 3.0},
                  {"wall_align.yaml", "mecanum", 2.0}, {"obstacle.yaml", "omni", 1.5},
                  {"wall_align.yaml", "omni", 2.0},    {"wall_align.yaml", "diff", 2.0},
                  {"obstacle.yaml", "kelo_two", 1.5},  {"obstacle.yaml", "kelo", 1.5}};
  for (const auto& [task, robot, at] : of) {
    const solver::Model model = shipped_program(task, robot).robot.model;
    const int wheel = model.wheels()[0].body - 1;
    int ticks = 0;
    double last = 0.0;
    const Trial run = drive(task, robot, {.sensed = [&, wheel, begin = at](solver::State& state) {
                              const bool is_dead = ++ticks * period > begin;
                              if (!is_dead) last = state.q(wheel);
                              state.q(wheel) = last;
                              if (is_dead) state.qd(wheel) = 0.0;
                            }});
    EXPECT_EQ(run.reason, EventCode::frozen) << robot;
    EXPECT_EQ(run.signal, model.joint(wheel).name + ".q");
    EXPECT_LE(run.found, at + (FrozenWheel::windows + 1) * FrozenWheel::window + 2 * period) << robot;
    EXPECT_LE(run.fastest, 0.25 + 0.5 * (FrozenWheel::windows + 1) * FrozenWheel::window) << robot;
  }
}

/// Three wheels set out after 1 s with 2 rad/s. The third of four is told 1 N m, and counts only when asked.
struct StandingWheel {
  double way, asked;  // [rad] of the others at the end, [s] that the wheel was told to turn back
  std::optional<Event> event;
};
StandingWheel roll_beside_a_standing_wheel(bool answers, double until) {
  const lang::Robot robot = test::mecanum_robot();
  FrozenWheel frozen(robot);
  solver::State state(robot.model);
  Eigen::VectorXd sent = Eigen::VectorXd::Zero(4);
  StandingWheel of{};
  for (int i = 0; i * period < until && !of.event; ++i) {
    const bool sets_out = i * period > 1.0;
    sent(2) = sets_out ? 1.0 : 0.0;
    frozen.ask(sent);
    of.asked += sent(2) < 0.0 ? period : 0.0;
    state.q(2) += answers && sent(2) < 0.0 ? 1e-3 : 0.0;
    of.way += sets_out ? 2.0 * period : 0.0;
    for (const int wheel : {0, 1, 3}) state.q(wheel) = of.way;
    of.event = frozen.look(state, sent, i * period);
  }
  return of;
}

// Told to go on, a base on two wheels of which one is dead would circle.
TEST(Wiring, AnEncoderThatIsDeadStopsTheBaseWhenAnotherWheelHasRolledAGoodWay) {
  const StandingWheel dead = roll_beside_a_standing_wheel(false, 3.0);
  EXPECT_TRUE(dead.event && dead.event->signal == event_signal::of_joint(2, event_signal::q));
  EXPECT_NEAR(dead.asked, FrozenWheel::answers_within, 2.0 * period);
  EXPECT_NEAR(dead.way, FrozenWheel::good_way + 2.0 * dead.asked, 2.0 * 2.0 * FrozenWheel::window);
}

/// A wall holds it, and it counts nothing there. It is asked after 1, 2, 4 and 8 rad, and then every 8 rad.
TEST(Wiring, AWheelThatStandsAtAWallIsAskedAndAnswers) {
  const StandingWheel held = roll_beside_a_standing_wheel(true, 1.0 + (1.0 + 2.0 + 4.0 + 8.0 + 4.0) / 2.0);
  EXPECT_FALSE(held.event);
  EXPECT_NEAR(held.asked, 4 * FrozenWheel::signs_of_life * period, 0.5 * period);
}

/// Another wheel rolls on, and this one has nothing to do: the rear wheel of an omni base that goes straight.
TEST(Wiring, AWheelThatIsToldNothingMayStand) {
  const lang::Robot robot = test::mecanum_robot();
  FrozenWheel frozen(robot);
  solver::State state(robot.model);
  for (int i = 0; i < 5000; ++i) {
    for (const int wheel : {0, 1, 3}) state.q(wheel) = 3.0 * i * period;
    ASSERT_FALSE(frozen.look(state, Eigen::VectorXd::Zero(4), i * period));
  }
}

/// 90 steps a turn, as the Hall sensors of a hub motor have, at any speed: between two steps it is still.
TEST(Wiring, ACoarseEncoderIsNotDead) {
  const lang::Robot robot = test::mecanum_robot();
  const double step = 2.0 * std::numbers::pi / 90.0;
  for (double rate = 0.1; rate < 30.0; rate *= 1.1) {
    FrozenWheel frozen(robot);
    solver::State state(robot.model);
    const Eigen::VectorXd sent = Eigen::VectorXd::Constant(4, 1.0);
    for (int i = 0; i < 5000; ++i) {
      for (int wheel = 0; wheel < 4; ++wheel)
        state.q(wheel) = std::floor((rate * i * period + 0.2 * wheel) / step) * step;
      ASSERT_FALSE(frozen.look(state, sent, i * period)) << rate << " " << i;
    }
  }
}

/// Encoders that begin anew with each turn, of 512 steps, and rates that are 20 ms late with noise.
TEST(Wiring, CoarseNoisyAndLateIsNoContradiction) {
  const lang::Robot robot = test::mecanum_robot();
  JointRates rates(robot.model);
  solver::State state(robot.model);
  const double step = 2.0 * std::numbers::pi / 512.0, late = 0.02;
  double fastest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double t = i * period;
    const auto q = [](double at) { return 8.0 * std::sin(1.5 * at) + 3.0 * std::sin(4.0 * at); };
    const auto qd = [](double at) { return 12.0 * std::cos(1.5 * at) + 12.0 * std::cos(4.0 * at); };
    const double turned = std::floor(q(t) / step) * step;
    const double noise = 0.3 * std::sin(1e4 * t);
    state.q.setConstant(turned - 2.0 * std::numbers::pi * std::floor(turned / (2.0 * std::numbers::pi)));
    state.qd.setConstant(qd(t - late) + noise);
    fastest = std::max(fastest, std::abs(qd(t)));
    ASSERT_FALSE(rates.look(state, t)) << t;
  }
  EXPECT_GT(fastest, 20.0);
}

TEST(Wiring, ARateOfOtherSizeIsToldAfterThreeWindows) {
  const lang::Robot robot = test::mecanum_robot();
  for (const double factor : {0.0, 0.3, 3.0, -1.0}) {
    JointRates rates(robot.model);
    solver::State state(robot.model);
    double told = -1.0;
    for (int i = 0; i < 1000 && told < 0.0; ++i) {
      state.q(2) = 5.0 * i * period;
      state.qd(2) = factor * 5.0;
      if (const auto event = rates.look(state, i * period)) {
        told = i * period;
        EXPECT_EQ(event->code, EventCode::rate_contradicts);
        EXPECT_EQ(event_signal::joint_of(event->signal), 2);
      }
    }
    EXPECT_NEAR(told, JointRates::windows * JointRates::window, 3.0 * period) << factor;
    Eigen::VectorXd qd = state.qd;
    rates.mend(qd);
    const double by_position = 5.0 * (1.0 - std::exp(-told / JointRates::quick));
    EXPECT_NEAR(qd(2), factor == 3.0 ? 15.0 : by_position, 1e-9) << factor;
  }
}

/// A task that measures a distance, whose samples `set` makes.
struct Signals {
  explicit Signals(const std::function<void(SignalSample&, double)>& set) {
    lang::Program p = test::program(
        {test::task("stand", {test::drive("go.x", test::Axis::x, test::Quantity::velocity, 0.0)})});
    lang::Signal range;
    range.name = "range";
    range.type = lang::SignalType::number;
    range.stale_after.constant = 0.5;
    p.signals.push_back(range);
    Runner runner(p);
    Sensed sensed(p.robot.model, 1);
    sensed.base_measured = true;
    for (int i = 0; i < 500; ++i) {
      sensed.time = 1000.0 + i * period;
      sensed.signals[0] = {.valid = true, .stamp = sensed.time, .number = 1.0};
      set(sensed.signals[0], sensed.time);
      runner.step(sensed);
    }
    events = runner.events();
    if (!events.empty()) name = runner.event_signal(events[0]);
    EXPECT_EQ(runner.state(), RunState::running);
  }
  std::vector<Event> events;
  std::string name;
};

TEST(Wiring, ASignalByAnotherClockIsToldOnce) {
  for (const double off : {0.2, 1.7e9, -61.0, -1000.0}) {
    const Signals run([off](SignalSample& sample, double time) { sample.stamp = time + off; });
    ASSERT_EQ(run.events.size(), 1U) << off;
    EXPECT_EQ(run.events[0].code, EventCode::signal_refused);
    EXPECT_EQ(run.name, "signal.range");
    EXPECT_NEAR(run.events[0].value, off, 1e-6 * std::abs(off));
  }
}

TEST(Wiring, ASampleThatIsEarlyOrStaysIsNotTold) {
  const Signals early([](SignalSample& sample, double time) { sample.stamp = time + 0.01; });
  EXPECT_TRUE(early.events.empty());
  const Signals stays([](SignalSample& sample, double) { sample.stamp = 1000.0; });
  EXPECT_TRUE(stays.events.empty());
}

TEST(Wiring, ASampleThatIsNoNumberIsTold) {
  const Signals run([](SignalSample& sample, double) { sample.number = std::nan(""); });
  ASSERT_EQ(run.events.size(), 1U);
  EXPECT_EQ(run.events[0].code, EventCode::signal_refused);
  EXPECT_EQ(run.events[0].value, 0.0);
}

}  // namespace
}  // namespace zwang::runtime
