// Encoders as a study draws them. The oracle is the plant's true state.
#include <gtest/gtest.h>

#include <cmath>

#include "standing_scene.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

constexpr double torque = 1.0;  // [N m] of each wheel: the base rolls
constexpr int samples = 300;

/// Calls `look` with each sample and the true positions.
template <typename Look>
void roll(const ScenePlantOptions& options, const Look& look) {
  const lang::Program program = program_with(cart);
  ScenePlant plant(program, options);
  Sensed sensed(program.robot.model, program.signals.size());
  const Eigen::VectorXd tau = Eigen::VectorXd::Constant(program.robot.model.joint_count(), torque);
  for (int i = 0; i < samples; ++i) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    look(sensed.state.q, plant.true_state().q, sensed.time);
    ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
  }
}

TEST(Encoders, CountTheTruePositionInSteps) {
  constexpr double step = 1e-3;  // [rad]
  ScenePlantOptions options;
  options.deviation.encoder_step = step;
  double farthest = 0.0;
  roll(options, [&](const Eigen::VectorXd& q, const Eigen::VectorXd& actual, double) {
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      EXPECT_NEAR(q(j) / step, std::round(q(j) / step), 1e-9);
      EXPECT_GE(actual(j) - q(j), -1e-12);
      EXPECT_LT(actual(j) - q(j), step + 1e-12);
      farthest = std::max(farthest, std::abs(q(j)));
    }
  });
  EXPECT_GT(farthest, 10.0 * step) << "the wheels did not roll";
}

/// Nor do readings of dead encoders repeat to the bit.
TEST(Encoders, ADeadReadingKeepsItsNoise) {
  constexpr double noise = 1e-10, at = 0.1;  // [rad], [s]
  constexpr double most = 7.0 * noise;       // once in 4e11 draws
  ScenePlantOptions options;
  options.deviation.encoder_noise = noise;
  options.faults.push_back({.kind = lang::FaultKind::samples_dead, .at = at});
  Eigen::VectorXd last;
  roll(options, [&](const Eigen::VectorXd& q, const Eigen::VectorXd&, double time) {
    if (time < at + 5e-4) return;
    if (last.size() > 0) {
      EXPECT_NE(q(0), last(0)) << "at " << time;
      EXPECT_LT((q - last).lpNorm<Eigen::Infinity>(), 2.0 * most);
    }
    last = q;
  });
  EXPECT_GT(last.size(), 0);
}

/// `come` is what a run says when a task is entered.
TEST(Faults, CountFromTheTimeThatTheyName) {
  constexpr double entered = 0.05, after = 0.1;  // [s]
  const lang::Program program = program_with(cart);
  ScenePlantOptions options;
  lang::Fault fault{.kind = lang::FaultKind::samples_lost, .at = after};
  fault.of = "run.entered." + program.tasks.front().name;
  options.faults.push_back(fault);
  ScenePlant plant(program, options);
  Sensed sensed(program.robot.model, program.signals.size());
  const Eigen::VectorXd tau = Eigen::VectorXd::Zero(program.robot.model.joint_count());
  double first = -1.0;
  bool has_entered = false;
  for (int i = 0; i < samples; ++i) {
    const double time = plant.truth().time;
    if (time >= entered && !has_entered) {
      EXPECT_TRUE(std::isinf(plant.onset()));
      plant.note_entry(0, time);
      plant.note_entry(0, time + 1.0);  // the first entry counts
      has_entered = true;
      EXPECT_DOUBLE_EQ(plant.onset(), time + after);
    }
    if (plant.sense(sensed) == PlantStatus::unreachable && first < 0.0) first = time;
    ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
  }
  EXPECT_NEAR(first, entered + after, 1.1e-3);  // a step of the simulation
}

}  // namespace
}  // namespace zwang::runtime
