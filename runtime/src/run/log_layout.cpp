#include "run/log_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "schedule/acceleration_of.hpp"
#include "schedule/plane_norm.hpp"

namespace zwang::runtime {

namespace {

constexpr double blank = std::numeric_limits<double>::quiet_NaN();

enum Fixed {
  time,
  task,
  guard,
  solver,
  iterations,
  base_x,
  base_y,
  base_yaw,
  base_vx,
  base_vy,
  base_wz,
  cause,
  cause_exit,
  also_always,
  also_true,
  refusal,
  missed,
  missed_by,
  held_back_by,
  last_held_back_by = held_back_by + 3,
  event,
  event_of,
  event_value,
  estimated_x,
  estimated_y,
  estimated_rz,
  slip,
};

static_assert(std::tuple_size_v<decltype(Shortfall::held_by)> == last_held_back_by - held_back_by + 1);

template <typename Enum>
std::vector<std::string> words_up_to(Enum last) {
  std::vector<std::string> words;
  for (int i = 0; i <= static_cast<int>(last); ++i) words.emplace_back(to_string(static_cast<Enum>(i)));
  return words;
}

std::vector<std::string> task_names(const Scheduler& scheduler) {
  std::vector<std::string> names;
  for (const lang::Task& t : scheduler.tasks()) names.push_back(t.name);
  return names;
}

}  // namespace

LogLayout::LogLayout(const StatementTable& statements, const Scheduler& scheduler, const solver::Model& model,
                     const lang::Program& program, const std::vector<std::string>& event_signals,
                     const std::vector<Column>& extra)
    : inputs_(model, program.signals, program.parameters, program.robot.drive) {
  // In the order of `Fixed`.
  add("time", "s");
  add("task", "", task_names(scheduler));
  add("guard", "", words_up_to(GuardStatus::stopped));
  add("solver", "", words_up_to(solver::Status::degenerate_model));
  add("solver.iterations", "");
  add("base.x", "m");
  add("base.y", "m");
  add("base.yaw", "rad");
  add("base.vx", "m/s");
  add("base.vy", "m/s");
  add("base.wz", "rad/s");
  add("switch", "", words_up_to(Cause::never_stood));
  add("switch.exit", "");
  add("switch.also_true.always", "");  // bit i: exit i + 1
  add("switch.also_true", "");         // likewise; the timeout is the bit above the last exit
  add("switch.refusal", "", words_up_to(Refusal::set));
  std::vector<std::string> rows;
  for (const Statement& s : statements.all()) rows.push_back(s.name);
  add("missed", "", rows);
  add("missed.by", "");
  for (const char* name : {"missed.held_back_by", "missed.held_back_by.2", "missed.held_back_by.3",
                           "missed.held_back_by.4"}) {  // the strongest first
    add(name, "", rows);
  }
  add("event", "", words_up_to(EventCode::not_at_rest));
  add("event.signal", "", event_signals);
  add("event.value", "");
  add("estimated.force.x", "N");
  add("estimated.force.y", "N");
  add("estimated.force.rz", "N m");
  add("slip", "m/s");
  first_joint_ = static_cast<int>(columns_.size());
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    const bool slides = joint.type == solver::JointType::prismatic;
    add(joint.name + ".q", slides ? "m" : "rad");
    add(joint.name + ".qd", slides ? "m/s" : "rad/s");
    add(joint.name + ".tau", slides ? "N" : "N m");
  }
  if (program.robot.drive.takes_velocity) {
    first_command_ = static_cast<int>(columns_.size());
    for (int j = 0; j < model.joint_count(); ++j) {
      for (const CommandColumn& column : command_columns(model.joint(j))) add(column.name, column.unit);
    }
  }
  if (program.robot.drive.takes_twist) {
    first_twist_ = static_cast<int>(columns_.size());
    for (const auto& [name, unit] : twist_columns) add(name, unit);
  }
  for (const lang::Signal& signal : program.signals) add_signal(signal);
  first_output_ = static_cast<int>(columns_.size());
  for (const lang::Output& output : program.outputs) {
    add("output." + output.name, "");
    columns_.back().span = output.span;
  }
  for (const Statement& s : statements.all()) add_statement(s);
  for (const lang::Task& t : scheduler.tasks()) {
    guards_.emplace_back();
    for (std::size_t i = 0; i < t.exits.size(); ++i) {
      guards_.back().push_back(add(t.name + ".exit" + std::to_string(i + 1) + ".true_for", "s"));
      columns_.back().span = t.exits[i].span;
    }
  }
  first_input_ = static_cast<int>(columns_.size());
  columns_.insert(columns_.end(), inputs_.columns().begin(), inputs_.columns().end());
  first_extra_ = static_cast<int>(columns_.size());
  columns_.insert(columns_.end(), extra.begin(), extra.end());
  values_.resize(columns_.size(), blank);
}

