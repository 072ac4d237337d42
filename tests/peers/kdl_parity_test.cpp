// Orocos KDL's ChainHdSolver_Vereshchagin and our solver on the same fixed-base arms.
//
// KDL's conventions: the root accelerates by -gravity, and all its accelerations contain this term, beta too.
// The external wrenches and alpha have the base's axes and the link's own origin. Their linear part comes
// first. KDL's nu is minus ours.
#include <gtest/gtest.h>

#include <cmath>
#include <kdl/chain.hpp>
#include <kdl/chainhdsolver_vereshchagin.hpp>
#include <limits>

#include "oracle/dense_dynamics.hpp"
#include "oracle/lexicographic.hpp"
#include "oracle/random_problem.hpp"
#include "zwang/solver/popov_vereshchagin.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::oracle {
namespace {

KDL::Vector to_kdl(const solver::Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

KDL::Rotation to_kdl(const solver::Matrix3& R) {
  return {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)};
}

KDL::Chain to_kdl(const solver::Model& model) {
  KDL::Chain chain;
  for (std::size_t i = 1; i < model.bodies().size(); ++i) {
    const solver::Body& body = model.bodies()[i];
    const bool slides = body.joint.type == solver::JointType::prismatic;
    const solver::Vector3 axis = body.pose_in_parent.rotation * body.joint.axis;
    const KDL::Joint joint(body.joint.name, to_kdl(body.pose_in_parent.position), to_kdl(axis),
                           slides ? KDL::Joint::TransAxis : KDL::Joint::RotAxis, 1.0, 0.0,
                           body.joint.rotor_inertia);
    const solver::RigidInertia& I = body.inertia;
    const solver::Vector3 c = I.first_moment / I.mass;
    const solver::Matrix3 at_centre =
        I.rotational - I.mass * (c.squaredNorm() * solver::Matrix3::Identity() - c * c.transpose());
    const KDL::RotationalInertia tensor(at_centre(0, 0), at_centre(1, 1), at_centre(2, 2), at_centre(0, 1),
                                        at_centre(0, 2), at_centre(1, 2));
    chain.addSegment(
        KDL::Segment(body.name, joint,
                     KDL::Frame(to_kdl(body.pose_in_parent.rotation), to_kdl(body.pose_in_parent.position)),
                     KDL::RigidBodyInertia(I.mass, to_kdl(c), tensor)));
  }
  return chain;
}

struct Arm {
  explicit Arm(std::uint64_t seed)
      : random(seed),
        model(random_model(Robot::arm, random, std::numeric_limits<double>::infinity())),
        state(random_state(model, random)) {
    // KDL's base is its world.
    state.base_pose = {};
    for (solver::ForceVector& f : state.f_ext) f = {};
    state.tau_ff.setZero();
  }
  Random random;
  solver::Model model;
  solver::State state;
};

std::vector<solver::Row> rows_on_the_tip(const solver::Model& model, int count, Random& random) {
  std::vector<solver::Row> rows;
  for (int i = 0; i < count; ++i) {
    solver::Row row;
    row.body = model.body_count() - 1;
    if (count == 6) {
      (i < 3 ? row.a.angular : row.a.linear)[i % 3] = 1.0;
    } else {
      row.a = {random.direction(), random.direction()};
    }
    row.b = random.uniform(-3.0, 3.0);
    rows.push_back(row);
  }
  return rows;
}

struct KdlAnswer {
  Eigen::VectorXd qdd;
  Eigen::VectorXd nu;
  Eigen::VectorXd constraint_torque;
};

KdlAnswer ask_kdl(const solver::Model& model, const solver::State& state, const DenseDynamics& poses,
                  const std::vector<solver::Row>& rows) {
  const auto n = static_cast<unsigned>(model.joint_count());
  const auto m = static_cast<unsigned>(rows.size());
  const solver::Vector3 lift = -model.gravity();
  KDL::JntArray q(n), qd(n), qdd(n), feed(n), constraint(n), beta(m);
  q.data = state.q;
  qd.data = state.qd;
  feed.data = state.tau_ff;
  KDL::Jacobian alpha(m);
  for (unsigned i = 0; i < m; ++i) {
    const solver::Row& row = rows[i];
    const solver::Matrix3 R = poses.bodies[static_cast<std::size_t>(row.body)].rotation.cast<double>();
    const solver::Vector3 force = R * row.a.linear;
    alpha.setColumn(i, KDL::Twist(to_kdl(force), to_kdl(solver::Vector3(R * row.a.angular))));
    beta(i) = row.b + force.dot(lift);
  }
  KDL::Wrenches wrenches(n);
  for (unsigned i = 0; i < n; ++i) {
    const solver::Matrix3 R = poses.bodies[i + 1].rotation.cast<double>();
    const solver::ForceVector& f = state.f_ext[i + 1];
    wrenches[i] = KDL::Wrench(to_kdl(solver::Vector3(R * f.linear)), to_kdl(solver::Vector3(R * f.angular)));
  }
  const KDL::Chain chain = to_kdl(model);  // the solver keeps a reference
  KDL::ChainHdSolver_Vereshchagin solver(chain, KDL::Twist(to_kdl(lift), KDL::Vector::Zero()), m);
  EXPECT_EQ(solver.CartToJnt(q, qd, qdd, alpha, beta, wrenches, feed, constraint), 0);
  KdlAnswer answer;
  answer.qdd = qdd.data;
  answer.constraint_torque = constraint.data;
  answer.nu = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(m));
  solver.getContraintForceMagnitude(answer.nu);
  return answer;
}

