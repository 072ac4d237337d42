#include "zwang/runtime/scheduler.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "schedule/blend.hpp"
#include "schedule/braking.hpp"
#include "schedule/condition.hpp"
#include "schedule/frame_table.hpp"
#include "schedule/supported.hpp"

namespace zwang::runtime {

namespace {

using lang::AxisStatements;
using solver::Axis;
using solver::Quantity;
using solver::Range;

constexpr double at_rest_speed = 0.01;               // [m/s]
constexpr double at_rest_turn = 0.0174532925199433;  // [rad/s], 1 deg/s
constexpr double longest_stop = 10.0;                // [s]
// Rounding in a clock that adds up periods must not shift a time by a whole tick.
constexpr double clock_rounding = 1e-6;  // of a period

bool is_rotation(Axis axis) {
  return axis >= Axis::rx;
}

bool says_something(const AxisStatements& axis) {
  return axis.driver || axis.position || axis.velocity || axis.acceleration;
}

/// An axis of a task that is in force, in the order of the task.
struct ActiveAxis {
  int group = 0;
  int axis = 0;
  std::optional<solver::AttachedFrame> entry_axes;  ///< `here` in axes of the moved body: the axes on entry
  double here = 0.0;
  AxisReading reading;
};

int axis_count(const lang::Task& task) {
  int count = 0;
  for (const lang::Group& group : task.groups) count += static_cast<int>(group.axes.size());
  return count;
}

int statement_rows(const lang::Task& task) {
  int rows = 0;
  for (const lang::Group& group : task.groups) {
    for (const AxisStatements& a : group.axes) {
      rows +=
          (a.driver ? 1 : 0) + 2 * ((a.position ? 1 : 0) + (a.velocity ? 1 : 0) + (a.acceleration ? 1 : 0));
    }
  }
  return rows;
}

void require_index(int index, std::size_t size, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= size) {
    throw std::invalid_argument(std::string("scheduler: ") + what + " is out of range");
  }
}

void require_indices(const lang::Condition& condition, const lang::Task& task, std::size_t frames,
                     std::size_t parameters) {
  for (std::size_t i = 0; i < condition.nodes.size(); ++i) {
    const lang::ExpressionNode& node = condition.nodes[i];
    if (node.left >= static_cast<int>(i) || node.right >= static_cast<int>(i)) {
      throw std::invalid_argument("scheduler: an operand stands behind its operator");
    }
    if (node.op == lang::Op::parameter) require_index(node.index, parameters, "a condition's parameter");
    if (node.op == lang::Op::speed || node.op == lang::Op::moved) {
      require_index(node.index, frames, "a condition's frame");
    }
    if (node.op == lang::Op::coordinate) {
      require_index(node.index, task.groups.size(), "a condition's group");
      require_index(node.axis, task.groups[static_cast<std::size_t>(node.index)].axes.size(),
                    "a condition's axis");
    }
  }
}

}  // namespace

const char* to_string(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::none:
      return "none";
    case Outcome::done:
      return "done";
    case Outcome::failed:
      return "failed";
  }
  return "?";
}

struct Scheduler::Parts final : Facts {
  Parts(const lang::Program& given, double control_period);

  // What a condition may ask about.
  double coordinate(int group, int axis, lang::CoordinateQuantity what) const noexcept override;
  double elapsed() const noexcept override { return now - entered; }
  double parameter(int index) const noexcept override { return parameters[static_cast<std::size_t>(index)]; }
  double speed(int frame) const noexcept override { return frames.speed(frame); }
  double moved(int frame) const noexcept override { return frames.moved(frame); }

  const lang::Task& active() const noexcept { return tasks[static_cast<std::size_t>(task)]; }
  int task_of(const lang::Target& target) const noexcept;
  std::optional<Transition> choose() noexcept;
  void advance_guards() noexcept;
  void check_rest() noexcept;
  void take(const Transition& chosen) noexcept;
  void apply(const std::vector<lang::SetAction>& actions) noexcept;
  void list_axes() noexcept;
  void capture_here() noexcept;
  solver::AttachedFrame axes_frame(const ActiveAxis& active_axis) const noexcept;
  const AxisStatements& statements(const ActiveAxis& a) const noexcept;
  void want() noexcept;
  solver::AxisConstraint constraint_of(const ActiveAxis& a) const noexcept;
  double braking_of(const AxisStatements& a, const solver::AxisConstraint& c) const noexcept;
  Range value(const lang::ValueRange& range) const noexcept;
  void put_constraints() noexcept;

