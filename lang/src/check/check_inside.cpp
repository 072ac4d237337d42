// Groups `inside` a region: whether it has room, and whether it can hold back what moves.
#include <algorithm>
#include <cmath>

#include "check/parameter_values.hpp"
#include "check/room.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_never.hpp"
#include "diagnostic/wordings_slips.hpp"

namespace zwang::lang {

namespace {

/// The largest margin in [good, bad] that leaves a place, in whole centimetres where `good` allows it. [m]
template <typename HasPlace>
double most_margin(double good, double bad, const HasPlace& has_place) {
  double most = good;
  for (int halved = 0; halved < 12; ++halved) {
    const double middle = 0.5 * (most + bad);
    (has_place(middle) ? most : bad) = middle;
  }
  return std::max(good, std::floor(100.0 * most) / 100.0);
}

/// E414: a point, or a circle within the footprint, that has no place inside. Corners may stand around a
/// notch, so a footprint is only asked about where there is none.
void check_room(CheckContext& context, const GroupText& group, const Region& region) {
  const std::optional<double> margin =
      group.margin ? known_value(context, *group.margin, dimension::length) : 0.0;
  if (!margin || *margin < 0.0) return;
  const auto has_place = [&](double needed) {
    return region.radius > 0.0 ? region.radius > needed : has_room(region.polygon, needed);
  };
  const Span& span = group.margin ? group.margin->span : group.region.span;
  const double most = group.margin ? values_of(context, *group.margin).high : 0.0;
  if (*margin > 0.0 && !has_place(*margin)) {
    context.diagnostics.add(wording::no_inside(span, region.name, *margin, 0.0, region.span));
    return;
  }
  const bool moves_footprint = group.move.text == "footprint" && context.robot.has_value();
  const double circle =
      moves_footprint && is_convex(region.polygon) ? circle_within(context.robot->footprint) : 0.0;
  if (circle > 0.0 && !has_place(*margin + circle)) {
    context.diagnostics.add(wording::no_inside(span, region.name, *margin, circle, region.span));
  } else if (most > *margin && !has_place(most + circle)) {
    require(context, *group.margin,
            {.rule = "`" + region.name + "` must have room within the margin",
             .limit = most_margin(*margin, most, [&](double tried) { return has_place(tried + circle); }),
             .is_least = false});
  }
}

/// E405: a region that the moved link carries along never holds it back.
void check_rides_along(CheckContext& context, const GroupText& group, int region, int move) {
  const RegionSymbol& symbol = context.symbols.regions[static_cast<std::size_t>(region)];
  const FrameSymbol& parent = context.symbols.frames[static_cast<std::size_t>(symbol.region.parent)];
  const FrameSymbol& moved = context.symbols.frames[static_cast<std::size_t>(move)];
  if (symbol.is_bad || parent.body < 0 || parent.body != moved.body) return;
  context.diagnostics.add(wording::boundary_rides_along(group.region.span, group.name.text, group.region.text,
                                                        parent.declaration.name, group.move.text,
                                                        symbol.region.span));
}

}  // namespace

void check_inside(CheckContext& context, const GroupText& group) {
  const std::optional<int> region = context.symbols.find_region(group.region.text);
  if (region) {
    context.symbols.regions[static_cast<std::size_t>(*region)].is_used = true;
  } else if (group.region.exists()) {
    context.diagnostics.add(wording::unknown_name(group.region.span, "region", group.region.text,
                                                  context.symbols.region_names()));
  }
  std::optional<int> move = context.symbols.find_frame(base_of(context));
  if (group.move.text != "footprint") {
    move = check_frame(context, group.move);
    if (move && context.symbols.frames[static_cast<std::size_t>(*move)].body < 0) {
      context.diagnostics.add(wording::immovable(group.move.span, group.move.text));
      move.reset();
    }
  }
  if (region && move) check_rides_along(context, group, *region, *move);
  const std::string what = group.name.text + ".margin";
  if (group.margin && check_value(context, *group.margin, dimension::length, what))
    check_positive(context, *group.margin, what, true);
  const std::string way_back = group.name.text + ".return";
  if (group.return_speed && check_value(context, *group.return_speed, dimension::velocity, way_back))
    check_positive(context, *group.return_speed, way_back, true);
  if (region) check_room(context, group, context.symbols.regions[static_cast<std::size_t>(*region)].region);
}

}  // namespace zwang::lang
