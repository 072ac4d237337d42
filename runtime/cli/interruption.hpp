/// Ctrl-C, SIGTERM, and a terminal that is gone.
#pragma once

#include <atomic>

namespace zwang::cli {

/// Catches these signals from now on. True once one has come; a second one ends the process. Under nohup a
/// terminal that is gone is ignored.
const std::atomic<bool>& catch_interruption();
bool is_interrupted() noexcept;

}  // namespace zwang::cli
