#include "mjcf.hpp"

#include <algorithm>
#include <string_view>

#include "mjcf_text.hpp"
#include "object_geometry.hpp"
#include "outline.hpp"
#include "pair_friction.hpp"
#include "refuse.hpp"
#include "zwang/lang/object_outline.hpp"

namespace zwang::runtime {

namespace {

using namespace mjcf;
using lang::SceneObject;
using lang::ShapeKind;
using solver::Matrix3;
using solver::RigidInertia;
using solver::Vector3;

constexpr double scripted_mass = 1e6;  ///< [kg] whatever meets it does not move it

class MjcfWriter {
 public:
  MjcfWriter(const std::vector<SimulatedRobot>& robots, const lang::Scene& scene)
      : robots_(robots), scene_(scene) {
    for (const SimulatedRobot& robot : robots) texts_.push_back(write_robot(robot, scene.floor_friction));
  }

  std::string write(double period) {
    const solver::Model& first = robots_.front().robot.model;
    text_ = "<mujoco model=\"zwang\">\n";
    text_ += "<compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n";
    text_ +=
        "<option integrator=\"Euler\" solver=\"Newton\" cone=\"elliptic\" impratio=\"10\" "
        "tolerance=\"1e-12\" collision=\"predefined\"" +
        attribute("timestep", text_of(period)) + attribute("gravity", list_of(first.gravity())) + "/>\n";
    text_ += "<default><geom contype=\"0\" conaffinity=\"0\" condim=\"3\" " + stiff() + "/></default>\n";
    write_assets();
    text_ += "<worldbody>\n";
    text_ += "<geom name=\"floor\" type=\"plane\" size=\"0 0 1\"/>\n";
    for (const RobotText& robot : texts_) text_ += robot.body;
    for (std::size_t k = 0; k < scene_.objects.size(); ++k) write_object(k);
    text_ += "</worldbody>\n";
    write_pairs();
    write_docks();
    write_motors();
    write_size();
    text_ += "</mujoco>\n";
    return std::move(text_);
  }

 private:
  /// As many contact points and constraint rows as there can be at once. MuJoCo takes memory for the square
  /// of the rows and writes zeros to it: 2000 rows take 50 MB and 20 ms at each start.
  void write_size() {
    // A sphere or a roller touches in one point. A hull that fell on the floor is a box or a mesh.
    constexpr std::size_t points_of_a_hull = 8, rows_of_a_point = 3, rows_of_a_joint = 2, rows_of_a_dock = 3;
    constexpr std::size_t most_points = 500, most_rows = 2000;
    std::size_t joints = 0;
    for (const SimulatedRobot& robot : robots_)
      joints += static_cast<std::size_t>(robot.robot.model.joint_count());
    for (const SceneObject& object : scene_.objects) joints += object.guide ? 1U : 0U;
    const std::size_t hulls = elements("hull\" condim");
    const std::size_t points = std::min(most_points, elements("<pair") + (points_of_a_hull - 1) * hulls);
    const std::size_t rows = std::min(most_rows, rows_of_a_point * points + rows_of_a_joint * joints +
                                                     rows_of_a_dock * elements("<connect"));
    text_ += "<size" + attribute("nconmax", std::to_string(points)) +
             attribute("njmax", std::to_string(rows)) + " nuser_geom=\"1\"/>\n";
  }

  std::size_t elements(std::string_view begin) const {
    std::size_t count = 0;
    for (std::size_t at = text_.find(begin); at != std::string::npos; at = text_.find(begin, at + 1)) ++count;
    return count;
  }

  void write_assets() {
    std::string assets;
    for (const RobotText& robot : texts_) assets += robot.assets;
    if (!assets.empty()) text_ += "<asset>" + assets + "</asset>\n";
  }

  void write_motors() {
    text_ += "<actuator>\n";
    for (const RobotText& robot : texts_) text_ += robot.motors;
    text_ += "</actuator>\n";
  }

  /// Objects that do not reach the bumper's height are not met.
  static bool is_met(const SceneObject& object, const SimulatedRobot& robot) {
    return lang::reaches(object, robot.robot.bumper_height);
  }
  bool is_met(const SceneObject& object) const {
    return std::any_of(robots_.begin(), robots_.end(),
                       [&object](const SimulatedRobot& robot) { return is_met(object, robot); });
  }

