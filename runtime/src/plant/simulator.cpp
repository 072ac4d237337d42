#include "simulator.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <stdexcept>

namespace zwang::runtime {

namespace {

using Vector3 = Eigen::Vector3d;

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

struct VirtualFiles {
  VirtualFiles() { mj_defaultVFS(&vfs); }
  ~VirtualFiles() { mj_deleteVFS(&vfs); }
  VirtualFiles(const VirtualFiles&) = delete;
  VirtualFiles& operator=(const VirtualFiles&) = delete;
  mjVFS vfs;
};

}  // namespace

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

}  // namespace zwang::runtime
