/// Questions about what carries the base, what it grips and what it hits.
#pragma once

#include "physics/questions.hpp"

namespace zwang::lang {

/// N603: the first hit. `is_first`: the task begins where the scene says.
void ask_hit(const PlannedTask& plan, const std::optional<Scene>& scene, bool is_first, Probe& probe,
             Remarks& remarks);
/// W640: accelerations and pushes that could tip the base over.
void ask_tipping(const PlannedTask& plan, const std::optional<Scene>& scene, Probe& probe, Remarks& remarks);
/// W640 of the protective stop; `span` where the file names its robot.
void ask_stop(const Span& span, Probe& probe, Remarks& remarks);
/// W642: drivers beyond what the floor holds.
void ask_traction(const PlannedTask& plan, const std::optional<Scene>& scene, Probe& probe, Remarks& remarks);
/// W642 of the protective stop; `span` where the file names its robot.
void ask_grip_of_stop(const Span& span, const std::optional<Scene>& scene, Probe& probe, Remarks& remarks);

/// The axis at the start, in the axes of the base.
solver::Vector3 direction_in_base(const PlannedAxis& axis, const Probe& probe,
                                  const std::optional<Scene>& scene);
/// The force [N] or moment [N m] that a driver asks for with this effective mass. The driver has a target: a
/// force, an acceleration or a velocity.
double asked_force(const PlannedTask& plan, const PlannedAxis& axis, double mass);

}  // namespace zwang::lang
