#include "robot/urdf.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <set>

#include "diagnostic/wordings.hpp"
#include "robot/possible_inertia.hpp"
#include "robot/turned_joints.hpp"
#include "robot/urdf_check.hpp"
#include "robot/urdf_excerpt.hpp"
#include "robot/xml_numbers.hpp"
#include "robot/xml_scan.hpp"
#include "tree/file.hpp"

namespace zwang::lang {

namespace {

/// Catches what urdfdom would print: it turns a bad part into a default with nothing but a line on stderr.
class MessageTrap final : public console_bridge::OutputHandler {
 public:
  MessageTrap() : level_(console_bridge::getLogLevel()) {
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_WARN);
    console_bridge::useOutputHandler(this);
  }
  ~MessageTrap() override {
    console_bridge::restorePreviousOutputHandler();
    console_bridge::setLogLevel(level_);
  }
  MessageTrap(const MessageTrap&) = delete;
  MessageTrap& operator=(const MessageTrap&) = delete;

  void log(const std::string& text, console_bridge::LogLevel, const char*, int) override {
    if (first_.empty()) first_ = text.empty() ? "unknown" : text;
  }
  const std::string& first() const { return first_; }

 private:
  console_bridge::LogLevel level_;
  std::string first_;
};

solver::Pose to_pose(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return {Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix(),
          {pose.position.x, pose.position.y, pose.position.z}};
}

solver::RigidInertia to_inertia(const urdf::Inertial& inertial, bool is_point_mass) {
  solver::Matrix3 m;
  m << inertial.ixx, inertial.ixy, inertial.ixz, inertial.ixy, inertial.iyy, inertial.iyz, inertial.ixz,
      inertial.iyz, inertial.izz;
  const solver::Pose pose = to_pose(inertial.origin);
  if (is_point_mass) m.setZero();
  const solver::Matrix3 turned = pose.rotation * m * pose.rotation.transpose();
  return solver::RigidInertia::from_com(inertial.mass, pose.position, turned);
}

solver::JointType to_type(int type) {
  switch (type) {
    case urdf::Joint::REVOLUTE:
      return solver::JointType::revolute;
    case urdf::Joint::CONTINUOUS:
      return solver::JointType::continuous;
    case urdf::Joint::PRISMATIC:
      return solver::JointType::prismatic;
    default:
      return solver::JointType::fixed;
  }
}

/// Simulators' files give wheels that are `revolute` limits of 1e16 rad; nothing that stops turns more than
/// 100 times.
constexpr double without_end = 200.0 * std::numbers::pi;  // [rad]

UrdfJoint to_joint(const urdf::Joint& joint) {
  UrdfJoint result;
  result.parent = joint.parent_link_name;
  result.child = joint.child_link_name;
  result.origin = to_pose(joint.parent_to_joint_origin_transform);
  result.joint.name = joint.name;
  result.joint.type = to_type(joint.type);
  if (result.joint.type == solver::JointType::fixed) return result;
  result.joint.axis = solver::Vector3(joint.axis.x, joint.axis.y, joint.axis.z).normalized();
  if (joint.dynamics) {
    result.coulomb = joint.dynamics->friction;
    result.viscous = joint.dynamics->damping;
  }
  if (joint.limits) {
    // 0 is how URDFs say that they do not know.
    if (joint.limits->effort > 0.0) result.joint.max_effort = joint.limits->effort;
    if (joint.limits->velocity > 0.0) result.joint.max_velocity = joint.limits->velocity;
    const auto [lower, upper] = std::minmax(joint.limits->lower, joint.limits->upper);
    const bool turns = result.joint.type == solver::JointType::revolute;
    if (turns && lower < -without_end && upper > without_end)
      result.joint.type = solver::JointType::continuous;
    if (result.joint.type != solver::JointType::continuous) {
      result.joint.lower = lower;
      result.joint.upper = upper;
    }
  }
  return result;
}

/// The radius of a shape that could roll.
std::optional<double> radius_of(const urdf::GeometrySharedPtr& geometry) {
  if (const auto cylinder = std::dynamic_pointer_cast<urdf::Cylinder>(geometry)) return cylinder->radius;
  if (const auto sphere = std::dynamic_pointer_cast<urdf::Sphere>(geometry)) return sphere->radius;
  return std::nullopt;
}

/// Its largest round shape; a URDF's cylinder stands along its own z.
template <typename Shapes>
void find_round_shape(const Shapes& shapes, UrdfLink& link) {
  for (const auto& shape : shapes) {
    const std::optional<double> radius = shape ? radius_of(shape->geometry) : std::nullopt;
    if (!radius || !(*radius > link.radius.value_or(0.0))) continue;
    link.radius = radius;
    link.round_at = to_pose(shape->origin).position;
    link.cylinder_axis.reset();
    if (std::dynamic_pointer_cast<urdf::Cylinder>(shape->geometry))
      link.cylinder_axis = to_pose(shape->origin).rotation.col(2);
  }
}

/// Corners of a shape that stands on the floor or hangs above it: of a box all, of round ones a circle's.
void add_corners(const urdf::Geometry& geometry, const solver::Pose& pose,
                 std::vector<solver::Vector3>& corners) {
  if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry)) {
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        for (const double z : {-0.5, 0.5})
          corners.push_back(pose * solver::Vector3(x * box->dim.x, y * box->dim.y, z * box->dim.z));
      }
    }
    return;
  }
  const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry);
  const auto* sphere = dynamic_cast<const urdf::Sphere*>(&geometry);
  if (cylinder == nullptr && sphere == nullptr) return;
  constexpr int sides = 16;
  const double outside = 1.0 / std::cos(std::numbers::pi / sides);  // the circle lies inside
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    const solver::Vector3 round = outside * solver::Vector3(std::cos(angle), std::sin(angle), 0.0);
    if (sphere != nullptr) corners.push_back(pose.position + sphere->radius * round);
    if (cylinder == nullptr) continue;
    for (const double z : {-0.5, 0.5})
      corners.push_back(pose * (cylinder->radius * round + solver::Vector3(0.0, 0.0, z * cylinder->length)));
  }
}

