#include "zwang/runtime/mujoco_plant.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "plant_simulation.hpp"

namespace zwang::runtime {

namespace {

using solver::Matrix3;
using solver::Vector3;

bool is_finite(const mjtNum* numbers, int count) {
  return std::all_of(numbers, numbers + count, [](mjtNum x) { return std::isfinite(x); });
}

}  // namespace

void MujocoPlant::Simulation::latch_hooks() noexcept {
  for (const SimulatedDock& dock : docks) {
    if (truth.objects[dock.owner].latched || !dock.holds) continue;
    const Vector3 hook =
        vector_of(data->xpos + 3 * dock.hook_body) + matrix_of(data->xquat + 4 * dock.hook_body) * dock.hook;
    if (!is_in_reach(dock.dock, truth.objects[dock.owner], hook)) continue;
    if (truth.objects[dock.owner].force < dock.dock.press) continue;
    Eigen::Map<Vector3>(model->eq_data + mjNEQDATA * dock.equality) = dock.hook;
    Eigen::Map<Vector3>(model->eq_data + mjNEQDATA * dock.equality + 3) =
        matrix_of(data->xquat + 4 * dock.body).transpose() * (hook - vector_of(data->xpos + 3 * dock.body));
    model->eq_active[dock.equality] = 1;
    truth.objects[dock.owner].latched = time();
    contacts.note_catch(0, time());
  }
}

void MujocoPlant::Simulation::set_dock(std::size_t owner, bool holds) noexcept {
  for (SimulatedDock& dock : docks) {
    if (dock.owner != owner) continue;
    dock.holds = holds;
    if (holds || !truth.objects[owner].latched) continue;
    model->eq_active[dock.equality] = 0;
    truth.objects[owner].latched.reset();
    truth.objects[owner].pull = 0.0;
  }
}

void MujocoPlant::Simulation::read_pulls() noexcept {
  for (const SimulatedDock& dock : docks) {
    ObjectTruth& owner = truth.objects[dock.owner];
    const double outwards = owner.yaw + std::atan2(dock.dock.at[1], dock.dock.at[0]);
    for (int row = 0; row + 2 < data->ne; row += 3) {
      if (data->efc_id[row] != dock.equality) continue;
      const mjtNum* f = data->efc_force + row;
      owner.pull = -(f[0] * std::cos(outwards) + f[1] * std::sin(outwards));
      const Vector3 hook = vector_of(data->xpos + 3 * dock.hook_body) +
                           matrix_of(data->xquat + 4 * dock.hook_body) * dock.hook;
      contacts.add_push(0, dock.hook_part, vector_of(f), hook);
      if (dock.owner >= objects.size())
        contacts.add_push(dock.owner - objects.size() + 1, 0, -vector_of(f), hook);
    }
  }
}

void MujocoPlant::Simulation::read_objects() noexcept {
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const int body = objects[k].body;
    place_truth(objects[k], vector_of(data->xpos + 3 * body), matrix_of(data->xquat + 4 * body),
                truth.objects[k]);
    if (objects[k].guide) truth.objects[k].travel = data->qpos[objects[k].position];
  }
  for (std::size_t r = 1; r < robots.size(); ++r) {
    ObjectTruth& seen = truth.objects[objects.size() + r - 1];
    const Vector3 at = robots[r].base_position(*model, *data);
    seen.x = at.x();
    seen.y = at.y();
    seen.yaw = solver::yaw_of(robots[r].base_rotation(*model, *data));
    truth.robots[r - 1].velocity = robots[r].planar_twist(*model, *data);
  }
}

void MujocoPlant::Simulation::set_floor_friction(double coefficient) noexcept {
  for (int p = 0; p < model->npair; ++p) {
    if (rolling_in(p).wheel >= 0) set_pair_friction(p, coefficient);
  }
  for (MovingRobot& robot : robots) robot.set_floor_friction(coefficient);
}

void MujocoPlant::Simulation::set_wheel_friction(std::size_t robot, std::size_t wheel,
                                                 double coefficient) noexcept {
  for (int p = 0; p < model->npair; ++p) {
    const GeomOwner& rolling = rolling_in(p);
    if (rolling.wheel == static_cast<int>(wheel) && rolling.robot == static_cast<int>(robot))
      set_pair_friction(p, coefficient);
  }
  robots[robot].set_floor_friction(coefficient, wheel);
}

