/// Diagnostics of a base that could tip over, lose its grip or hit something: E640, W640, W642, W644, N603.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// `outside`: of the mass beyond the supports [m], or 0 on their edge. `has_supports`: the robot file names
/// some.
Diagnostic falls_over(const Span& span, const std::string& base, double outside, bool has_supports);
/// The mass lies `inside` [m] the supports and `height` [m] above the floor. A floor that leans by `lean`
/// [rad] tips it.
Diagnostic stands_on_edge(const Span& span, const std::string& base, double inside, double height,
                          double lean);
/// `asked`, `tips` [m/s^2]; the mass lies `inside` [m] its supports and `height` [m] above the floor.
Diagnostic tips_by_acceleration(const Span& span, const std::string& axis, double asked, double tips,
                                double inside, double height);
/// `asked`, `tips` [m/s^2]
Diagnostic tips_by_stop(const Span& span, double asked, double tips);
/// `asked`, `tips` [N] at the bumper's `height` [m]
Diagnostic tips_by_push(const Span& span, const std::string& axis, double asked, double tips, double height);
/// `asked` [N] tips the base `from` this height [m] on, and nobody says how high the bumper is.
Diagnostic unknown_bumper_height(const Span& span, const std::string& axis, double asked, double from);
/// An object that a bumper of unknown height may pass. `height` of the object, `assumed` of the bumper. [m]
Diagnostic meets_or_passes(const Span& span, const std::string& base, const std::string& object,
                           double height, double assumed);
/// A bumper above all objects of the scene. `height` of the highest, `bumper` [m].
Diagnostic passes_all(const Span& span, const std::string& base, const std::string& object, double height,
                      double bumper);
/// `asked`, `held` [m/s^2]: the stop's brake, and what the floor holds.
Diagnostic stops_beyond_the_floor(const Span& span, double asked, double held, double friction);
/// `asked`, `held` [N]: the floor's friction times `load` [N].
Diagnostic beyond_the_floor(const Span& span, const std::string& axis, double asked, double held,
                            double friction, double load);

struct Impact {
  double mass = 0.0;       ///< [kg]
  double speed = 0.0;      ///< [m/s]
  double stiffness = 0.0;  ///< [N/m] of all points
  double peak = 0.0;       ///< [N]
  std::string object;      ///< that is struck; empty: the robot's own bumper
  int points = 1;          ///< that strike together
  bool is_bound = false;   ///< the speed is the most that it may be
  bool is_most = false;    ///< so is the peak
  double at_end = 0.0;     ///< [N] at most, where the object gives way no farther; 0: it never is there
  double in_steps = 0.0;   ///< [N] what the simulation feels at most; 0: the same
  std::vector<std::string> uncounted;  ///< what may make it harder
};
/// `allowed` [N] 0: nothing bounds the force.
Diagnostic first_hit(const Span& span, const std::string& axis, const Impact& hit, double allowed,
                     double gentle_speed);

}  // namespace zwang::lang::wording
