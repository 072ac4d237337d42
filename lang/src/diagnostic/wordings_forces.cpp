#include "diagnostic/wordings_forces.hpp"

#include <cmath>
#include <numbers>

#include "diagnostic/axis_units.hpp"
#include "diagnostic/make.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "words/text.hpp"

namespace zwang::lang::wording {

namespace {

std::string in_time(double seconds) {
  return seconds < 1.0 ? figure(seconds * 1e3, "ms") : figure(seconds, "s");
}

}  // namespace

Diagnostic wrench_on_the_world(const Span& span, const std::string& frame) {
  return error("E409", span,
               "`" + frame + "` stands in the world: no motor of the robot feels what presses on it",
               "ask about a frame of the robot");
}

Diagnostic wrench_that_the_floor_bears(const Span& span, const std::string& name) {
  return error("E409", span, "the floor bears " + in_ticks(name) + ": no motor of a base on wheels feels it",
               "a base feels `x`, `y`, `rz` and `plane`; measure the rest with a wrench signal");
}

Diagnostic yield_with_time_constant(const Span& span, const std::string& axis) {
  return error("E104", span, "`" + axis + "` gives a time constant beside `yield`",
               "`mass` and `damping` say how fast it gets there: mass / damping");
}

Diagnostic build_up_without_driver(const Span& span, const std::string& axis) {
  return error(
      "E104", span,
      "`build_up` adds up the error of a `position` or a `velocity`, and `" + axis + "` drives neither",
      "leave it out, or drive a `position` or a `velocity`");
}

Diagnostic build_up_with_spring(const Span& span, const std::string& axis) {
  return error("E104", span, "`build_up` does not go with a spring: `" + axis + "` gives a stiffness",
               "leave `build_up` out, or give a `time_constant` in the place of `stiffness` and `damping`");
}

Diagnostic builds_up_too_fast(const Span& span, const std::string& axis, double time_constant, double least) {
  return with_replacement(warning("W604", span,
                                  "`" + axis + "` swings: it builds up faster than its time constant of " +
                                      in_time(time_constant) + " can follow",
                                  "`build_up: " + in_time(least) + "` or longer"),
                          in_time(least));
}

Diagnostic rings_when_held(const Span& span, const std::string& axis, const Ringing& ringing, bool is_error) {
  const std::string enough = at_least(ringing.enough, "kg");
  const std::string message = "`" + axis + "` rings when held by more than " +
                              figure(ringing.stiffest * 1e-3, "kN/m") + ": the robot weighs " +
                              figure(ringing.mass, "kg") + " along it, and the force is known " +
                              in_time(ringing.lag) + " late";
  const std::string help = "write `mass: " + enough + "`";
  return with_replacement(
      is_error ? error("E417", span, message, help) : warning("W618", span, message, help), enough);
}

Diagnostic dead_band_not_held(const Span& span, const std::string& axis, bool turns,
                              const BandNotHeld& band) {
  const std::string unit = axis_units(turns).force;
  const std::string wide = figure(band.dead_band, unit), held = figure(band.held, unit);
  if (band.is_of_motors)
    return warning("W647", span,
                   "`" + axis + "` does not stand inside its dead band of " + wide + ": the motors hold " +
                       held + ", and a harder push moves it undamped",
                   "write `dead_band: " + held + "` or less");
  const std::string narrow = band.held > 0.0 ? ", or `dead_band: " + held + "`" : "";
  return with_related(warning("W647", span,
                              "`" + axis + "` does not stand inside its dead band of " + wide +
                                  ": its force range holds " + held + ", and a harder push moves it undamped",
                              "write `force: +-" + wide + "` or more" + narrow),
                      band.dead_band_span, "the dead band is given here");
}

Diagnostic swings_on(const Span& span, const std::string& axis, bool turns, const Swinging& swinging) {
  const std::string enough = at_least(swinging.enough, turns ? "N m s/rad" : "N s/m");
  return with_replacement(
      warning("W648", span,
              "`" + axis + "` swings: on " + figure(swinging.mass, axis_units(turns).mass) +
                  " its damping leaves " + figure(100.0 * swinging.left, "%") +
                  " of a swing when the task's time of " + figure(swinging.time, "s") + " is over",
              "write `damping: " + enough + "`, with which it does not swing"),
      enough);
}

Diagnostic trails_its_target(const Span& span, const std::string& axis, const Trailed& trailed,
                             const Span& declared) {
  const std::string speed =
      trailed.turns ? angle_in_degrees(trailed.speed) + "/s" : figure(trailed.speed, "m/s");
  const std::string distance =
      trailed.turns ? angle_in_degrees(trailed.distance) : figure(trailed.distance, "m");
  return with_related(
      make("N616", Severity::note, span,
           "a target at " + speed + " is trailed by `" + axis + "` by " + distance + " (2 T v)",
           "write `twist: 0.5 s` at the signal `" + trailed.signal + "`"),
      declared, "`" + trailed.signal + "` is taken to stand between two samples");
}

Diagnostic yields_across(const Span& span, const std::string& axis, const Across& across) {
  const std::string apart = across.at_start > 0.0
                                ? "they lie " + angle_in_degrees(across.at_start) + " apart at the start"
                                : "they turn apart as the robot moves";
  const bool is_reversed = across.at_start > 175.0 / 180.0 * std::numbers::pi;
  return warning("W617", span,
                 "`" + axis + "` yields along an axis of `" + across.in + "` to a force along an axis of `" +
                     across.force + "`: " + apart,
                 is_reversed
                     ? "turn the sign of the force"
                     : "write `in: " + across.force + "`, or take the part of the force along this axis");
}

Diagnostic twist_without_pose(const Span& span, const std::string& signal) {
  return error("E104", span, "signal `" + signal + "` has a twist, but is no pose",
               "leave `twist` out, or write `type: pose`");
}

Diagnostic push_against(const Span& span, const std::string& one, const std::string& other, bool turns,
                        double left, const Span& other_span) {
  return with_related(warning("W416", span,
                              "`" + one + "` and `" + other + "` push against each other: " +
                                  figure(left, axis_units(turns).force) + " are left",
                              "leave one of them out"),
                      other_span, "`" + other + "` pushes here");
}

}  // namespace zwang::lang::wording
