/// Bristles of dry friction, and their forces, are cut to what friction bears.
#pragma once

namespace zwang::runtime {

/// Shortens `v` to the length `limit`.
template <typename Vector>
void cut(Vector&& v, double limit) {
  const double length = v.norm();
  if (length > limit) v *= limit / length;
}

}  // namespace zwang::runtime
