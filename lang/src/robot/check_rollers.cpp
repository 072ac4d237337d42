// W868: rollers that are mirrored. W869: a wheel whose axis lies across its own cylinder. W870: one with more
// inertia than its mass has on the rim, m R^2.
//
// Each wheel's roller may be mounted either way. Every arrangement has its greatest forces along x and y and
// its greatest moment. A base is mounted as the arrangement with the greatest product of the three.
#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>

#include "diagnostic/wordings_standing.hpp"
#include "robot/check_joints.hpp"
#include "robot/possible_inertia.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {

namespace {

/// Forces nearer to each other than this are alike: omni wheels mirror into themselves.
constexpr double alike = 0.99;
constexpr std::size_t most_rollers = 8;  // 2^8 arrangements
/// Of the angle between a wheel's axis and its cylinder's, its cosine: 45 deg.
constexpr double across = 0.7;

/// A wheel's push on the base: its lever (x, y, rz) of 1 N, and the most that its motor makes.
struct RollerPush {
  solver::Vector3 along = solver::Vector3::Zero();  ///< per newton: x, y and [m] about the middle of all
  double most = 0.0;                                ///< [N]
};

/// The greatest force along x, y and the greatest moment that the motors make with nothing beside it:
///
///   F = min over pairs i, j of   sum_k most_k |w_k . n| / |n . e|,   n = w_i x w_j
///
/// the dual of max F with sum f_k w_k = F e and |f_k| <= most_k; its corners are those n. 0: none.
solver::Vector3 greatest_forces(const std::vector<RollerPush>& pushes) {
  solver::Vector3 greatest = solver::Vector3::Constant(solver::infinity);
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    for (std::size_t j = i + 1; j < pushes.size(); ++j) {
      const solver::Vector3 n = pushes[i].along.cross(pushes[j].along);
      double sum = 0.0;
      for (const RollerPush& push : pushes) sum += push.most * std::abs(push.along.dot(n));
      for (int k = 0; k < 3; ++k) {
        if (std::abs(n(k)) > 1e-9) greatest(k) = std::min(greatest(k), sum / std::abs(n(k)));
      }
    }
  }
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(greatest(k))) greatest(k) = 0.0;
  }
  return greatest;
}

/// The wheels' pushes with the rollers of `flipped`, a bit each, mirrored.
class Rollers {
 public:
  explicit Rollers(const solver::Model& model) : model_(model) {
    for (const solver::Wheel& wheel : model.wheels()) {
      if (wheel.roller_angle) wheels_.push_back(wheel);
    }
    for (const solver::Wheel& wheel : wheels_)
      middle_ += pose_in_base(model, wheel.body).position / static_cast<double>(wheels_.size());
  }

  const std::vector<solver::Wheel>& wheels() const { return wheels_; }

  std::vector<RollerPush> pushes(unsigned flipped) const {
    std::vector<RollerPush> all;
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const solver::Wheel& wheel = wheels_[i];
      const solver::Joint& joint = model_.joint(wheel.body - 1);
      const solver::Pose pose = pose_in_base(model_, wheel.body);
      const solver::Vector3 axle = pose.rotation * joint.axis;
      const double angle = ((flipped >> i) & 1U) != 0U ? -*wheel.roller_angle : *wheel.roller_angle;
      const solver::Vector3 roller = Eigen::AngleAxisd(angle, solver::Vector3::UnitZ()) * axle;
      const solver::Vector3 p = pose.position - middle_;
      const double rolls = std::abs(roller.dot(axle.cross(solver::Vector3::UnitZ())));
      const double lever = wheel.radius * rolls;
      const double effort = std::isfinite(joint.max_effort) ? joint.max_effort : 1.0;
      all.push_back({{roller.x(), roller.y(), p.cross(roller).z()},
                     joint.actuated && lever > 1e-9 ? effort / lever : 0.0});
    }
    return all;
  }

  /// sum |p_i x u_i| / n. [m]
  double lever(unsigned flipped) const {
    double sum = 0.0;
    for (const RollerPush& push : pushes(flipped)) sum += std::abs(push.along.z());
    return sum / static_cast<double>(wheels_.size());
  }

 private:
  const solver::Model& model_;
  std::vector<solver::Wheel> wheels_;
  solver::Vector3 middle_ = solver::Vector3::Zero();
};

double product_of(const solver::Vector3& forces) {
  return forces.x() * forces.y() * forces.z();
}

/// Of all arrangements the one with the greatest product of the three; of those alike the one with the fewest
/// wheels changed.
unsigned best_arrangement(const Rollers& rollers) {
  const auto count = static_cast<unsigned>(rollers.wheels().size());
  unsigned best = 0;
  double most = product_of(greatest_forces(rollers.pushes(0)));
  for (unsigned changed = 1; changed <= count; ++changed) {
    double most_of_these = most / alike;
    for (unsigned flipped = 1; flipped < 1U << count; ++flipped) {
      if (static_cast<unsigned>(std::popcount(flipped)) != changed) continue;
      const double product = product_of(greatest_forces(rollers.pushes(flipped)));
      if (!(product > most_of_these * (1.0 + 1e-9))) continue;
      best = flipped;
      most = most_of_these = product;
    }
  }
  return best;
}

}  // namespace

