#include <algorithm>
#include <cmath>
#include <numbers>

#include "mjcf.hpp"
#include "mjcf_text.hpp"
#include "outline.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::runtime {

using namespace mjcf;
using solver::Body;
using solver::JointType;
using solver::Matrix3;
using solver::Model;
using solver::Pose;
using solver::RigidInertia;
using solver::Vector3;

namespace {

constexpr double no_friction = 1e-5;  ///< the least that MuJoCo takes
constexpr double least_clearance =
    0.01;  ///< [m] of the body above the floor; wheels give way by less than 1 mm

/// The parts of the text that are one robot's.
class RobotWriter {
 public:
  explicit RobotWriter(const SimulatedRobot& simulated)
      : robot_(simulated.robot), model_(simulated.robot.model), simulated_(simulated) {}

  void write_assets() {
    if (simulated_.outline.empty() || is_rectangle(simulated_.outline)) return;
    write_prism_mesh("outline", contact_half_height);
    if (has_hull()) write_prism_mesh("hull", hull_half_height());
  }

  void write_prism_mesh(const char* name, double half_height) {
    std::string vertices;
    for (const Vector3& p : simulated_.outline) {
      for (const double z : {-half_height, half_height}) vertices += list_of(p.x(), p.y(), z) + ' ';
    }
    text_ += "<mesh" + attribute("name", simulated_.prefix + name) + attribute("vertex", vertices) + "/>\n";
  }

  bool has_hull() const {
    return !simulated_.outline.empty() && model_.base_type() == solver::BaseType::ground;
  }
  double hull_half_height() const { return 0.5 * (simulated_.top - hull_bottom()); }
  /// A base that stands never touches the floor with its body.
  double hull_bottom() const { return std::max(robot_.bumper_height, least_clearance); }

  void write_body(int index) {
    const Body& body = model_.bodies()[static_cast<std::size_t>(index)];
    const int wheel = wheel_of(index);
    const RollingSphere* sphere = sphere_of(index);
    Pose pose = body.pose_in_parent;
    RigidInertia inertia = body.inertia;
    if (index == 0) {
      pose.position = {0.0, 0.0, model_.base_type() == solver::BaseType::ground ? -simulated_.ground : 0.0};
      inertia = simulated_.spheres.base;
    } else if (wheel >= 0) {
      const Matrix3 in_base = lang::pose_in_base(model_, body.parent).rotation;
      pose.position +=
          in_base.transpose() * Vector3(0.0, 0.0, simulated_.wheel_lift[static_cast<std::size_t>(wheel)]);
    }
    if (has_rollers(wheel)) inertia = simulated_.rollers[static_cast<std::size_t>(wheel)].hub;
    if (sphere != nullptr) {
      pose.rotation = Matrix3::Identity();
      inertia = RigidInertia::from_com(sphere->mass, Vector3::Zero(), sphere->inertia * Matrix3::Identity());
    }
    const auto number = static_cast<std::size_t>(index);
    text_ += "<body" + attribute("name", named("body", number)) + attribute("pos", list_of(pose.position)) +
             attribute("quat", quaternion_of(pose.rotation)) + ">\n";
    if (index == 0) {
      if (!model_.has_fixed_base())
        text_ += "<freejoint" + attribute("name", simulated_.prefix + "base") + "/>\n";
    } else {
      write_joint(body, number - 1, sphere != nullptr);
    }
    if (inertia.mass > 0.0) text_ += inertial(inertia);
    if (index == 0) write_outline();
    if (has_rollers(wheel)) {
      write_rollers(static_cast<std::size_t>(wheel));
    } else if (wheel >= 0) {
      const auto w = static_cast<std::size_t>(wheel);
      text_ += wheel_geom(named("wheel", w), model_.wheels()[w].radius,
                          sphere != nullptr ? 0.0 : turn_of_held(model_.wheels()[w]));
    }
    for (std::size_t t = 0; t < simulated_.tips.size(); ++t) {
      if (simulated_.tips[t].body == index)
        text_ += sphere_geom(named("tip", t), simulated_.tips[t].pose_in_body.position, corner_radius);
    }
    for (int child = index + 1; child < model_.body_count(); ++child) {
      if (model_.bodies()[static_cast<std::size_t>(child)].parent != index) continue;
      write_body(child);
    }
    text_ += "</body>\n";
  }

