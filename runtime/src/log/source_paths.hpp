/// The names that a log gives the files of a run.
#pragma once

#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

/// From the present folder where all of them lie in it, else from the folder that they have in common,
/// however they were typed: the same files make the same log. `sources`, and the facts that name one: `task`,
/// `robot` and `scene`.
LogContext with_paths_from_one_folder(LogContext context);

}  // namespace zwang::runtime
