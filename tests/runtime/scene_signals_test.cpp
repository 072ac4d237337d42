// Signals of a scene, measured as well or as badly as the scene says.
// Expected values are the formulas of what the scene says.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "constants.hpp"
#include "standing_scene.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

// The hook looks back from x = -0.40 m: the cart at (-2, 0.3) stands 1.6 m ahead of it and 0.3 m to its
// right.
TEST(ScenePlant, PoseSignalsAreSeenFromTheirFrame) {
  const lang::Program program = program_with(std::string(cart) + "signals: {partner: {pose_of: cart}}\n");
  ScenePlant plant(program);
  Sensed sensed(program.robot.model, program.signals.size());
  ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
  const SignalSample& partner = sensed.signals[0];
  EXPECT_TRUE(partner.valid);
  EXPECT_NEAR(partner.pose.position.x(), 1.6, 1e-4);
  EXPECT_NEAR(partner.pose.position.y(), -0.3, 1e-4);
  EXPECT_NEAR(std::abs(std::atan2(partner.pose.rotation(1, 0), partner.pose.rotation(0, 0))),
              std::numbers::pi, 1e-4);
  EXPECT_FALSE(sensed.signals[1].valid) << "nobody measures it";
}

// A dock at the near face of a box whose origin lies 1.7 m behind the base. The dock's x axis points on into
// the box, as the hook's does.
TEST(ScenePlant, OfAnObjectWithADockTheSocketIsSeen) {
  const lang::Program program = program_with(R"(objects:
  dock:
    box: [0.6 m, 0.5 m, 0.4 m]
    at: [-1.7 m, 0.1 m]
    fixed: true
    dock: {at: [0.3 m, 0 m], hook: hook}
signals: {partner: {pose_of: dock}}
)");
  ScenePlant plant(program);
  Sensed sensed(program.robot.model, program.signals.size());
  ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
  const solver::Pose& seen = sensed.signals[0].pose;
  EXPECT_NEAR(seen.position.x(), 1.0, 1e-4);
  EXPECT_NEAR(seen.position.y(), -0.1, 1e-4);
  EXPECT_NEAR(std::atan2(seen.rotation(1, 0), seen.rotation(0, 0)), 0.0, 1e-4);
}

TEST(ScenePlant, DelayAndRateAreKept) {
  const lang::Program program =
      program_with(std::string(cart) + "signals: {near: {distance_to: cart, delay: 100 ms, rate: 20 Hz}}\n");
  ScenePlant plant(program);
  double first = -1.0, last_stamp = -1.0;
  std::vector<double> stamps;
  follow(plant, program, 1.5, idle, [&](const Sensed& sensed, PlantStatus) {
    const SignalSample& near = sensed.signals[1];
    if (!near.valid) return;
    if (first < 0.0) first = sensed.time;
    ASSERT_LE(near.stamp, sensed.time - 0.1 + 1e-9);
    ASSERT_GE(near.stamp, sensed.time - 0.15 - 1e-9);
    if (near.stamp != last_stamp) stamps.push_back(near.stamp);
    last_stamp = near.stamp;
  });
  EXPECT_NEAR(first, 0.1, 1e-9);
  ASSERT_GE(stamps.size(), 25u);
  for (std::size_t i = 1; i < stamps.size(); ++i) EXPECT_NEAR(stamps[i] - stamps[i - 1], 0.05, 1e-9);
}

