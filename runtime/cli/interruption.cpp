#include "interruption.hpp"

#include <csignal>

namespace zwang::cli {

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal sets it");

/// A second interruption ends the process at once: the operator does not want to wait for the end.
extern "C" void on_interruption(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& catch_interruption() {
  interrupted = false;
  std::signal(SIGINT, on_interruption);
  std::signal(SIGTERM, on_interruption);
  if (std::signal(SIGHUP, on_interruption) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  return interrupted;
}

bool is_interrupted() noexcept {
  return interrupted;
}

}  // namespace zwang::cli
