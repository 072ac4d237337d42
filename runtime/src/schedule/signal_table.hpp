/// The signals of a program: what was measured last, how old that is, and where a pose signal stands in the
/// world.
#pragma once

#include <vector>

#include "schedule/frame_table.hpp"
#include "schedule/pose_line.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

/// It is of the signal's type, its numbers are finite, and what turns something is a rotation.
bool is_sound(const SignalSample& sample, lang::SignalType type) noexcept;

/// [N] or [N m]
double part_of(const solver::ForceVector& wrench, lang::WrenchPart part) noexcept;

/// How a signal stands.
struct SignalState {
  bool received = false;
  bool known = false;
  double age = 0.0;  ///< [s]
};

class SignalTable {
 public:
  SignalTable(const lang::Program& program, double period);

  /// Takes in the snapshot: keeps what is new, and marks what is stale. `frames` has the poses of this
  /// instant; a new sample of a pose signal moves the frames that hang on it.
  void update(const Sensed& sensed, const std::vector<double>& parameters, FrameTable& frames) noexcept;

  bool known(int signal) const noexcept { return at(signal).received && !at(signal).stale; }
  bool received(int signal) const noexcept { return at(signal).received; }  ///< at least once
  /// Older than its `stale_after`; one that was never received ages from the start of the run.
  bool stale(int signal) const noexcept { return at(signal).stale; }
  const lang::Signal& declared(int signal) const noexcept { return at(signal).declared; }
  double age(int signal) const noexcept { return at(signal).age; }  ///< [s]
  SignalState state(int signal) const noexcept { return {at(signal).received, known(signal), age(signal)}; }
  /// Of a number [SI] or a boolean (0, 1); not a number while the signal is not known.
  double value(int signal) const noexcept;
  /// A number of a wrench [N] or [N m], likewise.
  double part(int signal, lang::WrenchPart part) const noexcept;
  /// The latest valid sample, whether it is stale or not.
  const SignalSample& sample(int signal) const noexcept { return at(signal).last; }

 private:
  /// Where the frame that a pose signal is seen from was, over the last `stale_after`.
  struct Past {
    double time = 0.0;
    solver::Pose pose;
  };
  struct Entry {
    lang::Signal declared;
    SignalSample last;
    bool received = false;
    bool stale = false;
    double age = 0.0;
    std::vector<Past> past;  // a ring
    std::size_t newest = 0;
    std::size_t past_count = 0;
    PoseLine line;               // of a twist that is fitted
    solver::FrameMotion course;  // at the last sample, of a signal with a twist
    bool moves = false;          // its frame goes on along the course
  };
  const Entry& at(int signal) const noexcept { return entries_[static_cast<std::size_t>(signal)]; }
  static void remember(Entry& entry, double time, const solver::Pose& pose) noexcept;
  static solver::Pose pose_then(const Entry& entry, double time) noexcept;
  static bool is_new(const Entry& entry, const SignalSample& sample, double latest) noexcept;
  void take(int index, const SignalSample& sample, FrameTable& frames) noexcept;
  void take_course(Entry& entry, const solver::Pose& seen_from) noexcept;
  void go_on(int index, double time, FrameTable& frames) noexcept;

  std::vector<Entry> entries_;
  double period_;
  double start_ = 0.0;
  bool started_ = false;
};

}  // namespace zwang::runtime
