#include "robot/draft_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "robot/adapt_urdf.hpp"
#include "robot/draft_entries.hpp"
#include "robot/placed_urdf.hpp"
#include "robot/possible_bodies.hpp"
#include "robot/possible_inertia.hpp"

namespace zwang::lang {

namespace {

bool is_listed(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A solid ball of the radius r has 2/5 m r^2 about each axis. A box of the sides a, b, c has in the mean
///   m (a^2 + b^2 + c^2) / 18.
double ball_like_box(const solver::Vector3& sides) {
  return sides.norm() / std::sqrt(0.4 * 18.0);
}

class DraftBodies {
 public:
  DraftBodies(const Urdf& urdf, const FoundWheels& found, const std::vector<Eigen::Vector2d>& outline)
      : urdf_(urdf), found_(found), outline_(outline) {
    for (const auto* some : {&found.wheels, &found.idle, &found.casters})
      wheels_.insert(wheels_.end(), some->begin(), some->end());
  }

  std::vector<DraftBody> find(const std::vector<std::string>& open, const std::vector<std::string>& held) {
    for (const std::string& link : open) {
      if (!is_listed(held, urdf_.joint_above(link)->joint.name)) add(link);
    }
    for (const DraftWheel& wheel : wheels_) {
      if (is_beyond_rim(wheel) || is_out_of_balance(wheel)) add(wheel.link);
      if (!wheel.swivel.empty() && is_beyond_reach(wheel)) add(urdf_.find_joint(wheel.swivel)->child);
    }
    Urdf standing = urdf_;
    for (UrdfJoint& joint : standing.joints) {
      if (is_listed(held, joint.joint.name)) hold(joint);
    }
    const auto bare = bare_body(standing);
    if (bare) add(bare->link), bodies_.back().beside = bare->beside;
    for (const ImpossibleBody& body : impossible_bodies(standing, found_.base)) {
      if (bare && body.parts.front() == found_.base) continue;  // possible with that mass
      for (const std::string& part : body.parts) add(part);
    }
    for (DraftBody& body : bodies_) {
      if (body.link == found_.base && body.lacks_mass && body.beside == 0.0) body.at = middle_of_feet();
    }
    return std::move(bodies_);
  }

 private:
  std::optional<BareBody> bare_body(const Urdf& standing) const {
    std::vector<std::string> links;
    for (const DraftWheel& wheel : wheels_) links.push_back(wheel.link);
    return find_bare_body(standing, found_.base, links);
  }

  void add(const std::string& link) {
    const auto is_it = [&](const DraftBody& body) { return body.link == link; };
    if (std::any_of(bodies_.begin(), bodies_.end(), is_it)) return;
    const bool is_wheel = std::any_of(wheels_.begin(), wheels_.end(),
                                      [&](const DraftWheel& wheel) { return wheel.link == link; });
    const UrdfLink& drawn = *urdf_.find_link(link);
    bodies_.push_back({link, !(drawn.inertia.mass > 0.0), is_wheel ? 0.0 : ball_radius(drawn),
                       link == found_.base ? std::optional(0.0) : std::nullopt, std::nullopt});
  }

  /// Where a mass of unknown place is carried best: in the middle of what stands on the ground, at the height
  /// of the axles. Above an axle with two wheels the base would fall over. nullopt: it is the link's origin.
  std::optional<solver::Vector3> middle_of_feet() const {
    const PlacedUrdf placed(urdf_, found_.base);
    std::vector<solver::Vector3> feet;
    for (const DraftWheel& wheel : wheels_) feet.emplace_back(wheel.at[0], wheel.at[1], wheel.at[2]);
    const double height = feet.empty() ? 0.0 : feet.front().z();
    for (const std::string& support : found_.supports) feet.push_back(placed.pose_of(support).position);
    solver::Vector3 middle = solver::Vector3::Zero();
    for (const solver::Vector3& foot : feet) middle += foot / static_cast<double>(feet.size());
    constexpr double nearly = 0.01;  // [m]
    if (middle.head<2>().norm() < nearly) return std::nullopt;
    constexpr double millimetre = 1e-3;
    return solver::Vector3((Eigen::Vector3d(middle.x(), middle.y(), height) / millimetre).array().round()) *
           millimetre;
  }

  double moment_about(const std::string& joint, const UrdfLink& link) const {
    const solver::Vector3& axis = urdf_.find_joint(joint)->joint.axis;
    return axis.dot(link.inertia.rotational * axis);
  }

  /// I > m r^2 about the axle: more than all of its mass has on its rim. No wheel here is larger than 0.3 m.
  bool is_beyond_rim(const DraftWheel& wheel) const {
    const UrdfLink& link = *urdf_.find_link(wheel.link);
    const double radius = wheel.radius.value_or(0.3);
    return moment_about(wheel.joint, link) > link.inertia.mass * radius * radius;
  }

  bool is_out_of_balance(const DraftWheel& wheel) const {
    const solver::RigidInertia& inertia = urdf_.find_link(wheel.link)->inertia;
    const double beside = beside_axis(inertia, urdf_.find_joint(wheel.joint)->joint.axis);
    return inertia.mass * beside > most_imbalance * urdf_.mass() * wheel.radius.value_or(0.3);
  }

  static double reach_of(const DraftWheel& wheel) { return wheel.trail + wheel.radius.value_or(0.3); }

  bool is_beyond_reach(const DraftWheel& wheel) const {
    const UrdfLink& link = *urdf_.find_link(urdf_.find_joint(wheel.swivel)->child);
    const double reach = swivel_reaches * reach_of(wheel);
    return moment_about(wheel.swivel, link) > link.inertia.mass * reach * reach;
  }

  /// Of what is drawn of the link; of the outline, where the base is a mesh; else that of a hand.
  double ball_radius(const UrdfLink& link) const {
    if (!link.corners.empty()) {
      solver::Vector3 low = link.corners.front(), high = low;
      for (const solver::Vector3& corner : link.corners)
        low = low.cwiseMin(corner), high = high.cwiseMax(corner);
      return ball_like_box(high - low);
    }
    if (link.radius) return *link.radius;
    if (link.name == found_.base && !outline_.empty()) {
      Eigen::Vector2d low = outline_.front(), high = low;
      for (const Eigen::Vector2d& corner : outline_) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
      return ball_like_box({high.x() - low.x(), high.y() - low.y(), 0.0});
    }
    for (const DraftWheel& wheel : wheels_) {
      if (!wheel.swivel.empty() && wheel.radius && urdf_.find_joint(wheel.swivel)->child == link.name)
        return reach_of(wheel);
    }
    return 0.05;
  }

  const Urdf& urdf_;
  const FoundWheels& found_;
  const std::vector<Eigen::Vector2d>& outline_;
  std::vector<DraftWheel> wheels_;
  std::vector<DraftBody> bodies_;
};

}  // namespace

std::vector<DraftBody> find_draft_bodies(const Urdf& urdf, const FoundWheels& found,
                                         const std::vector<std::string>& open,
                                         const std::vector<std::string>& held,
                                         const std::vector<Eigen::Vector2d>& outline) {
  return DraftBodies(urdf, found, outline).find(open, held);
}

bool share_mass(std::vector<DraftBody>& bodies, const std::vector<DraftWheel>& wheels) {
  const auto is_of_wheel = [&](const DraftBody& body) {
    return body.lacks_mass && std::any_of(wheels.begin(), wheels.end(),
                                          [&](const DraftWheel& wheel) { return wheel.link == body.link; });
  };
  const auto count = std::count_if(bodies.begin(), bodies.end(), is_of_wheel);
  if (count < 2 || static_cast<std::size_t>(count) != wheels.size()) return false;
  for (DraftBody& body : bodies) body.lacks_mass = body.lacks_mass && !is_of_wheel(body);
  return true;
}

bool lacks_body(const std::vector<DraftBody>& bodies) {
  return std::ranges::any_of(bodies, [](const DraftBody& body) { return body.lacks_mass && body.beside; });
}

std::vector<std::string> missing_of_bodies(const std::vector<DraftBody>& bodies) {
  std::vector<std::string> lines;
  for (const DraftBody& body : bodies) {
    if (body.lacks_mass && body.beside.value_or(0.0) > 0.0)
      lines.push_back("the mass of `" + body.link + "`, the body of the base: what is fixed to it weighs " +
                      wording::figure(*body.beside, "kg"));
  }
  std::string links;
  for (const DraftBody& body : bodies) links += (links.empty() ? "`" : ", `") + body.link + "`";
  if (!links.empty()) lines.push_back("inertias that a body can have, of links that move: " + links);
  return lines;
}

std::string inertias_entry(const std::vector<DraftBody>& bodies, const std::string& base_mass,
                           const std::string& mass) {
  if (bodies.empty()) return "";
  std::string text =
      "\n# Links to which the URDF gives no inertia, or one that no body has: a wheel counts as a solid "
      "disc,\n"
      "# another link as a solid ball. Without `mass` the URDF's, without `radius` the wheel's.\n";
  if (std::ranges::any_of(bodies, [](const DraftBody& body) { return body.at.has_value(); }))
    text +=
        "# at: where the mass lies, in the link's axes. Proposed: the middle between wheels and supports; "
        "the "
        "robot\n# balances there.\n";
  text += "inertias:\n";
  for (const DraftBody& body : bodies) {
    std::string keys;
    if (body.lacks_mass) keys = "mass: " + (body.beside ? base_mass : mass);
    if (body.radius > 0.0)
      keys += (keys.empty() ? "" : ", ") + std::string("radius: ") +
              in_millimetres(std::ceil(body.radius * 1e3) / 1e3);
    if (body.at)
      keys += ", at: [" + in_millimetres(body.at->x()) + ", " + in_millimetres(body.at->y()) + ", " +
              in_millimetres(body.at->z()) + "]";
    text += "  " + body.link + ": {" + keys + "}\n";
  }
  return text;
}

}  // namespace zwang::lang
