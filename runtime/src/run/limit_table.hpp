/// How near a run comes to each of its limits.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "run/statement_table.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

class LimitTable {
 public:
  LimitTable(const StatementTable& statements, const lang::Robot& robot);

  /// Takes in one tick. Rows that are fading are left out: they are not in force yet, or no more.
  void update(const StatementTable& statements, const solver::ConstraintSet& set,
              const std::vector<InForce>& in_force, const solver::Solution& solution,
              const Eigen::VectorXd& tau) noexcept;

  std::vector<LimitReport> reports() const;
  std::optional<LimitReport> now() const;

 private:
  struct Limit {
    LimitReport report;
    bool seen = false;
  };
  /// The limits of a statement by quantity, -1 where it has none.
  using Indices = std::array<int, 4>;

  void compare(int index, double value, double low, double high, bool wanted = false) noexcept;

  std::vector<Limit> limits_;
  std::vector<Indices> of_statement_;
  std::size_t first_torque_ = 0;
  // At its limit now: the one with the least share of its range left.
  int tightest_ = -1;
  double tightest_share_ = 0.0;
  double tightest_value_ = 0.0;
  double tightest_margin_ = 0.0;
  double tightest_limit_ = 0.0;
};

}  // namespace zwang::runtime
