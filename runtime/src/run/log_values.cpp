// The values of a tick, in the columns of LogLayout.
#include <algorithm>
#include <cmath>

#include "run/log_columns.hpp"
#include "run/log_layout.hpp"
#include "schedule/acceleration_of.hpp"
#include "schedule/plane_norm.hpp"

namespace zwang::runtime {

void LogLayout::put(int column, double value) noexcept {
  if (column >= 0) values_[static_cast<std::size_t>(column)] = value;
}

std::span<const double> LogLayout::fill(const StatementTable& statements, const Tick& tick) noexcept {
  std::fill(values_.begin(), values_.end(), log_column::blank);
  const solver::State& state = tick.known.state;
  put(log_column::time, tick.time);
  inputs_.write(tick.sensed, tick.parameters,
                std::span(values_).subspan(static_cast<std::size_t>(first_input_), inputs_.columns().size()));
  if (tick.scheduler.task() >= 0) put(log_column::task, tick.scheduler.task());
  put(log_column::guard, static_cast<double>(tick.guard_status));
  put(log_column::base_x, state.base_pose.position.x());
  put(log_column::base_y, state.base_pose.position.y());
  put(log_column::base_yaw, solver::yaw_of(state.base_pose.rotation));
  put(log_column::base_vx, state.base_twist.linear.x());
  put(log_column::base_vy, state.base_twist.linear.y());
  put(log_column::base_wz, state.base_twist.angular.z());
  if (tick.event.code != EventCode::none) {
    put(log_column::event, static_cast<double>(tick.event.code));
    if (tick.event.signal >= 0) put(log_column::event_of, tick.event.signal);
    put(log_column::event_value, tick.event.value);
  }
  const Eigen::Index joints = std::min({state.q.size(), state.qd.size(), tick.tau.size()});
  for (int j = 0; j < static_cast<int>(joints); ++j) {
    put(first_joint_ + 3 * j, state.q(j));
    put(first_joint_ + 3 * j + 1, state.qd(j));
    put(first_joint_ + 3 * j + 2, tick.tau(j));
  }
  if (first_command_ >= 0) put_command(tick.command);
  put_outputs(tick.command.outputs);
  if (tick.solved) {
    put(log_column::solver, static_cast<double>(tick.solver_status));
    put(log_column::iterations, tick.solution.iterations);
    put(log_column::estimated_x, tick.estimated_force.x());
    put(log_column::estimated_y, tick.estimated_force.y());
    put(log_column::estimated_rz, tick.estimated_force.z());
    put(log_column::slip, tick.slip);
    put_transition(tick.scheduler);
    put_signals(tick.scheduler);
    put_statements(statements, tick);
    if (tick.shortfall.missed >= 0) {
      put(log_column::missed, tick.shortfall.missed);
      put(log_column::missed_by, tick.shortfall.residual);
      for (int i = 0; i < tick.shortfall.count; ++i) {
        put(log_column::held_back_by + i, tick.shortfall.held_by[static_cast<std::size_t>(i)].statement);
      }
    }
    const std::vector<int>& exits = guards_[static_cast<std::size_t>(tick.scheduler.task())];
    for (std::size_t i = 0; i < exits.size(); ++i) put(exits[i], tick.scheduler.dwell(static_cast<int>(i)));
    const std::vector<int>& always = guards_[static_cast<std::size_t>(tick.scheduler.always_task())];
    for (std::size_t i = 0; i < always.size(); ++i) {
      put(always[i], tick.scheduler.always_dwell(static_cast<int>(i)));
    }
  }
  const std::size_t extra =
      std::min(tick.extra.size(), values_.size() - static_cast<std::size_t>(first_extra_));
  std::copy_n(tick.extra.begin(), extra, values_.begin() + first_extra_);
  return values_;
}

void LogLayout::put_statements(const StatementTable& statements, const Tick& tick) noexcept {
  std::size_t first_row = 0;
  for (int set = 0; set < tick.scheduler.set_count(); ++set) {
    put_coordinates(statements, tick.scheduler, set);
    put_rows(statements, tick, set, first_row);
    first_row += tick.scheduler.constraints(set).rows().size();
  }
}

const LogLayout::StatementColumns& LogLayout::columns_of(const StatementTable& statements,
                                                         const InForce& source) const noexcept {
  return of_statement_[static_cast<std::size_t>(statements.id(source.origin))];
}

/// Of the sets before, while a switch blends, those of statements that leave.
void LogLayout::put_coordinates(const StatementTable& statements, const Scheduler& scheduler,
                                int set) noexcept {
  const std::vector<InForce>& in_force = scheduler.in_force(set);
  const std::vector<solver::AxisConstraint>& constraints = scheduler.constraints(set).constraints();
  const std::vector<solver::Coordinate>& coordinates = scheduler.constraints(set).coordinates();
  for (std::size_t i = 0; i < in_force.size() && i < coordinates.size(); ++i) {
    if (set > 0 && in_force[i].active) continue;
    const StatementColumns& c = columns_of(statements, in_force[i]);
    const bool first = c.alpha >= 0 && std::isnan(values_[static_cast<std::size_t>(c.alpha)]);
    if (!c.inside && in_force[i].origin.part >= 0) continue;  // of a plane's norm: its speed says it all
    if (!c.inside) {
      put(c.position, coordinates[i].position);
      put(c.velocity, coordinates[i].velocity);
    } else if (constraints[i].position) {
      const solver::Range& range = *constraints[i].position;
      const double left = std::min(coordinates[i].position - range.low, range.high - coordinates[i].position);
      if (first || left < values_[static_cast<std::size_t>(c.position)]) {
        put(c.position, left);
        put(c.velocity, std::isfinite(range.low) ? coordinates[i].velocity : -coordinates[i].velocity);
      }
    }
    if (first || in_force[i].drives) put(c.alpha, in_force[i].alpha);
  }
}

/// Of a norm in a plane the two directions at right angles, or ahead and the turn, make it up.
void LogLayout::put_acceleration(const solver::ConstraintSet& set, const InForce& source,
                                 const solver::Row& row, const solver::Solution& solution,
                                 int column) noexcept {
  const auto i = static_cast<std::size_t>(row.constraint);
  const solver::AxisConstraint& c = set.constraints()[i];
  const solver::Coordinate& now = set.coordinates()[i];
  const bool is_turn = c.measure == solver::Measure::turn;
  const double along = is_turn ? now.velocity : acceleration_of(row, solution, now.acceleration_bias);
  const int part = source.origin.part;
  if (c.measure == solver::Measure::side && part != 0 && part != PlaneNorm::across) return;
  const double so_far = values_[static_cast<std::size_t>(column)];
  put(column, part <= 0 || std::isnan(so_far) ? along : std::hypot(so_far, along));
}

/// Forces are those of all sets, each by its share; the rest is of the active task's set and of what leaves.
void LogLayout::put_rows(const StatementTable& statements, const Tick& tick, int set,
                         std::size_t first_row) noexcept {
  const std::vector<InForce>& in_force = tick.scheduler.in_force(set);
  const std::vector<solver::Row>& rows = tick.scheduler.constraints(set).rows();
  const double share = tick.scheduler.share(set);
  const auto so_far = [&](int column) {
    const double value = column >= 0 ? values_[static_cast<std::size_t>(column)] : 0.0;
    return std::isnan(value) ? 0.0 : value;
  };
  for (std::size_t r = 0; r < rows.size() && first_row + r < tick.solution.rows.size(); ++r) {
    const auto i = static_cast<std::size_t>(rows[r].constraint);
    if (i >= in_force.size()) continue;
    const StatementColumns& c = columns_of(statements, in_force[i]);
    const solver::RowSolution& row = tick.solution.rows[first_row + r];
    const bool is_own = set == 0 || !in_force[i].active;
    const bool is_first = r == 0 || rows[r - 1].constraint != rows[r].constraint;
    if (is_own && is_first && c.acceleration >= 0)
      put_acceleration(tick.scheduler.constraints(set), in_force[i], rows[r], tick.solution, c.acceleration);
    switch (rows[r].kind) {
      case solver::RowKind::driver:
      case solver::RowKind::force:
        put(c.nu, so_far(c.nu) + share * row.nu);
        if (!is_own) break;
        put(c.b, rows[r].kind == solver::RowKind::force ? rows[r].force : rows[r].b);
        put(c.residual, row.residual);
        put(c.saturated, row.saturated ? 1.0 : 0.0);
        break;
      case solver::RowKind::sum:
        if (in_force[i].origin.part < 0) {
          put(c.sum, so_far(c.sum) + share * row.nu);
        } else if (std::abs(row.nu) > std::abs(so_far(c.sum))) {
          put(c.sum, row.nu);
        }
        break;
      case solver::RowKind::upper:
      case solver::RowKind::lower:
        put(c.limit_nu, so_far(c.limit_nu) + share * row.nu);
        if (is_own && std::abs(row.residual) >= std::abs(so_far(c.limit_residual)))
          put(c.limit_residual, row.residual);
        break;
    }
  }
}

void LogLayout::put_command(const Command& command) noexcept {
  for (int j = 0; j < static_cast<int>(command.velocity.size()); ++j) {
    const std::array<double, 3> values = command_values(command, j);
    for (int k = 0; k < 3; ++k) put(first_command_ + 3 * j + k, values[static_cast<std::size_t>(k)]);
  }
  if (first_twist_ < 0) return;
  for (int k = 0; k < 3; ++k) put(first_twist_ + k, command.twist(k));
}

void LogLayout::put_outputs(std::span<const double> outputs) noexcept {
  for (std::size_t i = 0; i < outputs.size(); ++i) put(first_output_ + static_cast<int>(i), outputs[i]);
}

void LogLayout::put_transition(const Scheduler& scheduler) noexcept {
  if (!scheduler.transition()) return;
  const Transition& t = *scheduler.transition();
  put(log_column::cause, static_cast<double>(t.cause));
  if (t.exit >= 0) put(log_column::cause_exit, t.exit + 1);
  put(log_column::also_always, static_cast<double>(t.also_always));
  const std::size_t exits = t.from >= 0 ? guards_[static_cast<std::size_t>(t.from)].size() : 0;
  put(log_column::also_true,
      static_cast<double>(t.also_true) + (t.also_timeout ? std::ldexp(1.0, static_cast<int>(exits)) : 0.0));
  put(log_column::refusal, static_cast<double>(t.refusal));
}

void LogLayout::put_signals(const Scheduler& scheduler) noexcept {
  for (std::size_t i = 0; i < of_signal_.size(); ++i) {
    const SignalColumns& c = of_signal_[i];
    const int signal = static_cast<int>(i);
    put(c.age, scheduler.signal_age(signal));
    put(c.known, scheduler.signal_known(signal) ? 1.0 : 0.0);
    const SignalSample& sample = scheduler.signal_sample(signal);
    if (!sample.valid) continue;
    switch (c.type) {
      case lang::SignalType::boolean:
        put(c.value, sample.boolean ? 1.0 : 0.0);
        break;
      case lang::SignalType::number:
        put(c.value, sample.number);
        break;
      case lang::SignalType::pose:
        put(c.value, sample.pose.position.x());
        put(c.value + 1, sample.pose.position.y());
        put(c.value + 2, solver::yaw_of(sample.pose.rotation));
        break;
      case lang::SignalType::wrench:
        for (int k = 0; k < 3; ++k) {
          put(c.value + k, sample.wrench.linear(k));
          put(c.value + 3 + k, sample.wrench.angular(k));
        }
        break;
    }
  }
}

}  // namespace zwang::runtime
