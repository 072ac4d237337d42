// The rows of each task as the solver will get them at the start pose, and what the robot can make of them.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "output.hpp"
#include "verbs.hpp"
#include "zwang/lang/notes.hpp"
#include "zwang/runtime/scheduler.hpp"
#include "zwang/solver/base_analysis.hpp"
#include "zwang/solver/popov_vereshchagin.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;

struct PlannedRow {
  solver::Row row;
  std::string name;                ///< "contact.x"
  std::string line;                ///< "wall_align.yaml:24"; empty where there is no text
  std::optional<double> weight;    ///< [kg] or [kg m^2]
  std::optional<double> fraction;  ///< of b that a soft row meets
  bool turns = false;
};

struct PlannedAxis {
  std::string name;
  bool turns = false;
  solver::AxisAnalysis analysis;
};

struct TaskPlan {
  std::string task;
  std::string refused;  ///< why there are no rows; empty otherwise
  std::vector<PlannedRow> rows;
  std::vector<PlannedAxis> axes;
  int equality_rows = 0;
  int rank = 0;  ///< of the equality rows, on the ground
  std::vector<lang::Diagnostic> notes;
};

const char* force_unit(bool turns) {
  return turns ? "N m" : "N";
}
const char* acceleration_unit(bool turns) {
  return turns ? "rad/s^2" : "m/s^2";
}

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

const lang::AxisStatements* statements_of(const runtime::Scheduler& scheduler,
                                          const runtime::Origin& origin) {
  if (origin.task < 0 || origin.group < 0 || origin.axis < 0) return nullptr;
  const lang::Task& task = scheduler.tasks().at(static_cast<std::size_t>(origin.task));
  return &task.groups.at(static_cast<std::size_t>(origin.group))
              .axes.at(static_cast<std::size_t>(origin.axis));
}

const lang::Span& span_of(const lang::AxisStatements& axis, solver::Quantity quantity) {
  const lang::Span& span = axis.statement_spans[static_cast<std::size_t>(quantity)];
  return span.exists() ? span : axis.span;
}

class Planner {
 public:
  Planner(const lang::Program& program, const lang::Diagnostics& diagnostics)
      : program_(program),
        diagnostics_(diagnostics),
        state_(lang::start_state(program.robot, program.scene)) {}

  TaskPlan plan(int index) {
    TaskPlan plan;
    const lang::Task& task = program_.tasks[static_cast<std::size_t>(index)];
    plan.task = task.name;
    plan.notes = notes_of(task);
    try {
      constexpr double period = 0.001;  // [s]
      runtime::Scheduler scheduler(starting_with(program_, index), period);
      runtime::Sensed sensed(program_.robot.model);
      sensed.state = state_;
      scheduler.tick(sensed);
      solver::ConstraintSet& set = scheduler.constraints();
      if (!set.fill(program_.robot.model, state_))
        throw std::invalid_argument("the rows exceed the capacity");
      for (const solver::Row& row : set.rows()) add_row(scheduler, set, row, plan);
      count_rank(set, plan);
    } catch (const std::invalid_argument& reason) {
      plan.refused = reason.what();
    }
    return plan;
  }

