#include "object_guide.hpp"

namespace zwang::runtime {

ObjectGuide::ObjectGuide(const lang::Guide& guide, double inertia)
    : guide_(guide),
      side_(guide.lower >= 0.0   ? 1.0
            : guide.upper <= 0.0 ? -1.0
                                 : 0.0),
      bristle_(floor_bristle(inertia, guide.friction)) {}

double ObjectGuide::step(double q, double rate, double period) noexcept {
  return -side_ * guide_.preload - guide_.stiffness * q - bristle_.step(rate, period);
}

}  // namespace zwang::runtime
