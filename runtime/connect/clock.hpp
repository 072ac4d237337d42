/// The clock of `zwang drive` and `zwang simulate`.
#pragma once

namespace zwang::connect {

/// [s] of the clock that stamps go by, from 1970. It runs evenly within a process: no leap, no correction.
double now() noexcept;
/// Sleeps until `now` is `time` [s]; not at all where it is.
void sleep_until(double time) noexcept;

}  // namespace zwang::connect