 private:
  void add_row(const runtime::Scheduler& scheduler, const solver::ConstraintSet& set, const solver::Row& row,
               TaskPlan& plan) {
    const auto index = static_cast<std::size_t>(row.constraint);
    const solver::AxisConstraint& constraint = set.constraints().at(index);
    PlannedRow planned;
    planned.row = row;
    planned.turns = constraint.axis >= solver::Axis::rx;
    const lang::AxisStatements* axis = statements_of(scheduler, scheduler.in_force().at(index).origin);
    if (axis != nullptr) {
      planned.name = axis->name;
      planned.line = place(diagnostics_, span_of(*axis, row.quantity));
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
    plan.axes.push_back({name, constraint.axis >= solver::Axis::rx,
                         solver::analyse_axis(program_.robot.model, state_, constraint.move, constraint.in,
                                              constraint.axis)});
    return plan.axes.back().analysis;
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

  /// What was said about the lines of the task, and of `always`, which holds in every task.
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
  solver::State state_;
};

/// What the row does with its quantity.
const char* word(solver::RowKind kind) {
  if (kind == solver::RowKind::driver) return "drives";
  if (kind == solver::RowKind::upper) return "at most";
  if (kind == solver::RowKind::lower) return "at least";
  return kind == solver::RowKind::force ? "presses" : "bounds the sum";
}

/// Rows that only carry or bound a force ask for no acceleration.
bool asks_for_acceleration(solver::RowKind kind) {
  return kind == solver::RowKind::driver || kind == solver::RowKind::upper || kind == solver::RowKind::lower;
}

const char* word(solver::Quantity quantity) {
  constexpr std::array words{"position", "velocity", "acceleration", "force"};
  return words[static_cast<std::size_t>(quantity)];
}

std::string number(double value) {
  if (std::abs(value) < 5e-13) value = 0.0;
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// (moment | force) in the moved body's axes and about its origin.
std::string column(const solver::ForceVector& a) {
  std::string text = "(";
  for (int i = 0; i < 3; ++i) text += number(a.angular[i]) + (i < 2 ? " " : " | ");
  for (int i = 0; i < 3; ++i) text += number(a.linear[i]) + (i < 2 ? " " : ")");
  return text;
}

std::string bounds(const PlannedRow& planned) {
  const solver::Row& row = planned.row;
  if (row.kind == solver::RowKind::force) return number(row.force) + " " + force_unit(planned.turns);
  if (row.kind == solver::RowKind::upper) return "nu <= 0";
  if (row.kind == solver::RowKind::lower) return "nu >= 0";
  if (!std::isfinite(row.lo) && !std::isfinite(row.hi)) return "what the motors make";
  return "[" + number(row.lo) + ", " + number(row.hi) + "] " + force_unit(planned.turns);
}

std::string demand(const PlannedRow& planned) {
  if (!asks_for_acceleration(planned.row.kind)) return "-";
  return number(planned.row.b) + " " + acceleration_unit(planned.turns);
}

std::string softness(const PlannedRow& planned) {
  if (!planned.weight) return "";
  return "weight " + number(*planned.weight) + (planned.turns ? " kg m^2" : " kg") + ": meets " +
         number(100.0 * *planned.fraction) + " %  ";
}

/// Columns as wide as their widest cell.
std::string table(const std::vector<std::vector<std::string>>& lines) {
  std::vector<std::size_t> widths;
  for (const auto& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : lines) {
    std::string row = " ";
    for (std::size_t i = 0; i < line.size(); ++i) row += " " + padded(line[i], widths[i]) + " ";
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string rows_table(const TaskPlan& plan) {
  std::vector<std::vector<std::string>> lines{
      {"row", "level", "", "b", "nu", "A_N (moment | force)", "from"}};
  for (const PlannedRow& planned : plan.rows) {
    lines.push_back({planned.name, std::to_string(planned.row.level),
                     std::string(word(planned.row.kind)) + " " + word(planned.row.quantity), demand(planned),
                     softness(planned) + bounds(planned), column(planned.row.a), planned.line});
  }
  return table(lines);
}

std::string axes_table(const TaskPlan& plan) {
  std::vector<std::vector<std::string>> lines{{"axis", "effective mass", "largest force"}};
  for (const PlannedAxis& axis : plan.axes) {
    const solver::AxisAnalysis& a = axis.analysis;
    const std::string held = a.kappa > 0.0 && std::isfinite(a.effective_mass) ? "no motor along it" : "held";
    lines.push_back({axis.name,
                     std::isfinite(a.effective_mass)
                         ? number(a.effective_mass) + (axis.turns ? " kg m^2" : " kg")
                         : "held by the ground",
                     !a.reachable                     ? held
                     : std::isfinite(a.largest_force) ? number(a.largest_force) + " " + force_unit(axis.turns)
                                                      : "no limit known"});
  }
  return table(lines);
}

std::string human(const TaskPlan& plan, int mobility, const lang::Diagnostics& diagnostics) {
  std::string text = plan.task + "\n";
  if (!plan.refused.empty()) return text + "  no rows: " + plan.refused + "\n";
  text += rows_table(plan) + "\n" + axes_table(plan) + "\n";
  text += "  mobility " + std::to_string(mobility) + "; equality rows " + std::to_string(plan.equality_rows) +
          ", their rank " + std::to_string(plan.rank) + "\n";
  for (const lang::Diagnostic& note : plan.notes) {
    text += "  " + note.code + " " + place(diagnostics, note.span) + ": " + note.message + "\n";
  }
  return text;
}

ordered_json finite(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json json_of(const solver::ForceVector& a) {
  return {a.angular.x(), a.angular.y(), a.angular.z(), a.linear.x(), a.linear.y(), a.linear.z()};
}

ordered_json json(const TaskPlan& plan, const lang::Diagnostics& diagnostics) {
  ordered_json rows = ordered_json::array();
  for (const PlannedRow& p : plan.rows) {
    const bool is_force = p.row.kind == solver::RowKind::force;
    rows.push_back({{"row", p.name},
                    {"kind", word(p.row.kind)},
                    {"quantity", word(p.row.quantity)},
                    {"level", p.row.level},
                    {"a", json_of(p.row.a)},
                    {"body", p.row.body},
                    {"reference_body", p.row.reference_body},
                    {"b", asks_for_acceleration(p.row.kind) ? ordered_json(p.row.b) : ordered_json(nullptr)},
                    {"force", is_force ? ordered_json(p.row.force) : ordered_json(nullptr)},
                    {"lo", finite(p.row.lo)},
                    {"hi", finite(p.row.hi)},
                    {"weight", p.weight ? ordered_json(*p.weight) : ordered_json(nullptr)},
                    {"fraction", p.fraction ? ordered_json(*p.fraction) : ordered_json(nullptr)},
                    {"from", p.line}});
    if (p.row.reference_body >= 0) rows.back()["a_reference"] = json_of(p.row.a_reference);
  }
  ordered_json axes = ordered_json::array();
  for (const PlannedAxis& axis : plan.axes) {
    axes.push_back({{"axis", axis.name},
                    {"reachable", axis.analysis.reachable},
                    {"effective_mass", finite(axis.analysis.effective_mass)},
                    {"largest_force", finite(axis.analysis.largest_force)}});
  }
  ordered_json notes = ordered_json::array();
  for (const lang::Diagnostic& d : plan.notes) {
    notes.push_back({{"code", d.code}, {"where", place(diagnostics, d.span)}, {"message", d.message}});
  }
  ordered_json whole = {{"task", plan.task}, {"equality_rows", plan.equality_rows},
                        {"rank", plan.rank}, {"rows", rows},
                        {"axes", axes},      {"notes", notes}};
  if (!plan.refused.empty()) whole["refused"] = plan.refused;
  return whole;
}

}  // namespace

int plan(const PlanArguments& arguments) {
  require_file(arguments.file);
  lang::LoadOptions options;
  options.robot = arguments.robot;
  options.scene = arguments.scene;
  options.parameters = arguments.parameters;
  lang::Diagnostics diagnostics;
  const std::optional<lang::Program> program = lang::load_with_notes(arguments.file, options, diagnostics);
  if (!program) {
    std::ostringstream text;
    if (arguments.format == Format::json) {
      text << "{\"ok\": false, \"diagnostics\": " << lang::render_json(diagnostics) << "}\n";
    } else {
      lang::render_human(diagnostics, text);
    }
    print(text.str());
    return exit_bad;
  }
  std::vector<int> wanted;
  for (std::size_t i = 0; i < program->tasks.size(); ++i) {
    const bool is_wanted = !arguments.task || program->tasks[i].name == *arguments.task;
    if (is_wanted) wanted.push_back(static_cast<int>(i));
  }
  if (wanted.empty()) throw Impossible("no task named `" + *arguments.task + "` in " + arguments.file);

  Planner planner(*program, diagnostics);
  const solver::BaseAnalysis base =
      solver::analyse_base(program->robot.model, lang::start_state(program->robot, program->scene));
  ordered_json tasks = ordered_json::array();
  for (const int index : wanted) {
    const TaskPlan task = planner.plan(index);
    if (arguments.format == Format::json) {
      tasks.push_back(json(task, diagnostics));
    } else {
      print((index == wanted.front() ? "" : "\n") + human(task, base.mobility, diagnostics));
    }
  }
  if (arguments.format == Format::json) {
    const ordered_json whole = {{"ok", true}, {"mobility", base.mobility}, {"tasks", tasks}};
    print(whole.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
  }
  return exit_good;
}

}  // namespace zwang::cli
