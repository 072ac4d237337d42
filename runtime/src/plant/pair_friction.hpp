/// The friction of two surfaces that touch.
#pragma once

#include <algorithm>

namespace zwang::runtime {

/// The smaller coefficient of the two, as the more slippery surface gives way first. A surface with 0 says
/// nothing: the other one's acts.
inline double pair_friction(double one, double other) {
  return one > 0.0 && other > 0.0 ? std::min(one, other) : std::max(one, other);
}

}  // namespace zwang::runtime
