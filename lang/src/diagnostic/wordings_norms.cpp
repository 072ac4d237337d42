#include "diagnostic/wordings_norms.hpp"

#include "diagnostic/make.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "words/units.hpp"

namespace zwang::lang::wording {

Diagnostic circle_beyond_norm(const Span& span, const Circle& c, const Span& norm) {
  return with_related(warning("W615", span,
                              figure(c.speed, "m/s") + " at " + figure(c.rate, "rad/s") + " needs " +
                                  figure(c.speed * c.rate, "m/s^2") + ", `" + c.norm + "` allows " +
                                  figure(c.most, "m/s^2") + ": the base will be slower",
                              "turn with `" + figure(c.most / c.speed, "rad/s") + "`, or drive with `" +
                                  figure(c.most / c.rate, "m/s") + "`"),
                      norm, "the norm of the acceleration is limited here");
}

Diagnostic box_for_norm(const Span& span, const Box& b, const Span& other) {
  const char* unit = b.is_force ? "N" : "m/s^2";
  const std::string word = b.is_force ? "force" : "acceleration";
  const std::string most = figure(b.most, unit);
  return with_related(warning("W641", span,
                              "`" + b.x + "` and `" + b.y + "` together allow " +
                                  figure(b.most * 1.41421356237, unit) + " at 45 deg",
                              "if " + most + " are meant in any direction, write `plane: {" + word + ": [0 " +
                                  unit + ", " + most + "]}`"),
                      other, "the other range");
}

}  // namespace zwang::lang::wording
