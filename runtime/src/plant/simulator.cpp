#include "simulator.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <numbers>

#include "contact_spring.hpp"
#include "refuse.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::runtime {

namespace {

using Vector3 = Eigen::Vector3d;

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

constexpr double edge_tilt = 0.25 * std::numbers::pi;  ///< [rad]

/// Whether a sphere can press out of a face with the normal `out`. A corner presses between the normals of
/// its own sides. So two corners that meet square, edge on edge, do not slip off each other's sides, which
/// lie a right angle beyond. Up to half of that it is the far end of a side that sank in askew.
bool faces(const mjModel* m, const mjData* d, int sphere, const Vector3& out) {
  const double half_angle = m->nuser_geom > 0 ? m->geom_user[m->nuser_geom * sphere] : 0.0;
  if (!(half_angle > 0.0)) return true;
  const mjtNum* axes = d->geom_xmat + 9 * sphere;
  const Vector3 outward(axes[0], axes[3], axes[6]);
  return outward.dot(-out) >= std::cos(half_angle + edge_tilt);
}

/// MuJoCo's collision of a sphere with a box stops at a depth of the sphere's radius, and so would a spring's
/// force. Where the centre is inside the box, the depth is measured to the nearest face that it can press on
/// instead. Only in simulations of this file: others in the process keep what they have.
int collide_deep(const mjModel* m, const mjData* d, mjContact* contact, int sphere, int box, mjtNum margin) {
  const int count = collide_sphere_box(m, d, contact, sphere, box, margin);
  if (error_exit == nullptr || count != 1) return count;
  const Eigen::Map<const Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>> axes(d->geom_xmat + 9 * box);
  const Eigen::Map<const Vector3> half(m->geom_size + 3 * box), box_at(d->geom_xpos + 3 * box),
      centre(d->geom_xpos + 3 * sphere);
  const Vector3 local = axes.transpose() * (centre - box_at);
  const Vector3 depth = half - local.cwiseAbs();
  int axis = 0;
  if (!(depth.minCoeff(&axis) > 0.0)) return count;
  double deep = depth[axis];
  Vector3 out = (local[axis] > 0.0 ? 1.0 : -1.0) * axes.col(axis);
  bool presses = faces(m, d, sphere, out);
  // Past the middle of a thin box the face that it came through is not the nearest.
  for (const int other : {0, 1}) {
    for (const double side : {-1.0, 1.0}) {
      const Vector3 normal = side * axes.col(other);
      const double there = half[other] - side * local[other];
      if ((presses && !(there < deep)) || !faces(m, d, sphere, normal)) continue;
      presses = true;
      deep = there;
      out = normal;
    }
  }
  contact->dist = -(deep + m->geom_size[3 * sphere]);
  Eigen::Map<Vector3>(contact->frame) = -out;  // from the sphere to the box
  std::fill(contact->frame + 3, contact->frame + 9, 0.0);
  Eigen::Map<Vector3>(contact->pos) = centre - (m->geom_size[3 * sphere] + 0.5 * contact->dist) * out;
  return count;
}

mjfCollision collide_plane_sphere = nullptr;  ///< MuJoCo's own

/// Turns the contact of a wheel: its first tangent becomes the rolling direction, or is turned from it by the
/// angle of the wheel's geom. Friction may differ between the two. Only in simulations of this file, as
/// above.
int collide_along(const mjModel* m, const mjData* d, mjContact* contact, int plane, int sphere,
                  mjtNum margin) {
  const int count = collide_plane_sphere(m, d, contact, plane, sphere, margin);
  const int body = m->geom_bodyid[sphere];
  if (error_exit == nullptr || count != 1 || m->body_jntnum[body] != 1) return count;
  const int joint = m->body_jntadr[body];
  if (m->jnt_type[joint] != mjJNT_HINGE) return count;
  const Eigen::Map<const Vector3> axis(d->xaxis + 3 * joint), normal(contact->frame);
  Vector3 first = axis.cross(normal).normalized();
  const double turn = m->geom_user[m->nuser_geom * sphere];
  if (turn != 0.0) first = Eigen::AngleAxisd(turn, Vector3(normal)) * first;
  Eigen::Map<Vector3>(contact->frame + 3) = first;
  return count;
}

/// One file that only MuJoCo's reader sees. The table of names has two megabytes of zeros: `calloc` gives
/// them without a write, which `mj_defaultVFS` would be.
struct VirtualFile {
  VirtualFile() : vfs(static_cast<mjVFS*>(std::calloc(1, sizeof(mjVFS)))) {}
  ~VirtualFile() {
    if (vfs != nullptr && vfs->nfile > 0) mju_free(vfs->filedata[0]);
    std::free(vfs);
  }
  VirtualFile(const VirtualFile&) = delete;
  VirtualFile& operator=(const VirtualFile&) = delete;
  mjVFS* vfs;
};

/// The body's mass and inertia as MuJoCo has them must be the ones that were written.
void require_equal(const mjModel& m, int id, const solver::RigidInertia& inertia, const std::string& name) {
  const Eigen::Matrix3d axes = matrix_of(m.body_iquat + 4 * id);
  const Eigen::Matrix3d at_com = axes * vector_of(m.body_inertia + 3 * id).asDiagonal() * axes.transpose();
  const auto compiled =
      solver::RigidInertia::from_com(m.body_mass[id], vector_of(m.body_ipos + 3 * id), at_com);
  if ((compiled.matrix() - inertia.matrix()).norm() > 1e-9 * inertia.matrix().norm()) {
    refuse("MuJoCo changed the inertia of `" + name + "`");
  }
}

/// The outline's corners are the footprint's, in another order and without those in hollows.
int nearest_corner(const std::vector<Vector3>& footprint, const Vector3& corner) {
  const auto nearer = [&corner](const Vector3& a, const Vector3& b) {
    return (a - corner).head<2>().norm() < (b - corner).head<2>().norm();
  };
  return static_cast<int>(std::min_element(footprint.begin(), footprint.end(), nearer) - footprint.begin());
}

/// The rollers of the wheel that this body is, where it has any.
const RollerWheel* rollers_of(const solver::Model& robot, const SimulatedRobot& simulated, int body) {
  for (std::size_t w = 0; w < simulated.rollers.size(); ++w) {
    if (robot.wheels()[w].body == body && !simulated.rollers[w].rollers.empty()) return &simulated.rollers[w];
  }
  return nullptr;
}

const GeomOwner& owner_of(const std::vector<GeomOwner>& owners, int geom) {
  return owners[static_cast<std::size_t>(geom)];
}

}  // namespace

