#include "path/place_on_path.hpp"

#include <algorithm>
#include <cmath>

#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

PlaceOnPath place_on(const Path& path, double x, double y) noexcept {
  PlaceOnPath best;
  double least = solver::infinity;
  for (std::size_t i = 0; i < path.pieces.size(); ++i) {
    const PathPiece& piece = path.pieces[i];
    const PlaceOnPiece place = place_on(piece, x, y);
    // An open path goes straight on beyond its ends.
    const double begin = i == 0 && !path.is_closed ? -solver::infinity : 0.0;
    const double end = i + 1 == path.pieces.size() && !path.is_closed ? solver::infinity : piece.length;
    const double nearest = std::clamp(place.along, begin, end);
    const double distance = std::hypot((place.along - nearest) * place.share, place.offset);
    if (!(distance < least)) continue;
    least = distance;
    best = {piece.start + nearest, place.offset, place.share};
  }
  if (path.is_closed && best.along > 0.5 * path.length()) best.along -= path.length();
  return best;
}

}  // namespace zwang::lang
