#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

const char* describe(SwapRefusal refusal) noexcept {
  switch (refusal) {
    case SwapRefusal::none:
      return "it runs";
    case SwapRefusal::stopped:
      return "the protective stop is latched";
    case SwapRefusal::has_run:
      return "the next program has run before, and would go on in the middle of its task";
    case SwapRefusal::joints:
      return "its robot has other joints";
    case SwapRefusal::period:
      return "its control period is another";
    case SwapRefusal::signal_missing:
      return "it reads a signal that the first program does not have, so that nobody measures it";
    case SwapRefusal::signal_type:
      return "it reads a signal as another type than the first program";
    case SwapRefusal::signal_frame:
      return "it sees a signal from another frame than the first program";
  }
  return "?";
}

std::string describe(const SwapResult& result) {
  const std::string name = result.signal;
  return describe(result.refusal) + (name.empty() ? "" : ": `" + name + "`");
}

}  // namespace zwang::runtime