Eigen::Matrix3d matrix_of(const double* quaternion) {
  return Eigen::Quaterniond(quaternion[0], quaternion[1], quaternion[2], quaternion[3]).toRotationMatrix();
}

Vector3 vector_of(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

void ModelDeleter::operator()(mjModel_* model) const {
  mj_deleteModel(model);
}

void DataDeleter::operator()(mjData_* data) const {
  mj_deleteData(data);
}

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

ModelPointer compile(const std::string& mjcf) {
  // MuJoCo's compiler keeps the last model for the whole process.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const char* const file = "plant.xml";
  const VirtualFile virtual_file;
  mjVFS* const vfs = virtual_file.vfs;
  if (vfs == nullptr || mj_makeEmptyFileVFS(vfs, file, static_cast<int>(mjcf.size())) != 0) {
    refuse("the simulation's text does not fit MuJoCo's virtual files");
  }
  std::memcpy(vfs->filedata[0], mjcf.data(), mjcf.size());
  std::array<char, 1000> error{};
  ModelPointer model(mj_loadXML(file, vfs, error.data(), static_cast<int>(error.size())));
  if (!model || error[0] != '\0') refuse(std::string("MuJoCo refuses the simulation: ") + error.data());
  return model;
}

void require_as_written(const mjModel& model, const SimulatedRobot& simulated) {
  const solver::Model& robot = simulated.robot.model;
  double mass = 0.0;
  for (int i = 0; i < robot.body_count(); ++i) {
    const solver::Body& body = robot.bodies()[static_cast<std::size_t>(i)];
    const std::string name = simulated.named("body", static_cast<std::size_t>(i));
    const int id = mj_name2id(&model, mjOBJ_BODY, name.c_str());
    mass += model.body_mass[id];
    const auto& spheres = simulated.spheres.spheres;
    const bool is_sphere = std::any_of(spheres.begin(), spheres.end(),
                                       [i](const RollingSphere& sphere) { return sphere.body == i; });
    const RollerWheel* rollers = rollers_of(robot, simulated, i);
    if (rollers != nullptr) {
      for (const Roller& roller : rollers->rollers) mass += roller.inertia.mass;
      require_equal(model, id, rollers->hub, body.name);
      continue;
    }
    if (is_sphere || (i == 0 && robot.has_fixed_base())) continue;  // a sphere's mass counts in the sum below
    require_equal(model, id, i == 0 ? simulated.spheres.base : body.inertia, body.name);
  }
  if (std::abs(mass - robot.total_mass()) > 1e-9 * mass) refuse("MuJoCo changed the robot's mass");
}

std::vector<GeomOwner> find_owners(const mjModel& model, const std::vector<SimulatedRobot>& robots) {
  std::vector<GeomOwner> owners(static_cast<std::size_t>(model.ngeom));
  for (int g = 0; g < model.ngeom; ++g) {
    const char* name = mj_id2name(&model, mjOBJ_GEOM, g);
    GeomOwner& owner = owners[static_cast<std::size_t>(g)];
    if (std::strcmp(name, "floor") == 0) continue;
    if (std::strncmp(name, "object_", 7) == 0) {
      owner.object = std::atoi(name + 7);
      continue;
    }
    const bool is_partner = std::strncmp(name, "partner_", 8) == 0;
    owner.robot = is_partner ? std::atoi(name + 8) : 0;
    const SimulatedRobot& robot = robots[static_cast<std::size_t>(owner.robot)];
    name += robot.prefix.size();
    owner.body = std::strcmp(name, "hull") == 0;
    if (std::strncmp(name, "wheel_", 6) == 0) owner.wheel = std::atoi(name + 6);
    const bool of_outline = std::strncmp(name, "bumper_", 7) == 0;
    owner.touches = of_outline || std::strncmp(name, "tip_", 4) == 0;
    if (owner.touches) {
      const char* body = mj_id2name(&model, mjOBJ_BODY, model.geom_bodyid[g]) + robot.prefix.size();
      owner.part = std::atoi(body + std::strlen("body_"));
    }
    if (of_outline && std::isdigit(static_cast<unsigned char>(name[7])) != 0) {
      const auto corner = static_cast<std::size_t>(std::atoi(name + 7));
      owner.corner = nearest_corner(robot.robot.footprint, robot.outline[corner]);
    }
  }
  return owners;
}

/// MuJoCo's contact force f and relative acceleration a obey a + r f = -k x - b v with penetration x < 0.
/// There r = A (1 - d)/d, with A its estimate of the inverse mass at the contact and d the impedance. So the
/// stepped spring f = K x + B v + M a takes 1/r = M, that is d = A M/(1 + A M), k = K r and b = B r. If M is
/// less than a thousandth of 1/A, the least impedance raises it to that mass. solref holds (-k d, -b d), as
/// MuJoCo divides it by d and d^2, and multiplies k by d.
std::vector<ContactSpring> set_springs(mjModel& model, const std::vector<GeomOwner>& owners,
                                       const lang::Scene& scene, const std::vector<SimulatedRobot>& robots) {
  const auto touchable = [&](const GeomOwner& owner) {
    if (owner.object >= 0) return touchable_object(scene.objects[static_cast<std::size_t>(owner.object)]);
    const auto r = static_cast<std::size_t>(owner.robot);
    return touchable_robot(owner.robot > 0 ? &scene.robots[r - 1] : nullptr,
                           robots[r].robot.model.total_mass());
  };
  std::vector<ContactSpring> springs(static_cast<std::size_t>(model.npair));
  for (int p = 0; p < model.npair; ++p) {
    const int one = model.pair_geom1[p];
    const int other = model.pair_geom2[p];
    const GeomOwner &first = owner_of(owners, one), &second = owner_of(owners, other);
    if (first.is_floor() || second.is_floor()) continue;
    const ContactSpring spring = contact_spring(touchable(first), touchable(second));
    springs[static_cast<std::size_t>(p)] = spring;
    const double inverse_mass = model.body_invweight0[2 * model.geom_bodyid[one]] +
                                model.body_invweight0[2 * model.geom_bodyid[other]];
    const SteppedSpring step = stepped(spring, inverse_mass, model.opt.timestep);
    const double share = inverse_mass * step.mass;
    const double impedance = std::max(spring_impedance, share / (1.0 + share));
    model.pair_solimp[mjNIMP * p] = model.pair_solimp[mjNIMP * p + 1] = impedance;
    model.pair_solref[2 * p] = -step.stiffness * (1.0 - impedance) * inverse_mass;
    model.pair_solref[2 * p + 1] = -step.damping * (1.0 - impedance) * inverse_mass;
  }
  return springs;
}

const char* mujoco_version() noexcept {
  return mj_versionString();
}

}  // namespace zwang::runtime
