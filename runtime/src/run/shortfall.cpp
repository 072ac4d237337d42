#include "run/shortfall.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

constexpr double tolerance = 0.01;     // [m/s^2] or [rad/s^2]
constexpr double wholly = 1.0 - 1e-9;  // of shares that add up to 1

}  // namespace

Shortfall find_shortfall(const StatementTable& statements, const solver::ConstraintSet& set,
                         const std::vector<InForce>& in_force, const solver::Solver& solver,
                         const solver::Solution& solution) noexcept {
  Shortfall worst;
  double least = tolerance;
  std::array<int, 8> opposing{};
  const std::size_t rows = std::min(set.rows().size(), solution.rows.size());
  for (std::size_t r = 0; r < rows; ++r) {
    const solver::Row& row = set.rows()[r];
    const auto c = static_cast<std::size_t>(row.constraint);
    const bool asks = row.kind != solver::RowKind::sum && row.kind != solver::RowKind::force;
    if (!asks || c >= in_force.size() || in_force[c].alpha < wholly) continue;
    const double residual = solution.rows[r].residual;
    if (std::abs(residual) <= least) continue;
    const int count = solver.opposing(static_cast<int>(r), opposing);
    Shortfall found;
    found.missed = statements.id(in_force[c].origin);
    found.origin = in_force[c].origin;
    found.residual = residual;
    for (int i = 0; i < count && found.count < static_cast<int>(found.held_by.size()); ++i) {
      const int by = set.rows()[static_cast<std::size_t>(opposing[static_cast<std::size_t>(i)])].constraint;
      if (by < 0 || static_cast<std::size_t>(by) >= in_force.size() || by == row.constraint) continue;
      const Origin& origin = in_force[static_cast<std::size_t>(by)].origin;
      found.held_by[static_cast<std::size_t>(found.count++)] = {statements.id(origin), origin};
    }
    if (found.count == 0) continue;
    worst = found;
    least = std::abs(residual);
  }
  return worst;
}

}  // namespace zwang::runtime
