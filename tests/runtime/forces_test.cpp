// Drivers that follow a force or add up their error, and the forces that conditions ask for. The base's
// dynamics are derived apart from the library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "robots.hpp"
#include "schedule/estimated_wrenches.hpp"
#include "scheduler_bench.hpp"
#include "zwang/lang/condition_function.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

/// Holds y and the heading, drives x.
lang::Program along_x(const AxisStatements& x) {
  return program({task("go", {x, drive("go.y", Axis::y, Quantity::velocity, 0.0),
                              drive("go.rz", Axis::rz, Quantity::velocity, 0.0)})});
}

/// Gives way along x to what conditions call `force`.
AxisStatements yields(const Nodes& force, double mass, double damping, double dead_band) {
  AxisStatements x = drive("go.x", Axis::x, Quantity::acceleration, 0.0);
  x.yield = lang::Yield{when(force), {.constant = mass}, {.constant = damping}, {.constant = dead_band}};
  return x;
}

Nodes estimated_force() {
  Nodes nodes = name(Op::estimated_force);
  nodes[0].axis = 0;
  return nodes;
}

/// Where a hand presses on the base at a time, in its axes [N, N, N m].
using Hand = std::function<Eigen::Vector3d(double time)>;

/// The base's speed along x at the end of each of the times [s], pushed by the hand.
std::vector<double> speeds(const lang::Program& program, const std::vector<double>& times, const Hand& hand,
                           double signal = 0.0) {
  Runner runner(program);
  PlanarBase base;
  Sensed sensed(program);
  std::vector<double> found;
  while (found.size() < times.size()) {
    base.sense(sensed);
    for (SignalSample& sample : sensed.signals) {
      sample.valid = true;
      sample.stamp = base.time;
      sample.number = signal;
    }
    const Eigen::VectorXd tau = runner.step(sensed);
    base.step(tau, hand(base.time));
    if (base.time >= times[found.size()] - 0.5 * period) found.push_back(base.V.x());
  }
  return found;
}

// From 1 s on F pushes with 30 N: dds = (F~ - D ds)/M, F~ = 30 N - 5 N. So v(t) = 25/80 (1 - exp(-t D/M)),
// whatever the mass of the base itself is.
TEST(Yield, MovesLikeItsMassAndItsDamper) {
  const Hand pushes = [](double time) { return Eigen::Vector3d(time < 1.0 ? 0.0 : 30.0, 0.0, 0.0); };
  for (const double mass : {40.0, 160.0}) {
    const double settled = 12.0 * mass / 80.0;
    const auto v =
        speeds(along_x(yields(estimated_force(), mass, 80.0, 5.0)), {2.0, 3.0, 1.0 + settled}, pushes);
    const auto expected = [&](double t) { return 25.0 / 80.0 * (1.0 - std::exp(-t * 80.0 / mass)); };
    // For 20 ms the estimate does not know of it: 30 N move 56 kg by 11 mm/s.
    EXPECT_NEAR(v[0], expected(1.0), 0.015) << mass;
    EXPECT_NEAR(v[1], expected(2.0), 0.015) << mass;
    EXPECT_NEAR(v[2], 25.0 / 80.0, 0.002) << mass;
  }
}

TEST(Yield, StandsInsideItsDeadBand) {
  const auto v = speeds(along_x(yields(estimated_force(), 60.0, 80.0, 5.0)), {3.0},
                        [](double) { return Eigen::Vector3d(4.0, 0.0, 0.0); });
  EXPECT_NEAR(v[0], 0.0, 1e-3);
}

// A hand that lets go at v leaves M dv/dt = -D v.
TEST(Yield, RollsOut) {
  const auto v = speeds(along_x(yields(estimated_force(), 60.0, 80.0, 0.0)), {6.0, 6.75}, [](double time) {
    return time < 6.0 ? Eigen::Vector3d(30.0, 0.0, 0.0) : Eigen::Vector3d::Zero().eval();
  });
  EXPECT_NEAR(v[1], v[0] * std::exp(-0.75 * 80.0 / 60.0), 0.03 * v[0]);
}

