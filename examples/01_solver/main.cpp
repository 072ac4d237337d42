// The solver alone: a base on four mecanum wheels, written in code, drives ahead at 0.3 m/s. It may spend 20
// N on that and no more, so it gains speed slowly at first; what is in its way would feel no more than that
// either.

#include <cstdio>
#include <numbers>
#include <string>

#include "zwang/solver/constraint.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/solver.hpp"
#include "zwang/solver/state.hpp"

namespace {

using namespace zwang::solver;

constexpr double wheel_radius = 0.076;  // [m]

RigidInertia chassis() {
  return RigidInertia::from_com(37.0, {0.0, 0.0, 0.13}, Vector3(0.8, 1.6, 2.1).asDiagonal());
}

RigidInertia wheel() {
  return RigidInertia::from_com(2.3, Vector3::Zero(), Vector3(0.0045, 0.0066, 0.0045).asDiagonal());
}

Model mecanum_base() {
  const double roller = std::numbers::pi / 4.0;
  const struct {
    const char* name;
    double x, y, roller_angle;
  } corners[] = {{"front_left", 0.3, 0.25, roller},
                 {"front_right", 0.3, -0.25, -roller},
                 {"rear_left", -0.3, 0.25, -roller},
                 {"rear_right", -0.3, -0.25, roller}};

  ModelBuilder builder(BaseType::ground, "base_link", chassis());
  for (const auto& corner : corners) {
    const Joint motor{.name = corner.name,
                      .type = JointType::continuous,
                      .axis = Vector3::UnitY(),
                      .rotor_inertia = 0.009,
                      .actuated = true,
                      .max_effort = 1.9};
    const Pose at{Matrix3::Identity(), Vector3(corner.x, corner.y, wheel_radius)};
    const Wheel mecanum{.radius = wheel_radius, .roller_angle = corner.roller_angle};
    builder.add_link(std::string(corner.name) + "_wheel", "base_link", at, motor, wheel());
    builder.add_wheel(corner.name, mecanum);
  }
  return builder.build();
}

// A velocity of the base along one of its own axes, with a limit on the force spent on it.
AxisConstraint drive(Axis axis, double velocity, double max_force) {
  AxisConstraint constraint;
  constraint.move.body = 0;
  constraint.in.body = 0;
  constraint.axis = axis;
  constraint.driver = Driver{.target = velocity, .force = {-max_force, max_force}};
  return constraint;
}

// One step of the motion that the solver computed: here it stands in for the robot.
void advance(State& state, const Solution& solution, double dt) {
  state.base_twist += solution.acceleration[0] * dt;
  state.base_pose.position += state.base_pose.rotation * state.base_twist.linear * dt;
  state.qd += solution.qdd * dt;
  state.q += state.qd * dt;
}

}  // namespace

int main() {
  const Model model = mecanum_base();
  Solver solver(model);
  Solution solution(model);
  State state(model);

  ConstraintSet constraints;
  constraints.add(drive(Axis::x, 0.3, 20.0));
  constraints.add(drive(Axis::y, 0.0, 20.0));
  constraints.add(drive(Axis::rz, 0.0, 5.0));

  const double dt = 0.001;
  std::printf("  time    speed    force   wheel torques\n");
  for (int tick = 0; tick <= 3000; ++tick) {
    Status status = solver.project_velocity(state);  // takes out what a real robot's sensors put in
    if (!constraints.fill(model, state)) return 1;
    if (status == Status::ok) status = solver.solve(state, constraints.rows(), solution);
    if (status != Status::ok) {
      std::fprintf(stderr, "solver: %s\n", to_string(status));
      return 1;
    }
    if (tick % 500 == 0) {
      std::printf("%4.1f s %5.3f m/s %6.2f N  ", tick * dt, state.base_twist.linear.x(), solution.rows[0].nu);
      for (const double torque : solution.tau) std::printf(" %6.3f", torque);
      std::printf(" N m\n");
    }
    advance(state, solution, dt);
  }
  return state.base_twist.linear.x() > 0.29 ? 0 : 1;
}
