// The energy of the robot changes at the rate of the power that motors and external wrenches put in: the
// ground's forces do no work. The energy is the oracle's, differentiated along the motion.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "law_problem.hpp"

namespace zwang::oracle {
namespace {

/// The state a moment later, to first order in the pose: enough for a central difference.
solver::State moved(const solver::Model& model, const solver::State& state, const solver::Solution& solution,
                    double time) {
  solver::State out = state;
  out.q += time * state.qd;
  out.qd += time * solution.qdd;
  if (model.has_fixed_base()) return out;
  const solver::Vector3 turn = time * state.base_twist.angular;
  if (turn.norm() > 0.0) {
    out.base_pose.rotation = state.base_pose.rotation * Eigen::AngleAxisd(turn.norm(), turn.normalized());
  }
  out.base_pose.position += time * (state.base_pose.rotation * state.base_twist.linear);
  out.base_twist += solution.acceleration.front() * time;
  return out;
}

Real energy(const solver::Model& model, const solver::State& state) {
  const DenseDynamics dense(model, state);
  return dense.kinetic_energy() + dense.potential_energy();
}

class Energy : public testing::TestWithParam<Robot> {};

TEST_P(Energy, RateEqualsThePowerOfMotorsAndWrenches) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    LawProblem p(GetParam(), seed, 20.0);
    const std::vector<solver::Row> rows = p.rows({.count = 4, .levels = 2});
    solver::Solver solver(p.model);
    solver::Solution solution(p.model);
    ASSERT_EQ(solver.solve(p.state, rows, solution), solver::Status::ok);

    const DenseDynamics dense(p.model, p.state);
    double power = solution.tau.dot(p.state.qd);
    double size = solution.tau.cwiseAbs().dot(p.state.qd.cwiseAbs());
    for (std::size_t i = 0; i < p.state.f_ext.size(); ++i) {
      if (i == 0 && p.model.has_fixed_base()) continue;
      const BodyMotion& body = dense.bodies[i];
      const solver::Matrix3 R = body.rotation.cast<double>();
      const solver::MotionVector twist{R.transpose() * body.angular.cast<double>(),
                                       R.transpose() * body.linear.cast<double>()};
      power += dot(p.state.f_ext[i], twist);
      size += std::abs(dot(p.state.f_ext[i], twist));
    }
    // Central differences at two steps, the error of second order taken out.
    const auto rate = [&](double step) {
      const Real ahead = energy(p.model, moved(p.model, p.state, solution, step));
      const Real behind = energy(p.model, moved(p.model, p.state, solution, -step));
      return static_cast<double>((ahead - behind) / (2 * static_cast<Real>(step)));
    };
    const double expected = (4.0 * rate(2e-4) - rate(4e-4)) / 3.0;
    EXPECT_NEAR(power, expected, 1e-7 * (1.0 + size + std::abs(expected))) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, Energy, testing::ValuesIn(all_robots),
                         [](const auto& drawn) { return to_string(drawn.param); });

}  // namespace
}  // namespace zwang::oracle
