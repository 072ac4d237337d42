#include "caster_friction.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

constexpr double roll_frequency = 200.0;  ///< [1/s] as that of the floor
constexpr double roll_damping = 0.7;      ///< ratio, while the bristle holds

}  // namespace

CasterFriction::CasterFriction(double mass, double load, double trail, double ahead, double aside)
    : bristle_(roll_frequency * roll_frequency * mass / 4.0),
      damper_(2.0 * roll_damping * roll_frequency * mass / 4.0),
      most_(load / 4.0),
      trail_(trail) {
  const std::array<Eigen::Vector2d, 4> pivots{
      Eigen::Vector2d{ahead, aside}, {-ahead, aside}, {-ahead, -aside}, {ahead, -aside}};
  for (std::size_t i = 0; i < pivots.size(); ++i) casters_[i].pivot = pivots[i];
}

Eigen::Vector3d CasterFriction::step(const Eigen::Vector3d& velocity, double period) noexcept {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Caster& caster : casters_) {
    const Eigen::Vector2d ahead(std::cos(caster.heading), std::sin(caster.heading));
    const Eigen::Vector2d of_pivot(velocity.x() - velocity.z() * caster.pivot.y(),
                                   velocity.y() + velocity.z() * caster.pivot.x());
    const double rolling = of_pivot.dot(ahead);
    const double across = ahead.x() * of_pivot.y() - ahead.y() * of_pivot.x();
    caster.stretch = std::clamp(caster.stretch + period * rolling, -most_ / bristle_, most_ / bristle_);
    const Eigen::Vector2d force =
        -std::clamp(bristle_ * caster.stretch + damper_ * rolling, -most_, most_) * ahead;
    sum += Eigen::Vector3d(force.x(), force.y(), caster.pivot.x() * force.y() - caster.pivot.y() * force.x());
    caster.heading += period * (across / trail_ - velocity.z());
  }
  return sum;
}

}  // namespace zwang::runtime
