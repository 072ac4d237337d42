// Each test is a sentence about signals: of the task language's sections "Geometry, once" and "The
// scheduler".
#include "scheduler_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;
using lang::SignalType;

constexpr int partner_frame = 3;
constexpr int socket_frame = 4;  ///< hangs on `partner`, 0.5 m behind it

/// A base that glides along the frame of a pose signal, seen from itself.
lang::Program docking(const std::vector<AxisStatements>& axes, double stale_after = 0.05) {
  lang::Program p = program({task("glide", axes, base_link, socket_frame)});
  p.signals = {signal("partner", SignalType::pose, stale_after)};
  p.signals[0].in = base_link;
  lang::FrameDeclaration partner, socket;
  partner.name = "partner";
  partner.parent = lang::FrameParent::signal;
  partner.parent_index = 0;
  socket.name = "socket";
  socket.parent = lang::FrameParent::frame;
  socket.parent_index = partner_frame;
  socket.pose.position = {-0.5, 0, 0};
  p.frames.push_back(partner);
  p.frames.push_back(socket);
  return p;
}

AxisStatements to_socket() {
  AxisStatements a = drive("glide.x", Axis::x, Quantity::position, 0.0);
  a.force = between(-30, 40);
  return a;
}

void see(Bench& bench, const solver::Pose& pose, double stamp) {
  bench.sensed.signals[0].valid = true;
  bench.sensed.signals[0].stamp = stamp;
  bench.sensed.signals[0].pose = pose;
}

TEST(PoseSignal, BecomesAWorldPoseAtItsStamp) {
  // The base drives along x at 1 m/s and turns at 1 rad/s; what it sees 20 ms late stands still.
  Bench bench(docking({to_socket()}));
  const solver::Pose object{solver::rotation_from_rpy(0, 0, 0.3), {2.0, 1.0, 0.0}};
  const auto base_at = [](double t) {
    return solver::Pose{solver::rotation_from_rpy(0, 0, t), {t, 0.0, 0.0}};
  };
  const double delay = 0.0205;  // between two ticks
  for (int i = 0; i < 200; ++i) {
    const double t = bench.sensed.time;
    bench.sensed.state.base_pose = base_at(t);
    if (t > delay) see(bench, base_at(t - delay).inverse() * object, t - delay);
    bench.tick();
    if (t <= delay) continue;
    const solver::Pose& in = bench.constraint(0).in.pose;
    const solver::Vector3 socket = object * solver::Vector3(-0.5, 0, 0);
    EXPECT_EQ(bench.constraint(0).in.body, -1);
    // The base's path between two ticks is taken as straight: off by (w dt)^2 v/8 at most.
    EXPECT_LT((in.position - socket).norm(), 1e-6);
    EXPECT_LT((in.rotation - object.rotation).norm(), 1e-6);
  }
}

TEST(PoseSignal, StaysFixedInTheWorldBetweenSamples) {
  Bench bench(docking({to_socket()}));
  see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, 0.0);
  for (int i = 0; i < 40; ++i) {
    bench.sensed.state.base_pose.position.x() = 0.01 * i;
    bench.tick();
    EXPECT_EQ(bench.constraint(0).in.pose.position.x(), 1.5);
    EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::position);
  }
}

TEST(PoseSignal, WhoseRotationIsNoneDidNotCome) {
  Bench bench(docking({to_socket()}));
  see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, 0.0);
  bench.tick();
  see(bench, {1.1 * solver::Matrix3::Identity(), {3.0, 0.0, 0.0}}, bench.sensed.time);
  bench.tick();
  EXPECT_EQ(bench.constraint(0).in.pose.position.x(), 1.5);
  see(bench, {solver::Matrix3::Identity(), {3.0, 0.0, 0.0}}, bench.sensed.time);
  bench.tick();
  EXPECT_EQ(bench.constraint(0).in.pose.position.x(), 2.5);
}

