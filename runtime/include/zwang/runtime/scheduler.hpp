/// Which task is active, which constraints are in force, and how they fade: steps 5 to 8 of the
/// control tick (runtime/README.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/plant.hpp"
#include "zwang/runtime/why.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// The phase of a run: tasks, brake, rest.
enum class Phase {
  running,
  stopping,  ///< `done` or `failed` was reached; the base brakes
  finished,  ///< the base stands; the brake's rows stay in force and hold it
};

/// The end that the tasks have reached.
enum class Outcome { none, done, failed };
ZWANG_EXPORT const char* to_string(Outcome outcome) noexcept;

/// The reason of a transition.
enum class Cause {
  start,        ///< the program's start task
  always,       ///< one of the exits of `always`
  timeout,      ///< the task's timeout
  exit,         ///< one of the task's exits
  never_stood,  ///< the brake did not bring the base to rest in time
};

ZWANG_EXPORT const char* to_string(Cause cause) noexcept;

/// The reason that kept the run out of the next task.
enum class Refusal {
  none,
  require,   ///< the task's `require` was false or unknown: `failed`
  attempts,  ///< the task's `attempts` were used up: where they lead
  set,       ///< a frame is set on the way, and a pose signal that it needs is not known: `failed`
};

ZWANG_EXPORT const char* to_string(Refusal refusal) noexcept;

/// A switch of tasks. Tasks are indices into Scheduler::tasks().
struct Transition {
  double time = 0.0;  ///< [s]
  int from = -1;      ///< -1 at the start
  int to = 0;
  Cause cause = Cause::start;
  int exit = -1;                    ///< index of the exit taken, of `always` or of the task
  bool resumes = false;             ///< `back`: `to` goes on where it was interrupted
  Refusal refusal = Refusal::none;  ///< of the last task that turned the run away
  int refused = -1;                 ///< that task
  int unknown_frame = -1;           ///< of a refused `set`: the frame whose pose is not known
  std::uint64_t also_always = 0;    ///< bit i: exit i of `always` would have been taken too
  bool also_timeout = false;        ///< the timeout was due too
  std::uint64_t also_true = 0;      ///< bit i: exit i of the task would have been taken too
};

/// The axis statement that a constraint comes from.
struct Origin {
  int task = -1;
  int group = -1;
  int axis = -1;  ///< 0 for a group that has none: `inside`
  int part = -1;  ///< of `inside`: the pair of features
  bool operator==(const Origin&) const = default;
};

/// One constraint of a set.
struct InForce {
  /// Of a set that was in force before a switch: the statement of the same axis in the task that is active
  /// now, where there is one.
  Origin origin;
  bool active = false;  ///< that statement is the active task's, or of `always`; false while it leaves
  bool drives = false;  ///< carries a driver
  double alpha = 1.0;   ///< the share of the sets that it is in force in, by its driver where it has one
};

/// A frame that has come to stand outside of a position range or a region that holds it.
struct Excursion {
  Origin origin;
  double distance = 0.0;  ///< how far outside [m] or [rad]
};

/// The last solution's values for an axis's driver.
struct AxisReading {
  /// nu, or phi f of a force driver [N] or [N m]; while a switch blends, of all drivers of the axis by the
  /// shares of their sets.
  double force = 0.0;
  double residual = 0.0;  ///< s [m/s^2] or [rad/s^2]
  bool saturated = false;
};

/// Runs the tasks of one program. Everything is sized by the constructor; afterwards nothing allocates,
/// locks, throws or prints, except where a member says so.
class ZWANG_EXPORT Scheduler {
 public:
  /// The program is copied. Throws std::invalid_argument on a program without tasks, with an index out of
  /// range, or with a part of the language that the runtime does not run yet. Throws it, too, if the period
  /// is not positive.
  Scheduler(const lang::Program& program, double period);
  ~Scheduler();
  Scheduler(Scheduler&&) noexcept;
  Scheduler& operator=(Scheduler&&) noexcept;

  /// Frames, guards, at most one transition, `set`, `here`, and the constraints in force now. The sample must
  /// be finite and later than the last one.
  void tick(const Sensed& sensed) noexcept;
  /// The contact force on the base that the conditions of the next tick read: x, y [N] and rz [N m] at its
  /// origin and in its axes. NaN: unknown.
  void estimate_force(const solver::Vector3& force) noexcept;
  /// The wrenches on the frames that conditions and drivers ask for. `p` pushes the robot along its free
  /// motions, in the order of `motions`, at the state of the last tick. `dt` [s] since the last one.
  void estimate_wrenches(const solver::FreeMotions& motions, const Eigen::VectorXd& p, double dt) noexcept;
  /// A driver of the last tick asks for more than 1 cm/s or 0.1 rad/s, or a range leads back what is outside.
  bool asks_for_motion() const noexcept;
  /// Once a tick, behind the last `observe`: what drivers build up, and how heavy the robot is along those
  /// that yield.
  void follow_up(const solver::Solver& solver) noexcept;
  /// The values that the outputs are set to, in the order of Program::outputs: SI, or 0 and 1.
  std::span<const double> outputs() const noexcept;
  /// The protective stop has latched: outputs are what their `stop` says.
  void stop_outputs() noexcept;
  /// An output has this value from now on, until a task sets it.
  void set_output(int index, double value) noexcept;
  /// The solution for the rows of `row_sets()`: the guards of the next tick read it.
  void observe(const solver::Solution& solution) noexcept;

