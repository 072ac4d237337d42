#include "zwang/runtime/mujoco_plant.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "joint_friction.hpp"
#include "mjcf.hpp"
#include "side_friction.hpp"
#include "simulated_object.hpp"
#include "simulator.hpp"

namespace zwang::runtime {

namespace {

using solver::Matrix3;
using solver::Model;
using solver::Vector3;

constexpr double settling_time = 0.5;   ///< [s] before t = 0, without torque
constexpr double start_overlap = 1e-5;  ///< [m] allowed between robot and objects at the start

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("plant: " + what);
}

Matrix3 matrix_of(const mjtNum* quaternion) {
  return Eigen::Quaterniond(quaternion[0], quaternion[1], quaternion[2], quaternion[3]).toRotationMatrix();
}

Vector3 vector_of(const mjtNum* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

std::string numbered(const char* name, int number) {
  return std::string(name) + '_' + std::to_string(number);
}

bool is_finite(const mjtNum* numbers, int count) {
  return std::all_of(numbers, numbers + count, [](mjtNum x) { return std::isfinite(x); });
}

double yaw_of(const Matrix3& rotation) {
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

}  // namespace

struct MujocoPlant::Simulation {
  /// How one joint of the model is read.
  struct JointAddress {
    int position = 0;                       ///< in qpos
    int velocity = 0;                       ///< in qvel
    int motor = -1;                         ///< in ctrl; -1 without a motor
    const RollingSphere* sphere = nullptr;  ///< set: a ball joint; q is integrated
    bool turns_wheel = false;
  };
  Simulation(const lang::Robot& robot, const lang::Scene& scene, const MujocoPlantOptions& options)
      : robot_model(robot.model),
        simulated(prepare_robot(robot, options.real_rollers)),
        posture(lang::start_state(robot).q),
        side_friction(robot.model, scene.floor_friction),
        joint_friction(robot),
        wheel_loads(robot.model.wheels().size(), 0.0) {
    install_handlers();
    if (!(options.period > 0.0) || options.period > 0.01) refuse("the period is not within 0 and 10 ms");
    text = write_mjcf(robot, simulated, scene, options.period);
    model = compile(text);
    data.reset(mj_makeData(model.get()));
    if (!data) refuse("MuJoCo has no memory for the simulation");
    find_addresses();
    require_as_written(*model, robot_model, simulated);
    owners = find_owners(*model, simulated, robot.footprint);
    set_springs(*model, owners, scene, robot_model.total_mass());
    truth.corner_forces.assign(robot.footprint.size(), 0.0);
    for (const lang::SceneObject& object : scene.objects)
      truth.objects.push_back({object.name, 0.0, {}, 0.0});
    find_objects(scene);
    torque = Eigen::VectorXd::Zero(robot_model.joint_count());
    base_mass = model->body_mass[base_body];
    const std::array<double, 2> at = options.start_at.value_or(scene.start_at);
    start(at, options.start_yaw.value_or(scene.start_yaw));
  }

  int id_of(mjtObj type, const std::string& name) const {
    return mj_name2id(model.get(), type, name.c_str());
  }

  bool floats() const { return !robot_model.has_fixed_base(); }

  void find_addresses() {
    base_body = id_of(mjOBJ_BODY, "body_0");
    int freedoms = floats() ? 6 : 0;
    for (int j = 0; j < robot_model.joint_count(); ++j) {
      const int id = id_of(mjOBJ_JOINT, numbered("joint", j));
      JointAddress address;
      address.position = model->jnt_qposadr[id];
      address.velocity = model->jnt_dofadr[id];
      address.motor = id_of(mjOBJ_ACTUATOR, numbered("motor", j));
      for (const RollingSphere& sphere : simulated.spheres.spheres) {
        if (sphere.body == j + 1) address.sphere = &sphere;
      }
      for (const solver::Wheel& wheel : robot_model.wheels()) {
        if (wheel.body == j + 1) address.turns_wheel = true;
      }
      freedoms += address.sphere != nullptr ? 3 : 1;
      joints.push_back(address);
    }
    for (const RollerWheel& wheel : simulated.rollers) freedoms += static_cast<int>(wheel.rollers.size());
    for (int j = 0; j < model->njnt; ++j) {
      const char* name = mj_id2name(model.get(), mjOBJ_JOINT, j);
      if (std::strncmp(name, "object_", 7) == 0) freedoms += 1;
    }
    if (model->nv != freedoms) refuse("MuJoCo changed the number of freedoms");
    q = posture;
    qd.setZero(robot_model.joint_count());
  }

  void find_objects(const lang::Scene& scene) {
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
      const lang::SceneObject& object = scene.objects[k];
      const std::string name = numbered("object", static_cast<int>(k));
      SimulatedObject simulated_object{.described = object, .geometry = geometry_of(object)};
      simulated_object.body = id_of(mjOBJ_BODY, name);
      const int joint = id_of(mjOBJ_JOINT, name + "_x");
      if (joint >= 0) {
        simulated_object.position = model->jnt_qposadr[joint];
        simulated_object.velocity = model->jnt_dofadr[joint];
      }
      if (object.mass)
        simulated_object.friction =
            floor_friction_of(object, scene.floor_friction, robot_model.gravity().norm());
      if (object.dock) {
        const solver::Frame& hook = hook_of(robot_model, object);
        simulated_object.hook_body = id_of(mjOBJ_BODY, numbered("body", hook.body));
        simulated_object.hook = hook.pose_in_body.position;
        simulated_object.equality = id_of(mjOBJ_EQUALITY, numbered("dock", static_cast<int>(k)));
      }
      objects.push_back(std::move(simulated_object));
    }
  }

  /// A hook that is near enough to its socket is tied to the object where it is.
  void latch_hooks() noexcept {
    for (std::size_t k = 0; k < objects.size(); ++k) {
      const SimulatedObject& object = objects[k];
      if (object.equality < 0 || truth.objects[k].latched) continue;
      const Vector3 hook = vector_of(data->xpos + 3 * object.hook_body) +
                           matrix_of(data->xquat + 4 * object.hook_body) * object.hook;
      if (!is_in_reach(object, truth.objects[k], hook)) continue;
      Eigen::Map<Vector3>(model->eq_data + mjNEQDATA * object.equality) = object.hook;
      Eigen::Map<Vector3>(model->eq_data + mjNEQDATA * object.equality + 3) =
          matrix_of(data->xquat + 4 * object.body).transpose() *
          (hook - vector_of(data->xpos + 3 * object.body));
      model->eq_active[object.equality] = 1;
      truth.objects[k].latched = true;
    }
  }

  void read_objects() noexcept {
    for (std::size_t k = 0; k < objects.size(); ++k) {
      const int body = objects[k].body;
      place_truth(objects[k], vector_of(data->xpos + 3 * body), matrix_of(data->xquat + 4 * body),
                  truth.objects[k]);
    }
  }

  void set_floor_friction(double coefficient) noexcept {
    for (int p = 0; p < model->npair; ++p) {
      const int wheel = std::max(owner_of(model->pair_geom1[p]).wheel, owner_of(model->pair_geom2[p]).wheel);
      if (wheel < 0) continue;
      mjtNum* friction = model->pair_friction + 5 * p;
      // Skidding wheels have next to none in the second direction.
      if (friction[1] == friction[0]) friction[1] = coefficient;
      friction[0] = coefficient;
    }
    side_friction.set_coefficient(coefficient);
  }

  void set_payload(double mass) noexcept {
    const double change = base_mass + mass - model->body_mass[base_body];
    model->body_mass[base_body] += change;
    model->body_subtreemass[base_body] += change;
    model->body_subtreemass[0] += change;
  }

  const GeomOwner& owner_of(int geom) const { return owners[static_cast<std::size_t>(geom)]; }

  /// Lets the robot sink into its wheels' contacts, then puts it exactly where it starts, at rest, at t = 0:
  /// of the settled pose, height and tilt of the base are kept.
  void start(const std::array<double, 2>& at, double yaw) {
    place(at, yaw);
    if (!guarded(mj_forward, model.get(), data.get())) refuse("MuJoCo fails at the start pose");
    refuse_overlap();
    if (robot_model.base_type() == solver::BaseType::ground) settle(yaw);
    read_base();
    read_objects();
    truth.velocity.setZero();
    truth.acceleration.setZero();
  }

  void settle(double yaw) {
    const std::vector<mjtNum> standing(data->qpos, data->qpos + model->nq);
    const int steps = static_cast<int>(settling_time / model->opt.timestep);
    for (int i = 0; i < steps; ++i) {
      if (!step()) refuse("the simulation diverges while the robot settles on the floor");
      hold_joints();
    }
    std::fill(data->qfrc_applied, data->qfrc_applied + model->nv, 0.0);
    side_friction.reset();
    const double height = data->qpos[2];
    const Matrix3 tilted = base_rotation();
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(yaw - yaw_of(tilted), Vector3::UnitZ()) * tilted);
    const std::array<double, 4> orientation = {turned.w(), turned.x(), turned.y(), turned.z()};
    std::copy(standing.begin(), standing.end(), data->qpos);
    data->qpos[2] = height;
    std::copy(orientation.begin(), orientation.end(), data->qpos + 3);
    std::fill(data->qvel, data->qvel + model->nv, 0.0);
    data->time = 0.0;
    if (!guarded(mj_forward, model.get(), data.get())) refuse("MuJoCo fails at the start pose");
  }

