/// How rows get into the sweeps: the one place for the solver, for Algorithm 1 alone and for the analysis.
#pragma once

#include "constraint/ground.hpp"
#include "sweep/sweeps.hpp"

namespace zwang::solver {

/// a . x, number by number, as they have just been written.
template <class Axis>
double along(const Axis& a, const Vector6& x) {
  return ((a(0) * x(0) + a(1) * x(1)) + (a(2) * x(2) + a(3) * x(3))) + (a(4) * x(4) + a(5) * x(5));
}

/// The rows of the ground where the bodies are in `sweeps`, the first ones of the robot's.
inline void add_ground_rows(const Ground& ground, Sweeps& sweeps) noexcept {
  sweeps.robot_rows.clear();
  for (int i = 0; i < ground.row_count(); ++i) {
    sweeps.robot_rows.add_row(static_cast<int>(ground.body(i)));
    sweeps.robot_rows.last_column() = ground.axis(i, sweeps);
  }
}

/// By row of the ground that stands in `sweeps`: the wanted acceleration less what velocities alone give.
inline void find_ground_bias(const Ground& ground, const Sweeps& sweeps, Eigen::VectorXd& bias) noexcept {
  for (int i = 0; i < ground.row_count(); ++i) {
    const auto a = sweeps.robot_rows.column(i);
    bias(i) = ground.bias(i, a, sweeps) - along(a, sweeps.bodies[ground.body(i)].c);
  }
}

/// By row of the ground: minus how fast its wheel slips along it.
inline void find_ground_slip(const Ground& ground, const Sweeps& sweeps, Eigen::VectorXd& slip) noexcept {
  for (int i = 0; i < ground.row_count(); ++i)
    slip(i) = -along(sweeps.robot_rows.column(i), sweeps.bodies[ground.body(i)].v);
}

/// A row of the public headers, whose forces are written in the coordinates of their bodies; returns its id.
template <class BodyRow>
int add_row(const BodyRow& row, const Model& model, Sweeps& sweeps) noexcept {
  const auto write = [&](int body, const ForceVector& a) {
    if (body == 0) {  // whose coordinates are the base's
      sweeps.task_rows.last_column() << a.angular, a.linear;
      return;
    }
    need_axes(model, static_cast<std::size_t>(body), sweeps);
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
