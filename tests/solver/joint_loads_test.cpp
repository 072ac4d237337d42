// The load on a joint, against the oracle's energies. Its weight is the slope of the potential energy. Its
// inertia is twice the kinetic energy of the joint that turns alone at 1 rad/s, or slides at 1 m/s.
#include "zwang/solver/joint_loads.hpp"

#include <gtest/gtest.h>

#include "law_problem.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::oracle {
namespace {

class JointLoads : public testing::TestWithParam<Robot> {};

TEST_P(JointLoads, AreTheSlopesOfTheEnergies) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    LawProblem p(GetParam(), seed, 20.0);
    solver::JointLoads loads(p.model);
    loads.weigh(p.state);
    std::size_t next = 0;
    for (int j = 0; j < p.model.joint_count(); ++j) {
      if (!p.model.joint(j).actuated || solver::turns_wheel(p.model, j + 1)) continue;
      ASSERT_LT(next, loads.all().size());
      const solver::JointLoads::Load& load = loads.all()[next++];
      EXPECT_EQ(load.joint, j);
      solver::State ahead = p.state, behind = p.state;
      constexpr double step = 1e-4;
      ahead.q(j) += step;
      behind.q(j) -= step;
      const Real rise = DenseDynamics(p.model, ahead).potential_energy() -
                        DenseDynamics(p.model, behind).potential_energy();
      EXPECT_NEAR(load.weight, static_cast<double>(rise) / (2.0 * step), 1e-6 * (1.0 + std::abs(load.weight)))
          << "seed " << seed;
      solver::State alone(p.model);
      alone.q = p.state.q;
      alone.base_pose = p.state.base_pose;
      alone.qd(j) = 1.0;
      const auto twice = static_cast<double>(2 * DenseDynamics(p.model, alone).kinetic_energy());
      EXPECT_NEAR(load.inertia, twice, 1e-9 * (1.0 + twice)) << "seed " << seed;
    }
    EXPECT_EQ(next, loads.all().size());
    const Eigen::VectorXd before = p.state.tau_ff;
    loads.bear(p.state);
    for (const solver::JointLoads::Load& load : loads.all())
      EXPECT_EQ(p.state.tau_ff(load.joint), before(load.joint) + load.weight);
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, JointLoads, testing::ValuesIn(all_robots),
                         [](const auto& drawn) { return to_string(drawn.param); });

}  // namespace
}  // namespace zwang::oracle