const GeomOwner& MujocoPlant::Simulation::rolling_in(int pair) const {
  const GeomOwner& one = owner_of(model->pair_geom1[pair]);
  return one.wheel >= 0 ? one : owner_of(model->pair_geom2[pair]);
}

void MujocoPlant::Simulation::set_pair_friction(int pair, double coefficient) noexcept {
  mjtNum* friction = model->pair_friction + 5 * pair;
  // Skidding wheels have next to none in the second direction.
  if (friction[1] == friction[0]) friction[1] = coefficient;
  friction[0] = coefficient;
}

bool MujocoPlant::Simulation::step() noexcept {
  const double before = data->time;
  for (MovingRobot& robot : robots) robot.push(*model, *data);
  for (SimulatedObject& object : objects) {
    object.position >= 0 ? follow_script(object, time(), data->qpos, data->qvel) : place_fixed(object);
    let_go(object, time());
    add_resistance(object, model->opt.timestep, data->qpos, data->qvel, data->qfrc_applied);
  }
  contact_friction.push(*model, *data);
  press_by_hand();
  if (!guarded(mj_step, model.get(), data.get())) return false;
  read_loads();
  const double elapsed = data->time - before;
  if (!(std::abs(elapsed - model->opt.timestep) < 1e-6 * model->opt.timestep)) return false;
  for (const mjWarningStat& warning : data->warning) {
    if (warning.number > 0) return false;
  }
  return is_finite(data->qpos, model->nq) && is_finite(data->qvel, model->nv) &&
         is_finite(data->qacc, model->nv);
}

void MujocoPlant::Simulation::place_fixed(const SimulatedObject& object) noexcept {
  if (object.described.motion.empty()) return;
  const ScriptedPose now = scripted_pose(object.described.motion, time());
  const Vector3 centre = scripted_centre(object, now);
  const mjtNum turn[] = {std::cos(0.5 * now.yaw), 0.0, 0.0, std::sin(0.5 * now.yaw)};
  std::copy(centre.data(), centre.data() + 3, model->body_pos + 3 * object.body);
  std::copy(std::begin(turn), std::end(turn), model->body_quat + 4 * object.body);
}

void MujocoPlant::Simulation::read_loads() noexcept {
  bool is_needed = false;
  for (MovingRobot& robot : robots) {
    is_needed = is_needed || robot.needs_loads();
    std::fill(robot.wheel_loads().begin(), robot.wheel_loads().end(), 0.0);
  }
  for (int c = 0; is_needed && c < data->ncon; ++c) {
    const GeomOwner &one = owner_of(data->contact[c].geom1), &other = owner_of(data->contact[c].geom2);
    const GeomOwner& rolling = one.wheel >= 0 ? one : other;
    if (rolling.wheel < 0) continue;
    std::array<mjtNum, 6> wrench{};
    mj_contactForce(model.get(), data.get(), c, wrench.data());
    robots[static_cast<std::size_t>(rolling.robot)].wheel_loads()[static_cast<std::size_t>(rolling.wheel)] +=
        wrench[0];
  }
}

void MujocoPlant::Simulation::read_base() noexcept {
  truth.time = time();
  const Vector3 at = first().base_position(*model, *data);
  truth.x = at.x();
  truth.y = at.y();
  truth.yaw = solver::yaw_of(first().base_rotation(*model, *data));
  for (std::size_t r = 0; r < robots.size(); ++r) {
    base_truth(r).mass = robots[r].mass(*model);
    BaseWatch::read_lean(robots[r], *model, *data, base_truth(r));
  }
}

void MujocoPlant::Simulation::read_motion(double before) noexcept {
  contact_friction.for_each([this](int geom1, int geom2, const Vector3& force, const Vector3& at) {
    if (owner_of(geom1).touches) add_push(owner_of(geom1), -force, at);
    if (owner_of(geom2).touches) add_push(owner_of(geom2), force, at);
  });
  for (std::size_t r = 0; r < robots.size(); ++r)
    watches[r].read_motion(robots[r], *model, *data, contacts.of_robot(r), before, time(), base_truth(r));
}

void MujocoPlant::Simulation::look_for_falls() noexcept {
  for (std::size_t r = 0; r < robots.size(); ++r)
    BaseWatch::look_for_fall(robots[r], *model, *data, contacts.of_robot(r), time(), base_truth(r));
}

