#include "caster_friction.hpp"

#include <cmath>

namespace zwang::runtime {

CasterFriction::CasterFriction(double mass, double load, double trail, double ahead, double aside)
    : trail_(trail) {
  const std::array<Eigen::Vector2d, 4> pivots{
      Eigen::Vector2d{ahead, aside}, {-ahead, aside}, {-ahead, -aside}, {ahead, -aside}};
  for (std::size_t i = 0; i < pivots.size(); ++i)
    casters_[i] = {pivots[i], 0.0, floor_bristle(mass / 4.0, load / 4.0)};
}

Eigen::Vector3d CasterFriction::step(const Eigen::Vector3d& velocity, double period) noexcept {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Caster& caster : casters_) {
    const Eigen::Vector2d ahead(std::cos(caster.heading), std::sin(caster.heading));
    const Eigen::Vector2d of_pivot(velocity.x() - velocity.z() * caster.pivot.y(),
                                   velocity.y() + velocity.z() * caster.pivot.x());
    const double rolling = of_pivot.dot(ahead);
    const double across = ahead.x() * of_pivot.y() - ahead.y() * of_pivot.x();
    const Eigen::Vector2d force = -caster.bristle.step(rolling, period) * ahead;
    sum += Eigen::Vector3d(force.x(), force.y(), caster.pivot.x() * force.y() - caster.pivot.y() * force.x());
    caster.heading += period * (across / trail_ - velocity.z());
  }
  return sum;
}

}  // namespace zwang::runtime
