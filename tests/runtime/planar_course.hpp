/// A program that drives the planar base of robots.hpp, whose dynamics are derived apart from the library.
#pragma once

#include <functional>

#include "robots.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime::test {

/// A program on the planar base, with forces from outside.
struct Course {
  explicit Course(const lang::Program& p) : program(p), runner(p), sensed(p.robot.model, p.signals.size()) {}
  void tick(const Eigen::Vector3d& force = Eigen::Vector3d::Zero()) {
    base.sense(sensed);
    tau = runner.step(sensed);
    base.step(tau, force);
  }
  void run(
      double seconds, const std::function<void()>& look = [] {}) {
    const double end = base.time + seconds - 1e-9;
    while (base.time < end) {
      tick();
      look();
    }
  }
  Eigen::Vector3d commanded() const { return base.commanded(tau); }
  double speed() const { return base.V.head<2>().norm(); }

  lang::Program program;
  Runner runner;
  Sensed sensed;
  PlanarBase base;
  Eigen::VectorXd tau;
};

/// Groups of `always` stand at level 0.
inline lang::Group at_level_zero(lang::Group group) {
  group.level = 0;
  for (AxisStatements& a : group.axes) a.level = 0;
  return group;
}

inline lang::Group inside(int region, double margin) {
  lang::Group group;
  group.name = "boundary";
  group.kind = lang::GroupKind::inside;
  group.region = region;
  group.moves_footprint = true;
  group.move = base_link;
  group.margin.constant = margin;
  return at_level_zero(group);
}

inline AxisStatements within(const std::string& name, Axis axis, Quantity quantity, double low, double high) {
  AxisStatements a = free_axis(name, axis);
  (quantity == Quantity::velocity       ? a.velocity
   : quantity == Quantity::acceleration ? a.acceleration
   : quantity == Quantity::force        ? a.force
                                        : a.position) = between(low, high);
  return a;
}

}  // namespace zwang::runtime::test