TEST(PoseSignal, HasNoVelocityUnlessItCarriesATwist) {
  Bench bench(docking({to_socket()}));
  // Seen turned by 90 deg: its x is the base's y. It moves along the base's x at 0.2 m/s and turns.
  const solver::Pose seen{solver::rotation_from_rpy(0, 0, std::numbers::pi / 2), {2.0, 0.0, 0.0}};
  see(bench, seen, 0.0);
  bench.tick();
  EXPECT_EQ(bench.scheduler.constraints().coordinates()[0].velocity, 0.0);
  see(bench, seen, bench.sensed.time);
  bench.sensed.signals[0].twist = solver::MotionVector{{0, 0, 0.1}, {0.2, 0.3, 0}};
  bench.tick();
  // The velocity is along the socket's x, which is the base's y. The standing base moves against the socket
  // with minus the socket's velocity at the base's origin: v + w x r, r = (-2, 0).
  EXPECT_NEAR(bench.scheduler.constraints().coordinates()[0].velocity, -(0.3 + 0.1 * -2.0), 1e-12);
}

TEST(PoseSignal, WhileInvalidMotionRowsInItsFrameStandStillWithTheSameForceRange) {
  AxisStatements pace = drive("glide.y", Axis::y, Quantity::velocity, 0.3);
  pace.force = between(-5, 6);
  AxisStatements push = drive("glide.rz", Axis::rz, Quantity::force, 2.0);
  push.velocity = between(-0.1, 0.2);
  Bench bench(docking({to_socket(), pace, push}, 0.010));
  see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, 0.0);
  bench.ticks_more(11);
  EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::position);
  EXPECT_EQ(bench.constraint(1).driver->target, 0.3);
  bench.tick();
  EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::velocity);
  EXPECT_EQ(bench.constraint(0).driver->target, 0.0);
  EXPECT_EQ(bench.constraint(0).driver->force.low, -30.0);
  EXPECT_EQ(bench.constraint(0).driver->force.high, 40.0);
  EXPECT_EQ(bench.constraint(1).driver->target, 0.0);
  EXPECT_EQ(bench.constraint(1).driver->force.high, 6.0);
  EXPECT_EQ(bench.constraint(2).driver->quantity, Quantity::force);
  EXPECT_EQ(bench.constraint(2).driver->target, 2.0) << "a force row is no motion row";
  ASSERT_TRUE(bench.constraint(2).velocity);
  EXPECT_EQ(bench.constraint(2).velocity->low, 0.0);
  EXPECT_EQ(bench.constraint(2).velocity->high, 0.0);
  see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, bench.sensed.time);
  bench.tick();
  EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::position);
  EXPECT_EQ(bench.constraint(1).driver->target, 0.3);
  EXPECT_EQ(bench.constraint(2).velocity->high, 0.2);
}

TEST(PoseSignal, WhileInvalidABoundaryThatItMovesAllowsNoMotion) {
  lang::Program p = docking({to_socket()}, 0.010);
  lang::Region yard;
  yard.name = "yard";
  yard.polygon = {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
  yard.parent = socket_frame;
  p.regions = {yard};
  lang::Group boundary;
  boundary.name = "boundary";
  boundary.kind = lang::GroupKind::inside;
  boundary.region = 0;
  boundary.moves_footprint = true;
  boundary.move = base_link;
  boundary.level = 0;
  p.always.groups = {boundary};
  Bench bench(p);
  see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, 0.0);
  bench.ticks_more(11);
  EXPECT_EQ(bench.count(), 1) << "far from every edge";
  bench.tick();
  ASSERT_EQ(bench.count(), 2);
  int found = 0;
  for (int i = 0; i < 2; ++i) {
    const InForce& source = bench.scheduler.in_force()[static_cast<std::size_t>(i)];
    if (source.origin.task != bench.scheduler.always_task()) continue;
    ++found;
    EXPECT_EQ(bench.constraint(i).measure, solver::Measure::speed);
    EXPECT_EQ(bench.constraint(i).level, 0);
    ASSERT_TRUE(bench.constraint(i).velocity);
    EXPECT_LE(bench.constraint(i).velocity->high, 0.001);
  }
  EXPECT_EQ(found, 1);
  see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, bench.sensed.time);
  bench.tick();
  EXPECT_EQ(bench.count(), 1);
}

