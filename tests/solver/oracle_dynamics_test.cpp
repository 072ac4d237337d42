// The oracle's own proof: its dynamics against differences of motion and energy, before anything is judged by
// it.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "oracle/dense_dynamics.hpp"
#include "oracle/random_problem.hpp"

namespace zwang::oracle {
namespace {

/// The state after `dt` along `vdot`, right to second order.
solver::State advance(const solver::Model& model, const solver::State& state, const Vector& vdot, double dt) {
  solver::State next = state;
  const int n = model.joint_count();
  const Eigen::VectorXd a = vdot.cast<double>();
  next.q = state.q + dt * state.qd + 0.5 * dt * dt * a.tail(n);
  next.qd = state.qd + dt * a.tail(n);
  if (!model.has_fixed_base()) {
    const solver::Vector3 w = state.base_twist.angular;
    const solver::Vector3 v = state.base_twist.linear;
    const solver::Vector3 turn = dt * w + 0.5 * dt * dt * a.head(3);
    next.base_pose.rotation =
        state.base_pose.rotation * Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    next.base_pose.position +=
        state.base_pose.rotation * (dt * v + 0.5 * dt * dt * (solver::Vector3(a.segment(3, 3)) + w.cross(v)));
    next.base_twist.angular += dt * a.head(3);
    next.base_twist.linear += dt * a.segment(3, 3);
  }
  return next;
}

class OracleDynamics : public testing::TestWithParam<Robot> {
 protected:
  static constexpr double dt = 1e-5;
  static constexpr int cases = 5;
};

class OracleGround : public OracleDynamics {};

TEST_P(OracleDynamics, MassMatrixIsPositiveAndCarriesTheKineticEnergyOfTheBodies) {
  Random random(11);
  for (int i = 0; i < cases; ++i) {
    const solver::Model model = random_model(GetParam(), random, 10.0);
    const solver::State state = random_state(model, random);
    const DenseDynamics d(model, state);
    EXPECT_LT((d.M - d.M.transpose()).norm(), 1e-15L * d.M.norm());
    EXPECT_EQ(Eigen::LLT<Matrix>(d.M).info(), Eigen::Success);
    Real energy = 0;
    for (std::size_t k = model.has_fixed_base() ? 1 : 0; k < d.bodies.size(); ++k) {
      const BodyMotion& b = d.bodies[k];
      const Matrix I = model.bodies()[k].inertia.matrix().cast<Real>();
      Vector twist(6);
      twist << b.rotation.transpose() * b.angular, b.rotation.transpose() * b.linear;
      energy += twist.dot(I * twist) / 2;
      if (k > 0) {
        const int j = static_cast<int>(k) - 1;
        energy += static_cast<Real>(model.joint(j).rotor_inertia * state.qd[j] * state.qd[j]) / 2;
      }
    }
    EXPECT_NEAR(static_cast<double>(d.kinetic_energy() / energy), 1.0, 1e-14);
  }
}

TEST_P(OracleDynamics, EnergyRateIsPower) {
  Random random(12);
  for (int i = 0; i < cases; ++i) {
    const solver::Model model = random_model(GetParam(), random, 10.0);
    const solver::State state = random_state(model, random);
    const DenseDynamics d(model, state);
    Vector tau = Vector::Zero(d.freedoms());
    for (Eigen::Index k = 0; k < tau.size(); ++k) tau[k] = random.uniform(-3.0, 3.0);
    const Vector vdot = Eigen::LLT<Matrix>(d.M).solve(tau - d.h);
    Real power = tau.dot(d.velocity);
    for (std::size_t k = 0; k < d.bodies.size(); ++k) {
      const BodyMotion& b = d.bodies[k];
      const solver::ForceVector& f = state.f_ext[k];
      power += (b.rotation * f.angular.cast<Real>()).dot(b.angular) +
               (b.rotation * f.linear.cast<Real>()).dot(b.linear);
    }
    const DenseDynamics after(model, advance(model, state, vdot, dt));
    const DenseDynamics before(model, advance(model, state, vdot, -dt));
    const Real rate = (after.kinetic_energy() + after.potential_energy() - before.kinetic_energy() -
                       before.potential_energy()) /
                      (2 * dt);
    EXPECT_NEAR(static_cast<double>(rate), static_cast<double>(power),
                1e-6 * (1.0 + std::abs(static_cast<double>(power))));
  }
}

TEST_P(OracleDynamics, SpatialAccelerationIsTheRateOfTheTwist) {
  Random random(13);
  for (int i = 0; i < cases; ++i) {
    const solver::Model model = random_model(GetParam(), random, 10.0);
    const solver::State state = random_state(model, random);
    const DenseDynamics d(model, state);
    Vector vdot(d.freedoms());
    for (Eigen::Index k = 0; k < vdot.size(); ++k) vdot[k] = random.uniform(-2.0, 2.0);
    const DenseDynamics after(model, advance(model, state, vdot, dt));
    const DenseDynamics before(model, advance(model, state, vdot, -dt));
    for (std::size_t k = 0; k < d.bodies.size(); ++k) {
      const auto twist = [&](const DenseDynamics& at) {
        const BodyMotion& b = at.bodies[k];
        Vector t(6);
        t << b.rotation.transpose() * b.angular, b.rotation.transpose() * b.linear;
        return t;
      };
      const Vector rate = (twist(after) - twist(before)) / (2 * dt);
      EXPECT_LT((rate - d.spatial_acceleration(static_cast<int>(k), vdot)).norm(), 1e-7L * (1 + rate.norm()));
    }
  }
}

TEST_P(OracleGround, GroundRowsAreTheRateOfTheSlip) {
  Random random(14);
  for (int i = 0; i < cases; ++i) {
    const solver::Model model = random_model(GetParam(), random, 10.0);
    solver::State state = random_state(model, random);
    // The ground's rows speak of a base that stays upright.
    state.base_twist.angular.head(2).setZero();
    const DenseDynamics d(model, state);
    Vector vdot(d.freedoms());
    for (Eigen::Index k = 0; k < vdot.size(); ++k) vdot[k] = random.uniform(-2.0, 2.0);
    vdot.head(2).setZero();
    const DenseDynamics after(model, advance(model, state, vdot, dt));
    const DenseDynamics before(model, advance(model, state, vdot, -dt));
    const LinearRows rows = d.ground();
    const Vector rate =
        (after.ground().jacobian * after.velocity - before.ground().jacobian * before.velocity) / (2 * dt);
    EXPECT_LT((rate - (rows.jacobian * vdot - rows.rhs)).norm(), 1e-7L * (1 + rate.norm()));
  }
}

TEST(OracleMomentum, FloatingTreeMovesItsMomentumByGravityAlone) {
  Random random(15);
  for (int i = 0; i < 10; ++i) {
    const solver::Model model = random_model(Robot::floating_tree, random, 10.0);
    solver::State state = random_state(model, random);
    for (solver::ForceVector& f : state.f_ext) f = {};
    const DenseDynamics d(model, state);
    Vector tau = Vector::Zero(d.freedoms());
    for (Eigen::Index k = 6; k < tau.size(); ++k) tau[k] = random.uniform(-3.0, 3.0);
    const Vector vdot = Eigen::LLT<Matrix>(d.M).solve(tau - d.h);
    Vec3 rate = Vec3::Zero();
    Vec3 spin = Vec3::Zero();
    Vec3 expected_spin = Vec3::Zero();
    Real mass = 0;
    for (std::size_t k = 0; k < d.bodies.size(); ++k) {
      const BodyMotion& b = d.bodies[k];
      const solver::RigidInertia& inertia = model.bodies()[k].inertia;
      const Real m = inertia.mass;
      const Vec3 arm = b.rotation * inertia.first_moment.cast<Real>() / m;
      const Vec3 alpha = b.angular_jacobian * vdot + b.angular_bias;
      const Vec3 a =
          b.linear_jacobian * vdot + b.linear_bias + alpha.cross(arm) + b.angular.cross(b.angular.cross(arm));
      const Mat3 about_centre =
          inertia.rotational.cast<Real>() -
          m * ((arm.dot(arm)) * Mat3::Identity() -
               (b.rotation.transpose() * arm) * (b.rotation.transpose() * arm).transpose());
      const Mat3 I = b.rotation * about_centre * b.rotation.transpose();
      const Vec3 momentum = I * b.angular;
      rate += m * a;
      spin += m * (b.origin + arm).cross(a) + I * alpha + b.angular.cross(momentum);
      expected_spin += (b.origin + arm).cross(m * model.gravity().cast<Real>());
      mass += m;
    }
    // A rotor's inertia acts between two bodies, so the totals do not see it.
    EXPECT_LT((rate - mass * model.gravity().cast<Real>()).norm(), 1e-13L * (1 + mass * 9.81L));
    EXPECT_LT((spin - expected_spin).norm(), 1e-13L * (1 + expected_spin.norm() + spin.norm()));
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, OracleDynamics, testing::ValuesIn(all_robots),
                         [](const auto& robot) { return std::string(to_string(robot.param)); });

INSTANTIATE_TEST_SUITE_P(Bases, OracleGround,
                         testing::Values(Robot::mecanum, Robot::omni, Robot::differential, Robot::kelo,
                                         Robot::skid, Robot::mecanum_arm),
                         [](const auto& robot) { return std::string(to_string(robot.param)); });

}  // namespace
}  // namespace zwang::oracle
