#include "zwang/runtime/mujoco_plant.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "floor_friction.hpp"
#include "mjcf.hpp"
#include "simulator.hpp"

namespace zwang::runtime {

namespace {

using solver::Matrix3;
using solver::Model;
using solver::Pose;
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

/// The body's mass and inertia as MuJoCo has them must be the ones that were written.
void require_equal(const mjModel& m, int id, const solver::RigidInertia& inertia, const std::string& name) {
  const Matrix3 axes = matrix_of(m.body_iquat + 4 * id);
  const Matrix3 at_com = axes * vector_of(m.body_inertia + 3 * id).asDiagonal() * axes.transpose();
  const auto compiled =
      solver::RigidInertia::from_com(m.body_mass[id], vector_of(m.body_ipos + 3 * id), at_com);
  if ((compiled.matrix() - inertia.matrix()).norm() > 1e-9 * inertia.matrix().norm()) {
    refuse("MuJoCo changed the inertia of `" + name + "`");
  }
}

}  // namespace

struct MujocoPlant::Simulation {
  /// How one joint of the model is read.
  struct JointAddress {
    int position = 0;                       ///< in qpos
    int velocity = 0;                       ///< in qvel
    int motor = -1;                         ///< in ctrl; -1 without a motor
    const RollingSphere* sphere = nullptr;  ///< set: a ball joint; q is integrated
  };
  /// An object that slides on the floor: three freedoms from `velocity` in qvel.
  struct Slider {
    int velocity = 0;
    FloorFriction friction;
  };
  /// Which object and whether the robot's outline a geom belongs to.
  struct GeomOwner {
    int object = -1;
    bool robot = false;
  };

  Simulation(const lang::Robot& robot, const lang::Scene& scene, const MujocoPlantOptions& options)
      : robot_model(robot.model), simulated(prepare_robot(robot)) {
    install_handlers();
    if (!(options.period > 0.0) || options.period > 0.01) refuse("the period is not within 0 and 10 ms");
    text = write_mjcf(robot, simulated, scene, options.period);
    model = compile(text);
    data.reset(mj_makeData(model.get()));
    if (!data) refuse("MuJoCo has no memory for the simulation");
    find_addresses();
    compare_inertia();
    find_owners(scene);
    set_springs(scene);
    find_sliders(scene);
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
      freedoms += address.sphere != nullptr ? 3 : 1;
      joints.push_back(address);
    }
    for (int j = 0; j < model->njnt; ++j) {
      const char* name = mj_id2name(model.get(), mjOBJ_JOINT, j);
      if (std::strncmp(name, "object_", 7) == 0) freedoms += 1;
    }
    if (model->nv != freedoms) refuse("MuJoCo changed the number of freedoms");
    q.setZero(robot_model.joint_count());
    qd.setZero(robot_model.joint_count());
  }

  void compare_inertia() const {
    double mass = 0.0;
    for (int i = 0; i < robot_model.body_count(); ++i) {
      const solver::Body& body = robot_model.bodies()[static_cast<std::size_t>(i)];
      const int id = id_of(mjOBJ_BODY, numbered("body", i));
      mass += model->body_mass[id];
      const bool is_sphere = i > 0 && joints[static_cast<std::size_t>(i) - 1].sphere != nullptr;
      if (is_sphere || (i == 0 && !floats())) continue;  // a sphere's mass counts in the sum below
      require_equal(*model, id, i == 0 ? simulated.spheres.base : body.inertia, body.name);
    }
    if (std::abs(mass - robot_model.total_mass()) > 1e-9 * mass) refuse("MuJoCo changed the robot's mass");
  }

  void find_owners(const lang::Scene& scene) {
    owners.resize(static_cast<std::size_t>(model->ngeom));
    for (int g = 0; g < model->ngeom; ++g) {
      const char* name = mj_id2name(model.get(), mjOBJ_GEOM, g);
      GeomOwner& owner = owners[static_cast<std::size_t>(g)];
      if (std::strncmp(name, "object_", 7) == 0) owner.object = std::atoi(name + 7);
      owner.robot = std::strncmp(name, "bumper_", 7) == 0;
    }
    for (const lang::SceneObject& object : scene.objects)
      truth.objects.push_back({object.name, 0.0, {}, 0.0});
  }

