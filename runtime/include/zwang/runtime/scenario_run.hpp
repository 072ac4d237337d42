/// Runs one cell of a scenario and judges what was expected of it, by the plant's own measurements.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

/// The result of one expectation.
struct ExpectationResult {
  std::string text;
  lang::Span span;
  bool held = false;
  /// The margin that was left, as a share of the threshold (of `within`, of its time). Negative: it did not
  /// hold.
  std::optional<double> margin;
  /// The figure behind it, which the deciding comparison compares at that time. For `within`, the time taken
  /// [s].
  std::optional<double> value;
  std::string unit;   ///< of `value`, SI
  double time = 0.0;  ///< [s] of the run, when the margin was least
};

/// Another robot of the scene, when the run ended.
struct PartnerResult {
  std::string name;
  std::string outcome;  ///< done, failed, stopped, fallen; unfinished while its task was under way
  std::string because;  ///< of a stop, and of a base that may still move
};

/// The events of a run, for a report that shows it without its log. Long lists are cut.
struct CellStory {
  struct Step {
    double time = 0.0;  ///< [s]
    std::string from;   ///< task; empty at the start
    std::string to;
    std::string why;
  };
  struct Told {
    double time = 0.0;  ///< [s]
    std::string code, signal;
  };
  std::vector<Step> transitions;
  std::vector<Told> events;
  std::uint64_t transition_count = 0, event_count = 0;  ///< all of them
  std::vector<LimitReport> limits;                      ///< the broken ones first, then the least margin
  std::vector<std::array<double, 3>> path;  ///< x, y [m] and yaw [rad] of the base, as the plant has it
};

/// The result of one cell.
struct CellResult {
  std::string name;
  bool passed = false;
  /// Of the first robot, which ends the run: done, failed, stopped, fallen, diverged, refused, unfinished,
  /// error; interrupted when it was told to end
  std::string outcome;
  std::string because;  ///< of a stop or an error, and of a base that may still move; the codes of a refusal
  std::string why;      ///< it is not `done`: what its task waited for, as Why::sentence
  std::vector<PartnerResult> partners;
  double simulated = 0.0;  ///< [s]
  double wall = 0.0;       ///< [s]
  double torque = 0.0;     ///< share of its limit, of the motor that came nearest to it, of any robot
  std::vector<ExpectationResult> expectations;
  CellStory story;
};

/// `codes` are those of the task's errors and warnings. Touches nothing outside of its arguments:
/// cells may run side by side on threads. Once `interrupted` is true, which another thread or a signal sets,
/// it ends within a tick.
ZWANG_EXPORT CellResult run_cell(const lang::Scenario& scenario, const lang::ScenarioCell& cell,
                                 const lang::ScenarioRun& run, const std::vector<std::string>& codes = {},
                                 const std::atomic<bool>* interrupted = nullptr);

}  // namespace zwang::runtime