// Ten times a second somebody says where the base is, 50 ms later, a centimetre wrong; it stands at the
// origin.
TEST(ScenePlant, AFixOfTheBaseIsMeasuredAsTheSceneSays) {
  const lang::Program program = program_with("state: {fix: {noise: 1 cm, delay: 50 ms, rate: 10 Hz}}\n");
  ScenePlant plant(program);
  double last_stamp = -1.0;
  int count = 0;
  double sum = 0.0, squares = 0.0;
  follow(plant, program, 40.0, idle, [&](const Sensed& sensed, PlantStatus) {
    ASSERT_FALSE(sensed.base_measured);
    if (sensed.time < 0.05 - 1e-9) {
      ASSERT_FALSE(sensed.base_fix);
      return;
    }
    ASSERT_TRUE(sensed.base_fix);
    ASSERT_LE(sensed.base_fix->stamp, sensed.time - 0.05 + 1e-9);
    if (sensed.base_fix->stamp == last_stamp) return;
    if (last_stamp >= 0.0) {
      ASSERT_NEAR(sensed.base_fix->stamp - last_stamp, 0.1, 1e-9);
    }
    last_stamp = sensed.base_fix->stamp;
    ++count;
    sum += sensed.base_fix->pose.position.x();
    squares += sensed.base_fix->pose.position.x() * sensed.base_fix->pose.position.x();
  });
  ASSERT_EQ(count, 400);
  EXPECT_NEAR(sum / count, 0.0, 4.0 * 0.01 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.01, 0.01 * 4.0 / std::sqrt(2.0 * count));
}

struct Statistics {
  double mean = 0.0, deviation = 0.0, share_valid = 0.0;
  std::vector<double> values;
};

Statistics distances(const std::string& measured, std::uint64_t seed) {
  const lang::Program program = program_with(
      "objects: {post: {cylinder: {radius: 0.5 m, height: 1 m}, at: [3 m, 4 m]}}\nsignals: {near: {" +
      measured + "}}\n");
  ScenePlantOptions options;
  options.seed = seed;
  ScenePlant plant(program, options);
  Statistics s;
  int ticks = 0;
  follow(plant, program, 4.0, idle, [&](const Sensed& sensed, PlantStatus) {
    ++ticks;
    if (sensed.signals[1].valid) s.values.push_back(sensed.signals[1].number);
  });
  for (const double v : s.values) s.mean += v / static_cast<double>(s.values.size());
  for (const double v : s.values)
    s.deviation += (v - s.mean) * (v - s.mean) / static_cast<double>(s.values.size());
  s.deviation = std::sqrt(s.deviation);
  s.share_valid = static_cast<double>(s.values.size()) / ticks;
  return s;
}

// 4000 samples: the mean is known to sigma / 63, sigma to 1.1 %, a share of 0.2 to 0.006; bounds at four
// times.
TEST(ScenePlant, NoiseAndDropoutsAreAsLargeAsTheSceneSays) {
  const Statistics clean = distances("distance_to: post", 1);
  EXPECT_NEAR(clean.mean, 4.5, 1e-4) << "5 m less the radius";
  EXPECT_LT(clean.deviation, 1e-4);
  const Statistics noisy = distances("distance_to: post, noise: 20 mm, dropouts: 20 %", 1);
  EXPECT_NEAR(noisy.mean, 4.5, 4.0 * 0.02 / 56.0);
  EXPECT_NEAR(noisy.deviation, 0.02, 0.05 * 0.02);
  EXPECT_NEAR(noisy.share_valid, 0.8, 0.026);
}

/// The felt forces of a base that presses on a wall with 20 N, from 3 s on: then it rests.
Statistics forces(const std::string& how) {
  const lang::Program program = program_with(R"(objects:
  wall: {wall: {length: 4 m, thickness: 0.1 m, height: 1 m}, at: [0.42 m, 0 m], fixed: true, damping: 1}
signals: {felt: {force_of: wall)" + how + "}}\n");
  ScenePlant plant(program);
  Statistics s;
  int ticks = 0;
  follow(plant, program, 7.0, Eigen::VectorXd::Constant(4, 20.0 * 0.0759 / 4.0),
         [&](const Sensed& sensed, PlantStatus) {
           if (sensed.time < 3.0) return;
           ++ticks;
           if (sensed.signals[4].valid) s.values.push_back(sensed.signals[4].number);
         });
  const auto count = static_cast<double>(s.values.size());
  for (const double v : s.values) s.mean += v / count;
  for (const double v : s.values) s.deviation += (v - s.mean) * (v - s.mean) / count;
  s.deviation = std::sqrt(s.deviation);
  s.share_valid = count / ticks;
  return s;
}