  /// Contacts as springs of stiffness K and damping c = 2 zeta sqrt(K m), m the reduced mass of the two;
  /// between two objects those of the softer one. MuJoCo's contact force f and relative acceleration a obey a
  /// + r f = -k x - b v with penetration x < 0 and r = A (1 - d)/d; A is its estimate of the inverse mass at
  /// the contact and d the impedance, so that f = K x + c v for k = K A (1 - d)/d, b = c A (1 - d)/d, apart
  /// from a/r, a mass of d/((1 - d) A) beside the robot's. solref holds (-k d, -b d): MuJoCo divides it by d
  /// and d^2, and multiplies k by d.
  void set_springs(const lang::Scene& scene) {
    for (int p = 0; p < model->npair; ++p) {
      const int one = model->pair_geom1[p];
      const int other = model->pair_geom2[p];
      if (owner_of(one).object < 0 && owner_of(other).object < 0) continue;  // wheels and skids on the floor
      const lang::SceneObject& object = softer_object(scene, owner_of(one).object, owner_of(other).object);
      require_spring(object);
      const double mass =
          1.0 / (inverse_mass_of(scene, owner_of(one)) + inverse_mass_of(scene, owner_of(other)));
      const double inverse_mass = model->body_invweight0[2 * model->geom_bodyid[one]] +
                                  model->body_invweight0[2 * model->geom_bodyid[other]];
      const double scale = (1.0 - spring_impedance) * inverse_mass;
      model->pair_solref[2 * p] = -object.stiffness * scale;
      model->pair_solref[2 * p + 1] = -2.0 * object.damping * std::sqrt(object.stiffness * mass) * scale;
    }
  }

  static const lang::SceneObject& softer_object(const lang::Scene& scene, int one, int other) {
    if (one < 0 || other < 0) return scene.objects[static_cast<std::size_t>(std::max(one, other))];
    const auto& a = scene.objects[static_cast<std::size_t>(one)];
    const auto& b = scene.objects[static_cast<std::size_t>(other)];
    return a.stiffness < b.stiffness ? a : b;
  }

  double inverse_mass_of(const lang::Scene& scene, const GeomOwner& owner) const {
    if (owner.object < 0) return 1.0 / robot_model.total_mass();
    const auto& mass = scene.objects[static_cast<std::size_t>(owner.object)].mass;
    return mass ? 1.0 / *mass : 0.0;
  }

