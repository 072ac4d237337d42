#include "robot/weightless_links.hpp"

#include <Eigen/LU>

namespace zwang::lang {

namespace {

/// Of a link and all that is fixed to it, in the link's frame.
solver::RigidInertia carried_inertia(const Urdf& urdf, const std::string& link) {
  solver::RigidInertia inertia = urdf.find_link(link)->inertia;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.parent != link || joint.joint.type != solver::JointType::fixed) continue;
    inertia = inertia + carried_inertia(urdf, joint.child).expressed_in(joint.origin);
  }
  return inertia;
}

}  // namespace

std::vector<std::string> without_inertia(const Urdf& urdf) {
  std::vector<std::string> names;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.joint.type == solver::JointType::fixed) continue;
    const solver::RigidInertia inertia = carried_inertia(urdf, joint.child);
    bool is_good = inertia.mass > 0.0;
    if (is_good) {
      const solver::Matrix3 at_com = inertia.rotational_at_com();
      is_good = (at_com.diagonal().array() > 0.0).all() && at_com.determinant() > 0.0;
    }
    if (!is_good) names.push_back(joint.child);
  }
  return names;
}

}  // namespace zwang::lang
