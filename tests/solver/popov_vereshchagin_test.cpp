// Algorithm 1 as a plain call: the torque to command, dependent and contradicting rows, damping.
#include "zwang/solver/popov_vereshchagin.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "law_problem.hpp"

namespace zwang::oracle {
namespace {

using solver::AccelerationRow;
using solver::ConstrainedMotion;
using solver::PopovVereshchagin;
using solver::Status;

/// L = A M^-1 A' and b - g of given rows and the ground's, ground first, from the dense oracle.
struct BaseProblem {
  BaseProblem(const LawProblem& p, const std::vector<solver::Row>& rows) {
    const DenseDynamics dense(p.model, p.state);
    const LinearRows task = dense.rows(rows);
    const LinearRows ground = dense.ground();
    A = stack(ground.jacobian, task.jacobian);
    Vector force = -dense.h;
    force.tail(dense.joints) += p.state.tau_ff.cast<Real>();
    const Eigen::LDLT<Matrix> M(dense.M);
    free = M.solve(force);
    Vector b(A.rows());
    b << ground.rhs, task.rhs;
    rhs = b - A * free;
    response = M.solve(Matrix(A.transpose()));
    L = A * response;
  }
  /// Rows that were drawn one by one may lie along each other.
  bool is_independent() const {
    const Vector eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix>(L).eigenvalues();
    return eigenvalues[0] > 1e-6L * eigenvalues[eigenvalues.size() - 1];
  }
  /// nu of least norm among those that bring L nu nearest to b - g.
  Vector nu(int rank) const {
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(L);
    Vector out = Vector::Zero(L.rows());
    for (Eigen::Index k = L.rows() - rank; k < L.rows(); ++k) {
      const Vector u = eigen.eigenvectors().col(k);
      out += u * (u.dot(rhs) / eigen.eigenvalues()[k]);
    }
    return out;
  }
  Matrix A, L, response;
  Vector free, rhs;
};

RowOptions equalities(int count) {
  return {.count = count, .one_sided = 0, .force = 0, .duplicate = 0};
}

class PopovVereshchaginTest : public testing::TestWithParam<Robot> {};

TEST_P(PopovVereshchaginTest, TheCommandedTorqueMakesTheSameMotionWithoutRows) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    LawProblem p(GetParam(), seed);
    PopovVereshchagin solver(p.model);
    ConstrainedMotion constrained(p.model);
    ConstrainedMotion plain(p.model);
    const auto rows = acceleration_rows(p.rows(equalities(3)));
    ASSERT_EQ(solver.solve(p.state, rows, constrained), Status::ok);
    solver::State commanded = p.state;
    commanded.tau_ff = constrained.tau_control;
    commanded.f_ext.front() += constrained.base_wrench;
    ASSERT_EQ(solver.solve(commanded, {}, plain), Status::ok);
    EXPECT_LT(relative_difference(plain.qdd, constrained.qdd), 1e-9) << "seed " << seed;
    for (std::size_t i = 0; i < plain.acceleration.size(); ++i) {
      EXPECT_LT(relative_difference(plain.acceleration[i].vector(), constrained.acceleration[i].vector()),
                1e-9)
          << "seed " << seed << " body " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, PopovVereshchaginTest, testing::ValuesIn(all_robots),
                         [](const auto& drawn) { return to_string(drawn.param); });

/// Independent rows on an arm, then copies and mixtures of them with the set-points that follow.
struct Dependent {
  explicit Dependent(std::uint64_t seed, double contradiction = 0.0)
      : p(Robot::arm, seed), rows(p.rows(equalities(p.random.pick(1, 3)))) {
    for (solver::Row& row : rows) {  // one body and no reference: mixtures of rows are rows
      row.body = p.model.body_count() - 1;
      row.reference_body = -1;
    }
    independent = static_cast<int>(rows.size());
    const int more = p.random.pick(1, 3);
    for (int i = 0; i < more; ++i) {
      solver::Row row = rows.front();
      if (p.random.chance(0.5)) {
        row = rows[static_cast<std::size_t>(p.random.pick(0, independent - 1))];
      } else {
        row.a = {};
        row.b = 0.0;
        for (int k = 0; k < independent; ++k) {
          const double share = p.random.uniform(-1.0, 1.0);
          row.a += rows[static_cast<std::size_t>(k)].a * share;
          row.b += rows[static_cast<std::size_t>(k)].b * share;
        }
      }
      row.b += contradiction * p.random.uniform(-1.0, 1.0);
      rows.push_back(row);
    }
  }
  LawProblem p;
  std::vector<solver::Row> rows;
  int independent = 0;
};

TEST(DependentRows, ConsistentOnesGiveTheMotionOfTheIndependentOnesAndTheShortestMultipliers) {
  double worst_motion = 0.0;
  double worst_nu = 0.0;
  int sets = 0;
  for (std::uint64_t seed = 1; sets < 2000; ++seed) {
    const Dependent problem(seed);
    PopovVereshchagin solver(problem.p.model);
    ConstrainedMotion motion(problem.p.model);
    ASSERT_EQ(solver.solve(problem.p.state, acceleration_rows(problem.rows), motion), Status::ok);
    const std::vector<solver::Row> independent(problem.rows.begin(),
                                               problem.rows.begin() + problem.independent);
    const BaseProblem alone(problem.p, independent);
    if (!alone.is_independent()) continue;
    ++sets;
    const BaseProblem all(problem.p, problem.rows);
    const Vector vdot = alone.free + alone.response * alone.L.ldlt().solve(alone.rhs);
    const double off = relative_difference(motion.qdd, vdot.cast<double>());
    const auto count = static_cast<Eigen::Index>(problem.rows.size());
    const Vector nu = all.nu(problem.independent);
    const double off_nu = relative_difference(motion.nu.head(count), nu.cast<double>());
    EXPECT_LT(off, 1e-9) << "seed " << seed;
    EXPECT_LT(off_nu, 1e-9) << "seed " << seed;
    EXPECT_EQ(motion.rank, problem.independent) << "seed " << seed;
    worst_motion = std::max(worst_motion, off);
    worst_nu = std::max(worst_nu, off_nu);
  }
  RecordProperty("worst_motion", std::to_string(worst_motion));
  std::printf("2000 dependent sets: motion %.1e, multipliers %.1e\n", worst_motion, worst_nu);
}

TEST(DependentRows, ContradictingOnesAreMetInTheLeastSquaresSense) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Dependent problem(seed, 1.0);
    PopovVereshchagin solver(problem.p.model);
    ConstrainedMotion motion(problem.p.model);
    ASSERT_EQ(solver.solve(problem.p.state, acceleration_rows(problem.rows), motion), Status::ok);
    const BaseProblem all(problem.p, problem.rows);
    const auto count = static_cast<Eigen::Index>(problem.rows.size());
    const Vector nu = all.nu(problem.independent);
    const Vector residual = all.L * nu - all.rhs;
    EXPECT_GT(residual.norm(), 1e-6L) << "seed " << seed;
    EXPECT_LT(relative_difference(motion.nu.head(count), nu.cast<double>()), 1e-8) << "seed " << seed;
    EXPECT_LT(relative_difference(motion.residual.head(count), residual.cast<double>()), 1e-8)
        << "seed " << seed;
  }
}

TEST(Damping, AddsItsSquareToLAndLeavesTheRank) {
  for (const double damping : {0.01, 0.1, 1.0}) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const Dependent problem(seed, 1.0);
      PopovVereshchagin solver(problem.p.model, {.damping = damping});
      ConstrainedMotion motion(problem.p.model);
      ASSERT_EQ(solver.solve(problem.p.state, acceleration_rows(problem.rows), motion), Status::ok);
      EXPECT_EQ(motion.rank, problem.independent) << "seed " << seed;
      const BaseProblem all(problem.p, problem.rows);
      const auto count = static_cast<Eigen::Index>(problem.rows.size());
      Matrix damped = all.L;
      damped.diagonal().array() += static_cast<Real>(damping) * static_cast<Real>(damping);
      const Vector nu = damped.ldlt().solve(all.rhs);
      EXPECT_LT(relative_difference(motion.nu.head(count), nu.cast<double>()), 1e-8)
          << "seed " << seed << ", damping " << damping;
    }
  }
}

}  // namespace
}  // namespace zwang::oracle
