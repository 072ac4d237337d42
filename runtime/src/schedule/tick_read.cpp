// Step 9 of the tick: what the solution says of the drivers, for the guards of the next tick.
#include <cmath>

#include "schedule/parts.hpp"

namespace zwang::runtime {

/// Reads the solution of the rows, for the guards of the next tick.
void Scheduler::Parts::read(const solver::Solution& solution) noexcept {
  mobility = solution.mobility;
  for (ActiveAxis& a : axes) {
    a.row = -1;
    if (!a.says->driver) a.reading = {};
  }
  std::size_t row = 0, first_source = 0;
  for (std::size_t set = 0; set < blend->sets().size(); ++set) {
    for (const solver::Row& asked : blend->sets()[set].constraints.rows()) {
      if (row == solution.rows.size()) return;
      const solver::RowSolution& answer = solution.rows[row];
      if (solver::is_limit(asked.kind) && answer.residual == 0.0) {  // it tells nothing
        ++row;
        continue;
      }
      ActiveAxis* axis = sources[first_source + static_cast<std::size_t>(asked.constraint)];
      if (axis != nullptr) read_row(set, asked, answer, *axis);
      const bool drives = asked.kind == solver::RowKind::driver && set == 0;
      if (axis != nullptr && drives) {
        axis->row = static_cast<int>(row);
        axis->is_met = answer.status == solver::RowStatus::held && !answer.saturated;
      }
      ++row;
    }
    first_source += blend->sets()[set].in_force.size();
  }
}

/// Of the task that is active what its own set says; the force, which the sets before go on to make, of all.
void Scheduler::Parts::read_row(std::size_t set, const solver::Row& row, const solver::RowSolution& answer,
                                ActiveAxis& axis) noexcept {
  AxisReading& reading = axis.reading;
  if (row.kind == solver::RowKind::driver || row.kind == solver::RowKind::force) {
    const double force = blend->sets()[set].share * answer.nu;
    if (set > 0) {
      reading.force += force;
    } else {
      reading = {force, answer.residual, answer.saturated};
    }
  } else if (set == 0 && !axis.says->driver && std::abs(answer.residual) > std::abs(reading.residual)) {
    reading.residual = answer.residual;
  }
}

}  // namespace zwang::runtime
