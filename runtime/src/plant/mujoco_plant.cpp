#include "zwang/runtime/mujoco_plant.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "contact_spring.hpp"
#include "floor_friction.hpp"
#include "mjcf.hpp"
#include "side_friction.hpp"

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

// MuJoCo reports errors through handlers of the whole process. Its own wait for a key and write a file.
// No frame between the handler and the place that it jumps to holds anything that would need destroying.
thread_local std::jmp_buf* error_exit = nullptr;

void on_error(const char* message) {
  if (error_exit != nullptr) std::longjmp(*error_exit, 1);
  std::fprintf(stderr, "zwang: MuJoCo: %s\n", message);
  std::abort();
}

void on_warning(const char* /*message*/) {}  // counted in mjData, where every step looks

mjfCollision collide_sphere_box = nullptr;  ///< MuJoCo's own

/// MuJoCo's collision of a sphere with a box stops at a depth of the sphere's radius, and so would a spring's
/// force. Where the centre is inside the box, the depth is measured to the nearest face instead. Only in
/// simulations of this file: others in the process keep what they have.
int collide_deep(const mjModel* m, const mjData* d, mjContact* contact, int sphere, int box, mjtNum margin) {
  const int count = collide_sphere_box(m, d, contact, sphere, box, margin);
  if (error_exit == nullptr || count != 1) return count;
  const Eigen::Map<const Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>> axes(d->geom_xmat + 9 * box);
  const Eigen::Map<const Vector3> half(m->geom_size + 3 * box), box_at(d->geom_xpos + 3 * box),
      centre(d->geom_xpos + 3 * sphere);
  const Vector3 local = axes.transpose() * (centre - box_at);
  const Vector3 depth = half - local.cwiseAbs();
  int face = 0;
  if (!(depth.minCoeff(&face) > 0.0)) return count;
  const Vector3 out = (local[face] > 0.0 ? 1.0 : -1.0) * axes.col(face);
  contact->dist = -(depth[face] + m->geom_size[3 * sphere]);
  Eigen::Map<Vector3>(contact->frame) = -out;  // from the sphere to the box
  std::fill(contact->frame + 3, contact->frame + 9, 0.0);
  Eigen::Map<Vector3>(contact->pos) = centre - (m->geom_size[3 * sphere] + 0.5 * contact->dist) * out;
  return count;
}

mjfCollision collide_plane_sphere = nullptr;  ///< MuJoCo's own

/// Turns the contact of a wheel so that its first tangent is the rolling direction: friction may differ
/// between the two. Only in simulations of this file, as above.
int collide_along(const mjModel* m, const mjData* d, mjContact* contact, int plane, int sphere,
                  mjtNum margin) {
  const int count = collide_plane_sphere(m, d, contact, plane, sphere, margin);
  const int body = m->geom_bodyid[sphere];
  if (error_exit == nullptr || count != 1 || m->body_jntnum[body] != 1) return count;
  const int joint = m->body_jntadr[body];
  if (m->jnt_type[joint] != mjJNT_HINGE) return count;
  const Eigen::Map<const Vector3> axis(d->xaxis + 3 * joint), normal(contact->frame);
  Eigen::Map<Vector3>(contact->frame + 3) = axis.cross(normal).normalized();
  return count;
}

/// Once, before all else.
void install_handlers() {
  static const bool installed = [] {
    mju_user_error = on_error;
    mju_user_warning = on_warning;
    collide_sphere_box = mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_BOX];
    mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_BOX] = collide_deep;
    collide_plane_sphere = mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_SPHERE];
    mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_SPHERE] = collide_along;
    return true;
  }();
  static_cast<void>(installed);
}

/// False when MuJoCo raised an error: the data is void.
bool guarded(void (*call)(const mjModel*, mjData*), const mjModel* model, mjData* data) noexcept {
  std::jmp_buf exit;
  error_exit = &exit;
  if (setjmp(exit) != 0) {
    error_exit = nullptr;
    return false;
  }
  call(model, data);
  error_exit = nullptr;
  return true;
}

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

using ModelPointer = std::unique_ptr<mjModel, ModelDeleter>;
using DataPointer = std::unique_ptr<mjData, DataDeleter>;

struct VirtualFiles {
  VirtualFiles() { mj_defaultVFS(&vfs); }
  ~VirtualFiles() { mj_deleteVFS(&vfs); }
  VirtualFiles(const VirtualFiles&) = delete;
  VirtualFiles& operator=(const VirtualFiles&) = delete;
  mjVFS vfs;
};

