#include "zwang/lang/path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

namespace {

using Point = std::array<double, 2>;

constexpr double straight = 1e-6;           // [rad] a turn that needs no fillet
constexpr double least_opening = 1e-3;      // [rad] between a line and the way back along it
constexpr double fits = 1.0 + 1e-9;         // a fillet may take the whole of a line
constexpr double least_line_length = 1e-9;  // [m]

double length_of_line(const Point& from, const Point& to) {
  return std::hypot(to[0] - from[0], to[1] - from[1]);
}

double heading_of_line(const Point& from, const Point& to) {
  return std::atan2(to[1] - from[1], to[0] - from[0]);
}

/// The last point of a closed path has the first one behind it.
std::size_t lines_of(const std::vector<Point>& points, bool is_closed) {
  return points.empty() ? 0 : points.size() - (is_closed ? 0 : 1);
}

/// [rad] to the left at each point; 0 at the ends.
std::vector<double> turns_of(const std::vector<Point>& points, bool is_closed) {
  const std::size_t count = points.size();
  std::vector<double> turns(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_closed && (i == 0 || i + 1 == count)) continue;
    const Point &before = points[(i + count - 1) % count], &after = points[(i + 1) % count];
    const double turn = heading_of_line(points[i], after) - heading_of_line(before, points[i]);
    turns[i] = std::remainder(turn, 2.0 * std::numbers::pi);
    if (std::abs(turns[i]) < straight) turns[i] = 0.0;
  }
  return turns;
}

/// The length that a fillet of radius 1 cuts from the lines on both sides of each point.
std::vector<double> cuts_of(const std::vector<double>& turns) {
  std::vector<double> cuts;
  for (const double turn : turns) cuts.push_back(std::tan(0.5 * std::abs(turn)));
  return cuts;
}

/// Adds pieces one behind the other.
class PieceChain {
 public:
  /// `ahead` of the first point, along the first line. [m]
  explicit PieceChain(double ahead) { at_.position.x() = ahead; }
  void add(double length, double curvature) {
    pieces_.push_back({start_, length, curvature, at_});
    const double turn = curvature * length;
    // The chord of an arc has half of its turn.
    const double chord = curvature == 0.0 ? length : 2.0 * std::sin(0.5 * turn) / curvature;
    const solver::Vector3 ahead(chord * std::cos(0.5 * turn), chord * std::sin(0.5 * turn), 0.0);
    at_ = at_ * solver::Pose{solver::rotation_from_rpy(0.0, 0.0, turn), ahead};
    start_ += length;
  }
  std::vector<PathPiece> pieces() && { return std::move(pieces_); }

 private:
  std::vector<PathPiece> pieces_;
  solver::Pose at_;
  double start_ = 0.0;
};

}  // namespace

double Path::least_radius() const {
  double sharpest = 0.0;
  for (const PathPiece& piece : pieces) sharpest = std::max(sharpest, std::abs(piece.curvature));
  return sharpest > 0.0 ? 1.0 / sharpest : solver::infinity;
}

std::vector<solver::Vector3> Path::points(double most_turn) const {
  std::vector<solver::Vector3> points;
  const auto add = [&](const PathPiece& piece, double s) {
    const double k = piece.curvature, turn = k * s;
    const solver::Vector3 ahead = k == 0.0
                                      ? solver::Vector3(s, 0.0, 0.0)
                                      : solver::Vector3(std::sin(turn) / k, (1.0 - std::cos(turn)) / k, 0.0);
    points.push_back(piece.pose * ahead);
  };
  for (const PathPiece& piece : pieces) {
    const double turn = std::abs(piece.curvature) * piece.length;
    const int count = std::max(1, static_cast<int>(std::ceil(turn / most_turn)));
    for (int i = 0; i < count; ++i) add(piece, piece.length * i / count);
  }
  if (!pieces.empty()) add(pieces.back(), pieces.back().length);
  return points;
}

PlaceOnPiece place_on(const PathPiece& piece, double x, double y) noexcept {
  const solver::Vector3 p =
      piece.pose.rotation.transpose() * (solver::Vector3(x, y, 0.0) - piece.pose.position);
  const double k = piece.curvature;
  if (k == 0.0) return {p.x(), p.y(), 1.0};
  const double ahead = k * p.x(), inwards = 1.0 - k * p.y();
  const double share = std::hypot(ahead, inwards);
  return {std::atan2(ahead, inwards) / k, (1.0 - share) / k, share};
}

double largest_fillet(const std::vector<Point>& points, bool is_closed) {
  const std::vector<double> turns = turns_of(points, is_closed);
  const std::vector<double> cuts = cuts_of(turns);
  double most = solver::infinity;
  for (std::size_t i = 0; i < lines_of(points, is_closed); ++i) {
    const std::size_t next = (i + 1) % points.size();
    const double cut = cuts[i] + cuts[next];
    if (std::numbers::pi - std::abs(turns[i]) < least_opening) return 0.0;
    if (cut > 0.0) most = std::min(most, length_of_line(points[i], points[next]) / cut);
  }
  return most;
}

std::optional<std::vector<PathPiece>> path_through(const std::vector<Point>& points, double fillet,
                                                   bool is_closed) {
  const double most = largest_fillet(points, is_closed);
  if (points.size() < 2 || most == 0.0 || fillet > most * fits) return std::nullopt;
  const std::vector<double> turns = turns_of(points, is_closed);
  const std::vector<double> cuts = cuts_of(turns);
  const std::size_t count = lines_of(points, is_closed);
  // A fillet at the first point takes the begin of the first line.
  PieceChain chain(std::isfinite(most) ? fillet * cuts[0] : 0.0);
  double line = 0.0;  // of it what is not added yet: lines that go on in one are one
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % points.size();
    const double cut = std::isfinite(most) ? fillet * (cuts[i] + cuts[next]) : 0.0;
    line += std::max(0.0, length_of_line(points[i], points[next]) - cut);
    const double turn = turns[next];
    const bool is_last = i + 1 == count;
    if (turn == 0.0 && !is_last) continue;
    const bool ends_here = !is_closed && (is_last || (cuts[i] == 0.0 && turns[i] == 0.0));
    if (ends_here || line > least_line_length) chain.add(line, 0.0);
    line = 0.0;
    if (turn != 0.0) chain.add(fillet * std::abs(turn), std::copysign(1.0 / fillet, turn));
  }
  return std::move(chain).pieces();
}

}  // namespace zwang::lang
