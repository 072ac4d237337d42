#include "mjcf.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

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

constexpr double corner_radius = 1e-6;       ///< [m]
constexpr double contact_half_height = 1.0;  ///< [m] of the upright faces that meet in the bumper's plane
constexpr double max_wheel_lift = 0.002;     ///< [m]
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

/// Base frame pose of a body at q = 0.
Pose pose_in_base(const Model& model, int body) {
  Pose pose;
  for (int i = body; i > 0; i = model.bodies()[static_cast<std::size_t>(i)].parent) {
    pose = model.bodies()[static_cast<std::size_t>(i)].pose_in_parent * pose;
  }
  return pose;
}

double cross2(const Vector3& o, const Vector3& a, const Vector3& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

/// Monotone chain; counter-clockwise, without points on straight stretches.
std::vector<Vector3> convex_hull(std::vector<Vector3> points) {
  for (Vector3& p : points) p.z() = 0.0;
  const auto before = [](const Vector3& a, const Vector3& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  std::vector<Vector3> hull;
  const auto extend = [&hull](const Vector3& p, std::size_t kept) {
    while (hull.size() >= kept + 2 && cross2(hull[hull.size() - 2], hull.back(), p) <= 1e-12) hull.pop_back();
    hull.push_back(p);
  };
  for (const Vector3& p : points) extend(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(*p, lower);
  hull.pop_back();
  if (hull.size() < 3) hull.clear();
  return hull;
}

/// Centres of spheres tangent to both sides of each corner of a convex polygon, from inside.
std::vector<Vector3> corner_centres(const std::vector<Vector3>& polygon) {
  std::vector<Vector3> centres;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3 to_next = (polygon[(i + 1) % n] - polygon[i]).normalized();
    const Vector3 to_last = (polygon[(i + n - 1) % n] - polygon[i]).normalized();
    const Vector3 inward = (to_next + to_last).normalized();
    const double half_angle_sine = std::abs(to_next.cross(inward).z());
    centres.push_back(polygon[i] + corner_radius / half_angle_sine * inward);
  }
  return centres;
}

std::vector<Vector3> rectangle(double half_x, double half_y) {
  return {{-half_x, -half_y, 0.0}, {half_x, -half_y, 0.0}, {half_x, half_y, 0.0}, {-half_x, half_y, 0.0}};
}

bool is_rectangle(const std::vector<Vector3>& p) {
  if (p.size() != 4) return false;
  const Vector3 side = p[1] - p[0];
  const Vector3 next = p[2] - p[1];
  return (p[0] + p[2] - p[1] - p[3]).norm() < 1e-9 &&
         std::abs(side.dot(next)) < 1e-9 * side.norm() * next.norm();
}

/// Where an object stands, and what of it the robot can touch.
struct ObjectGeometry {
  Vector3 centre;  ///< [m] world
  Vector3 half;    ///< [m] half extents of a box; radius, radius, half height of a cylinder
  bool round = false;
};

ObjectGeometry geometry_of(const SceneObject& object) {
  const auto& size = object.size;
  ObjectGeometry g;
  g.round = object.shape == ShapeKind::cylinder;
  Vector3 shift = Vector3::Zero();
  if (object.shape == ShapeKind::wall) {
    g.half = 0.5 * Vector3(size[1], size[0], size[2]);  // the wall's x is its thickness
    shift.x() = g.half.x();                             // `at` lies on the face that looks along -x
  } else if (object.shape == ShapeKind::box) {
    g.half = 0.5 * Vector3(size[0], size[1], size[2]);
  } else {
    g.half = Vector3(size[0], size[0], 0.5 * size[2]);
  }
  if (!(g.half.minCoeff() > 0.0)) refuse("the object `" + object.name + "` has no size");
  const Matrix3 turn = solver::rotation_from_rpy(0.0, 0.0, object.yaw);
  g.centre = Vector3(object.at[0], object.at[1], g.half.z()) + turn * shift;
  return g;
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
    if (wheel >= 0) {
      const auto w = static_cast<std::size_t>(wheel);
      text_ += sphere_geom(numbered("wheel", w), Vector3::Zero(), model_.wheels()[w].radius);
    }
    for (int child = index + 1; child < model_.body_count(); ++child) {
      if (model_.bodies()[static_cast<std::size_t>(child)].parent != index) continue;
      if (sphere != nullptr) refuse("the wheel `" + body.name + "` carries another body");
      write_body(child);
    }
    text_ += "</body>\n";
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
    if (object.mass) {
      if (!(*object.mass > 0.0)) refuse("the mass of `" + object.name + "` is not positive");
      text_ += "<joint" + attribute("name", name + "_x") + " type=\"slide\" axis=\"1 0 0\"/>\n";
      text_ += "<joint" + attribute("name", name + "_y") + " type=\"slide\" axis=\"0 1 0\"/>\n";
      text_ += "<joint" + attribute("name", name + "_turn") + " type=\"hinge\" axis=\"0 0 1\"/>\n";
      text_ += inertial(inertia_of(*object.mass, g));
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
      text_ += "<pair" + attribute("geom1", "floor") + attribute("geom2", numbered("wheel", w)) +
               " condim=\"3\" " + stiff() +
               attribute("friction", list_of(scene_.floor_friction, sideways_friction(w), 0.0, 0.0, 0.0)) +
               "/>\n";
    }
    for (std::size_t c = 0; c < simulated_.skids.size(); ++c) {
      text_ += "<pair" + attribute("geom1", "floor") + attribute("geom2", numbered("skid", c)) +
               " condim=\"1\" " + stiff() + "/>\n";
    }
    for (std::size_t k = 0; k < scene_.objects.size(); ++k) {
      if (!is_met(scene_.objects[k])) continue;
      if (!simulated_.outline.empty()) write_meeting_of_robot(k);
      for (std::size_t other = 0; other < k; ++other) {
        const bool moves = scene_.objects[k].mass || scene_.objects[other].mass;
        if (moves && is_met(scene_.objects[other])) write_meeting(k, other);
      }
    }
    text_ += "</contact>\n";
  }

  /// Of a contact's second direction, across the wheel's rolling. Skidding wheels: side_friction.hpp.
  double sideways_friction(std::size_t w) const {
    const solver::Wheel& wheel = model_.wheels()[w];
    return wheel.roller_angle || wheel.holds_sideways ? scene_.floor_friction : no_friction;
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

/// The ground as the wheels' lowest points have it, on the average; small differences are levelled out.
void level_wheels(const Model& model, SimulatedRobot& simulated) {
  std::vector<double> lowest;
  for (const solver::Wheel& wheel : model.wheels()) {
    if (!wheel.roller_angle && !wheel.holds_rolling) {
      refuse("a wheel that does not hold rolling cannot be simulated");
    }
    lowest.push_back(pose_in_base(model, wheel.body).position.z() - wheel.radius);
  }
  if (lowest.empty()) refuse("a base on the ground needs wheels");
  for (const double z : lowest) simulated.ground += z / static_cast<double>(lowest.size());
  for (const double z : lowest) {
    simulated.wheel_lift.push_back(simulated.ground - z);
    if (std::abs(simulated.ground - z) > max_wheel_lift) {
      refuse("the wheels do not stand on one level: their lowest points differ by millimetres");
    }
  }
}

/// A support stands on the ground straight below its link's origin.
Vector3 point_below(const lang::Robot& robot, const std::string& support) {
  const auto frame = robot.model.find_frame(support);
  if (!frame) refuse("the model has no link `" + support + "` to support the base");
  const solver::Frame& link = robot.model.frames()[static_cast<std::size_t>(*frame)];
  if (link.body != 0) refuse("the support `" + support + "` is not fixed to the base");
  return link.pose_in_body.position;
}

}  // namespace

SimulatedRobot prepare_robot(const lang::Robot& robot) {
  SimulatedRobot simulated;
  simulated.spheres = replace_wheels_by_spheres(robot.model);
  simulated.outline = convex_hull(robot.footprint);
  if (robot.model.base_type() != solver::BaseType::ground) {
    simulated.wheel_lift.assign(robot.model.wheels().size(), 0.0);
    return simulated;
  }
  level_wheels(robot.model, simulated);
  for (const std::string& support : robot.supports) simulated.skids.push_back(point_below(robot, support));
  if (robot.supports.empty() && robot.model.wheels().size() < 3) {
    if (simulated.outline.empty()) refuse("a base on two wheels needs a footprint for its supports");
    simulated.skids = simulated.outline;
  }
  for (Vector3& skid : simulated.skids) skid.z() = simulated.ground;
  return simulated;
}

std::string write_mjcf(const lang::Robot& robot, const SimulatedRobot& simulated, const lang::Scene& scene,
                       double period) {
  return MjcfWriter(robot, simulated, scene).write(period);
}

}  // namespace zwang::runtime