TEST(PoseSignal, WhileInvalidASpringInItsFrameStandsStillToo) {
  AxisStatements spring = to_socket();
  spring.stiffness = lang::Value{.constant = 200.0};
  spring.damping = lang::Value{.constant = 50.0};
  Bench bench(docking({spring}, 0.010));
  see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, 0.0);
  bench.ticks_more(11);
  EXPECT_TRUE(bench.constraint(0).driver->makes_force());
  bench.tick();
  EXPECT_FALSE(bench.constraint(0).driver->makes_force());
  EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::velocity);
  EXPECT_EQ(bench.constraint(0).driver->target, 0.0);
  EXPECT_EQ(bench.constraint(0).driver->force.high, 40.0);
}

/// From the task "wait" to the task "go", which drives in `goal`; `goal` is set from `socket` by the exit or
/// on entry.
lang::Program with_goal(bool on_entry, const lang::Target& target) {
  lang::Program p = docking({to_socket()}, 0.010);
  p.frames.push_back({.name = "goal"});
  constexpr int goal = socket_frame + 1;
  lang::Task go = task("go", {to_socket()}, base_link, goal);
  p.tasks[0].exits = {exit(after(0.003), target)};
  const std::vector<lang::SetAction> set = {{.index = goal, .source = socket_frame}};
  (on_entry ? go.set_on_entry : p.tasks[0].exits[0].set) = set;
  p.tasks.push_back(go);
  return p;
}

TEST(PoseSignal, ASetFromItsFrameWhileItIsUnknownLeadsToFailed) {
  for (const bool on_entry : {false, true}) {
    for (const bool was_seen : {false, true}) {
      Bench bench(with_goal(on_entry, to_task(1)));
      if (was_seen) see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, -0.009);  // stale by then
      bench.sensed.state.base_pose.position.x() = 3.0;
      ASSERT_GT(bench.ticks_to_switch(1), 0) << "the start";
      ASSERT_GT(bench.ticks_to_switch(10), 0);
      EXPECT_EQ(bench.scheduler.outcome(), Outcome::failed);
      const Transition& t = bench.transitions.back();
      EXPECT_EQ(t.refusal, Refusal::set);
      EXPECT_EQ(t.refused, 1);
      EXPECT_EQ(t.unknown_frame, socket_frame);
      EXPECT_NE(bench.scheduler.why(t).find("`go` needs the pose of `socket`, which is not known"),
                std::string::npos)
          << bench.scheduler.why(t);
    }
  }
}

TEST(PoseSignal, ASetFromItsFrameWhileItIsKnownTakesItsPose) {
  for (const bool on_entry : {false, true}) {
    Bench bench(with_goal(on_entry, to_task(1)));
    see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, 0.0);
    bench.ticks_more(6);
    ASSERT_EQ(bench.scheduler.task(), 1);
    EXPECT_NEAR(bench.constraint(0).in.pose.position.x(), 2.0 - 0.5, 1e-12);
  }
}

TEST(PoseSignal, ASetOfAFrameThatHangsOnItWhileItIsUnknownLeadsToFailed) {
  lang::Program p = with_goal(false, to_task(1));
  p.tasks[0].exits[0].set = {{.index = socket_frame, .source = base_link}};
  Bench bench(p);
  bench.ticks_more(6);
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::failed);
  EXPECT_EQ(bench.transitions.back().unknown_frame, socket_frame);
}

TEST(PoseSignal, ASetFromItsFrameDoesNotHinderAnEnd) {
  Bench bench(with_goal(false, to_done));
  bench.ticks_more(6);
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
}

TEST(PoseSignal, ThatNeverCameGivesAForceNoAxis) {
  Bench bench(docking({drive("glide.x", Axis::x, Quantity::force, 20.0)}, 0.010));
  bench.ticks_more(3);
  EXPECT_EQ(bench.constraint(0).driver->target, 0.0);
  see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, bench.sensed.time);
  bench.tick();
  EXPECT_EQ(bench.constraint(0).driver->target, 20.0);
  bench.ticks_more(20);
  EXPECT_EQ(bench.constraint(0).driver->target, 20.0) << "along the axis that was known last";
}