  void find_sliders(const lang::Scene& scene) {
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
      const lang::SceneObject& object = scene.objects[k];
      if (!object.mass) continue;
      const std::string name = numbered("object", static_cast<int>(k));
      const int body = id_of(mjOBJ_BODY, name);
      const double yaw_inertia = model->body_inertia[3 * body + upright_axis(body)];
      const double area = object.shape == lang::ShapeKind::cylinder
                              ? std::numbers::pi * object.size[0] * object.size[0]
                              : object.size[0] * object.size[1];
      const double reach = 2.0 / 3.0 * std::sqrt(area / std::numbers::pi);  // of a disk as large
      const double load = scene.floor_friction * *object.mass * robot_model.gravity().norm();
      sliders.push_back({model->jnt_dofadr[id_of(mjOBJ_JOINT, name + "_x")],
                         FloorFriction(*object.mass, yaw_inertia, load, reach)});
    }
  }

  /// The principal axis of an object that is its vertical one.
  int upright_axis(int body) const {
    int axis = 0;
    matrix_of(model->body_iquat + 4 * body).row(2).cwiseAbs().maxCoeff(&axis);
    return axis;
  }

  static void require_spring(const lang::SceneObject& object) {
    if (!(object.stiffness > 0.0) || !(object.damping >= 0.0) || !(object.friction >= 0.0)) {
      refuse("stiffness, damping or friction of `" + object.name + "` is out of range");
    }
    // The contact's damping is also what resists sliding until the friction limit is reached.
    if (object.friction > 0.0 && object.damping < 0.01) {
      refuse("friction of `" + object.name + "` needs a damping ratio of at least 0.01");
    }
  }

  const GeomOwner& owner_of(int geom) const { return owners[static_cast<std::size_t>(geom)]; }

  /// Lets the robot sink into its wheels' contacts, then puts it exactly where it starts, at rest, at t = 0.
  void start(const std::array<double, 2>& at, double yaw) {
    place(at, yaw);
    if (!guarded(mj_forward, model.get(), data.get())) refuse("MuJoCo fails at the start pose");
    refuse_overlap();
    const std::vector<mjtNum> standing(data->qpos, data->qpos + model->nq);
    const int steps = static_cast<int>(settling_time / model->opt.timestep);
    for (int i = 0; i < steps; ++i) {
      if (!step()) refuse("the simulation diverges while the robot settles on the floor");
    }
    // Kept from settling: heights and tilts of what moves freely.
    std::vector<mjtNum> settled(data->qpos, data->qpos + model->nq);
    for (int j = 0; j < model->njnt; ++j) {
      const int a = model->jnt_qposadr[j];
      const auto address = static_cast<std::size_t>(a);
      if (model->jnt_type[j] == mjJNT_FREE) {
        const Matrix3 now = matrix_of(data->qpos + a + 3);
        const double turned = yaw_of(matrix_of(&standing[address + 3])) - yaw_of(now);
        const Eigen::Quaterniond upright(Eigen::AngleAxisd(turned, Vector3::UnitZ()) * now);
        settled[address] = standing[address];
        settled[address + 1] = standing[address + 1];
        const std::array<double, 4> quaternion = {upright.w(), upright.x(), upright.y(), upright.z()};
        std::copy(quaternion.begin(), quaternion.end(), &settled[address + 3]);
      } else {
        const int count = model->jnt_type[j] == mjJNT_BALL ? 4 : 1;
        std::copy_n(&standing[address], count, &settled[address]);
      }
    }
    std::copy(settled.begin(), settled.end(), data->qpos);
    std::fill(data->qvel, data->qvel + model->nv, 0.0);
    data->time = 0.0;
    if (!guarded(mj_forward, model.get(), data.get())) refuse("MuJoCo fails at the start pose");
    velocity.setZero();
    read_base();
    truth.velocity.setZero();
    truth.acceleration.setZero();
  }

  void place(const std::array<double, 2>& at, double yaw) {
    const std::array<double, 4> turn = {std::cos(0.5 * yaw), 0.0, 0.0, std::sin(0.5 * yaw)};
    mjtNum* position = floats() ? data->qpos + model->jnt_qposadr[id_of(mjOBJ_JOINT, "base")]
                                : model->body_pos + 3 * base_body;
    mjtNum* orientation = floats() ? position + 3 : model->body_quat + 4 * base_body;
    std::copy(at.begin(), at.end(), position);
    std::copy(turn.begin(), turn.end(), orientation);
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
    cancel_sphere_products();
    for (Slider& slider : sliders) {
      const Vector3 moving = vector_of(data->qvel + slider.velocity);
      Eigen::Map<Vector3>(data->qfrc_applied + slider.velocity) =
          slider.friction.step(moving, model->opt.timestep);
    }
    if (!guarded(mj_step, model.get(), data.get())) return false;
    const double elapsed = data->time - before;
    if (!(std::abs(elapsed - model->opt.timestep) < 1e-6 * model->opt.timestep)) return false;
    for (const mjWarningStat& warning : data->warning) {
      if (warning.number > 0) return false;
    }
    return is_finite(data->qpos, model->nq) && is_finite(data->qvel, model->nv) &&
           is_finite(data->qacc, model->nv);
  }

  /// See rolling_spheres.hpp: the wheel has no counterpart for I/R^2 wz z x v of its sphere.
  void cancel_sphere_products() noexcept {
    if (!floats() || simulated.spheres.spheres.empty()) return;
    const Matrix3 to_world = matrix_of(data->qpos + 3);
    const Vector3 linear = to_world.transpose() * vector_of(data->qvel);
    const Vector3 spin(0.0, 0.0, data->qvel[5]);
    Vector3 force = Vector3::Zero();
    Vector3 moment = Vector3::Zero();
    for (const RollingSphere& sphere : simulated.spheres.spheres) {
      const double weight = sphere.inertia / (sphere.radius * sphere.radius);
      const Vector3 part = weight * spin.cross(linear + spin.cross(sphere.centre));
      force += part;
      moment += sphere.centre.cross(part);
    }
    Eigen::Map<Vector3>(data->qfrc_applied) = to_world * force;
    Eigen::Map<Vector3>(data->qfrc_applied + 3) = moment;
  }

  Vector3 base_velocity() const {
    if (!floats()) return Vector3::Zero();
    const Vector3 linear = matrix_of(data->qpos + 3).transpose() * vector_of(data->qvel);
    return {linear.x(), linear.y(), data->qvel[5]};
  }

  void read_base() noexcept {
    truth.time = data->time;
    const mjtNum* position = floats() ? data->qpos : model->body_pos + 3 * base_body;
    truth.x = position[0];
    truth.y = position[1];
    truth.yaw = yaw_of(base_rotation());
  }

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
    for (int c = 0; c < data->ncon; ++c) {
      const int k = touched_object(data->contact[c]);
      if (k < 0) continue;
      std::array<mjtNum, 6> wrench{};
      mj_contactForce(model.get(), data.get(), c, wrench.data());
      ObjectTruth& object = truth.objects[static_cast<std::size_t>(k)];
      object.force += wrench[0];
      if (!object.touched) object.touched = before;
    }
    for (ObjectTruth& object : truth.objects) object.peak_force = std::max(object.peak_force, object.force);
  }

  PlantStatus apply(const Eigen::VectorXd& tau) noexcept {
    if (diverged) return PlantStatus::diverged;
    if (tau.size() != q.size() || !tau.allFinite()) return PlantStatus::unreachable;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].motor >= 0) data->ctrl[joints[j].motor] = tau[static_cast<Eigen::Index>(j)];
    }
    const double before = data->time;
    if (!step()) {
      diverged = true;
      return PlantStatus::diverged;
    }
    const Vector3 now = base_velocity();
    truth.acceleration = (now - velocity) / model->opt.timestep;
    truth.velocity = velocity = now;
    read_base();
    read_joints();
    read_contacts(before);
    return PlantStatus::ok;
  }

  PlantStatus sense(Sensed& sensed) const noexcept {
    if (diverged) return PlantStatus::diverged;
    if (sensed.state.q.size() != q.size()) return PlantStatus::unreachable;
    sensed.time = data->time;
    sensed.state.q = q;
    sensed.state.qd = qd;
    sensed.state.base_pose.rotation = base_rotation();
    if (floats()) {
      sensed.state.base_pose.position = vector_of(data->qpos);
      sensed.state.base_twist.angular = vector_of(data->qvel + 3);
      sensed.state.base_twist.linear = sensed.state.base_pose.rotation.transpose() * vector_of(data->qvel);
    } else {
      sensed.state.base_pose.position = vector_of(model->body_pos + 3 * base_body);
      sensed.state.base_twist = {};
    }
    return PlantStatus::ok;
  }

  Model robot_model;
  SimulatedRobot simulated;
  std::string text;
  ModelPointer model;
  DataPointer data;
  int base_body = 0;
  std::vector<JointAddress> joints;
  std::vector<GeomOwner> owners;  ///< by geom
  std::vector<Slider> sliders;
  Eigen::VectorXd q, qd;
  Vector3 velocity = Vector3::Zero();
  Truth truth;
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

const std::string& MujocoPlant::mjcf() const noexcept {
  return simulation_->text;
}

}  // namespace zwang::runtime
