/// Values that a `set` needs and that may not be known when it is carried out.
#pragma once

#include <optional>
#include <vector>

#include "check/context.hpp"

namespace zwang::lang {

/// The checked conditions of a file; without nodes where one could not be read.
struct SetConditions {
  const std::vector<std::vector<Condition>>& of_tasks;  ///< of each exit of each task
  const std::vector<Condition>& of_always;
  const std::vector<std::optional<Condition>>& of_entries;  ///< `enter.require` of each task
};

/// W513: frames that are set from a pose signal, or hang on one, on a way that does not ask whether it is
/// known.
void check_unguarded_sets(CheckContext& context, const SetConditions& conditions);

}  // namespace zwang::lang