TEST(PoseSignal, SeenFromAFrameThatIsNowhereIsNotSeen) {
  lang::Program p = docking({to_socket()}, 0.050);
  p.signals.push_back(signal("tag", SignalType::pose, 0.050));
  p.signals[1].in = socket_frame;  // of the first signal
  p.tasks[0].exits = {exit(when(name(Op::valid, 1)), to_done, 1e6)};
  Bench bench(p);
  const auto see_tag = [&] {
    bench.sensed.signals[1].valid = true;
    bench.sensed.signals[1].stamp = bench.sensed.time;
  };
  for (int i = 0; i < 5; ++i) {
    see_tag();
    bench.tick();
  }
  EXPECT_FALSE(bench.scheduler.signal_known(1));
  see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, bench.sensed.time);
  bench.tick();
  see_tag();
  bench.tick();
  EXPECT_TRUE(bench.scheduler.signal_known(1));
}

TEST(PoseSignal, HereIsTakenWhenItsFrameIsFirstKnown) {
  AxisStatements hold = to_socket();
  hold.here = true;
  Bench bench(docking({hold}));
  bench.ticks_more(5);
  EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::velocity);
  bench.sensed.state.base_pose.position.x() = 0.25;
  see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, bench.sensed.time);
  bench.tick();
  EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::position);
  EXPECT_NEAR(bench.constraint(0).driver->target, -(2.0 - 0.5), 1e-12) << "behind the socket";
}

TEST(PoseSignal, LossAndReturnAreBlendedLikeASwitch) {
  lang::Program p = docking({to_socket()}, 0.010);
  p.tasks[0].blend.constant = 0.010;
  Bench bench(p);
  for (int i = 0; i < 30; ++i) {
    see(bench, {solver::Matrix3::Identity(), {2.0, 0.0, 0.0}}, bench.sensed.time);
    bench.tick();
  }
  bench.ticks_more(9);
  EXPECT_EQ(bench.scheduler.set_count(), 1);
  bench.tick();
  EXPECT_EQ(bench.scheduler.set_count(), 1) << "10 ms old: not older";
  for (int i = 1; i <= 9; ++i) {
    bench.tick();
    ASSERT_EQ(bench.scheduler.set_count(), 2);
    EXPECT_EQ(bench.scheduler.constraints(1).constraints()[0].driver->quantity, Quantity::position);
    EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::velocity);
    EXPECT_NEAR(bench.scheduler.share(0), 0.1 * i, 1e-9);
  }
}

TEST(PoseSignal, WhatConditionsAskOfItsFrameIsUnknownWhileItIsInvalid) {
  for (const bool by_feature : {false, true}) {
    lang::Program p = docking({to_socket()}, 0.010);
    const Nodes asked =
        by_feature ? call("speed", socket_frame) : coordinate(0, 0, CoordinateQuantity::position);
    const Nodes anything = apply(Op::less, asked, number(1e9));
    p.tasks[0].exits = {exit(when(anything), to_done, 1e6)};
    Bench bench(p);
    bench.ticks_more(2);
    EXPECT_EQ(bench.scheduler.dwell(0), 0.0) << "not received yet";
    see(bench, {}, bench.sensed.time);
    bench.ticks_more(11);
    EXPECT_NEAR(bench.scheduler.dwell(0), 0.011, 1e-12);
    bench.tick();
    EXPECT_EQ(bench.scheduler.dwell(0), 0.0);
  }
}

TEST(PoseSignal, AFrameThatASignalMovesIsTheSameAxesAfterASwitch) {
  lang::Program p = docking({to_socket()});
  lang::Task next = p.tasks[0];
  next.name = "next";
  next.blend.constant = 0.010;
  p.tasks[0].exits = {exit(after(0.005), to_task(1))};
  p.tasks.push_back(next);
  Bench bench(p);
  for (int i = 0; i < 8; ++i) {
    // Noise: never twice at one place.
    see(bench, {solver::Matrix3::Identity(), {2.0 + 0.001 * (i % 3), 0.0, 0.0}}, bench.sensed.time);
    bench.tick();
  }
  ASSERT_EQ(bench.scheduler.task(), 1);
  ASSERT_EQ(bench.count(), 1);
  EXPECT_NEAR(bench.scheduler.in_force()[0].alpha, 1.0, 1e-12) << "the axis is driven throughout";
}

}  // namespace
}  // namespace zwang::runtime
