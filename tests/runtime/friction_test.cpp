#include "estimate/friction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "estimate/press.hpp"
#include "robots.hpp"

namespace zwang::runtime {
namespace {

constexpr double give = 0.2e-3;  // [rad] before a joint slides

lang::Robot rough_robot(double compensate) {
  lang::Robot robot = test::mecanum_robot();
  robot.friction.assign(4, {.coulomb = 0.5, .presliding = give, .viscous = 0.02, .compensate = compensate});
  robot.friction[3].compensate = 0.0;
  return robot;
}

/// The torques that the compensation adds at the rate `qd`, if each joint presses with `press`.
Eigen::VectorXd compensation(FrictionEstimate& friction, double qd, double press) {
  friction.update(Eigen::VectorXd::Constant(4, qd), Eigen::VectorXd::Constant(4, press));
  Eigen::VectorXd tau = Eigen::VectorXd::Constant(4, 1.0);
  friction.compensate(tau);
  return tau.array() - 1.0;
}

Eigen::VectorXd compensation(const lang::Robot& robot, double qd) {
  FrictionEstimate friction(robot);
  return compensation(friction, qd, 0.0);
}

/// All joints from where they are by `steps` samples.
void roll(FrictionEstimate& friction, double& q, std::initializer_list<double> steps) {
  for (const double step : steps) friction.follow(Eigen::VectorXd::Constant(4, q += step));
}

TEST(FrictionEstimate, MakesUpForItsPartAtSpeed) {
  const lang::Robot robot = rough_robot(0.8);
  const Eigen::VectorXd forward = compensation(robot, 20.0);
  EXPECT_NEAR(forward(0), 0.8 * (0.5 + 0.02 * 20.0), 0.8 * 0.5 * 1e-4);
  EXPECT_EQ(forward(3), 0.0) << "nothing is to be compensated there";
  EXPECT_NEAR(compensation(robot, -20.0)(0), -forward(0), 1e-15);
}

TEST(FrictionEstimate, NeverExceedsTheFrictionAndVanishesAtRest) {
  const lang::Robot robot = rough_robot(0.95);
  EXPECT_EQ(compensation(robot, 0.0)(0), 0.0);
  double last = 0.0;
  for (double qd = 1e-4; qd < 30.0; qd *= 1.3) {
    const double tau = compensation(robot, qd)(0);
    EXPECT_GT(tau, last) << "grows with the speed";
    EXPECT_LT(tau, 0.5 + 0.02 * qd);
    last = tau;
  }
  EXPECT_NEAR(compensation(robot, FrictionEstimate::turn_taper)(0),
              0.95 * (0.5 / std::sqrt(2.0) + 0.02 * FrictionEstimate::turn_taper), 1e-15);
}

// At rest, by the last motion: c coulomb z / delta, as far as the joint presses.
TEST(FrictionEstimate, RemembersTheLastMotionOfAJointThatPresses) {
  FrictionEstimate friction(rough_robot(0.8));
  const double all = 0.8 * 0.5;
  double q = 7.0;
  roll(friction, q, {0.0});
  EXPECT_EQ(compensation(friction, 0.0, 5.0)(0), 0.0) << "nobody knows which way it came";
  roll(friction, q, {1e-3, 1e-3});
  EXPECT_NEAR(compensation(friction, 0.0, 5.0)(0), all, 1e-12);
  EXPECT_NEAR(compensation(friction, 0.0, -5.0)(0), all, 1e-12) << "the motion counts, not where it presses";
  EXPECT_NEAR(compensation(friction, 0.0, 0.25)(0), 0.5 * all, 1e-12)
      << "half its friction is what it presses with";
  EXPECT_EQ(compensation(friction, 0.0, 0.0)(0), 0.0) << "it does not press";
  roll(friction, q, {-0.5 * give});
  EXPECT_NEAR(compensation(friction, 0.0, 5.0)(0), 0.5 * all, 1e-9);
  roll(friction, q, {-0.5 * give});
  EXPECT_NEAR(compensation(friction, 0.0, 5.0)(0), 0.0, 1e-9);
  roll(friction, q, {-3.0 * give});
  EXPECT_NEAR(compensation(friction, 0.0, 5.0)(0), -all, 1e-12) << "rolled back, friction helps the push";
  EXPECT_NEAR(compensation(friction, -20.0, 5.0)(0), -all - 0.8 * 0.02 * 20.0, 1e-12);
}

TEST(FrictionEstimate, TakesAnEncoderThatStartsAnewForWhatItIs) {
  FrictionEstimate friction(rough_robot(0.8));
  double q = std::numbers::pi - 1e-3;
  roll(friction, q, {0.0, 2e-3 - 2.0 * std::numbers::pi});
  EXPECT_NEAR(compensation(friction, 0.0, 5.0)(0), 0.8 * 0.5, 1e-12);
}

TEST(FrictionEstimate, HoldsNothingAtRestWhereThePreslidingIsNotKnown) {
  lang::Robot robot = rough_robot(0.8);
  for (lang::JointFriction& f : robot.friction) f.presliding = 0.0;
  FrictionEstimate friction(robot);
  double q = 0.0;
  roll(friction, q, {0.0, 1e-2});
  EXPECT_EQ(compensation(friction, 0.0, 5.0)(0), 0.0);
}

/// Work that the compensation of one joint gives, and that its true friction takes, along a way.
class Works {
 public:
  Works(double coulomb, double presliding, double true_coulomb, double true_presliding)
      : true_coulomb_(true_coulomb), true_presliding_(true_presliding), friction_([&] {
          lang::Robot robot = rough_robot(0.8);
          robot.friction[0].coulomb = coulomb;
          robot.friction[0].presliding = presliding;
          robot.friction[0].viscous = 0.0;
          return robot;
        }()) {
    friction_.follow(Eigen::VectorXd::Zero(4));
  }

