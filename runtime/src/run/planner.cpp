#include "zwang/runtime/planner.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "zwang/lang/configurations.hpp"
#include "zwang/runtime/scheduler.hpp"
#include "zwang/runtime/with_unit.hpp"
#include "zwang/solver/popov_vereshchagin.hpp"

namespace zwang::runtime {

namespace {

/// The program as if it began with this task, entered without a blend.
lang::Program starting_with(const lang::Program& program, int task) {
  lang::Program one = program;
  one.start = task;
  lang::Task& first = one.tasks[static_cast<std::size_t>(task)];
  first.blend = {.constant = 0.0};
  first.require.reset();
  first.attempts.reset();
  return one;
}

const lang::AxisStatements* statements_of(const Scheduler& scheduler, const Origin& origin) {
  if (origin.task < 0 || origin.group < 0 || origin.axis < 0) return nullptr;
  const lang::Task& task = scheduler.tasks().at(static_cast<std::size_t>(origin.task));
  return &task.groups.at(static_cast<std::size_t>(origin.group))
              .axes.at(static_cast<std::size_t>(origin.axis));
}

const lang::Span& span_of(const lang::AxisStatements& axis, solver::Quantity quantity) {
  const lang::Span& span = axis.statement_spans[static_cast<std::size_t>(quantity)];
  return span.exists() ? span : axis.span;
}

bool turns(const solver::AxisConstraint& constraint) {
  return constraint.is_angle() || constraint.axis >= solver::Axis::rx;
}

/// Of the frame and those it hangs on: the name of the pose signal among them.
std::string signal_of(const lang::Program& program, int frame) {
  while (frame > 0) {
    const lang::FrameDeclaration& declared = program.frames[static_cast<std::size_t>(frame)];
    if (declared.parent == lang::FrameParent::signal)
      return program.signals[static_cast<std::size_t>(declared.parent_index)].name;
    frame = declared.parent == lang::FrameParent::frame ? declared.parent_index : 0;
  }
  return "";
}

/// Signals that the group's frames and drivers hang on.
std::set<std::string> signals_of(const lang::Program& program, const lang::Group& group) {
  std::set<std::string> names{signal_of(program, group.move), signal_of(program, group.in)};
  if (group.kind == lang::GroupKind::feature) {
    const lang::Feature& feature = program.features[static_cast<std::size_t>(group.feature)];
    names.insert(signal_of(program, feature.first));
    names.insert(signal_of(program, feature.second));
  }
  if (group.kind == lang::GroupKind::inside)
    names.insert(signal_of(program, program.regions[static_cast<std::size_t>(group.region)].parent));
  for (const lang::AxisStatements& axis : group.axes) {
    if (axis.target.signal >= 0)
      names.insert(program.signals[static_cast<std::size_t>(axis.target.signal)].name);
  }
  names.erase("");
  return names;
}

class Look {
 public:
  Look(const lang::Program& program, const lang::Diagnostics& diagnostics,
       const std::vector<solver::State>& states, Sensed sensed)
      : program_(program),
        diagnostics_(diagnostics),
        states_(states),
        state_(states.front()),
        sensed_(std::move(sensed)) {
    sensed_.state = state_;
  }

  TaskPlan plan(int index) {
    TaskPlan plan;
    const lang::Task& task = program_.tasks[static_cast<std::size_t>(index)];
    plan.task = task.name;
    plan.notes = notes_of(task);
    try {
      Scheduler scheduler(starting_with(program_, index), program_.robot.control_period);
      scheduler.tick(sensed_);
      solver::ConstraintSet& set = scheduler.constraints();
      if (!set.fill(program_.robot.model, state_))
        throw std::invalid_argument("the rows exceed the capacity");
      for (const solver::Row& row : set.rows()) add_row(scheduler, set, row, plan);
      merge_parts(scheduler, set, plan);
      count_rank(set, plan);
      add_dormant(task, scheduler.parameters(), plan);
    } catch (const std::invalid_argument& reason) {
      plan.refused = reason.what();
    }
    return plan;
  }

 private:
  void add_row(const Scheduler& scheduler, const solver::ConstraintSet& set, const solver::Row& row,
               TaskPlan& plan) {
    const auto index = static_cast<std::size_t>(row.constraint);
    const solver::AxisConstraint& constraint = set.constraints().at(index);
    PlannedRow planned;
    planned.row = row;
    planned.turns = turns(constraint);
    const lang::AxisStatements* axis = statements_of(scheduler, scheduler.in_force().at(index).origin);
    if (axis != nullptr) {
      planned.name = axis->name;
      planned.span = span_of(*axis, row.quantity);
    }
    const solver::AxisAnalysis& analysis = analyse(planned.name, constraint, plan);
    const bool drives = row.kind == solver::RowKind::driver;
    if (axis != nullptr && axis->weight && drives) {
      // R = 1/w: nu = (b - g) / (1/Lambda + 1/w), of which w / (w + Lambda) is met.
      planned.weight = axis->weight->evaluate(scheduler.parameters());
      planned.fraction = *planned.weight / (*planned.weight + analysis.effective_mass);
    }
    plan.equality_rows += drives ? 1 : 0;
    plan.rows.push_back(planned);
  }