  void write_object(std::size_t k) {
    const SceneObject& object = scene_.objects[k];
    const ObjectGeometry g = geometry_of(object);
    const std::string name = numbered("object", k);
    text_ += "<body" + attribute("name", name) + attribute("pos", list_of(g.centre)) +
             (object.leans() ? attribute("quat", quaternion_of(g.rotation))
                             : attribute("euler", list_of(0.0, 0.0, object.yaw))) +
             ">\n";
    if (object.guide) {
      if (!object.is_locked()) write_guide(*object.guide, object, g, name);
    } else if (object.moves()) {
      const double mass = object.mass.value_or(scripted_mass);
      if (!(mass > 0.0)) refuse("the mass of `" + object.name + "` is not positive");
      text_ += "<joint" + attribute("name", name + "_x") + " type=\"slide\" axis=\"1 0 0\"/>\n";
      text_ += "<joint" + attribute("name", name + "_y") + " type=\"slide\" axis=\"0 1 0\"/>\n";
      text_ += "<joint" + attribute("name", name + "_turn") + " type=\"hinge\" axis=\"0 0 1\"/>\n";
      text_ += inertial(inertia_of(mass, g));
    }
    if (is_met(object)) object.leans() ? write_leaning_faces(object, g, name) : write_faces(g, name);
    if (has_tips()) write_solid(g, name);
    text_ += "</body>\n";
  }

  bool has_tips() const {
    return std::any_of(robots_.begin(), robots_.end(),
                       [](const SimulatedRobot& robot) { return !robot.tips.empty(); });
  }

  /// The object as it is, which the tips of arms meet.
  void write_solid(const ObjectGeometry& g, const std::string& name) {
    text_ += "<geom" + attribute("name", name + "_solid") +
             (g.round ? attribute("type", "cylinder") + attribute("size", list_of(g.half.x(), g.half.z()))
                      : attribute("type", "box") + attribute("size", list_of(g.half))) +
             "/>\n";
  }

  /// The joint of an object with a guide, and its inertia. The guide's other effects are in object_guide.hpp.
  void write_guide(const lang::Guide& guide, const SceneObject& object, const ObjectGeometry& g,
                   const std::string& name) {
    if (!object.mass || !(*object.mass > 0.0)) refuse("the mass of `" + object.name + "` is not positive");
    const Vector3 at = Vector3(guide.at[0], guide.at[1], guide.at[2]) - g.shift;
    const std::string moves = attribute("type", guide.turns ? "hinge" : "slide") +
                              attribute("axis", list_of(guide.axis[0], guide.axis[1], guide.axis[2])) +
                              (guide.turns ? attribute("pos", list_of(at)) : "");
    text_ += "<joint" + attribute("name", name + "_guide") + moves + attribute("limited", "true") +
             attribute("range", list_of(guide.lower, guide.upper)) +
             attribute("damping", text_of(guide.damping)) +
             " solreflimit=\"0.004 1\" solimplimit=\"0.95 0.99 0.001\"/>\n";
    text_ += inertial(inertia_of(*object.mass, g));
  }

  /// A round object is met as the sphere that its circle in the bumper's plane belongs to.
  void write_faces(const ObjectGeometry& g, const std::string& name) {
    const Vector3 plane(0.0, 0.0, robots_.front().robot.bumper_height - g.half.z());
    if (g.round) {
      text_ += sphere_geom(name + "_face", plane, g.half.x());
      return;
    }
    text_ += "<geom" + attribute("name", name + "_face") + attribute("type", "box") +
             attribute("pos", list_of(plane)) +
             attribute("size", list_of(g.half.x(), g.half.y(), contact_half_height)) + "/>\n";
    const auto edges = corners_of(rectangle(g.half.x(), g.half.y()));
    for (std::size_t c = 0; c < edges.size(); ++c) {
      text_ += corner_geom(numbered(name + "_edge", c), edges[c], plane);
    }
  }