  void go_to(double q) {
    const int steps = static_cast<int>(std::abs(q - q_) / 1e-7) + 1;
    const double step = (q - q_) / steps;
    for (int i = 0; i < steps; ++i) {
      const double before = given_force_, taken_before = true_coulomb_ * stretch_ / true_presliding_;
      q_ += step;
      stretch_ = std::clamp(stretch_ + step, -true_presliding_, true_presliding_);
      friction_.follow(Eigen::VectorXd::Constant(4, q_));
      given_force_ = compensation(friction_, 0.0, 5.0)(0);
      given += 0.5 * (before + given_force_) * step;
      taken += 0.5 * (taken_before + true_coulomb_ * stretch_ / true_presliding_) * step;
    }
  }

  double given = 0.0, taken = 0.0;  ///< [J]

 private:
  double true_coulomb_, true_presliding_;
  FrictionEstimate friction_;
  double q_ = 0.0, stretch_ = 0.0, given_force_ = 0.0;
};

// Whatever the motion, friction takes what its compensation gives and what that has stored, c coulomb delta
// / 2.
TEST(FrictionEstimate, GivesNoMoreThanFrictionTakes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> size(-1.0, 1.0);
  for (const double longer : {1.0, 1.3, 2.0, 5.0}) {
    Works works(0.5, longer * give, 0.4, give);  // 25 % too much: all of it is given back
    double least = 0.0;
    for (int i = 0; i < 60; ++i) {
      works.go_to(8.0 * give * std::pow(size(random), 3.0));
      least = std::min(least, works.taken - works.given);
    }
    EXPECT_GE(least, -0.5 * 0.4 * longer * give * (1.0 + 1e-6)) << longer;
    EXPECT_GT(works.given, 0.1 * works.taken) << longer << ": nothing was compensated";
  }
}

// A presliding that is too short feeds small swings: between -true and true with 4 c coulomb (true - delta).
TEST(FrictionEstimate, FeedsSwingsOfLessThanTheTruePreslidingByWhatItIsTooShort) {
  Works works(0.5, 0.5 * give, 0.5, give);
  works.go_to(give);
  const double given = works.given, taken = works.taken;
  works.go_to(-give);
  works.go_to(give);
  EXPECT_NEAR(works.taken - taken, 0.0, 1e-3 * give);
  EXPECT_NEAR(works.given - given, 4.0 * 0.8 * 0.5 * (give - 0.5 * give), 1e-3 * give);
}

/// The forces with which the joints of the mecanum base press, by the solver.
class PressTest : public testing::Test {
 protected:
  Eigen::VectorXd press(const solver::AxisConstraint& constraint) {
    solver::ConstraintSet set;
    EXPECT_TRUE(set.add(constraint));
    EXPECT_TRUE(set.fill(model, state));
    EXPECT_EQ(solver.solve(state, set.rows(), solution), solver::Status::ok);
    const solver::RowSet all{&set.rows(), 1.0};
    return Press(model).look(solver, std::span(&all, 1), solution);
  }
  static solver::AxisConstraint drive(solver::Axis axis, const solver::Driver& driver) {
    solver::AxisConstraint constraint;
    constraint.move.body = constraint.in.body = 0;
    constraint.axis = axis;
    constraint.driver = driver;
    return constraint;
  }
  /// The torque of each motor alone that turns its joint as the wrench does: (J M^-1 F)_j / (J M^-1 J')_jj.
  static Eigen::VectorXd expected(const Eigen::Vector3d& wrench) {
    const test::PlanarBase base;
    const Eigen::MatrixXd J = base.jacobian(), JM = J * base.inertia().inverse();
    return (JM * wrench).cwiseQuotient((JM * J.transpose()).diagonal());
  }

  solver::Model model = test::mecanum_robot().model;
  solver::State state{model};
  solver::Solver solver{model};
  solver::Solution solution{model};
};

TEST_F(PressTest, IsWhatForcesTurnTheJointsWith) {
  const Eigen::VectorXd ahead =
      press(drive(solver::Axis::x, {.quantity = solver::Quantity::force, .target = 20.0}));
  EXPECT_LT((ahead - expected({20.0, 0.0, 0.0})).norm(), 1e-9 * ahead.norm());
  const Eigen::VectorXd turning =
      press(drive(solver::Axis::rz, {.quantity = solver::Quantity::force, .target = -3.0}));
  EXPECT_LT((turning - expected({0.0, 0.0, -3.0})).norm(), 1e-9 * turning.norm());
}

TEST_F(PressTest, CountsADriverAtItsBoundAndNoneThatHolds) {
  const auto wanting = [&](double acceleration) {
    return press(
        drive(solver::Axis::y,
              {.quantity = solver::Quantity::acceleration, .target = acceleration, .force = {-15.0, 15.0}}));
  };
  EXPECT_EQ(wanting(0.1).norm(), 0.0);
  const Eigen::VectorXd bound = wanting(-3.0);
  EXPECT_LT((bound - expected({0.0, -15.0, 0.0})).norm(), 1e-9 * bound.norm());
}

}  // namespace
}  // namespace zwang::runtime
