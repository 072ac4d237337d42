// W645: a push across the way of a base whose driven wheels swivel by themselves.
//
// Such a wheel holds the base across its heading, and turns its heading only as it rolls. At a wall beside
// the way, the base comes off as the wheels turn from the push to the way. It comes back at an angle, and the
// wheels drive it into the wall until they have turned. That goes on for as long as it drives. In the
// simulation walls of 5 kN/m and more are hopped along, whatever their damping. A box that gives way is not.
// Another robot on such wheels holds against the push as a wall does, and so does a box that it holds. Two of
// them squeeze a box with 0 to 135 N instead of 25 N. A robot on mecanum wheels gives way evenly.
//
// What stands where the base never comes is no wall. In the first task, with its heading held, the base
// sweeps a strip: v t along its way, and from there straight on along the push. Else it stays in a disc about
// its start, whose radius is the sum of v t over all tasks. A robot that drives itself comes nearer by its
// own v t.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_never.hpp"
#include "physics/ahead.hpp"
#include "physics/questions.hpp"
#include "zwang/lang/plane.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::lang {

namespace {

bool is_driven_on_a_swivel(const solver::Model& model, const solver::Wheel& wheel) {
  if (!model.joint(wheel.body - 1).actuated) return false;
  for (int body = model.bodies()[static_cast<std::size_t>(wheel.body)].parent; body > 0;
       body = model.bodies()[static_cast<std::size_t>(body)].parent) {
    if (!model.joint(body - 1).actuated) return true;
  }
  return false;
}

/// Along x or y of the base, or of a frame on it.
bool is_own_way(const PlannedAxis& axis) {
  return axis.driver && axis.measure == solver::Measure::axis && !axis.turns() &&
         axis.axis != solver::Axis::z && axis.move.body == 0 && axis.in.body == 0;
}

bool rolls_on_driven_swivels(const solver::Model& model) {
  return std::any_of(model.wheels().begin(), model.wheels().end(),
                     [&](const solver::Wheel& wheel) { return is_driven_on_a_swivel(model, wheel); });
}

double latest_end(const CheckContext& context, const PlannedTask& plan,
                  const std::vector<Condition>& conditions) {
  return ending_before(context, *plan.task, conditions, plan.task->exits.size()).time;
}

double speed_of_base(const PlannedTask& plan, Probe& probe) {
  return speed_in_force(plan, {0, {}}, probe).most;
}

bool holds_its_heading(const PlannedTask& plan) {
  return std::any_of(plan.axes.begin(), plan.axes.end(), [](const PlannedAxis& axis) {
    const bool stands = axis.stands_still() || (axis.driver == solver::Quantity::position && !axis.target);
    return axis.drives_motion() && axis.move.body == 0 && axis.axis == solver::Axis::rz &&
           axis.measure == solver::Measure::axis && stands;
  });
}

constexpr double far = 1e3;  // [m] of a task without an end

/// An endless time makes an endless way, at a speed of 0, too: nobody knows better. [m]
double way_in(double speed, double time) {
  const double way = speed * time;
  return std::isnan(way) ? solver::infinity : way;
}

/// Where a run may bring the base and the robots beside it. Infinite: nobody knows.
struct Reach {
  double way = 0.0;   ///< [m] from the start
  double time = 0.0;  ///< [s] until the run ends
};

Reach reach_of_run(const CheckContext& context, const ExitConditions& conditions, const AllTasks& all,
                   Probe& probe) {
  Reach reach;
  for (std::size_t i = 0; i < all.plans.size(); ++i) {
    const PlannedTask& plan = all.plans[i];
    if (leads_back(context) || is_entered_again(context, plan.task->name.text))
      return {solver::infinity, solver::infinity};
    const double time = latest_end(context, plan, conditions.of_tasks[i]);
    reach.time += time;
    reach.way += way_in(speed_of_base(plan, probe), time);
  }
  return reach;
}

/// The strip of a push: the outline of the base from its start along its way, and what it pushes towards.
struct Strip {
  Outline swept;
  solver::Vector3 push;  ///< unit vector in the world
  double way = 0.0;      ///< [m] as far as the push brings it
};

solver::Vector3 own_direction(const PlannedAxis& axis, double sign, const Robot& robot, const Scene& scene) {
  solver::Vector3 along = solver::Vector3::Zero();
  along(axis.axis == solver::Axis::x ? 0 : 1) = sign;
  return start_state(robot, scene).base_pose.rotation * (axis.in.pose.rotation * along);
}

Outline swept_along(Outline outline, const solver::Vector3& way) {
  const std::size_t corners = outline.size();
  for (std::size_t i = 0; i < corners; ++i) outline.push_back(outline[i] + way);
  return plane::convex_hull(std::move(outline));
}

/// By the limits of the robot file. [m/s]
double fastest(const Robot& robot) {
  double x = solver::infinity, y = solver::infinity;
  for (const BaseLimit& limit : robot.limits) {
    if (limit.quantity != solver::Quantity::velocity || is_rotation(limit.axis)) continue;
    (limit.axis == solver::Axis::x ? x : y) = std::max(limit.range.high, -limit.range.low);
  }
  return std::hypot(x, y);
}

/// Of what one axis of another robot's task drives. [m/s]
double driven_speed(const AxisStatements& axis, const Program& program) {
  constexpr double overshoot = 1.1;  // of a driver of velocity
  const bool stays = !axis.driver || axis.here || is_rotation(axis.axis);
  if (stays) return 0.0;
  const std::vector<double> parameters = program.parameter_values();
  if (axis.velocity)
    return std::max(std::abs(axis.velocity->low.evaluate(parameters)),
                    std::abs(axis.velocity->high.evaluate(parameters)));
  const bool is_given = axis.driver == solver::Quantity::velocity && axis.target.signal < 0;
  return is_given ? overshoot * std::abs(axis.target.evaluate(parameters)) : fastest(program.robot);
}

/// As fast as the tasks of another robot drive it. [m/s]
double driven_speed(const Program& program) {
  const auto of_groups = [&](const std::vector<Group>& groups) {
    double sum = 0.0;
    for (const Group& group : groups) {
      for (const AxisStatements& axis : group.axes)
        sum += group.kind == GroupKind::feature && axis.driver ? fastest(program.robot)
                                                               : driven_speed(axis, program);
    }
    return sum;
  };
  double most = 0.0;
  for (const Task& task : program.tasks) most = std::max(most, of_groups(task.groups));
  return std::min(fastest(program.robot), most + of_groups(program.always.groups));
}

/// 0 where one lies inside of the other. [m]
double distance_between(const Outline& one, const Outline& other) {
  double least = solver::infinity;
  for (const auto& [from, to] : {std::pair(&one, &other), std::pair(&other, &one)}) {
    for (const solver::Vector3& corner : *from)
      least = std::min(least, plane::contains(*to, corner) ? 0.0 : plane::distance_to_edges(*to, corner));
  }
  return least;
}

class Beside {
 public:
  Beside(const Scene& scene, const Robot& robot, const Reach& reach, const std::optional<Strip>& strip)
      : scene_(scene), robot_(robot), reach_(reach), strip_(strip), start_(outline_at_start(robot, scene)) {
    // A cylinder's first two sizes are its radius.
    for (const SceneObject& object : scene.objects) {
      if (object.inverse_mass() > 0.0)
        between_ += (object.shape == ShapeKind::cylinder ? std::sqrt(2.0) : 1.0) *
                    std::hypot(object.size[0], object.size[1]);
    }
  }

