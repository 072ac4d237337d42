#include "guard/motor_watch.hpp"

namespace zwang::runtime {

MotorWatch::MotorWatch(const lang::Robot& robot, double period)
    : signs_(robot, period),
      actuators_(robot, period),
      beside_contact_(robot, period),
      runaway_(robot.model.joint_count(), robot.model.total_mass(), period),
      reversed_(robot, runaway_.period_of_looks()),
      contact_(robot, runaway_.period_of_looks()),
      pusher_(robot, runaway_.period_of_looks()) {}

void MotorWatch::reset() noexcept {
  signs_.pause();
  actuators_.reset();
  beside_contact_.reset();
  runaway_.reset();
  reversed_.reset();
  contact_.reset();
  pusher_.reset();
}

std::optional<Event> MotorWatch::look(DisturbanceObserver& observer, const solver::State& state,
                                      const Eigen::VectorXd& sent, const solver::ConstraintSet& set,
                                      bool blends) noexcept {
  std::optional<Event> first = signs_.look(observer);
  const auto take = [&first](const std::optional<Event>& found) {
    if (!first) first = found;
  };
  const auto take_unless_pushed = [&](const std::optional<Event>& found) {
    if (!pusher_.is_at_work()) take(found);
  };
  take_unless_pushed(actuators_.look(observer, state.q, contact_));
  take_unless_pushed(beside_contact_.look(observer, state.q, contact_));
  if (!runaway_.follow(sent, state.qd)) return first;
  const double power = observer.power(runaway_.rates());
  const auto p = observer.force().head(observer.motions().count);
  const double energy = observer.kinetic_energy(runaway_.rates());
  contact_.follow(observer.motions(), p, power, energy);
  pusher_.look(observer, power, runaway_.rates());
  take_unless_pushed(reversed_.look(power, observer.torque(), runaway_.rates(), contact_));
  take(runaway_.look(set, energy, p, contact_, pusher_.is_at_work(), blends));
  return first;
}

}  // namespace zwang::runtime