/// [m] The widest swing of a yield of 20 kg and 80 N s/m that a spring holds: in the first half second after
/// a knock, and in the last of four seconds.
std::pair<double, double> swings(double stiffness) {
  const lang::Program p = along_x(yields(estimated_force(), 20.0, 80.0, 0.0));
  Runner runner(p);
  PlanarBase base;
  base.V.x() = 2e-3;
  Sensed sensed(p.robot.model);
  std::pair<double, double> widest;
  while (base.time < 4.0) {
    base.sense(sensed);
    const Eigen::VectorXd tau = runner.step(sensed);
    base.step(tau, {-stiffness * base.pose.x(), 0.0, 0.0});
    if (base.time < 0.5) widest.first = std::max(widest.first, std::abs(base.pose.x()));
    if (base.time > 3.5) widest.second = std::max(widest.second, std::abs(base.pose.x()));
  }
  return widest;
}

// The force is known 20 ms late. By Routh's criterion a holder of the stiffness k makes no swing while
//   k < D (M + t D) L / (t M (L - M - t D)),   L the mass of the base.
TEST(Yield, RingsOnlyWhereItIsHeldStiffly) {
  constexpr double M = 20.0, D = 80.0, t = 0.02;
  const double L = PlanarBase().inertia()(0, 0);
  const double bound = D * (M + t * D) * L / (t * M * (L - M - t * D));
  const auto below = swings(0.7 * bound), above = swings(1.4 * bound);
  EXPECT_LT(below.second, 0.2 * below.first);
  EXPECT_GT(above.second, 2.0 * above.first);
}

// A force that only is told moves the base, too: nothing pushes it.
TEST(Yield, FollowsANumberSignal) {
  lang::Program p = along_x(yields(name(Op::signal, 0), 60.0, 80.0, 0.0));
  p.signals = {{.name = "wish", .type = lang::SignalType::number, .stale_after = {.constant = 0.1}}};
  const Hand same = [](double) { return Eigen::Vector3d(16.0, 0.0, 0.0); };
  EXPECT_NEAR(speeds(p, {6.0}, same, 16.0)[0], 16.0 / 80.0, 1e-3);
}

TEST(Yield, StandsWhileItsForceIsNotKnown) {
  lang::Program p = along_x(yields(name(Op::signal, 0), 60.0, 80.0, 0.0));
  p.signals = {{.name = "wish", .type = lang::SignalType::number, .stale_after = {.constant = 0.1}}};
  Bench bench(std::move(p));
  bench.tick();
  EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::velocity);
  EXPECT_EQ(bench.constraint(0).driver->target, 0.0);
  bench.hear(0, 12.0);
  bench.tick();
  EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::acceleration);
  EXPECT_NEAR(bench.constraint(0).driver->target, 12.0 / 60.0, 1e-12);
}

AxisStatements slow_push(std::optional<double> build_up) {
  AxisStatements x = drive("go.x", Axis::x, Quantity::velocity, 0.02);
  x.time_constant.constant = 0.05;
  x.force = between(-10.0, 10.0);
  if (build_up) x.build_up = lang::Value{.constant = *build_up};
  return x;
}

double mass_along_x() {
  return PlanarBase().inertia()(0, 0);
}

// 3 N of drag slow a velocity driver by F T/m; what builds up makes up for all of it.
TEST(BuildUp, MakesUpForDrag) {
  const Hand drag = [](double) { return Eigen::Vector3d(-3.0, 0.0, 0.0); };
  const double v1 = 0.02 - 3.0 * 0.05 / mass_along_x();
  EXPECT_NEAR(speeds(along_x(slow_push({})), {4.0}, drag)[0], v1, 1e-5);
  EXPECT_NEAR(speeds(along_x(slow_push(0.2)), {4.0}, drag)[0], 0.02, 1e-5);
}

constexpr double creep = 1e-3;  // [m/s] at which what blocks the base gives way

