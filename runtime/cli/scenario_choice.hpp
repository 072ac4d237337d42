/// One cell of a scenario as a run.
#pragma once

#include <optional>
#include <string>

#include "verbs.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::cli {

/// Where the file is a scenario: the run of the cell that is named, or of the only one that it has. Else the
/// arguments as they are. Throws Impossible where no cell is named, or none has the name.
RunArguments with_choice(RunArguments arguments, lang::Diagnostics& diagnostics);

/// The program of the cell. nullopt where the scenario, or the task on this robot, has errors.
std::optional<lang::Program> load_choice(const ScenarioChoice& choice, lang::Diagnostics& diagnostics);

/// In quotes, where a shell would not take it as it is.
std::string argument_of_shell(const std::string& text);

/// `zwang run FILE --cell NAME --report`, as a shell takes it.
std::string command_of(const std::string& scenario, const std::string& cell);

}  // namespace zwang::cli
