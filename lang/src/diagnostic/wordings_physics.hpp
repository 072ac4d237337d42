/// Diagnostics of a robot that cannot do what a file asks: E404, E406, W407 and the 600s.
#pragma once

#include <limits>
#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// `18.0 N`, `0.08 m/s`: three significant digits.
std::string figure(double value, const std::string& unit);
/// Not above the value, and not below it: a number that is offered in the place of another must do.
std::string at_most(double value, const std::string& unit);
std::string at_least(double value, const std::string& unit);
std::string angle_in_degrees(double radians);

Diagnostic held_axis(const Span& span, const std::string& axis);
/// `frame_ahead`: a frame that could be driven along this axis, as it is written; empty when there is none.
Diagnostic axis_held_by_wheels(const Span& span, const std::string& axis, const std::string& frame_ahead);
/// `can_turn`: what cannot go sideways can be turned and driven ahead.
Diagnostic no_motor_along(const Span& span, const std::string& axis, bool can_turn);
/// No motor pushes along an axis of `in`, a frame of the world, at the headings where the axis lies across
/// the base.
Diagnostic no_motor_across(const Span& span, const std::string& axis, const std::string& in, bool can_turn);
Diagnostic tied_axes(const Span& span, const std::string& axis, const std::string& move, int freedoms,
                     const std::string& frame_ahead);
Diagnostic too_many_rows(const Span& span, int rows, int level, int freedoms, bool is_base,
                         const std::string& frame_ahead);
/// `twin`: the one axis that already says the same; empty when it takes several.
Diagnostic redundant_row(const Span& span, const std::string& axis, const std::string& twin,
                         const Span& twin_span);
/// A row of `level` above takes the motion whole.
Diagnostic taken_above(const Span& span, const std::string& axis, const std::string& above, int level,
                       const Span& above_span);

/// `axis` is a path; `says` what of it is a force: "presses", "has a force range".
Diagnostic cannot_feel(const Span& span, const std::string& axis, const std::string& says, double push,
                       const Span& motor);
Diagnostic pushes_fully(const Span& span, double push, const Span& motor);  ///< [N]

/// A force driver and what an acceleration range leaves of it.
struct Cap {
  std::string axis;
  bool turns = false;
  double wanted = 0.0;                                      ///< [N] or [N m]
  double most = 0.0;                                        ///< [N] or [N m]
  double mass = 0.0;                                        ///< effective [kg] or [kg m^2]
  double motors = std::numeric_limits<double>::infinity();  ///< that they make at most [N] or [N m]
};
Diagnostic cannot_press(const Span& span, const Cap& cap, const Span& limit);
/// By the range of velocities, which the drive keeps within `horizon` [s].
Diagnostic too_slow_to_press(const Span& span, const Cap& cap, double horizon, const Span& range);
Diagnostic cannot_press_everywhere(const Span& span, const Cap& least, const Span& limit);
Diagnostic cannot_press_at_range_end(const Span& span, const Cap& cap, const Span& limit);

/// `time_constant`: with which the range would be reached [s]; 0 where the driver has none that matters.
Diagnostic dead_guard(const Span& span, const std::string& axis, bool turns, double mass, double acceleration,
                      double pressed, double time_constant, const Span& guard);

struct Braking {
  double speed = 0.0;          ///< [m/s] or [rad/s]
  double time_constant = 0.0;  ///< [s]
  double peak = 0.0;           ///< [m/s^2] or [rad/s^2]
  double allowed = 0.0;        ///< [m/s^2] or [rad/s^2]
  double mass = 0.0;           ///< [kg] or [kg m^2]
  bool by_force = false;       ///< a force range allows it, over the mass
  std::string sum;             ///< the path of the force range, where it is one of the sum of all rows
};
Diagnostic brakes_too_hard(const Span& span, const std::string& axis, bool turns, const Braking& braking,
                           double enough);
Diagnostic faster_than_the_tick(const Span& span, const std::string& axis, double time_constant,
                                double period, double least);
/// The damping and the stiffness of a spring on the mass. SI
Diagnostic damped_too_hard(const Span& span, const std::string& axis, bool turns, double mass, double period,
                           double most);
Diagnostic too_stiff(const Span& span, const std::string& axis, bool turns, double mass, double period,
                     double most);

Diagnostic force_budget(const Span& span, const std::string& axis, bool turns, double own,
                        const std::string& others, double added);
/// `mass` 0: the driver asks for the force itself.
Diagnostic beyond_the_motors(const Span& span, const std::string& axis, bool turns, double asked, double most,
                             double mass, double time_constant, bool always);
Diagnostic boundary_not_held(const Span& span, const std::string& axis, bool turns, double mass,
                             double braking, double force, double enough);

/// `own`: the base's axis that no motor pushes along.
Diagnostic boundary_askew(const Span& span, const std::string& axis, const std::string& own);

/// `elsewhere`: its wheels hold it where they stand at the start, and not however they are steered.
Diagnostic free_and_held(const Span& span, const std::string& axis, bool elsewhere);

/// `limit`: whose range it is; empty: the driver's own axis. `quantity`: what the range allows nothing of.
Diagnostic stands_still(const Span& span, const std::string& axis, const std::string& limit,
                        const std::string& quantity, const Span& range);

/// `asked`: the distance that is asked for; `height`: between the two points, which keep it. [m]
Diagnostic vanishing_distance(const Span& span, const std::string& axis, double asked, double height);

/// `limited`: the axis of the base whose force is limited, at `limit`.
Diagnostic holds_all_askew(const Span& span, const std::string& axis, const std::string& in,
                           const std::string& own_axis, int later_level, const std::string& other,
                           const Span& other_span);
Diagnostic arm_without_limit(const Span& span, const std::string& axis, const std::string& frame,
                             const std::string& limited, const Span& limit);

/// From this task on nothing was asked of the robot's model.
Diagnostic unasked(const Span& span, const std::string& task);

}  // namespace zwang::lang::wording
