/// Both checks of a task file: of what its statements mean, and of what the robot can do about them.
#pragma once

#include <optional>

#include "check/check.hpp"

namespace zwang::lang {

/// `robot` none: it could not be read, and was complained of; what does not need it is checked all the same.
/// `with_notes`: notes (N codes) are looked for, too. `budget`: what may still be asked of robots' models, in
/// the units of `Probe`; files that are loaded together share it.
std::optional<CheckedFile> check(TaskFile file, std::optional<Robot> robot, std::optional<Scene> scene,
                                 const LoadOptions& options, bool with_notes, double& budget,
                                 Diagnostics& diagnostics);

}  // namespace zwang::lang
