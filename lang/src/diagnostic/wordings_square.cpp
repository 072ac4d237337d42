#include "diagnostic/wordings_square.hpp"

#include <cmath>
#include <numbers>

#include "diagnostic/make.hpp"

namespace zwang::lang::wording {

namespace {

std::string askew_figure(double angle) {
  return figure(std::abs(angle) * 180.0 / std::numbers::pi, "deg");
}

std::string what_becomes_of(const ComesAskew& coming) {
  if (coming.how == Askew::turned_away) return "turns away from the wall";
  if (coming.how == Askew::rests) return "comes to rest " + askew_figure(coming.rests_at) + " askew";
  if (coming.how == Askew::slowed)
    return "turns more slowly than the exit asks for: against this row it takes " + figure(coming.row, "N m");
  std::string by;
  if (coming.friction > 0.0) by = "the wall's friction of " + figure(coming.friction, "");
  if (coming.held > 0.0)
    by += (by.empty() ? "" : " and ") + std::string("the floor's ") + figure(coming.held, "N m");
  return "stays so: " + by + " hold" + (coming.friction > 0.0 && coming.held > 0.0 ? "" : "s") + " it";
}

std::string unless(const ComesAskew& coming) {
  if (coming.unless == Unless::friction)
    return ", unless the wall's friction of " + figure(coming.friction, "") + " turns it square";
  if (coming.unless == Unless::slides) return ", until it slides along the wall";
  if (coming.unless != Unless::hit) return "";
  const std::string square = ", unless the hit turns it square";
  if (!std::isfinite(coming.by_hit)) return square + ": nothing bounds its speed";
  return coming.by_hit > std::abs(coming.from) ? square
                                               : square + ": by up to " + askew_figure(coming.by_hit);
}

}  // namespace

Diagnostic cannot_square(const Span& span, const std::string& axis, double floor, double wall,
                         const Span& exit, bool is_doubtful) {
  const std::string why = floor > 0.0 ? "a wall turns this base with " + figure(wall, "N m") +
                                            ", and it is held with " + figure(floor, "N m")
                                      : "the wheels hold the heading of this base, and no wall turns it";
  const std::string help = "drive `rz` to a measured angle, or take a base that a wall can turn";
  if (!exit.exists()) return warning("W621", span, "`" + axis + "` is free, but " + why, help);
  const std::string message = "`" + axis + "` cannot tell square from stuck: " + why;
  return with_related(is_doubtful ? warning("W621", span, message + ", unless the hit turns it square", help)
                                  : error("E621", span, message, help),
                      exit, "this is true of a base that is stuck, too");
}

Diagnostic rests_askew(const Span& span, const std::string& axis, double askew, const Span& exit) {
  return with_related(
      error("E621", span,
            "`" + axis +
                "` cannot tell square from stuck: this outline is round ahead, and rests on a wall " +
                askew_figure(askew) + " askew",
            "drive `rz` to a measured angle, or take a base that is flat ahead"),
      exit, "this is true of a base that rests askew, too");
}

Diagnostic comes_askew(const Span& span, const std::string& axis, const ComesAskew& coming,
                       const Span& exit) {
  const std::string first =
      coming.tip.empty() ? "" : "`" + coming.tip + "` reaches ahead of the outline and touches first, and ";
  const std::string message = "`" + axis + "` cannot tell square from stuck: " + first + "from " +
                              askew_figure(coming.from) + " askew the base " + what_becomes_of(coming) +
                              unless(coming);
  std::string help = coming.tip.empty() ? "" : "fold the arm by `posture`, draw the `footprint` around it, ";
  if (coming.most > 0.0 && coming.tip.empty())
    help += "come at most " + askew_figure(coming.most) + " askew, ";
  help += coming.tip.empty() ? "drive `rz` to a measured angle, or take a base that is wider ahead"
                             : "or drive `rz` to a measured angle";
  return with_related(
      coming.is_sure ? error("E621", span, message, help) : warning("W621", span, message, help), exit,
      "this is true of a base that rests askew, too");
}

}  // namespace zwang::lang::wording