void MujocoPlant::Simulation::add_push(const GeomOwner& owner, const Vector3& force,
                                       const Vector3& at) noexcept {
  contacts.add_push(static_cast<std::size_t>(owner.robot), owner.part, force, at);
}

double MujocoPlant::Simulation::time() const noexcept {
  return static_cast<double>(steps_since_start) * model->opt.timestep;
}

PlantStatus MujocoPlant::Simulation::give(std::size_t robot, const Eigen::VectorXd& tau) noexcept {
  if (diverged) return PlantStatus::diverged;
  return robots[robot].give(*data, tau, model->opt.timestep) ? PlantStatus::ok : PlantStatus::unreachable;
}

PlantStatus MujocoPlant::Simulation::apply(const Eigen::VectorXd& tau) noexcept {
  if (const PlantStatus given = give(0, tau); given != PlantStatus::ok) return given;
  const double before = time();
  if (!step()) {
    diverged = true;
    return PlantStatus::diverged;
  }
  ++steps_since_start;
  const Vector3 now = first().planar_twist(*model, *data);
  truth.acceleration = (now - velocity) / model->opt.timestep;
  truth.velocity = velocity = now;
  read_base();
  for (MovingRobot& robot : robots) robot.read(*model, *data);
  contacts.read(*model, *data, before, truth);
  read_objects();
  read_pulls();
  feel_hand();
  read_motion(before);
  read_wrenches();
  look_for_falls();
  latch_hooks();
  return PlantStatus::ok;
}

PlantStatus MujocoPlant::Simulation::sense(std::size_t robot, Sensed& sensed) const noexcept {
  if (diverged) return PlantStatus::diverged;
  if (sensed.state.q.size() != robots[robot].joint_count()) return PlantStatus::unreachable;
  sensed.time = time();
  robots[robot].sense(*model, *data, sensed.state);
  sensed.base_measured = true;
  return PlantStatus::ok;
}

template <typename Act>
void MujocoPlant::Simulation::for_each_push(Act act) const {
  for (const BodyPush& one : more_pushes) {
    const auto number = static_cast<std::size_t>(one.body);
    const int body =
        one.robot < 0 ? objects[number].body : bodies[static_cast<std::size_t>(one.robot)][number];
    const Matrix3 turned = matrix_of(data->xquat + 4 * body);
    Vector3 place = one.pose.position;
    if (one.robot < 0) place -= objects[number].geometry.shift;
    const Matrix3 axes = turned * one.pose.rotation;
    act(one, body, Vector3(vector_of(data->xpos + 3 * body) + turned * place),
        Vector3(axes * one.wrench.linear), Vector3(axes * one.wrench.angular));
  }
}

void MujocoPlant::Simulation::press_by_hand() noexcept {
  if (!push.force.isZero(0.0)) first().press(*model, *data, push.at, push.force);
  for_each_push([this](const BodyPush& /*one*/, int body, const Vector3& at, const Vector3& force,
                       const Vector3& torque) {
    const Vector3 arm = at - vector_of(data->xipos + 3 * body);
    Eigen::Map<Vector3>(data->xfrc_applied + 6 * body) += force;
    Eigen::Map<Vector3>(data->xfrc_applied + 6 * body + 3) += arm.cross(force) + torque;
  });
}

void MujocoPlant::Simulation::feel_hand() noexcept {
  for (ObjectTruth& object : truth.objects) object.hand = 0.0;
  for (std::size_t r = 0; r < robots.size(); ++r) base_truth(r).hand = 0.0;
  if (!push.force.isZero(0.0)) {
    contacts.add_push(0, 0, {push.force.x(), push.force.y(), 0.0}, first().in_world(*model, *data, push.at));
    truth.base.hand += push.force.norm();
  }
  for_each_push([this](const BodyPush& one, int /*body*/, const Vector3& at, const Vector3& force,
                       const Vector3& torque) {
    if (one.robot < 0) {
      truth.objects[static_cast<std::size_t>(one.body)].hand += force.norm();
      return;
    }
    const auto robot = static_cast<std::size_t>(one.robot);
    contacts.add_push(robot, one.body, force, at, torque);
    base_truth(robot).hand += force.norm();
    if (robot > 0) truth.objects[objects.size() + robot - 1].hand += force.norm();
  });
}

