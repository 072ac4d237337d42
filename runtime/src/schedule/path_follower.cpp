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
  rounds_ = 0;
  follow(point);
  // A frame near the start of a closed path is there, and not a whole round ahead.
  const double along = arc_length() + lang::place_on(piece(), point.x(), point.y()).along;
  if (path_->is_closed && along > 0.5 * path_->length()) --rounds_;
}

bool PathFollower::go_on(int way) noexcept {
  const std::size_t last = path_->pieces.size() - 1;
  const bool is_at_end = piece_ == (way > 0 ? last : 0);
  if (is_at_end && !path_->is_closed) return false;
  if (is_at_end) rounds_ += way;
  piece_ = is_at_end ? (way > 0 ? 0 : last) : (way > 0 ? piece_ + 1 : piece_ - 1);
  return true;
}

void PathFollower::follow(const solver::Vector3& point) noexcept {
  int way = 0;  // it never goes to and fro
  for (std::size_t steps = 0; steps < path_->pieces.size(); ++steps) {
    const lang::PlaceOnPiece place = lang::place_on(piece(), point.x(), point.y());
    is_known_ = place.share > least_share;
    if (!is_known_) return;
    const int beyond = place.along > piece().length ? 1 : place.along < 0.0 ? -1 : 0;
    if (beyond == 0 || beyond == -way || !go_on(beyond)) return;
    way = beyond;
  }
}

}  // namespace zwang::runtime
