#include "diagnostic/wordings_physics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "diagnostic/axis_units.hpp"
#include "diagnostic/make.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::lang::wording {

namespace {

/// To three significant digits, down or up: what is offered in the place of a number must do.
double rounded(double value, bool up) {
  if (!(value > 0.0)) return value;
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  const double steps = value / step;
  return step * (up ? std::ceil(steps - 1e-9) : std::floor(steps + 1e-9));
}

std::string product(double mass, double acceleration, const AxisUnits& u) {
  return figure(mass, u.mass) + " x " + figure(acceleration, u.acceleration);
}

std::string control_period_of(double period) {
  return "a control period of " + figure(period * 1e3, "ms");
}

std::string ahead(const std::string& frame) {
  return frame.empty() ? ""
                       : "move a frame ahead of the axle, for example " + frame +
                             ", or `lead`, if the robot file names one";
}

/// `lead` is the base where the robot file does not say otherwise.
std::string named_lead(const std::string& frame) {
  return "say in the robot file which frame ahead of the axle `lead` is: `lead: nose`, and under `frames` " +
         frame;
}

Diagnostic capped(Diagnostic diagnostic, const Cap& cap, const Span& limit) {
  const AxisUnits u = axis_units(cap.turns);
  diagnostic.help = "ask for `" + at_most(cap.most, u.force) + "` or less";
  // An acceleration that no motor makes would lead from this error to the next.
  const double possible = std::min(cap.wanted, cap.motors);
  if (possible > cap.most)
    diagnostic.help +=
        ", or allow an acceleration of `" + at_least(possible / cap.mass, u.acceleration) + "`";
  if (possible < cap.wanted)
    diagnostic.help += " for the " + figure(cap.motors, u.force) + " that the motors make at most";
  if (!limit.exists()) return diagnostic;
  return with_related(std::move(diagnostic), limit, "the acceleration is limited here");
}

}  // namespace

std::string figure(double value, const std::string& unit) {
  char text[64];
  const double size = std::abs(value);
  std::snprintf(text, sizeof text, size >= 100.0 && size < 1e7 ? "%.0f" : "%.3g", value);
  return unit.empty() ? std::string(text) : std::string(text) + " " + unit;
}

std::string at_most(double value, const std::string& unit) {
  return figure(rounded(value, false), unit);
}

std::string at_least(double value, const std::string& unit) {
  return figure(rounded(value, true), unit);
}

std::string angle_in_degrees(double radians) {
  return figure(radians * 180.0 / std::numbers::pi, "deg");
}

Diagnostic held_axis(const Span& span, const std::string& axis) {
  return error("E404", span, "this base cannot move along `" + axis + "`: the ground holds it",
               "leave the axis out, or write it as a range");
}

Diagnostic axis_held_by_wheels(const Span& span, const std::string& axis, const std::string& frame_ahead) {
  return error("E404", span, "this base cannot move along `" + axis + "`: its wheels hold it",
               frame_ahead.empty() ? "leave the axis out, or write it as a range" : ahead(frame_ahead));
}

Diagnostic no_motor_along(const Span& span, const std::string& axis, bool can_turn) {
  return error("E404", span, "no motor of this robot pushes along `" + axis + "`",
               can_turn ? "turn the base with `rz` and drive ahead along its own `x`"
                        : "leave the axis out, or write it as a range");
}

Diagnostic no_motor_across(const Span& span, const std::string& axis, const std::string& in, bool can_turn) {
  return error(
      "E404", span,
      "no motor of this robot pushes along `" + axis + "` of `" + in + "` where the base stands across it",
      can_turn ? "turn the base with `rz` and drive ahead along `x` in its own axes, not in `" + in + "`"
               : "leave the axis out, or write it as a range");
}

Diagnostic tied_axes(const Span& span, const std::string& axis, const std::string& move, int freedoms,
                     const std::string& frame_ahead) {
  return error("E404", span,
               "this base cannot drive `" + move + "` along `" + axis +
                   "` as well: its wheels leave it only one way to go at a time",
               frame_ahead.empty()
                   ? "leave one of the " + std::to_string(freedoms) + " out, or give it another `level`"
               : move == "lead" ? named_lead(frame_ahead)
                                : ahead(frame_ahead));
}

