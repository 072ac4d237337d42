// Runs that do not reach `done`, and the sentence that names the reason of each.
#include "zwang/runtime/why.hpp"

#include <gtest/gtest.h>

#include "scene_program.hpp"
#include "why_run.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

TEST(Why, ARunThatIsDoneHasNone) {
  const Ended ended = run(std::string(drive_ahead) + R"(
    exits:
      - {when: elapsed > 0.1 s, goto: done}
)",
                          open_floor);
  EXPECT_EQ(ended.state, RunState::done);
  EXPECT_FALSE(ended.why);
}

TEST(Why, ALostPartner) {
  const Ended ended = run(R"(
signals: {partner: {type: pose, in: base_link, stale_after: 300 ms}}
frames: {socket: {parent: partner}}
start: align
tasks:
  align:
    constraints:
      line: {move: base_link, in: socket, x: {position: 0 m}, y: {position: 0 m}, rz: {position: 0 rad}}
    exits:
      - {when: abs(line.x.position) < 2 cm and abs(line.y.position) < 8 mm, for: 0.5 s, goto: done}
    timeout: {after: 0.4 s, goto: failed}
)",
                          wall("3 m") + "signals: {partner: {pose_of: door, dropouts: 99.99 %}}\n");
  EXPECT_EQ(ended.sentence().find("`partner` was never received; `align` waited"), 0u) << ended.sentence();
  expect_words(ended, {"`align` waited 0.400 s, its timeout (task.yaml:",
                       "`abs(line.x.position) < 2 cm` and "
                       "`abs(line.y.position) < 8 mm` are unknown without `partner`"});
  ASSERT_TRUE(ended.why);
  EXPECT_EQ(ended.why->cause, WhyCause::timeout);
  ASSERT_EQ(ended.why->waited.exits.size(), 1u);
  const WaitedExit& exit = ended.why->waited.exits[0];
  EXPECT_EQ(exit.column, "align.exit1.true_for");
  EXPECT_EQ(exit.verdict, Verdict::unknown);
  ASSERT_EQ(exit.terms.size(), 2u);
  ASSERT_EQ(exit.terms[0].signals.size(), 1u);
  EXPECT_FALSE(exit.terms[0].signals[0].received);
  EXPECT_NEAR(exit.terms[0].signals[0].age, 0.4, 1e-9);
  EXPECT_EQ(exit.terms[0].signals[0].stale_after, 0.3);
}

TEST(Why, ABlockedDoor) {
  const Ended ended = run(R"(
start: go
tasks:
  go:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: 0.3 m/s, force: +-25 N}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: moved(base_link) > 1 m, goto: done}
    timeout: {after: 2 s, goto: failed}
)",
                          wall("0.6 m"));
  expect_words(ended, {"`go` waited 2.000 s, its timeout", "`moved(base_link) > 1 m` is false (0.1",
                       " m for at least ", "`go.go.x.nu` was at its limit, 25.00 N"});
  EXPECT_EQ(ended.sentence().find("too short"), std::string::npos) << "more time would not open the door";
}

TEST(Why, TheNoteComesFirst) {
  const std::string standing = R"(
start: wait
tasks:
  wait:
    constraints: {stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
)";
  const Ended left =
      run(standing + "    exits: [{when: elapsed > 0.1 s, goto: failed, note: nobody came}]\n", open_floor);
  EXPECT_EQ(left.sentence().find("nobody came: `wait` was ended by the exit `elapsed > 0.1 s`"), 0u);
  const Ended late =
      run(standing + "    timeout: {after: 0.1 s, goto: failed, note: the door is shut}\n", open_floor);
  EXPECT_EQ(late.sentence().find("the door is shut: `wait` waited 0.1"), 0u) << late.sentence();
  const Ended tried = run(standing + "    timeout: {after: 0.1 s, goto: again}\n" + R"(  again:
    timeout: {after: 0.1 s, goto: wait}
    exits: [{when: speed(base_link) > 10 cm/s, goto: done}]
    constraints: {stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
    attempts: {max: 1, goto: failed, note: twice in vain}
)",
                          open_floor);
  EXPECT_EQ(tried.sentence().find("twice in vain: `wait` led to `again`"), 0u) << tried.sentence();
}

TEST(Why, ADeadScanner) {
  const Ended ended =
      run(R"(
signals: {nearest: {type: number, unit: m, stale_after: 200 ms}}
always:
  exits:
    - {when: nearest < 1.2 m, goto: failed}
start: go
tasks:
  go:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: 0.3 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: moved(base_link) > 1 m, goto: done}
    timeout: never
)",
          std::string(open_floor) + "signals: {nearest: {script: [[0 s, 5 m], [0.3 s, lost]]}}\n");
  EXPECT_EQ(ended.sentence().find("`nearest` fell silent: it came last 0.20"), 0u) << ended.sentence();
  expect_words(ended, {"ago and counts for 0.200 s; `go` was ended by the exit `nearest < 1.2 m` (task.yaml:",
                       "of `always`, which fires when it is unknown", "`moved(base_link) > 1 m` is false"});
  EXPECT_EQ(ended.why->cause, WhyCause::always);
}

