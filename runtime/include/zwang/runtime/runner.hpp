/// One control tick from sample to torques: admit, schedule, fill, solve, guard, record.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/command.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/runtime/plant.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/safety_guard.hpp"
#include "zwang/runtime/scheduler.hpp"
#include "zwang/runtime/why.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// The state of a run.
enum class RunState {
  running,
  done,
  failed,
  stopped,  ///< the protective stop; SafetyGuard::reason says why
};
ZWANG_EXPORT const char* to_string(RunState state) noexcept;

/// A limit of the task, the robot or a motor that was in force, and how near the run came to it.
/// Forces and accelerations are those commanded; positions and velocities those sensed; torques those sent.
struct ZWANG_EXPORT LimitReport {
  std::string
      row;  ///< its column of the log: "press.contact.x.velocity", "press.contact.x.nu", "left_wheel.tau"
  lang::Span span;  ///< where it is written
  double limit = 0.0;
  double worst = 0.0;   ///< the value nearest to, or farthest beyond, the limit
  double margin = 0.0;  ///< what was left; negative when it was broken
  std::string unit;     ///< SI
  /// Beyond the limit by more than a thousandth of it: what four digits show.
  bool is_broken() const;
};

/// A row that does not get what it asks, because others hold it back: "`go.x` misses 0.31 m/s^2; held back by
/// `boundary.edge2` and `manners.speed`".
struct ShortfallReport {
  std::string row;
  double residual = 0.0;
  std::string unit;
  std::vector<std::string> held_back_by;  ///< the strongest first
};

/// Why a program is not swapped in.
enum class SwapRefusal {
  none,            ///< it is
  stopped,         ///< the protective stop is latched
  has_run,         ///< it has run before
  joints,          ///< its joints are others, or what its drive takes is
  period,          ///< its control period is another
  signal_missing,  ///< a signal of it is not measured in this run
  signal_type,     ///< a signal of it is measured as another type
  signal_frame,    ///< a pose or a wrench of it is seen from another frame
};
const char* describe(SwapRefusal refusal) noexcept;  ///< a sentence without its end

/// The result of a swap.
struct SwapResult {
  SwapRefusal refusal = SwapRefusal::none;
  const char* signal = "";  ///< its name, where the refusal is about one; as long as the next runner lives
  explicit operator bool() const noexcept { return refusal == SwapRefusal::none; }
};
/// The sentence with the signal's name. Allocates.
ZWANG_EXPORT std::string describe(const SwapResult& result);

/// Settings by the host; without them the robot file counts.
struct RunnerSettings {
  /// [s] between steps, 0.1 to 10 ms; where none is given, the robot file's `control_period`.
  std::optional<double> period;
  double max_slew = std::numeric_limits<double>::infinity();  ///< [N m/s] or [N/s] of a joint
  std::vector<Column> extra_columns;  ///< logged behind the runner's own; `step` is given their values
};

/// The sentence of reports for `Runner::may_still_move`.
inline constexpr const char* unseen_rest = "no sample has shown the base at rest: it may still move";

/// One thread at a time calls it. A runner that was moved from can be destroyed or assigned to, no more.
class ZWANG_EXPORT Runner {
 public:
  /// The program is copied. Throws std::invalid_argument, as Scheduler, Solver and SafetyGuard do.
  explicit Runner(const lang::Program& program, const RunnerSettings& settings = {});
  ~Runner();
  Runner(Runner&&) noexcept;
  Runner& operator=(Runner&&) noexcept;

  /// The torques to send for this sample [N m] or [N], one entry a joint; always finite and within the
  /// joints' limits. A state of another size latches the stop (`bad_sample`). `extra` has a value for each
  /// of `extra_columns`. Goes on braking and holding after the run is over. Does not allocate, lock, throw or
  /// print.
  const Eigen::VectorXd& step(const Sensed& sensed, std::span<const double> extra = {}) noexcept;
  /// The command of that step to a drive of any kind, for Plant::follow. A drive that takes velocities needs
  /// it.
  const Command& command() const noexcept;
  /// The values of the task file's outputs after that step, in the order of Program::outputs: SI, or 0 and 1.
  /// From the end of the run or a stop on, they are the values that their `stop` gives.
  std::span<const double> outputs() const noexcept;

