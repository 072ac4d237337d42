#include "run/statement_table.hpp"

#include <utility>

namespace zwang::runtime {

namespace {

/// The robot's limits differ from task to task in what the task replaces; the shared entry has them all.
void merge(lang::AxisStatements& into, const lang::AxisStatements& from) {
  const auto take = [&](auto member, solver::Quantity quantity) {
    if (into.*member || !(from.*member)) return;
    into.*member = from.*member;
    const auto q = static_cast<std::size_t>(quantity);
    into.statement_spans[q] = from.statement_spans[q];
  };
  take(&lang::AxisStatements::position, solver::Quantity::position);
  take(&lang::AxisStatements::velocity, solver::Quantity::velocity);
  take(&lang::AxisStatements::acceleration, solver::Quantity::acceleration);
  take(&lang::AxisStatements::force, solver::Quantity::force);
}

/// One axis of a group.
Statement statement_of(const std::string& name, bool own, const lang::AxisStatements& says,
                       const lang::Group& group, const lang::Program& program) {
  Statement statement{name, own, says, group.kind == lang::GroupKind::inside, {}, {}, 0.0};
  const auto frame = static_cast<std::size_t>(group.move);
  if (frame < program.frames.size()) statement.frame = program.frames[frame].name;
  if (!statement.inside) return statement;
  if (group.moves_footprint) statement.frame = "footprint";
  const lang::Region& region = program.regions[static_cast<std::size_t>(group.region)];
  statement.region = region.name;
  statement.radius = region.radius;
  return statement;
}

}  // namespace

StatementTable::StatementTable(const Scheduler& scheduler, const lang::Program& program) {
  const std::vector<lang::Task>& tasks = scheduler.tasks();
  ids_.resize(tasks.size());
  // First what the file says, then what the robot adds.
  for (const bool own : {true, false}) {
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      const bool is_always = static_cast<int>(t) == scheduler.always_task();
      const std::size_t own_groups = is_always                  ? tasks[t].groups.size()
                                     : t < program.tasks.size() ? program.tasks[t].groups.size()
                                                                : 0;
      ids_[t].resize(tasks[t].groups.size());
      for (std::size_t g = 0; g < tasks[t].groups.size(); ++g) {
        if ((g < own_groups) != own) continue;
        const lang::Group& group = tasks[t].groups[g];
        for (const lang::AxisStatements& a : group.axes) {
          const std::string name = own ? tasks[t].name + "." + a.name : a.name;
          ids_[t][g].push_back(find_or_add(statement_of(name, own, a, group, program)));
        }
      }
    }
  }
}

int StatementTable::find_or_add(Statement statement) {
  for (std::size_t i = 0; i < statements_.size(); ++i) {
    if (statements_[i].own == statement.own && statements_[i].name == statement.name) {
      merge(statements_[i].says, statement.says);
      return static_cast<int>(i);
    }
  }
  statements_.push_back(std::move(statement));
  return static_cast<int>(statements_.size()) - 1;
}

int StatementTable::id(const Origin& origin) const noexcept {
  return ids_[static_cast<std::size_t>(origin.task)][static_cast<std::size_t>(origin.group)]
             [static_cast<std::size_t>(origin.axis)];
}

const char* unit_of(solver::Axis axis, solver::Quantity quantity) noexcept {
  const bool turns = axis >= solver::Axis::rx;
  switch (quantity) {
    case solver::Quantity::position:
      return turns ? "rad" : "m";
    case solver::Quantity::velocity:
      return turns ? "rad/s" : "m/s";
    case solver::Quantity::acceleration:
      return turns ? "rad/s^2" : "m/s^2";
    case solver::Quantity::force:
      break;
  }
  return turns ? "N m" : "N";
}

}  // namespace zwang::runtime
