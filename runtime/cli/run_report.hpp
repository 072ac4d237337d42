/// What a run says: while it goes, and when it is over.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::cli {

/// What the plant measured at one object.
struct ObjectReport {
  std::string name;
  std::optional<double> touched;       ///< [s]
  std::optional<double> yaw_at_touch;  ///< [rad]
  double steady_force = 0.0;           ///< [N] mean of the last 0.5 s in which a task was active
  double peak_force = 0.0;             ///< [N]
  std::optional<double> latched;       ///< [s] when the hook caught in its dock
  double pull = 0.0;                   ///< [N] of the hook, outwards, when the last task ended
};

/// A force driver that was in force when the last task ended.
struct AskedForce {
  std::string row;
  double force = 0.0;  ///< [N] or [N m]
  std::string unit;
};

/// Watches the plant's truth from tick to tick.
class TruthWatch {
 public:
  TruthWatch(const runtime::Truth& truth, double period);
  /// `in_task`: a task is active, not the brake behind it.
  void look(const runtime::Truth& truth, bool in_task);
  std::vector<ObjectReport> objects(const runtime::Truth& truth) const;

 private:
  struct Watched {
    std::vector<double> last_forces;  ///< a ring
    std::optional<double> yaw_at_touch;
    double pull = 0.0;
  };
  std::vector<Watched> watched_;
  std::size_t window_;
  std::size_t looks_ = 0;
};

/// Another robot of the scene, when the run ended.
struct PartnerReport {
  std::string name;
  std::string outcome;  ///< done, failed, stopped, fallen, or unfinished
  std::string because;  ///< of a stop
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

struct RunReport {
  std::string outcome;     ///< done, failed, stopped, fallen, diverged; the first robot's
  std::string because;     ///< of a stop; empty otherwise
  double elapsed = 0.0;    ///< [s]
  double wall_time = 0.0;  ///< [s] that it took
  std::uint64_t seed = 0;
  std::vector<std::string> logs;  ///< of the first robot, one after the other
  std::vector<Chapter> before;
  std::uint64_t records = 0;
  std::string log_error;  ///< empty when the log is complete
  std::vector<AskedForce> asked;
  std::vector<ObjectReport> objects;
  std::vector<PartnerReport> partners;
  double x = 0.0, y = 0.0, yaw = 0.0;  ///< [m], [rad] of the base, as the plant has it
  runtime::BaseTruth base;
};

/// The row that is at its limit, in a line without its end.
std::string live_line(const runtime::Runner& runner, double time);
std::vector<AskedForce> asked_forces(const runtime::Scheduler& scheduler);

std::string human_report(const RunReport& report, const runtime::Runner& runner,
                         const lang::Diagnostics& diagnostics);
std::string json_report(const RunReport& report, const runtime::Runner& runner,
                        const lang::Diagnostics& diagnostics);

}  // namespace zwang::cli
