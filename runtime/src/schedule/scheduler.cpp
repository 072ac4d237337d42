#include "zwang/runtime/scheduler.hpp"

#include <cmath>
#include <stdexcept>

#include "schedule/braking.hpp"
#include "schedule/parts.hpp"

namespace zwang::runtime {

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

const char* to_string(Cause cause) noexcept {
  switch (cause) {
    case Cause::start:
      return "start";
    case Cause::always:
      return "always";
    case Cause::timeout:
      return "timeout";
    case Cause::exit:
      return "exit";
    case Cause::never_stood:
      return "never_stood";
  }
  return "?";
}

const char* to_string(Refusal refusal) noexcept {
  switch (refusal) {
    case Refusal::none:
      return "none";
    case Refusal::require:
      return "require";
    case Refusal::attempts:
      return "attempts";
    case Refusal::set:
      return "set";
  }
  return "?";
}

namespace {

double positive(double period) {
  if (!(period > 0.0) || !std::isfinite(period))
    throw std::invalid_argument("scheduler: the period is not positive");
  return period;
}

std::vector<std::optional<solver::Range>> ranges_of(const std::vector<lang::Parameter>& parameters) {
  std::vector<std::optional<solver::Range>> ranges;
  for (const lang::Parameter& p : parameters) ranges.push_back(p.range);
  return ranges;
}

}  // namespace

Scheduler::Parts::Parts(const lang::Program& given, double control_period)
    : model(given.robot.model),
      stop(given.robot.stop),
      limits(given.robot.limits),
      parameters(given.parameter_values()),
      parameter_ranges(ranges_of(given.parameters)),
      declarations(given.frames),
      features(given.features),
      paths(given.paths),
      base(base_frame(declarations, given.robot)),
      held_joints(find_held_joints(declarations, given.robot.model)),
      tasks(given, declarations, base, held_joints),
      frames(declarations, given.robot.model, given.signals.size()),
      signals(given, positive(control_period)),
      wrenches(model),
      declared_outputs(given.outputs),
      feels_pushes(!given.robot.drive.takes_velocity),
      period(control_period),
      horizon(given.robot.drive.horizon()),
      keeps_all_sides(given.robot.drive.takes_velocity && !given.robot.drive.has_virtual_robot()),
      radius(footprint_radius(given.robot)),
      effective_mass(effective_mass_of(given.robot)),
      braking(solver::Vector3::Zero()),
      start(given.start),
      entries(tasks.tasks.size(), 0),
      entered_last(tasks.tasks.size(), 0.0),
      guards(tasks.most_exits, tasks.most_nodes, tasks.most_compared, control_period, Unknown::does_not_fire),
      always_guards(tasks.most_exits, tasks.most_nodes, tasks.most_compared, control_period,
                    Unknown::fires_when_stale) {
  for (const lang::Output& output : declared_outputs) outputs.push_back(output.start);
  pushing.resize(tasks.most_nodes);
  list_followers();
  for (const lang::Task& t : tasks.tasks) {
    if (t.require) follow(*t.require);
    for (const lang::Exit& exit : t.exits) follow(exit.when);
    guarded.emplace_back(t.exits, static_cast<int>(guarded.size()));
    fence_of.emplace_back();
    plane_of.emplace_back();
    first_axis_of.emplace_back();
    std::size_t axes_before = 0;
    for (const lang::Group& g : t.groups) {
      for (const lang::AxisStatements& axis : g.axes) {
        if (axis.yield) follow(axis.yield->force);
      }
      const bool can_move = frames.attached(g.move).body >= 0 || is_bearing_of_the_robot(g);
      if (!can_move) throw std::invalid_argument("scheduler: `" + g.name + "` moves a frame of the world");
      fence_of.back().push_back(-1);
      first_axis_of.back().push_back(axes_before);
      axes_before += g.axes.size();
      if (g.moves_footprint && given.robot.footprint.empty()) {
        throw std::invalid_argument("scheduler: `" + g.name +
                                    "` moves a footprint that the robot does not have");
      }
      plane_of.back().push_back(-1);
      if (std::ranges::any_of(g.axes, limits_a_plane)) {
        plane_of.back().back() = static_cast<int>(planes.size());
        planes.push_back(plane_norm_of(model, frames.attached(g.move), frames.attached(g.in)));
      }
      if (g.kind != lang::GroupKind::inside) continue;
      fence_of.back().back() = static_cast<int>(fences.size());
      fences.emplace_back(
          given.regions[static_cast<std::size_t>(g.region)],
          g.moves_footprint ? given.robot.footprint : std::vector<solver::Vector3>{solver::Vector3::Zero()});
    }
  }
  in_reach.resize(fences.size());
  plane_readings.resize(planes.size());
  press_x = press_y = Eigen::VectorXd::Zero(6 + model.joint_count());
  const std::size_t most_wanted =
      tasks.most_axes + RegionFence::most_near * fences.size() + PlaneNorm::most_sides * planes.size();
  axes.reserve(tasks.most_axes);
  wanted.reserve(most_wanted);
  renewed.reserve(2 * most_wanted);
  for (const lang::Task& t : tasks.tasks)
    left.emplace_back(t.exits.size(), tasks.most_nodes, tasks.most_compared, given.signals.size());
  blend.emplace(most_wanted, tasks.most_rows, horizon);
  sources.reserve(Blend::most_sets * blend->capacity());
}

void Scheduler::Parts::follow(const lang::Condition& condition) {
  for (const lang::ExpressionNode& node : condition.nodes) {
    if (node.op == lang::Op::of_frame) frames.follow(node);
    if (node.op == lang::Op::estimated_wrench) wrenches.ask(node.index);
  }
}

/// The observer of a bearing may stand in the world: then the observed frame moves.
bool Scheduler::Parts::is_bearing_of_the_robot(const lang::Group& g) const noexcept {
  return g.kind == lang::GroupKind::feature &&
         features[static_cast<std::size_t>(g.feature)].kind == lang::FeatureKind::bearing &&
         frames.attached(g.in).body >= 0;
}

Scheduler::Scheduler(const lang::Program& program, double period) {
  parts_ = std::make_unique<Parts>(program, period);
}
Scheduler::~Scheduler() = default;
Scheduler::Scheduler(Scheduler&&) noexcept = default;
Scheduler& Scheduler::operator=(Scheduler&&) noexcept = default;

void Scheduler::tick(const Sensed& sensed) noexcept {
  Parts& p = *parts_;
  p.sense(sensed);
  p.advance_guards();
  if (p.task < 0) {
    Parts::Choice first;
    first.transition.time = p.now;
    first.target = {lang::TargetKind::task, p.start};
    p.take(first);
  } else if (p.phase == Phase::running) {
    if (const auto choice = p.choose()) p.take(*choice);
  } else {
    if (const auto choice = p.choose_while_stopping()) p.take(*choice);
    p.check_rest();
  }
  if (!p.transition) p.track_losses();
  p.put_constraints();
}

void Scheduler::observe(const solver::Solution& solution) noexcept {
  parts_->read(solution);
}

bool Scheduler::pose_broken_sides(const solver::Solver& solver, const solver::Solution& solution) noexcept {
  return parts_->pose_broken_sides(solver, solution);
}

bool Scheduler::fill_constraints() noexcept {
  for (BlendedSet& set : parts_->blend->sets()) {
    if (!set.constraints.fill(parts_->frames.motions())) return false;
  }
  return true;
}

int Scheduler::set_count() const noexcept {
  return static_cast<int>(parts_->blend->sets().size());
}
solver::ConstraintSet& Scheduler::constraints(int set) noexcept {
  return parts_->blend->set(set).constraints;
}
const solver::ConstraintSet& Scheduler::constraints(int set) const noexcept {
  return parts_->blend->set(set).constraints;
}
double Scheduler::share(int set) const noexcept {
  return parts_->blend->set(set).share;
}
std::span<const solver::RowSet> Scheduler::row_sets() const noexcept {
  return {parts_->row_sets.data(), parts_->blend->sets().size()};
}
const std::vector<InForce>& Scheduler::in_force(int set) const noexcept {
  return parts_->blend->set(set).in_force;
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
bool Scheduler::has_stood() const noexcept {
  return parts_->has_stood;
}
const std::optional<Excursion>& Scheduler::excursion() const noexcept {
  return parts_->excursion;
}
int Scheduler::task() const noexcept {
  return parts_->task;
}
void Scheduler::estimate_force(const solver::Vector3& force) noexcept {
  parts_->estimated_force = force;
  parts_->wrenches.take_base_force(force, parts_->frames);
}
void Scheduler::estimate_wrenches(const solver::FreeMotions& motions, const Eigen::VectorXd& p,
                                  double dt) noexcept {
  if (parts_->state != nullptr) parts_->wrenches.estimate(motions, p, *parts_->state, parts_->frames, dt);
}
bool Scheduler::asks_for_motion() const noexcept {
  return parts_->asks_for_motion;
}
void Scheduler::follow_up(const solver::Solver& solver) noexcept {
  Parts& p = *parts_;
  p.asks_for_motion = p.phase == Phase::running && std::ranges::any_of(p.axes, [&p](const ActiveAxis& a) {
                        return a.is_outside || p.asks_for_motion_of(a);
                      });
  for (ActiveAxis& a : p.axes) {
    if (a.says->build_up) p.build_up(a);
    if (!a.says->yield || a.row < 0) continue;
    solver.force_on_motions(a.row, p.press_x);
    a.inverse_mass = p.press_x.head(p.mobility).squaredNorm();
  }
}
std::span<const double> Scheduler::outputs() const noexcept {
  return parts_->outputs;
}
void Scheduler::stop_outputs() noexcept {
  parts_->stop_outputs();
}
void Scheduler::set_output(int index, double value) noexcept {
  parts_->outputs[static_cast<std::size_t>(index)] = value;
}

double Scheduler::elapsed() const noexcept {
  return parts_->elapsed();
}
double Scheduler::dwell(int exit) const noexcept {
  return parts_->guards.dwell(static_cast<std::size_t>(exit));
}
double Scheduler::always_dwell(int exit) const noexcept {
  return parts_->always_guards.dwell(static_cast<std::size_t>(exit));
}
const std::vector<double>& Scheduler::parameters() const noexcept {
  return parts_->parameters;
}
bool Scheduler::set_parameter(int index, double value) noexcept {
  Parts& p = *parts_;
  if (index < 0 || static_cast<std::size_t>(index) >= p.parameters.size() || !std::isfinite(value))
    return false;
  const auto& range = p.parameter_ranges[static_cast<std::size_t>(index)];
  if (range && (value < range->low || value > range->high)) return false;
  p.parameters[static_cast<std::size_t>(index)] = value;
  p.values_are_due = true;
  return true;
}
bool Scheduler::signal_known(int signal) const noexcept {
  return parts_->signals.known(signal);
}
double Scheduler::signal_age(int signal) const noexcept {
  return parts_->signals.age(signal);
}
const SignalSample& Scheduler::signal_sample(int signal) const noexcept {
  return parts_->signals.sample(signal);
}
std::string Scheduler::part_name(const Origin& origin) const {
  if (origin.part < 0) return {};
  const auto task = static_cast<std::size_t>(origin.task), group = static_cast<std::size_t>(origin.group);
  const int fence = parts_->fence_of[task][group];
  if (fence < 0)
    return parts_->planes[static_cast<std::size_t>(parts_->plane_of[task][group])].name(origin.part);
  return parts_->fences[static_cast<std::size_t>(fence)].name(static_cast<std::size_t>(origin.part));
}
const std::vector<lang::Task>& Scheduler::tasks() const noexcept {
  return parts_->tasks.tasks;
}
int Scheduler::program_task_count() const noexcept {
  return parts_->tasks.program_tasks;
}
int Scheduler::always_task() const noexcept {
  return parts_->tasks.always();
}
int Scheduler::row_capacity() const noexcept {
  return static_cast<int>(Blend::most_sets) * set_capacity();
}
int Scheduler::set_capacity() const noexcept {
  return Blend::rows_of_a_set(parts_->tasks.most_rows);
}
double Scheduler::period() const noexcept {
  return parts_->period;
}

AxisReading Scheduler::reading(const Origin& origin) const noexcept {
  const ActiveAxis* a = parts_->find(origin);
  return a != nullptr ? a->reading : AxisReading{};
}

}  // namespace zwang::runtime
