#include "zwang/lang/plant_refusal.hpp"

#include "diagnostic/wordings_standing.hpp"

namespace zwang::lang {

namespace {

bool names(const std::string& reason, const std::string& thing) {
  return reason.find("`" + thing + "`") != std::string::npos;
}

Span cause_of(const std::string& reason, const Robot& robot, const Scene* scene) {
  if (scene != nullptr) {
    for (const SceneObject& object : scene->objects) {
      if (names(reason, object.name)) return object.span;
    }
    for (const SceneRobot& other : scene->robots) {
      if (names(reason, other.name)) return other.span;
    }
  }
  for (std::size_t j = 0; j < robot.joint_spans.size(); ++j) {
    const solver::Body& body = robot.model.bodies()[j + 1];
    if (names(reason, body.name) || names(reason, body.joint.name)) return robot.joint_spans[j];
  }
  return robot.joint_spans.empty() ? Span{} : robot.joint_spans.front();
}

}  // namespace

void tell_plant_refusal(const std::string& reason, const Robot& robot, const Scene* scene,
                        Diagnostics& diagnostics) {
  diagnostics.add(wording::plant_refuses(cause_of(reason, robot, scene), reason));
}

}  // namespace zwang::lang
