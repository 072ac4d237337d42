/// Whether this robot can do what the file asks: E404, E406, W407 and the 600s, computed from its model
/// through the solver.
#pragma once

#include "check/context.hpp"

namespace zwang::lang {

/// The condition of each exit; without nodes where it could not be read.
struct ExitConditions {
  const std::vector<std::vector<Condition>>& of_tasks;
  const std::vector<Condition>& of_always;
  const std::vector<std::optional<Condition>>& on_entry;  ///< `enter.require` of each task
};

/// Asks what can be asked of a file that may have other errors; notes only where they are wanted.
void check_physics(CheckContext& context, const std::optional<Scene>& scene, const ExitConditions& conditions,
                   double& budget);

}  // namespace zwang::lang
