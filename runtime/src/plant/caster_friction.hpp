/// Friction of an object that rolls on four swivel casters.
///
/// A caster's wheel trails its pivot by t. It holds no force across its heading: the pivot's velocity across
/// it swivels the caster by d' = v_across/t - w, w the object's turn. Along its heading it rolls against dry
/// friction, a bristle, with a quarter of mu m g.
#pragma once

#include <Eigen/Core>
#include <array>

#include "bristle.hpp"

namespace zwang::runtime {

class CasterFriction {
 public:
  CasterFriction() = default;
  /// Pivots at (+-`ahead`, +-`aside`) [m] from the centre. `load` mu m g [N], `trail` [m]. All head along x.
  CasterFriction(double mass, double load, double trail, double ahead, double aside);

  /// Force and moment (fx, fy [N], mz [N m]) about the centre at its planar velocity, both in the object's
  /// own axes. Moves the casters by one step of `period` [s].
  Eigen::Vector3d step(const Eigen::Vector3d& velocity, double period) noexcept;

 private:
  struct Caster {
    Eigen::Vector2d pivot = Eigen::Vector2d::Zero();
    double heading = 0.0;  ///< [rad]
    Bristle bristle;       ///< along the heading
  };
  std::array<Caster, 4> casters_;
  double trail_ = 1.0;  ///< [m]
};

}  // namespace zwang::runtime