namespace {

/// m r^2 of all of a swivel's mass at r, `swivel_reaches` as far off its axis as its wheel reaches.
void check_swivel_inertias(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics) {
  std::vector<wording::HeavySwivel> heavy;
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const solver::Body& body = robot.model.bodies()[static_cast<std::size_t>(wheel.body)];
    if (body.parent == 0) continue;
    const solver::Body& swivel = robot.model.bodies()[static_cast<std::size_t>(body.parent)];
    const solver::Vector3& axis = swivel.joint.axis;
    const double trail = axis.cross(body.pose_in_parent.position).norm();
    const double reach = swivel_reaches * (trail + wheel.radius);
    const double about_axis = axis.dot(swivel.inertia.rotational * axis);
    const double within = swivel.inertia.mass * reach * reach;
    if (about_axis <= within) continue;
    const auto text = std::find_if(file.wheels.begin(), file.wheels.end(),
                                   [&](const WheelText& w) { return w.joint.text == body.joint.name; });
    heavy.push_back({text->joint.span, swivel.joint.name, about_axis, within, reach});
  }
  if (!heavy.empty()) diagnostics.add(wording::swivel_inertia_beyond_reach(heavy));
}

void check_balance(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics) {
  std::vector<wording::UnbalancedWheel> wheels;
  const double weight = robot.model.total_mass() * robot.model.gravity().norm();
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const solver::Body& body = robot.model.bodies()[static_cast<std::size_t>(wheel.body)];
    const double beside = beside_axis(body.inertia, body.joint.axis);
    const double force = body.inertia.mass * robot.model.gravity().norm() * beside / wheel.radius;
    if (force <= most_imbalance * weight) continue;
    const auto text = std::find_if(file.wheels.begin(), file.wheels.end(),
                                   [&](const WheelText& w) { return w.joint.text == body.joint.name; });
    wheels.push_back({text->joint.span, body.joint.name, beside, force});
  }
  if (!wheels.empty()) diagnostics.add(wording::unbalanced_wheels(wheels));
}

}  // namespace

void check_rollers(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics) {
  const Rollers rollers(robot.model);
  const std::size_t count = rollers.wheels().size();
  if (count < 3 || count > most_rollers) return;
  const unsigned best = best_arrangement(rollers);
  if (best == 0) return;
  std::vector<wording::MirroredWheel> wheels;
  for (std::size_t i = 0; i < count; ++i) {
    if (((best >> i) & 1U) == 0U) continue;
    const std::string& joint = robot.model.joint(rollers.wheels()[i].body - 1).name;
    const auto text = std::find_if(file.wheels.begin(), file.wheels.end(),
                                   [&](const WheelText& w) { return w.joint.text == joint; });
    if (text != file.wheels.end()) wheels.push_back({text->joint.span, joint});
  }
  if (wheels.empty()) return;
  if (wheels.size() == count) {
    diagnostics.add(
        wording::mirrored_rollers(wheels.front().span, rollers.lever(0), rollers.lever((1U << count) - 1)));
    return;
  }
  const solver::Vector3 own = greatest_forces(rollers.pushes(0)),
                        other = greatest_forces(rollers.pushes(best));
  int lost = 0;
  for (int k = 1; k < 3; ++k) {
    if (own(k) * other(lost) < own(lost) * other(k)) lost = k;
  }
  diagnostics.add(wording::mirrored_wheels(wheels, lost, own(lost), other(lost)));
}

void check_wheel_shapes(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics) {
  for (const WheelText& wheel : file.wheels) {
    const UrdfJoint* joint = urdf.find_joint(wheel.joint.text);
    const UrdfLink* link = joint != nullptr ? urdf.find_link(joint->child) : nullptr;
    if (link == nullptr || !link->cylinder_axis) continue;
    if (std::abs(joint->joint.axis.dot(*link->cylinder_axis)) >= across) continue;
    diagnostics.add(wording::wheel_across(wheel.joint.span, wheel.joint.text, joint->span));
  }
}

void check_wheel_inertias(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics) {
  std::vector<wording::HeavyWheel> heavy;
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const solver::Body& body = robot.model.bodies()[static_cast<std::size_t>(wheel.body)];
    const double about_axle = body.joint.axis.dot(body.inertia.rotational * body.joint.axis);
    const double on_the_rim = body.inertia.mass * wheel.radius * wheel.radius;
    if (about_axle <= on_the_rim) continue;
    const auto text = std::find_if(file.wheels.begin(), file.wheels.end(),
                                   [&](const WheelText& w) { return w.joint.text == body.joint.name; });
    heavy.push_back({text->joint.span, body.joint.name, about_axle, on_the_rim});
  }
  if (!heavy.empty()) diagnostics.add(wording::wheel_inertia_beyond_rim(heavy));
  check_swivel_inertias(file, robot, diagnostics);
  check_balance(file, robot, diagnostics);
}

}  // namespace zwang::lang
