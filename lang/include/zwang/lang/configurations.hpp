/// Joint angles and headings at which a robot is looked at where a figure depends on them: always the same
/// ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::lang {

/// The start pose alone for a robot that has wheels and no other joints. Of any other robot also, with the
/// base where it starts: all other joints turned alike by 45, 90 and 135 deg, and three of `general_states`.
/// The mass of casters and swivels has its extremes at those angles.
ZWANG_EXPORT std::vector<solver::State> configurations(const Robot& robot, const std::optional<Scene>& scene);

/// The configurations that `configurations` returns, in words, for reports that give figures over them.
ZWANG_EXPORT std::string describe_configurations(const Robot& robot);

/// The solver's figures of an axis as a task can use them. Where the ground leaves less than a thousandth of
/// the axis, the axis is held. An example is a base whose wheels stand a millimetre behind the origin. When
/// the base spins, the origin goes sideways with tons of effective mass. An axis that only moves along with a
/// turn, and cannot be pushed alone, is not reachable.
ZWANG_EXPORT solver::AxisAnalysis usable(solver::AxisAnalysis axis);

/// Four states in general position: joints anywhere within their limits, the base anywhere within 3 m of the
/// origin, at any heading.
ZWANG_EXPORT std::vector<solver::State> general_states(const solver::Model& model);

}  // namespace zwang::lang