Diagnostic too_many_rows(const Span& span, int rows, int level, int freedoms, bool is_base,
                         const std::string& frame_ahead) {
  const std::string who = is_base ? "the base" : "the robot";
  std::string help = "give it `level: " + std::to_string(std::min(level + 1, 9)) + "`, or leave it out";
  if (!frame_ahead.empty())
    help = "drive x and y of a frame ahead of the axle and leave rz out: " + frame_ahead;
  return error("E406", span,
               std::to_string(rows) + " equality rows at level " + std::to_string(level) + ", " + who +
                   " has " + std::to_string(freedoms) + ": which may give way?",
               std::move(help));
}

Diagnostic redundant_row(const Span& span, const std::string& axis, const std::string& twin,
                         const Span& twin_span) {
  const std::string message = twin.empty() ? "`" + axis + "` adds nothing to the rows before it"
                                           : "`" + axis + "` and `" + twin + "` drive the same motion";
  Diagnostic diagnostic = warning("W407", span, message, "leave one of them out, or write it as a range");
  return twin_span.exists() ? with_related(std::move(diagnostic), twin_span, "`" + twin + "` is driven here")
                            : diagnostic;
}

Diagnostic taken_above(const Span& span, const std::string& axis, const std::string& above, int level,
                       const Span& above_span) {
  return with_related(warning("W407", span,
                              "`" + axis + "` never acts: `" + above + "` drives the same motion at level " +
                                  std::to_string(level),
                              "leave one of them out, or write it as a range"),
                      above_span, "`" + above + "` is driven here");
}

Diagnostic cannot_feel(const Span& span, const std::string& axis, const std::string& says, double push,
                       const Span& motor) {
  return with_related(
      error("E630", span,
            "`" + axis + "` " + says + ", and this robot cannot feel: its drive pushes with up to " +
                figure(push, "N") + " until the wheels turn as they are told",
            "say how fast the base may go instead, or use a drive that takes torques or a "
            "torque limit in each cycle"),
      motor, "one of the motors; `torque_limit: fixed` says that its limit is not sent");
}

Diagnostic pushes_fully(const Span& span, double push, const Span& motor) {
  return with_related(
      warning("W635", span,
              "this robot cannot feel: at an obstacle it pushes with up to " + figure(push, "N") +
                  " until the guard finds that its wheels do not follow, after 0.3 s and more",
              "keep people away, or lower the drive's own torque limit"),
      motor, "one of the motors; `torque_limit: fixed` says that its limit is not sent");
}

Diagnostic cannot_press(const Span& span, const Cap& cap, const Span& limit) {
  const AxisUnits u = axis_units(cap.turns);
  return capped(error("E601", span,
                      "`" + cap.axis + "` can never press with " + figure(cap.wanted, u.force) +
                          ": the acceleration limit caps it at " + figure(cap.most, u.force) + " (" +
                          product(cap.mass, cap.most / cap.mass, u) + ")"),
                cap, limit);
}

Diagnostic too_slow_to_press(const Span& span, const Cap& cap, double horizon, const Span& range) {
  const AxisUnits u = axis_units(cap.turns);
  const double speed = cap.most * horizon / cap.mass, enough = cap.wanted * horizon / cap.mass;
  return with_related(error("E601", span,
                            "`" + cap.axis + "` can never press with " + figure(cap.wanted, u.force) +
                                ": the velocity range caps it at " + figure(cap.most, u.force) + " (" +
                                figure(cap.mass, u.mass) + " x " + figure(speed, u.speed) + " / " +
                                figure(horizon, "s") + ", within which this drive keeps limits)",
                            "ask for `" + at_most(cap.most, u.force) + "` or less, or allow `" +
                                figure(rounded(enough, true), u.speed) + "`"),
                      range, "the velocity is limited here");
}

Diagnostic cannot_press_everywhere(const Span& span, const Cap& least, const Span& limit) {
  const AxisUnits u = axis_units(least.turns);
  return capped(warning("W601", span,
                        "`" + least.axis + "` cannot press with " + figure(least.wanted, u.force) +
                            " in every configuration: the acceleration limit caps it at " +
                            figure(least.most, u.force) + " in some (" +
                            product(least.mass, least.most / least.mass, u) + ")"),
                least, limit);
}

