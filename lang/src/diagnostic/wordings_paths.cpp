#include "diagnostic/wordings_paths.hpp"

#include <cmath>

#include "diagnostic/make.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "words/text.hpp"

namespace zwang::lang::wording {

Diagnostic path_of_one_point(const Span& span, const std::string& what) {
  return error("E419", span, what + " has no way to go: it needs two points or more",
               "write where it begins and where it ends: `[[0 m, 0 m], [3 m, 0 m]]`");
}

Diagnostic point_twice(const Span& span, const std::string& what) {
  return error("E419", span, what + " has no direction here: the point before stands at the same place",
               "leave one of them out");
}

Diagnostic closed_by_hand(const Span& span, const std::string& what) {
  return error("E419", span, what + " is closed: it leads from its last point to the first one by itself",
               "leave this point out");
}

Diagnostic path_turns_back(const Span& span, const std::string& what) {
  return error("E419", span, what + " turns back the way that it came: no fillet fits there",
               "write two paths, one for each way");
}

Diagnostic fillet_too_large(const Span& span, const std::string& what, double radius, double most) {
  const std::string fits = at_most(most, "m");
  return with_replacement(
      error("E419", span,
            "the fillet of " + figure(radius, "m") + " does not fit " + what + ": its lines are too short",
            "at most `" + fits + "`"),
      fits);
}

Diagnostic no_axis_of_a_path(const Span& span, const std::string& group, const std::string& word,
                             const std::string& move, const std::string& path) {
  const std::string own = word == "speed" || word == "plane" ? "world" : move;
  return error(
      "E420", span,
      "`" + group + "." + word + "` is no axis of the path `" + path + "`: it has `x`, `y`, `z` and `rz`",
      "write `" + word + "` in a group of its own: `{move: " + move + ", in: " + own + ", " + word +
          ": ..}`");
}

Diagnostic rigid_path(const Span& span, const std::string& move, const std::string& path) {
  return error("E412", span,
               "`" + move + "` never moves along the path `" + path + "`: one link carries both",
               "give the path a `parent` that does not move with `" + move + "`: `world`");
}

Diagnostic fillet_beyond_norm(const Span& span, const Fillet& f, const Span& norm, const Span& declared) {
  const double needed = f.speed * f.speed / f.radius;
  return with_related(
      with_related(warning("W615", span,
                           figure(f.speed, "m/s") + " around a fillet of " + figure(f.radius, "m") +
                               " needs " + figure(needed, "m/s^2") + ", `" + f.norm + "` allows " +
                               figure(f.most, "m/s^2") + ": the base leaves the path",
                           "drive with `" + at_most(std::sqrt(f.most * f.radius), "m/s") + "`, or give `" +
                               f.path + "` a fillet of `" + at_least(f.speed * f.speed / f.most, "m") + "`"),
                   norm, "the norm of the acceleration is limited here"),
      declared, "the path is declared here");
}

Diagnostic fillet_beyond_push(const Span& span, const Fillet& f, const FilletPush& push, const Span& norm,
                              const Span& declared) {
  const double needed = push.mass * f.speed * f.speed / f.radius;
  const std::string effect =
      push.off > 0.0 ? "while its casters turn, the base comes off the path by some " + figure(push.off, "m")
                     : "the base is slower, or leaves the path";
  return with_related(
      with_related(
          warning("W615", span,
                  figure(f.speed, "m/s") + " around a fillet of " + figure(f.radius, "m") + " takes up to " +
                      figure(needed, "N") + " (" + figure(push.mass, "kg") + " x " +
                      figure(f.speed * f.speed / f.radius, "m/s^2") + "), `" + f.norm + "` allows " +
                      figure(f.most, "N") + ": " + effect,
                  "drive with `" + at_most(push.slow, "m/s") + "`, give `" + f.path + "` a fillet of `" +
                      at_least(push.wide, "m") + "`, or allow `" + at_least(push.strong, "N") + "`"),
          norm, "the norm of the force is limited here"),
      declared, "the path is declared here");
}

Diagnostic heading_left_over(const Span& span, const std::string& axis, const std::string& move,
                             double length) {
  const std::string rate =
      length > 0.0 ? ": to a third after each " + figure(length, "m") + " of the way" : std::string();
  return make("N622", Severity::note, span,
              "`" + axis + "` gets nothing: x and y of `" + move +
                  "` take both freedoms of this base. Its heading turns into the path by itself" + rate,
              "leave `" + axis + "` out, or keep it for bases with three freedoms");
}

}  // namespace zwang::lang::wording
