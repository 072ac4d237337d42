/// Dry friction where robots touch objects and each other. The model is that of floor_friction.hpp under
/// objects, for the same reason. A sliding contact of MuJoCo is in balance at mu v B/K less depth than at
/// rest, with v its speed. It chatters where that is more than its depth. So these contacts press along their
/// normal only, and in the contact's plane an elastic bristle yields. With stretch s, ds/dt = v,
///     f = -(k s + c v), |f| <= mu N, and |k s| <= mu N by cutting s.
/// k = m w^2 with w = 100 1/s. m is MuJoCo's estimate of the moving mass at the contact.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator.hpp"

namespace zwang::runtime {

class ContactFriction {
 public:
  ContactFriction() = default;
  /// Of all pairs of geoms but those with the floor. `owners` by geom.
  ContactFriction(const mjModel_& model, const std::vector<GeomOwner>& owners);

  /// Sets `xfrc_applied` to the friction of the contacts that the last step found. Moves the bristles by one
  /// step.
  void push(const mjModel_& model, mjData_& data) noexcept;
  /// The forces on each pair's bodies: `act(geom1, geom2, force on the second [N], where [m])`.
  template <typename Act>
  void for_each(Act act) const {
    for (const Bristle& bristle : bristles_) {
      if (bristle.load > 0.0)
        act(bristle.geoms[0], bristle.geoms[1], bristle.force,
            Eigen::Vector3d(bristle.loaded_point / bristle.load));
    }
  }

 private:
  /// Of all contacts of one pair of geoms.
  struct Bristle {
    int geoms[2] = {-1, -1};
    int bodies[2] = {-1, -1};
    double coefficient = 0.0;                           ///< mu
    double stiffness = 0.0;                             ///< k [N/m]
    double damping = 0.0;                               ///< c [N s/m]
    Eigen::Vector3d stretch = Eigen::Vector3d::Zero();  ///< s [m], of the second body past the first
    double load = 0.0;                                  ///< N [N]
    Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< f [N] on the second body
    Eigen::Vector3d loaded_point, loaded_normal;        ///< sums over the contacts, each times its N
  };
  void find_loads(const mjModel_& model, const mjData_& data) noexcept;

  std::vector<Bristle> bristles_;
};

}  // namespace zwang::runtime
