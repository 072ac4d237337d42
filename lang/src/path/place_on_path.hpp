/// Where a point is along a whole path.
#pragma once

#include "zwang/lang/path.hpp"

namespace zwang::lang {

/// Of a point in the path's plane: its nearest point on the whole path.
struct PlaceOnPath {
  double along = 0.0;   ///< [m] arc length; of a closed path within half a round of 0
  double offset = 0.0;  ///< [m] to the left of it
  double share = 1.0;   ///< as of a piece
};
PlaceOnPath place_on(const Path& path, double x, double y) noexcept;

}  // namespace zwang::lang
