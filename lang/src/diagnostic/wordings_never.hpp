/// Diagnostics of files that read well and cannot work. Ranges exclude each other, exits never come, loops
/// have no way out, or forces are never reached.
#pragma once

#include <string>
#include <vector>

#include "diagnostic/wordings_physics.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang::wording {

/// The range that a path keeps to. With low = high, the value that it asks for. SI.
struct Bound {
  std::string path;
  std::string quantity;  ///< "velocity"
  std::string unit;
  double low = 0.0, high = 0.0;
};
Diagnostic excluding_ranges(const Span& span, const Bound& own, const Bound& other, const Span& other_span);
/// Velocities along two axes of one frame, whose norm is beyond a range.
Diagnostic beyond_a_norm(const Span& span, const std::string& one, const std::string& other, double together,
                         const Bound& norm, const Span& norm_span);
Diagnostic beyond_a_range(const Span& span, const Bound& asked, const Bound& range, const Span& range_span);

/// A driver of position, beside a range of velocities that has no 0.
Diagnostic never_stands(const Span& span, const std::string& asked, const Bound& range,
                        const Span& range_span);

/// `task` comes first in the text; the names of all that follow each other. Not empty.
Diagnostic no_way_out(const Span& span, const std::vector<std::string>& tasks);
Diagnostic to_and_fro(const Span& span, const std::string& from, const std::string& to, const Span& there);

/// `parent` carries the region that group `group` is to stay inside, and `move` as well.
Diagnostic boundary_rides_along(const Span& span, const std::string& group, const std::string& region,
                                const std::string& parent, const std::string& move, const Span& declared);
/// `what` is an object that says `fixed: false` and has no mass.
Diagnostic loose_without_mass(const Span& span, const std::string& what);
/// `body`: what a template makes of its argument, `+-$pace`.
Diagnostic negative_width(const Span& span, const std::string& argument, const std::string& body,
                          const Span& body_span);
/// Every task that `always` interrupts, at `there`, is interrupted again when `back` resumes it.
Diagnostic interrupts_again(const Span& span, const std::string& task, const Span& there);
/// `20 N`, in the unit that the parameter was declared with.
std::string in_unit_of(const Parameter& parameter, double value);
/// `rule`: what a use of the parameter asks of it, "`c.x.stiffness` must be above 0". `worst`: a value that
/// it may take, SI. `narrowed`: a range that keeps to the rule; none is known. `from`: where the range
/// stands, or where the value is set; may be nowhere.
Diagnostic breaks_a_use(const Span& span, const std::string& rule, const Parameter& parameter,
                        bool is_negated, double worst, const std::optional<solver::Range>& narrowed,
                        const Span& from, bool from_range);

enum class SetIn { exit, always, entry };
/// `frame` is set from `source`, which needs `signal`. `when`: the exit's condition, as it is written in
/// `condition`; none on entry.
Diagnostic set_from_unknown(const Span& span, const std::string& frame, const std::string& source,
                            const std::string& signal, SetIn in, const Span* when,
                            const std::string& condition);

/// `what` waits for a task that comes later.
Diagnostic not_entered_yet(const Span& span, const std::string& what, const std::string& task);
/// A measured number that the range `by` keeps within [low, high]. SI.
struct Kept {
  std::string what, unit;
  double low = 0.0, high = 0.0;
  std::string by;
  std::string parameter;  ///< that an end of the range is; empty: none
  Span range;
  double time = solver::infinity;  ///< [s] of a way: for so long it goes at most
};
Diagnostic never_true(const Span& span, const Kept& kept);
/// `or_entered`: the task may begin outside of the range, too.
Diagnostic only_from_outside(const Span& span, const Kept& kept, bool or_entered);
Diagnostic always_true(const Span& span, const Kept& kept);
Diagnostic contradicts_itself(const Span& span);
/// Each of its parts leaves out what another one takes.
Diagnostic part_is_always_true(const Span& span);
/// An angle that starts anew at half a turn: a range beyond it, and a target that it is `instead`. [rad]
Diagnostic beyond_half_a_turn(const Span& span, const std::string& axis);
Diagnostic wraps_to(const Span& span, const std::string& axis, double target, double instead);
/// Two regions that hold one base and are `apart` [m].
Diagnostic excluding_regions(const Span& span, const std::string& own, const std::string& other, double apart,
                             const Span& other_span);
/// A range of accelerations above `most` [m/s^2] or [rad/s^2], what the motors make.
Diagnostic beyond_the_motors(const Span& span, const Bound& range, double most);
/// Of `enter.require`: `what` counts from the entry on.
Diagnostic never_on_entry(const Span& span, const std::string& what);
Diagnostic never_in_time(const Span& span, const std::string& by, const Span& end);

/// The force of a blocked driver, and its force range. SI.
struct Unreached {
  std::string axis;
  bool turns = false;
  double mass = 0.0, acceleration = 0.0;
  double pressed = 0.0;        ///< mass x acceleration
  double bound = 0.0;          ///< of the force range
  double velocity = 0.0;       ///< of a velocity driver
  double time_constant = 0.0;  ///< [s]
  double enough = 0.0;         ///< a time constant with which it reaches the bound [s]; 0: none does
  bool by_motors = false;      ///< they make no more than `pressed`
  std::string sum;             ///< a path that bounds the sum of all forces to `pressed`; empty: none
};
/// `limit`: where the acceleration is limited; may be nowhere.
Diagnostic never_reached(const Span& span, const Unreached& unreached, const Span& limit);
/// N619: of a position driver.
Diagnostic limited_range(const Span& span, const Unreached& unreached, const Span& limit);
/// A guard on `saturated`, at `span`, of a driver that has no force range. `motors`: what they make along it.
Diagnostic never_saturated(const Span& span, const Unreached& unreached, double motors);
/// `clipped`: from which way on. [m] or [rad] `sum`: the path of a force range on the sum of all rows, if it
/// clips.
Diagnostic clipped_spring(const Span& span, const Cap& cap, double clipped, const Span& limit,
                          const std::string& sum);

/// A guard on a distance. [m], [m/s]
struct LateGuard {
  std::string signal;
  double distance = 0.0;
  double speed = 0.0;
  double way = 0.0;          ///< to stop
  double reach = 0.0;        ///< of the footprint
  double slow_enough = 0.0;  ///< 0: no speed is
};
/// `limit`: what allows the speed; empty: the robot itself.
Diagnostic stops_too_late(const Span& span, const LateGuard& guard, const std::string& limit,
                          const Span& limit_span);

/// Of driven wheels that swivel by themselves.
Diagnostic hops_along(const Span& span, const std::string& push, const std::string& way, const Span& driven);
/// `left` of `all` freedoms of the base have no row beside the feature's.
Diagnostic leaves_freedoms(const Span& span, const std::string& path, int left, int all);
/// What a task drives by a velocity, and the task `next` has no row for.
struct Coasting {
  std::string task, driver;  ///< "turn", "turn.off.rz"
  double speed = 0.0;        ///< [m/s] or [rad/s]
  bool turns = false;
  std::string next;
};
/// `span`: where the task leads to the next one. `driven`: the driver's value.
Diagnostic coasts_on(const Span& span, const Coasting& coasting, const Span& driven);
Diagnostic steering_stands(const Span& span, const std::string& axis, const std::string& steering,
                           const std::string& link, const std::string& base);

}  // namespace zwang::lang::wording
