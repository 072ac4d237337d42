/// The control loop of `zwang drive`.
#pragma once

#include <cstdint>
#include <optional>

#include "control.hpp"
#include "inbox.hpp"
#include "lateness.hpp"
#include "outbox.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::connect {

struct DriveReport {
  Lateness lateness;
  std::uint64_t skipped = 0;      ///< cycles that were missed, and not caught up
  std::uint64_t unsent = 0;       ///< commands that DDS did not take within a millisecond
  std::uint64_t without_new = 0;  ///< ticks for which no new sample had come
  double elapsed = 0.0;           ///< [s]
  double first_sample = 0.0;      ///< [s] its stamp: the events' times count from 1970, too
  /// [s] from the last sample's arrival to the stop, where silence has caused it.
  std::optional<double> silence;
  bool ended_early = false;  ///< by a signal, before the base was known to stand
};

/// Until the run is finished, or a signal asks for the end. A drive that takes torques ticks with the samples
/// of its joints; one that takes velocities by the clock. The tick calls nothing of DDS but a write that is
/// handed over. Afterwards zeros have been sent.
void drive(const lang::Connection& connection, const lang::Program& program, Inbox& inbox, Outbox& outbox,
           Control& control, runtime::Runner& runner, DriveReport& report);

}  // namespace zwang::connect
