#include "object_guide.hpp"

#include <algorithm>

namespace zwang::runtime {

namespace {

constexpr double bristle_frequency = 200.0;  ///< [1/s] as that of the floor
constexpr double bristle_damping = 0.7;      ///< ratio, while it holds

}  // namespace

ObjectGuide::ObjectGuide(const lang::Guide& guide, double inertia)
    : guide_(guide),
      side_(guide.lower >= 0.0   ? 1.0
            : guide.upper <= 0.0 ? -1.0
                                 : 0.0),
      bristle_(bristle_frequency * bristle_frequency * inertia),
      damper_(2.0 * bristle_damping * bristle_frequency * inertia) {}

double ObjectGuide::step(double q, double rate, double period) noexcept {
  const double most = guide_.friction;
  stretch_ = std::clamp(stretch_ + period * rate, -most / bristle_, most / bristle_);
  const double dry = std::clamp(bristle_ * stretch_ + damper_ * rate, -most, most);
  return -side_ * guide_.preload - guide_.stiffness * q - dry;
}

}  // namespace zwang::runtime
