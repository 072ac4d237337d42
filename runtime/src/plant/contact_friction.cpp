#include "contact_friction.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "cut.hpp"

namespace zwang::runtime {

namespace {

using Eigen::Vector3d;

constexpr double contact_frequency = 100.0;    ///< w [1/s]
constexpr double contact_damping_ratio = 0.7;  ///< while the bristles hold

/// Of the body's point at `point`, in world axes.
Vector3d velocity_at(const mjModel& m, const mjData& d, int body, const Vector3d& point) {
  const mjtNum* const twist = d.cvel + 6 * body;
  const Vector3d reference = vector_of(d.subtree_com + 3 * m.body_rootid[body]);
  return vector_of(twist + 3) + vector_of(twist).cross(point - reference);
}

void add_force(const Vector3d& force, const Vector3d& point, int body, mjData& d) {
  const Vector3d arm = point - vector_of(d.xipos + 3 * body);
  Eigen::Map<Vector3d>(d.xfrc_applied + 6 * body) += force;
  Eigen::Map<Vector3d>(d.xfrc_applied + 6 * body + 3) += arm.cross(force);
}

}  // namespace

ContactFriction::ContactFriction(const mjModel& model, const std::vector<GeomOwner>& owners) {
  const auto is_floor = [&](int geom) { return owners[static_cast<std::size_t>(geom)].is_floor(); };
  for (int p = 0; p < model.npair; ++p) {
    if (is_floor(model.pair_geom1[p]) || is_floor(model.pair_geom2[p])) continue;
    Bristle bristle;
    bristle.geoms[0] = model.pair_geom1[p];
    bristle.geoms[1] = model.pair_geom2[p];
    bristle.coefficient = model.pair_friction[5 * p];
    double inverse_mass = 0.0;
    for (int side = 0; side < 2; ++side) {
      bristle.bodies[side] = model.geom_bodyid[bristle.geoms[side]];
      inverse_mass += model.body_invweight0[2 * bristle.bodies[side]];
    }
    if (!(bristle.coefficient > 0.0) || !(inverse_mass > 0.0)) continue;
    bristle.stiffness = contact_frequency * contact_frequency / inverse_mass;
    bristle.damping = 2.0 * contact_damping_ratio * contact_frequency / inverse_mass;
    bristles_.push_back(bristle);
  }
}

void ContactFriction::find_loads(const mjModel& model, const mjData& data) noexcept {
  for (Bristle& bristle : bristles_) {
    bristle.load = 0.0;
    bristle.loaded_point.setZero();
    bristle.loaded_normal.setZero();
  }
  for (int c = 0; c < data.ncon; ++c) {
    const mjContact& contact = data.contact[c];
    const auto bristle = std::find_if(bristles_.begin(), bristles_.end(), [&](const Bristle& b) {
      return std::minmax(b.geoms[0], b.geoms[1]) == std::minmax(contact.geom1, contact.geom2);
    });
    if (bristle == bristles_.end()) continue;
    std::array<mjtNum, 6> wrench{};
    mj_contactForce(&model, &data, c, wrench.data());
    bristle->load += wrench[0];
    bristle->loaded_point += wrench[0] * vector_of(contact.pos);
    bristle->loaded_normal += wrench[0] * vector_of(contact.frame);
  }
}

void ContactFriction::push(const mjModel& model, mjData& data) noexcept {
  std::fill(data.xfrc_applied, data.xfrc_applied + 6 * model.nbody, 0.0);
  if (bristles_.empty()) return;
  find_loads(model, data);
  for (Bristle& bristle : bristles_) {
    if (!(bristle.load > 0.0)) {
      bristle.stretch.setZero();
      continue;
    }
    const Vector3d point = bristle.loaded_point / bristle.load;
    const Vector3d normal = bristle.loaded_normal.normalized();
    const auto along_contact = [&normal](const Vector3d& v) -> Vector3d {
      return v - normal * normal.dot(v);
    };
    const Vector3d v = along_contact(velocity_at(model, data, bristle.bodies[1], point) -
                                     velocity_at(model, data, bristle.bodies[0], point));
    const double limit = bristle.coefficient * bristle.load;
    bristle.stretch = along_contact(bristle.stretch + model.opt.timestep * v);
    cut(bristle.stretch, limit / bristle.stiffness);
    Vector3d force = -(bristle.stiffness * bristle.stretch + bristle.damping * v);
    cut(force, limit);
    bristle.force = force;
    add_force(force, point, bristle.bodies[1], data);
    add_force(-force, point, bristle.bodies[0], data);
  }
}

}  // namespace zwang::runtime
