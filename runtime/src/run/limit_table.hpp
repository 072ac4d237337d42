/// How near a run comes to each of its limits.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "run/statement_table.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

class LimitTable {
 public:
  LimitTable(const StatementTable& statements, const lang::Robot& robot);

  /// Takes in one tick. `set`: the newest one; `blends`: others are in force beside it.
  void update(const StatementTable& statements, const solver::ConstraintSet& set,
              const std::vector<InForce>& in_force, const solver::Solution& solution,
              const Eigen::VectorXd& tau, bool blends) noexcept;

  std::vector<LimitReport> reports() const;
  std::optional<LimitReport> now() const { return report_of(tightest()); }

  /// How near a value came, so far: apart from the names, as it is what each tick goes through.
  struct Nearest {
    double limit = 0.0;
    double worst = 0.0;
    double margin = std::numeric_limits<double>::infinity();  ///< until it is seen
  };
  /// The limit that the last tick was at.
  struct Tightest {
    int limit = -1;  ///< none
    Nearest now;
  };
  Tightest tightest() const noexcept { return {tightest_, tightest_now_}; }
  std::optional<LimitReport> report_of(const Tightest& tightest) const;

 private:
  /// The limits of a statement by quantity, -1 where it has none.
  using Indices = std::array<int, 4>;

  void compare_motion(const Indices& of, const solver::AxisConstraint& constraint,
                      const solver::Coordinate& now) noexcept;
  void compare_acceleration(const Indices& of, const solver::AxisConstraint& constraint,
                            const solver::Coordinate& now, const solver::Row& row,
                            const solver::Solution& solution) noexcept;
  void compare_force(const Indices& of, const solver::AxisConstraint& constraint, const solver::Row& row,
                     double nu) noexcept;
  void compare_rows(const StatementTable& statements, const solver::ConstraintSet& set,
                    const std::vector<InForce>& in_force, const solver::Solution& solution,
                    bool blends) noexcept;
  LimitReport report_of(std::size_t index, const Nearest& nearest) const;
  /// A position or a region; the force of a driver; anything else.
  enum class Kind { other, place, push };
  void compare(int index, double value, double low, double high, Kind kind = Kind::other) noexcept;
  void take(int index, const Nearest& now, double range, double least_share, Kind kind) noexcept;

  std::vector<LimitReport> limits_;  ///< their names
  std::vector<Nearest> nearest_;     ///< by limit
  std::vector<double> torque_;       ///< by joint: what its motor can do, 0 without one
  std::vector<Indices> of_statement_;
  std::size_t first_torque_ = 0;
  // At its limit now: the one with the least share of its range left.
  int tightest_ = -1;
  Kind tightest_kind_ = Kind::other;
  double tightest_share_ = 0.0;
  Nearest tightest_now_;
};

}  // namespace zwang::runtime
