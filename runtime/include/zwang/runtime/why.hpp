/// Why a run is not `done`: what its task waited for, in numbers and in one sentence.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/source.hpp"

namespace zwang::runtime {

/// The value of a condition.
enum class Verdict { no, yes, unknown };
ZWANG_EXPORT const char* to_string(Verdict verdict) noexcept;  ///< "false", "true", "unknown"

/// A signal that a term hangs on.
struct WaitedSignal {
  std::string name;
  bool received = false;     ///< a valid sample has come
  double age = 0.0;          ///< [s]; since the start of the run where none has come
  double stale_after = 0.0;  ///< [s] the age at which it counts as invalid
  bool refused = false;      ///< samples came that could not be taken
  double ahead = 0.0;        ///< [s] of a refused sample's stamp; 0 where the stamp is not the reason
};
/// "`partner` was never received", or how long ago its last sample came, or why it was refused.
ZWANG_EXPORT std::string in_words(const WaitedSignal& signal);

/// A comparison of a condition, or a name in it that is true or false.
struct WaitedTerm {
  std::string text;  ///< as written: "abs(contact.x.velocity) < 5 mm/s"
  Verdict verdict = Verdict::unknown;
  bool holds_back = false;      ///< the condition would be nearer to true if this term were another
  std::optional<double> value;  ///< of the side that is not a constant; SI
  std::optional<double> bound;  ///< of the other side, where that is no constant either; SI
  std::string unit;
  std::vector<WaitedSignal> signals;  ///< that are not known, and make the term unknown or `valid()` false
  std::string because;                ///< of an unknown that hangs on no signal
  std::optional<double>
      left;            ///< [s] until it is as wanted, at its pace of late; none: it does not come nearer
  double stood = 0.0;  ///< [s] for so long its value has been what it is, to a hundredth of what it misses
  bool stood_throughout = false;  ///< since the task was entered
  bool recedes = false;           ///< the value goes away from what is wanted
  std::string asked;  ///< of a coordinate that stood: what drives it, in words; empty: no coordinate
};

/// An exit, or a `require`, with the last values of its terms.
struct WaitedExit {
  std::string column;  ///< of the log: "press.exit1.true_for"; empty of a `require`
  std::string when;    ///< as written, in one line
  std::string target;  ///< "hold", "back", "done"
  lang::Span span;
  bool can_reach_done = false;  ///< `done` can be reached from the target
  Verdict verdict = Verdict::unknown;
  double true_for = 0.0;  ///< [s] without a break, until now
  double longest = 0.0;   ///< [s] the longest of them since the task was entered
  int times = 0;          ///< that it became true since then
  double needed = 0.0;    ///< [s] its `for`
  std::vector<WaitedTerm> terms;
};

/// A task and its exits, as they stood when the task was left; of a task that goes on, as they stand.
struct WaitedTask {
  std::string task;
  double elapsed = 0.0;  ///< [s] since it was entered, interruptions left out
  std::vector<WaitedExit> exits;
};

/// The cause that keeps the run from `done`.
enum class WhyCause {
  waiting,      ///< nothing yet: the run goes on, or was ended from outside
  timeout,      ///< of the task
  exit,         ///< one of the task's own exits, to where `done` cannot be reached from
  always,       ///< an exit of `always`, to where `done` cannot be reached from
  require,      ///< of the task that was to be entered
  attempts,     ///< of the task that was to be entered
  set,          ///< of a frame on the way to the task, whose pose was not known
  never_stood,  ///< the brake did not bring the base to rest
  stopped,      ///< the protective stop
};
ZWANG_EXPORT const char* to_string(WhyCause cause) noexcept;

/// The reason, as numbers and as a sentence.
struct Why {
  WhyCause cause = WhyCause::waiting;
  double time = 0.0;              ///< [s] when it was decided; while nothing is, of the last sample
  WaitedTask waited;              ///< the task that was active then
  std::optional<WaitedExit> met;  ///< the exit that was taken, or the `require` that did not hold
  std::string limit;     ///< the limit that the tick before was at, a column of the log; may be empty
  std::string sentence;  ///< all of it, without an end: "`align` waited 30.00 s, its timeout ..."
};

}  // namespace zwang::runtime