  const solver::Model model;
  const lang::Stop stop;
  std::vector<lang::BaseLimit> limits;
  std::vector<double> parameters;
  std::vector<lang::FrameDeclaration> declarations;
  std::vector<lang::Task> tasks;
  FrameTable frames;
  double period;
  double radius;  ///< [m] of the footprint
  int start;
  int program_tasks;

  Phase phase = Phase::running;
  Outcome outcome = Outcome::none;
  int task = -1;
  double now = 0.0;
  double entered = 0.0;
  double blend_time = 0.0;
  const solver::State* state = nullptr;  ///< of the present tick
  std::optional<Transition> transition;
  std::vector<ActiveAxis> axes;
  std::vector<int> true_ticks;  ///< of each exit
  std::vector<double> scratch;
  std::vector<Wanted> wanted;
  std::vector<InForce> in_force;
  int most_rows = 0;
  std::optional<Blend> blend;
  std::optional<solver::ConstraintSet> set;
};

Scheduler::Parts::Parts(const lang::Program& given, double control_period)
    : model(given.robot.model),
      stop(given.robot.stop),
      limits(given.robot.limits),
      parameters(given.parameter_values()),
      declarations(given.frames),
      tasks(given.tasks),
      frames((base_frame(declarations, given.robot), declarations), given.robot.model),
      period(control_period),
      radius(footprint_radius(given.robot)),
      start(given.start),
      program_tasks(static_cast<int>(given.tasks.size())) {
  if (!(period > 0.0) || !std::isfinite(period))
    throw std::invalid_argument("scheduler: the period is not positive");
  require_index(start, tasks.size(), "the start task");
  const int base = base_frame(declarations, given.robot);
  for (lang::Task& t : tasks) add_limits(t, given.robot, base, declarations);
  tasks.push_back(brake_task("done", given.robot, base));
  tasks.push_back(brake_task("failed", given.robot, base));

  std::size_t most_axes = 0, most_exits = 0, most_nodes = 0;
  for (const lang::Task& t : tasks) {
    most_axes = std::max(most_axes, static_cast<std::size_t>(axis_count(t)));
    most_exits = std::max(most_exits, t.exits.size());
    most_rows = std::max(most_rows, statement_rows(t));
    for (const lang::Group& group : t.groups) {
      require_index(group.move, declarations.size(), "a moved frame");
      require_index(group.in, declarations.size(), "an axes frame");
      if (frames.attached(group.move).body < 0) {
        throw std::invalid_argument("scheduler: `" + group.name + "` moves a frame of the world");
      }
    }
    for (const lang::Exit& exit : t.exits) {
      most_nodes = std::max(most_nodes, exit.when.nodes.size());
      require_indices(exit.when, t, declarations.size(), parameters.size());
      if (exit.target.kind == lang::TargetKind::task) {
        require_index(exit.target.task, given.tasks.size(), "an exit's target");
      }
    }
  }
  axes.reserve(most_axes);
  wanted.reserve(most_axes);
  true_ticks.resize(most_exits);
  scratch.resize(most_nodes);

  double force_scale = 0.0;
  for (const solver::Wheel& wheel : model.wheels()) {
    force_scale += model.joint(wheel.body - 1).max_effort / wheel.radius;
  }
  if (!(force_scale > 0.0) || !std::isfinite(force_scale)) force_scale = 10.0 * model.total_mass();
  blend.emplace(most_axes, 3 * most_rows, force_scale, force_scale * radius);
  in_force.reserve(blend->capacity());
  set.emplace(static_cast<int>(blend->capacity()), 4 * most_rows);
}

double Scheduler::Parts::coordinate(int group, int axis, lang::CoordinateQuantity what) const noexcept {
  for (const ActiveAxis& a : axes) {
    if (a.group != group || a.axis != axis) continue;
    switch (what) {
      case lang::CoordinateQuantity::force:
        return a.reading.force;
      case lang::CoordinateQuantity::residual:
        return a.reading.residual;
      case lang::CoordinateQuantity::saturated:
        return a.reading.saturated ? 1.0 : 0.0;
      case lang::CoordinateQuantity::position:
      case lang::CoordinateQuantity::velocity:
        break;
    }
    const lang::Group& g = active().groups[static_cast<std::size_t>(group)];
    const solver::Coordinate c =
        solver::coordinate_of(frames.attached(g.move), axes_frame(a), statements(a).axis, model, *state);
    return what == lang::CoordinateQuantity::position ? c.position : c.velocity;
  }
  return std::nan("");
}

