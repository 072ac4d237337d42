#include "robot/supports.hpp"

#include <algorithm>
#include <set>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_standing.hpp"

namespace zwang::lang {

namespace {

/// The joint that a link moves about in the base, the nearest one; nullptr where it is fixed to the base.
const UrdfJoint* moving_carrier(const Urdf& urdf, const std::string& base, const std::string& link) {
  std::set<std::string> seen;
  for (const UrdfJoint* above = urdf.joint_above(link);
       above != nullptr && above->child != base && seen.insert(above->child).second;
       above = urdf.joint_above(above->parent)) {
    if (above->joint.type != solver::JointType::fixed) return above;
  }
  return nullptr;
}

wording::SupportOn what_moves(const std::string& support, const UrdfJoint& carrier, const RobotFile& file,
                              const Urdf& urdf) {
  for (const WheelText& wheel : file.wheels) {
    const UrdfJoint* joint = urdf.find_joint(wheel.joint.text);
    if (joint == nullptr || joint == &carrier) continue;
    if (moving_carrier(urdf, file.base.text, joint->parent) == &carrier)
      return wording::SupportOn::steered_link;
  }
  const UrdfLink* link = urdf.find_link(support);
  const bool is_ball = link != nullptr && link->radius && !link->cylinder_axis;
  return is_ball ? wording::SupportOn::ball : wording::SupportOn::caster_wheel;
}

}  // namespace

void check_supports(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics) {
  for (const Word& support : file.supports) {
    if (support.exists() && urdf.find_link(support.text) == nullptr)
      diagnostics.add(wording::unknown_name(support.span, "link", support.text, urdf.link_names()));
    if (const UrdfJoint* carrier = moving_carrier(urdf, file.base.text, support.text))
      diagnostics.add(wording::moving_support(support.span, support.text, carrier->joint.name,
                                              what_moves(support.text, *carrier, file, urdf), carrier->span));
  }
}

std::vector<SupportFrame> support_frames(const RobotFile& file, const Urdf& urdf) {
  constexpr double rounding = 1e-6;  // [m] of places in a file
  std::vector<SupportFrame> frames;
  std::set<std::string> seen;
  for (const Word& support : file.supports) {
    const UrdfLink* link = urdf.find_link(support.text);
    if (link == nullptr || !seen.insert(link->name).second) continue;
    SupportFrame frame{link->name, link->name};
    // Some files draw all parts in the base's own frame: a mesh stands where its mass is.
    const double mass = link->inertia.mass;
    const solver::Vector3 middle = link->radius ? link->round_at
                                   : mass > 0.0 ? solver::Vector3(link->inertia.first_moment / mass)
                                                : solver::Vector3::Zero();
    if (middle.norm() > rounding) {
      frame.name = link->name + " ball";  // no name that a file could use
      frame.at = middle;
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace zwang::lang
