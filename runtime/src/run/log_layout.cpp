#include "run/log_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zwang::runtime {

namespace {

constexpr double blank = std::numeric_limits<double>::quiet_NaN();

enum Fixed { time, task, guard, solver, iterations, base_x, base_y, base_yaw, base_vx, base_vy, base_wz };

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
                     const std::vector<Column>& extra) {
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
  first_joint_ = static_cast<int>(columns_.size());
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    const bool slides = joint.type == solver::JointType::prismatic;
    add(joint.name + ".q", slides ? "m" : "rad");
    add(joint.name + ".qd", slides ? "m/s" : "rad/s");
    add(joint.name + ".tau", slides ? "N" : "N m");
  }
  for (const Statement& s : statements.all()) {
    using solver::Quantity;
    const auto unit = [&](Quantity quantity) { return std::string(unit_of(s.says.axis, quantity)); };
    StatementColumns c;
    const std::size_t first = columns_.size();
    const bool ranges = s.says.position || s.says.velocity || s.says.acceleration;
    if (s.says.driver || ranges) {
      c.position = add(s.name + ".position", unit(Quantity::position));
      c.velocity = add(s.name + ".velocity", unit(Quantity::velocity));
      c.alpha = add(s.name + ".alpha", "");
    }
    if (s.says.driver) {
      const bool pushes = s.says.driver == Quantity::force;
      c.b = pushes ? add(s.name + ".f", unit(Quantity::force))
                   : add(s.name + ".b", unit(Quantity::acceleration));
      c.nu = add(s.name + ".nu", unit(Quantity::force));
      c.residual = add(s.name + ".residual", unit(Quantity::acceleration));
    }
    if (ranges) c.limit_nu = add(s.name + ".limit_nu", unit(Quantity::force));
    for (std::size_t i = first; i < columns_.size(); ++i) columns_[i].span = s.says.span;
    of_statement_.push_back(c);
  }
  for (const lang::Task& t : scheduler.tasks()) {
    guards_.emplace_back();
    for (std::size_t i = 0; i < t.exits.size(); ++i) {
      guards_.back().push_back(add(t.name + ".exit" + std::to_string(i + 1) + ".true_for", "s"));
    }
  }
  first_extra_ = static_cast<int>(columns_.size());
  columns_.insert(columns_.end(), extra.begin(), extra.end());
  values_.resize(columns_.size(), blank);
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
  const solver::State& state = tick.sensed.state;
  const solver::Matrix3& R = state.base_pose.rotation;
  put(time, tick.sensed.time);
  if (tick.scheduler.task() >= 0) put(task, tick.scheduler.task());
  put(guard, static_cast<double>(tick.guard_status));
  put(base_x, state.base_pose.position.x());
  put(base_y, state.base_pose.position.y());
  put(base_yaw, std::atan2(R(1, 0), R(0, 0)));
  put(base_vx, state.base_twist.linear.x());
  put(base_vy, state.base_twist.linear.y());
  put(base_wz, state.base_twist.angular.z());
  const Eigen::Index joints = std::min({state.q.size(), state.qd.size(), tick.tau.size()});
  for (int j = 0; j < static_cast<int>(joints); ++j) {
    put(first_joint_ + 3 * j, state.q(j));
    put(first_joint_ + 3 * j + 1, state.qd(j));
    put(first_joint_ + 3 * j + 2, tick.tau(j));
  }
  if (tick.set != nullptr) {
    put(solver, static_cast<double>(tick.solver_status));
    put(iterations, tick.solution.iterations);
    put_statements(statements, tick);
    const std::vector<int>& exits = guards_[static_cast<std::size_t>(tick.scheduler.task())];
    for (std::size_t i = 0; i < exits.size(); ++i) put(exits[i], tick.scheduler.dwell(static_cast<int>(i)));
  }
  const std::size_t extra =
      std::min(tick.extra.size(), values_.size() - static_cast<std::size_t>(first_extra_));
  std::copy_n(tick.extra.begin(), extra, values_.begin() + first_extra_);
  return values_;
}

void LogLayout::put_statements(const StatementTable& statements, const Tick& tick) noexcept {
  const std::vector<InForce>& in_force = tick.scheduler.in_force();
  const std::vector<solver::AxisConstraint>& constraints = tick.set->constraints();
  const std::vector<solver::Coordinate>& coordinates = tick.set->coordinates();
  const auto columns_of = [&](std::size_t i) -> const StatementColumns& {
    return of_statement_[static_cast<std::size_t>(statements.id(in_force[i].origin))];
  };
  // While a switch blends, one statement can stand in several constraints: the one that drives gives the
  // alpha.
  for (std::size_t i = 0; i < in_force.size() && i < coordinates.size(); ++i) {
    const StatementColumns& c = columns_of(i);
    put(c.position, coordinates[i].position);
    put(c.velocity, coordinates[i].velocity);
    const bool first = c.alpha >= 0 && std::isnan(values_[static_cast<std::size_t>(c.alpha)]);
    if (first || in_force[i].drives) put(c.alpha, constraints[i].alpha);
  }
  const std::vector<solver::Row>& rows = tick.set->rows();
  for (std::size_t r = 0; r < rows.size() && r < tick.solution.rows.size(); ++r) {
    const auto i = static_cast<std::size_t>(rows[r].constraint);
    if (i >= in_force.size()) continue;
    const StatementColumns& c = columns_of(i);
    const solver::RowSolution& row = tick.solution.rows[r];
    if (rows[r].kind == solver::RowKind::driver || rows[r].kind == solver::RowKind::force) {
      put(c.b, rows[r].kind == solver::RowKind::force ? rows[r].force : rows[r].b);
      put(c.nu, row.nu);
      put(c.residual, row.residual);
    } else if (c.limit_nu >= 0) {
      const double so_far = values_[static_cast<std::size_t>(c.limit_nu)];
      put(c.limit_nu, (std::isnan(so_far) ? 0.0 : so_far) + row.nu);
    }
  }
}

}  // namespace zwang::runtime