  bool any_is_stiff() const {
    constexpr double least_stiffness = 5e3;  // [N/m]
    const auto is_wall = [&](const SceneObject& object) {
      return !object.moves() && object.stiffness >= least_stiffness &&
             comes_to(outline_in_world(object, robot_.bumper_height), 0.0);
    };
    const auto holds_against = [&](const SceneRobot& robot) {
      return robot.stiffness >= least_stiffness && robot.program &&
             rolls_on_driven_swivels(robot.program->robot.model) &&
             comes_to(outline_in_world(robot), way_of(*robot.program));
    };
    return std::any_of(scene_.objects.begin(), scene_.objects.end(), is_wall) ||
           std::any_of(scene_.robots.begin(), scene_.robots.end(), holds_against);
  }

 private:
  /// `own`: how far the other one moves itself. [m]
  bool comes_to(const Outline& other, double own) const {
    if (other.empty()) return false;
    if (!strip_) return apart(other) <= reach_.way + between_ + own;
    const double way = std::min(strip_->way + between_, far);
    if (meeting_of(strip_->swept, other, strip_->push).way <= way) return true;
    const Outline all = swept_along(strip_->swept, way * strip_->push);
    return own > 0.0 && distance_between(all, other) <= own;
  }

  /// From the middle of the base to the outline, less the base's own size. [m]
  double apart(const Outline& other) const {
    solver::Vector3 middle = solver::Vector3::Zero();
    for (const solver::Vector3& corner : start_) middle += corner / static_cast<double>(start_.size());
    double size = 0.0;
    for (const solver::Vector3& corner : start_) size = std::max(size, (corner - middle).norm());
    return std::max(0.0, plane::distance_to_edges(other, middle) - size);
  }

