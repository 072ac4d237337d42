#include "check_task_file.hpp"
#include "diagnostic/wordings.hpp"
#include "load_within.hpp"
#include "lower/lower.hpp"
#include "robot/load_robot.hpp"
#include "scene/check_scene.hpp"
#include "scene/check_start_inside.hpp"
#include "scene/load_robots.hpp"
#include "scene/load_scene.hpp"
#include "spec/task_file.hpp"
#include "tree/file.hpp"
#include "tree/read.hpp"
#include "zwang/lang/notes.hpp"
#include "zwang/lang/scene_for_robot.hpp"

namespace zwang::lang {

namespace {

namespace fs = std::filesystem;

/// The robot that the command line names, else the file's.
std::optional<Robot> load_robot_of(const TaskFile& file, const fs::path& path, const fs::path& root,
                                   const LoadOptions& options, const Span& cause, Diagnostics& diagnostics) {
  if (options.robot) return load_robot_below(*options.robot, root_of(*options.robot), cause, diagnostics);
  if (!file.robot.exists()) return std::nullopt;
  const auto robot = resolve_path(file.robot.text, path, root, file.robot.span, diagnostics);
  if (!robot) return std::nullopt;
  return load_robot_below(*robot, root, file.robot.span, diagnostics);
}

std::optional<Scene> load_scene_of(const TaskFile& file, const fs::path& path, const fs::path& root,
                                   const LoadOptions& options, double& budget, Diagnostics& diagnostics) {
  if (options.scene) {
    const fs::path own_root = options.root.value_or(root_of(*options.scene));
    return load_scene_from(*options.scene, own_root, {}, budget, diagnostics);
  }
  if (!file.scene.exists()) return std::nullopt;
  const auto scene = resolve_path(file.scene.text, path, root, file.scene.span, diagnostics);
  if (!scene) return std::nullopt;
  return load_scene_from(*scene, root, file.scene.span, budget, diagnostics);
}

/// A robot of a scene names a task file, and the place of its start is all that the physics asks of a scene.
struct Invitation {
  Span task, robot;            ///< where they are named
  std::optional<Scene> scene;  ///< in the place of any that the task file names
};

std::optional<Program> load_phases(const fs::path& path, const LoadOptions& options, bool with_notes,
                                   double& budget, Diagnostics& diagnostics, const Invitation& invited = {},
                                   const Start& start = {}) {
  const fs::path root = options.root.value_or(root_of(path));
  const std::optional<int> source = read_file(path, yaml_size_limit, invited.task, diagnostics);
  if (!source) return std::nullopt;
  const std::optional<Document> document = read(*source, diagnostics);
  if (!document) return std::nullopt;
  std::optional<TaskFile> file = parse(*document, diagnostics);
  if (!file) return std::nullopt;
  std::optional<Robot> robot = load_robot_of(*file, path, root, options, invited.robot, diagnostics);
  std::optional<Scene> scene =
      invited.scene ? invited.scene : load_scene_of(*file, path, root, options, budget, diagnostics);
  if (scene) put_start(start, *scene);
  if (scene && robot) check_scene_for(*scene, *robot, diagnostics);
  // Names of a section that could not be read would all be called unknown.
  if (file->is_incomplete) return std::nullopt;
  std::optional<CheckedFile> checked =
      check(std::move(*file), std::move(robot), std::move(scene), options, with_notes, budget, diagnostics);
  if (!checked) return std::nullopt;
  Program program = lower(std::move(*checked));
  program.path = path.string();
  check_start_inside(program, diagnostics);
  return program;
}

Invitation invitation_of(const SceneRobot& robot, const Scene& scene) {
  Scene own;
  own.start_at = robot.at;
  own.start_yaw = robot.yaw;
  own.floor_friction = scene.floor_friction;
  own.signals = robot.signals;
  return {robot.task_span, robot.robot_span, std::move(own)};
}

}  // namespace

bool load_robots_of(Scene& scene, const fs::path& path, const fs::path& root, double& budget,
                    Diagnostics& diagnostics) {
  for (SceneRobot& robot : scene.robots) {
    // Robots may share files: where one is wrong, it is wrong for all, and said already.
    if (diagnostics.has_errors()) return false;
    LoadOptions options;
    options.root = root;
    if (!robot.robot.empty())
      options.robot = resolve_path(robot.robot, path, root, robot.robot_span, diagnostics);
    const auto task = resolve_path(robot.task, path, root, robot.task_span, diagnostics);
    if (!task || (!robot.robot.empty() && !options.robot)) continue;
    options.given = robot.parameters;
    if (options.robot) robot.robot_path = options.robot->string();
    if (auto program = load_phases(*task, options, false, budget, diagnostics, invitation_of(robot, scene)))
      robot.program = std::make_shared<const Program>(std::move(*program));
  }
  return !diagnostics.has_errors();
}

std::optional<Scene> load_scene_for(const fs::path& robot_path, const fs::path& path,
                                    Diagnostics& diagnostics) {
  double budget = whole_budget;
  const std::optional<Robot> robot = load_robot_below(robot_path, root_of(robot_path), {}, diagnostics);
  std::optional<Scene> scene = load_scene_from(path, root_of(path), {}, budget, diagnostics);
  if (scene && robot) check_scene_for(*scene, *robot, diagnostics);
  diagnostics.settle();
  if (diagnostics.has_errors()) return std::nullopt;
  return scene;
}

solver::State start_state(const Robot& robot, const std::optional<Scene>& scene) {
  solver::State state = start_state(robot);
  if (!scene || robot.model.has_fixed_base()) return state;
  state.base_pose.position = {scene->start_at[0], scene->start_at[1], 0.0};
  state.base_pose.rotation = solver::rotation_from_rpy(0.0, 0.0, scene->start_yaw);
  return state;
}

void put_start(const Start& start, Scene& scene) {
  scene.start_at = start.at.value_or(scene.start_at);
  scene.start_yaw = start.yaw.value_or(scene.start_yaw);
}

std::optional<Program> load_within(double& budget, const fs::path& path, const LoadOptions& options,
                                   const Start& start, Diagnostics& diagnostics) {
  std::optional<Program> program = load_phases(path, options, false, budget, diagnostics, {}, start);
  diagnostics.settle();
  return program;
}

std::optional<Program> load_from(const Start& start, const fs::path& path, const LoadOptions& options,
                                 Diagnostics& diagnostics) {
  double budget = whole_budget;
  return load_within(budget, path, options, start, diagnostics);
}

std::optional<Program> load(const fs::path& path, const LoadOptions& options, Diagnostics& diagnostics) {
  return load_from({}, path, options, diagnostics);
}

std::optional<Program> load_with_notes(const fs::path& path, const LoadOptions& options,
                                       Diagnostics& diagnostics) {
  double budget = whole_budget;
  std::optional<Program> program = load_phases(path, options, true, budget, diagnostics);
  diagnostics.settle();
  return program;
}

}  // namespace zwang::lang
