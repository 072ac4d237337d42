// A pose signal with a twist goes on between two samples.
#include <gtest/gtest.h>

#include <cmath>

#include "schedule/pose_line.hpp"
#include "scheduler_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;
using solver::Vector3;

solver::Pose turned(double yaw, double x, double y) {
  return {solver::rotation_from_rpy(0.0, 0.0, yaw), {x, y, 0.0}};
}

/// Even motion along x and a turn.
solver::Pose on_its_way(double time) {
  return turned(0.4 + 0.5 * time, 1.0 + 0.3 * time, 2.0 - 0.2 * time);
}

TEST(PoseLine, IsTheMotionOfWhatMovesEvenly) {
  PoseLine line(0.5);
  for (int i = 0; i <= 20; ++i) line.add(0.066 * i, on_its_way(0.066 * i));
  const solver::FrameMotion now = line.at_newest();
  EXPECT_NEAR((now.linear - Vector3(0.3, -0.2, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((now.angular - Vector3(0.0, 0.0, 0.5)).norm(), 0.0, 1e-12);
  const solver::FrameMotion later = carried_on(now, 0.1);
  const solver::Pose expected = on_its_way(20 * 0.066 + 0.1);
  EXPECT_NEAR((later.pose.position - expected.position).norm(), 0.0, 1e-12);
  EXPECT_NEAR((later.pose.rotation - expected.rotation).norm(), 0.0, 1e-12);
}

// n samples at even steps dt with noise s leave a slope of s sqrt(12/(n (n^2 - 1)))/dt.
TEST(PoseLine, SmoothsWhatIsMeasured) {
  constexpr double dt = 1.0 / 15.0, noise = 2e-3;
  constexpr int n = 8;
  double sum = 0.0;
  unsigned int state = 1;
  const auto random = [&] {  // of variance 1
    double value = 0.0;
    for (int i = 0; i < 12; ++i)
      value += static_cast<double>((state = 1664525u * state + 1013904223u) >> 8) / (1 << 24);
    return value - 6.0;
  };
  constexpr int runs = 400;
  for (int run = 0; run < runs; ++run) {
    PoseLine line((n - 0.5) * dt);
    for (int i = 0; i < n; ++i) line.add(i * dt, turned(0.0, 0.3 * i * dt + noise * random(), 0.0));
    sum += std::pow(line.at_newest().linear.x() - 0.3, 2.0);
  }
  const double expected = noise * std::sqrt(12.0 / (n * (n * n - 1.0))) / dt;
  EXPECT_NEAR(std::sqrt(sum / runs), expected, 0.15 * expected);
}

TEST(PoseLine, StandsUntilItsSamplesCoverHalfOfItsTime) {
  PoseLine line(0.5);
  for (int i = 0; i <= 2; ++i) line.add(0.1 * i, on_its_way(0.1 * i));
  EXPECT_TRUE(line.at_newest().linear.isZero());
  EXPECT_EQ(line.at_newest().pose.position, on_its_way(0.2).position);
  line.add(0.3, on_its_way(0.3));
  EXPECT_NEAR(line.at_newest().linear.x(), 0.3, 1e-12);
}

// Samples of every tick are more than it remembers.
TEST(PoseLine, RemembersItsTimeHoweverManySamplesCome) {
  PoseLine line(0.5);
  for (int i = 0; i <= 2000; ++i) line.add(1e-3 * i, on_its_way(1e-3 * i));
  EXPECT_NEAR(line.at_newest().linear.x(), 0.3, 1e-12);
  EXPECT_NEAR((line.at_newest().pose.position - on_its_way(2.0).position).norm(), 0.0, 1e-12);
}

/// A base that stands, and glides in the frame of a pose signal with a twist.
lang::Program following(lang::SignalTwist twist) {
  lang::Program p =
      program({task("follow", {drive("follow.x", Axis::x, Quantity::position, -0.9)}, base_link, 3)});
  p.signals = {{.name = "guide", .type = lang::SignalType::pose, .stale_after = {.constant = 0.3}}};
  p.signals[0].twist = twist;
  p.signals[0].twist_window = 0.5;
  lang::FrameDeclaration person;
  person.name = "person";
  person.parent = lang::FrameParent::signal;
  person.parent_index = 0;
  p.frames.push_back(person);
  return p;
}

/// At 15 Hz, 60 ms late.
void see_at(Bench& bench, double& last) {
  const double stamp = bench.sensed.time - 0.06;
  if (stamp < last + 1.0 / 15.0) return;
  last = stamp;
  SignalSample& sample = bench.sensed.signals[0];
  sample.valid = true;
  sample.stamp = stamp;
  sample.pose = on_its_way(stamp);
  sample.twist = solver::MotionVector{{0.0, 0.0, 0.5}, {0.3, -0.2, 0.0}};  // in world axes: `in` is the world
}

TEST(Course, BringsTheFrameToWhereTheTargetIs) {
  for (const lang::SignalTwist twist : {lang::SignalTwist::fitted, lang::SignalTwist::measured}) {
    Bench bench(following(twist));
    double last = -1.0;
    for (int i = 0; i < 1200; ++i) {
      see_at(bench, last);
      const double now = bench.sensed.time;
      bench.tick();
      if (i < 600) continue;
      const solver::AttachedFrame& in = bench.constraint(0).in;
      EXPECT_NEAR((in.pose.position - on_its_way(now).position).norm(), 0.0, 1e-9);
      EXPECT_NEAR((in.pose.rotation - on_its_way(now).rotation).norm(), 0.0, 1e-9);
      // Velocities count against it: along its x, of the base's origin seen from the turning frame.
      const Vector3 v = in.pose.rotation.transpose() * Vector3(0.3, -0.2, 0.0);
      EXPECT_NEAR((in.twist.linear - v).norm(), 0.0, 1e-9);
      EXPECT_NEAR(in.twist.angular.z(), 0.5, 1e-9);
    }
  }
}

TEST(Course, EndsWhereTheSignalIsLost) {
  Bench bench(following(lang::SignalTwist::fitted));
  double last = -1.0;
  for (int i = 0; i < 900; ++i) {
    see_at(bench, last);
    bench.tick();
  }
  // It stays known for 0.3 s after its last sample, goes on for as long, and then stands.
  const double lost = last + 0.3;
  solver::AttachedFrame at_loss;
  for (int i = 0; i < 500; ++i) {
    const double now = bench.sensed.time;
    bench.tick();
    const solver::AttachedFrame& in = bench.constraint(0).in;
    if (now < lost - period) {
      EXPECT_NEAR((in.pose.position - on_its_way(now).position).norm(), 0.0, 1e-9);
      at_loss = in;
    } else if (now > lost + 2 * period) {
      EXPECT_NEAR((in.pose.position - at_loss.pose.position).norm(), 0.0, 2e-3);
      EXPECT_TRUE(in.twist.linear.isZero());
      EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::velocity);
    }
  }
}

// A correction by a sample is no motion of the frame, what it does between them is.
TEST(Course, CountsForMoved) {
  lang::Program p = following(lang::SignalTwist::fitted);
  p.tasks[0].exits = {exit(when(apply(Op::greater, call("moved", 3), number(0.36))), to_done)};
  Bench bench(std::move(p));
  double last = -1.0;
  double at = 0.0;
  for (int i = 0; i < 3000 && bench.scheduler.outcome() == Outcome::none; ++i) {
    see_at(bench, last);
    at = bench.sensed.time;
    bench.tick();
  }
  // It knows how the target moves once the samples cover 0.25 s, from then on at 0.36 m/s.
  EXPECT_NEAR(at, 0.06 + 0.25 + 1.0, 0.1);
}

}  // namespace
}  // namespace zwang::runtime
