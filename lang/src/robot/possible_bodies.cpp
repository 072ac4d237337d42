#include "robot/possible_bodies.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <set>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_standing.hpp"

namespace zwang::lang {

namespace {

bool is_fixed(const UrdfJoint& joint) {
  return joint.joint.type == solver::JointType::fixed;
}

/// Links that move as one, and their inertia in the frame of the first.
struct Lump {
  solver::RigidInertia inertia;
  std::vector<const UrdfLink*> links;
};

/// `from`: the joint on the way here.
Lump lump_of(const Urdf& urdf, const std::string& link, const UrdfJoint* from = nullptr) {
  const UrdfLink& own = *urdf.find_link(link);
  Lump lump{own.inertia, {&own}};
  const auto add = [&](const std::string& next, const UrdfJoint& joint, const solver::Pose& pose) {
    const Lump other = lump_of(urdf, next, &joint);
    lump.inertia = lump.inertia + other.inertia.expressed_in(pose);
    lump.links.insert(lump.links.end(), other.links.begin(), other.links.end());
  };
  for (const UrdfJoint& joint : urdf.joints) {
    if (&joint == from || !is_fixed(joint)) continue;
    if (joint.parent == link) add(joint.child, joint, joint.origin);
    if (joint.child == link) add(joint.parent, joint, joint.origin.inverse());
  }
  return lump;
}

solver::Vector3 moments_of(const solver::RigidInertia& inertia) {
  return Eigen::SelfAdjointEigenSolver<solver::Matrix3>(inertia.rotational_at_com()).eigenvalues();
}

/// No moment of a body is larger than the sum of the other two.
bool keeps_triangle_rule(const solver::RigidInertia& inertia) {
  if (!(inertia.mass > 0.0)) return true;  // what it is fixed to may have the mass
  const solver::Vector3 moments = moments_of(inertia);
  return moments(0) + moments(1) >= moments(2) - 1e-6 * moments.cwiseAbs().maxCoeff();
}

/// Why no model can move it, as the solver says it of the part; empty: one can.
std::string why_impossible(const solver::RigidInertia& inertia, const std::string& part) {
  if (!(inertia.mass > 0.0)) return "the mass of `" + part + "` is not positive";
  if (moments_of(inertia).minCoeff() <= 0.0) return "the inertia of `" + part + "` is not positive definite";
  if (!keeps_triangle_rule(inertia))
    return "the inertia of `" + part + "` breaks the triangle rule: no body can have it";
  return "";
}

/// The base, and links below joints that move, which are not above the base.
std::vector<std::string> first_links(const Urdf& urdf, const std::string& base) {
  std::set<std::string> above;
  for (const UrdfJoint* joint = urdf.joint_above(base); joint != nullptr;
       joint = urdf.joint_above(joint->parent)) {
    if (!above.insert(joint->child).second) break;
  }
  std::vector<std::string> links{base};
  for (const UrdfJoint& joint : urdf.joints) {
    if (!is_fixed(joint) && !above.contains(joint.child)) links.push_back(joint.child);
  }
  return links;
}

/// How the robot file gives the link an inertia: as a disc where it is a wheel, else as a ball.
wording::InertiaEntry entry_for(const RobotFile& file, const Urdf& urdf, const UrdfLink& link) {
  const UrdfJoint* above = urdf.joint_above(link.name);
  const bool is_wheel =
      above != nullptr && std::any_of(file.wheels.begin(), file.wheels.end(), [&](const WheelText& wheel) {
        return wheel.joint.text == above->joint.name;
      });
  return {link.name, !(link.inertia.mass > 0.0), !is_wheel};
}

/// [m^3] Of the box around what collides; 0: a mesh, or nothing.
double box_volume(const UrdfLink& link) {
  if (link.corners.empty()) return 0.0;
  solver::Vector3 low = link.corners.front(), high = low;
  for (const solver::Vector3& corner : link.corners) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
  return (high - low).prod();
}

/// [kg/m^3] Packing foam. An empty box of 1 mm aluminium, .6 m x .4 m x .3 m, has twice that.
constexpr double foam = 20.0;

/// m < foam V, of all masses that may be the body's. A part that collides and is less than half as large each
/// way, an eighth of V, has its mass for itself.
bool is_lighter_than_foam(const std::vector<const UrdfLink*>& links, double volume) {
  double mass = 0.0;
  for (const UrdfLink* link : links) {
    const double own = box_volume(*link);
    if (own == 0.0 || own > volume / 8.0) mass += link->inertia.mass;
  }
  return mass < foam * volume;
}

}  // namespace

std::optional<BareBody> find_bare_body(const Urdf& urdf, const std::string& base,
                                       const std::vector<std::string>& wheels) {
  const Lump lump = lump_of(urdf, base);
  const double all = lump.inertia.mass;
  if (!(all > 0.0)) return std::nullopt;  // an impossible body
  const UrdfLink& largest =
      **std::ranges::max_element(lump.links, {}, [](const UrdfLink* link) { return box_volume(*link); });
  if (!(largest.inertia.mass > 0.0) && is_lighter_than_foam(lump.links, box_volume(largest)))
    return BareBody{largest.name, all};
  // A mesh has no size here. No robot is built lighter than the wheels that carry it.
  const auto mesh =
      std::ranges::find_if(lump.links, [](const UrdfLink* link) { return !link->mesh.empty(); });
  if (mesh == lump.links.end() || (*mesh)->inertia.mass > 0.0) return std::nullopt;
  double rolling = 0.0;
  for (const std::string& wheel : wheels) rolling += urdf.find_link(wheel)->inertia.mass;
  if (!(all < rolling)) return std::nullopt;
  return BareBody{(*mesh)->name, all};
}

std::vector<std::string> without_inertia(const Urdf& urdf) {
  std::vector<std::string> names;
  for (const UrdfJoint& joint : urdf.joints) {
    if (is_fixed(joint)) continue;
    const solver::RigidInertia inertia = lump_of(urdf, joint.child).inertia;
    bool is_good = inertia.mass > 0.0;
    if (is_good) {
      const solver::Matrix3 at_com = inertia.rotational_at_com();
      is_good = (at_com.diagonal().array() > 0.0).all() && at_com.determinant() > 0.0;
    }
    if (!is_good) names.push_back(joint.child);
  }
  return names;
}

std::vector<ImpossibleBody> impossible_bodies(const Urdf& urdf, const std::string& base) {
  std::vector<ImpossibleBody> bodies;
  for (const std::string& link : first_links(urdf, base)) {
    const Lump lump = lump_of(urdf, link);
    if (why_impossible(lump.inertia, link).empty()) continue;
    ImpossibleBody body{link, "", {}};
    for (const UrdfLink* part : lump.links) {
      if (!keeps_triangle_rule(part->inertia)) body.parts.push_back(part->name);
    }
    if (body.parts.empty() || !(lump.inertia.mass > 0.0)) body.parts = {link};
    body.reason = why_impossible(lump.inertia, body.parts.front());
    bodies.push_back(std::move(body));
  }
  return bodies;
}

void check_bodies(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics) {
  for (const ImpossibleBody& body : impossible_bodies(urdf, file.base.text)) {
    for (const std::string& part : body.parts) {
      const UrdfLink& link = *urdf.find_link(part);
      const bool is_first = &part == &body.parts.front();
      const std::string reason = is_first ? body.reason : why_impossible(link.inertia, part);
      diagnostics.add(wording::impossible_body(link.span, reason, entry_for(file, urdf, link)));
    }
  }
}

}  // namespace zwang::lang
