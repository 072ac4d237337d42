#include "scene/load_scene.hpp"

#include "check/check.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_guides.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_never.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "scene/check_scene.hpp"
#include "scene/check_start.hpp"
#include "scene/faults.hpp"
#include "scene/load_guide.hpp"
#include "scene/load_pushes.hpp"
#include "scene/load_robots.hpp"
#include "scene/load_signals.hpp"
#include "spec/in_one_line.hpp"
#include "spec/shape.hpp"
#include "tree/file.hpp"
#include "tree/read.hpp"
#include "words/nearest.hpp"

namespace zwang::lang {

namespace {

/// `[0, 0, 20]` as `{at: [0 m, 0 m], yaw: 20 deg}`.
std::string start_example(const Node& node) {
  const auto& items = node.items;
  std::string example = "{at: [0 m, 0 m]";
  if (items.size() >= 2)
    example = "{at: [" + wording::with_unit(items[0].text, dimension::length) + ", " +
              wording::with_unit(items[1].text, dimension::length) + "]";
  if (items.size() == 3) example += ", yaw: " + wording::with_unit(items[2].text, dimension::angle);
  return example + "}";
}

void parse_start(const Node& node, Scene& scene, Diagnostics& diagnostics) {
  MapReader start(node, "`start`", diagnostics, start_example(node));
  if (const Node* at = start.optional("at"))
    scene.start_at = parse_place(*at, "start.at", "yaw", diagnostics).value_or(scene.start_at);
  if (const Node* yaw = start.optional("yaw")) {
    scene.start_yaw = parse_plain(*yaw, dimension::angle, "start.yaw", diagnostics).value_or(0.0);
  }
  start.finish();
}

void parse_floor(const Node& node, Scene& scene, Diagnostics& diagnostics) {
  MapReader floor(node, "`floor`", diagnostics, "{friction: " + (node.is_scalar() ? node.text : "0.9") + "}");
  if (const Node* friction = floor.optional("friction")) {
    scene.floor_friction =
        parse_positive(*friction, dimension::none, "floor.friction", false, diagnostics).value_or(0.9);
  }
  floor.finish();
}

/// The mapping that the author of `wall: 3` or `cylinder: [0.3, 1.7]` may have meant.
std::string sizes_example(const Node& node, bool is_wall) {
  const auto size = [&](std::size_t i, const char* usual) {
    if (node.is_scalar() && i == 0) return wording::with_unit(node.text, dimension::length);
    return i < node.items.size() ? wording::with_unit(node.items[i].text, dimension::length) : usual;
  };
  return is_wall ? "{length: " + size(0, "4 m") + "}"
                 : "{radius: " + size(0, "0.3 m") + ", height: " + size(1, "1 m") + "}";
}

/// The sizes of a cylinder or a wall, by name.
void parse_sizes(const Node& node, const std::string& whose, SceneObject& object, Diagnostics& diagnostics) {
  const bool is_wall = object.shape == ShapeKind::wall;
  const std::string what = whose + (is_wall ? "'s `wall`" : "'s `cylinder`");
  if (count_bare_numbers(node) > 1 && node.is_mapping()) {
    diagnostics.add(wording::needs_units(node.span, what, in_one_line(node, dimension::length)));
    return;
  }
  MapReader map(node, what, diagnostics, sizes_example(node, is_wall));
  const auto size = [&](const char* key, double& target, bool is_required) {
    const Node* value = is_required ? map.required(key) : map.optional(key);
    if (value != nullptr) {
      target =
          parse_positive(*value, dimension::length, whose + "'s " + key, false, diagnostics).value_or(1.0);
    }
  };
  if (object.shape == ShapeKind::cylinder) {
    size("radius", object.size[0], true);
    object.size[1] = object.size[0];
    size("height", object.size[2], true);
  } else {
    object.size = {1.0, 0.1, 1.0};
    size("length", object.size[0], true);
    size("thickness", object.size[1], false);
    size("height", object.size[2], false);
  }
  map.finish();
}

/// How many shapes are given.
int parse_shape(MapReader& map, SceneObject& object, Diagnostics& diagnostics) {
  const std::string what = "object `" + object.name + "`";
  const Node* box = map.optional("box");
  const Node* cylinder = map.optional("cylinder");
  const Node* wall = map.optional("wall");
  const int count = (box != nullptr ? 1 : 0) + (cylinder != nullptr ? 1 : 0) + (wall != nullptr ? 1 : 0);
  if (count == 1 && box != nullptr) {
    object.shape = ShapeKind::box;
    const auto values = parse_vector(*box, dimension::length, 3, 3, what + "'s box", diagnostics);
    if (!values) return count;
    object.size = {(*values)[0], (*values)[1], (*values)[2]};
    for (const double extent : *values) {
      if (extent > 0.0) continue;
      diagnostics.add(wording::not_positive(box->span, what + "'s box", false));
      return count;
    }
  } else if (count == 1) {
    object.shape = cylinder != nullptr ? ShapeKind::cylinder : ShapeKind::wall;
    parse_sizes(cylinder != nullptr ? *cylinder : *wall, what, object, diagnostics);
  }
  return count;
}

/// How it feels to touch an object or a robot.
template <typename Touched>
void parse_contact(MapReader& map, Touched& touched, Diagnostics& diagnostics) {
  if (const Node* node = map.optional("stiffness")) {
    touched.stiffness =
        parse_positive(*node, dimension::stiffness, map.what() + "'s `stiffness`", false, diagnostics)
            .value_or(1e5);
  }
  if (const Node* node = map.optional("damping")) {
    touched.damping =
        parse_positive(*node, dimension::none, map.what() + "'s `damping`", true, diagnostics).value_or(0.3);
  }
  if (const Node* node = map.optional("friction")) {
    touched.friction =
        parse_positive(*node, dimension::none, map.what() + "'s `friction`", true, diagnostics);
  }
}

/// `yaw`, or `rpy` of a fixed box or wall that leans.
void parse_heading(MapReader& map, SceneObject& object, Diagnostics& diagnostics) {
  const Node* yaw = map.optional("yaw");
  const Node* rpy = map.optional("rpy");
  if (yaw != nullptr)
    object.yaw = parse_plain(*yaw, dimension::angle, map.what() + "'s `yaw`", diagnostics).value_or(0.0);
  if (rpy == nullptr) return;
  if (yaw != nullptr) diagnostics.add(wording::yaw_twice(rpy->span, map.what()));
  const auto angles = parse_vector(*rpy, dimension::angle, 3, 3, map.what() + "'s `rpy`", diagnostics);
  if (!angles) return;
  object.roll = (*angles)[0];
  object.pitch = (*angles)[1];
  object.yaw = (*angles)[2];
  for (const char* key : {"mass", "hinge", "slide", "motion", "dock", "cylinder"}) {
    if (!object.leans() || map.optional(key) == nullptr) continue;
    diagnostics.add(wording::leans_and(rpy->span, map.what(), key));
    return;
  }
}

SceneObject parse_object(const Entry& entry, Diagnostics& diagnostics) {
  SceneObject object;
  object.name = parse_name(entry.key, "an object's name", diagnostics).text;
  object.span = entry.key.span;
  const std::string what = "object `" + entry.key.text + "`";
  MapReader map(entry.value, what, diagnostics);
  if (!map.is_mapping()) return object;
  const int shapes = parse_shape(map, object, diagnostics);
  if (const Node* at = map.required("at"))
    object.at = parse_place(*at, what + "'s `at`", "yaw", diagnostics).value_or(object.at);
  parse_heading(map, object, diagnostics);
  const Node* mass = map.optional("mass");
  const Node* fixed = map.optional("fixed");
  if (mass != nullptr) {
    object.mass =
        parse_positive(*mass, dimension::mass, what + "'s `mass`", false, diagnostics).value_or(1.0);
  }
  const std::optional<bool> is_fixed =
      fixed != nullptr ? parse_boolean(*fixed, what + "'s `fixed`", diagnostics) : std::nullopt;
  const bool is_guided = has_guide(entry.value);
  if (is_fixed == true && mass != nullptr && !is_guided)
    diagnostics.add(wording::fixed_with_mass(fixed->span, what, mass->span));
  const bool has_motion = entry.value.find("motion") != nullptr;
  if (is_fixed == false && mass == nullptr && !has_motion && !map.has_misspelt({"mass", "motion"}))
    diagnostics.add(wording::loose_without_mass(fixed->span, what));
  parse_contact(map, object, diagnostics);
  if (const Node* node = map.optional("motion")) {
    object.motion = parse_motion(*node, what + "'s `motion`", diagnostics);
    if (mass != nullptr && !is_guided)
      diagnostics.add(wording::scripted_with_mass(node->span, what, mass->span));
  }
  parse_guide(map, object, diagnostics);
  if (const Node* node = map.optional("dock")) {
    object.dock = parse_dock(*node, what + "'s `dock`", diagnostics);
  }
  // An unknown key may have been the shape's.
  if (shapes > 1 || (shapes == 0 && !map.has_unread_keys()))
    diagnostics.add(wording::one_shape(object.span, what));
  map.finish();
  return object;
}

std::vector<GivenParameter> parse_given_parameters(const Node& node, const std::string& what,
                                                   Diagnostics& diagnostics) {
  std::vector<GivenParameter> given;
  if (!require_mapping(node, what, diagnostics)) return given;
  for (const Entry& entry : node.entries) {
    if (entry.key.is_bad) continue;
    const Word value = parse_word(entry.value, what + "." + entry.key.text, diagnostics);
    if (value.exists()) given.push_back({entry.key.text, value.text, entry.key.span, entry.value.span});
  }
  return given;
}

/// The robot's own signals may speak of robots that come later: `seen` are all.
SceneRobot parse_robot(const Entry& entry, const std::vector<Seen>& seen, Diagnostics& diagnostics) {
  SceneRobot robot;
  robot.name = parse_name(entry.key, "a robot's name", diagnostics).text;
  robot.span = entry.key.span;
  const std::string what = "robot `" + entry.key.text + "`";
  MapReader map(entry.value, what, diagnostics,
                "{task: " + (entry.value.is_scalar() ? entry.value.text : "task.yaml") + ", at: [2 m, 0 m]}");
  if (!map.is_mapping()) return robot;
  if (const Node* task = map.required("task")) {
    robot.task = parse_word(*task, what + "'s `task`", diagnostics).text;
    robot.task_span = task->span;
  }
  if (const Node* file = map.optional("robot")) {
    robot.robot = parse_word(*file, what + "'s `robot`", diagnostics).text;
    robot.robot_span = file->span;
  }
  if (const Node* node = map.optional("params"))
    robot.parameters = parse_given_parameters(*node, what + "'s `params`", diagnostics);
  if (const Node* at = map.required("at"))
    robot.at = parse_place(*at, what + "'s `at`", "yaw", diagnostics).value_or(robot.at);
  if (const Node* yaw = map.optional("yaw"))
    robot.yaw = parse_plain(*yaw, dimension::angle, what + "'s `yaw`", diagnostics).value_or(0.0);
  parse_contact(map, robot, diagnostics);
  if (const Node* node = map.optional("dock"))
    robot.dock = parse_dock(*node, what + "'s `dock`", diagnostics);
  if (const Node* node = map.optional("signals"))
    robot.signals = parse_scene_signals(*node, seen, false, diagnostics);
  const Node* state = map.optional("state");
  if (state != nullptr) robot.state = parse_state_noise(*state, diagnostics);
  robot.state.wheels_only = robot.state.wheels_only || state == nullptr;
  map.finish();
  return robot;
}

/// `truth.base` is the first robot's, and what has a name is seen by it.
void take_name(const Node& key, std::vector<Seen>& seen, bool has_dock, Diagnostics& diagnostics) {
  for (const Seen& other : seen) {
    if (other.name != key.text) continue;
    const std::string owner =
        key.text == "base" ? "the robot's base in `truth.base`" : "an object of the scene";
    diagnostics.add(wording::name_taken(key.span, key.text, owner));
  }
  seen.push_back({key.text, has_dock});
}

/// Of an object or a robot; one that is misspelt was complained of.
bool has_dock(const Node& node) {
  for (const Entry& entry : node.entries) {
    if (meant_key(entry.key.text, {"at", "dock", "mass", "yaw"}) == "dock" || entry.key.text == "dock")
      return true;
  }
  return false;
}

void parse_robots(const Node& node, Scene& scene, std::vector<Seen>& seen, Diagnostics& diagnostics) {
  if (!require_mapping(node, "`robots`", diagnostics)) return;
  if (node.entries.size() > most_scene_robots) {
    diagnostics.add(wording::too_many_robots(node.entries[most_scene_robots].key.span, most_scene_robots));
    return;
  }
  for (const Entry& entry : node.entries) {
    if (!entry.key.is_bad) take_name(entry.key, seen, has_dock(entry.value), diagnostics);
  }
  for (const Entry& entry : node.entries) {
    if (!entry.key.is_bad) scene.robots.push_back(parse_robot(entry, seen, diagnostics));
  }
}

std::optional<Scene> parse_scene(const Document& document, Diagnostics& diagnostics) {
  MapReader map(document.root, "a scene file", diagnostics);
  if (!map.is_mapping() || !check_version(map, "zwang_scene", 1, diagnostics)) return std::nullopt;
  Scene scene;
  if (const Node* node = map.optional("start")) parse_start(*node, scene, diagnostics);
  if (const Node* node = map.optional("floor")) parse_floor(*node, scene, diagnostics);
  if (const Node* node = map.optional("real_rollers")) {
    scene.real_rollers = parse_boolean(*node, "`real_rollers`", diagnostics).value_or(false);
    scene.real_rollers_span = node->span;
  }
  std::vector<Seen> seen;
  const Node* objects = map.optional("objects");
  if (objects != nullptr && require_mapping(*objects, "`objects`", diagnostics)) {
    for (const Entry& entry : objects->entries) {
      if (entry.key.is_bad) continue;
      scene.objects.push_back(parse_object(entry, diagnostics));
      // `truth.base.x` is the robot's.
      if (entry.key.text == "base")
        diagnostics.add(wording::name_taken(entry.key.span, "base", "the robot's base in `truth.base`"));
      seen.push_back({entry.key.text, has_dock(entry.value), travel_of(entry.value)});
    }
  }
  seen.push_back({"base", false});
  const Node* robots = map.optional("robots");
  if (robots != nullptr) parse_robots(*robots, scene, seen, diagnostics);
  const bool are_read =
      (objects == nullptr || objects->is_mapping()) && (robots == nullptr || robots->is_mapping());
  if (!are_read || map.has_misspelt({"objects", "robots"})) seen.push_back({});
  if (const Node* node = map.optional("signals")) {
    scene.signals = parse_scene_signals(*node, seen, true, diagnostics);
  }
  const Node* state = map.optional("state");
  if (state != nullptr) scene.state = parse_state_noise(*state, diagnostics);
  // The plant's truth only where the scene says so.
  scene.state.wheels_only = scene.state.wheels_only || state == nullptr;
  if (const Node* node = map.optional("faults")) scene.faults = parse_faults(*node, false, diagnostics);
  if (const Node* node = map.optional("pushes")) scene.pushes = parse_pushes(*node, scene, diagnostics);
  map.finish();
  return scene;
}

}  // namespace

std::optional<Scene> load_scene_from(const std::filesystem::path& path, const std::filesystem::path& root,
                                     const Span& cause, double& budget, Diagnostics& diagnostics) {
  const std::optional<int> source = read_file(path, yaml_size_limit, cause, diagnostics);
  if (!source) return std::nullopt;
  std::optional<Scene> scene = read_scene(*source, diagnostics);
  if (scene) scene->path = path.string();
  if (scene && !load_robots_of(*scene, path, root, budget, diagnostics)) return std::nullopt;
  const int errors_before = diagnostics.error_count();
  if (scene) check_faults_of_partners(scene->faults, *scene, diagnostics);
  if (scene) check_leaving_objects(scene->faults, *scene, diagnostics);
  if (scene) check_partners(*scene, diagnostics);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  return scene;
}

std::optional<Scene> read_scene(int source, Diagnostics& diagnostics) {
  const int errors_before = diagnostics.error_count();
  const std::optional<Document> document = read(source, diagnostics);
  if (!document) return std::nullopt;
  std::optional<Scene> scene = parse_scene(*document, diagnostics);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  return scene;
}

std::optional<Scene> load_scene(const std::filesystem::path& path, Diagnostics& diagnostics) {
  double budget = whole_budget;
  std::optional<Scene> scene = load_scene_from(path, root_of(path), {}, budget, diagnostics);
  if (scene) check_objects_at_start(*scene, diagnostics);
  diagnostics.settle();
  return diagnostics.has_errors() ? std::nullopt : scene;
}

}  // namespace zwang::lang