  /// While the robot settles: joints other than the wheels keep their posture, and bear what hangs on them.
  void hold_joints() {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].turns_wheel) continue;
      data->qpos[joints[j].position] = posture[static_cast<Eigen::Index>(j)];
      data->qvel[joints[j].velocity] = 0.0;
      data->qfrc_applied[joints[j].velocity] = data->qfrc_bias[joints[j].velocity];
    }
  }

  void place(const std::array<double, 2>& at, double yaw) {
    const std::array<double, 4> turn = {std::cos(0.5 * yaw), 0.0, 0.0, std::sin(0.5 * yaw)};
    mjtNum* position = floats() ? data->qpos + model->jnt_qposadr[id_of(mjOBJ_JOINT, "base")]
                                : model->body_pos + 3 * base_body;
    mjtNum* orientation = floats() ? position + 3 : model->body_quat + 4 * base_body;
    std::copy(at.begin(), at.end(), position);
    std::copy(turn.begin(), turn.end(), orientation);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].sphere != nullptr) continue;
      data->qpos[joints[j].position] = posture[static_cast<Eigen::Index>(j)];
    }
    q = posture;
  }

  void refuse_overlap() const {
    for (int c = 0; c < data->ncon; ++c) {
      const mjContact& contact = data->contact[c];
      const int object = touched_object(contact);
      if (object >= 0 && contact.dist < -start_overlap) {
        refuse("the robot starts inside `" + truth.objects[static_cast<std::size_t>(object)].name + "`");
      }
    }
  }

  /// The object that the robot's outline touches in this contact, or -1.
  int touched_object(const mjContact& contact) const {
    const GeomOwner& one = owner_of(contact.geom1);
    const GeomOwner& other = owner_of(contact.geom2);
    if (one.robot) return other.object;
    if (other.robot) return one.object;
    return -1;
  }

  /// One step; false when the simulation is void.
  bool step() noexcept {
    const double before = data->time;
    if (!simulated.spheres.spheres.empty() || !side_friction.empty()) {
      // A free joint takes its force in world axes and its torque in the body's.
      const solver::ForceVector wrench = sphere_products(simulated.spheres, base_twist()) +
                                         side_friction.step(base_twist(), wheel_loads, model->opt.timestep);
      Eigen::Map<Vector3>(data->qfrc_applied) = base_rotation() * wrench.linear;
      Eigen::Map<Vector3>(data->qfrc_applied + 3) = wrench.angular;
    }
    for (SimulatedObject& object : objects) {
      follow_script(object, time(), data->qpos, data->qvel);
      add_floor_friction(object, model->opt.timestep, data->qvel, data->qfrc_applied);
    }
    if (!guarded(mj_step, model.get(), data.get())) return false;
    if (!side_friction.empty()) read_loads();
    const double elapsed = data->time - before;
    if (!(std::abs(elapsed - model->opt.timestep) < 1e-6 * model->opt.timestep)) return false;
    for (const mjWarningStat& warning : data->warning) {
      if (warning.number > 0) return false;
    }
    return is_finite(data->qpos, model->nq) && is_finite(data->qvel, model->nv) &&
           is_finite(data->qacc, model->nv);
  }

  void read_loads() noexcept {
    std::fill(wheel_loads.begin(), wheel_loads.end(), 0.0);
    for (int c = 0; c < data->ncon; ++c) {
      const int wheel =
          std::max(owner_of(data->contact[c].geom1).wheel, owner_of(data->contact[c].geom2).wheel);
      if (wheel < 0) continue;
      std::array<mjtNum, 6> wrench{};
      mj_contactForce(model.get(), data.get(), c, wrench.data());
      wheel_loads[static_cast<std::size_t>(wheel)] += wrench[0];
    }
  }

  /// In base axes and at the base's origin.
  solver::MotionVector base_twist() const {
    if (!floats()) return {};
    return {vector_of(data->qvel + 3), base_rotation().transpose() * vector_of(data->qvel)};
  }

  Vector3 base_velocity() const {
    const solver::MotionVector twist = base_twist();
    return {twist.linear.x(), twist.linear.y(), twist.angular.z()};
  }

  void read_base() noexcept {
    truth.time = time();
    truth.x = base_position().x();
    truth.y = base_position().y();
    truth.yaw = yaw_of(base_rotation());
  }

  /// Counted: MuJoCo's own clock adds up its steps and with them their rounding.
  double time() const { return static_cast<double>(steps_since_start) * model->opt.timestep; }

  Vector3 base_position() const { return vector_of(floats() ? data->qpos : model->body_pos + 3 * base_body); }

  Matrix3 base_rotation() const {
    return matrix_of(floats() ? data->qpos + 3 : model->body_quat + 4 * base_body);
  }

  void read_joints() noexcept {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const JointAddress& address = joints[j];
      const auto i = static_cast<Eigen::Index>(j);
      if (address.sphere == nullptr) {
        q[i] = data->qpos[address.position];
        qd[i] = data->qvel[address.velocity];
      } else {
        // The joint's velocity is in the sphere's own axes, and relative to the base.
        const Vector3 spin =
            matrix_of(data->qpos + address.position) * vector_of(data->qvel + address.velocity);
        qd[i] = address.sphere->torque_direction().dot(spin);
        q[i] += model->opt.timestep * qd[i];
      }
    }
  }

  /// The contacts of the step that was just made are those at its beginning, `before`.
  void read_contacts(double before) noexcept {
    for (ObjectTruth& object : truth.objects) object.force = 0.0;
    std::fill(truth.corner_forces.begin(), truth.corner_forces.end(), 0.0);
    for (int c = 0; c < data->ncon; ++c) {
      const int k = touched_object(data->contact[c]);
      if (k < 0) continue;
      std::array<mjtNum, 6> wrench{};
      mj_contactForce(model.get(), data.get(), c, wrench.data());
      ObjectTruth& object = truth.objects[static_cast<std::size_t>(k)];
      object.force += wrench[0];
      const int corner =
          std::max(owner_of(data->contact[c].geom1).corner, owner_of(data->contact[c].geom2).corner);
      if (corner >= 0) truth.corner_forces[static_cast<std::size_t>(corner)] += wrench[0];
      if (!object.touched) object.touched = before;
    }
    for (ObjectTruth& object : truth.objects) object.peak_force = std::max(object.peak_force, object.force);
  }

  PlantStatus apply(const Eigen::VectorXd& tau) noexcept {
    if (diverged) return PlantStatus::diverged;
    if (tau.size() != q.size() || !tau.allFinite()) return PlantStatus::unreachable;
    torque = tau;
    joint_friction.add_to(torque, qd, model->opt.timestep);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const double given = torque[static_cast<Eigen::Index>(j)];
      if (joints[j].motor >= 0) {
        data->ctrl[joints[j].motor] = given;
      } else if (joints[j].sphere == nullptr) {
        data->qfrc_applied[joints[j].velocity] = given;
      }
    }
    const double before = time();
    if (!step()) {
      diverged = true;
      return PlantStatus::diverged;
    }
    ++steps_since_start;
    const Vector3 now = base_velocity();
    truth.acceleration = (now - velocity) / model->opt.timestep;
    truth.velocity = velocity = now;
    read_base();
    read_joints();
    read_contacts(before);
    read_objects();
    latch_hooks();
    return PlantStatus::ok;
  }

  PlantStatus sense(Sensed& sensed) const noexcept {
    if (diverged) return PlantStatus::diverged;
    if (sensed.state.q.size() != q.size()) return PlantStatus::unreachable;
    sensed.time = time();
    sensed.state.q = q;
    sensed.state.qd = qd;
    sensed.state.base_pose.rotation = base_rotation();
    sensed.state.base_pose.position = base_position();
    sensed.state.base_twist = base_twist();
    return PlantStatus::ok;
  }

  Model robot_model;
  SimulatedRobot simulated;
  Eigen::VectorXd posture;  ///< q at the start
  SideFriction side_friction;
  JointFriction joint_friction;
  Eigen::VectorXd torque;           ///< of the joints, friction included
  std::vector<double> wheel_loads;  ///< [N] that the floor carries each wheel with, in the last step
  std::string text;
  ModelPointer model;
  DataPointer data;
  int base_body = 0;
  std::vector<JointAddress> joints;
  std::vector<GeomOwner> owners;  ///< by geom
  std::vector<SimulatedObject> objects;
  double base_mass = 0.0;  ///< [kg] without a payload
  Eigen::VectorXd q, qd;
  Vector3 velocity = Vector3::Zero();
  Truth truth;
  std::int64_t steps_since_start = 0;
  bool diverged = false;
};

MujocoPlant::MujocoPlant(const lang::Robot& robot, const lang::Scene& scene,
                         const MujocoPlantOptions& options)
    : simulation_(std::make_unique<Simulation>(robot, scene, options)) {}

MujocoPlant::~MujocoPlant() = default;

PlantStatus MujocoPlant::sense(Sensed& sensed) noexcept {
  return simulation_->sense(sensed);
}

PlantStatus MujocoPlant::apply(const Eigen::VectorXd& tau) noexcept {
  return simulation_->apply(tau);
}

const Truth& MujocoPlant::truth() const noexcept {
  return simulation_->truth;
}

void MujocoPlant::set_floor_friction(double coefficient) noexcept {
  simulation_->set_floor_friction(coefficient);
}

void MujocoPlant::set_payload(double mass) noexcept {
  simulation_->set_payload(mass);
}

void MujocoPlant::diverge() noexcept {
  simulation_->diverged = true;
}

const std::string& MujocoPlant::mjcf() const noexcept {
  return simulation_->text;
}

}  // namespace zwang::runtime
