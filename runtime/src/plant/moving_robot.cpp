#include "moving_robot.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "simulator.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::runtime {

using solver::Matrix3;
using solver::Vector3;

MovingRobot::MovingRobot(const SimulatedRobot& simulated, double floor_friction)
    : simulated_(simulated),
      posture_(lang::start_state(simulated.robot).q),
      side_friction_(simulated.robot.model, floor_friction),
      joint_friction_(simulated.robot),
      torque_(Eigen::VectorXd::Zero(simulated.robot.model.joint_count())),
      wheel_loads_(simulated.robot.model.wheels().size(), 0.0),
      q_(posture_),
      qd_(Eigen::VectorXd::Zero(simulated.robot.model.joint_count())) {}

void MovingRobot::find_addresses(const mjModel& m) {
  const auto id_of = [&](mjtObj type, const std::string& name) { return mj_name2id(&m, type, name.c_str()); };
  base_body_ = id_of(mjOBJ_BODY, simulated_.named("body", 0));
  remember_base(m);
  if (floats()) {
    const int base = id_of(mjOBJ_JOINT, simulated_.prefix + "base");
    base_position_ = m.jnt_qposadr[base];
    base_velocity_ = m.jnt_dofadr[base];
  }
  freedoms_ = floats() ? 6 : 0;
  for (int j = 0; j < model().joint_count(); ++j) {
    const auto number = static_cast<std::size_t>(j);
    const int id = id_of(mjOBJ_JOINT, simulated_.named("joint", number));
    JointAddress address;
    address.position = m.jnt_qposadr[id];
    address.velocity = m.jnt_dofadr[id];
    address.motor = id_of(mjOBJ_ACTUATOR, simulated_.named("motor", number));
    for (const RollingSphere& sphere : simulated_.spheres.spheres) {
      if (sphere.body == j + 1) address.sphere = &sphere;
    }
    address.turns_wheel = solver::turns_wheel(model(), j + 1);
    freedoms_ += address.sphere != nullptr ? 3 : 1;
    joints_.push_back(address);
  }
  for (const RollerWheel& wheel : simulated_.rollers) freedoms_ += static_cast<int>(wheel.rollers.size());
}

void MovingRobot::remember_base(const mjModel& m) {
  const solver::RigidInertia& own = model().bodies().front().inertia;
  as_built_.mass = m.body_mass[base_body_];
  as_built_.centre = m.body_ipos[3 * base_body_];
  const Matrix3 to_centre =
      own.mass > 0.0
          ? solver::RigidInertia::from_com(own.mass, own.first_moment / own.mass, Matrix3::Zero()).rotational
          : Matrix3(Matrix3::Zero());
  const Matrix3 axes = matrix_of(m.body_iquat + 4 * base_body_);
  as_built_.inertia = vector_of(m.body_inertia + 3 * base_body_);
  as_built_.own_inertia = (axes.transpose() * (own.rotational - to_centre) * axes).diagonal();
}

void MovingRobot::set_payload(mjModel& m, double mass) const noexcept {
  const double change = as_built_.mass + mass - m.body_mass[base_body_];
  m.body_mass[base_body_] += change;
  m.body_subtreemass[base_body_] += change;
  m.body_subtreemass[0] += change;
}

double MovingRobot::mass(const mjModel& m) const noexcept {
  return m.body_subtreemass[base_body_];
}

void MovingRobot::shift_centre_of_mass(mjModel& m, double ahead) const noexcept {
  // Else the simulator takes the body's own frame for the one of its inertia.
  m.body_sameframe[base_body_] = 0;
  m.body_ipos[3 * base_body_] = as_built_.centre + ahead;
}

void MovingRobot::scale_inertia(mjModel& m, double factor) const noexcept {
  const Vector3 scaled = as_built_.inertia + (factor - 1.0) * as_built_.own_inertia;
  std::copy(scaled.data(), scaled.data() + 3, m.body_inertia + 3 * base_body_);
}

void MovingRobot::place(mjModel& m, mjData& d, const std::array<double, 2>& at, double yaw) {
  const std::array<double, 4> turn = {std::cos(0.5 * yaw), 0.0, 0.0, std::sin(0.5 * yaw)};
  mjtNum* position = floats() ? d.qpos + base_position_ : m.body_pos + 3 * base_body_;
  mjtNum* orientation = floats() ? position + 3 : m.body_quat + 4 * base_body_;
  std::copy(at.begin(), at.end(), position);
  std::copy(turn.begin(), turn.end(), orientation);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (joints_[j].sphere != nullptr) continue;
    d.qpos[joints_[j].position] = posture_[static_cast<Eigen::Index>(j)];
  }
  q_ = posture_;
}

void MovingRobot::hold_joints(mjData& d) const noexcept {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (joints_[j].turns_wheel) continue;
    d.qpos[joints_[j].position] = posture_[static_cast<Eigen::Index>(j)];
    d.qvel[joints_[j].velocity] = 0.0;
    d.qfrc_applied[joints_[j].velocity] = d.qfrc_bias[joints_[j].velocity];
  }
}

