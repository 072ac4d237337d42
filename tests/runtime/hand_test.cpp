// A hand's action on the simulated world has the same effect as the entry of a scene file.
#include "zwang/runtime/hand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "scene_program.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

constexpr double step = 1e-3;

const char* const watching = R"(zwang: 1
robot: robots/mecanum_base.yaml
signals:
  near: {type: number, unit: m, stale_after: 1 s}
  loaded: {type: bool, stale_after: 1 s}
  unseen: {type: bool, stale_after: 1 s}
start: stand
tasks:
  stand:
    constraints:
      stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: elapsed > 1 s, goto: done}
)";

/// A crate that slides, a fixed post, both out of the way of the base.
const std::string crate_and_post = R"(objects:
  crate: {box: [0.4 m, 0.4 m, 0.5 m], at: [2 m, 0 m], mass: 20 kg}
  post: {cylinder: {radius: 0.1 m, height: 1 m}, at: [0 m, 2 m], fixed: true}
signals:
  near: {distance_to: post}
  loaded: {script: [[0 s, true]]}
)";

lang::Program watching_in(const std::string& scene) {
  return zwang::test::program_in_scene(watching, scene);
}

/// Uneven torques, so that the base goes on a curve.
const Eigen::Vector4d torques(0.3, 0.2, 0.25, 0.1);

template <typename Look>
void go_on(ScenePlant& plant, Sensed& sensed, double seconds, const Eigen::VectorXd& torque,
           const Look& look) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / step)); ++i) {
    const PlantStatus status = plant.sense(sensed);
    look(sensed, status);
    if (plant.apply(torque) != PlantStatus::ok) return;
  }
}
template <typename Look>
void stand(ScenePlant& plant, const lang::Program& program, double seconds, const Look& look) {
  Sensed sensed(program);
  go_on(plant, sensed, seconds, Eigen::Vector4d::Zero(), look);
}
void stand(ScenePlant& plant, const lang::Program& program, double seconds) {
  stand(plant, program, seconds, [](const Sensed&, PlantStatus) {});
}

std::size_t switch_named(const lang::Program& program, const std::string& name) {
  const std::vector<FaultSwitch> switches = fault_switches(program.robot);
  std::size_t place = 0;
  while (place < switches.size() && switches[place].name != name) ++place;
  return place;
}

struct ByHand {
  const char* in_scene;  // behind `at: 0.1 s, for: 0.1 s, `
  const char* name;
  double value;  // the place of the word, or the number
};
class FaultByHand : public testing::TestWithParam<ByHand> {};

// The same run twice: the fault stands in the scene, or a hand puts it on and ends it.
TEST_P(FaultByHand, ActsAsThatOfTheSceneToTheLastBit) {
  const ByHand& fault = GetParam();
  const lang::Program of_scene = watching_in(crate_and_post + "faults: [{at: 0.1 s, for: 0.1 s, " +
                                             std::string(fault.in_scene) + "}]\n");
  const lang::Program program = watching_in(crate_and_post);
  ScenePlant expected(of_scene), plant(program);
  std::vector<double> told, told_by_hand;
  const auto note = [](std::vector<double>& list) {
    return [&list](const Sensed& sensed, PlantStatus status) {
      list.push_back(status == PlantStatus::ok ? 0.0 : 1.0);
      list.push_back(sensed.time);
      list.insert(list.end(), sensed.state.q.begin(), sensed.state.q.end());
    };
  };
  Sensed sensed(of_scene), sensed_by_hand(program);
  go_on(expected, sensed, 0.3, torques, note(told));

  const std::size_t place = switch_named(program, fault.name);
  Hand hand = idle_hand(program);
  ASSERT_LT(place, hand.faults.size());
  go_on(plant, sensed_by_hand, 0.1, torques, note(told_by_hand));
  hand.faults[place] = fault.value;
  plant.set_hand(hand);
  go_on(plant, sensed_by_hand, 0.1, torques, note(told_by_hand));
  plant.set_hand(idle_hand(program));
  go_on(plant, sensed_by_hand, 0.1, torques, note(told_by_hand));

  EXPECT_EQ(told, told_by_hand);
  EXPECT_EQ(expected.truth().x, plant.truth().x);
  EXPECT_EQ(expected.truth().y, plant.truth().y);
  EXPECT_EQ(expected.truth().yaw, plant.truth().yaw);
  EXPECT_EQ(expected.truth().velocity, plant.truth().velocity);
}

INSTANTIATE_TEST_SUITE_P(
    Each, FaultByHand,
    testing::Values(ByHand{"samples: lost", "samples", 1}, ByHand{"samples: frozen", "samples", 5},
                    ByHand{"clock: ahead", "clock", 2},
                    ByHand{"wheel: front_left_wheel, torque: lost", "torque.front_left_wheel", 1},
                    ByHand{"wheel: rear_right_wheel, torque: stuck", "torque.rear_right_wheel", 2},
                    ByHand{"wheel: front_left_wheel, torque: flipped", "torque.front_left_wheel", 3},
                    ByHand{"floor_friction: 0.02", "floor_friction", 0.02},
                    ByHand{"wheel: rear_left_wheel, floor_friction: 0.02", "floor_friction.rear_left_wheel",
                           0.02},
                    ByHand{"payload: 20 kg", "payload", 20.0},
                    ByHand{"centre_of_mass: 0.1 m", "centre_of_mass", 0.1},
                    ByHand{"inertia: 50 %", "inertia", 0.5}));

