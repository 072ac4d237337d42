#include "check_task_file.hpp"

#include "check/context.hpp"
#include "physics/physics.hpp"

namespace zwang::lang {

std::optional<CheckedFile> check(TaskFile file, std::optional<Robot> robot, std::optional<Scene> scene,
                                 const LoadOptions& options, bool with_notes, double& budget,
                                 Diagnostics& diagnostics) {
  CheckedFile checked;
  checked.symbols.has_robot = robot.has_value();
  for (const TaskText& task : file.tasks) checked.symbols.tasks.push_back(task.name.text);
  CheckContext context{file, robot, options, checked.symbols, diagnostics, with_notes, &checked.yields};
  check_statements(context, scene, checked);
  check_physics(context, scene, {checked.conditions, checked.always_conditions, checked.requirements},
                budget);
  if (scene && !diagnostics.has_errors()) {
    check_scene_names(context, *scene);
    check_unfed_signals(context, *scene);
  }
  if (diagnostics.has_errors() || !robot) return std::nullopt;
  checked.robot = std::move(*robot);
  checked.scene = std::move(scene);
  checked.file = std::move(file);
  return checked;
}

}  // namespace zwang::lang