Vector3 MovingRobot::sinking(const mjData& d) const noexcept {
  return vector_of(d.qacc + base_velocity_ + 2);
}

void MovingRobot::stand(mjData& d, double yaw, double height, const Matrix3& tilted) const noexcept {
  const double turn = yaw - std::atan2(tilted(1, 0), tilted(0, 0));
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(turn, Vector3::UnitZ()) * tilted);
  const std::array<double, 4> orientation = {turned.w(), turned.x(), turned.y(), turned.z()};
  d.qpos[base_position_ + 2] = height;
  std::copy(orientation.begin(), orientation.end(), d.qpos + base_position_ + 3);
}

bool MovingRobot::give(mjData& d, const Eigen::VectorXd& tau, double period) noexcept {
  if (tau.size() != q_.size() || !tau.allFinite()) return false;
  torque_ = tau;
  joint_friction_.add_to(torque_, qd_, period);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const double given = torque_[static_cast<Eigen::Index>(j)];
    if (joints_[j].motor >= 0) {
      d.ctrl[joints_[j].motor] = given;
    } else if (joints_[j].sphere == nullptr) {
      d.qfrc_applied[joints_[j].velocity] = given;
    }
  }
  return true;
}

void MovingRobot::push(const mjModel& m, mjData& d) noexcept {
  if (simulated_.spheres.spheres.empty() && side_friction_.empty()) return;
  // A free joint takes its force in world axes and its torque in the body's.
  const solver::MotionVector twist = base_twist(m, d);
  const solver::ForceVector wrench =
      sphere_products(simulated_.spheres, twist) + side_friction_.step(twist, wheel_loads_, m.opt.timestep);
  Eigen::Map<Vector3>(d.qfrc_applied + base_velocity_) = base_rotation(m, d) * wrench.linear;
  Eigen::Map<Vector3>(d.qfrc_applied + base_velocity_ + 3) = wrench.angular;
}

void MovingRobot::press(const mjModel& m, mjData& d, const Eigen::Vector2d& at,
                        const Eigen::Vector2d& force) const noexcept {
  // The simulation takes the force at the body's centre of mass.
  const Vector3 arm =
      base_rotation(m, d) * (Vector3(at.x(), at.y(), 0.0) - vector_of(m.body_ipos + 3 * base_body_));
  const Vector3 whole(force.x(), force.y(), 0.0);
  Eigen::Map<Vector3>(d.xfrc_applied + 6 * base_body_) += whole;
  Eigen::Map<Vector3>(d.xfrc_applied + 6 * base_body_ + 3) += arm.cross(whole);
}

Vector3 MovingRobot::in_world(const mjModel& m, const mjData& d, const Eigen::Vector2d& at) const noexcept {
  return base_position(m, d) + base_rotation(m, d) * Vector3(at.x(), at.y(), 0.0);
}

void MovingRobot::read(const mjModel& m, const mjData& d) noexcept {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointAddress& address = joints_[j];
    const auto i = static_cast<Eigen::Index>(j);
    if (address.sphere == nullptr) {
      q_[i] = d.qpos[address.position];
      qd_[i] = d.qvel[address.velocity];
    } else {
      // The joint's velocity is in the sphere's own axes, and relative to the base.
      const Vector3 spin = matrix_of(d.qpos + address.position) * vector_of(d.qvel + address.velocity);
      qd_[i] = address.sphere->torque_direction().dot(spin);
      q_[i] += m.opt.timestep * qd_[i];
    }
  }
}

void MovingRobot::sense(const mjModel& m, const mjData& d, solver::State& state) const noexcept {
  state.q = q_;
  state.qd = qd_;
  state.base_pose.rotation = base_rotation(m, d);
  state.base_pose.position = base_position(m, d);
  state.base_twist = base_twist(m, d);
}

Vector3 MovingRobot::base_position(const mjModel& m, const mjData& d) const noexcept {
  return vector_of(floats() ? d.qpos + base_position_ : m.body_pos + 3 * base_body_);
}

Matrix3 MovingRobot::base_rotation(const mjModel& m, const mjData& d) const noexcept {
  return matrix_of(floats() ? d.qpos + base_position_ + 3 : m.body_quat + 4 * base_body_);
}

solver::MotionVector MovingRobot::base_twist(const mjModel& m, const mjData& d) const noexcept {
  if (!floats()) return {};
  return {vector_of(d.qvel + base_velocity_ + 3),
          base_rotation(m, d).transpose() * vector_of(d.qvel + base_velocity_)};
}

Vector3 MovingRobot::planar_twist(const mjModel& m, const mjData& d) const noexcept {
  const solver::MotionVector twist = base_twist(m, d);
  return {twist.linear.x(), twist.linear.y(), twist.angular.z()};
}

}  // namespace zwang::runtime