TEST(Why, AWallThatGivesWay) {
  const Ended ended = run(R"(
start: press
tasks:
  press:
    constraints:
      contact: {move: base_link, in: base_link, x: {force: 30 N, velocity: +-0.2 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: moved(base_link) > 0.5 m, goto: failed}
      - {when: abs(contact.x.velocity) < 1 mm/s and elapsed > 1 s, for: 1 s, goto: done}
    timeout: {after: 20 s, goto: failed}
)",
                          wall("0.46 m", "mass: 3 kg, friction: 0"));
  expect_words(ended, {"`press` was ended by the exit `moved(base_link) > 0.5 m` (task.yaml:", "): 0.50"});
  EXPECT_EQ(ended.why->cause, WhyCause::exit);
}

void expect_a_motor_is_named(const std::string& fault, const std::string& what) {
  const Ended ended = run(
      std::string(drive_ahead) + R"(
    exits:
      - {when: moved(base_link) > 1 m, goto: done}
    timeout: never
)",
      std::string(open_floor) + "faults: [{at: 0.1 s, wheel: front_left_wheel, torque: " + fault + "}]\n");
  EXPECT_EQ(ended.state, RunState::stopped) << fault;
  expect_words(ended, {"the protective stop latched in `go`: " + what + " (`front_left_wheel",
                       "which waited: `moved(base_link) > 1 m` is false"});
  ASSERT_TRUE(ended.why) << fault;
  EXPECT_EQ(ended.why->cause, WhyCause::stopped) << fault;
}

TEST(Why, AStuckMotor) {
  expect_a_motor_is_named("stuck", "a motor's torque does not follow its command");
}

TEST(Why, AFlippedMotor) {
  expect_a_motor_is_named("flipped", "a motor turns the wrong way");
}

TEST(Why, Ice) {
  const Ended ended =
      run(std::string(drive_ahead) + R"(
    exits:
      - {when: moved(base_link) > 0.3 m, goto: done}
    timeout: {after: 1 s, goto: failed}
)",
          std::string(open_floor) + "state: perfect\nfaults: [{at: 0 s, for: 10 s, floor_friction: 0.01}]\n");
  EXPECT_EQ(ended.sentence().find("wheels slid over the floor by 0."), 0u) << ended.sentence();
  expect_words(ended,
               {" m in all, from 0.1", " s on; `go` waited", "`moved(base_link) > 0.3 m` is false (0.0"});
}

TEST(Why, ABounceInterruptsWhatMustHold) {
  const Ended ended = run(R"(
start: press
tasks:
  press:
    constraints:
      contact: {move: base_link, in: base_link, x: {force: 20 N, velocity: +-0.2 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: contact.x.velocity > 0.02 m/s and elapsed > 0.1 s, for: 5 s, goto: done}
    timeout: {after: 3 s, goto: failed}
)",
                          wall("0.6 m"));
  expect_words(ended, {"`contact.x.velocity > 0.02 m/s` is false (", " after it was true ",
                       " of the 5.000 s that it must hold"});
  EXPECT_EQ(ended.sentence().find("too short"), std::string::npos) << "it comes and goes";
}

TEST(Why, AnExitThatIsNeverTrue) {
  const Ended ended = run(R"(
signals: {level: {type: number, unit: m, stale_after: 1 s}}
start: wait
tasks:
  wait:
    constraints:
      still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: level > 10 m, goto: done}
    timeout: {after: 0.2 s, goto: failed}
)",
                          std::string(open_floor) + "signals: {level: {script: [[0 s, 3 m]]}}\n");
  expect_words(ended, {"`level > 10 m` is false (3.000 m all the time)"});
}

TEST(Why, ATimeoutThatIsTooShort) {
  const Ended ended = run(std::string(drive_ahead) + R"(
    exits:
      - {when: moved(base_link) > 2 m, goto: done}
    timeout: {after: 4 s, goto: failed}
)",
                          open_floor);
  expect_words(ended, {"`go` waited 4.000 s, its timeout", ", too short by about ",
                       " s at its pace: `moved(base_link) > 2 m` is false (1.0"});
  // 0.3 m/s, and less while the base gathers speed: (2 m - the way so far) / (0.3 m/s).
  ASSERT_TRUE(ended.why);
  const WaitedTerm& term = ended.why->waited.exits.at(0).terms.at(0);
  ASSERT_TRUE(term.left && term.value);
  EXPECT_NEAR(*term.left, (2.0 - *term.value) / 0.3, 0.05);
}

