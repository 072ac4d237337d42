#include "mjcf.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "object_geometry.hpp"
#include "outline.hpp"

namespace zwang::runtime {

namespace {

using lang::SceneObject;
using lang::ShapeKind;
using solver::Body;
using solver::JointType;
using solver::Matrix3;
using solver::Model;
using solver::Pose;
using solver::RigidInertia;
using solver::Vector3;

constexpr double contact_half_height = 1.0;  ///< [m] of the upright faces that meet in the bumper's plane
constexpr double scripted_mass = 1e6;        ///< [kg] whatever meets it does not move it
constexpr double no_friction = 1e-5;         ///< the least that MuJoCo takes

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("plant: " + what);
}

/// The shortest text that reads back as the same number, whatever the locale.
std::string text_of(double number) {
  if (!std::isfinite(number)) refuse("a number of the robot or the scene is not finite");
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  return {buffer.data(), end};
}

template <typename... Numbers>
std::string list_of(double first, Numbers... rest) {
  std::string text = text_of(first);
  ((text += ' ' + text_of(rest)), ...);
  return text;
}

std::string list_of(const Vector3& v) {
  return list_of(v.x(), v.y(), v.z());
}

std::string attribute(const std::string& name, const std::string& value) {
  return ' ' + name + "=\"" + value + '"';
}

std::string numbered(const char* name, std::size_t number) {
  return std::string(name) + '_' + std::to_string(number);
}

std::string quaternion_of(const Matrix3& rotation) {
  const Eigen::Quaterniond q(rotation);
  return list_of(q.w(), q.x(), q.y(), q.z());
}

std::string inertial(const RigidInertia& inertia) {
  const Vector3 com = inertia.first_moment / inertia.mass;
  const Matrix3 c = solver::skew(com);
  const Matrix3 at_com = inertia.rotational + inertia.mass * c * c;
  return "<inertial" + attribute("pos", list_of(com)) + attribute("mass", text_of(inertia.mass)) +
         attribute("fullinertia", list_of(at_com(0, 0), at_com(1, 1), at_com(2, 2), at_com(0, 1),
                                          at_com(0, 2), at_com(1, 2))) +
         "/>\n";
}

std::string sphere_geom(const std::string& name, const Vector3& at, double radius) {
  return "<geom" + attribute("name", name) + attribute("type", "sphere") + attribute("pos", list_of(at)) +
         attribute("size", text_of(radius)) + "/>\n";
}

class MjcfWriter {
 public:
  MjcfWriter(const lang::Robot& robot, const SimulatedRobot& simulated, const lang::Scene& scene)
      : robot_(robot), model_(robot.model), simulated_(simulated), scene_(scene) {}

  std::string write(double period) {
    text_ = "<mujoco model=\"zwang\">\n";
    text_ += "<compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n";
    text_ +=
        "<option integrator=\"Euler\" solver=\"Newton\" cone=\"elliptic\" impratio=\"10\" "
        "tolerance=\"1e-12\"" +
        attribute("timestep", text_of(period)) + attribute("gravity", list_of(model_.gravity())) + "/>\n";
    text_ += "<size nconmax=\"500\" njmax=\"2000\"/>\n";
    text_ += "<default><geom contype=\"0\" conaffinity=\"0\" condim=\"3\" " + stiff() + "/></default>\n";
    write_assets();
    text_ += "<worldbody>\n";
    text_ += "<geom name=\"floor\" type=\"plane\" size=\"0 0 1\"/>\n";
    write_body(0);
    for (std::size_t k = 0; k < scene_.objects.size(); ++k) write_object(k);
    text_ += "</worldbody>\n";
    write_pairs();
    write_docks();
    write_motors();
    text_ += "</mujoco>\n";
    return std::move(text_);
  }

 private:
  static std::string stiff() { return "solref=\"0.004 1\" solimp=\"0.95 0.99 0.001\""; }

  /// Objects that do not reach the bumper's height are not met.
  bool is_met(const SceneObject& object) const { return object.size[2] >= robot_.bumper_height; }