/// The forces along x at `times` [s] while something holds the base. Then the base is let go: its speeds at
/// `later` [s].
struct Blocked {
  std::vector<double> forces;
  std::vector<double> speeds;
};
Blocked blocked(const lang::Program& program, double until, const std::vector<double>& times,
                const std::vector<double>& later) {
  Runner runner(program);
  PlanarBase base;
  base.V.x() = creep;
  Sensed sensed(program.robot.model);
  Blocked found;
  while (found.speeds.size() < later.size()) {
    base.sense(sensed);
    const Eigen::VectorXd tau = runner.step(sensed);
    const bool is_blocked = base.time < until - 0.5 * period;
    base.step(tau, is_blocked ? Eigen::Vector3d(-base.commanded(tau)) : Eigen::Vector3d::Zero().eval());
    const auto is_due = [&](const std::vector<double>& of, std::size_t i) {
      return i < of.size() && base.time >= of[i] - 0.5 * period;
    };
    if (is_due(times, found.forces.size()))
      found.forces.push_back(runner.scheduler().reading({0, 0, 0}).force);
    if (!is_blocked && is_due(later, found.speeds.size())) found.speeds.push_back(base.V.x());
  }
  return found;
}

// If the base is blocked at the speed ds, q = (v - ds) t/t_b. So it presses with m (v - ds) (1 + t/t_b)/T, up
// to F after t_b (F T/(m (v - ds)) - 1).
TEST(BuildUp, ReachesItsForceRangeWhenBlocked) {
  const double m = mass_along_x(), v = 0.02 - creep, T = 0.05, t_b = 4.0, F = 60.0;
  AxisStatements x = slow_push(t_b);
  x.force = between(-F, F);
  const double reached = t_b * (F * T / (m * v) - 1.0);
  const auto pressed = [&](double t) { return m * v * (1.0 + t / t_b) / T; };
  ASSERT_GT(reached, 1.0);
  const Blocked found =
      blocked(along_x(x), reached + 2.0, {0.5 * reached, 0.9 * reached, reached + 1.0}, {reached + 2.0});
  EXPECT_NEAR(found.forces[0], pressed(0.5 * reached), 0.02 * F);
  EXPECT_NEAR(found.forces[1], pressed(0.9 * reached), 0.02 * F);
  EXPECT_NEAR(found.forces[2], F, 1e-6);
}

// Let go at F after a long while, the base is pulled by all of F at first. Beyond v what was added up fades:
// at 1.1 v, or 5 mm/s beyond v, the driver brakes, whatever q is. In a tick F makes it F h/m faster.
TEST(BuildUp, WhatWasAddedUpIsNoSpeedBeyondTheTarget) {
  const double T = 0.05, F = 40.0;
  for (const double v : {0.02, 0.2}) {
    AxisStatements x = slow_push(4.0 * T);
    x.driver = Quantity::velocity;
    x.target.constant = v;
    x.force = between(-F, F);
    std::vector<double> times;
    for (double t = 0.002; t < 1.5; t += 0.002) times.push_back(20.0 + t);
    const Blocked found = blocked(along_x(x), 20.0, {}, times);
    const double fastest = *std::max_element(found.speeds.begin(), found.speeds.end());
    EXPECT_GT(fastest, v) << "F was not added up";
    EXPECT_LT(fastest, v + std::max(0.1 * v, 5e-3) + F * period / mass_along_x());
    EXPECT_NEAR(found.speeds.back(), v, 0.02 * v);
  }
}

// The base is held at the creep c until it presses with 6.5 m v/T. Then friction of 5 m v/T rubs it. For 0.5
// kg at 20 mm/s these are stiction of 1.3 N and friction of 1 N. With t_b = 4 T, l = 1/(2 T) and e = ds - v,
//   e = (e0 + (1.5 v/T + l e0) t) exp(-l t),   e0 = c - v,
// if q keeps what it built up. Beyond v it fades, so the base is slower than that.
TEST(BuildUp, BreaksAwayFromStictionGently) {
  // Slow, so that the motors of this base make the stiction.
  const double m = mass_along_x(), v = 0.005, T = 0.05, l = 1.0 / (2.0 * T);
  const double held = 6.5 * m * v / T, rubs = 5.0 * m * v / T;
  AxisStatements x = slow_push(4.0 * T);
  x.target.constant = v;
  x.force = between(-2.0 * held, 2.0 * held);
  const lang::Program p = along_x(x);
  Runner runner(p);
  PlanarBase base;
  base.V.x() = creep;
  Sensed sensed(p.robot.model);
  std::optional<double> away;
  double fastest = 0.0;
  while (!away || base.time < *away + 1.0) {
    base.sense(sensed);
    const Eigen::VectorXd tau = runner.step(sensed);
    const Eigen::Vector3d pushed = base.commanded(tau);
    ASSERT_LT(base.time, 10.0) << "it never breaks away";
    if (!away && pushed.x() >= held) away = base.time;
    base.step(tau, away ? Eigen::Vector3d(-rubs, 0.0, 0.0) : Eigen::Vector3d(-pushed));
    fastest = std::max(fastest, base.V.x());
  }
  const double e0 = creep - v, slope = 1.5 * v / T + l * e0, at = 1.0 / l - e0 / slope;
  EXPECT_GT(fastest, v);
  EXPECT_LT(fastest, v + 1.02 * (e0 + slope * at) * std::exp(-l * at));
}