void MujocoPlant::Simulation::read_wrenches() noexcept {
  for (const WrenchSensor& sensor : sensors) {
    solver::ForceVector sum;
    for (const std::size_t body : sensor.carried) sum += contacts.of_robot(sensor.robot).on_body[body];
    const Matrix3 turned = matrix_of(data->xquat + 4 * sensor.body);
    const Vector3 at = vector_of(data->xpos + 3 * sensor.body) + turned * sensor.pose.position;
    const Matrix3 to_sensor = (turned * sensor.pose.rotation).transpose();
    truth.wrenches[sensor.robot][sensor.signal] = {to_sensor * (sum.angular - at.cross(sum.linear)),
                                                   to_sensor * sum.linear};
  }
}

MujocoPlant::MujocoPlant(const lang::Robot& robot, const lang::Scene& scene,
                         const MujocoPlantOptions& options)
    : simulation_(std::make_unique<Simulation>(robot, scene, options)) {}

MujocoPlant::~MujocoPlant() = default;

std::string describe_fall(const BaseTruth& base) {
  constexpr double degree = std::numbers::pi / 180.0;
  // Roll turns about x, which points ahead, pitch about y, which points left: positive ones lower the right
  // and the front.
  const bool ahead_or_back = std::abs(base.pitch) >= std::abs(base.roll);
  const double angle = ahead_or_back ? base.pitch : base.roll;
  const char* side =
      ahead_or_back ? (angle > 0.0 ? "front" : "back") : (angle > 0.0 ? "right side" : "left side");
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "the base tipped over its %s, %s %.0f deg", side,
                ahead_or_back ? "pitch" : "roll", angle / degree);
  return text.data();
}

PlantStatus MujocoPlant::sense(Sensed& sensed) noexcept {
  return simulation_->sense(0, sensed);
}

PlantStatus MujocoPlant::apply(const Eigen::VectorXd& tau) noexcept {
  return simulation_->apply(tau);
}

PlantStatus MujocoPlant::sense_partner(std::size_t partner, Sensed& sensed) const noexcept {
  return simulation_->sense(partner + 1, sensed);
}

PlantStatus MujocoPlant::give_partner(std::size_t partner, const Eigen::VectorXd& tau) noexcept {
  return simulation_->give(partner + 1, tau);
}

const Truth& MujocoPlant::truth() const noexcept {
  return simulation_->truth;
}

void MujocoPlant::set_push(const Push& push) noexcept {
  simulation_->push = push;
}

void MujocoPlant::set_more_pushes(std::span<const BodyPush> pushes) noexcept {
  simulation_->more_pushes.assign(pushes.begin(), pushes.end());
}

void MujocoPlant::set_floor_friction(double coefficient) noexcept {
  simulation_->set_floor_friction(coefficient);
}

void MujocoPlant::set_payload(double mass) noexcept {
  simulation_->first().set_payload(*simulation_->model, mass);
}

void MujocoPlant::set_partner_payload(std::size_t partner, double mass) noexcept {
  if (partner + 1 < simulation_->robots.size())
    simulation_->robots[partner + 1].set_payload(*simulation_->model, mass);
}

void MujocoPlant::set_wheel_friction(std::size_t robot, std::size_t wheel, double coefficient) noexcept {
  if (robot < simulation_->robots.size()) simulation_->set_wheel_friction(robot, wheel, coefficient);
}

void MujocoPlant::shift_centre_of_mass(std::size_t robot, double ahead) noexcept {
  if (robot < simulation_->robots.size())
    simulation_->robots[robot].shift_centre_of_mass(*simulation_->model, ahead);
}

void MujocoPlant::scale_inertia(std::size_t robot, double factor) noexcept {
  if (robot < simulation_->robots.size())
    simulation_->robots[robot].scale_inertia(*simulation_->model, factor);
}

void MujocoPlant::move_object(std::size_t object, std::vector<lang::Waypoint> motion) {
  if (object >= simulation_->objects.size()) return;
  SimulatedObject& moved = simulation_->objects[object];
  if (!moved.described.guide && !moved.described.leans()) moved.described.motion = std::move(motion);
}

void MujocoPlant::set_dock(std::size_t owner, bool holds) noexcept {
  simulation_->set_dock(owner, holds);
}

void MujocoPlant::diverge() noexcept {
  simulation_->diverged = true;
}

const std::string& MujocoPlant::mjcf() const noexcept {
  return simulation_->text;
}

}  // namespace zwang::runtime
