#include "physics/push.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {

Push push_of(const PlannedTask& plan, Probe& probe) {
  Push push;
  for (const PlannedAxis& axis : plan.axes) {
    const bool is_asked = axis.driver && axis.text != nullptr && axis.move.body == 0 && !axis.turns() &&
                          !axis.is_feature() && !axis.stands_still() && axis.is_placed;
    if (!is_asked) continue;
    const auto& range = axis[solver::Quantity::force];
    double force = 0.0;
    if (axis.driver == solver::Quantity::force) {
      force = std::abs(axis.target.value_or(0.0));
    } else if (range) {
      force = std::max(range->high, -range->low);
    } else if (const AxisFigures* figures = probe.figures(axis)) {
      force = figures->force;
    }
    if (force > push.force) push = {&axis, force};
  }
  return push;
}

namespace {

/// Of the push in the base. [rad]
double heading_of(const Push& push, Probe& probe) {
  const bool is_own = push.axis->in.body == 0;  // else the base may head to it anyhow: as at the start
  const solver::Vector3 along =
      is_own ? solver::Vector3(push.axis->in.pose.rotation.col(static_cast<int>(push.axis->axis)))
             : probe.direction(*push.axis);
  const bool pulls = push.axis->target.value_or(0.0) < 0.0;
  return std::atan2(pulls ? -along.y() : along.y(), pulls ? -along.x() : along.x());
}

}  // namespace

Eigen::Vector2d along_push(const solver::Vector3& place, const Push& push, Probe& probe) {
  const double heading = heading_of(push, probe);
  const Eigen::Vector2d axle(axle_ahead(probe.robot().model, heading), 0.0);
  return Eigen::Rotation2Dd(-heading) * place.head<2>() - axle;
}

std::vector<Eigen::Vector2d> outline_along(const Push& push, Probe& probe) {
  std::vector<Eigen::Vector2d> outline;
  for (const solver::Vector3& corner : probe.robot().footprint)
    outline.push_back(along_push(corner, push, probe));
  return outline;
}

double longest_lever(const Push& push, Probe& probe) {
  double most = 0.0;
  for (const Eigen::Vector2d& corner : outline_along(push, probe))
    most = std::max(most, std::abs(corner.y()));
  return most;
}

double lever_askew(const Push& push, double askew, Probe& probe) {
  const std::vector<Eigen::Vector2d> outline = outline_along(push, probe);
  double shortest = solver::infinity;
  for (const double yaw : {askew, -askew}) {
    Eigen::Vector2d foremost(-solver::infinity, 0.0);
    for (const Eigen::Vector2d& corner : outline) {
      const Eigen::Vector2d turned = Eigen::Rotation2Dd(yaw) * corner;
      if (turned.x() > foremost.x()) foremost = turned;
    }
    shortest = std::min(shortest, std::abs(foremost.y()));
  }
  return shortest;
}

}  // namespace zwang::lang