// With q the law of a position is of the third degree; drag shifts only its begin. With e the way to the
// goal,
//   d3e/dt3 + 2/T d2e/dt2 + 1/T^2 de/dt + 1/(t_b T^2) e = 0,   e = -p, de/dt = 0, d2e/dt2 = p/T^2 - F/m at 0.
// At t_b = 4 T its swinging part is damped by 0.69, and it overshoots.
TEST(BuildUp, OfAPositionIsALawOfTheThirdDegree) {
  constexpr double T = 0.1, t_b = 4.0 * T, goal = 0.02, drag = 3.0;
  AxisStatements x = drive("go.x", Axis::x, Quantity::position, goal);
  x.time_constant.constant = T;
  x.build_up = lang::Value{.constant = t_b};
  lang::Program p =
      program({task("go", {x, drive("go.y", Axis::y, Quantity::velocity, 0.0)}, base_link, world_frame)});
  for (lang::Task& only : p.tasks) only.blend = {.constant = 0.0};
  Runner runner(p);
  PlanarBase base;
  Sensed sensed(p.robot.model);
  Eigen::Vector3d e(-goal, 0.0, goal / (T * T) - drag / mass_along_x());
  Eigen::Matrix3d law;
  law << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, -1.0 / (t_b * T * T), -1.0 / (T * T), -2.0 / T;
  double farthest = 0.0;
  while (base.time < 2.0) {
    base.sense(sensed);
    const Eigen::VectorXd tau = runner.step(sensed);
    base.step(tau, {-drag, 0.0, 0.0});
    constexpr int parts = 20;
    for (int i = 0; i < parts; ++i) e += period / parts * (law * e);
    EXPECT_NEAR(base.pose.x() - goal, e[0], 0.02 * goal) << base.time;
    farthest = std::max(farthest, base.pose.x());
  }
  EXPECT_GT(farthest, 1.01 * goal);
}

// A position driver under 3 N stands F T^2/m off its place; what builds up leads it there.
TEST(BuildUp, LeadsAPositionToItsPlace) {
  const auto offset = [](std::optional<double> build_up) {
    AxisStatements x = drive("go.x", Axis::x, Quantity::position, 0.05);
    x.time_constant.constant = 0.1;
    if (build_up) x.build_up = lang::Value{.constant = *build_up};
    lang::Program p =
        program({task("go", {x, drive("go.y", Axis::y, Quantity::velocity, 0.0)}, base_link, world_frame)});
    Runner runner(p);
    PlanarBase base;
    Sensed sensed(p.robot.model);
    while (base.time < 12.0) {
      base.sense(sensed);
      const Eigen::VectorXd tau = runner.step(sensed);
      base.step(tau, {-3.0, 0.0, 0.0});
    }
    return base.pose.x() - 0.05;
  };
  EXPECT_NEAR(offset({}), -3.0 * 0.1 * 0.1 / mass_along_x(), 1e-5);
  EXPECT_NEAR(offset(0.8), 0.0, 1e-5);
}