Span span_of(const std::vector<XmlElement>& elements, std::string_view kind, const std::string& name) {
  for (const XmlElement& element : elements) {
    const XmlAttribute* attribute = element.find("name");
    if (element.parent == 0 && element.name == kind && attribute != nullptr && attribute->value == name) {
      return element.span;
    }
  }
  return elements[0].span;
}

/// Of each element that has one, by its index.
std::map<int, UrdfMimic> find_mimics(const std::vector<XmlElement>& elements) {
  std::map<int, UrdfMimic> mimics;
  for (const XmlElement& element : elements) {
    if (element.name != "mimic") continue;
    const XmlAttribute* joint = element.find("joint");
    const XmlAttribute* factor = element.find("multiplier");
    const auto numbers = factor != nullptr ? read_numbers(factor->value, 1) : std::nullopt;
    mimics.try_emplace(element.parent, UrdfMimic{joint != nullptr ? joint->value : "",
                                                 numbers ? numbers->front() : 1.0, element.span});
  }
  return mimics;
}

/// By the index of its joint; of 0 0 0 the unit vector is 0.
std::map<int, solver::Vector3> find_axes(const std::vector<XmlElement>& elements) {
  std::map<int, solver::Vector3> axes;
  for (const XmlElement& element : elements) {
    const XmlAttribute* xyz = element.name == "axis" ? element.find("xyz") : nullptr;
    if (xyz == nullptr) continue;
    const auto numbers = read_numbers(xyz->value, 3);
    const solver::Vector3 axis =
        numbers ? solver::Vector3(numbers->at(0), numbers->at(1), numbers->at(2)) : solver::Vector3::Zero();
    axes.try_emplace(element.parent, axis.norm() > 0.0 ? axis.normalized() : solver::Vector3::Zero());
  }
  return axes;
}

/// The joints that motors are said to turn.
std::set<std::string> find_transmissions(const std::vector<XmlElement>& elements) {
  std::set<std::string> joints;
  for (const XmlElement& element : elements) {
    const XmlAttribute* name = element.find("name");
    if (element.name != "joint" || element.parent <= 0 || name == nullptr) continue;
    const std::string& parent = elements[static_cast<std::size_t>(element.parent)].name;
    if (parent == "transmission" || parent == "ros2_control") joints.insert(name->value);
  }
  return joints;
}

