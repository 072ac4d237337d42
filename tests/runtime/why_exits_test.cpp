// The sentence of a run that ends by its own exits: attempts, a pose that never came, an end from outside.
#include "why_run.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

TEST(Why, AttemptsThatAreUsedUp) {
  const Ended ended = run(R"(
start: look
tasks:
  look:
    attempts: {max: 2, goto: failed}
    constraints:
      still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: moved(base_link) > 1 m, goto: done}]
    timeout: {after: 0.1 s, goto: again}
  again:
    constraints:
      still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 0.1 s, goto: look}]
    timeout: never
)",
                          open_floor);
  expect_words(
      ended,
      {"`again` led to `look` by `elapsed > 0.1 s`, which had been entered 2 times, all its attempts"});
  EXPECT_EQ(ended.why->cause, WhyCause::attempts);
}

TEST(Why, ASetFromAPoseThatNeverCame) {
  const Ended ended = run(R"(
signals: {partner: {type: pose, in: base_link, stale_after: 300 ms}}
frames: {socket: {parent: partner}, goal: {parent: world}}
start: look
tasks:
  look:
    constraints:
      still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 0.1 s, set: {frames.goal: socket}, goto: go}]
    timeout: never
  go:
    constraints:
      line: {move: base_link, in: goal, x: {position: 0 m}, y: {position: 0 m}, rz: {position: 0 rad}}
    exits: [{when: line.x.position < 1 cm, for: 0.1 s, goto: done}]
    timeout: {after: 10 s, goto: failed}
)",
                          wall("3 m") + "signals: {partner: {pose_of: door, dropouts: 99.99 %}}\n");
  expect_words(ended, {"`look` led to `go` by `elapsed > 0.1 s`, on the way a frame is set (task.yaml:",
                       "which needs the pose of `socket`: it is not known"});
  EXPECT_EQ(ended.why->cause, WhyCause::set);
}

// The way into a task that leads nowhere else decides, not the last step of that way.
TEST(Why, TheTurnAndNotTheRetreat) {
  const Ended ended = run(R"(
start: look
tasks:
  look:
    constraints:
      still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: moved(base_link) > 1 m, goto: done}]
    timeout: {after: 0.1 s, goto: retreat}
  retreat:
    constraints:
      back: {move: base_link, in: base_link, x: {velocity: -0.1 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 0.2 s, goto: failed}]
    timeout: never
)",
                          open_floor);
  expect_words(ended, {"`look` waited 0.100 s, its timeout"});
  EXPECT_NEAR(ended.why->time, 0.1, 1e-9);
}

// A patrol has no way to `done`: what it did last is no reason, and it is not over.
TEST(Why, APatrolThatIsEndedFromOutsideWaits) {
  const Ended ended = run(R"(
start: there
tasks:
  there:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: 0.1 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 0.1 s, goto: back_again}]
    timeout: never
  back_again:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: -0.1 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: moved(base_link) > 5 m, goto: there}]
    timeout: never
)",
                          open_floor, 0.3);
  EXPECT_EQ(ended.state, RunState::running);
  ASSERT_TRUE(ended.why);
  EXPECT_EQ(ended.why->cause, WhyCause::waiting);
  expect_words(ended, {"`back_again` still waits after 0.", "`moved(base_link) > 5 m` is false (0."});
}

// Wheels slide on ice before the samples go bad. The guard's messages before its stop stand before the stop.
TEST(Why, WhatWasToldBeforeTheStopStandsBeforeIt) {
  const Ended ended =
      run(std::string(drive_ahead) + R"(
    exits:
      - {when: moved(base_link) > 3 m, goto: done}
    timeout: never
)",
          std::string(open_floor) +
              "state: perfect\nfaults: [{at: 0 s, floor_friction: 0.01}, {at: 1 s, samples: nan}]\n");
  ASSERT_EQ(ended.state, RunState::stopped);
  EXPECT_EQ(ended.sentence().find("wheels slid over the floor by "), 0u) << ended.sentence();
  EXPECT_LT(ended.sentence().find("wheels slid over the floor"),
            ended.sentence().find("; then the protective stop latched in `go`: "))
      << ended.sentence();
}

TEST(Why, ARunThatIsEndedFromOutsideStillWaits) {
  const Ended ended = run(std::string(drive_ahead) + R"(
    exits:
      - {when: not moved(base_link) < 1 m, goto: done}
    timeout: never
)",
                          open_floor, 0.3);
  EXPECT_EQ(ended.state, RunState::running);
  expect_words(ended, {"`go` still waits after 0.2", "`moved(base_link) < 1 m` is true (0."});
}

}  // namespace
}  // namespace zwang::runtime