  bool has_rollers(int wheel) const {
    return wheel >= 0 && !simulated_.rollers.empty() &&
           !simulated_.rollers[static_cast<std::size_t>(wheel)].rollers.empty();
  }

  void write_rollers(std::size_t w) {
    const std::vector<Roller>& rollers = simulated_.rollers[w].rollers;
    for (std::size_t i = 0; i < rollers.size(); ++i) {
      const std::string name = numbered(named("roller", w), i);
      text_ += "<body" + attribute("name", name) + attribute("pos", list_of(rollers[i].pose.position)) +
               attribute("quat", quaternion_of(rollers[i].pose.rotation)) + "><joint" +
               attribute("name", name) + " type=\"hinge\" axis=\"0 0 1\"/>\n" + inertial(rollers[i].inertia) +
               "<geom" + attribute("name", numbered(named("wheel", w), i)) + " type=\"ellipsoid\"" +
               attribute("size", list_of(rollers[i].radius, rollers[i].radius, rollers[i].half)) +
               "/></body>\n";
    }
  }

  void write_joint(const Body& body, std::size_t number, bool ball) {
    const std::string name = attribute("name", named("joint", number));
    if (ball) {
      text_ += "<joint" + name + " type=\"ball\"/>\n";
      return;
    }
    const solver::Joint& joint = body.joint;
    const bool slides = joint.type == JointType::prismatic;
    text_ += "<joint" + name + attribute("type", slides ? "slide" : "hinge") +
             attribute("axis", list_of(joint.axis)) + attribute("armature", text_of(joint.rotor_inertia));
    if (joint.type != JointType::continuous && std::isfinite(joint.lower) && std::isfinite(joint.upper) &&
        joint.lower < joint.upper) {
      text_ += attribute("limited", "true") + attribute("range", list_of(joint.lower, joint.upper));
    }
    text_ += "/>\n";
  }

  void write_outline() {
    if (simulated_.outline.empty()) return;
    const double plane = simulated_.ground + robot_.bumper_height;
    const auto corners = corners_of(simulated_.outline);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      text_ += corner_geom(named("bumper", c), corners[c], Vector3(0.0, 0.0, plane));
    }
    for (std::size_t c = 0; c < simulated_.skids.size(); ++c) {
      const Vector3 up(0.0, 0.0, corner_radius);
      text_ += sphere_geom(named("skid", c), simulated_.skids[c] + up, corner_radius);
    }
    write_prism("bumper_prism", "outline", plane, contact_half_height);
    if (has_hull())
      write_prism("hull", "hull", simulated_.ground + hull_bottom() + hull_half_height(), hull_half_height());
  }

  /// Upright, of the outline's form, about the height `middle`.
  void write_prism(const char* name, const char* mesh, double middle, double half_height) {
    text_ += "<geom" + attribute("name", simulated_.prefix + name);
    if (is_rectangle(simulated_.outline)) {
      const auto& p = simulated_.outline;
      const Vector3 side = p[1] - p[0];
      const Vector3 centre = 0.5 * (p[0] + p[2]) + Vector3(0.0, 0.0, middle);
      text_ += attribute("type", "box") + attribute("pos", list_of(centre)) +
               attribute("euler", list_of(0.0, 0.0, std::atan2(side.y(), side.x()))) +
               attribute("size", list_of(0.5 * side.norm(), 0.5 * (p[2] - p[1]).norm(), half_height));
    } else {
      text_ += attribute("type", "mesh") + attribute("mesh", simulated_.prefix + mesh) +
               attribute("pos", list_of(0.0, 0.0, middle));
    }
    text_ += "/>\n";
  }

