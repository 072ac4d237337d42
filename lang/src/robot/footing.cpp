#include "zwang/lang/footing.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "zwang/lang/plane.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {

namespace {

using solver::Pose;
using solver::Vector3;

constexpr double least_area = 1e-6;  ///< [m^2] twice that of a triangle of points that carries

void add_mass(const Robot& robot, const Eigen::VectorXd& q, Footing& footing) {
  Vector3 moment = Vector3::Zero();
  for (int b = 0; b < robot.model.body_count(); ++b) {
    const solver::RigidInertia& inertia = robot.model.bodies()[static_cast<std::size_t>(b)].inertia;
    const Pose pose = pose_in_base(robot.model, b, q);
    footing.mass += inertia.mass;
    moment += inertia.mass * pose.position + pose.rotation * inertia.first_moment;
  }
  footing.centre = moment / footing.mass;
  footing.weight = footing.mass * robot.model.gravity().norm();
}

void add_points(const Robot& robot, const Eigen::VectorXd& q, double ground, Footing& footing) {
  for (const solver::Wheel& wheel : robot.model.wheels())
    footing.points.push_back(pose_in_base(robot.model, wheel.body, q).position);
  footing.wheels = footing.points.size();
  for (const std::string& support : robot.supports) {
    const auto frame = robot.model.find_frame(support);
    if (!frame) continue;
    const solver::Frame& above = robot.model.frames()[static_cast<std::size_t>(*frame)];
    footing.points.push_back((pose_in_base(robot.model, above.body, q) * above.pose_in_body).position);
  }
  if (robot.supports.empty() && footing.wheels < 3)
    footing.points.insert(footing.points.end(), robot.footprint.begin(), robot.footprint.end());
  for (Vector3& point : footing.points) point.z() = ground;
}

double distance_inside(const Footing& footing) {
  const std::vector<Vector3> hull = plane::convex_hull(footing.points);
  if (!hull.empty()) {
    const double distance = plane::distance_to_edges(hull, footing.centre);
    return plane::contains(hull, footing.centre) ? distance : -distance;
  }
  double least = solver::infinity;
  for (const Vector3& a : footing.points) {
    for (const Vector3& b : footing.points)
      least = std::min(least, plane::distance_to_segment(footing.centre, a, b));
  }
  return -least;
}

}  // namespace

double Footing::lean() const {
  return std::atan2(inside, std::max(height, 1e-9));
}

bool Footing::is_on_edge() const {
  // With two points the other supports are unknown. Only a mass beside both is certainly wrong.
  if (points.size() < 3) return inside < -rounding_of_places;
  return inside <= rounding_of_places || lean() < least_lean;
}

double Footing::arm_behind(const Vector3& direction) const {
  const std::vector<Vector3> hull = plane::convex_hull(points);
  if (hull.empty()) return 0.0;
  double least = solver::infinity;
  for (std::size_t i = 0, j = hull.size() - 1; i < hull.size(); j = i++) {
    // Counter-clockwise: the inside lies to the left of an edge.
    const Vector3 edge = (hull[i] - hull[j]).normalized();
    const Vector3 inward(-edge.y(), edge.x(), 0.0);
    const double away = inward.x() * direction.x() + inward.y() * direction.y();
    if (away < 1e-9) continue;
    const Vector3 arm = centre - hull[j];
    least = std::min(least, (inward.x() * arm.x() + inward.y() * arm.y()) / away);
  }
  return std::max(0.0, least);
}

double Footing::tipping_acceleration(const Vector3& direction) const {
  return height > 0.0 ? weight / mass * arm_behind(direction) / height : solver::infinity;
}

double Footing::tipping_deceleration(bool goes_sideways) const {
  const Vector3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0);
  const double along = std::min(tipping_acceleration(x), tipping_acceleration(-x));
  return goes_sideways ? std::min({along, tipping_acceleration(y), tipping_acceleration(-y)}) : along;
}

double Footing::tipping_push(const Vector3& direction, double height_of_push) const {
  return height_of_push > 0.0 ? weight * arm_behind(direction) / height_of_push : solver::infinity;
}

double Footing::most_carried(const std::vector<double>& shares) const {
  // A linear programme: max sum s_i N_i under sum N_i = m g, sum N_i (x_i, y_i) = m g (x, y), N >= 0. It has
  // three equalities, so it has an optimum with at most three loads that are not 0.
  const Eigen::Vector3d asked = weight * Eigen::Vector3d(1.0, centre.x(), centre.y());
  const auto column = [&](std::size_t i) { return Eigen::Vector3d(1.0, points[i].x(), points[i].y()); };
  double most = 0.0;
  Eigen::Matrix3d balance;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        balance << column(i), column(j), column(k);
        if (std::abs(balance.determinant()) < least_area) continue;
        const Eigen::Vector3d n = balance.inverse() * asked;
        if (n.minCoeff() < -1e-9 * weight) continue;
        most = std::max(most, n.dot(Eigen::Vector3d(shares[i], shares[j], shares[k])));
      }
    }
  }
  return most;
}

std::optional<Footing> footing_of(const Robot& robot) {
  if (robot.model.base_type() != solver::BaseType::ground || robot.model.wheels().empty())
    return std::nullopt;
  const Eigen::VectorXd q = start_state(robot).q;
  const double ground = wheel_level(robot.model).mean;
  Footing footing;
  add_mass(robot, q, footing);
  if (!(footing.mass > 0.0)) return std::nullopt;
  add_points(robot, q, ground, footing);
  footing.height = footing.centre.z() - ground;
  footing.inside = distance_inside(footing);
  return footing;
}

}  // namespace zwang::lang
