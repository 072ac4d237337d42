// An output has its start, and each value that the file sets it to. A signal of the scene has, and five
// standard deviations more either way,
//
//   travel_of       what its hinge or slide leaves it
//   force_of        no less than its bias
//   distance_to     no less than the footprint keeps the base's origin from an object that it meets:
//                   min r - 5 cm, r from the origin to the footprint's edges; a padded wall gives way so far
#include "physics/known_signal.hpp"

#include <algorithm>
#include <cmath>

#include "check/context.hpp"
#include "zwang/lang/plane.hpp"

namespace zwang::lang {

namespace {

/// How far an object's guide lets it go, as the signal measures it.
Known known_travel(const SceneSignal& source, const SceneObject& object, double noise) {
  const Guide& guide = *object.guide;
  Known known{
      {guide.lower - noise, guide.upper + noise}, "the range of `" + object.name + "`", object.span, true};
  if (!source.beyond) return known;
  const bool is_reached =
      *source.beyond < 0.0 ? guide.lower <= *source.beyond : guide.upper >= *source.beyond;
  known.bounds = {0.0, is_reached ? 1.0 : 0.0};
  return known;
}

/// From the base's origin to the edge of an object that the footprint meets.
Known known_distance(const SceneSignal& source, const SceneObject& object, const Robot& robot, double noise) {
  constexpr double gives_way = 0.05;  // [m]
  const bool is_met = !object.leans() && object.size[2] > robot.bumper_height && object.motion.empty();
  const solver::Vector3 origin = solver::Vector3::Zero();
  if (!is_met || robot.footprint.size() < 3 || !plane::contains(robot.footprint, origin)) return {};
  const double least = plane::distance_to_edges(robot.footprint, origin) - gives_way - noise;
  if (!(least > 0.0)) return {};
  return {{least, solver::infinity}, "the footprint that meets `" + object.name + "`", source.span, true};
}

}  // namespace

Known known_output(const CheckContext& context, int index) {
  const Output& output = context.symbols.outputs[static_cast<std::size_t>(index)].output;
  Known known{{output.start, output.start}, output.name, output.span, true, index};
  for (const ValueText* value : values_set(context, output.name)) {
    const std::optional<bool> truth = truth_of(*value);
    if (!truth && value->kind != ValueKind::quantity) return {};
    const double given = truth ? (*truth ? 1.0 : 0.0) : value->quantity.value;
    known.bounds.low = std::min(known.bounds.low, given);
    known.bounds.high = std::max(known.bounds.high, given);
  }
  return known;
}

Known known_signal(const std::string& name, const std::optional<Scene>& scene, const Robot& robot) {
  constexpr double most_deviations = 5.0;  // of a normal noise, once in a million samples
  if (!scene) return {};
  const auto at = std::find_if(scene->signals.begin(), scene->signals.end(),
                               [&](const SceneSignal& source) { return source.name == name; });
  if (at == scene->signals.end() || at->object < 0) return {};
  const auto k = static_cast<std::size_t>(at->object);
  const double noise = most_deviations * std::max(at->noise, at->angle_noise);
  const bool is_object = k < scene->objects.size();
  if (at->kind == SceneSignalKind::travel && is_object && scene->objects[k].guide)
    return known_travel(*at, scene->objects[k], noise);
  if (at->kind == SceneSignalKind::distance && is_object)
    return known_distance(*at, scene->objects[k], robot, noise);
  if (at->kind != SceneSignalKind::force || at->beyond) return {};
  return {{std::min(0.0, at->bias) - noise, solver::infinity}, "a push of two that touch", at->span, true};
}

std::vector<const ValueText*> values_set(const CheckContext& context, const std::string& output) {
  std::vector<const ValueText*> values;
  const auto gather = [&](const std::vector<SetText>& sets) {
    for (const SetText& set : sets) {
      if (set.kind == SetKind::output && set.name.text == output) values.push_back(&set.value);
    }
  };
  for (const ExitText& exit : context.file.always_exits) gather(exit.set);
  for (const TaskText& task : context.file.tasks) {
    gather(task.set_on_entry);
    for (const ExitText& exit : task.exits) gather(exit.set);
  }
  return values;
}

}  // namespace zwang::lang