  /// How many sets of constraints are in force: one, or up to three while a switch blends. Set 0 is that of
  /// the active task.
  int set_count() const noexcept;
  solver::ConstraintSet& constraints(int set = 0) noexcept;
  const solver::ConstraintSet& constraints(int set = 0) const noexcept;
  /// The part that a set's solution has in the torques; 1 in all.
  double share(int set) const noexcept;
  /// Computes the coordinates and rows of all sets at the state of the last tick, which must still be there.
  /// False when the rows exceed the capacity.
  bool fill_constraints() noexcept;
  /// The rows of all sets, for the solver, as filled last.
  std::span<const solver::RowSet> row_sets() const noexcept;
  /// Of a norm in a plane, as many sides are in force as have been met. Behind `observe`. True: the solution
  /// breaks other ones, which are in force now: to be filled, solved and observed again.
  bool pose_broken_sides(const solver::Solver& solver, const solver::Solution& solution) noexcept;
  /// Parallel to constraints(set).constraints().
  const std::vector<InForce>& in_force(int set = 0) const noexcept;
  const std::optional<Transition>& transition() const noexcept;  ///< of this tick

  /// The first that began with this tick. It is over, and can begin anew, once the frame is inside.
  const std::optional<Excursion>& excursion() const noexcept;

  Phase phase() const noexcept;
  Outcome outcome() const noexcept;  ///< none until `done` or `failed` is reached
  bool has_stood() const noexcept;   ///< in phase `finished`: the base was seen to stand
  int task() const noexcept;         ///< the active one, an index into `tasks()`; -1 before the first tick
  /// [s] since the task was entered, interruptions left out.
  double elapsed() const noexcept;
  /// Zeros where the active task and `always` have no such statement.
  AxisReading reading(const Origin& origin) const noexcept;
  /// How long the condition of the active task's exit has been true without a break. [s]
  double dwell(int exit) const noexcept;
  double always_dwell(int exit) const noexcept;  ///< dwell of an exit of `always` [s]
  /// The present values, SI, in the order of Program::parameters.
  const std::vector<double>& parameters() const noexcept;
  /// Sets a parameter [SI] from outside, between two ticks; constraints follow on the next one. False, and
  /// nothing happens, for an index or a value outside its range or a value that is not finite.
  bool set_parameter(int index, double value) noexcept;

  // Signals, as of the last tick, parallel to the program's.
  bool signal_known(int signal) const noexcept;  ///< received, and not older than its `stale_after`
  double signal_age(int signal) const noexcept;  ///< [s]; since the start of the run when never received
  const SignalSample& signal_sample(int signal) const noexcept;  ///< the latest valid one

  /// The program's tasks, then the two that brake, `done` and `failed`, then `always`. A task has the robot's
  /// limits as the group `limits` where neither it nor `always` gives any. The groups and exits of `always`
  /// are in force throughout.
  const std::vector<lang::Task>& tasks() const noexcept;
  int program_task_count() const noexcept;
  int always_task() const noexcept;
  int row_capacity() const noexcept;  ///< no tick has more rows, those of all sets together
  int set_capacity() const noexcept;  ///< no set has more rows
  double period() const noexcept;     ///< [s]

  /// The words for one row of a group `inside` a region, "edge2"; empty for other origins. Allocates.
  std::string part_name(const Origin& origin) const;
  /// Why a transition was taken, in the words of the task file. Allocates.
  std::string why(const Transition& transition) const;
  /// The `note` of the exit, the timeout or the attempts that it came from; empty without one.
  const std::string& note(const Transition& transition) const noexcept;
  /// `why`, and the note behind a colon. Allocates.
  std::string why_with_note(const Transition& transition) const;
  /// Where those words stand. Allocates nothing; the span may not exist.
  lang::Span where(const Transition& transition) const noexcept;
  /// Of a refused `set`: the frame whose pose is not known.
  const std::string& unknown_frame(const Transition& transition) const noexcept;
  /// The state of the exits of a task, or of `always`, when the task was left last. For the active task it is
  /// the present state. Allocates.
  WaitedTask waited(int task) const;
  /// The state of the `require` of a task at its last evaluation. Allocates.
  WaitedExit required(int task) const;
  /// Whether exits, timeouts and attempts lead from the task to `done`; `back` counts as if it did, and the
  /// exits of `always` do not count.
  bool can_reach_done(int task) const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace zwang::runtime
