/// Meaning: names, dimensions, clashes, physics. What passes here can be lowered without another question.
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

/// `robot` none: it could not be read, and was complained of; what does not need it is checked all the same.
/// `with_notes`: notes (N codes) are looked for, too. `budget`: what may still be asked of robots' models, in
/// the units of `Probe`; files that are loaded together share it.
std::optional<CheckedFile> check(TaskFile file, std::optional<Robot> robot, std::optional<Scene> scene,
                                 const LoadOptions& options, bool with_notes, double& budget,
                                 Diagnostics& diagnostics);

/// Takes about a second.
inline constexpr double whole_budget = 2e9;

}  // namespace zwang::lang
