#include "schedule/kinetic_energy.hpp"

namespace zwang::runtime {

double kinetic_energy(const solver::Model& model, const solver::State& state,
                      solver::BodyMotions& motions) noexcept {
  double twice = 0.0;
  for (std::size_t i = 0; i < model.bodies().size(); ++i) {
    const solver::Body& body = model.bodies()[i];
    const solver::MotionVector V = motions.twist_of(static_cast<int>(i));
    twice += dot(body.inertia * V, V);
    if (i == 0) continue;
    const double rate = state.qd(static_cast<Eigen::Index>(i) - 1);
    twice += body.joint.rotor_inertia * rate * rate;
  }
  return 0.5 * twice;
}

}  // namespace zwang::runtime
