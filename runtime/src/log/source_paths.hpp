/// The names that a log gives the files of a run.
#pragma once

#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

/// Paths start at the present folder if all files lie in it, else at the folder that they have in common. The
/// spelling on the command line does not matter: the same files make the same log. Changes `sources`, and the
/// facts that name a file: `task`, `robot` and `scene`.
LogContext with_paths_from_one_folder(LogContext context);

}  // namespace zwang::runtime
