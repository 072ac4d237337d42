// The cap on the active set's iterations: never met as it stands, and harmless where it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "law_problem.hpp"

namespace zwang::oracle {
namespace {

using solver::Row;
using solver::RowKind;
using solver::RowSolution;
using solver::Solution;
using solver::Status;

constexpr int seeds = 300;
constexpr double rounding = 1e-9;  // relative

struct BusyProblem : LawProblem {
  BusyProblem(Robot robot, std::uint64_t seed)
      : LawProblem(robot, seed, 1.0 + static_cast<double>(seed % 40)), rows(LawProblem::rows(everything)) {}
  std::vector<Row> rows;
};

bool is_inside(double x, double low, double high) {
  const double slack = rounding * (1.0 + std::abs(x));
  return x >= low - slack && x <= high + slack;
}

bool is_finite(const Solution& s) {
  bool finite = s.tau.allFinite() && s.qdd.allFinite();
  for (const solver::MotionVector& a : s.acceleration) finite = finite && a.vector().allFinite();
  for (const RowSolution& row : s.rows) {
    finite = finite && std::isfinite(row.nu) && std::isfinite(row.phi) && std::isfinite(row.residual);
  }
  return finite;
}

/// The error of a row's force, in words; empty: the force is inside its bounds.
std::string beyond_bounds(const Row& row, const RowSolution& got, int lowest_level) {
  const bool is_one_sided = is_limit(row.kind);
  double low = row.lo;
  double high = row.hi;
  if (is_one_sided && row.level < lowest_level) {  // below its own level it holds with what that takes
    if (low < 0.0) low = -no_limit;
    if (high > 0.0) high = no_limit;
  }
  if (is_inside(got.nu, low, high) && got.phi >= 0.0 && got.phi <= 1.0) return {};
  return "nu " + std::to_string(got.nu) + " of [" + std::to_string(low) + ", " + std::to_string(high) +
         "], phi " + std::to_string(got.phi);
}

void expect_inside_bounds(const BusyProblem& p, const Solution& s) {
  for (int j = 0; j < p.model.joint_count(); ++j) {
    const solver::Joint& joint = p.model.joint(j);
    EXPECT_LE(std::abs(s.tau[j]), joint.actuated ? joint.max_effort : 0.0) << joint.name;
  }
  int lowest = 0;
  for (const Row& row : p.rows) lowest = std::max(lowest, row.level);
  for (std::size_t i = 0; i < p.rows.size(); ++i)
    EXPECT_EQ(beyond_bounds(p.rows[i], s.rows[i], lowest), "") << "row " << i;
}

/// The accelerations are those of the torques, however good these are.
void expect_motion_of_torques(const BusyProblem& p, const Solution& s) {
  solver::State commanded = p.state;
  for (int j = 0; j < p.model.joint_count(); ++j) {
    if (p.model.joint(j).actuated) commanded.tau_ff[j] = s.tau[j];
  }
  solver::PopovVereshchagin forward(p.model);
  solver::ConstrainedMotion motion(p.model);
  ASSERT_EQ(forward.solve(commanded, {}, motion), Status::ok);
  EXPECT_LT(relative_difference(s.qdd, motion.qdd), 1e-9);
}

class IterationLimit : public testing::TestWithParam<int> {};

TEST_P(IterationLimit, LeavesEveryNumberFiniteAndInsideItsBounds) {
  int met = 0;
  for (const Robot robot : all_robots) {
    int met_here = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE(std::string(to_string(robot)) + ", seed " + std::to_string(seed));
      const BusyProblem p(robot, seed);
      solver::Solver solver(p.model, {.max_iterations = GetParam()});
      Solution s(p.model);
      const Status status = solver.solve(p.state, p.rows, s);
      if (status == Status::iteration_limit) ++met_here;
      EXPECT_TRUE(status == Status::ok || status == Status::iteration_limit) << to_string(status);
      EXPECT_TRUE(is_finite(s));
      expect_inside_bounds(p, s);
      expect_motion_of_torques(p, s);
      if (HasFailure()) return;
    }
    EXPECT_TRUE(met_here > 0 || GetParam() > 1) << to_string(robot) << " never met the lowest cap";
    met += met_here;
  }
  std::printf("a cap of %d: met in %d of %zu problems\n", GetParam(), met, seeds * std::size(all_robots));
  EXPECT_GT(met, 500) << "nothing proved where the cap is not met";
}

INSTANTIATE_TEST_SUITE_P(Caps, IterationLimit, testing::Values(1, 2, 3));

TEST(DefaultIterationLimit, IsNeverMetAsItStands) {
  std::map<int, int> counts;
  for (const Robot robot : all_robots) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const BusyProblem p(robot, seed);
      solver::Solver solver(p.model);
      Solution s(p.model);
      ASSERT_EQ(solver.solve(p.state, p.rows, s), Status::ok) << to_string(robot) << ", seed " << seed;
      expect_inside_bounds(p, s);
      ++counts[s.iterations];
    }
  }
  std::printf("problems by iterations, all stages:");
  for (const auto& [iterations, problems] : counts) std::printf("  %d: %d", iterations, problems);
  std::printf("\n");
  EXPECT_LT(counts.rbegin()->first, solver::Settings{}.max_iterations / 4) << "far from the cap of one stage";
}

}  // namespace
}  // namespace zwang::oracle
