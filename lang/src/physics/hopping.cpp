// W645: a push across the way of a base whose driven wheels swivel by themselves.
//
// Such a wheel holds the base across its heading, and turns its heading only as it rolls. At a wall beside
// the way, the base comes off as the wheels turn from the push to the way. It comes back at an angle, and the
// wheels drive it into the wall until they have turned. That goes on for as long as it drives. In the
// simulation walls of 5 kN/m and more are hopped along, whatever their damping. A box that gives way is not.
// Another robot on such wheels holds against the push as a wall does, and so does a box that it holds. Two of
// them squeeze a box with 0 to 135 N instead of 25 N. A robot on mecanum wheels gives way evenly.
#include <algorithm>

#include "diagnostic/wordings_never.hpp"
#include "physics/questions.hpp"
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

/// Without a scene nobody knows what stands beside the way.
bool may_be_stiff(const std::optional<Scene>& scene) {
  constexpr double least_stiffness = 5e3;  // [N/m]
  if (!scene) return true;
  const auto is_wall = [](const SceneObject& object) {
    return !object.moves() && object.stiffness >= least_stiffness;
  };
  const auto holds_against = [](const SceneRobot& robot) {
    return robot.stiffness >= least_stiffness && robot.program &&
           rolls_on_driven_swivels(robot.program->robot.model);
  };
  return std::any_of(scene->objects.begin(), scene->objects.end(), is_wall) ||
         std::any_of(scene->robots.begin(), scene->robots.end(), holds_against);
}

}  // namespace

void ask_hopping(const PlannedTask& plan, const std::optional<Scene>& scene, const Probe& probe,
                 Remarks& remarks) {
  if (!may_be_stiff(scene) || !rolls_on_driven_swivels(probe.robot().model)) return;
  for (const PlannedAxis& push : plan.axes) {
    if (!is_own_way(push) || *push.driver != solver::Quantity::force || push.target == 0.0) continue;
    for (const PlannedAxis& way : plan.axes) {
      const bool drives = is_own_way(way) && *way.driver == solver::Quantity::velocity && !way.is_yield &&
                          !way.stands_still() && way.axis != push.axis;
      if (!drives) continue;
      remarks.add(wording::hops_along(push.driver_span(), push.path, way.path, way.driver_span()));
      return;
    }
  }
}

}  // namespace zwang::lang
