/// A number that a condition measures: its axis in a task, its name and its unit.
#pragma once

#include <string>

#include "physics/planned_axis.hpp"

namespace zwang::lang {

/// The group that a coordinate stands in: of the plan's task, or of `always`.
const GroupText& group_measured(const CheckContext& context, const PlannedTask& plan,
                                const ExpressionNode& node);
/// The axis of a coordinate; nullptr where the plan has left it out.
const PlannedAxis* axis_measured(const CheckContext& context, const PlannedTask& plan,
                                 const ExpressionNode& node);
/// As the file writes it: "go.x.velocity", "speed(base)".
std::string name_measured(const CheckContext& context, const PlannedTask& plan, const ExpressionNode& node);
std::string unit_measured(const CheckContext& context, const PlannedTask& plan, const ExpressionNode& node);

}  // namespace zwang::lang
