// Prints what the solver makes of seeded problems, a line a vector: torques, then accelerations. Two builds
// of it, for two processors for one, are compared number by number.
#include <cstdio>

#include "oracle/random_problem.hpp"
#include "zwang/solver/solver.hpp"

namespace {

using namespace zwang;

void print(const Eigen::VectorXd& vector) {
  for (const double number : vector) std::printf("%.17g ", number);
  std::printf("\n");
}

/// Rows that nothing bounds and none contradicts: their solution is unique, and well conditioned with it.
constexpr oracle::RowOptions rows_with_one_answer{.one_sided = 0.0,
                                                  .force = 0.0,
                                                  .duplicate = 0.0,
                                                  .relative = 0.0,
                                                  .weight = 0.0,
                                                  .sum = 0.0,
                                                  .bound = 1e4};

}  // namespace

int main() {
  for (const oracle::Robot robot : oracle::all_robots) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      oracle::Random random(seed);
      const solver::Model model = oracle::random_model(robot, random, 40.0);
      const solver::State state = oracle::random_state(model, random);
      const std::vector<solver::Row> rows = oracle::random_rows(model, rows_with_one_answer, random);
      solver::Solver solver(model);
      solver::Solution solution(model);
      if (solver.solve(state, rows, solution) != solver::Status::ok) return 1;
      print(solution.tau);
      print(solution.qdd);
    }
  }
}