TEST(ScenePlant, AForceIsFeltAsBadlyAsTheSceneSays) {
  const Statistics clean = forces("");
  EXPECT_NEAR(clean.mean, 20.0, 0.02) << "what the wheels push with";
  EXPECT_LT(clean.deviation, 0.02);
  const Statistics biased = forces(", bias: -30 N");
  EXPECT_NEAR(biased.mean, clean.mean - 30.0, 1e-9);
  const Statistics noisy = forces(", bias: 30 N, noise: 2 N, dropouts: 20 %");
  EXPECT_NEAR(noisy.mean, 50.0, 0.02 + 4.0 * 2.0 / 56.0);
  EXPECT_NEAR(noisy.deviation, 2.0, 0.05 * 2.0);
  EXPECT_NEAR(noisy.share_valid, 0.8, 0.026);
}

// A switch that closes at 10 N is closed while 20 N press it; one that closes at 30 N stays open.
TEST(ScenePlant, ASwitchClosesAtTheForceThatTheSceneSays) {
  for (const char* source : {"force_of: wall", "wrench_at: base_link"}) {
    for (const double beyond : {10.0, 30.0}) {
      const lang::Program program = program_with(R"(objects:
  wall: {wall: {length: 4 m, thickness: 0.1 m, height: 1 m}, at: [0.42 m, 0 m], fixed: true, damping: 1}
signals: {latch: {)" + std::string(source) +
                                                 ", beyond: " + std::to_string(beyond) + " N}}\n");
      ScenePlant plant(program);
      bool before = true, at_rest = false;
      follow(plant, program, 4.0, Eigen::VectorXd::Constant(4, 20.0 * 0.0759 / 4.0),
             [&](const Sensed& sensed, PlantStatus) {
               if (sensed.time < 0.05) before = sensed.signals[2].boolean;
               at_rest = sensed.signals[2].boolean;
             });
      EXPECT_FALSE(before) << source;
      EXPECT_EQ(at_rest, beyond < 20.0) << source << " " << beyond;
    }
  }
}

// The first contact is felt as late as the scene says.
TEST(ScenePlant, AForceIsFeltAfterItsDelay) {
  const lang::Program program = program_with(R"(objects:
  wall: {wall: {length: 4 m, thickness: 0.1 m, height: 1 m}, at: [0.42 m, 0 m], fixed: true}
signals: {felt: {force_of: wall, delay: 50 ms}}
)");
  ScenePlant plant(program);
  double felt = -1.0;
  follow(plant, program, 1.0, Eigen::VectorXd::Constant(4, 20.0 * 0.0759 / 4.0),
         [&](const Sensed& sensed, PlantStatus) {
           if (felt < 0.0 && sensed.signals[4].valid && sensed.signals[4].number > 0.0) felt = sensed.time;
         });
  ASSERT_TRUE(plant.truth().objects[0].touched);
  EXPECT_NEAR(felt - *plant.truth().objects[0].touched, 0.05, 2.5 * period);
}

TEST(ScenePlant, OneSeedIsOneRun) {
  const char* const measured = "distance_to: post, noise: 20 mm, dropouts: 20 %";
  EXPECT_EQ(distances(measured, 7).values, distances(measured, 7).values);
  EXPECT_NE(distances(measured, 7).values, distances(measured, 8).values);
}

TEST(ScenePlant, ScriptedSignalsStepAtTheirTimes) {
  const lang::Program program =
      program_with("signals: {loaded: {script: [[0.1 s, false], [0.2 s, true], [0.3 s, lost]]}}\n");
  ScenePlant plant(program);
  follow(plant, program, 0.4, idle, [&](const Sensed& sensed, PlantStatus) {
    const SignalSample& loaded = sensed.signals[3];
    const int tick = static_cast<int>(std::lround(sensed.time / period));
    EXPECT_EQ(loaded.valid, tick >= 100 && tick < 300) << sensed.time;
    if (loaded.valid) {
      EXPECT_EQ(loaded.boolean, tick >= 200) << sensed.time;
    }
  });
}

}  // namespace
}  // namespace zwang::runtime