double relative(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / (1.0 + b.cwiseAbs().maxCoeff());
}

class KdlParity : public testing::TestWithParam<int> {
 protected:
  /// Three answers to one problem: KDL's, ours and the dense oracle's, which says who is wrong.
  void compare(const Arm& arm, const std::vector<solver::Row>& rows, std::uint64_t seed) {
    const OracleSolution want = solve(arm.model, arm.state, rows);
    const Eigen::VectorXd dense = want.vdot.cast<double>();
    const KdlAnswer kdl = ask_kdl(arm.model, arm.state, DenseDynamics(arm.model, arm.state), rows);
    EXPECT_LT(relative(kdl.qdd, dense), 1e-9) << "KDL against the oracle, seed " << seed;

    solver::Solver solver(arm.model);
    solver::Solution got(arm.model);
    ASSERT_EQ(solver.solve(arm.state, rows, got), solver::Status::ok);
    EXPECT_LT(relative(got.qdd, kdl.qdd), 1e-9) << "seed " << seed;
    Eigen::VectorXd nu(static_cast<Eigen::Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) nu[static_cast<Eigen::Index>(i)] = got.rows[i].nu;
    EXPECT_LT(relative(nu, -kdl.nu), 1e-9) << "seed " << seed;

    // KDL's constraint_torques are line 23's S'A nu, what adds to the feed-forward torque at the joint: our
    // sign.
    solver::PopovVereshchagin sweeps(arm.model);
    solver::ConstrainedMotion motion(arm.model);
    std::vector<solver::AccelerationRow> columns;
    for (const solver::Row& row : rows) columns.push_back({.body = row.body, .a = row.a, .b = row.b});
    ASSERT_EQ(sweeps.solve(arm.state, columns, motion), solver::Status::ok);
    EXPECT_LT(relative(motion.constraint_torque, kdl.constraint_torque), 1e-9) << "seed " << seed;
  }

  static constexpr std::uint64_t arms = 40;
};

TEST_P(KdlParity, Gravity) {
  for (std::uint64_t seed = 1; seed <= arms; ++seed) {
    Arm arm(seed);
    compare(arm, rows_on_the_tip(arm.model, GetParam(), arm.random), seed);
  }
}

TEST_P(KdlParity, ExternalForces) {
  for (std::uint64_t seed = 1; seed <= arms; ++seed) {
    Arm arm(seed);
    for (std::size_t i = 1; i < arm.state.f_ext.size(); ++i) {
      arm.state.f_ext[i] = {arm.random.vector(2.0), arm.random.vector(10.0)};
    }
    compare(arm, rows_on_the_tip(arm.model, GetParam(), arm.random), seed);
  }
}

TEST_P(KdlParity, FeedForwardTorques) {
  for (std::uint64_t seed = 1; seed <= arms; ++seed) {
    Arm arm(seed);
    for (Eigen::Index j = 0; j < arm.state.tau_ff.size(); ++j)
      arm.state.tau_ff[j] = arm.random.uniform(-5.0, 5.0);
    compare(arm, rows_on_the_tip(arm.model, GetParam(), arm.random), seed);
  }
}

TEST_P(KdlParity, NoGravity) {
  for (std::uint64_t seed = 1; seed <= arms; ++seed) {
    Random random(seed);
    solver::ModelBuilder builder(solver::BaseType::fixed, "base", random_inertia(random, 5.0));
    builder.set_gravity(solver::Vector3::Zero());
    std::string parent = "base";
    for (int i = 0; i < 7; ++i) {
      solver::Joint joint;
      joint.name = "joint" + std::to_string(i);
      joint.type = solver::JointType::continuous;
      joint.axis = random.direction();
      joint.actuated = true;
      const std::string name = "link" + std::to_string(i);
      const solver::RigidInertia inertia = random_inertia(random, random.uniform(0.5, 3.0));
      builder.add_link(name, parent, {random.rotation(), random.vector(0.3)}, joint, inertia);
      parent = name;
    }
    Arm arm(seed);
    arm.model = builder.build();
    compare(arm, rows_on_the_tip(arm.model, GetParam(), random), seed);
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, KdlParity, testing::Values(1, 3, 6));

}  // namespace
}  // namespace zwang::oracle
