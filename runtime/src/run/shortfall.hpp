/// The row that falls farthest short of what it asks, and who holds it back.
#pragma once

#include <array>

#include "run/statement_table.hpp"
#include "zwang/runtime/scheduler.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

struct Shortfall {
  struct Holder {
    int statement = -1;
    Origin origin;
  };
  int missed = -1;  ///< statement; -1: nothing falls short because of another row
  Origin origin;
  double residual = 0.0;  ///< [m/s^2] or [rad/s^2]
  std::array<Holder, 4> held_by;
  int count = 0;  ///< of `held_by`, the strongest first
};

/// Does not allocate. Rows that only their own force range holds back are not over-constrained.
Shortfall find_shortfall(const StatementTable& statements, const solver::ConstraintSet& set,
                         const std::vector<InForce>& in_force, const solver::Solver& solver,
                         const solver::Solution& solution) noexcept;

}  // namespace zwang::runtime
