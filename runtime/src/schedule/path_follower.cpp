#include "schedule/path_follower.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

/// From the point to the piece, its ends included. [m]
double distance_to_piece(const lang::PathPiece& piece, const lang::PlaceOnPiece& place) {
  const double beyond = std::max({0.0, -place.along, place.along - piece.length});
  // At an end the chord counts; along an arc the way around it is longer, and that piece is farther either
  // way.
  return std::hypot(beyond * place.share, place.offset);
}

}  // namespace

void PathFollower::search(const solver::Vector3& point) noexcept {
  double least = solver::infinity;
  for (std::size_t i = 0; i < path_->pieces.size(); ++i) {
    const lang::PathPiece& piece = path_->pieces[i];
    const double distance = distance_to_piece(piece, lang::place_on(piece, point.x(), point.y()));
    if (!(distance < least)) continue;
    least = distance;
    piece_ = i;
  }
  follow(point);
}

void PathFollower::follow(const solver::Vector3& point) noexcept {
  int way = 0;  // it never goes to and fro
  for (std::size_t steps = 0; steps < path_->pieces.size(); ++steps) {
    const lang::PlaceOnPiece place = lang::place_on(piece(), point.x(), point.y());
    is_known_ = place.share > least_share;
    if (!is_known_) return;
    if (place.along > piece().length && piece_ + 1 < path_->pieces.size() && way >= 0) {
      ++piece_;
      way = 1;
    } else if (place.along < 0.0 && piece_ > 0 && way <= 0) {
      --piece_;
      way = -1;
    } else {
      return;
    }
  }
}

}  // namespace zwang::runtime
