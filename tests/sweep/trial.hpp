/// Runs what was drawn in the closed loop, and judges it by the plant.
#pragma once

#include <optional>
#include <string>

#include "draw.hpp"

namespace zwang::sweep {

struct Result {
  std::string outcome;            ///< done, failed, stopped, unfinished
  std::string reason;             ///< of a stop
  std::string task;               ///< in force at the onset
  double encoder_step = 0.0;      ///< [rad] 0: exact positions
  std::optional<double> onset;    ///< [s] of the fault; none: the run was over before
  std::optional<double> stopped;  ///< [s]
  // By the plant, from the onset on.
  double speed_at_onset = 0.0;  ///< [m/s]
  double speed = 0.0;           ///< [m/s] the most
  double force = 0.0;           ///< [N] the most on one object
  double moved = 0.0;           ///< [m] the farthest that the base got from where it was
  // Of the bounds.
  double speed_bound = 0.0;  ///< [m/s] the task's, or what the base had at the onset, and a tenth
  double force_bound = 0.0;  ///< [N] of a hit at that speed: F + v sqrt(K m) of two corners

  bool is_faulty() const { return onset.has_value(); }
  bool is_false_stop() const { return !is_faulty() && stopped.has_value(); }
  bool breaks_a_bound() const { return is_faulty() && (speed > speed_bound || force > force_bound); }
  bool is_hooked = false;  ///< at the end, by the plant
  int probed = 0;          ///< times that a look found the encoders alive
  /// `done` of a base that lost its encoders and then moved: in a held press, or in a dock, nothing does.
  bool is_untrue() const { return is_faulty() && outcome == "done" && moved > held && !is_hooked; }
  static constexpr double held = 1e-3;  ///< [m]
};

Result run(const Drawn& drawn);

}  // namespace zwang::sweep
