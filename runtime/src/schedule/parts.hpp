/// The parts of a scheduler. One file for each step of the tick: tick_sense, tick_choose, tick_switch,
/// tick_rows, tick_drivers, tick_return, tick_sides, tick_paths, tick_read. The numbers are those of the
/// table in runtime/README.md.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "schedule/at_rest.hpp"
#include "schedule/blend.hpp"
#include "schedule/condition.hpp"
#include "schedule/estimated_wrenches.hpp"
#include "schedule/frame_table.hpp"
#include "schedule/guards.hpp"
#include "schedule/path_follower.hpp"
#include "schedule/plane_norm.hpp"
#include "schedule/region_fence.hpp"
#include "schedule/signal_table.hpp"
#include "schedule/task_list.hpp"
#include "schedule/task_snapshot.hpp"
#include "zwang/lang/condition_function.hpp"
#include "zwang/runtime/scheduler.hpp"

namespace zwang::runtime {

/// A norm in the base's plane limits the braking along x and y.
inline constexpr int both_axes = 3;

/// An axis of `always` or of the active task.
struct ActiveAxis {
  Origin origin;
  const lang::Group* group = nullptr;
  const lang::AxisStatements* says = nullptr;
  int fence = -1;   ///< of a group `inside`: index into `fences`
  int plane = -1;   ///< of a norm of accelerations or forces: index into `planes`
  int brakes = -1;  ///< of the base's x, y and rz the one whose braking its ranges limit; -1: none; or
                    ///< `both_axes`
  bool hangs_on_signal = false;                     ///< its frames or its value do: it can be lost
  bool is_along_path = false;                       ///< its axes turn with a path: it can be lost, too
  bool varies = false;                              ///< what it wants is not up to the parameters alone
  std::optional<solver::AttachedFrame> entry_axes;  ///< `here` in axes of the moved body: the axes on entry
  double here = 0.0;
  bool has_here = false;
  std::size_t wanted = 0;  ///< index in `wanted` of its constraint, or of its first one
  bool lost = false;  ///< its axes hang on a pose signal that is not known now, or its value on such a signal
  AxisReading reading;
  bool is_outside = false;    ///< of its position range or its region, by more than what a brake leaves
  int row = -1;               ///< of its driver in the set of the active task; -1: not in force
  bool is_met = false;        ///< that row gets what it asks
  double built_up = 0.0;      ///< what `build_up` has added up: q [m], [m/s], [rad] or [rad/s]
  double added = 0.0;         ///< the part of q that the target has in this tick
  double inverse_mass = 0.0;  ///< of one that yields: of the robot along it, 1/Lambda [1/kg] or [1/kg m^2]
};

/// The pairs of features of a fence that are in force, by their indices.
struct InReach {
  struct Pair {
    std::size_t index = 0;
    double left = 0.0;     ///< before the margin [m]
    double braking = 0.0;  ///< [m/s^2]
  };
  std::array<Pair, RegionFence::most_near> pairs{};
  std::size_t count = 0;
};

/// The readings of a solution along sides 0 and `across` of a plane's norm.
struct PlaneReading {
  std::array<int, 2> row{-1, -1};        ///< of Solution::rows, along them; -1: not in force
  std::array<double, 2> acceleration{};  ///< [m/s^2]
  std::array<double, 2> press{};         ///< [N] of all sets, by their shares
  double W_xx = 0.0, W_xy = 0.0,
         W_yy = 0.0;  ///< acceleration along one by a unit force along the other [1/kg]
};

/// Of a row whose frame is outside.
struct WayBack {
  solver::Vector3 inwards;      ///< unit normal in the world; zero: an angle, which has none
  std::optional<double> speed;  ///< of the row's own point along it [m/s]; none: the point is the origin
};

/// Where `back` leads.
struct Interruption {
  int task = -1;
  double spent = 0.0;  ///< [s] in the task until it was interrupted
};

struct Scheduler::Parts final : Facts {
  Parts(const lang::Program& given, double control_period);
  void follow(const lang::Condition& condition);