ModelPointer compile(const std::string& mjcf) {
  const char* const file = "plant.xml";
  const auto files = std::make_unique<VirtualFiles>();  // two megabytes: not for the stack
  if (mj_makeEmptyFileVFS(&files->vfs, file, static_cast<int>(mjcf.size())) != 0) {
    refuse("the simulation's text does not fit MuJoCo's virtual files");
  }
  std::memcpy(files->vfs.filedata[mj_findFileVFS(&files->vfs, file)], mjcf.data(), mjcf.size());
  std::array<char, 1000> error{};
  ModelPointer model(mj_loadXML(file, &files->vfs, error.data(), static_cast<int>(error.size())));
  if (!model || error[0] != '\0') refuse(std::string("MuJoCo refuses the simulation: ") + error.data());
  return model;
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

/// The outline's corners are the footprint's, in another order and without those in hollows.
int nearest_corner(const std::vector<Vector3>& footprint, const Vector3& corner) {
  const auto nearer = [&corner](const Vector3& a, const Vector3& b) {
    return (a - corner).head<2>().norm() < (b - corner).head<2>().norm();
  };
  return static_cast<int>(std::min_element(footprint.begin(), footprint.end(), nearer) - footprint.begin());
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
    bool turns_wheel = false;
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
    int corner = -1;  ///< of the robot's footprint
    int wheel = -1;
  };

  Simulation(const lang::Robot& robot, const lang::Scene& scene, const MujocoPlantOptions& options)
      : robot_model(robot.model),
        simulated(prepare_robot(robot)),
        posture(lang::start_state(robot).q),
        side_friction(robot.model, scene.floor_friction),
        wheel_loads(robot.model.wheels().size(), 0.0) {
    install_handlers();
    if (!(options.period > 0.0) || options.period > 0.01) refuse("the period is not within 0 and 10 ms");
    text = write_mjcf(robot, simulated, scene, options.period);
    model = compile(text);
    data.reset(mj_makeData(model.get()));
    if (!data) refuse("MuJoCo has no memory for the simulation");
    find_addresses();
    compare_inertia();
    find_owners(scene, robot.footprint);
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
      for (const solver::Wheel& wheel : robot_model.wheels()) {
        if (wheel.body == j + 1) address.turns_wheel = true;
      }
      freedoms += address.sphere != nullptr ? 3 : 1;
      joints.push_back(address);
    }
    for (int j = 0; j < model->njnt; ++j) {
      const char* name = mj_id2name(model.get(), mjOBJ_JOINT, j);
      if (std::strncmp(name, "object_", 7) == 0) freedoms += 1;
    }
    if (model->nv != freedoms) refuse("MuJoCo changed the number of freedoms");
    q = posture;
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

  void find_owners(const lang::Scene& scene, const std::vector<Vector3>& footprint) {
    owners.resize(static_cast<std::size_t>(model->ngeom));
    for (int g = 0; g < model->ngeom; ++g) {
      const char* name = mj_id2name(model.get(), mjOBJ_GEOM, g);
      GeomOwner& owner = owners[static_cast<std::size_t>(g)];
      if (std::strncmp(name, "object_", 7) == 0) owner.object = std::atoi(name + 7);
      if (std::strncmp(name, "wheel_", 6) == 0) owner.wheel = std::atoi(name + 6);
      owner.robot = std::strncmp(name, "bumper_", 7) == 0;
      if (owner.robot && std::isdigit(static_cast<unsigned char>(name[7])) != 0) {
        owner.corner =
            nearest_corner(footprint, simulated.outline[static_cast<std::size_t>(std::atoi(name + 7))]);
      }
    }
    truth.corner_forces.assign(footprint.size(), 0.0);
    for (const lang::SceneObject& object : scene.objects)
      truth.objects.push_back({object.name, 0.0, {}, 0.0});
  }

  /// MuJoCo's contact force f and relative acceleration a obey a + r f = -k x - b v with penetration x < 0
  /// and r = A (1 - d)/d; A is its estimate of the inverse mass at the contact and d the impedance. So f = K
  /// x + c v for k = K A (1 - d)/d, b = c A (1 - d)/d, apart from a/r, a mass of d/((1 - d) A) beside the
  /// robot's. solref holds (-k d, -b d): MuJoCo divides it by d and d^2, and multiplies k by d.
  void set_springs(const lang::Scene& scene) {
    for (int p = 0; p < model->npair; ++p) {
      const int one = model->pair_geom1[p];
      const int other = model->pair_geom2[p];
      if (owner_of(one).object < 0 && owner_of(other).object < 0) continue;  // wheels and skids on the floor
      const ContactSpring spring =
          contact_spring(scene, robot_model.total_mass(), owner_of(one).object, owner_of(other).object);
      const double inverse_mass = model->body_invweight0[2 * model->geom_bodyid[one]] +
                                  model->body_invweight0[2 * model->geom_bodyid[other]];
      model->pair_solref[2 * p] = -spring.stiffness * (1.0 - spring_impedance) * inverse_mass;
      model->pair_solref[2 * p + 1] = -spring.damping * (1.0 - spring_impedance) * inverse_mass;
    }
  }

  void find_sliders(const lang::Scene& scene) {
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
      if (!scene.objects[k].mass) continue;
      const int joint = id_of(mjOBJ_JOINT, numbered("object", static_cast<int>(k)) + "_x");
      const double gravity = robot_model.gravity().norm();
      sliders.push_back(
          {model->jnt_dofadr[joint], floor_friction_of(scene.objects[k], scene.floor_friction, gravity)});
    }
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
    for (Slider& slider : sliders) {
      const Vector3 moving = vector_of(data->qvel + slider.velocity);
      Eigen::Map<Vector3>(data->qfrc_applied + slider.velocity) =
          slider.friction.step(moving, model->opt.timestep);
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
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].motor >= 0) data->ctrl[joints[j].motor] = tau[static_cast<Eigen::Index>(j)];
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
  std::vector<double> wheel_loads;  ///< [N] that the floor carries each wheel with, in the last step
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

const std::string& MujocoPlant::mjcf() const noexcept {
  return simulation_->text;
}

}  // namespace zwang::runtime
