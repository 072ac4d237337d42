/// Where a frame is along a path: at which piece of it.
///
/// Progress is measured, so that nothing runs ahead of a robot that something holds up. The piece is searched
/// from the last one on: where a path meets itself, the frame stays on the branch that it came along.
#pragma once

#include "zwang/lang/path.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::runtime {

class PathFollower {
 public:
  /// Nearer to an arc's centre than this share of its radius, the frame's place along it is unknown.
  static constexpr double least_share = 0.1;

  /// `path` must live as long.
  PathFollower(const lang::Path& path, int path_index, int move)
      : path_(&path), index_(path_index), move_(move) {}

  bool follows(int path_index, int move) const noexcept { return index_ == path_index && move_ == move; }
  int path_index() const noexcept { return index_; }
  int move() const noexcept { return move_; }
  int frame() const noexcept { return path_->frame; }

  /// The piece whose nearest point is nearest of all. The point is in the path's frame.
  void search(const solver::Vector3& point) noexcept;
  /// From the last piece to its neighbours, for as long as the point lies beyond an end.
  void follow(const solver::Vector3& point) noexcept;

  bool is_known() const noexcept { return is_known_; }
  const lang::PathPiece& piece() const noexcept { return path_->pieces[piece_]; }
  /// Arc length where the piece begins: of a closed path all rounds since the search count. [m]
  double arc_length() const noexcept { return piece().start + rounds_ * path_->length(); }

  /// Of the path's frame: where the piece begins.
  solver::AttachedFrame start_of_piece;
  double followed_at = -1.0;  ///< [s] the tick that it was followed in last; negative: never
  int settings = 0;           ///< of the path's frame, as it was then

 private:
  /// To the next piece, or with -1 to the one before; false at an end of the path.
  bool go_on(int way) noexcept;

  const lang::Path* path_;
  int index_;
  int move_;
  std::size_t piece_ = 0;
  int rounds_ = 0;  ///< of a closed path, since the search; below 0: backwards
  bool is_known_ = true;
};

}  // namespace zwang::runtime
