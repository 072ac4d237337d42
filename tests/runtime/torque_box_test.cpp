// The box of torques that a drive may choose from keeps every force bound, and is no narrower than it must.
#include "drive/torque_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "drive/velocity_drive.hpp"
#include "shipped_program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::runtime {
namespace {

using solver::infinity;

struct Box {
  Eigen::VectorXd lower, upper;
};

Box box_of(const TorqueBounds& bounds, const Eigen::VectorXd& torque, const Eigen::VectorXd& limit) {
  Box box{torque, torque};
  put_box(bounds, torque, limit, box.lower, box.upper);
  return box;
}

/// The corner of the box where g . tau is largest.
Eigen::VectorXd farthest_corner(const Box& box, const Eigen::VectorXd& g) {
  return (g.array() > 0.0).select(box.upper, box.lower);
}

TEST(TorqueBox, NoCornerLeavesAForceBound) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0), some(0.0, 1.0);
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::Index joints = 2 + trial % 7;
    TorqueBounds bounds(joints, 6);
    bounds.count = 1 + trial % 6;
    const Eigen::VectorXd limit =
        Eigen::VectorXd::NullaryExpr(joints, [&] { return 1.0 + 5.0 * some(random); });
    const Eigen::VectorXd torque = limit.unaryExpr([&](double most) { return most * any(random); });
    for (int k = 0; k < bounds.count; ++k) {
      bounds.per_torque.col(k) = Eigen::VectorXd::NullaryExpr(joints, [&] { return 10.0 * any(random); });
      const double force = bounds.per_torque.col(k).dot(torque);
      // Some bounds are on the force itself, as a force driver's is, and some are on one side only.
      bounds.high(k) = force + (k % 3 == 0 ? 0.0 : 20.0 * some(random));
      bounds.low(k) = k % 2 == 0 ? -infinity : force - 20.0 * some(random);
    }
    const Box box = box_of(bounds, torque, limit);
    for (int k = 0; k < bounds.count; ++k) {
      const Eigen::VectorXd g = bounds.per_torque.col(k);
      EXPECT_LE(g.dot(farthest_corner(box, g)), bounds.high(k) + 1e-9) << trial << ", " << k;
      EXPECT_GE(g.dot(farthest_corner(box, -g)), bounds.low(k) - 1e-9) << trial << ", " << k;
    }
    EXPECT_LE((box.lower - torque).maxCoeff(), 1e-12);
    EXPECT_GE((box.upper - torque).minCoeff(), -1e-12);
    EXPECT_LE((box.upper - limit).maxCoeff(), 0.0);
    EXPECT_LE((-limit - box.lower).maxCoeff(), 0.0);
  }
}

/// Of one bound, the farthest corner is at it; against the other side nothing but the motors bounds.
TEST(TorqueBox, IsAsWideAsOneBoundAllows) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    TorqueBounds bounds(4, 1);
    bounds.count = 1;
    const Eigen::VectorXd limit = Eigen::VectorXd::Constant(4, 1e3);
    const Eigen::VectorXd g = Eigen::VectorXd::NullaryExpr(4, [&] { return 10.0 * any(random); });
    const Eigen::VectorXd torque = Eigen::VectorXd::NullaryExpr(4, [&] { return any(random); });
    bounds.per_torque.col(0) = g;
    bounds.high(0) = g.dot(torque) + 7.0;
    bounds.low(0) = -infinity;
    const Box box = box_of(bounds, torque, limit);
    EXPECT_NEAR(g.dot(farthest_corner(box, g)), bounds.high(0), 1e-9);
    EXPECT_EQ(farthest_corner(box, -g), Eigen::VectorXd((g.array() > 0.0).select(-limit, limit)));
  }
}

lang::Program at_far_wall(const std::string& task, const std::string& robot) {
  return zwang::test::shipped_files(task, "robots/limited/" + robot + ".yaml", "scenes/wall_far.yaml");
}

/// Of a base whose centre of mass is its origin, 1 N m at each wheel of the radius R presses with 4/R ahead.
/// The torques of each corner of the box that is sent press with the task's 20 N at most.
TEST(TorqueBox, PressesNoHarderThanTheTaskWhateverTheDriveChooses) {
  const lang::Program program = at_far_wall("wall_align.yaml", "mecanum_50_hz");
  ScenePlant plant(program);
  Runner runner(program);
  Sensed sensed(program);
  const double radius = program.robot.model.wheels().front().radius;
  for (int i = 0; i < 6000; ++i) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    runner.step(sensed);
    const Command& command = runner.command();
    EXPECT_LE(command.upper.sum() / radius, 20.0 * (1.0 + 1e-3)) << "in tick " << i;
    EXPECT_LE((command.lower - command.torque).maxCoeff(), 1e-12);
    EXPECT_GE((command.upper - command.torque).minCoeff(), -1e-12);
    ASSERT_EQ(plant.follow(command), PlantStatus::ok);
  }
}

TEST(Command, IsItsTorqueToADriveThatTakesTorques) {
  lang::Diagnostics diagnostics;
  const auto program = lang::load(ZWANG_SOURCE_DIR "/specs/wall_align.yaml", {}, diagnostics);
  ASSERT_TRUE(program);
  struct OwnPlant : Plant {
    PlantStatus sense(Sensed&) noexcept override { return PlantStatus::ok; }
    PlantStatus apply(const Eigen::VectorXd& tau) noexcept override {
      taken = tau;
      return PlantStatus::ok;
    }
    Eigen::VectorXd taken;
  } plant;
  Runner runner(*program);
  Sensed sensed(*program);
  const Eigen::VectorXd tau = runner.step(sensed);
  EXPECT_EQ(plant.follow(runner.command()), PlantStatus::ok);
  EXPECT_EQ(plant.taken, tau);
  EXPECT_EQ(runner.command().lower, tau);
  EXPECT_EQ(runner.command().upper, tau);
}

}  // namespace
}  // namespace zwang::runtime
