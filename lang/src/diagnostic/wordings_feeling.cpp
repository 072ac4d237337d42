#include "diagnostic/wordings_feeling.hpp"

#include <cmath>
#include <numbers>

#include "diagnostic/make.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "words/text.hpp"
#include "words/units.hpp"

namespace zwang::lang::wording {

Diagnostic feels_twice(const Span& span) {
  return error("E815", span, "a robot feels by its `wrench` or by its `effort`, not by both",
               "keep the wrench: friction in the wheels does not spoil it");
}

Diagnostic feels_nothing(const Span& span) {
  return error("E815", span, "`feels` does not say what tells of a contact",
               "write `{wrench: {frame: bumper, noise: 1 N, filter: 5 ms}}`");
}

Diagnostic feels_beside_torques(const Span& span) {
  return error(
      "E815", span,
      "`feels` says nothing of a drive that is sent torques or torque limits: it presses as it is told",
      "remove it; or say `command: velocity` and `torque_limit: fixed` of the drive, if that is so");
}

Diagnostic feels_on_a_joint(const Span& span, const std::string& frame) {
  return error("E815", span, "the frame " + in_ticks(frame) + " of the wrench moves on a joint",
               "name a frame that is fixed to the base");
}

Diagnostic feels_too_late(const Span& span, double after, std::optional<double> longest) {
  const std::string help =
      longest && *longest > 0.0
          ? "with the same rate and filters a delay of " + figure(std::floor(*longest * 1e3), "ms") +
                " would do"
          : "a shorter delay alone would not do: raise the rate or T_i, or shorten the filter";
  return error("E631", span,
               "this robot feels a force " + figure(after * 1e3, "ms") +
                   " later: pressed against a wall it would swing, however slow it is",
               help);
}

Diagnostic slow_in_contact(const Span& span, double fades, double mass) {
  return warning(
      "W632", span,
      "in contact this robot moves slowly: 20 N push it with " + figure(20.0 / (mass * fades) * 1e3, "mm/s"),
      "give its tasks longer timeouts, or shorten delay, cycle and filter");
}

Diagnostic turned_slowly(const Span& exit, const SlowTurn& turn, const Span& push) {
  const double in_degrees = 180.0 / std::numbers::pi;
  const double slower = std::floor(0.95 * turn.turns * in_degrees * 100.0) / 100.0;
  std::string help =
      "press with `" + figure(std::ceil(1.05 * turn.force * turn.asked / turn.turns), "N") + "`, ";
  if (slower > 0.0) help += "ask for less than `" + figure(slower, "deg/s") + "`, ";
  return with_related(error("E633", exit,
                            "`" + turn.axis + "` cannot tell square from slow: this robot feels late, and " +
                                figure(turn.askew * in_degrees, "deg") + " askew a wall turns it with " +
                                figure(turn.turns * in_degrees, "deg/s") + ", the exit holds below " +
                                figure(turn.asked * in_degrees, "deg/s"),
                            help + "or drive `rz` to a measured angle"),
                      push, "it presses with " + figure(turn.force, "N"));
}

}  // namespace zwang::lang::wording
