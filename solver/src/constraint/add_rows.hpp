/// How rows get into the sweeps: the one place for the solver, for Algorithm 1 alone and for the analysis.
#pragma once

#include "constraint/ground.hpp"
#include "sweep/sweeps.hpp"

namespace zwang::solver {

/// The rows of the ground at the configuration and the twists in `sweeps`, where they change. Each is handed
/// to `take(index, row)`, too.
template <class Take>
void add_ground_rows(const Ground& ground, Sweeps& sweeps, Take take) noexcept {
  if (!sweeps.is_articulated) sweeps.robot_rows.clear();
  const int count = ground.row_count();
  for (int i = 0; i < count; ++i) {
    const GroundRow row = ground.row(i, sweeps);
    if (!sweeps.is_articulated) {
      sweeps.robot_rows.add_row(row.body);
      sweeps.robot_rows.last_column() = row.a;
    }
    take(i, row);
  }
}

/// A row of the public headers, whose forces are written in the coordinates of their bodies; returns its id.
template <class BodyRow>
int add_row(const BodyRow& row, Sweeps& sweeps) noexcept {
  const auto write = [&sweeps](int body, const ForceVector& a) {
    if (body == 0) {  // whose coordinates are the base's
      sweeps.task_rows.last_column() << a.angular, a.linear;
      return;
    }
    sweeps.bodies[static_cast<std::size_t>(body)].to_base(a, sweeps.task_rows.last_column());
  };
  const int id = sweeps.task_rows.add_row(row.body);
  write(row.body, row.a);
  if (row.reference_body >= 0) {
    sweeps.task_rows.extend_last_row(row.reference_body);
    write(row.reference_body, -row.a_reference);
  }
  return id;
}

}  // namespace zwang::solver