// The base drives along its own axes; the exit looks at it from a frame that stands elsewhere.
TEST(Why, AWrongFrame) {
  const Ended ended = run(R"(
frames: {shelf: {parent: world, at: [0 m, 4 m]}}
start: go
tasks:
  go:
    constraints:
      go: {move: base_link, in: world, x: {position: 0.05 m}, y: {position: 0 m}, rz: {position: 0 rad}}
      seen: {move: base_link, in: shelf, z: free, x: {velocity: +-1 m/s}, y: {velocity: +-1 m/s}}
    exits:
      - {when: abs(seen.y.position) < 5 cm and abs(go.x.position) < 0.2 m, for: 0.1 s, goto: done}
    timeout: {after: 0.5 s, goto: failed}
)",
                          open_floor);
  expect_words(ended,
               {"`abs(seen.y.position) < 5 cm` is false (4.000 m all the time; `seen.y` of `base_link` in "
                "`shelf` is driven by no row)"});
  EXPECT_EQ(ended.sentence().find("go.x.position"), std::string::npos) << "a term that holds is no reason";
}

// Held by the boundary, the driver presses with all of its range: the boundary is the reason.
TEST(Why, ABoundaryThatADriverPressesAgainst) {
  const Ended ended = run(R"(
regions: {room: {polygon: [[-1 m, -1 m], [0.6 m, -1 m], [0.6 m, 1 m], [-1 m, 1 m]]}}
always:
  constraints:
    fence: {move: footprint, inside: room, margin: 5 cm}
start: go
tasks:
  go:
    constraints:
      go: {move: base_link, in: world, x: {position: 2 m, velocity: +-0.3 m/s, force: +-30 N}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: go.x.position > 1.9 m, goto: done}
    timeout: {after: 4 s, goto: failed}
)",
                          open_floor);
  expect_words(ended,
               {"`always.fence.left` was at its limit, 0.050 m, which keeps `footprint` inside `room`"});
}

TEST(Why, ABoundaryThatTheGoalLiesBehind) {
  const Ended ended = run(R"(
regions: {room: {polygon: [[-1 m, -1 m], [0.6 m, -1 m], [0.6 m, 1 m], [-1 m, 1 m]]}}
always:
  constraints:
    fence: {move: footprint, inside: room, margin: 5 cm}
start: go
tasks:
  go:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: 0.3 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: moved(base_link) > 1 m, goto: done}
    timeout: {after: 3 s, goto: failed}
)",
                          open_floor);
  expect_words(ended,
               {"`moved(base_link) > 1 m` is false (0.",
                "`always.fence.left` was at its limit, 0.050 m, which keeps `footprint` inside `room`"});
}

Ended stands_outside(const std::string& region) {
  return run("\nregions: {room: " + region + R"(}
always:
  constraints:
    fence: {move: base_link, inside: room, margin: 5 cm}
start: wait
tasks:
  wait:
    constraints:
      still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: moved(base_link) > 1 m, goto: done}
    timeout: {after: 0.1 s, goto: failed}
)",
             "start: {at: [2 m, 0 m]}\nfloor: {friction: 0.9}\n");
}

// Both regions end at x = 0.6 m, and the base stands at 2 m: 1.4 m outside of them.
/// A robot's clock counts from 1970 on. The sample of 0.5 s does not come.
TEST(Why, TellsTimesSinceTheRunBegan) {
  const lang::Program program =
      zwang::test::program_in_scene(("zwang: 1\nrobot: robots/mecanum_base.yaml\n" +
                                     std::string(drive_ahead) + "    timeout: {after: 1 s, goto: failed}\n")
                                        .c_str(),
                                    open_floor);
  ScenePlant plant(program, {});
  Runner runner(program);
  Sensed sensed(program);
  for (int tick = 0; !runner.finished() && tick < 5000; ++tick) {
    if (tick != 500) {
      plant.sense(sensed);
      sensed.time += 1'795'782'845.0;
    }
    if (plant.apply(runner.step(sensed)) != PlantStatus::ok) break;
  }
  ASSERT_EQ(runner.state(), RunState::failed);
  EXPECT_NE(runner.why()->sentence.find("the guard told at 0.500 s: no sample arrived"), std::string::npos)
      << runner.why()->sentence;
}

TEST(Why, ARegionThatIsLeft) {
  Ended ended = stands_outside("{polygon: [[-1 m, -1 m], [0.6 m, -1 m], [0.6 m, 1 m], [-1 m, 1 m]]}");
  expect_words(ended,
               {"`base_link` stood outside of the region `room` by 1.400 m, from the start; `wait` waited",
                "`always.fence.left` stood at -1.",
                ", beyond its limit of 0.050 m, which keeps `base_link` inside `room`"});
  ended = stands_outside("{circle: {at: [0 m, 0 m], radius: 0.6 m}}");
  expect_words(ended, {"`base_link` stood outside of the region `room` by 1.400 m, from the start",
                       ", beyond its limit of 0.550 m"});
}

}  // namespace
}  // namespace zwang::runtime
