/// One unit of work of the benchmarks: a call on a problem that was set up outside, at state number i.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "zwang/solver/model.hpp"
#include "zwang/solver/popov_vereshchagin.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::bench {

inline constexpr int state_count = 64;

struct Workload {
  std::string name;
  std::string includes;  ///< what one call does
  std::function<void(std::size_t)> call;
};

/// A light arm of seven joints: alternating axes, link lengths and masses.
struct Arm {
  static constexpr int joints = 7;
  static solver::Vector3 axis(int j) {
    return j % 2 == 0 ? solver::Vector3::UnitZ() : solver::Vector3::UnitY();
  }
  static double length(int j) { return j % 2 == 0 ? 0.16 : 0.2; }
  static double mass(int j) { return 3.5 - 0.3 * j; }
  static solver::Vector3 com() { return {0.01, -0.02, 0.08}; }
  static solver::Matrix3 inertia() { return solver::Vector3(0.02, 0.018, 0.006).asDiagonal(); }
  static void add_to(solver::ModelBuilder& builder, const std::string& parent, int links);
};

std::vector<solver::State> random_states(const solver::Model& model, unsigned seed);

Workload arm_zwang(int rows);
Workload arm_kdl(int rows);  ///< kdl_arm.cpp
Workload arm_pinocchio();    ///< pinocchio_arm.cpp, where it is installed
Workload base_rows();
Workload base_full();
/// The same base with wheels that are not round: what round ones keep from call to call is computed anew.
Workload eccentric_base_rows();
Workload eccentric_base_full();
Workload base_with_rows();
Workload base_tick();
Workload mobile_arm_rows();
Workload mobile_arm_full();
std::string chain_name(int links, int rows);
Workload chain(int links, int rows);

/// mj_step of a four-wheeled mecanum base with the settings of the simulated plant (mujoco_step.cpp).
Workload mujoco_step();

}  // namespace zwang::bench