void LogLayout::add_signal(const lang::Signal& signal) {
  const std::size_t first = columns_.size();
  const std::string name = "signal." + signal.name;
  SignalColumns c;
  c.type = signal.type;
  switch (signal.type) {
    case lang::SignalType::boolean:
    case lang::SignalType::number:  // in SI; a length and a force have no unit in the program any more
      c.value = add(name, "");
      break;
    case lang::SignalType::pose:
      c.value = add(name + ".x", "m");
      add(name + ".y", "m");
      add(name + ".yaw", "rad");
      break;
    case lang::SignalType::wrench:
      c.value = add(name + ".fx", "N");
      add(name + ".fy", "N");
      add(name + ".fz", "N");
      add(name + ".mx", "N m");
      add(name + ".my", "N m");
      add(name + ".mz", "N m");
      break;
  }
  c.age = add(name + ".age", "s");
  c.known = add(name + ".valid", "");
  for (std::size_t i = first; i < columns_.size(); ++i) columns_[i].span = signal.span;
  of_signal_.push_back(c);
}

void LogLayout::add_statement(const Statement& s) {
  using solver::Quantity;
  const auto unit = [&](Quantity quantity) { return std::string(unit_of(s.says.axis, quantity)); };
  StatementColumns c;
  const std::size_t first = columns_.size();
  const bool ranges = s.says.position || s.says.velocity || s.says.acceleration;
  c.inside = s.inside;
  if (s.says.driver || s.says.force || ranges) {
    c.position = add(s.name + (s.inside ? ".left" : ".position"), unit(Quantity::position));
    c.velocity = add(s.name + ".velocity", unit(Quantity::velocity));
    if (s.says.acceleration) c.acceleration = add(s.name + ".acceleration", unit(Quantity::acceleration));
    c.alpha = add(s.name + ".alpha", "");
  }
  if (s.says.driver) {
    const bool pushes = s.says.driver == Quantity::force || s.says.stiffness || s.says.damping;
    c.b =
        pushes ? add(s.name + ".f", unit(Quantity::force)) : add(s.name + ".b", unit(Quantity::acceleration));
    c.nu = add(s.name + ".nu", unit(Quantity::force));
    c.residual = add(s.name + ".residual", unit(Quantity::acceleration));
    c.saturated = add(s.name + ".saturated", "");
  }
  if (ranges) {
    c.limit_nu = add(s.name + ".limit_nu", unit(Quantity::force));
    c.limit_residual = add(s.name + ".limit_residual", unit(Quantity::acceleration));
  }
  if (s.says.force && !s.says.driver) c.sum = add(s.name + ".sum", unit(Quantity::force));
  for (std::size_t i = first; i < columns_.size(); ++i) columns_[i].span = s.says.span;
  of_statement_.push_back(c);
}

int LogLayout::add(std::string name, std::string unit, std::vector<std::string> words) {
  columns_.push_back({std::move(name), std::move(unit), std::move(words)});
  return static_cast<int>(columns_.size()) - 1;
}

void LogLayout::put(int column, double value) noexcept {
  if (column >= 0) values_[static_cast<std::size_t>(column)] = value;
}

std::span<const double> LogLayout::fill(const StatementTable& statements, const Tick& tick) noexcept {
  std::fill(values_.begin(), values_.end(), blank);
  const solver::State& state = tick.known.state;
  put(time, tick.sensed.time);
  inputs_.write(tick.sensed, tick.parameters,
                std::span(values_).subspan(static_cast<std::size_t>(first_input_), inputs_.columns().size()));
  if (tick.scheduler.task() >= 0) put(task, tick.scheduler.task());
  put(guard, static_cast<double>(tick.guard_status));
  put(base_x, state.base_pose.position.x());
  put(base_y, state.base_pose.position.y());
  put(base_yaw, solver::yaw_of(state.base_pose.rotation));
  put(base_vx, state.base_twist.linear.x());
  put(base_vy, state.base_twist.linear.y());
  put(base_wz, state.base_twist.angular.z());
  if (tick.event.code != EventCode::none) {
    put(event, static_cast<double>(tick.event.code));
    if (tick.event.signal >= 0) put(event_of, tick.event.signal);
    put(event_value, tick.event.value);
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
    put(solver, static_cast<double>(tick.solver_status));
    put(iterations, tick.solution.iterations);
    put(estimated_x, tick.estimated_force.x());
    put(estimated_y, tick.estimated_force.y());
    put(estimated_rz, tick.estimated_force.z());
    put(slip, tick.slip);
    put_transition(tick.scheduler);
    put_signals(tick.scheduler);
    put_statements(statements, tick);
    if (tick.shortfall.missed >= 0) {
      put(missed, tick.shortfall.missed);
      put(missed_by, tick.shortfall.residual);
      for (int i = 0; i < tick.shortfall.count; ++i) {
        put(held_back_by + i, tick.shortfall.held_by[static_cast<std::size_t>(i)].statement);
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
  put(cause, static_cast<double>(t.cause));
  if (t.exit >= 0) put(cause_exit, t.exit + 1);
  put(also_always, static_cast<double>(t.also_always));
  const std::size_t exits = t.from >= 0 ? guards_[static_cast<std::size_t>(t.from)].size() : 0;
  put(also_true,
      static_cast<double>(t.also_true) + (t.also_timeout ? std::ldexp(1.0, static_cast<int>(exits)) : 0.0));
  put(refusal, static_cast<double>(t.refusal));
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