  /// As large as it is, with corners where its edges pass through the bumper's plane.
  void write_leaning_faces(const SceneObject& object, const ObjectGeometry& g, const std::string& name) {
    text_ += "<geom" + attribute("name", name + "_face") + attribute("type", "box") +
             attribute("size", list_of(g.half)) + "/>\n";
    const Matrix3 back = lang::lean_of(object).transpose();
    const auto edges = corners_of(outline_of_edges(object));
    const Vector3 plane(0.0, 0.0, robots_.front().robot.bumper_height);
    for (std::size_t c = 0; c < edges.size(); ++c) {
      const Matrix3 outward = solver::rotation_from_rpy(0.0, 0.0, edges[c].outward);
      text_ += corner_geom(numbered(name + "_edge", c), back * (edges[c].centre + plane) - g.shift,
                           quaternion_of(back * outward), edges[c].half_angle);
    }
  }

  /// Corners that touch sides, at the bumper's height.
  std::vector<Vector3> outline_of_edges(const SceneObject& object) const {
    return lang::outline_of(object, robots_.front().robot.bumper_height);
  }

  static RigidInertia inertia_of(double mass, const ObjectGeometry& g) {
    const Vector3 sq = g.half.cwiseProduct(g.half);
    Vector3 moments;
    if (g.round) {
      const double across = mass * (sq.x() / 4.0 + sq.z() / 3.0);
      moments = {across, across, mass * sq.x() / 2.0};
    } else {
      moments = mass / 3.0 * Vector3(sq.y() + sq.z(), sq.x() + sq.z(), sq.x() + sq.y());
    }
    return RigidInertia::from_com(mass, Vector3::Zero(), moments.asDiagonal());
  }

  void write_pairs() {
    text_ += "<contact>\n";
    for (const RobotText& robot : texts_) text_ += robot.contacts;
    for (std::size_t k = 0; k < scene_.objects.size(); ++k) {
      for (const SimulatedRobot& robot : robots_) {
        if (!robot.outline.empty() && is_met(scene_.objects[k], robot)) write_meeting_of_robot(k, robot);
        for (std::size_t t = 0; t < robot.tips.size(); ++t) write_meeting_of_tip(k, robot, t);
      }
      for (std::size_t other = 0; other < k; ++other) {
        if (meet(k, other) && is_met(scene_.objects[k]) && is_met(scene_.objects[other]))
          write_meeting(k, other);
      }
    }
    for (std::size_t r = 1; r < robots_.size(); ++r) {
      for (std::size_t other = 0; other < r; ++other) write_meeting_of_robots(other, r);
    }
    text_ += "</contact>\n";
  }

  bool can_move(std::size_t k) const {
    const SceneObject& object = scene_.objects[k];
    return object.guide ? !object.is_locked() : object.moves();
  }
  /// A drawer's cabinet and a door's frame stand around the drawer and the door. Whatever does not move
  /// freely and stands nearer than this to something on a guide, as it is written, counts as that: they never
  /// meet.
  static constexpr double clearance = 0.02;  // [m] more than the play of a door in its frame
  bool meet(std::size_t k, std::size_t other) const {
    if (!can_move(k) && !can_move(other)) return false;
    const SceneObject& one = scene_.objects[k];
    const SceneObject& two = scene_.objects[other];
    const auto is_free = [](const SceneObject& object) { return object.moves() && !object.guide; };
    const bool is_guided = one.guide || two.guide;
    if (!is_guided || is_free(one) || is_free(two)) return true;
    return gap_between(one, two, robots_.front().robot.bumper_height) > clearance;
  }

  /// Ties that hold nothing until the plant puts one in force: the hook's origin to a point of the object.
  void write_docks() {
    text_ += "<equality>\n";
    for (std::size_t k = 0; k < scene_.objects.size(); ++k) {
      const SceneObject& object = scene_.objects[k];
      if (object.dock) write_dock(k, *object.dock, object.name, numbered("object", k));
    }
    for (std::size_t r = 1; r < robots_.size(); ++r) {
      const lang::SceneRobot& robot = scene_.robots[r - 1];
      if (robot.dock)
        write_dock(scene_.objects.size() + r - 1, *robot.dock, robot.name, robots_[r].named("body", 0));
    }
    text_ += "</equality>\n";
  }