  const solver::AxisAnalysis& analyse(const std::string& name, const solver::AxisConstraint& constraint,
                                      TaskPlan& plan) {
    for (const PlannedAxis& axis : plan.axes) {
      if (axis.name == name) return axis.analysis;
    }
    PlannedAxis axis;
    axis.name = name;
    axis.turns = turns(constraint);
    axis.analysis = look(constraint, axis);
    plan.axes.push_back(axis);
    return plan.axes.back().analysis;
  }

  /// Through the solver's analysis, in every configuration; returns that of the start pose.
  solver::AxisAnalysis look(const solver::AxisConstraint& constraint, PlannedAxis& axis) const {
    solver::AxisAnalysis start;
    for (const solver::State& state : states_) {
      const solver::AxisAnalysis one =
          lang::usable(solver::analyse_axis(program_.robot.model, state, constraint));
      if (&state == &state_) start = one;
      axis.mass.add(one.effective_mass);
      axis.is_sometimes_held = axis.is_sometimes_held || !std::isfinite(one.effective_mass);
      if (one.reachable) axis.force.add(one.largest_force);
    }
    return start;
  }

  /// A region has a row for each pair of features that is near: the figures are those of all of them.
  void merge_parts(const Scheduler& scheduler, const solver::ConstraintSet& set, TaskPlan& plan) const {
    for (std::size_t i = 0; i < set.constraints().size(); ++i) {
      const Origin& origin = scheduler.in_force().at(i).origin;
      const lang::AxisStatements* statements = statements_of(scheduler, origin);
      if (statements == nullptr || origin.part < 1) continue;
      for (PlannedAxis& axis : plan.axes) {
        if (axis.name == statements->name) look(set.constraints()[i], axis);
      }
    }
  }

  /// Statements without a row at the start pose, and those that have another row until a signal comes.
  void add_dormant(const lang::Task& task, const std::vector<double>& parameters, TaskPlan& plan) const {
    std::set<std::string> unknown;
    for (const auto* groups : {&program_.always.groups, &task.groups}) {
      for (const lang::Group& group : *groups) {
        unknown.merge(signals_of(program_, group));
        const bool is_far = group.kind == lang::GroupKind::inside && !has_row(plan, group.name);
        if (is_far) plan.dormant.push_back({group.name, "no edge is near", group.span});
        for (const lang::AxisStatements& axis : group.axes) {
          if (!axis.is_planar || !axis.velocity || has_row(plan, axis.name)) continue;
          const std::string half = with_unit(0.5 * axis.velocity->high.evaluate(parameters), "m/s", 3);
          plan.dormant.push_back(
              {axis.name, "no row below " + half, span_of(axis, solver::Quantity::velocity)});
        }
      }
    }
    plan.unknown_signals.assign(unknown.begin(), unknown.end());
  }

  static bool has_row(const TaskPlan& plan, const std::string& name) {
    return std::any_of(plan.rows.begin(), plan.rows.end(),
                       [&](const PlannedRow& row) { return row.name == name; });
  }

  void count_rank(const solver::ConstraintSet& set, TaskPlan& plan) {
    solver::PopovVereshchagin equalities(program_.robot.model,
                                         {.row_capacity = std::max(1, static_cast<int>(set.rows().size()))});
    solver::ConstrainedMotion motion(program_.robot.model, std::max(1, static_cast<int>(set.rows().size())));
    std::vector<solver::AccelerationRow> rows;
    if (equalities.solve(state_, rows, motion) != solver::Status::ok) return;
    const int ground = motion.rank;
    for (const solver::Row& row : set.rows()) {
      if (row.kind != solver::RowKind::driver) continue;
      rows.push_back({row.body, row.a, row.reference_body, row.a_reference, row.b});
    }
    if (equalities.solve(state_, rows, motion) == solver::Status::ok) plan.rank = motion.rank - ground;
  }

  /// The diagnostics about the lines of the task, and of `always`, which holds in every task.
  std::vector<lang::Diagnostic> notes_of(const lang::Task& task) const {
    int next = 1 << 30;
    int first_task = 1 << 30;
    for (const lang::Task& other : program_.tasks) {
      first_task = std::min(first_task, other.span.begin.line);
      if (other.span.begin.line > task.span.begin.line) next = std::min(next, other.span.begin.line);
    }
    std::vector<lang::Diagnostic> notes;
    for (const lang::Diagnostic& d : diagnostics_.sorted()) {
      const bool is_physical = d.code.size() == 4 && (d.code[1] == '6' || d.code == "W407");
      const int line = d.span.begin.line;
      const bool is_here = d.span.source != task.span.source || line < first_task ||
                           (line >= task.span.begin.line && line < next);
      if (is_physical && is_here) notes.push_back(d);
    }
    return notes;
  }

  const lang::Program& program_;
  const lang::Diagnostics& diagnostics_;
  const std::vector<solver::State>& states_;  ///< the one that has the rows first
  const solver::State& state_;
  Sensed sensed_;
};

}  // namespace

Planner::Planner(const lang::Program& program, const lang::Diagnostics& diagnostics)
    : program_(program),
      diagnostics_(diagnostics),
      states_(lang::configurations(program.robot, program.scene)) {}

Configurations Planner::configurations() const {
  return {states_.size(), lang::describe_configurations(program_.robot)};
}

TaskPlan Planner::plan(int task) const {
  return Look(program_, diagnostics_, states_, Sensed(program_.robot.model)).plan(task);
}

TaskPlan Planner::plan(int task, const Sensed& at) const {
  const std::vector<solver::State> states{at.state};
  return Look(program_, diagnostics_, states, at).plan(task);
}

}  // namespace zwang::runtime