  // Step 5: the snapshot, stale signals, frames, and what conditions ask about.
  void sense(const Sensed& sensed) noexcept;
  Fact look_up(const lang::ExpressionNode& node, int owner) const noexcept override;
  Fact coordinate(const lang::ExpressionNode& node, int owner) const noexcept;
  Fact of_frame(int frame, double value) const noexcept;
  bool is_bearing_of_the_robot(const lang::Group& g) const noexcept;
  bool is_known(int frame) const noexcept;
  bool was_seen(int frame) const noexcept;
  Fact feature(const lang::Feature& feature) const noexcept;
  lang::TaskEntries entries_of(int of_task) const noexcept;
  solver::AxisConstraint measured(const lang::Group& group, const lang::AxisStatements& axis,
                                  const ActiveAxis* active_axis) const noexcept;
  solver::Coordinate coordinate_of(const lang::Group& group, const lang::AxisStatements& axis,
                                   const ActiveAxis* active_axis) const noexcept;
  double position_of(const lang::Group& group, const lang::AxisStatements& axis,
                     const ActiveAxis* active_axis) const noexcept;

  // Where frames are along paths.
  void list_followers();
  const PathFollower* follower_of(const lang::Group& group) const noexcept;
  bool is_off_path(const lang::Group& group) const noexcept;
  void follow_paths(int owner, bool enters) noexcept;
  void measure_along(const lang::Group& group, solver::AxisConstraint& c) const noexcept;

  // Steps 5 and 6: guards, and at most one transition.
  struct Choice {
    Transition transition;
    lang::Target target;
  };
  void advance_guards() noexcept;
  std::optional<Choice> choose() noexcept;
  std::optional<Choice> choose_while_stopping() noexcept;
  bool is_own_target(const lang::Target& target) const noexcept;
  bool is_used_up(int of_task) const noexcept;
  lang::Target led_past(lang::Target target) const noexcept;
  bool is_heeded(const lang::Target& target) const noexcept;
  int first_interruption() const noexcept;
  bool is_timed_out() const noexcept;
  void check_rest() noexcept;

  // Step 7: the switch, `set`, and every `here`.
  void take(Choice choice) noexcept;
  void lead(Transition& transition, const lang::Target& target) const noexcept;
  void turn_away(Transition& transition) noexcept;
  int unknown_frame_of(const std::vector<lang::SetAction>& actions) const noexcept;
  void refuse_set(Transition& transition, int unknown_frame) const noexcept;
  lang::Span refused_set(const Transition& transition) const noexcept;
  const std::vector<lang::SetAction>* exit_sets(const Transition& transition) const noexcept;
  void interrupt(const Transition& transition) noexcept;
  void enter() noexcept;
  void stop_outputs() noexcept;
  void resume() noexcept;
  void apply(const std::vector<lang::SetAction>& actions) noexcept;
  void list_axes(bool resumes) noexcept;
  void remember(TaskSnapshot& snapshot, int of_task) const noexcept;
  ActiveAxis active_axis(const Origin& origin) noexcept;
  int base_direction(const lang::Group& group, const lang::AxisStatements& axis) const noexcept;
  int braking_direction(const lang::Group& group, const lang::AxisStatements& axis) const noexcept;
  void capture_here(ActiveAxis& a) noexcept;

