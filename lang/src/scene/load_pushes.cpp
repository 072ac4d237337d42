#include "scene/load_pushes.hpp"

#include <algorithm>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_guides.hpp"
#include "spec/shape.hpp"

namespace zwang::lang {

namespace {

/// Three components of a force or a torque. If the list has two, the third one is 0.
std::array<double, 3> parse_three(const Node& node, const Dimension& expected, std::size_t fewest,
                                  const std::string& what, Diagnostics& diagnostics) {
  const auto parts = parse_vector(node, expected, fewest, 3, what, diagnostics);
  if (!parts) return {};
  return {(*parts)[0], (*parts)[1], parts->size() > 2 ? (*parts)[2] : 0.0};
}

template <typename Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

/// Why no push moves it; empty where one does.
std::string what_holds(const SceneObject& object) {
  if (object.is_locked()) return "it is `locked`";
  if (!object.motion.empty()) return "it follows its `motion`";
  return object.mass ? "" : "it is fixed";
}

void check_pushed(const ScenePush& push, const Scene& scene, Diagnostics& diagnostics) {
  if (!push.robot.empty() && !push.object.empty()) return;  // told before
  if (!push.robot.empty()) {
    const std::vector<std::string> robots = names_of(scene.robots);
    if (std::find(robots.begin(), robots.end(), push.robot) == robots.end())
      diagnostics.add(wording::unknown_name(push.whose_span, "robot", push.robot, robots));
    return;
  }
  if (push.object.empty()) return;
  const auto object = std::find_if(scene.objects.begin(), scene.objects.end(),
                                   [&](const SceneObject& o) { return o.name == push.object; });
  if (object == scene.objects.end()) {
    diagnostics.add(wording::unknown_name(push.whose_span, "object", push.object, names_of(scene.objects)));
    return;
  }
  const std::string holds = what_holds(*object);
  if (!holds.empty()) {
    diagnostics.add(wording::push_without_effect(push.whose_span, push.object, holds));
  } else if (push.force[2] != 0.0 || push.torque[0] != 0.0 || push.torque[1] != 0.0) {
    diagnostics.add(wording::push_off_the_floor(push.wrench_span, push.object));
  }
}

/// The robot or object that is pressed, and the place of the push.
void parse_place_of_push(MapReader& map, ScenePush& push, Diagnostics& diagnostics) {
  const Node* robot = map.optional("robot");
  const Node* object = map.optional("object");
  const Node* frame = map.optional("frame");
  const Node* point = map.optional("point");
  if (robot != nullptr) push.robot = parse_word(*robot, "`robot`", diagnostics).text;
  if (object != nullptr) push.object = parse_word(*object, "`object`", diagnostics).text;
  if (robot != nullptr) push.whose_span = robot->span;
  if (object != nullptr) push.whose_span = object->span;
  if (frame != nullptr) {
    push.frame = parse_word(*frame, "`frame`", diagnostics).text;
    push.frame_span = frame->span;
  }
  if (point != nullptr) push.point = parse_place(*point, "`point`", "", diagnostics).value_or(push.point);
  if (robot != nullptr && object != nullptr) {
    diagnostics.add(wording::push_of_two(object->span));
  } else if (object != nullptr && frame != nullptr) {
    diagnostics.add(wording::push_key_of_other(frame->span, "frame", true));
  } else if (object == nullptr && point != nullptr && !map.has_misspelt({"object"})) {
    diagnostics.add(wording::push_key_of_other(point->span, "point", false));
  }
}

ScenePush parse_push(const Node& node, const Scene& scene, Diagnostics& diagnostics) {
  ScenePush push;
  MapReader map(node, "a push", diagnostics, "{at: 1 s, force: [30 N, 0 N]}");
  if (!map.is_mapping()) return push;
  if (const Node* at = map.required("at"))
    push.at = parse_positive(*at, dimension::time, "`at`", true, diagnostics).value_or(0.0);
  if (const Node* duration = map.optional("for"))
    push.duration =
        parse_positive(*duration, dimension::time, "`for`", false, diagnostics).value_or(push.duration);
  parse_place_of_push(map, push, diagnostics);
  const Node* force = map.optional("force");
  const Node* torque = map.optional("torque");
  if (force != nullptr) push.force = parse_three(*force, dimension::force, 2, "`force`", diagnostics);
  if (torque != nullptr) push.torque = parse_three(*torque, dimension::torque, 3, "`torque`", diagnostics);
  push.wrench_span = force != nullptr && push.force[2] != 0.0 ? force->span
                     : torque != nullptr                      ? torque->span
                                                              : node.span;
  if (force == nullptr && torque == nullptr && !map.has_unread_keys())
    diagnostics.add(wording::push_without_wrench(node.span));
  map.finish();
  check_pushed(push, scene, diagnostics);
  return push;
}

}  // namespace

std::vector<ScenePush> parse_pushes(const Node& node, const Scene& scene, Diagnostics& diagnostics) {
  std::vector<ScenePush> pushes;
  if (!require_sequence(node, "`pushes`", diagnostics)) return pushes;
  for (const Node& item : node.items) pushes.push_back(parse_push(item, scene, diagnostics));
  return pushes;
}

}  // namespace zwang::lang
