// Several sets of rows, each solved whole, and their solutions blended: what all sets agree on is exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "carriage.hpp"
#include "law_problem.hpp"

namespace zwang::oracle {
namespace {

using solver::Row;
using solver::RowKind;
using solver::RowSet;
using solver::Status;
using solver::test::along_rail;
using Rows = std::vector<Row>;

/// Rows on level 0 that all sets share, and others on levels 1 and 2 that each set has for itself.
struct Blended {
  Blended(Robot robot, std::uint64_t seed) : problem(robot, seed, 12.0) {
    RowOptions options = everything;
    options.count = 3;
    shared = problem.rows(options);
    for (Row& row : shared) row.level = 0;
    options.count = 4;
    for (Rows& set : sets) {
      set = shared;
      for (Row row : problem.rows(options)) {
        row.level = std::max(row.level, 1);
        set.push_back(row);
      }
    }
  }
  solver::Solution solve(std::span<const RowSet> of) {
    solver::Solver solver(problem.model);
    solver::Solution solution(problem.model);
    EXPECT_EQ(solver.solve(problem.state, of, solution), Status::ok);
    return solution;
  }
  LawProblem problem;
  Rows shared;
  std::array<Rows, 3> sets;
};

bool is_equality(const Row& row) {
  return row.kind == RowKind::driver && std::isinf(row.weight);
}

// The commanded acceleration of a row of level 0 does not depend on the rows below it, nor on their shares.
// Motors or the row's own force may be at their limit.
TEST(BlendedSets, ASharedRowOfTheHighestLevelAcceleratesAsItDoesAlone) {
  double worst = 0.0;
  int compared = 0;
  for (const Robot robot : all_robots) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      Blended b(robot, seed);
      const RowSet alone{&b.shared, 1.0};
      const solver::Solution want = b.solve({&alone, 1});
      for (const double share : {0.005, 0.4, 0.995}) {
        const RowSet sets[] = {
            {&b.sets[0], share}, {&b.sets[1], 0.7 * (1.0 - share)}, {&b.sets[2], 0.3 * (1.0 - share)}};
        const solver::Solution got = b.solve(sets);
        for (std::size_t i = 0; i < b.shared.size(); ++i) {
          if (!is_equality(b.shared[i])) continue;
          worst = std::max(worst, std::abs(got.rows[i].residual - want.rows[i].residual));
          ++compared;
        }
      }
    }
  }
  std::printf("shared rows of level 0: %d compared, at most %.1e m/s^2 off\n", compared, worst);
  EXPECT_GT(compared, 1000);
  EXPECT_LT(worst, 1e-9);
}

TEST(BlendedSets, TorquesAreThoseOfEachSetByItsShare) {
  for (const Robot robot : all_robots) {
    Blended b(robot, 3);
    const double shares[] = {0.2, 0.5, 0.3};
    std::vector<RowSet> sets;
    Eigen::VectorXd want = Eigen::VectorXd::Zero(b.problem.model.joint_count());
    std::vector<double> nu;
    for (std::size_t k = 0; k < 3; ++k) {
      const RowSet alone{&b.sets[k], 1.0};
      const solver::Solution one = b.solve({&alone, 1});
      want += shares[k] * one.tau;
      for (const solver::RowSolution& row : one.rows) nu.push_back(row.nu);
      sets.push_back({&b.sets[k], shares[k]});
    }
    const solver::Solution got = b.solve(sets);
    EXPECT_LT(relative_difference(got.tau, want), 1e-9) << to_string(robot);
    ASSERT_EQ(got.rows.size(), nu.size());
    for (std::size_t i = 0; i < nu.size(); ++i)
      EXPECT_NEAR(got.rows[i].nu, nu[i], 1e-9 * (1.0 + std::abs(nu[i])));
    for (int j = 0; j < b.problem.model.joint_count(); ++j) {
      EXPECT_LE(std::abs(got.tau(j)), b.problem.model.joint(j).max_effort);
    }
  }
}

TEST(BlendedSets, ARangeThatAllSetsKeepIsKept) {
  int binding = 0;
  for (const Robot robot : all_robots) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Blended b(robot, seed);
      const RowSet sets[] = {{&b.sets[0], 0.35}, {&b.sets[1], 0.65}};
      const solver::Solution got = b.solve(sets);
      std::vector<solver::Solution> alone;
      for (const RowSet& set : sets) {
        const RowSet one{set.rows, 1.0};
        alone.push_back(b.solve({&one, 1}));
      }
      for (std::size_t i = 0; i < b.shared.size(); ++i) {
        if (!is_limit(b.shared[i].kind)) continue;
        const double most =
            std::max(std::abs(alone[0].rows[i].residual), std::abs(alone[1].rows[i].residual));
        EXPECT_LE(std::abs(got.rows[i].residual), most + 1e-9) << to_string(robot) << " " << seed;
        binding += got.rows[i].nu != 0.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(binding, 20);
}

// 10 kg: 3 m/s^2 of one set and 1 m/s^2 of the other.
TEST(BlendedSets, ResidualsAreThoseOfTheMotionAndForcesThoseOfTheSet) {
  const solver::Model model = solver::test::carriage(solver::infinity);
  solver::Solver solver(model);
  solver::Solution solution(model);
  const Rows now{along_rail(RowKind::driver, 3.0, 500.0)};
  const Rows before{along_rail(RowKind::driver, 1.0, 500.0), along_rail(RowKind::upper, 2.0, 500.0)};
  const RowSet sets[] = {{&now, 0.25}, {&before, 0.75}};
  ASSERT_EQ(solver.solve(solver::State(model), sets, solution), Status::ok);
  EXPECT_NEAR(solution.tau[0], 15.0, 1e-12);
  EXPECT_NEAR(solution.qdd[0], 1.5, 1e-12);
  ASSERT_EQ(solution.rows.size(), 3u);
  EXPECT_NEAR(solution.rows[0].nu, 30.0, 1e-12);
  EXPECT_NEAR(solution.rows[0].residual, -1.5, 1e-12);
  EXPECT_NEAR(solution.rows[1].nu, 10.0, 1e-12);
  EXPECT_NEAR(solution.rows[1].residual, 0.5, 1e-12);
  EXPECT_EQ(solution.rows[2].residual, 0.0);
}

TEST(BlendedSets, ThatDoNotFitAreRefused) {
  const solver::Model model = solver::test::carriage(solver::infinity);
  solver::Solver solver(model, {.row_capacity = 4, .set_capacity = 2});
  solver::Solution solution(model);
  const Rows two(2, along_rail(RowKind::driver, 1.0, 500.0)), three(3, two[0]);
  const RowSet fits[] = {{&two, 0.5}, {&two, 0.5}}, too_long[] = {{&three, 1.0}},
               too_many[] = {{&two, 0.5}, {&two, 0.25}, {&two, 0.25}};
  const solver::State state(model);
  EXPECT_EQ(solver.solve(state, fits, solution), Status::ok);
  EXPECT_EQ(solver.solve(state, too_long, solution), Status::capacity_exceeded);
  EXPECT_EQ(solver.solve(state, too_many, solution), Status::capacity_exceeded);
}

}  // namespace
}  // namespace zwang::oracle
