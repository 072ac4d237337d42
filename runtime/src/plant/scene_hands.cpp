#include "scene_hands.hpp"

#include <algorithm>

namespace zwang::runtime {

namespace {

using solver::Vector3;

/// On the first robot or on another one.
BodyPush on_robot(const lang::ScenePush& push, const lang::Scene& scene, const solver::Model& first) {
  BodyPush place;
  const solver::Model* model = &first;
  const auto robot = std::ranges::find(scene.robots, push.robot, &lang::SceneRobot::name);
  if (!push.robot.empty() && robot != scene.robots.end()) {
    place.robot = static_cast<int>(robot - scene.robots.begin()) + 1;
    model = &robot->program->robot.model;
  }
  if (const auto frame = model->find_frame(push.frame)) {
    const solver::Frame& at = model->frames()[static_cast<std::size_t>(*frame)];
    place.body = at.body;
    place.pose = at.pose_in_body;
  }
  return place;
}

BodyPush on_object(const lang::ScenePush& push, const lang::Scene& scene) {
  BodyPush place;
  place.robot = -1;
  const auto object = std::ranges::find(scene.objects, push.object, &lang::SceneObject::name);
  place.body = static_cast<int>(object - scene.objects.begin());
  place.pose.position = {push.point[0], push.point[1], 0.0};
  return place;
}

Vector3 vector_of_three(const std::array<double, 3>& parts) {
  return {parts[0], parts[1], parts[2]};
}

}  // namespace

SceneHands::SceneHands(const lang::Scene& scene, const solver::Model& first) {
  for (const lang::ScenePush& push : scene.pushes) {
    BodyPush place = push.object.empty() ? on_robot(push, scene, first) : on_object(push, scene);
    place.wrench = {vector_of_three(push.torque), vector_of_three(push.force)};
    hands_.push_back({push.at, push.at + push.duration, place});
  }
  pressing_.reserve(hands_.size());
}

std::span<const BodyPush> SceneHands::at(double time) noexcept {
  pressing_.clear();
  for (const Hand& hand : hands_) {
    if (time >= hand.begin && time < hand.end) pressing_.push_back(hand.push);
  }
  return pressing_;
}

}  // namespace zwang::runtime
