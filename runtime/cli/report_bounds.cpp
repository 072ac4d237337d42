#include <cmath>
#include <tuple>
#include <utility>

#include "json_parts.hpp"
#include "zwang/runtime/scheduler.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;
using solver::Quantity;

struct Bounded {
  std::string column;
  std::string task;  ///< empty: in every task
  double low = 0.0, high = 0.0;
  lang::Span span;
};

ordered_json json_of(const Bounded& b) {
  return {
      {"column", b.column},           {"task", b.task.empty() ? ordered_json(nullptr) : ordered_json(b.task)},
      {"low", finite_or_null(b.low)}, {"high", finite_or_null(b.high)},
      {"file", b.span.source},        {"line", b.span.exists() ? b.span.begin.line : 0}};
}

/// The bounds of one axis. `name`: its statement's, as the columns of the log begin.
void add_axis(const lang::AxisStatements& axis, const std::string& name, const std::string& task, bool inside,
              const std::vector<double>& parameters, ordered_json& bounds) {
  const auto add = [&](const std::optional<lang::ValueRange>& range, const char* column, Quantity quantity) {
    if (!range) return;
    const lang::Span& own = axis.statement_spans[static_cast<std::size_t>(quantity)];
    // A norm in a plane is never below 0: that is no end of its range.
    double low = axis.is_planar ? -solver::infinity : range->low.evaluate(parameters);
    double high = range->high.evaluate(parameters);
    // The column of a region has what is left until its margin.
    if (inside) std::tie(low, high) = std::pair(0.0, solver::infinity);
    bounds.push_back(json_of({name + "." + column, task, low, high, own.exists() ? own : axis.span}));
  };
  add(axis.position, inside ? "left" : "position", Quantity::position);
  add(axis.velocity, "velocity", Quantity::velocity);
  add(axis.acceleration, "acceleration", Quantity::acceleration);
  add(axis.force, axis.driver ? "nu" : "sum", Quantity::force);
  if (axis.driver == Quantity::force) {
    const double force = axis.target.evaluate(parameters);
    const lang::Span& own = axis.statement_spans[static_cast<std::size_t>(Quantity::force)];
    bounds.push_back(json_of({name + ".nu", task, force, force, own.exists() ? own : axis.span}));
  }
}

}  // namespace

ordered_json bounds_of(const lang::Program& program) {
  const runtime::Scheduler scheduler(program, program.robot.control_period);
  const std::vector<double> parameters = program.parameter_values();
  ordered_json bounds = ordered_json::array();
  for (std::size_t t = 0; t < scheduler.tasks().size(); ++t) {
    const lang::Task& task = scheduler.tasks()[t];
    const bool is_always = static_cast<int>(t) == scheduler.always_task();
    const std::size_t own = is_always                  ? task.groups.size()
                            : t < program.tasks.size() ? program.tasks[t].groups.size()
                                                       : 0;
    for (std::size_t g = 0; g < task.groups.size(); ++g) {
      const lang::Group& group = task.groups[g];
      for (const lang::AxisStatements& axis : group.axes)
        add_axis(axis, g < own ? task.name + "." + axis.name : axis.name, is_always ? "" : task.name,
                 group.kind == lang::GroupKind::inside, parameters, bounds);
    }
  }
  for (int j = 0; j < program.robot.model.joint_count(); ++j) {
    const solver::Joint& joint = program.robot.model.joint(j);
    if (!joint.actuated) continue;
    const auto i = static_cast<std::size_t>(j);
    const lang::Span span =
        i < program.robot.joint_spans.size() ? program.robot.joint_spans[i] : lang::Span{};
    // Of a robot that feels the torques are the virtual robot's.
    const double limit = program.robot.drive.mass_factor * joint.max_effort;
    bounds.push_back(json_of({joint.name + ".tau", "", -limit, limit, span}));
  }
  return bounds;
}

}  // namespace zwang::cli
