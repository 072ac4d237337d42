/// Diagnostics of connection files.
#pragma once

#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

Diagnostic bad_topic(const Span& span, const std::string& name);
/// `is_scan`: a LaserScan without `nearest`; else `nearest` beside another type.
Diagnostic nearest_of_a_scan(const Span& span, bool is_scan);
Diagnostic signal_without_source(const Span& span, const std::string& name, const std::string& connection);
Diagnostic signal_of_another_type(const Span& span, const std::string& name, const std::string& type,
                                  const Span& declared);
Diagnostic output_without_sink(const Span& span, const std::string& name, bool is_number,
                               const std::string& connection);
Diagnostic output_of_another_type(const Span& span, const std::string& name, const std::string& type,
                                  const Span& declared);
/// `nearest` with its angles the wrong way round.
Diagnostic nearest_of_nothing(const Span& span);
Diagnostic feeling_without_topic(const Span& span);
Diagnostic topic_twice(const Span& span, const std::string& name, const Span& first);
Diagnostic name_twice(const Span& span, const std::string& name, const Span& first);
Diagnostic one_command(const Span& span);
Diagnostic wrong_command(const Span& span, const std::string& what, const std::string& help);
Diagnostic two_fixes(const Span& span);
Diagnostic frame_in_itself(const Span& span, const std::string& frame);
/// A frame that `publish` places and `fix` looks for.
Diagnostic told_and_heard(const Span& span, const std::string& frame, const Span& fix);
/// `reach: []`.
Diagnostic reach_of_nothing(const Span& span);
/// `cycle` [s] between two commands.
Diagnostic too_short_timeout(const Span& span, double cycle);
/// `stale_after` [s] beyond `given_up_after`.
Diagnostic stale_too_late(const Span& span, double stale_after);
/// `sampled` [s] between two samples of the robot, at least.
Diagnostic stale_at_once(const Span& span, double stale_after, double sampled);
/// `rate` [1/s] above that of the ticks, `period` [s].
Diagnostic rate_too_high(const Span& span, double rate, double period);
/// `rate` below that on which the robot file's drive counts. [1/s]
Diagnostic rate_below_drive(const Span& span, double rate, double of_drive);
/// `rate` [1/s] so low that a stop leaves later than `stale_after` [s].
Diagnostic rate_too_low(const Span& span, double rate, double stale_after);
Diagnostic tasks_without_goals(const Span& span);
Diagnostic nothing_stops_it(const Span& span, const std::string& topic);
/// A receiver's `timeout` [s] beyond `given_up_after`.
Diagnostic stopped_too_late(const Span& span, double timeout);
/// Held for `timeout` [s], the motors' torques bring the base to `speed` [m/s] within `within` [s].
Diagnostic torque_held_too_long(const Span& span, double timeout, double speed, double within);

}  // namespace zwang::lang::wording
