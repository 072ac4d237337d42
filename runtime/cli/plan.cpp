#include "file_kind.hpp"
#include "output.hpp"
#include "plan_report.hpp"
#include "verbs.hpp"
#include "zwang/lang/notes.hpp"

namespace zwang::cli {

int plan(const PlanArguments& arguments) {
  require_file(arguments.file);
  refuse_urdf(arguments.file);
  lang::Diagnostics diagnostics;
  const std::optional<lang::Program> program =
      lang::load_with_notes(arguments.file, arguments.overrides.load_options(), diagnostics);
  if (!program) {
    if (arguments.format == Format::json) {
      print_data("{\"ok\": false, \"diagnostics\": " + lang::render_json(diagnostics) + "}\n");
    } else {
      print(rendered(diagnostics));
    }
    return exit_bad;
  }
  std::vector<int> wanted;
  for (std::size_t i = 0; i < program->tasks.size(); ++i) {
    const bool is_wanted = !arguments.task || program->tasks[i].name == *arguments.task;
    if (is_wanted) wanted.push_back(static_cast<int>(i));
  }
  if (wanted.empty()) throw Impossible("no task named `" + *arguments.task + "` in " + arguments.file);

  const runtime::Planner planner(*program, diagnostics);
  const solver::BaseAnalysis base =
      solver::analyse_base(program->robot.model, lang::start_state(program->robot, program->scene));
  std::vector<TaskPlan> plans;
  for (const int index : wanted) plans.push_back(planner.plan(index));
  if (arguments.format == Format::json) {
    print_data(json(plans, base.mobility, planner.configurations(), diagnostics));
    return exit_good;
  }
  for (const TaskPlan& task : plans) {
    print((&task == plans.data() ? "" : "\n") +
          human(task, base.mobility, planner.configurations(), diagnostics));
  }
  return exit_good;
}

}  // namespace zwang::cli