/// Links at the ends of each <joint> that stands in a <gazebo>, with the ends as text.
std::set<std::string> find_loops(const std::vector<XmlElement>& elements) {
  const auto parent_of = [&](const XmlElement& element) {
    return element.parent > 0 ? &elements[static_cast<std::size_t>(element.parent)] : nullptr;
  };
  std::set<std::string> links;
  for (const XmlElement& element : elements) {
    const XmlElement* joint = parent_of(element);
    const bool is_end = element.name == "parent" || element.name == "child";
    if (!is_end || element.text.empty() || joint == nullptr || joint->name != "joint") continue;
    const XmlElement* above = parent_of(*joint);
    if (above != nullptr && above->name == "gazebo") links.insert(element.text);
  }
  return links;
}

/// By link, the file and the scale of the first mesh that it shows. A mirrored mesh is as large.
std::map<std::string, std::string> find_meshes(const std::vector<XmlElement>& elements) {
  std::map<std::string, std::string> meshes;
  for (const XmlElement& element : elements) {
    const XmlAttribute* file = element.name == "mesh" ? element.find("filename") : nullptr;
    if (file == nullptr) continue;
    const XmlElement* above = &element;
    while (above->name != "link" && above->parent > 0)
      above = &elements[static_cast<std::size_t>(above->parent)];
    const XmlAttribute* link = above->name == "link" ? above->find("name") : nullptr;
    if (link == nullptr) continue;
    const XmlAttribute* scale = element.find("scale");
    std::string text = scale == nullptr ? "1 1 1" : scale->value;
    std::erase(text, '-');
    meshes.emplace(link->value, file->value + " " + text);
  }
  return meshes;
}

/// Of links that move by themselves; what is fixed to another is judged with it.
void correct_inertias(Urdf& urdf, Diagnostics& diagnostics) {
  for (UrdfLink& link : urdf.links) {
    const UrdfJoint* above = urdf.joint_above(link.name);
    if (above == nullptr || above->joint.type == solver::JointType::fixed) continue;
    const std::optional<CorrectedInertia> possible = corrected(link.inertia);
    if (!possible) continue;
    link.inertia = possible->inertia;
    diagnostics.add(wording::corrected_inertia(link.span, link.name, possible->share));
  }
}

template <typename Items, typename Match>
auto find_in(Items& items, const Match& match) -> decltype(items.data()) {
  const auto it = std::find_if(items.begin(), items.end(), match);
  return it == items.end() ? nullptr : &*it;
}

void read_links(const urdf::ModelInterface& model, const std::vector<XmlElement>& elements,
                const UrdfFindings& findings, Urdf& urdf) {
  const std::map<std::string, std::string> meshes = find_meshes(elements);
  for (const auto& [name, link] : model.links_) {
    UrdfLink result;
    result.name = name;
    result.span = span_of(elements, "link", name);
    for (const auto& shape : link->collision_array) {
      if (shape && shape->geometry) add_corners(*shape->geometry, to_pose(shape->origin), result.corners);
    }
    find_round_shape(link->collision_array, result);
    if (!result.radius) find_round_shape(link->visual_array, result);
    if (const auto mesh = meshes.find(name); mesh != meshes.end()) result.mesh = mesh->second;
    if (link->inertial && !findings.weightless.contains(name))
      result.inertia = to_inertia(*link->inertial, findings.point_masses.contains(name));
    urdf.links.push_back(std::move(result));
  }
}