TEST(HandOnSignals, NothingIsMeasuredOfOneThatIsBlocked) {
  const lang::Program program = watching_in(crate_and_post);
  ScenePlant plant(program);
  const std::vector<std::size_t> given = given_signals(program);
  EXPECT_EQ(given, (std::vector<std::size_t>{0, 1})) << "the scene gives no `unseen`";
  Hand hand = idle_hand(program);
  for (const bool is_blocked : {false, true, false}) {
    hand.blocked[1] = is_blocked;
    plant.set_hand(hand);
    stand(plant, program, 0.02, [&](const Sensed& sensed, PlantStatus) {
      EXPECT_EQ(sensed.signals[1].valid, !is_blocked) << sensed.time;
      EXPECT_TRUE(sensed.signals[0].valid) << "the other one goes on";
    });
  }
}

// Half a metre takes 2 s at 0.25 m/s; the quarter turn beside it takes a little less.
TEST(HandOnObjects, AFixedOneGoesStraightAndEvenlyAndStays) {
  const lang::Program program = watching_in(crate_and_post);
  ScenePlant plant(program);
  Hand hand = idle_hand(program);
  hand.sent = {1, {0.3, 2.4}, 0.5 * std::numbers::pi};
  plant.set_hand(hand);
  const double lasts = 0.5 / hand_speed;
  const ObjectTruth& post = plant.truth().objects[1];
  double far = 0.0;
  stand(plant, program, lasts + 0.2, [&](const Sensed& sensed, PlantStatus) {
    if (sensed.time == 0.0) return;
    // The truth is that of the step's end; the way is looked up at its beginning.
    const double share = std::min(1.0, (plant.truth().time - step) / lasts);
    far = std::max(far, std::hypot(post.x - 0.3 * share, post.y - (2.0 + 0.4 * share)));
  });
  EXPECT_LT(far, 1e-9);
  EXPECT_NEAR(post.yaw, 0.5 * std::numbers::pi, 1e-9);
  Sensed sensed(program);
  ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
  EXPECT_NEAR(sensed.signals[0].number, std::hypot(0.3, 2.4) - 0.1, 1e-3) << "signals see it where it is";
}

TEST(HandOnObjects, OneWithAMassIsLetGoAtRest) {
  const lang::Program program = watching_in(crate_and_post);
  ScenePlant plant(program);
  Hand hand = idle_hand(program);
  hand.sent = {0, {2.0, 0.1}, 0.0};
  plant.set_hand(hand);
  const ObjectTruth& crate = plant.truth().objects[0];
  stand(plant, program, 0.1 / hand_speed + 0.05);
  EXPECT_NEAR(crate.x, 2.0, 1e-3);
  EXPECT_NEAR(crate.y, 0.1, 1e-3);
  stand(plant, program, 0.2);
  EXPECT_NEAR(crate.y, 0.1, 1e-3) << "it stays where it was let go";
}

TEST(HandOnObjects, PushesTheBaseOutOfItsWay) {
  const lang::Program program = watching_in(
      "objects: {post: {cylinder: {radius: 0.1 m, height: 1 m}, at: [0 m, 0.5 m], fixed: true}}\n");
  ScenePlant plant(program);
  Hand hand = idle_hand(program);
  // The base's left side is at 0.28 m: the post goes 0.1 m into it, and the base rolls sideways.
  hand.sent = {0, {0.0, 0.28}, 0.0};
  plant.set_hand(hand);
  stand(plant, program, 0.22 / hand_speed + 0.2);
  EXPECT_TRUE(plant.truth().objects[0].touched.has_value());
  EXPECT_LT(plant.truth().y, -0.09);
}

TEST(Hand, HasAColumnForEachOfItsValues) {
  const lang::Program program = watching_in(crate_and_post);
  ScenePlant plant(program);
  const HandColumns by_hand(program);
  const std::vector<Column>& columns = by_hand.columns();
  std::set<std::string> names;
  for (const std::vector<Column>& some : {columns, truth_columns(*program.scene)}) {
    for (const Column& column : some) EXPECT_TRUE(names.insert(column.name).second) << column.name;
  }
  Hand hand = idle_hand(program);
  hand.blocked[0] = true;
  hand.push = {{0.1, 0.2}, {3.0, 4.0}};
  hand.faults[switch_named(program, "payload")] = 12.0;
  hand.sent = {1, {0.5, 2.5}, 0.25};
  std::vector<double> values(columns.size());
  by_hand.put(hand, plant.truth(), values);
  const auto value = [&](const std::string& name) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].name == name) return values[i];
    }
    ADD_FAILURE() << "no column " << name;
    return 0.0;
  };
  EXPECT_EQ(value("hand.at.y"), 0.2);
  EXPECT_EQ(value("hand.force.x"), 3.0);
  EXPECT_EQ(value("hand.blocked.near"), 1.0);
  EXPECT_EQ(value("hand.blocked.loaded"), 0.0);
  EXPECT_EQ(value("hand.fault.payload"), 12.0);
  EXPECT_EQ(value("hand.fault.samples"), 0.0);
  EXPECT_TRUE(std::isnan(value("hand.fault.inertia")));
  EXPECT_EQ(value("hand.object"), 2.0) << "`none` is the first word";
  EXPECT_EQ(value("hand.to.yaw"), 0.25);
  EXPECT_EQ(value("truth.post.y"), 2.0);
}

}  // namespace
}  // namespace zwang::runtime
