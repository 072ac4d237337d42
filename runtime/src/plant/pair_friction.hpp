/// The friction of two surfaces that touch.
#pragma once

#include <algorithm>
#include <optional>

namespace zwang::runtime {

/// The smaller coefficient of the two, as the more slippery surface gives way first. Where one surface says
/// nothing the other one's acts; two of them do not rub. A robot's own surface says nothing.
inline double pair_friction(std::optional<double> one, std::optional<double> other = std::nullopt) {
  if (one && other) return std::min(*one, *other);
  return one ? *one : other.value_or(0.0);
}

}  // namespace zwang::runtime