  double way_of(const Program& program) const {
    const double speed = driven_speed(program);
    return speed > 0.0 ? way_in(speed, reach_.time) : 0.0;
  }

  const Scene& scene_;
  const Robot& robot_;
  Reach reach_;
  const std::optional<Strip>& strip_;
  Outline start_;
  double between_ = 0.0;  ///< [m] of all that gives way
};

struct Hop {
  const PlannedAxis *push = nullptr, *way = nullptr;
};

Hop hop_of(const PlannedTask& plan) {
  for (const PlannedAxis& push : plan.axes) {
    if (!is_own_way(push) || *push.driver != solver::Quantity::force || push.target == 0.0) continue;
    for (const PlannedAxis& way : plan.axes) {
      const bool drives = is_own_way(way) && *way.driver == solver::Quantity::velocity && !way.is_yield &&
                          !way.stands_still() && way.axis != push.axis;
      if (drives) return {&push, &way};
    }
  }
  return {};
}

/// nullopt where nobody knows how the base heads by then.
std::optional<Strip> strip_of(const PlannedTask& plan, const Hop& hop, bool is_first, double time,
                              const Robot& robot, const Scene& scene) {
  constexpr double overshoot = 1.1;  // of a driver of velocity
  if (!is_first || !holds_its_heading(plan) || !hop.push->target || !hop.way->target) return std::nullopt;
  const auto sign = [](double value) { return value < 0.0 ? -1.0 : 1.0; };
  const double along = std::min(far, overshoot * std::abs(*hop.way->target) * time);
  const solver::Vector3 way = along * own_direction(*hop.way, sign(*hop.way->target), robot, scene);
  return Strip{swept_along(outline_at_start(robot, scene), way),
               own_direction(*hop.push, sign(*hop.push->target), robot, scene),
               way_in(plan.speed_limit(*hop.push), time)};
}

}  // namespace

void ask_hopping(const CheckContext& context, const PlannedTask& plan, const ExitConditions& conditions,
                 const AllTasks& all, Probe& probe, Remarks& remarks) {
  const Robot& robot = probe.robot();
  const Hop hop = rolls_on_driven_swivels(robot.model) ? hop_of(plan) : Hop{};
  if (hop.push == nullptr) return;
  // Without a scene nobody knows what stands beside the way.
  if (all.scene) {
    const bool is_first = plan.task->name.text == context.file.start.text &&
                          !is_entered_again(context, plan.task->name.text) && !leads_back(context);
    const auto index = static_cast<std::size_t>(plan.task - context.file.tasks.data());
    const std::optional<Strip> strip = strip_of(
        plan, hop, is_first, latest_end(context, plan, conditions.of_tasks[index]), robot, *all.scene);
    const Reach reach = reach_of_run(context, conditions, all, probe);
    if (!Beside(*all.scene, robot, reach, strip).any_is_stiff()) return;
  }
  remarks.add(
      wording::hops_along(hop.push->driver_span(), hop.push->path, hop.way->path, hop.way->driver_span()));
}

}  // namespace zwang::lang
