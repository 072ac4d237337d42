#include "estimate/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "robots.hpp"

namespace zwang::runtime {
namespace {

lang::Robot rough_robot(double compensate) {
  lang::Robot robot = test::mecanum_robot();
  robot.friction.assign(4, {.coulomb = 0.5, .viscous = 0.02, .compensate = compensate});
  robot.friction[3].compensate = 0.0;
  return robot;
}

Eigen::VectorXd compensation(const lang::Robot& robot, double qd) {
  solver::State state(robot.model);
  state.qd.setConstant(qd);
  Eigen::VectorXd tau = Eigen::VectorXd::Constant(4, 1.0);
  FrictionFeedForward(robot).add_to(tau, state);
  return tau.array() - 1.0;
}

TEST(FrictionFeedForward, MakesUpForItsPartAtSpeed) {
  const lang::Robot robot = rough_robot(0.8);
  const Eigen::VectorXd forward = compensation(robot, 20.0);
  EXPECT_NEAR(forward(0), 0.8 * (0.5 + 0.02 * 20.0), 0.8 * 0.5 * 1e-4);
  EXPECT_EQ(forward(3), 0.0) << "nothing is to be compensated there";
  EXPECT_NEAR(compensation(robot, -20.0)(0), -forward(0), 1e-15);
}

TEST(FrictionFeedForward, NeverExceedsTheFrictionAndVanishesAtRest) {
  const lang::Robot robot = rough_robot(0.95);
  EXPECT_EQ(compensation(robot, 0.0)(0), 0.0);
  double last = 0.0;
  for (double qd = 1e-4; qd < 30.0; qd *= 1.3) {
    const double tau = compensation(robot, qd)(0);
    EXPECT_GT(tau, last) << "grows with the speed";
    EXPECT_LT(tau, 0.5 + 0.02 * qd);
    last = tau;
  }
  EXPECT_NEAR(compensation(robot, FrictionFeedForward::turn_taper)(0),
              0.95 * (0.5 / std::sqrt(2.0) + 0.02 * FrictionFeedForward::turn_taper), 1e-15);
}

}  // namespace
}  // namespace zwang::runtime
