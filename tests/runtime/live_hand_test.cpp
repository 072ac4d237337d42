// Requests of the live page to its hand: what is good is done, all else is refused and changes nothing.
#include "live_hand.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene_program.hpp"

namespace zwang::cli {
namespace {

lang::Program program_with_a_post() {
  return zwang::test::program_in_scene(
      R"(zwang: 1
robot: robots/mecanum_base.yaml
signals: {loaded: {type: bool, stale_after: 1 s}, unseen: {type: bool, stale_after: 1 s}}
start: stand
tasks:
  stand:
    constraints: {stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}}}
    exits: [{when: loaded or unseen, goto: done}]
)",
      R"(objects: {post: {cylinder: {radius: 0.1 m, height: 1 m}, at: [2 m, 0 m], fixed: true}}
signals: {loaded: {script: [[0 s, false]]}}
)");
}

std::string ask(LiveHand& hand, const std::string& request) {
  return hand.obey(nlohmann::json::parse(request));
}

TEST(LiveHand, DoesWhatItIsAskedFor) {
  LiveHand hand(program_with_a_post());
  EXPECT_EQ(ask(hand, R"({"do": "push", "at": [0.1, 0], "force": [30, -40]})"), "");
  EXPECT_EQ(hand.hand().push.force.y(), -40.0);
  EXPECT_EQ(ask(hand, R"({"do": "block", "name": "loaded", "value": true})"), "");
  EXPECT_TRUE(hand.hand().blocked[0]);
  EXPECT_EQ(ask(hand, R"({"do": "fault", "name": "torque.front_left_wheel", "value": "flipped"})"), "");
  EXPECT_EQ(ask(hand, R"({"do": "fault", "name": "payload", "value": 5})"), "");
  EXPECT_EQ(hand.in_force().dump(),
            R"({"blocked":["loaded"],"faults":{"torque.front_left_wheel":"flipped","payload":5.0}})");
  EXPECT_EQ(ask(hand, R"({"do": "fault", "name": "payload", "value": null})"), "");
  EXPECT_EQ(ask(hand, R"({"do": "fault", "name": "torque.front_left_wheel", "value": null})"), "");
  EXPECT_EQ(ask(hand, R"({"do": "block", "name": "loaded", "value": false})"), "");
  EXPECT_EQ(hand.in_force().dump(), R"({"blocked":[],"faults":{}})");
  EXPECT_EQ(ask(hand, R"({"do": "move", "name": "post", "to": [1, 0.5], "yaw": 1.5})"), "");
  EXPECT_EQ(hand.hand().sent, (runtime::SentObject{0, {1.0, 0.5}, 1.5}));
  hand.let_go();
  EXPECT_TRUE(hand.hand().push.force.isZero());
}

TEST(LiveHand, RefusesAllElse) {
  LiveHand hand(program_with_a_post());
  const std::string before = hand.in_force().dump();
  for (const char* request : {
           R"({"do": "push", "at": [0, 0], "force": [600, 0]})",
           R"({"do": "push", "at": [9, 0], "force": [1, 0]})",
           R"({"do": "push", "at": [0, 0], "force": ["1", 0]})",
           R"({"do": "push"})",
           R"({"do": "block", "name": "unseen", "value": true})",
           R"({"do": "block", "name": "", "value": true})",
           R"({"do": "block", "name": "loaded", "value": 1})",
           R"({"do": "fault", "name": "samples", "value": "late"})",
           R"({"do": "fault", "name": "samples", "value": 1})",
           R"({"do": "fault", "name": "payload", "value": 1e9})",
           R"({"do": "fault", "name": "payload", "value": "none"})",
           R"({"do": "fault", "name": 7, "value": null})",
           R"({"do": "fault"})",
           R"({"do": "move", "name": "wall", "to": [0, 0], "yaw": 0})",
           R"({"do": "move", "name": "post", "to": [0, 1e6], "yaw": 0})",
           R"({"do": "move", "name": "post", "to": [0], "yaw": 0})",
           R"({"do": "move", "name": "post", "to": [0, 0]})",
       }) {
    EXPECT_NE(ask(hand, request), "") << request;
  }
  EXPECT_EQ(hand.in_force().dump(), before);
  EXPECT_EQ(hand.hand().sent, runtime::SentObject{});
  EXPECT_TRUE(hand.hand().push.force.isZero());
  // Requests of other parts of the page are not its own.
  EXPECT_EQ(ask(hand, R"({"do": "pause"})"), "");
  EXPECT_EQ(ask(hand, R"([1])"), "");
}

TEST(LiveHand, TellsWhatItCanDo) {
  const auto choices = LiveHand(program_with_a_post()).choices();
  EXPECT_EQ(choices["signals"].dump(), R"(["loaded"])");
  EXPECT_EQ(choices["objects"].dump(), R"(["post"])");
  EXPECT_EQ(choices["faults"][0].dump(),
            R"({"name":"samples","words":["none","lost","nan","inf","huge","frozen","dead"]})");
}

}  // namespace
}  // namespace zwang::cli
