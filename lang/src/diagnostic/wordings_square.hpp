/// Diagnostics of a base that a wall is to square up.
#pragma once

#include <string>

#include "diagnostic/wordings_physics.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// `floor` 0: the wheels hold the heading. [N m]. `exit`: that asks for it; none: W621. `is_doubtful`: a hit
/// may turn the base square, W621.
Diagnostic cannot_square(const Span& span, const std::string& axis, double floor, double wall,
                         const Span& exit, bool is_doubtful);
/// `askew` [rad]: as far as that the outline rests on a wall.
Diagnostic rests_askew(const Span& span, const std::string& axis, double askew, const Span& exit);

/// The ways in which a base that comes askew to a wall does not rest square.
enum class Askew {
  held,         ///< it stays as it came
  slowed,       ///< a row lets it turn, more slowly than an exit asks for
  turned_away,  ///< it turns on along the wall
  rests,        ///< it rests at another angle
};
/// That may turn it square yet.
enum class Unless { nothing, hit, friction, slides };
/// A base that comes to a wall `from` [rad].
struct ComesAskew {
  bool is_sure = false;  ///< it comes so in the scene, or no angle helps: E621; else W621
  double from = 0.0;     ///< [rad]
  Askew how = Askew::held;
  double rests_at = 0.0;  ///< [rad]
  double friction = 0.0;  ///< of the wall, which holds the corner that touches
  double held = 0.0;      ///< [N m] with which the floor holds the heading
  double row = 0.0;       ///< [N m] below which a row makes it seem to rest
  Unless unless = Unless::nothing;
  double by_hit = 0.0;  ///< [rad] by which a hit turns it at most
  double most = 0.0;    ///< [rad] from which the base still squares up; 0: from nowhere
  std::string tip;      ///< of an arm, that touches before the outline; empty: the outline does
};
Diagnostic comes_askew(const Span& span, const std::string& axis, const ComesAskew& coming, const Span& exit);

}  // namespace zwang::lang::wording