  // Step 8: the constraints in force.
  void track_losses() noexcept;
  void start_blend() noexcept;
  void put_constraints() noexcept;
  void put() noexcept;
  void list_wanted() noexcept;
  Wanted& new_wanted(std::size_t index) noexcept;
  void list_axis(const ActiveAxis& a) noexcept;
  void list_fence(const ActiveAxis& a) noexcept;
  void want() noexcept;
  void want_axis(ActiveAxis& a) noexcept;
  void want_motion_ranges(const ActiveAxis& a, solver::AxisConstraint& c) const noexcept;
  bool is_left_to_the_end(const ActiveAxis& a) const noexcept;
  solver::Driver driver_of(ActiveAxis& a) const noexcept;
  double added_to(const solver::Driver& driver, const ActiveAxis& a) const noexcept;
  void yield(const ActiveAxis& a, solver::Driver& driver) const noexcept;
  double pushed_with(const ActiveAxis& a) const noexcept;
  bool find_pushes() noexcept;
  solver::Range with_what_pushes(solver::Range acceleration, int base_axis) const noexcept;
  void build_up(ActiveAxis& a) noexcept;
  bool asks_for_motion_of(const ActiveAxis& a) const noexcept;
  double error_of(const ActiveAxis& a, const solver::Driver& driver,
                  const solver::Coordinate& now) const noexcept;
  bool is_lost(const ActiveAxis& a) const noexcept;
  void want_fence(const ActiveAxis& a, RegionFence& fence) noexcept;
  void want_standstill(const ActiveAxis& a) noexcept;
  InReach find_nearest(const ActiveAxis& a, RegionFence& fence) noexcept;
  bool keep_in_reach(const ActiveAxis& a, const InReach& nearest) noexcept;
  void put_in_reach(const ActiveAxis& a, const RegionFence& fence, InReach nearest) noexcept;
  void lead_back() noexcept;
  void find_way_back(ActiveAxis& a) noexcept;
  void lead_back(const ActiveAxis& a, std::size_t index, const WayBack& way) noexcept;
  void note_excursion(ActiveAxis& a, double outside) noexcept;
  void only_hold_back(solver::AxisConstraint& c) const noexcept;
  void keep_energy_from_rising() noexcept;
  double braking_of(const solver::AxisConstraint& c, const lang::AxisStatements& s) const noexcept;
  double braking_along(const solver::Vector3& direction) const noexcept;
  void find_braking() noexcept;
  solver::Range value(const lang::ValueRange& range) const noexcept;
  const solver::AttachedFrame& axes_frame(const lang::Group& group, const ActiveAxis* a) const noexcept;
  void read(const solver::Solution& solution) noexcept;
  void read_row(std::size_t set, const solver::Row& row, const solver::RowSolution& answer,
                ActiveAxis& axis) noexcept;

  // Steps 8 and 9: the sides of norms, and which of them are in force.
  void list_plane(const ActiveAxis& a) noexcept;
  void want_plane(const ActiveAxis& a) noexcept;
  bool pose_broken_sides(const solver::Solver& solver, const solver::Solution& solution) noexcept;
  void read_planes(const solver::Solution& solution) noexcept;
  double share_of_side(const solver::AxisConstraint& side, const PlaneReading& reading) const noexcept;
  bool choose_sides(const ActiveAxis& a, const PlaneReading& reading) noexcept;

  // For people, after the run.
  std::vector<int> signals_of(const lang::ExpressionNode& name, int owner) const;
  WaitedExit waited(const lang::Condition& condition, int owner, std::span<const double> values,
                    const std::vector<SignalState>& states) const;
  std::string asked_of(const lang::Condition& condition, const Compared& compared, const std::string& unit,
                       int owner) const;
  void follow_course(const TaskSnapshot& now, int owner, std::size_t exit, WaitedExit& waited) const;
  std::string name_of(const lang::Target& target) const;

  const lang::Task& active() const noexcept { return tasks[task]; }
  bool is_at_end() const noexcept { return tasks.ends(task); }
  double elapsed() const noexcept { return now - entered; }
  const lang::Group& group(const Origin& origin) const noexcept {
    return tasks[origin.task].groups[static_cast<std::size_t>(origin.group)];
  }
  const ActiveAxis* find(const Origin& origin) const noexcept;
  ActiveAxis* find(const Origin& origin) noexcept;