Diagnostic cannot_press_at_range_end(const Span& span, const Cap& cap, const Span& limit) {
  const AxisUnits u = axis_units(cap.turns);
  return capped(
      warning("W601", span,
              "`" + cap.axis + "` cannot press with " + figure(cap.wanted, u.force) +
                  ", which its parameter's range allows: the acceleration limit caps it at " +
                  figure(cap.most, u.force) + " (" + product(cap.mass, cap.most / cap.mass, u) + ")"),
      cap, limit);
}

Diagnostic dead_guard(const Span& span, const std::string& axis, bool turns, double mass, double acceleration,
                      double pressed, double time_constant, const Span& guard) {
  const AxisUnits u = axis_units(turns);
  std::string help = "a force range of `+-" + at_most(pressed, u.force) + "` or less";
  if (time_constant > 0.0) help += ", or a `time_constant` of `" + at_most(time_constant, "s") + "` or less";
  return with_related(
      warning("W602", span,
              "blocked, `" + axis + "` presses with " + figure(pressed, u.force) + " at most (" +
                  product(mass, acceleration, u) + "): it never reaches this range",
              help),
      guard, "a base that is blocked does not make this true");
}

Diagnostic brakes_too_hard(const Span& span, const std::string& axis, bool turns, const Braking& b,
                           double enough) {
  const AxisUnits u = axis_units(turns);
  const std::string whose =
      b.sum.empty() ? "its force range" : "`" + b.sum + "`, which bounds the sum of all forces,";
  const std::string limit = b.by_force ? whose + " allows " + figure(b.allowed, u.acceleration) + " (" +
                                             figure(b.allowed * b.mass, u.force) + " / " +
                                             figure(b.mass, u.mass) + ")"
                                       : "the acceleration limit allows " + figure(b.allowed, u.acceleration);
  return warning("W604", span,
                 "`" + axis + "` would brake with " + figure(b.peak, u.acceleration) + " from " +
                     figure(b.speed, u.speed) + " (v/(e time_constant)), " + limit + ": it overshoots",
                 "`time_constant: " + at_least(enough, "s") + "` or longer, or a lower velocity");
}

Diagnostic faster_than_the_tick(const Span& span, const std::string& axis, double time_constant,
                                double period, double least) {
  return warning("W604", span,
                 "`" + axis + "` has a time constant of " + figure(time_constant * 1e3, "ms") + ", which " +
                     control_period_of(period) + " cannot follow",
                 "`time_constant: " + figure(least * 1e3, "ms") + "` or longer");
}

Diagnostic damped_too_hard(const Span& span, const std::string& axis, bool turns, double mass, double period,
                           double most) {
  return warning("W604", span,
                 "the damping of `" + axis + "` shakes " + figure(mass, axis_units(turns).mass) + ": " +
                     control_period_of(period) + " cannot follow it",
                 "`damping: " + at_most(most, turns ? "N m s/rad" : "N s/m") + "` or less");
}

Diagnostic too_stiff(const Span& span, const std::string& axis, bool turns, double mass, double period,
                     double most) {
  return warning("W604", span,
                 "`" + axis + "` is too stiff for its damping: on " + figure(mass, axis_units(turns).mass) +
                     " and with " + control_period_of(period) + " it swings wider and wider",
                 "`stiffness: " + at_most(most, turns ? "N m/rad" : "N/m") + "` or less, or more damping");
}

Diagnostic force_budget(const Span& span, const std::string& axis, bool turns, double own,
                        const std::string& others, double added) {
  const AxisUnits u = axis_units(turns);
  return make(
      "N605", Severity::note, span,
      "`" + axis + "` <= " + figure(own, u.force) + ", but " + others + " may add " + figure(added, u.force),
      "");
}

Diagnostic beyond_the_motors(const Span& span, const std::string& axis, bool turns, double asked, double most,
                             double mass, double time_constant, bool always) {
  const AxisUnits u = axis_units(turns);
  std::string from = mass > 0.0 ? " (" + product(mass, asked / mass, u) + ")" : "";
  std::string help = mass > 0.0 ? "ask for `" + at_most(most / mass, u.acceleration) + "` or less"
                                : "ask for `" + at_most(most, u.force) + "` or less";
  if (time_constant > 0.0) help = "`time_constant: " + at_least(time_constant, "s") + "` or longer";
  return warning("W606", span,
                 "`" + axis + "` asks for " + figure(asked, u.force) + from + ", the motors make " +
                     figure(most, u.force) + " at most along it" + (always ? "" : " in some configurations"),
                 help);
}