  void write_contacts(double floor_friction) {
    for (std::size_t w = 0; w < model_.wheels().size(); ++w) {
      const std::string wheel = named("wheel", w);
      if (!has_rollers(static_cast<int>(w))) write_rolling(w, wheel, floor_friction);
      for (std::size_t i = 0; has_rollers(static_cast<int>(w)) && i < roller_count; ++i) {
        write_rolling(w, numbered(wheel, i), floor_friction);
      }
    }
    if (has_hull()) {
      text_ += "<pair" + attribute("geom1", "floor") + attribute("geom2", simulated_.prefix + "hull") +
               " condim=\"3\" " + stiff() +
               attribute("friction", list_of(floor_friction, floor_friction, 0.0, 0.0, 0.0)) + "/>\n";
    }
    for (std::size_t c = 0; c < simulated_.skids.size(); ++c) {
      text_ += "<pair" + attribute("geom1", "floor") + attribute("geom2", named("skid", c)) +
               " condim=\"1\" " + stiff() + "/>\n";
    }
  }

  void write_motors() {
    for (int j = 0; j < model_.joint_count(); ++j) {
      if (!model_.joint(j).actuated) continue;
      const auto number = static_cast<std::size_t>(j);
      text_ += "<motor" + attribute("name", named("motor", number));
      if (const RollingSphere* sphere = sphere_of(j + 1)) {
        const Vector3 t = sphere->torque_direction();
        text_ += attribute("jointinparent", named("joint", number)) +
                 attribute("gear", list_of(t.x(), t.y(), t.z(), 0.0, 0.0, 0.0));
      } else {
        text_ += attribute("joint", named("joint", number));
      }
      text_ += "/>\n";
    }
  }

  std::string text() { return std::move(text_); }

 private:
  void write_rolling(std::size_t w, const std::string& geom, double floor_friction) {
    text_ +=
        "<pair" + attribute("geom1", "floor") + attribute("geom2", geom) + " condim=\"3\" " + stiff() +
        attribute("friction", list_of(floor_friction, second_friction(w, floor_friction), 0.0, 0.0, 0.0)) +
        "/>\n";
  }

  /// Of a contact's second direction: none across the only one that a hinged wheel holds. Skidding wheels:
  /// side_friction.hpp.
  double second_friction(std::size_t w, double floor_friction) const {
    const solver::Wheel& wheel = model_.wheels()[w];
    const bool is_hinged = sphere_of(wheel.body) == nullptr && !has_rollers(static_cast<int>(w));
    return is_hinged && wheel.held_directions() == 1 ? no_friction : floor_friction;
  }

  /// The angle about z from a wheel's rolling direction a x z to the first direction that it holds. The axis
  /// a lies a quarter turn ahead, and a roller's axis lies ahead of a by the roller angle.
  static double turn_of_held(const solver::Wheel& wheel) {
    constexpr double quarter = 0.5 * std::numbers::pi;
    if (wheel.roller_angle) return quarter + *wheel.roller_angle;
    return wheel.holds_rolling ? 0.0 : quarter;
  }

  int wheel_of(int body) const {
    for (std::size_t w = 0; w < model_.wheels().size(); ++w) {
      if (model_.wheels()[w].body == body) return static_cast<int>(w);
    }
    return -1;
  }

  const RollingSphere* sphere_of(int body) const {
    for (const RollingSphere& sphere : simulated_.spheres.spheres) {
      if (sphere.body == body) return &sphere;
    }
    return nullptr;
  }

  std::string named(const char* part, std::size_t number) const { return simulated_.named(part, number); }

  const lang::Robot& robot_;
  const Model& model_;
  const SimulatedRobot& simulated_;
  std::string text_;
};

}  // namespace

RobotText write_robot(const SimulatedRobot& simulated, double floor_friction) {
  RobotWriter assets(simulated), body(simulated), contacts(simulated), motors(simulated);
  assets.write_assets();
  body.write_body(0);
  contacts.write_contacts(floor_friction);
  motors.write_motors();
  return {assets.text(), body.text(), contacts.text(), motors.text()};
}

}  // namespace zwang::runtime