  const solver::Model model;
  const lang::Stop stop;
  std::vector<lang::BaseLimit> limits;
  std::vector<double> parameters;
  const std::vector<std::optional<solver::Range>> parameter_ranges;
  std::vector<lang::FrameDeclaration> declarations;
  const std::vector<lang::Feature> features;
  const std::vector<lang::Path> paths;
  const int base;  ///< frame
  const std::vector<HeldJoint> held_joints;
  const TaskList tasks;
  FrameTable frames;
  SignalTable signals;
  EstimatedWrenches wrenches;
  const std::vector<lang::Output> declared_outputs;
  std::vector<double> outputs;          ///< of each what it is set to
  mutable std::vector<double> pushing;  ///< of each node of what a driver yields to
  const bool feels_pushes;              ///< what pushes the robot moves what the rows move, too
  const double period;
  const double horizon;            ///< [s] within which limits act
  const bool keeps_all_sides;      ///< of planes in force
  const double radius;             ///< [m] of the footprint
  solver::Vector3 effective_mass;  ///< of the base along x, y and rz [kg, kg, kg m^2]
  solver::Vector3 braking;         ///< what the ranges in force leave along them [m/s^2, m/s^2, rad/s^2]
  /// Accelerations along them by the forces that rows yield to, as far as the base moves with them.
  solver::Vector3 pushes = solver::Vector3::Zero();
  std::vector<PathFollower> followers;
  std::vector<RegionFence> fences;
  std::vector<InReach> in_reach;  ///< of each fence
  std::vector<PlaneNorm> planes;
  std::vector<PlaneReading> plane_readings;  ///< of each
  Eigen::VectorXd press_x, press_y;          ///< a unit force along its sides, as FreeMotions has it
  int mobility = 0;                          ///< of the last solution
  // By task and group.
  std::vector<std::vector<int>> fence_of;               ///< -1: not `inside`
  std::vector<std::vector<int>> plane_of;               ///< -1: no norm of accelerations or forces
  std::vector<std::vector<std::size_t>> first_axis_of;  ///< among those of its task
  const int start;

  Phase phase = Phase::running;
  Outcome outcome = Outcome::none;
  int task = -1;
  double now = 0.0;
  double entered = 0.0;   ///< [s] when the task was entered; later by what interruptions took
  double switched = 0.0;  ///< [s] when the present blend began
  double blend_time = 0.0;
  double energy_at_end = 0.0;  ///< [J] kinetic, when an end was reached
  RestWatch rest;              ///< in an end
  bool has_stood = false;
  bool asks_for_motion = false;  ///< as of the last solution
  std::optional<Excursion> excursion;
  std::vector<int> entries;          ///< of each task, since the start
  std::vector<double> entered_last;  ///< of each task [s]
  Interruption interruption;
  const solver::State* state = nullptr;  ///< of the present tick
  /// x, y [N], rz [N m]; NaN: unknown.
  solver::Vector3 estimated_force = solver::Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  std::optional<Transition> transition;
  std::vector<GuardedExits> guarded;  ///< of each task
  Guards guards;
  Guards always_guards;
  std::vector<ActiveAxis> axes;  ///< those of `always` first
  std::size_t always_axes = 0;
  std::vector<TaskSnapshot> left;    ///< of each task, when it was left last
  std::vector<Wanted> wanted;        ///< those of `always` first
  std::size_t always_wanted = 0;     ///< as many of these, once they are listed
  std::vector<int> renewed;          ///< those of `wanted` with values that the last tick did not have
  bool values_are_due = true;        ///< of all that is wanted: another list, or other parameters
  bool reach_changed = true;         ///< another pair of features is in force, or one no more
  std::vector<ActiveAxis*> sources;  ///< of each constraint of all sets its axis; null while it leaves
  std::optional<Blend> blend;
  std::array<solver::RowSet, Blend::most_sets> row_sets;
};

}  // namespace zwang::runtime
