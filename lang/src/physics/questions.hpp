/// The questions, a file each. All get a task's axes and write what they find into `remarks`.
#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>

#include "check/endings.hpp"
#include "physics/physics.hpp"
#include "physics/planned_axis.hpp"
#include "physics/probe.hpp"

namespace zwang::lang {

/// A remark about one place is added once. A template's axis stands in several tasks, an axis of `always` in
/// all.
class Remarks {
 public:
  explicit Remarks(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void add(Diagnostic diagnostic) {
    if (said_[place(diagnostic.span)].insert(diagnostic.code).second) diagnostics_.add(std::move(diagnostic));
  }
  /// One cause, one message: whether something was said of this place already.
  bool any_at(const Span& span) const { return said_.contains(place(span)); }

 private:
  using Place = std::tuple<int, int, int>;
  static Place place(const Span& span) { return {span.source, span.begin.line, span.begin.column}; }

  Diagnostics& diagnostics_;
  std::map<Place, std::set<std::string>> said_;
};

/// An axis, and the velocities to which tasks drive it.
struct DrivenMotion {
  const PlannedAxis* axis = nullptr;
  Bounds velocities;
};
/// What any task of a file drives, each axis once: by frames and axis.
struct DrivenByAny {
  std::map<std::string, DrivenMotion> motions;
  double speed = 0.0, turning = 0.0;  ///< [m/s], [rad/s]
};

/// The tasks and the scene that an exit depends on beside its own task.
struct AllTasks {
  std::vector<PlannedTask> plans;  ///< of all tasks, as they are written
  const std::optional<Scene>& scene;
  std::optional<DrivenByAny> any = {};  ///< of files with many tasks
};

/// The path that the axis turns with; nullptr without one.
const Path* path_of(const CheckContext& context, const PlannedAxis& axis);

/// E404 for an axis alone. Takes it out of the plan: what cannot be driven is not asked about again.
void ask_reach(PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W416: places that joints cannot come to.
void ask_travel(const PlannedTask& plan, const Robot& robot, const std::optional<Scene>& scene,
                Remarks& remarks);
/// E406, W407, and E404 for axes that the wheels tie together.
void ask_freedoms(const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W614: a base of two freedoms that is to stand still along an axis of the world, and to move along another.
void ask_askew(const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W609: an axis that contact may move, and cannot.
void ask_free(const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W610: drivers that a range keeps from moving anything. Takes them out of the plan.
void ask_still(const CheckContext& context, PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W613: distances that are to vanish.
void ask_distance(const PlannedTask& plan, const Probe& probe, Remarks& remarks);
/// W611: speeds that the wheels' motors cannot turn to, or an arm's joints.
void ask_top_speed(const PlannedTask& plan, const Robot& robot, Probe& probe, Remarks& remarks);
/// W612: an arm that may press harder than the base may.
void ask_arm_force(const PlannedTask& plan, const Robot& robot, Remarks& remarks);
/// E601, W601: force drivers and acceleration ranges.
void ask_press(const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W602: a guard on `saturated` that never fires. W619: a force range of which less than half is made.
void ask_dead_guard(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W615: circles that the norm of an acceleration does not allow. W641: two ranges that are meant as a norm.
void ask_plane(const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W615: fillets that the norm of an acceleration does not allow at the speed along the path.
void ask_path(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// N622: a heading along a path, of a base whose freedoms x and y take.
void ask_heading(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W601: springs that an acceleration limit clips.
void ask_springs(const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W604: time constants too short for the braking, or for the tick.
void ask_time_constant(const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W618, E417: yields that ring when a hand holds them stiffly.
void ask_yields(const CheckContext& context, const PlannedTask& plan, const std::optional<Scene>& scene,
                Probe& probe, Remarks& remarks);
/// W647: yields whose force range, or whose motors, do not hold their dead band.
void ask_dead_band(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W648: springs that still swing at the timeout.
void ask_swinging(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W617: yields along an axis that is not the one along which their force is measured.
void ask_yield_axes(const CheckContext& context, const PlannedTask& plan, const Probe& probe,
                    Remarks& remarks);
/// W646: freedoms of the base that a task of features leaves to nothing.
void ask_left_over(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W646: what the task drives, and a task that it leads to leaves to nothing. `conditions`: of its exits.
void ask_coasting(const CheckContext& context, const PlannedTask& plan, const AllTasks& all,
                  const std::vector<Condition>& conditions, Remarks& remarks);
/// N616: targets on a pose signal that are trailed.
void ask_trailing(const CheckContext& context, const PlannedTask& plan, Remarks& remarks);
/// N605: what other rows may add along a limited direction.
void ask_force_budget(const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W649: drivers that dry friction holds.
void ask_friction(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W606: drivers beyond the motors.
void ask_wheel_torque(const PlannedTask& plan, Probe& probe, Remarks& remarks);
/// W607: boundaries that ask for more braking than the motors have.
void ask_boundary(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks);

/// W416: ranges that exclude each other, drivers beyond a range.
void ask_contradiction(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks);

/// Joints that steer a wheel and that no row of any task turns, by their number.
std::vector<int> held_steerings(const CheckContext& context, const solver::Model& model);
/// W643: motion that the wheels hold while nothing steers them.
void ask_steering(const CheckContext& context, const PlannedTask& plan, const std::vector<int>& held,
                  Probe& probe, Remarks& remarks);
/// W645: a push across the way of driven casters, at what stands where the base may come.
void ask_hopping(const CheckContext& context, const PlannedTask& plan, const ExitConditions& conditions,
                 const AllTasks& all, Probe& probe, Remarks& remarks);
/// Below which turn the condition takes the axis to rest; none: it does not ask. [rad/s]
std::optional<double> turn_at_rest(const CheckContext& context, const PlannedTask& plan,
                                   const Condition& condition, const PlannedAxis& axis);
/// E621, W621: a heading that a wall is to turn, and cannot. `conditions`: of the task's exits. `is_start`:
/// the task begins where the scene puts the base.
void ask_square(const CheckContext& context, const PlannedTask& plan,
                const std::vector<Condition>& conditions, const std::vector<int>& held_steerings,
                const std::optional<Scene>& scene, bool is_start, Probe& probe, Remarks& remarks);
/// E633: a heading that a wall turns more slowly than an exit asks for. `conditions`: of the task's exits.
void ask_turned_slowly(const CheckContext& context, const PlannedTask& plan,
                       const std::vector<Condition>& conditions, Probe& probe, Remarks& remarks);

/// W511: exits that the ranges in force decide. `exits` are those of the plan's task, or of `always`.
void ask_exits(const CheckContext& context, const PlannedTask& plan, const std::vector<ExitText>& exits,
               const std::vector<Condition>& conditions, const AllTasks& all, Probe& probe, Remarks& remarks);

/// W511: an `enter.require` that asks for more speed than the tasks before leave.
void ask_requirement(const CheckContext& context, const PlannedTask& plan,
                     const std::optional<Condition>& require, const AllTasks& all, Probe& probe,
                     Remarks& remarks);
/// Whether the scene moves the base: what a range keeps, somebody may break.
bool pushes_the_base(const std::optional<Scene>& scene);

/// W620: guards on a distance that fire too late to stop. `index`: of the plan's task.
void ask_stopping(const CheckContext& context, const PlannedTask& plan, const ExitConditions& conditions,
                  std::size_t index, Probe& probe, Remarks& remarks);

/// The most that ranges in force leave of a speed, and the range that leaves least; no path: the base itself.
struct SpeedLimit {
  double most = solver::infinity;  ///< [m/s] or [rad/s]
  std::string path;
  Span span;
};
/// Of a point on the base; infinite for points elsewhere.
SpeedLimit most_speed(const PlannedTask& plan, const solver::AttachedFrame& point, Probe& probe);
SpeedLimit most_turning(const PlannedTask& plan, Probe& probe);
/// The speed that drivers of velocity give to the base's origin, with a tenth for overshoot. Infinite where
/// anything else drives it, or where nothing moves it.
SpeedLimit speed_of_drivers(const PlannedTask& plan, const solver::AttachedFrame& point, Probe& probe);
/// The lesser of both.
SpeedLimit speed_in_force(const PlannedTask& plan, const solver::AttachedFrame& point, Probe& probe);

/// Acceleration that the plan allows along the axis in the direction of `sign`. It counts ranges on that very
/// axis, and on the base's own axes of the same kind. Infinite where there is none. `own`: the axis's own
/// range, too.
struct AccelerationLimit {
  double most = solver::infinity;  ///< [m/s^2] or [rad/s^2]
  const PlannedAxis* from = nullptr;
};
AccelerationLimit acceleration_limit(const PlannedTask& plan, const PlannedAxis& axis, double sign, bool own);
/// Force that ranges on axes without a driver leave to the sum of the rows along the axis, in the direction
/// of `sign`. They bound all rows from their level on. [N] or [N m]; infinite where there is none.
struct ForceLimit {
  double most = solver::infinity;
  const PlannedAxis* from = nullptr;
};
ForceLimit sum_limit(const PlannedTask& plan, const PlannedAxis& axis, double sign);

}  // namespace zwang::lang