int Scheduler::Parts::task_of(const lang::Target& target) const noexcept {
  switch (target.kind) {
    case lang::TargetKind::task:
      return target.task;
    case lang::TargetKind::done:
      return program_tasks;
    case lang::TargetKind::back:  // nothing interrupts a task yet, so there is nothing to go back to
    case lang::TargetKind::failed:
      break;
  }
  return program_tasks + 1;
}

void Scheduler::Parts::advance_guards() noexcept {
  const std::vector<lang::Exit>& exits = active().exits;
  for (std::size_t i = 0; i < exits.size(); ++i) {
    const bool holds = evaluate(exits[i].when, *this, scratch) == Verdict::yes;
    true_ticks[i] = holds ? std::min(true_ticks[i] + 1, 1 << 30) : 0;
  }
}

/// Order is priority: the timeout, then the exits from top to bottom.
std::optional<Transition> Scheduler::Parts::choose() noexcept {
  advance_guards();
  Transition chosen{.time = now, .from = task};
  bool any = false;
  const lang::Task& t = active();
  if (t.timeout && elapsed() >= t.timeout->after.evaluate(parameters) - clock_rounding * period) {
    chosen.to = task_of(t.timeout->target);
    chosen.cause = Cause::timeout;
    any = true;
  }
  for (std::size_t i = 0; i < t.exits.size(); ++i) {
    const double needed = std::ceil(t.exits[i].dwell.evaluate(parameters) / period - clock_rounding);
    if (true_ticks[i] < std::max(1.0, needed)) continue;
    if (!any) {
      chosen.to = task_of(t.exits[i].target);
      chosen.cause = Cause::exit;
      chosen.exit = static_cast<int>(i);
      any = true;
    } else if (i < 64) {
      chosen.also_true |= std::uint64_t{1} << i;
    }
  }
  if (!any) return std::nullopt;
  return chosen;
}

void Scheduler::Parts::apply(const std::vector<lang::SetAction>& actions) noexcept {
  for (const lang::SetAction& action : actions) {
    if (action.sets_frame) {
      frames.set(action.index, action.source, model, *state);
    } else {
      parameters[static_cast<std::size_t>(action.index)] = action.value.evaluate(parameters);
    }
  }
}

void Scheduler::Parts::take(const Transition& chosen) noexcept {
  transition = chosen;
  if (chosen.exit >= 0) apply(active().exits[static_cast<std::size_t>(chosen.exit)].set);
  task = chosen.to;
  apply(active().set_on_entry);
  entered = now;
  std::fill(true_ticks.begin(), true_ticks.end(), 0);
  frames.start_paths();
  if (task >= program_tasks) {
    phase = Phase::stopping;
    outcome = task == program_tasks ? Outcome::done : Outcome::failed;
  }
  list_axes();
  capture_here();
  want();
  blend_time = active().blend.evaluate(parameters);
  blend->start(wanted, blend_time);
}

void Scheduler::Parts::check_rest() noexcept {
  if (phase != Phase::stopping) return;
  const solver::MotionVector& twist = state->base_twist;
  const bool stands =
      model.has_fixed_base() || (twist.linear.norm() < at_rest_speed && twist.angular.norm() < at_rest_turn);
  if (stands) {
    phase = Phase::finished;
  } else if (elapsed() > longest_stop) {
    if (task == program_tasks) {
      transition =
          Transition{.time = now, .from = task, .to = program_tasks + 1, .cause = Cause::never_stood};
    }
    outcome = Outcome::failed;
    phase = Phase::finished;
  }
}

void Scheduler::Parts::list_axes() noexcept {
  axes.clear();
  const lang::Task& t = active();
  for (std::size_t g = 0; g < t.groups.size(); ++g) {
    for (std::size_t a = 0; a < t.groups[g].axes.size(); ++a) {
      axes.push_back({static_cast<int>(g), static_cast<int>(a), std::nullopt, 0.0, {}});
    }
  }
}