  void write_assets() {
    if (simulated_.outline.empty() || is_rectangle(simulated_.outline)) return;
    std::string vertices;
    for (const Vector3& p : simulated_.outline) {
      for (const double z : {-contact_half_height, contact_half_height}) {
        vertices += list_of(p.x(), p.y(), z) + ' ';
      }
    }
    text_ += "<asset><mesh name=\"outline\"" + attribute("vertex", vertices) + "/></asset>\n";
  }

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
      const Matrix3 in_base = pose_in_base(model_, body.parent).rotation;
      pose.position +=
          in_base.transpose() * Vector3(0.0, 0.0, simulated_.wheel_lift[static_cast<std::size_t>(wheel)]);
    }
    if (has_rollers(wheel)) inertia = simulated_.rollers[static_cast<std::size_t>(wheel)].hub;
    if (sphere != nullptr) {
      pose.rotation = Matrix3::Identity();
      inertia = RigidInertia::from_com(sphere->mass, Vector3::Zero(), sphere->inertia * Matrix3::Identity());
    }
    const auto number = static_cast<std::size_t>(index);
    text_ += "<body" + attribute("name", numbered("body", number)) +
             attribute("pos", list_of(pose.position)) + attribute("quat", quaternion_of(pose.rotation)) +
             ">\n";
    if (index == 0) {
      if (!model_.has_fixed_base()) text_ += "<freejoint name=\"base\"/>\n";
    } else {
      write_joint(body, number - 1, sphere != nullptr);
    }
    if (inertia.mass > 0.0) text_ += inertial(inertia);
    if (index == 0) write_outline();
    if (has_rollers(wheel)) {
      write_rollers(static_cast<std::size_t>(wheel));
    } else if (wheel >= 0) {
      const auto w = static_cast<std::size_t>(wheel);
      text_ += sphere_geom(numbered("wheel", w), Vector3::Zero(), model_.wheels()[w].radius);
    }
    for (std::size_t t = 0; t < simulated_.tips.size(); ++t) {
      if (simulated_.tips[t].body == index)
        text_ += sphere_geom(numbered("tip", t), simulated_.tips[t].pose_in_body.position, corner_radius);
    }
    for (int child = index + 1; child < model_.body_count(); ++child) {
      if (model_.bodies()[static_cast<std::size_t>(child)].parent != index) continue;
      if (sphere != nullptr) refuse("the wheel `" + body.name + "` carries another body");
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
      const std::string name = numbered(numbered("roller", w).c_str(), i);
      text_ +=
          "<body" + attribute("name", name) + attribute("pos", list_of(rollers[i].pose.position)) +
          attribute("quat", quaternion_of(rollers[i].pose.rotation)) + "><joint" + attribute("name", name) +
          " type=\"hinge\" axis=\"0 0 1\"/>\n" + inertial(rollers[i].inertia) + "<geom" +
          attribute("name", numbered(numbered("wheel", w).c_str(), i)) + " type=\"ellipsoid\"" +
          attribute("size", list_of(rollers[i].radius, rollers[i].radius, rollers[i].half)) + "/></body>\n";
    }
  }

  void write_joint(const Body& body, std::size_t number, bool ball) {
    const std::string name = attribute("name", numbered("joint", number));
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
    const auto corners = corner_centres(simulated_.outline);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      text_ += sphere_geom(numbered("bumper", c), corners[c] + Vector3(0.0, 0.0, plane), corner_radius);
    }
    for (std::size_t c = 0; c < simulated_.skids.size(); ++c) {
      const Vector3 up(0.0, 0.0, corner_radius);
      text_ += sphere_geom(numbered("skid", c), simulated_.skids[c] + up, corner_radius);
    }
    text_ += "<geom name=\"bumper_prism\"";
    if (is_rectangle(simulated_.outline)) {
      const auto& p = simulated_.outline;
      const Vector3 side = p[1] - p[0];
      const Vector3 centre = 0.5 * (p[0] + p[2]) + Vector3(0.0, 0.0, plane);
      text_ += attribute("type", "box") + attribute("pos", list_of(centre)) +
               attribute("euler", list_of(0.0, 0.0, std::atan2(side.y(), side.x()))) +
               attribute("size", list_of(0.5 * side.norm(), 0.5 * (p[2] - p[1]).norm(), contact_half_height));
    } else {
      text_ += attribute("type", "mesh") + attribute("mesh", "outline") +
               attribute("pos", list_of(0.0, 0.0, plane));
    }
    text_ += "/>\n";
  }

  void write_object(std::size_t k) {
    const SceneObject& object = scene_.objects[k];
    const ObjectGeometry g = geometry_of(object);
    const std::string name = numbered("object", k);
    text_ += "<body" + attribute("name", name) + attribute("pos", list_of(g.centre)) +
             attribute("euler", list_of(0.0, 0.0, object.yaw)) + ">\n";
    if (object.mass || !object.motion.empty()) {
      const double mass = object.mass.value_or(scripted_mass);
      if (!(mass > 0.0)) refuse("the mass of `" + object.name + "` is not positive");
      text_ += "<joint" + attribute("name", name + "_x") + " type=\"slide\" axis=\"1 0 0\"/>\n";
      text_ += "<joint" + attribute("name", name + "_y") + " type=\"slide\" axis=\"0 1 0\"/>\n";
      text_ += "<joint" + attribute("name", name + "_turn") + " type=\"hinge\" axis=\"0 0 1\"/>\n";
      text_ += inertial(inertia_of(mass, g));
    }
    if (is_met(object)) write_faces(g, name);
    text_ += "</body>\n";
  }

  /// A round object is met as the sphere that its circle in the bumper's plane belongs to.
  void write_faces(const ObjectGeometry& g, const std::string& name) {
    const Vector3 plane(0.0, 0.0, robot_.bumper_height - g.half.z());
    if (g.round) {
      text_ += sphere_geom(name + "_face", plane, g.half.x());
      return;
    }
    text_ += "<geom" + attribute("name", name + "_face") + attribute("type", "box") +
             attribute("pos", list_of(plane)) +
             attribute("size", list_of(g.half.x(), g.half.y(), contact_half_height)) + "/>\n";
    const auto edges = corner_centres(rectangle(g.half.x(), g.half.y()));
    for (std::size_t c = 0; c < edges.size(); ++c) {
      text_ += sphere_geom(numbered((name + "_edge").c_str(), c), edges[c] + plane, corner_radius);
    }
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
    for (std::size_t w = 0; w < model_.wheels().size(); ++w) {
      const std::string wheel = numbered("wheel", w);
      if (!has_rollers(static_cast<int>(w))) write_rolling(w, wheel);
      for (std::size_t i = 0; has_rollers(static_cast<int>(w)) && i < roller_count; ++i) {
        write_rolling(w, numbered(wheel.c_str(), i));
      }
    }
    for (std::size_t c = 0; c < simulated_.skids.size(); ++c) {
      text_ += "<pair" + attribute("geom1", "floor") + attribute("geom2", numbered("skid", c)) +
               " condim=\"1\" " + stiff() + "/>\n";
    }
    for (std::size_t k = 0; k < scene_.objects.size(); ++k) {
      if (!is_met(scene_.objects[k])) continue;
      if (!simulated_.outline.empty()) write_meeting_of_robot(k);
      for (std::size_t t = 0; t < simulated_.tips.size(); ++t) write_meeting_of_tip(k, t);
      for (std::size_t other = 0; other < k; ++other) {
        if ((moves(k) || moves(other)) && is_met(scene_.objects[other])) write_meeting(k, other);
      }
    }
    text_ += "</contact>\n";
  }

  void write_rolling(std::size_t w, const std::string& geom) {
    text_ += "<pair" + attribute("geom1", "floor") + attribute("geom2", geom) + " condim=\"3\" " + stiff() +
             attribute("friction", list_of(scene_.floor_friction, sideways_friction(w), 0.0, 0.0, 0.0)) +
             "/>\n";
  }

  /// Of a contact's second direction, across the wheel's rolling. Skidding wheels: side_friction.hpp.
  double sideways_friction(std::size_t w) const {
    const solver::Wheel& wheel = model_.wheels()[w];
    return wheel.roller_angle || wheel.holds_sideways ? scene_.floor_friction : no_friction;
  }

  bool moves(std::size_t k) const { return scene_.objects[k].mass || !scene_.objects[k].motion.empty(); }

  /// Ties that hold nothing until the plant puts one in force: the hook's origin to a point of the object.
  void write_docks() {
    text_ += "<equality>\n";
    for (std::size_t k = 0; k < scene_.objects.size(); ++k) {
      if (!scene_.objects[k].dock) continue;
      const solver::Frame& hook = hook_of(model_, scene_.objects[k]);
      text_ += "<connect" + attribute("name", numbered("dock", k)) +
               attribute("body1", numbered("body", static_cast<std::size_t>(hook.body))) +
               attribute("body2", numbered("object", k)) +
               attribute("anchor", list_of(hook.pose_in_body.position)) + " active=\"false\" " + stiff() +
               "/>\n";
    }
    text_ += "</equality>\n";
  }

  void write_meeting_of_robot(std::size_t k) {
    const SceneObject& object = scene_.objects[k];
    const std::string face = numbered("object", k) + "_face";
    if (object.shape == ShapeKind::cylinder) {
      write_spring(face, "bumper_prism", object.friction);
      return;
    }
    for (std::size_t c = 0; c < simulated_.outline.size(); ++c) {
      write_spring(face, numbered("bumper", c), object.friction);
    }
    for (std::size_t c = 0; c < 4; ++c) write_spring(edge_of(k, c), "bumper_prism", object.friction);
  }

  /// A round object is met in the bumper's plane only, where no arm reaches.
  void write_meeting_of_tip(std::size_t k, std::size_t tip) {
    if (scene_.objects[k].shape == ShapeKind::cylinder) return;
    write_spring(numbered("object", k) + "_face", numbered("tip", tip), scene_.objects[k].friction);
  }

  void write_meeting(std::size_t k, std::size_t other) {
    const double friction = std::max(scene_.objects[k].friction, scene_.objects[other].friction);
    const bool k_round = scene_.objects[k].shape == ShapeKind::cylinder;
    const bool other_round = scene_.objects[other].shape == ShapeKind::cylinder;
    const std::string face = numbered("object", k) + "_face";
    const std::string other_face = numbered("object", other) + "_face";
    if (k_round || other_round) {
      write_spring(face, other_face, friction);
      return;
    }
    for (std::size_t c = 0; c < 4; ++c) {
      write_spring(edge_of(k, c), other_face, friction);
      write_spring(edge_of(other, c), face, friction);
    }
  }

  static std::string edge_of(std::size_t k, std::size_t c) {
    return numbered((numbered("object", k) + "_edge").c_str(), c);
  }

  void write_spring(const std::string& one, const std::string& other, double friction) {
    const double d = spring_impedance;
    text_ += "<pair" + attribute("geom1", one) + attribute("geom2", other) +
             attribute("condim", friction > 0.0 ? "3" : "1") + attribute("solimp", list_of(d, d, 0.001)) +
             attribute("friction", list_of(friction, friction, 0.0, 0.0, 0.0)) + "/>\n";
  }

  void write_motors() {
    text_ += "<actuator>\n";
    for (int j = 0; j < model_.joint_count(); ++j) {
      if (!model_.joint(j).actuated) continue;
      const auto number = static_cast<std::size_t>(j);
      text_ += "<motor" + attribute("name", numbered("motor", number));
      if (const RollingSphere* sphere = sphere_of(j + 1)) {
        const Vector3 t = sphere->torque_direction();
        text_ += attribute("jointinparent", numbered("joint", number)) +
                 attribute("gear", list_of(t.x(), t.y(), t.z(), 0.0, 0.0, 0.0));
      } else {
        text_ += attribute("joint", numbered("joint", number));
      }
      text_ += "/>\n";
    }
    text_ += "</actuator>\n";
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

  const lang::Robot& robot_;
  const Model& model_;
  const SimulatedRobot& simulated_;
  const lang::Scene& scene_;
  std::string text_;
};

}  // namespace

std::string write_mjcf(const lang::Robot& robot, const SimulatedRobot& simulated, const lang::Scene& scene,
                       double period) {
  return MjcfWriter(robot, simulated, scene).write(period);
}

}  // namespace zwang::runtime
