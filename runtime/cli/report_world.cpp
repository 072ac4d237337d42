#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph.hpp"
#include "json_parts.hpp"

namespace zwang::cli {

namespace {

using lang::Program;
using nlohmann::ordered_json;

ordered_json json_of(const solver::Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

ordered_json json_of(const solver::Pose& pose) {
  ordered_json rotation = ordered_json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation.push_back(pose.rotation(row, column));
  }
  return {{"p", json_of(pose.position)}, {"r", rotation}};
}

ordered_json json_of(const std::vector<std::array<double, 2>>& polygon) {
  ordered_json corners = ordered_json::array();
  for (const auto& corner : polygon) corners.push_back({corner[0], corner[1]});
  return corners;
}

ordered_json json_of(const std::vector<solver::Vector3>& polygon) {
  ordered_json corners = ordered_json::array();
  for (const solver::Vector3& corner : polygon) corners.push_back({corner.x(), corner.y()});
  return corners;
}

/// The homogeneous box with the body's mass, centre of mass and principal inertias. Its sides a, b, c follow
/// from the moments I about them: a^2 = 6 (I_b + I_c - I_a) / m.
ordered_json box_of(const solver::RigidInertia& inertia) {
  const solver::Vector3 centre = inertia.first_moment / inertia.mass;
  const solver::Matrix3 shift = solver::skew(centre);
  const solver::Matrix3 about_centre = inertia.rotational + inertia.mass * shift * shift;
  const Eigen::SelfAdjointEigenSolver<solver::Matrix3> principal(about_centre);
  const solver::Vector3 moments = principal.eigenvalues();
  solver::Vector3 sides;
  for (int i = 0; i < 3; ++i)
    sides(i) = std::sqrt(std::max(0.0, 6.0 / inertia.mass * (moments.sum() - 2.0 * moments(i))));
  solver::Matrix3 axes = principal.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  return {{"sides", json_of(sides)}, {"pose", json_of(solver::Pose{axes, centre})}};
}

const char* name_of(solver::JointType type) {
  switch (type) {
    case solver::JointType::fixed:
      return "fixed";
    case solver::JointType::prismatic:
      return "prismatic";
    case solver::JointType::revolute:
    case solver::JointType::continuous:
      break;
  }
  return "revolute";
}

ordered_json robot_of(const lang::Robot& robot) {
  ordered_json bodies = ordered_json::array(), wheels = ordered_json::array(), frames = ordered_json::array();
  for (const solver::Body& body : robot.model.bodies()) {
    bodies.push_back({{"name", body.name},
                      {"parent", body.parent},
                      {"pose", json_of(body.pose_in_parent)},
                      {"joint", body.joint.name},
                      {"type", name_of(body.joint.type)},
                      {"axis", json_of(body.joint.axis)},
                      {"effort", std::isfinite(body.joint.max_effort) && body.joint.actuated
                                     ? ordered_json(body.joint.max_effort)
                                     : ordered_json(nullptr)},
                      {"box", box_of(body.inertia)}});
  }
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    wheels.push_back(
        {{"body", wheel.body},
         {"radius", wheel.radius},
         {"roller", wheel.roller_angle ? ordered_json(*wheel.roller_angle) : ordered_json(nullptr)}});
  }
  for (const solver::Frame& frame : robot.model.frames())
    frames.push_back({{"name", frame.name}, {"body", frame.body}, {"pose", json_of(frame.pose_in_body)}});
  ordered_json posture = ordered_json::array();
  for (const double q : robot.posture) posture.push_back(q);
  return {{"name", robot.name},
          {"footprint", json_of(robot.footprint)},
          {"height", robot.bumper_height},
          {"bodies", bodies},
          {"wheels", wheels},
          {"frames", frames},
          {"posture", posture}};
}

ordered_json scene_of(const lang::Scene& scene) {
  ordered_json objects = ordered_json::array(), robots = ordered_json::array();
  for (const lang::SceneObject& o : scene.objects) {
    ordered_json one = {
        {"name", o.name}, {"size", o.size}, {"at", o.at}, {"yaw", o.yaw}, {"moves", o.moves()}};
    one["shape"] = o.shape == lang::ShapeKind::wall  ? "wall"
                   : o.shape == lang::ShapeKind::box ? "box"
                                                     : "cylinder";
    if (o.dock) one["dock"] = o.dock->at;
    if (o.leans()) {
      const solver::Matrix3 rotation = solver::rotation_from_rpy(o.roll, o.pitch, o.yaw);
      one["lean"] = json_of(solver::Pose{rotation, {o.at[0], o.at[1], 0.0}});
    }
    objects.push_back(one);
  }
  for (const lang::SceneRobot& r : scene.robots) {
    ordered_json one = {{"name", r.name}, {"at", r.at}, {"yaw", r.yaw}};
    if (r.program) one["robot"] = robot_of(r.program->robot);
    robots.push_back(one);
  }
  return {{"objects", objects}, {"robots", robots}};
}

ordered_json regions_of(const Program& program) {
  ordered_json regions = ordered_json::array();
  for (const lang::Region& region : program.regions) {
    regions.push_back({{"name", region.name},
                       {"parent", region.parent},
                       {"polygon", json_of(region.polygon)},
                       {"centre", region.centre},
                       {"radius", region.radius}});
  }
  return regions;
}

ordered_json paths_of(const Program& program) {
  constexpr double chord = std::numbers::pi / 36.0;  // [rad] of an arc
  ordered_json paths = ordered_json::array();
  for (const lang::Path& path : program.paths) {
    ordered_json points = ordered_json::array();
    for (const solver::Vector3& point : path.points(chord)) points.push_back({point.x(), point.y()});
    paths.push_back(
        {{"name", path.name}, {"frame", path.frame}, {"closed", path.is_closed}, {"points", points}});
  }
  return paths;
}

/// A frame that a task sets moves when the run reaches the line, which the log does not hold.
bool is_set(const Program& program, int frame) {
  const auto sets = [&](const std::vector<lang::SetAction>& actions) {
    return std::ranges::any_of(
        actions, [&](const auto& a) { return a.kind == lang::SetKind::frame && a.index == frame; });
  };
  const auto exit_sets = [&](const lang::Exit& exit) { return sets(exit.set); };
  return std::ranges::any_of(program.always.exits, exit_sets) ||
         std::ranges::any_of(program.tasks, [&](const lang::Task& task) {
           return sets(task.set_on_entry) || std::ranges::any_of(task.exits, exit_sets);
         });
}

ordered_json frames_of(const Program& program) {
  ordered_json frames = ordered_json::array();
  for (std::size_t i = 0; i < program.frames.size(); ++i) {
    const lang::FrameDeclaration& frame = program.frames[i];
    ordered_json one = {{"name", frame.name}, {"index", frame.parent_index}, {"pose", json_of(frame.pose)}};
    constexpr std::array parents{"world", "body", "frame", "signal"};
    one["parent"] = parents[static_cast<std::size_t>(frame.parent)];
    one["declared"] = frame.span.exists();
    one["set"] = is_set(program, static_cast<int>(i));
    if (frame.parent == lang::FrameParent::signal)
      one["signal"] = program.signals[static_cast<std::size_t>(frame.parent_index)].name;
    frames.push_back(one);
  }
  return frames;
}

}  // namespace

ordered_json world_of(const Program& program) {
  ordered_json signals = ordered_json::array();
  for (const lang::Signal& signal : program.signals)
    signals.push_back(
        {{"name", signal.name}, {"in", signal.in}, {"is_pose", signal.type == lang::SignalType::pose}});
  ordered_json world = {{"robot", robot_of(program.robot)},
                        {"regions", regions_of(program)},
                        {"paths", paths_of(program)},
                        {"frames", frames_of(program)},
                        {"signals", signals}};
  world["scene"] = program.scene ? scene_of(*program.scene) : ordered_json(nullptr);
  return world;
}

ordered_json graph_json(const Program& program) {
  const Graph graph = graph_of(program);
  ordered_json edges = ordered_json::array();
  for (const Edge& edge : graph.edges) {
    edges.push_back(
        {{"from", edge.from}, {"to", edge.to}, {"label", edge.label}, {"dashed", edge.is_interruption}});
  }
  return {{"tasks", graph.tasks}, {"start", graph.start}, {"always", graph.has_always}, {"edges", edges}};
}

}  // namespace zwang::cli