void Scheduler::Parts::capture_here() noexcept {
  for (ActiveAxis& a : axes) {
    const AxisStatements& s = statements(a);
    if (!s.here) continue;
    const lang::Group& group = active().groups[static_cast<std::size_t>(a.group)];
    const solver::AttachedFrame& move = frames.attached(group.move);
    const solver::AttachedFrame& in = frames.attached(group.in);
    // Axes that the moved body carries cannot tell where it is: they stay where they were on entry.
    if (in.body >= 0 && in.body == move.body) a.entry_axes = solver::AttachedFrame{-1, frames.pose(group.in)};
    a.here = solver::coordinate_of(move, axes_frame(a), s.axis, model, *state).position;
  }
}

solver::AttachedFrame Scheduler::Parts::axes_frame(const ActiveAxis& a) const noexcept {
  if (a.entry_axes) return *a.entry_axes;
  return frames.attached(active().groups[static_cast<std::size_t>(a.group)].in);
}

const AxisStatements& Scheduler::Parts::statements(const ActiveAxis& a) const noexcept {
  return active().groups[static_cast<std::size_t>(a.group)].axes[static_cast<std::size_t>(a.axis)];
}

Range Scheduler::Parts::value(const lang::ValueRange& range) const noexcept {
  return {range.low.evaluate(parameters), range.high.evaluate(parameters)};
}

/// a_brk of a position range: what the axis's own acceleration range allows, else the robot's; never more
/// than the force range can do to the robot's mass.
double Scheduler::Parts::braking_of(const AxisStatements& a, const solver::AxisConstraint& c) const noexcept {
  const bool turns = is_rotation(a.axis);
  double braking = turns ? stop.deceleration / radius : stop.deceleration;
  if (c.acceleration) {
    braking = std::min(-c.acceleration->low, c.acceleration->high);
  } else {
    for (const lang::BaseLimit& limit : limits) {
      if (limit.quantity == Quantity::acceleration && is_rotation(limit.axis) == turns) {
        braking = std::min({braking, -limit.range.low, limit.range.high});
      }
    }
  }
  if (!turns && a.force) {
    const Range force = value(*a.force);
    braking = std::min({braking, -force.low / model.total_mass(), force.high / model.total_mass()});
  }
  return std::max(braking, 1e-3);
}

solver::AxisConstraint Scheduler::Parts::constraint_of(const ActiveAxis& a) const noexcept {
  const AxisStatements& s = statements(a);
  solver::AxisConstraint c;
  c.move = frames.attached(active().groups[static_cast<std::size_t>(a.group)].move);
  c.in = axes_frame(a);
  c.axis = s.axis;
  c.level = s.level;
  if (s.position) c.position = value(*s.position);
  if (s.velocity) c.velocity = value(*s.velocity);
  if (s.acceleration) c.acceleration = value(*s.acceleration);
  if (s.driver) {
    solver::Driver driver;
    driver.quantity = *s.driver;
    driver.target = s.here ? a.here : s.target.evaluate(parameters);
    driver.time_constant = s.time_constant.evaluate(parameters);
    if (s.force) driver.force = value(*s.force);
    c.driver = driver;
  }
  if (c.position) c.braking = braking_of(s, c);
  return c;
}

/// The active task's constraints with the present values of the parameters.
void Scheduler::Parts::want() noexcept {
  wanted.clear();
  for (const ActiveAxis& a : axes) {
    if (says_something(statements(a))) wanted.push_back({constraint_of(a), {task, a.group, a.axis}});
  }
}

void Scheduler::Parts::put_constraints() noexcept {
  want();
  // The tick of the switch already goes one tick's way, so that no alpha is ever 0.
  double progress = blend_time > 0.0 ? (elapsed() + period) / blend_time : 1.0;
  if ((1.0 - progress) * blend_time < clock_rounding * period) progress = 1.0;
  blend->put(wanted, progress, *set, in_force);
}

Scheduler::Scheduler(const lang::Program& program, double period) {
  require_supported(program);
  parts_ = std::make_unique<Parts>(program, period);
}
Scheduler::~Scheduler() = default;
Scheduler::Scheduler(Scheduler&&) noexcept = default;
Scheduler& Scheduler::operator=(Scheduler&&) noexcept = default;

