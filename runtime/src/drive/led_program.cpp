#include "drive/led_program.hpp"

namespace zwang::runtime {

namespace {

solver::RigidInertia times(const solver::RigidInertia& inertia, double factor) {
  solver::RigidInertia more = inertia;
  more.mass *= factor;
  more.first_moment *= factor;
  more.rotational *= factor;
  return more;
}

/// In the order of the frames, which links and declared frames share.
solver::Model times(const solver::Model& model, double factor) {
  const std::vector<solver::Body>& bodies = model.bodies();
  solver::ModelBuilder builder(model.base_type(), bodies.front().name, times(bodies.front().inertia, factor));
  builder.set_steering_error(model.steering_error());
  for (std::size_t f = 1; f < model.frames().size(); ++f) {
    const solver::Frame& frame = model.frames()[f];
    const solver::Body& body = bodies[static_cast<std::size_t>(frame.body)];
    if (frame.body == 0 || frame.name != body.name) {
      builder.add_frame(frame.name, body.name, frame.pose_in_body);
      continue;
    }
    solver::Joint joint = body.joint;
    joint.rotor_inertia *= factor;
    joint.max_effort *= factor;
    builder.add_link(body.name, bodies[static_cast<std::size_t>(body.parent)].name, body.pose_in_parent,
                     joint, times(body.inertia, factor));
  }
  for (const solver::Wheel& wheel : model.wheels())
    builder.add_wheel(model.joint(wheel.body - 1).name, wheel);
  return builder.set_gravity(model.gravity()).build();
}

}  // namespace

lang::Program led_program(const lang::Program& program) {
  lang::Program led = program;
  const double factor = program.robot.drive.mass_factor;
  if (!program.robot.drive.feels_contact() || factor == 1.0) return led;
  led.robot.model = times(program.robot.model, factor);
  led.robot.slew *= factor;
  return led;
}

}  // namespace zwang::runtime
