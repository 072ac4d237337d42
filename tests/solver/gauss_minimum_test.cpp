// Gauss's principle: of all accelerations that keep the constraints, the solver's has the smallest Zwang. The
// Zwang is 1/2 (x - x_free)' M (x - x_free), with M and x_free from the dense oracle.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

#include "law_problem.hpp"
#include "zwang/solver/popov_vereshchagin.hpp"

namespace zwang::oracle {
namespace {

constexpr int problems = 60;
constexpr int perturbations = 20;

struct Zwang {
  explicit Zwang(const DenseDynamics& d, const solver::State& state) : M(d.M) {
    Vector force = -d.h;
    force.tail(d.joints) += state.tau_ff.cast<Real>();
    free = M.ldlt().solve(force);
  }
  Real operator()(const Vector& x) const { return (x - free).dot(M * (x - free)) / 2; }
  Matrix M;
  Vector free;
};

/// Directions that change nothing along `rows`.
Matrix left_free(const Matrix& rows) {
  if (rows.rows() == 0) return Matrix::Identity(rows.cols(), rows.cols());
  Eigen::ColPivHouseholderQR<Matrix> qr(rows.transpose());
  qr.setThreshold(1e-12L);
  return Matrix(qr.householderQ()).rightCols(rows.cols() - qr.rank());
}

Vector random_vector(Eigen::Index size, Random& random) {
  Vector v(size);
  for (Real& x : v) x = static_cast<Real>(random.uniform(-1.0, 1.0));
  return v;
}

class GaussMinimum : public testing::TestWithParam<Robot> {};

TEST_P(GaussMinimum, NoAccelerationInsideTheEqualitiesHasASmallerZwang) {
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= problems; ++seed) {
    LawProblem p(GetParam(), seed);
    const DenseDynamics dense(p.model, p.state);
    const std::vector<solver::Row> rows =
        p.rows({.count = 3, .one_sided = 0, .force = 0, .weight = 0, .sum = 0});
    solver::PopovVereshchagin sweeps(p.model);
    solver::ConstrainedMotion motion(p.model);
    ASSERT_EQ(sweeps.solve(p.state, acceleration_rows(rows), motion), solver::Status::ok);

    const Vector x = generalised(p.model, motion.acceleration, motion.qdd);
    const LinearRows task = dense.rows(rows);
    const Matrix held = stack(task.jacobian, dense.ground().jacobian);
    const Zwang zwang(dense, p.state);
    const Real least = zwang(x);
    const Matrix N = left_free(held);
    for (int k = 0; k < perturbations && N.cols() > 0; ++k) {
      const Vector step = N * random_vector(N.cols(), p.random);
      // No slope along any direction that the constraints leave, so the quadratic term alone is left.
      const Vector pull = zwang.M * (x - zwang.free);
      EXPECT_LT(std::abs(pull.dot(step)), 1e-10L * (1 + pull.norm()) * step.norm()) << "seed " << seed;
      EXPECT_GT(zwang(x + step), least) << "seed " << seed;
      ++tried;
    }
  }
  EXPECT_GE(tried, 100);
}

TEST_P(GaussMinimum, NoAccelerationInsideTheLimitsHasASmallerZwang) {
  int active = 0;
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= problems; ++seed) {
    LawProblem p(GetParam(), seed);
    const DenseDynamics dense(p.model, p.state);
    std::vector<solver::Row> rows =
        p.rows({.count = 3, .one_sided = 1, .force = 0, .duplicate = 0, .weight = 0, .sum = 0});
    for (solver::Row& row : rows) {
      row.lo = row.kind == solver::RowKind::upper ? -1e6 : 0.0;
      row.hi = row.kind == solver::RowKind::lower ? 1e6 : 0.0;
    }
    solver::Solver solver(p.model);
    solver::Solution solution(p.model);
    ASSERT_EQ(solver.solve(p.state, rows, solution), solver::Status::ok);
    bool kept = true;
    for (const solver::RowSolution& row : solution.rows) {
      kept = kept && row.status == solver::RowStatus::held;
      active += row.nu != 0.0;
    }
    if (!kept) continue;  // the limits contradict each other

    const Vector x = generalised(p.model, solution.acceleration, solution.qdd);
    const LinearRows task = dense.rows(rows);
    const Matrix N = left_free(dense.ground().jacobian);
    const Zwang zwang(dense, p.state);
    const Real least = zwang(x);
    for (int k = 0; k < perturbations; ++k) {
      const Vector step = N * random_vector(N.cols(), p.random);
      for (const Real length : {1.0L, 1e-2L, 1e-4L}) {
        const Vector other = x + length * step;
        const Vector s = task.jacobian * other - task.rhs;
        bool inside = true;
        for (std::size_t i = 0; i < rows.size(); ++i) {
          const Real beyond = rows[i].kind == solver::RowKind::upper ? s[static_cast<Eigen::Index>(i)]
                                                                     : -s[static_cast<Eigen::Index>(i)];
          inside = inside && beyond <= 0;
        }
        if (!inside) continue;
        EXPECT_GT(zwang(other) - least, -1e-10L * (1 + least)) << "seed " << seed;
        ++compared;
      }
    }
  }
  EXPECT_GT(active, 20);
  EXPECT_GT(compared, 500);
}

// Bases whose motors make every wrench: what they command is then the constraint force itself.
INSTANTIATE_TEST_SUITE_P(Robots, GaussMinimum,
                         testing::Values(Robot::arm, Robot::tree, Robot::mecanum, Robot::omni,
                                         Robot::differential, Robot::kelo, Robot::mecanum_arm),
                         [](const auto& drawn) { return to_string(drawn.param); });

}  // namespace
}  // namespace zwang::oracle
