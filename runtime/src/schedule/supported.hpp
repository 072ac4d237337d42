/// The part of the language that this runtime runs. The rest is refused before the first tick: a limit that
/// is read and then forgotten would be worse than one that cannot be written.
#pragma once

#include "zwang/lang/program.hpp"

namespace zwang::runtime {

/// Throws std::invalid_argument, naming what cannot be run and the task it stands in.
void require_supported(const lang::Program& program);

}  // namespace zwang::runtime