Diagnostic boundary_not_held(const Span& span, const std::string& axis, bool turns, double mass,
                             double braking, double force, double enough) {
  const AxisUnits u = axis_units(turns);
  constexpr double share = solver::braking_share;
  return warning("W607", span,
                 "the boundary of `" + axis + "` brakes with up to " +
                     figure(share * braking * mass, u.force) + " (" + figure(share, "") + " x " +
                     product(mass, braking, u) + "), the motors make " + figure(force, u.force) +
                     ": it can be overrun",
                 "limit the acceleration to `+-" + at_most(enough, u.acceleration) + "`");
}

Diagnostic boundary_askew(const Span& span, const std::string& axis, const std::string& own) {
  return warning(
      "W607", span,
      "no motor of this robot pushes along its own `" + own +
          "`: where it stands askew to the boundary of `" + axis + "`, it is not held back at all",
      "keep the base square to the boundary, or leave room for where it stops by the task's own drivers");
}

Diagnostic free_and_held(const Span& span, const std::string& axis, bool elsewhere) {
  const std::string held = "`" + axis + "` is free, but the wheels hold it";
  return warning("W609", span, held + (elsewhere ? " while nobody steers" : "") + ": no contact moves it",
                 "leave the axis out, or take a base that can be moved along it");
}

Diagnostic unasked(const Span& span, const std::string& task) {
  return make("N608", Severity::note, span,
              "from task `" + task +
                  "` on nothing was asked about the robot's model: so many axes of such a robot would take "
                  "too long",
              "split the file");
}

Diagnostic stands_still(const Span& span, const std::string& axis, const std::string& limit,
                        const std::string& quantity, const Span& range) {
  return with_related(warning("W610", span,
                              "nothing will move along `" + axis + "`: " +
                                  (limit.empty()                          ? "its own range"
                                   : limit.find(' ') == std::string::npos ? "`" + limit + "`"
                                                                          : limit) +
                                  " allows no " + quantity + " that way",
                              "widen the range; to stand still write `velocity: 0 m/s`"),
                      range, "the range is here");
}

Diagnostic vanishing_distance(const Span& span, const std::string& axis, double asked, double height) {
  const std::string instead =
      "drive x and y of the frame in axes at the point: `x: {position: 0 m}, y: {position: 0 m}`";
  if (height < 1e-4)
    return warning("W613", span,
                   "at a distance of 0 there is no direction between two points: `" + axis +
                       "` makes the base circle about the point and never rest",
                   instead + "; or keep a distance, `5 cm`");
  return warning("W613", span,
                 "`" + axis + "` cannot become " + figure(asked, "m") + ": the two points lie " +
                     figure(height, "m") + " apart in height, and the base swings across and never rests",
                 instead + "; or keep a distance of more than `" + at_least(height, "m") + "`");
}

Diagnostic holds_all_askew(const Span& span, const std::string& axis, const std::string& in,
                           const std::string& own_axis, int later_level, const std::string& other,
                           const Span& other_span) {
  return with_related(warning("W614", span,
                              "`" + axis + "` holds up `" + other + "`, too, once the base is askew to `" +
                                  in + "`: it goes only where it heads",
                              "stand still in the base's own axes, in a group of its own: " + own_axis +
                                  "; or let it give way, `level: " + std::to_string(later_level) + "`"),
                      other_span, "`" + other + "` is driven here");
}

Diagnostic arm_without_limit(const Span& span, const std::string& axis, const std::string& frame,
                             const std::string& limited, const Span& limit) {
  return with_related(
      warning("W612", span,
              "`" + axis + "` moves `" + frame + "` of the arm and has no limit of its force: what limits `" +
                  limited + "` holds for the base alone",
              "limit what the arm may press with as well: `force: +-20 N`"),
      limit, "the base's force is limited here");
}

}  // namespace zwang::lang::wording
