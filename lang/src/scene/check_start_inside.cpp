#include "scene/check_start_inside.hpp"

#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_standing.hpp"
#include "path/place_on_path.hpp"
#include "zwang/lang/feature_measure.hpp"
#include "zwang/lang/plane.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;
using Point = std::array<double, 2>;

constexpr double told_distance = 1e-3;  // [m], or [rad]: a start is written with as many digits

class StartCheck {
 public:
  StartCheck(const Program& program, Diagnostics& diagnostics)
      : program_(program),
        diagnostics_(diagnostics),
        state_(start_state(program.robot, program.scene)),
        parameters_(program.parameter_values()) {}

  void check() {
    for (const Group& group : program_.always.groups) check_group(group, "always.");
    const Task& first = program_.tasks[static_cast<std::size_t>(program_.start)];
    if (!first.set_on_entry.empty()) return;  // it may move the frames that its groups stand in
    for (const Group& group : first.groups) check_group(group, first.name + ".");
  }

 private:
  const FrameDeclaration& frame(int index) const { return program_.frames[static_cast<std::size_t>(index)]; }

  /// None where it hangs on a signal.
  std::optional<solver::AttachedFrame> attached(int index) const {
    solver::AttachedFrame attached{-1, frame(index).pose, {}};
    const FrameDeclaration* f = &frame(index);
    while (f->parent == FrameParent::frame) {
      f = &frame(f->parent_index);
      attached.pose = f->pose * attached.pose;
    }
    if (f->parent == FrameParent::signal) return std::nullopt;
    if (f->parent == FrameParent::body) attached.body = f->parent_index;
    return attached;
  }

  void check_group(const Group& group, const std::string& owner) {
    if (group.kind == GroupKind::inside) return check_region(group, owner);
    for (const AxisStatements& axis : group.axes) {
      if (axis.position) check_range(group, axis, owner);
    }
  }

  void check_range(const Group& group, const AxisStatements& axis, const std::string& owner) {
    solver::AxisConstraint c;
    c.axis = axis.axis;
    int move = group.move, in = group.in;
    if (group.kind == GroupKind::feature) {
      const Feature& feature = program_.features[static_cast<std::size_t>(group.feature)];
      move = feature.first;
      in = feature.second;
      set_measure(c, feature);
    }
    const auto moved = attached(move), axes = attached(in);
    if (!moved || !axes) return;
    c.move = *moved;
    c.in = *axes;
    if (group.path >= 0 && axis.axis != solver::Axis::x && axis.axis != solver::Axis::y) return;
    const double s =
        group.path >= 0 ? on_path(group, c) : solver::coordinate_of(c, program_.robot.model, state_).position;
    const double low = axis.position->low.evaluate(parameters_);
    const double high = axis.position->high.evaluate(parameters_);
    const double outside = std::max(s - high, low - s);
    if (!(outside > told_distance)) return;
    const bool is_feature = group.kind == GroupKind::feature;
    const bool turns = is_feature ? program_.features[static_cast<std::size_t>(group.feature)].turns
                                  : axis.axis >= solver::Axis::rx;
    diagnostics_.add(wording::starts_outside(
        axis.statement_spans[static_cast<std::size_t>(solver::Quantity::position)],
        {owner + axis.name, "", outside, axis.return_speed.evaluate(parameters_), turns}));
  }

  /// [m] along the path, or beside it.
  double on_path(const Group& group, solver::AxisConstraint c) const {
    const bool is_along = c.axis == solver::Axis::x;
    c.axis = solver::Axis::x;
    const double x = solver::coordinate_of(c, program_.robot.model, state_).position;
    c.axis = solver::Axis::y;
    const double y = solver::coordinate_of(c, program_.robot.model, state_).position;
    const PlaceOnPath place = place_on(program_.paths[static_cast<std::size_t>(group.path)], x, y);
    return is_along ? place.along : place.offset;
  }

  void check_region(const Group& group, const std::string& owner) {
    const Region& region = program_.regions[static_cast<std::size_t>(group.region)];
    const auto moved = attached(group.move), parent = attached(region.parent);
    if (!moved || !parent) return;
    const solver::Pose pose = solver::motion_of(*moved, program_.robot.model, state_).pose;
    const solver::Pose seen_from = solver::motion_of(*parent, program_.robot.model, state_).pose;
    std::vector<Vector3> corners{Vector3::Zero()};
    if (group.moves_footprint) corners = program_.robot.footprint;
    std::vector<Point> outline;
    for (const Vector3& corner : corners) {
      const Vector3 p = seen_from.rotation.transpose() * (pose * corner - seen_from.position);
      outline.push_back({p.x(), p.y()});
    }
    const double outside = group.margin.evaluate(parameters_) - least_inside(region, outline);
    if (outside > told_distance)
      diagnostics_.add(wording::starts_outside(
          group.span,
          {owner + group.name, region.name, outside, group.return_speed.evaluate(parameters_), false}));
  }

  /// Of the outline's corners, and of the region's where they lie in the outline; negative: outside. [m]
  static double least_inside(const Region& region, const std::vector<Point>& outline) {
    double least = solver::infinity;
    for (const Point& p : outline) {
      const double on_circle = region.radius - std::hypot(p[0] - region.centre[0], p[1] - region.centre[1]);
      least = std::min(least, region.polygon.empty() ? on_circle : inside(region.polygon, p));
    }
    if (outline.size() < 3) return least;
    for (const Point& vertex : region.polygon) {
      if (plane::contains(outline, vertex))
        least = std::min(least, -plane::distance_to_edges(outline, vertex));
    }
    return least;
  }

  static double inside(const std::vector<Point>& polygon, const Point& p) {
    const double distance = plane::distance_to_edges(polygon, p);
    return plane::contains(polygon, p) ? distance : -distance;
  }

  const Program& program_;
  Diagnostics& diagnostics_;
  const solver::State state_;
  const std::vector<double> parameters_;
};

}  // namespace

void check_start_inside(const Program& program, Diagnostics& diagnostics) {
  if (!program.scene) return;
  StartCheck(program, diagnostics).check();
}

}  // namespace zwang::lang
