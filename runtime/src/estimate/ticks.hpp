/// Times, in ticks of the control loop.
#pragma once

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

/// At least one. [s]
inline int ticks_of(double time, double period) noexcept {
  return std::max(1, static_cast<int>(std::lround(time / period)));
}

}  // namespace zwang::runtime
