#include <algorithm>
#include <cmath>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_paths.hpp"
#include "spec/parse_task.hpp"
#include "spec/shape.hpp"

namespace zwang::lang {

namespace {

using Point = std::array<double, 2>;

constexpr double least_distance = 1e-3;  // [m] of two points of a path

bool stand_together(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]) < least_distance;
}

/// The number of the first point that stands where the one before it stands; 0: none does. Of a closed path
/// the last point may not stand at the first one, either.
std::size_t repeated_point(const std::vector<Point>& points, bool is_closed) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (stand_together(points[i], points[i - 1])) return i;
  }
  return is_closed && stand_together(points.front(), points.back()) ? points.size() - 1 : 0;
}

/// nullopt where they cannot be points of a path.
std::optional<std::vector<Point>> parse_through(const Node& node, bool is_closed, const std::string& what,
                                                Diagnostics& diagnostics) {
  auto points = parse_places(node, what + "'s `through`", "a point of " + what, diagnostics);
  if (!points) return std::nullopt;
  if (points->size() < 2) {
    diagnostics.add(wording::path_of_one_point(node.span, what));
    return std::nullopt;
  }
  if (const std::size_t i = repeated_point(*points, is_closed); i > 0) {
    const bool repeats_before = stand_together((*points)[i], (*points)[i - 1]);
    diagnostics.add(repeats_before ? wording::point_twice(node.items[i].span, what)
                                   : wording::closed_by_hand(node.items[i].span, what));
    return std::nullopt;
  }
  return points;
}

std::vector<PathPiece> join_points(const std::vector<Point>& points, bool is_closed, const Node& through,
                                   const Node* fillet, const std::string& what, Diagnostics& diagnostics) {
  const double most = largest_fillet(points, is_closed);
  if (most == 0.0) {
    diagnostics.add(wording::path_turns_back(through.span, what));
    return {};
  }
  double radius = 0.0;
  if (fillet != nullptr) {
    const auto given = parse_positive(*fillet, dimension::length, what + "'s `fillet`", false, diagnostics);
    if (!given) return {};
    radius = *given;
  }
  const auto pieces = path_through(points, radius, is_closed);
  if (!pieces) diagnostics.add(wording::fillet_too_large(fillet->span, what, radius, most));
  return pieces.value_or(std::vector<PathPiece>{});
}

void parse_path(const Entry& entry, TaskFile& file, Diagnostics& diagnostics) {
  Path path;
  FrameText frame;
  const Word name = parse_name(entry.key, "a path's name", diagnostics);
  const std::string what = "path `" + entry.key.text + "`";
  MapReader map(entry.value, what, diagnostics,
                "{through: [[0 m, 0 m], [3 m, 0 m], [3 m, 2 m]], fillet: 0.5 m}");
  const Node* through = map.required("through");
  if (const Node* parent = map.optional("parent")) {
    frame.parent = parse_word(*parent, what + "'s `parent`", diagnostics);
  } else {
    frame.parent = {"world", entry.key.span};
  }
  if (const Node* closed = map.optional("closed"))
    path.is_closed = parse_boolean(*closed, what + "'s `closed`", diagnostics).value_or(false);
  const auto points =
      through != nullptr ? parse_through(*through, path.is_closed, what, diagnostics) : std::nullopt;
  const double most = points ? largest_fillet(*points, path.is_closed) : 0.0;
  const bool turns = std::isfinite(most) && most > 0.0;
  const Node* fillet = turns ? map.required("fillet") : map.optional("fillet");
  if (points) {
    const Point &first = points->front(), &second = (*points)[1];
    frame.at = {first[0], first[1]};
    frame.rpy = {0.0, 0.0, std::atan2(second[1] - first[1], second[0] - first[0])};
    if (!turns || fillet != nullptr)
      path.pieces = join_points(*points, path.is_closed, *through, fillet, what, diagnostics);
  }
  map.finish();
  if (!name.exists()) return;
  path.name = name.text;
  path.span = frame.span = entry.key.span;
  frame.name = name;
  frame.is_path = true;
  file.frames.push_back(std::move(frame));
  file.paths.push_back(std::move(path));
}

}  // namespace

void parse_paths(const Node& node, TaskFile& file, Diagnostics& diagnostics) {
  if (!require_mapping(node, "`paths`", diagnostics)) return;
  for (const Entry& entry : node.entries) {
    if (!entry.key.is_bad) parse_path(entry, file, diagnostics);
  }
}

}  // namespace zwang::lang