void Scheduler::tick(const Sensed& sensed) noexcept {
  Parts& p = *parts_;
  p.state = &sensed.state;
  p.now = sensed.time;
  p.transition.reset();
  p.frames.update(p.model, sensed.state);
  if (p.task < 0) {
    p.take({.time = p.now, .from = -1, .to = p.start});
  } else if (p.phase == Phase::running) {
    if (const auto chosen = p.choose()) p.take(*chosen);
  } else {
    p.check_rest();
  }
  p.put_constraints();
}

void Scheduler::observe(const solver::Solution& solution) noexcept {
  Parts& p = *parts_;
  const std::vector<solver::Row>& rows = p.set->rows();
  for (ActiveAxis& a : p.axes) {
    if (!p.statements(a).driver) a.reading = {};
  }
  const std::size_t count = std::min(rows.size(), solution.rows.size());
  for (std::size_t i = 0; i < count; ++i) {
    const int c = rows[i].constraint;
    if (c < 0 || static_cast<std::size_t>(c) >= p.in_force.size()) continue;
    const InForce& source = p.in_force[static_cast<std::size_t>(c)];
    if (!source.active) continue;
    const bool is_driver = rows[i].kind == solver::RowKind::driver || rows[i].kind == solver::RowKind::force;
    for (ActiveAxis& a : p.axes) {
      if (a.group != source.origin.group || a.axis != source.origin.axis) continue;
      if (is_driver) {
        a.reading = {solution.rows[i].nu, solution.rows[i].residual, solution.rows[i].saturated};
      } else if (!p.statements(a).driver &&
                 std::abs(solution.rows[i].residual) > std::abs(a.reading.residual)) {
        a.reading.residual = solution.rows[i].residual;
      }
    }
  }
}

solver::ConstraintSet& Scheduler::constraints() noexcept {
  return *parts_->set;
}
const std::vector<InForce>& Scheduler::in_force() const noexcept {
  return parts_->in_force;
}
const std::optional<Transition>& Scheduler::transition() const noexcept {
  return parts_->transition;
}
Phase Scheduler::phase() const noexcept {
  return parts_->phase;
}
Outcome Scheduler::outcome() const noexcept {
  return parts_->outcome;
}
int Scheduler::task() const noexcept {
  return parts_->task;
}
double Scheduler::elapsed() const noexcept {
  return parts_->elapsed();
}
double Scheduler::dwell(int exit) const noexcept {
  return parts_->true_ticks[static_cast<std::size_t>(exit)] * parts_->period;
}
const std::vector<double>& Scheduler::parameters() const noexcept {
  return parts_->parameters;
}
const std::vector<lang::Task>& Scheduler::tasks() const noexcept {
  return parts_->tasks;
}
int Scheduler::program_task_count() const noexcept {
  return parts_->program_tasks;
}
int Scheduler::row_capacity() const noexcept {
  return 4 * parts_->most_rows;
}
double Scheduler::period() const noexcept {
  return parts_->period;
}

AxisReading Scheduler::reading(const Origin& origin) const noexcept {
  if (origin.task == parts_->task) {
    for (const ActiveAxis& a : parts_->axes) {
      if (a.group == origin.group && a.axis == origin.axis) return a.reading;
    }
  }
  return {};
}

std::string Scheduler::why(const Transition& transition) const {
  switch (transition.cause) {
    case Cause::start:
      return "start";
    case Cause::timeout: {
      char text[64];
      const lang::Task& task = parts_->tasks[static_cast<std::size_t>(transition.from)];
      std::snprintf(text, sizeof text, "timeout after %g s",
                    task.timeout->after.evaluate(parts_->parameters));
      return text;
    }
    case Cause::never_stood:
      return "the brake did not bring the base to rest";
    case Cause::exit:
      break;
  }
  const lang::Task& task = parts_->tasks[static_cast<std::size_t>(transition.from)];
  return task.exits[static_cast<std::size_t>(transition.exit)].when.text;
}

lang::Span Scheduler::where(const Transition& transition) const noexcept {
  if (transition.from < 0) return {};
  const lang::Task& task = parts_->tasks[static_cast<std::size_t>(transition.from)];
  if (transition.cause == Cause::timeout && task.timeout) return task.timeout->span;
  if (transition.cause != Cause::exit) return {};
  return task.exits[static_cast<std::size_t>(transition.exit)].when.span;
}

}  // namespace zwang::runtime
