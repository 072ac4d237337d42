#include "diagnostic/wordings_statics.hpp"

#include <algorithm>
#include <cmath>

#include "diagnostic/make.hpp"
#include "diagnostic/wordings_physics.hpp"

namespace zwang::lang::wording {

namespace {

/// To two significant digits, down.
double rounded_down(double value) {
  if (!(value > 0.0)) return 0.0;
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return step * std::floor(value / step + 1e-9);
}

}  // namespace

Diagnostic falls_over(const Span& span, const std::string& base, double outside, bool has_supports) {
  return error(
      "E640", span,
      "`" + base + "` falls over as it stands: its mass lies " +
          (outside > 0.0 ? figure(outside * 1e3, "mm") + " outside" : std::string("on the edge of")) +
          " its wheels and supports",
      std::string("name the links that also carry it in `supports`, or say where a mass lies, `inertias: "
                  "{LINK: {radius: 0.2 m, at: [-5 cm, 0 m, 0 m]}}`") +
          (has_supports ? "; a base on two wheels that names none stands on its footprint" : ""));
}

Diagnostic stands_on_edge(const Span& span, const std::string& base, double inside, double height,
                          double lean) {
  return warning(
      "W640", span,
      "`" + base + "` stands on the edge of its wheels and supports: its mass lies " +
          figure(inside * 1e3, "mm") + " inside them and " + figure(height * 1e3, "mm") +
          " high, so a floor that leans by " + angle_in_degrees(lean) + " tips it over",
      "name the links that also carry it in `supports`, or say where a mass lies, `inertias: {LINK: {radius: "
      "0.2 m, at: [-5 cm, 0 m, 0 m]}}`");
}

Diagnostic tips_by_acceleration(const Span& span, const std::string& axis, double asked, double tips,
                                double inside, double height) {
  return warning("W640", span,
                 "`" + axis + "` may speed up with " + figure(asked, "m/s^2") + ", " + figure(tips, "m/s^2") +
                     " tip the base over: its mass is " + figure(inside * 1e3, "mm") +
                     " inside its supports and " + figure(height * 1e3, "mm") + " high",
                 "limit it: `acceleration: +-" + figure(rounded_down(tips), "m/s^2") + "`");
}

Diagnostic tips_by_stop(const Span& span, double asked, double tips) {
  return warning(
      "W640", span,
      "the robot's protective stop brakes with " + figure(asked, "m/s^2") + ", " + figure(tips, "m/s^2") +
          " tip the base over",
      "write `stop: {deceleration: " + figure(rounded_down(tips), "m/s^2") + "}` in the robot file");
}

Diagnostic tips_by_push(const Span& span, const std::string& axis, double asked, double tips, double height) {
  return warning("W640", span,
                 "`" + axis + "` may push with " + figure(asked, "N") + ", " + figure(tips, "N") +
                     " at the bumper, " + figure(height * 1e3, "mm") + " high, tip the base over",
                 "stay below `" + figure(rounded_down(tips), "N") + "`");
}

Diagnostic unknown_bumper_height(const Span& span, const std::string& axis, double asked, double from) {
  return warning("W640", span,
                 "`" + axis + "` may push with " + figure(asked, "N") + ", which tip the base over from " +
                     figure(from * 1e3, "mm") +
                     " above the floor on: the robot file does not say how high it touches",
                 "write `bumper: {height: ..}` in the robot file");
}

Diagnostic meets_or_passes(const Span& span, const std::string& base, const std::string& object,
                           double height, double assumed) {
  return warning("W644", span,
                 "`" + object + "` is " + figure(height * 1e3, "mm") + " high, and the robot file of `" +
                     base + "` does not say how high it touches: a bumper at " + figure(assumed * 1e3, "mm") +
                     " is assumed, so it " + (height < assumed ? "passes" : "meets") + " `" + object + "`",
                 "write `bumper: {height: ..}` in the robot file");
}

Diagnostic passes_all(const Span& span, const std::string& base, const std::string& object, double height,
                      double bumper) {
  return warning("W644", span,
                 "`" + base + "` touches at " + figure(bumper, "m") + " and passes above every object: `" +
                     object + "`, the highest, is " + figure(height, "m") + " high",
                 "write `bumper: {height: ..}` in the robot file as it is measured, from the floor to where "
                 "the base touches first");
}

Diagnostic stops_beyond_the_floor(const Span& span, double asked, double held, double friction) {
  return warning(
      "W642", span,
      "the robot's protective stop brakes with " + figure(asked, "m/s^2") + ", the floor holds " +
          figure(held, "m/s^2") + " at most (friction " + figure(friction, "") + "): the wheels slip",
      "write `stop: {deceleration: " + figure(rounded_down(held), "m/s^2") + "}` in the robot file");
}

Diagnostic beyond_the_floor(const Span& span, const std::string& axis, double asked, double held,
                            double friction, double load) {
  return warning("W642", span,
                 "`" + axis + "` asks for " + figure(asked, "N") + ", the floor holds " + figure(held, "N") +
                     " at most (friction " + figure(friction, "") + " x " + figure(load, "N") +
                     " on its driven wheels): the wheels slip",
                 "stay below `" + figure(rounded_down(held), "N") + "`");
}

Diagnostic first_hit(const Span& span, const std::string& axis, const Impact& hit, double allowed,
                     double gentle_speed) {
  const std::string points = hit.points == 1 ? " (1 point)" : " (" + std::to_string(hit.points) + " points)";
  std::string text = "`" + axis + "`: " + figure(hit.mass, "kg") + (hit.is_bound ? " at up to " : " at ") +
                     figure(hit.speed, "m/s") + " against " + figure(hit.stiffness / 1000.0, "kN/m") +
                     (hit.object.empty() ? "" : " of `" + hit.object + "`" + points) +
                     (hit.is_most ? " peaks at up to " : " peaks near ") + figure(hit.peak, "N");
  if (hit.at_end > hit.peak)
    text += ", at up to " + figure(hit.at_end, "N") + " where it gives way no farther";
  for (std::size_t i = 0; i < hit.uncounted.size(); ++i)
    text += (i == 0 ? ", not counting " : " and ") + hit.uncounted[i];
  if (hit.in_steps > 0.0) text += "; the simulation feels less, as its steps do not resolve the hit";
  if (hit.in_steps > 0.0 && hit.in_steps < std::max(hit.peak, hit.at_end))
    text += ": at most " + figure(hit.in_steps, "N");
  return make("N603", Severity::note, span,
              text + "; " +
                  (allowed > 0.0 ? "below " + figure(allowed, "N") + " from " + figure(gentle_speed, "m/s")
                                 : "no force range bounds what it presses with afterwards"),
              "");
}

}  // namespace zwang::lang::wording