TEST(WrenchSignal, IsAskedForByItsParts) {
  using lang::WrenchPart;
  const std::pair<WrenchPart, double> parts[] = {
      {WrenchPart::x, 3.0},  {WrenchPart::y, -4.0},  {WrenchPart::z, 5.0},    {WrenchPart::rx, 0.6},
      {WrenchPart::ry, 0.7}, {WrenchPart::rz, -0.8}, {WrenchPart::plane, 5.0}};
  for (const auto& [part, value] : parts) {
    Nodes felt = name(Op::signal, 0);
    felt[0].axis = static_cast<int>(part);
    lang::Task t = task("feel", {drive("go.x", Axis::x, Quantity::velocity, 0.0)});
    t.exits = {
        exit(when(apply(Op::less, apply(Op::abs, apply(Op::subtract, felt, number(value))), number(1e-9))),
             to_done)};
    lang::Program p = program({t});
    p.signals = {{.name = "felt", .type = lang::SignalType::wrench, .stale_after = {.constant = 0.1}}};
    Bench bench(std::move(p));
    bench.ticks_more(3);
    EXPECT_EQ(bench.scheduler.outcome(), Outcome::none) << "it was never received";
    bench.sensed.signals[0].valid = true;
    bench.sensed.signals[0].stamp = bench.sensed.time;
    bench.sensed.signals[0].wrench = {{0.6, 0.7, -0.8}, {3.0, -4.0, 5.0}};
    EXPECT_EQ(bench.ticks_to_switch(3), 1) << static_cast<int>(part);
  }
}

// The estimated force on the base, as a wrench on a frame that it carries, about that frame's origin.
TEST(EstimatedWrench, OnAFrameOfTheBaseIsThatOnTheBase) {
  Nodes torque = name(Op::estimated_wrench, bumper);
  torque[0].axis = static_cast<int>(lang::WrenchPart::rz);
  lang::Task t = task("feel", {drive("go.x", Axis::x, Quantity::velocity, 0.0)});
  // 2 N to the left at 0.4 m ahead turn by 0.8 N m about the origin, and by 0 about the bumper.
  t.exits = {exit(when(apply(Op::less, apply(Op::abs, torque), number(1e-9))), to_done)};
  Bench bench(program({t}));
  bench.ticks_more(3);
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::none) << "it is not known yet";
  bench.scheduler.estimate_force({0.0, 2.0, 0.8});
  EXPECT_EQ(bench.ticks_to_switch(3), 1);
}

// A unit force or torque at the tip of an arm of seven joints, as the solver has it along the free motions.
TEST(EstimatedWrench, AtTheTipOfAnArmIsWhatPressesThere) {
  lang::Diagnostics diagnostics;
  const auto robot = lang::load_robot(
      std::filesystem::path(ZWANG_SOURCE_DIR) / "specs/robots/mecanum_arm_base.yaml", diagnostics);
  ASSERT_TRUE(robot);
  const solver::Model& model = robot->model;
  const solver::State state = lang::start_state(*robot, std::nullopt);
  lang::FrameDeclaration tip;
  tip.parent = lang::FrameParent::body;
  tip.parent_index = model.body_count() - 1;
  tip.pose = {solver::rotation_from_rpy(0.3, -0.2, 0.5), {0.02, 0.03, 0.1}};
  FrameTable frames({{}, tip}, model, 0);
  frames.update(model, state, period);
  solver::ConstraintSet set(6, 6);
  for (int axis = 0; axis < 6; ++axis) {
    solver::AxisConstraint c;
    c.move = c.in = frames.attached(1);
    c.axis = static_cast<Axis>(axis);
    c.driver = solver::Driver{.quantity = Quantity::force, .target = 1.0};
    ASSERT_TRUE(set.add(c));
  }
  ASSERT_TRUE(set.fill(model, state));
  solver::Solver solver(model, {.base_motion = true});
  solver::Solution solution(model);
  ASSERT_EQ(solver.solve(state, set.rows(), solution), solver::Status::ok);
  solver::FreeMotions motions(model);
  ASSERT_TRUE(solver.free_motions(motions));
  for (int row = 0; row < 6; ++row) {
    Eigen::VectorXd p = Eigen::VectorXd::Zero(6 + model.joint_count());
    solver.force_on_motions(row, p);
    EstimatedWrenches wrenches(model);
    wrenches.ask(1);
    EXPECT_TRUE(std::isnan(wrenches.part(1, lang::WrenchPart::x)));
    wrenches.estimate(motions, p, state, frames, 1.0);  // far longer than its low pass
    for (int part = 0; part < 6; ++part)
      EXPECT_NEAR(wrenches.part(1, static_cast<lang::WrenchPart>(part)), part == row ? 1.0 : 0.0, 1e-4)
          << row << " " << part;
  }
}

}  // namespace
}  // namespace zwang::runtime