/// In the order of the text, which is the author's order of joints.
void read_joints(const urdf::ModelInterface& model, const std::vector<XmlElement>& elements,
                 const std::vector<std::string>& turned, Urdf& urdf) {
  std::set<std::string> done;
  const std::map<int, UrdfMimic> mimics = find_mimics(elements);
  const std::set<std::string> driven = find_transmissions(elements);
  const std::map<int, solver::Vector3> axes = find_axes(elements);
  for (const XmlElement& element : elements) {
    if (element.parent != 0 || element.name != "joint") continue;
    const auto joint = model.joints_.find(element.find("name")->value);
    if (joint == model.joints_.end() || !done.insert(joint->first).second) continue;
    urdf.joints.push_back(to_joint(*joint->second));
    urdf.above.emplace(urdf.joints.back().child, urdf.joints.size() - 1);
    urdf.joints.back().span = element.span;
    urdf.joints.back().has_transmission = driven.contains(joint->first);
    const int index = static_cast<int>(&element - elements.data());
    urdf.joints.back().is_turned = std::find(turned.begin(), turned.end(), joint->first) != turned.end();
    const auto axis = axes.find(index);
    urdf.joints.back().has_axis = axis != axes.end();
    if (axis != axes.end()) urdf.joints.back().drawn_axis = axis->second;
    const auto mimic = mimics.find(index);
    if (mimic != mimics.end()) urdf.joints.back().mimic = mimic->second;
  }
}

}  // namespace

const UrdfLink* Urdf::find_link(const std::string& link) const {
  return find_in(links, [&](const UrdfLink& l) { return l.name == link; });
}

const UrdfJoint* Urdf::find_joint(const std::string& joint) const {
  return find_in(joints, [&](const UrdfJoint& j) { return j.joint.name == joint; });
}

UrdfJoint* Urdf::find_joint(const std::string& joint) {
  return find_in(joints, [&](const UrdfJoint& j) { return j.joint.name == joint; });
}

const UrdfJoint* Urdf::joint_above(const std::string& link) const {
  const auto place = above.find(link);
  return place == above.end() ? nullptr : &joints[place->second];
}

std::vector<std::string> Urdf::link_names() const {
  std::vector<std::string> names;
  for (const UrdfLink& link : links) names.push_back(link.name);
  return names;
}

std::vector<std::string> Urdf::joint_names() const {
  std::vector<std::string> names;
  for (const UrdfJoint& joint : joints) names.push_back(joint.joint.name);
  return names;
}

double Urdf::mass() const {
  double sum = 0.0;
  for (const UrdfLink& link : links) sum += link.inertia.mass;
  return sum;
}

bool Urdf::is_negligible(const UrdfLink& link) const {
  return !(link.inertia.mass > negligible_share * mass());
}

std::optional<Urdf> read_urdf(const std::filesystem::path& path, const Span& cause, Diagnostics& diagnostics,
                              const UrdfChanges& changes) {
  const std::optional<int> source = read_file(path, urdf_size_limit, cause, diagnostics);
  if (!source) return std::nullopt;
  return read_urdf(*source, diagnostics, changes);
}

std::optional<Urdf> read_urdf(int source, Diagnostics& diagnostics, const UrdfChanges& changes) {
  auto elements = scan_xml(source, diagnostics);
  if (!elements) return std::nullopt;
  LeftOut left_out = leave_out(changes.ignored, *elements);
  let_turn(changes.turning, *elements);
  AboveBase above_base = drop_above_base(*elements);
  const std::optional<UrdfFindings> findings = check_urdf(*elements, diagnostics);
  if (!findings) return std::nullopt;

  urdf::ModelInterfaceSharedPtr model;
  std::string message;
  {
    static std::mutex one_trap;  // console_bridge's handler is the process's
    const std::lock_guard lock(one_trap);
    const MessageTrap trap;
    model = urdf::parseURDF(urdf_excerpt(*elements));
    message = trap.first();
  }
  if (!model || !message.empty()) {
    diagnostics.add(wording::urdf_refused((*elements)[0].span, message));
    return std::nullopt;
  }

  Urdf urdf;
  urdf.left_out = std::move(left_out);
  urdf.above_base = std::move(above_base);
  urdf.looped = find_loops(*elements);
  urdf.name = model->getName();
  urdf.root = model->getRoot()->name;
  read_links(*model, *elements, *findings, urdf);
  read_joints(*model, *elements, changes.turning, urdf);
  correct_inertias(urdf, diagnostics);
  return urdf;
}

}  // namespace zwang::lang
