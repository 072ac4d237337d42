/// A drawn run: which robot does what, where, and what goes wrong.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "zwang/lang/program.hpp"

namespace zwang::sweep {

/// Numbers that a seed fixes on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  double uniform(double low, double high);
  /// Evenly spread over the powers of ten.
  double log_uniform(double low, double high);
  int below(int count);

 private:
  std::uint64_t next();
  std::uint64_t state_;
};

enum class EncoderFault {
  none,
  dead,    ///< positions stay, rates are 0
  frozen,  ///< the whole state stays
};

/// When a fault begins: at a time, or so long after the entry into the task number `entry` of the run.
struct Onset {
  int entry = -1;      ///< counted from 0, the start; -1: from the start of the run
  double after = 0.0;  ///< [s]
};

struct Drawn {
  std::string name;  ///< "docking.yaml on diff_base, dock"
  lang::Program program;
  double time_limit = 0.0;    ///< [s] of the run
  double speed = 0.0;         ///< [m/s] most that the task allows
  double force = 0.0;         ///< [N] most that it presses with
  double encoder_step = 0.0;  ///< [rad]; 0: exact positions
  EncoderFault fault = EncoderFault::none;
  Onset onset;
  std::uint64_t seed = 0;  ///< of the plant's noise
  /// [s] from the onset on until the pressed object is gone. The onset lies in a press, at `press_share` of
  /// all the presses of a healthy run. Negative: objects stay.
  double leaves_after = -1.0;
  double press_share = 0.0;
};

enum class Which {
  all,
  healthy,
  faulty,
  others,  ///< tasks with an arm, objects that give way, paths and people, with a fault: what docs/limits.md
           ///< states
  sound_others,  ///< the same tasks without a fault
  released,      ///< encoders fail in a held press, and up to 1 s later nothing is left to press on
  starts,  ///< not drawn: encoders that fail 0 to 0.4 s after a base sets out to a wall, `start_count` runs
};
inline constexpr int start_count = 88;

/// Run number `index` of the sweep. Throws std::runtime_error where a shipped file does not load.
Drawn draw(std::uint64_t seed, int index, Which which);

}  // namespace zwang::sweep
