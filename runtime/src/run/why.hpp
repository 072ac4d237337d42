/// From the transitions of a run to the one that decided its end, and from there to why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/limit_table.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/runtime/scheduler.hpp"
#include "zwang/runtime/why.hpp"

namespace zwang::runtime {

/// The transition after which `done` could no longer be reached. Does not allocate, lock, throw or print.
class TurningPoint {
 public:
  /// Every transition of the run; `limits` as the tick before left them.
  void look(const Transition& transition, const Scheduler& scheduler, const LimitTable& limits) noexcept;

  const std::optional<Transition>& found() const noexcept { return found_; }
  /// Some task of the way so far led to `done`. A patrol has none: it waits in any case.
  bool leads_to_done() const noexcept { return leads_to_done_; }
  /// The one through which the task was entered that was left then.
  const std::optional<Transition>& entry() const noexcept { return entry_; }
  const LimitTable::Tightest& limit() const noexcept { return limit_; }

 private:
  std::optional<Transition> found_, entry_, last_;
  LimitTable::Tightest limit_;
  bool leads_to_done_ = false;
};

/// A signal whose samples came and could not be taken.
struct RefusedSignal {
  std::string name;
  double ahead = 0.0;  ///< [s] of its stamp; 0 where the stamp is not the reason
};

/// The facts of a runner that `why_of` needs.
struct EndOfRun {
  const Scheduler& scheduler;
  const TurningPoint& turning_point;
  bool is_decided = false;           ///< by the turning point; else by the stop, or it goes on
  std::string file;                  ///< of the task, as places name it
  double time = 0.0;                 ///< [s] of the last sample
  std::optional<LimitReport> limit;  ///< that was at its limit when it was decided
  std::string limit_keeps;           ///< of a region: "`footprint` inside `ward`"
  std::string stop;                  ///< what latched the protective stop; empty: it is not latched
  std::vector<RefusedSignal> refused;
  std::vector<std::string> met;   ///< in words: wheels that slide, a region left
  std::vector<std::string> told;  ///< the guard's other reports while the task was active, in words
};
Why why_of(const EndOfRun& end);

/// Which frame left its range or its region, when, and by how much. `told` has the distance at first;
/// `limits`, of the run, know the largest one.
std::string words_of_excursion(const Statement& row, const Event& told, bool at_start,
                               const std::vector<LimitReport>& limits);

/// The words of `Why::sentence`.
struct WhyWords {
  const EndOfRun& end;
  std::string place(const lang::Span& span) const;
  static std::vector<std::string> missing(const WaitedExit& exit);
  std::string of_terms(const WaitedExit& exit) const;
  std::string of_exit(const WaitedExit& exit) const;
  std::string of_waiting(const WaitedTask& task) const;
  /// [s] that the exit needs at the pace of late; none: it does not come nearer.
  static std::optional<double> time_left(const WaitedExit& exit);
  /// Those that lead on; where none does, all.
  static std::vector<WaitedExit> leading(const WaitedTask& task);
};

}  // namespace zwang::runtime
