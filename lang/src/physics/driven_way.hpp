/// How far the drivers of a task lead the base from where it starts.
#pragma once

#include <optional>

#include "physics/questions.hpp"

namespace zwang::lang {

/// The longest way that drivers of positions take, and the one that takes most of it.
struct DrivenWay {
  double most = 0.0;  ///< [m] or [rad]
  const PlannedAxis* by = nullptr;
};
/// Of the path of `point`, if drivers hold or place each freedom of the base. nullopt: something else may
/// move it. The task begins at the start pose.
std::optional<DrivenWay> way_to_places(const PlannedTask& plan, const solver::AttachedFrame& point,
                                       Probe& probe);
/// Of the base's turn.
std::optional<DrivenWay> turn_to_places(const PlannedTask& plan, Probe& probe);

/// The most arc length that a frame passes beside its path, by its own way: within `beside_path` of the least
/// radius.
inline constexpr double beside_path = 0.1, arc_by_way = 1.0 / (1.0 - beside_path);

/// The arc length [m] at which the axis stands as the run starts: of `x` of a path beside which the task
/// keeps the frame. nullopt: the frame starts or is kept too far beside it, so that a short way passes a long
/// piece.
std::optional<double> start_along_path(const CheckContext& context, const PlannedTask& plan,
                                       const PlannedAxis& axis, const Probe& probe);

}  // namespace zwang::lang
