/// Paths of lines and fillets, in the x-y plane of a frame of their own. The frame is at the first point,
/// with x along the first line.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::lang {

/// A line, or an arc of constant curvature.
struct PathPiece {
  double start = 0.0;      ///< arc length where it begins [m]
  double length = 0.0;     ///< [m]
  double curvature = 0.0;  ///< [1/m] above 0 to the left; 0: a line
  solver::Pose pose;       ///< where it begins, x along its tangent there, in the path's frame
};

/// Of a point in the path's plane, seen from one piece.
struct PlaceOnPiece {
  double along = 0.0;   ///< [m] to the nearest point, from where the piece begins; below 0: before it
  double offset = 0.0;  ///< [m] to the left of it
  double share = 1.0;   ///< 1 - curvature * offset: of the arc's radius what is left; 0 at its centre
};

/// Lines that fillets join, so that the tangent turns without a jump. It begins and ends with a line, which
/// may have no length: beyond the ends the path goes straight on.
struct ZWANG_EXPORT Path {
  std::string name;
  int frame = 0;
  std::vector<PathPiece> pieces;
  bool is_closed = false;  ///< the last piece leads into the first one: arc lengths go on, round after round
  Span span;

  double length() const { return pieces.empty() ? 0.0 : pieces.back().start + pieces.back().length; }
  /// [m] of its tightest fillet; infinite where there is none.
  double least_radius() const;
  /// From its begin to its end, in the path's frame; arcs as chords of `most_turn` at most. [m]
  std::vector<solver::Vector3> points(double most_turn) const;
};

/// `x`, `y`: of the point in the path's frame [m].
ZWANG_EXPORT PlaceOnPiece place_on(const PathPiece& piece, double x, double y) noexcept;

/// The pieces through points [m] in any axes, with one radius for all fillets. Points that stand on a line
/// between their neighbours have none. nullopt where the path turns back, or the fillets do not fit. A closed
/// one goes on from the last point to the first, and begins behind the fillet there.
ZWANG_EXPORT std::optional<std::vector<PathPiece>> path_through(
    const std::vector<std::array<double, 2>>& points, double fillet, bool is_closed = false);
/// The largest radius whose fillets fit; 0 where the path turns back, infinite where it never turns. [m]
ZWANG_EXPORT double largest_fillet(const std::vector<std::array<double, 2>>& points, bool is_closed = false);

}  // namespace zwang::lang