  void write_dock(std::size_t number, const lang::Dock& dock, const std::string& owner,
                  const std::string& body) {
    const SimulatedRobot& first = robots_.front();
    const solver::Frame& hook = hook_of(first.robot.model, dock, owner);
    text_ += "<connect" + attribute("name", numbered("dock", number)) +
             attribute("body1", first.named("body", static_cast<std::size_t>(hook.body))) +
             attribute("body2", body) + attribute("anchor", list_of(hook.pose_in_body.position)) +
             " active=\"false\" " + stiff() + "/>\n";
  }

  void write_meeting_of_robot(std::size_t k, const SimulatedRobot& robot) {
    const SceneObject& object = scene_.objects[k];
    const std::string face = numbered("object", k) + "_face";
    const std::string prism = robot.prefix + "bumper_prism";
    if (object.shape == ShapeKind::cylinder) {
      write_spring(face, prism, pair_friction(object.friction));
      return;
    }
    for (std::size_t c = 0; c < robot.outline.size(); ++c) {
      write_spring(face, robot.named("bumper", c), pair_friction(object.friction));
    }
    const std::size_t edges = outline_of_edges(object).size();
    for (std::size_t c = 0; c < edges; ++c)
      write_spring(edge_of(k, c), prism, pair_friction(object.friction));
  }

  void write_meeting_of_tip(std::size_t k, const SimulatedRobot& robot, std::size_t tip) {
    write_spring(numbered("object", k) + "_solid", robot.named("tip", tip),
                 pair_friction(scene_.objects[k].friction));
  }

  /// Corners of each against the sides of the other, at the height of the corner's bumper. `r` > 0.
  void write_meeting_of_robots(std::size_t other, std::size_t r) {
    const SimulatedRobot& one = robots_[other];
    const SimulatedRobot& two = robots_[r];
    if (one.outline.empty() || two.outline.empty()) return;
    const std::optional<double> of_one = other > 0 ? scene_.robots[other - 1].friction : std::nullopt;
    const double friction = pair_friction(of_one, scene_.robots[r - 1].friction);
    for (std::size_t c = 0; c < one.outline.size(); ++c)
      write_spring(one.named("bumper", c), two.prefix + "bumper_prism", friction);
    for (std::size_t c = 0; c < two.outline.size(); ++c)
      write_spring(two.named("bumper", c), one.prefix + "bumper_prism", friction);
  }

  void write_meeting(std::size_t k, std::size_t other) {
    const double friction = pair_friction(scene_.objects[k].friction, scene_.objects[other].friction);
    const bool k_round = scene_.objects[k].shape == ShapeKind::cylinder;
    const bool other_round = scene_.objects[other].shape == ShapeKind::cylinder;
    const std::string face = numbered("object", k) + "_face";
    const std::string other_face = numbered("object", other) + "_face";
    if (k_round || other_round) {
      write_spring(face, other_face, friction);
      return;
    }
    for (std::size_t c = 0; c < outline_of_edges(scene_.objects[k]).size(); ++c)
      write_spring(edge_of(k, c), other_face, friction);
    for (std::size_t c = 0; c < outline_of_edges(scene_.objects[other]).size(); ++c)
      write_spring(edge_of(other, c), face, friction);
  }

  static std::string edge_of(std::size_t k, std::size_t c) {
    return numbered(numbered("object", k) + "_edge", c);
  }

  /// ContactFriction reads the coefficient.
  void write_spring(const std::string& one, const std::string& other, double friction) {
    const double d = spring_impedance;
    text_ += "<pair" + attribute("geom1", one) + attribute("geom2", other) + attribute("condim", "1") +
             attribute("solimp", list_of(d, d, 0.001)) +
             attribute("friction", list_of(friction, friction, 0.0, 0.0, 0.0)) + "/>\n";
  }

  const std::vector<SimulatedRobot>& robots_;
  std::vector<RobotText> texts_;
  const lang::Scene& scene_;
  std::string text_;
};

}  // namespace

std::string write_mjcf(const std::vector<SimulatedRobot>& robots, const lang::Scene& scene, double period) {
  return MjcfWriter(robots, scene).write(period);
}

}  // namespace zwang::runtime
