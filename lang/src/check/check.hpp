/// Meaning: names, dimensions, clashes. A file that passes these checks and the physics can be lowered
/// without further checks.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "check/symbols.hpp"
#include "spec/task_file.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

/// A task file whose every name is known and every quantity fits its place.
struct CheckedFile {
  TaskFile file;
  Robot robot;
  std::optional<Scene> scene;
  Symbols symbols;
  /// The condition of each exit of each task, names resolved.
  std::vector<std::vector<Condition>> conditions;
  std::vector<Condition> always_conditions;            ///< of each exit under `always`
  std::vector<std::optional<Condition>> requirements;  ///< `enter.require` of each task
  std::map<const AxisText*, Condition> yields;         ///< what axes of `file` give way to
};

struct CheckContext;

/// Everything but what is asked of the robot's model. The conditions go to `checked`, whose symbols are the
/// context's.
void check_statements(CheckContext& context, const std::optional<Scene>& scene, CheckedFile& checked);

/// Takes about a second.
inline constexpr double whole_budget = 2e9;

}  // namespace zwang::lang
