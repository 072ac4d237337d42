/// The report of a run: during it and after it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "truth_watch.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::cli {

/// Another robot of the scene, when the run ended.
struct PartnerReport {
  std::string name;
  std::string outcome;  ///< done, failed, stopped, fallen, or unfinished
  std::string because;  ///< of a stop, and of a base that may still move
  std::string task;     ///< that was active; empty when none was
};
/// `base`: as the plant has it.
PartnerReport partner_report(const runtime::ScenePartner& partner, const runtime::BaseTruth& base);

/// A program that ran before the file was loaded again.
struct Chapter {
  double until = 0.0;                              ///< [s]
  const runtime::Runner* runner = nullptr;         ///< as it stood then
  const lang::Diagnostics* diagnostics = nullptr;  ///< of its files
};

/// A fault of the scene, or of the cell of a scenario, that had begun.
struct FaultReport {
  double at = 0.0;  ///< [s]
  lang::Span span;  ///< nowhere: of the cell

  std::string whose() const { return span.exists() ? "the scene" : "the cell"; }
};

struct RunReport {
  std::string outcome;          ///< done, failed, stopped, fallen, diverged; the first robot's
  std::string because;          ///< of a stop; empty otherwise
  bool ended_early = false;     ///< from outside, before the robot stood
  bool may_still_move = false;  ///< no sample has shown the base at rest
  double elapsed = 0.0;         ///< [s]
  double wall_time = 0.0;       ///< [s] that it took
  std::uint64_t seed = 0;
  std::vector<std::string> logs;  ///< of the first robot, one after the other
  std::vector<Chapter> before;
  std::uint64_t records = 0;
  double processor_time = 0.0;      ///< [s] that the run took, with its log
  double log_processor_time = 0.0;  ///< [s] of it, of the threads that write logs
  std::string log_error;            ///< empty when the log is complete
  std::string page;                 ///< path of the page of the run; empty: none was made
  std::vector<AskedForce> asked;
  std::vector<ObjectReport> objects;
  std::vector<PartnerReport> partners;
  std::optional<runtime::Why> why;     ///< none: it is `done`, or the plant ended it
  double x = 0.0, y = 0.0, yaw = 0.0;  ///< [m], [rad] of the base, as the plant has it
  runtime::BaseTruth base;
  HandReport hand;
  std::vector<FaultReport> faults;
};

/// The row that is at its limit, in a line without its end.
std::string live_line(const runtime::Runner& runner, double time);
/// A transition and its reason, likewise.
std::string transition_line(const runtime::Scheduler& scheduler, const runtime::Transition& transition);

/// `done after 11.05 s`, with what was hit and why it is not `done`, in a line without its end.
std::string verdict(const RunReport& report);

std::string human_report(const RunReport& report, const runtime::Runner& runner,
                         const lang::Diagnostics& diagnostics);
/// For the end of a log: the outcome, the verdict, and the report as JSON.
std::map<std::string, std::string> conclusion(const RunReport& report, const runtime::Runner& runner,
                                              const lang::Diagnostics& diagnostics);
std::map<std::string, std::string> conclusion(const runtime::ScenePartner& partner,
                                              const runtime::BaseTruth& base);
std::string json_report(const RunReport& report, const runtime::Runner& runner,
                        const lang::Diagnostics& diagnostics);

}  // namespace zwang::cli