  double period() const noexcept;  ///< [s] of its steps
  /// For LogContext::facts: the task, its present parameters, the settings, and the software that computes
  /// it. A replay needs these facts beside the files and the logged values. It also needs `robot` and
  /// `scene`, where LoadOptions named one.
  std::map<std::string, std::string> facts() const;
  RunState state() const noexcept;
  /// The outcome is known and the base stands (or has had the time to).
  bool finished() const noexcept;
  /// The run is finished by the time it had, and no sample that can be believed has shown the base at rest.
  bool may_still_move() const noexcept;
  /// For people: the reason of a stop, and `unseen_rest`; mostly empty. Allocates.
  std::string because() const;

  /// Sets a parameter of the task file, in SI, between two steps. False, and nothing happens, for a name that
  /// is unknown and a value outside the parameter's range. Does not allocate.
  bool set_parameter(std::string_view name, double value) noexcept;

  /// An event that the host has seen, as `overrun`. The next step has it, for the report and the log. Codes
  /// that latch the stop belong to `SafetyGuard::stop`, and are ignored here.
  void tell(EventCode code, int signal = -1, double value = 0.0) noexcept;

  /// From the next step on the program of `next` runs, from its start task, on the same robot. Build `next`
  /// on another thread, from a file that may have changed, and swap between two steps. Guard, estimates and
  /// events stay. The difference of the torques fades within `handover`. The recorder is let go, as columns
  /// may differ. `next` gets the old program. Snapshots keep the layout of the program that the runner was
  /// made with. The next program finds its signals among them by name, type and frame. If the swap is refused
  /// nothing happens, and the result says why. Does not allocate, lock, throw or print.
  SwapResult swap_program(Runner& next) noexcept;
  static constexpr double handover = 0.2;  ///< [s]

  /// The columns of a log of this run. A recorder made with them may be attached before the first step; it
  /// must outlive the runner.
  std::vector<Column> columns() const;
  void record_to(Recorder* recorder) noexcept;  ///< nullptr: no log

  const Scheduler& scheduler() const noexcept;
  const SafetyGuard& guard() const noexcept;
  SafetyGuard& guard() noexcept;                      ///< for `stop` and `reset`, between two steps
  const solver::Solution& solution() const noexcept;  ///< of the last step that solved; sets in their order
  GuardStatus guard_status() const noexcept;          ///< of the last step
  solver::Status solver_status() const noexcept;      ///< of the last step that got to the solver

  const std::vector<Transition>& transitions() const noexcept;  ///< the first 1024
  std::uint64_t transition_count() const noexcept;
  const std::vector<Event>& events() const noexcept;  ///< the first 1024
  std::uint64_t event_count() const noexcept;
  std::string event_signal(const Event& event) const;  ///< its name, "front_left_wheel.tau". Allocates.
  /// An estimate of the contact force on the base, from joints and torques alone: x, y [N] and rz [N m] at
  /// its origin, in its axes. Low-passed with 20 ms.
  solver::Vector3 estimated_force() const noexcept;
  /// Where the base and its joints are after the last step, as the task sees them: in the world, the twist in
  /// the base's axes. A drive with a virtual robot: that one's.
  const solver::State& estimated_state() const noexcept;
  /// Every limit that was in force, in the order of the files. Allocates.
  std::vector<LimitReport> limits() const;
  /// The row that fell farthest short in the last step because of others, if any. Allocates.
  std::optional<ShortfallReport> shortfall() const;
  /// The limit that the last step was at, if any. Allocates.
  std::optional<LimitReport> limit_now() const;
  /// Why the run is not `done`: what its task waited for. None where it is. For after the run. Allocates.
  std::optional<Why> why() const;

 private:
  std::string describe_stop() const;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace zwang::runtime
