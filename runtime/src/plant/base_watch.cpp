#include "base_watch.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

using solver::Matrix3;
using solver::Vector3;

BaseWatch::BaseWatch(const MovingRobot& robot, double period)
    : means_(period), slip_(robot.model(), period), state_(robot.model()) {}

void BaseWatch::read_lean(const MovingRobot& robot, const mjModel_& m, const mjData_& d,
                          BaseTruth& truth) noexcept {
  const Matrix3 rotation = robot.base_rotation(m, d);
  truth.roll = std::atan2(rotation(2, 1), rotation(2, 2));
  truth.pitch = std::atan2(-rotation(2, 0), std::hypot(rotation(2, 1), rotation(2, 2)));
}

void BaseWatch::read_motion(const MovingRobot& robot, const mjModel_& m, const mjData_& d,
                            const RobotContacts& contacts, double before, double now,
                            BaseTruth& truth) noexcept {
  const Vector3 speed = robot.base_rotation(m, d) * robot.base_twist(m, d).linear;
  means_.look(speed.head<2>(), contacts.push, before < contacts.hit_until);
  truth.acceleration = means_.acceleration();
  truth.push = means_.push();
  const Vector3 at = robot.base_position(m, d);
  const Vector3 push(contacts.push.x(), contacts.push.y(), 0.0);
  truth.contact = robot.base_rotation(m, d).transpose() * push;
  truth.contact.z() = contacts.moment - (at.x() * push.y() - at.y() * push.x());
  if (!robot.is_on_ground()) return;
  robot.sense(m, d, state_);
  slip_.look(robot.model(), state_);
  truth.slip = slip_.speed();
  truth.most_slip = std::max(truth.most_slip, truth.slip);
  if (truth.slip > told_slip && !truth.slipped) truth.slipped = now;
}

void BaseWatch::look_for_fall(const MovingRobot& robot, const mjModel_& m, const mjData_& d,
                              const RobotContacts& contacts, double now, BaseTruth& truth) noexcept {
  if (truth.fallen || !robot.is_on_ground()) return;
  const double upright = robot.base_rotation(m, d)(2, 2);  // the cosine of its lean
  if (upright < std::cos(largest_lean) || contacts.lies_on_floor) truth.fallen = now;
}

}  // namespace zwang::runtime
