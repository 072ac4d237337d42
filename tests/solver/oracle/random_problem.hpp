/// Seeded random robots, states and rows.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "zwang/solver/constraint.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::oracle {

/// Seeded draws. Two of them never stand among the arguments of one call: compilers differ in which comes
/// first.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }
  int pick(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
  }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  solver::Vector3 vector(double size);
  solver::Vector3 direction();
  solver::Matrix3 rotation();

 private:
  std::mt19937_64 engine_;
};

enum class Robot {
  arm,
  tree,
  floating_tree,
  mecanum,
  omni,
  differential,
  kelo,
  skid,
  mecanum_arm,
  tricycle,
  swerve,
  differential_arm,
  kelo_arm,
  car
};
inline constexpr Robot all_robots[] = {Robot::arm,      Robot::tree,   Robot::floating_tree,
                                       Robot::mecanum,  Robot::omni,   Robot::differential,
                                       Robot::kelo,     Robot::skid,   Robot::mecanum_arm,
                                       Robot::tricycle, Robot::swerve, Robot::differential_arm,
                                       Robot::kelo_arm, Robot::car};
const char* to_string(Robot robot);

solver::RigidInertia random_inertia(Random& random, double mass);
solver::Model random_model(Robot robot, Random& random, double max_effort);
/// Wheeled bases stand upright anywhere; the measured velocity need not be one that the wheels allow.
solver::State random_state(const solver::Model& model, Random& random);

struct RowOptions {
  int count = 3;
  int levels = 1;
  double one_sided = 0.2;
  double force = 0.15;
  double duplicate = 0.15;  ///< a copy of an earlier row, or a mixture of two; b is consistent or not
  double apart = 0.3;       ///< of the copies those with another b
  double relative = 0.15;   ///< between two bodies
  double weight = 0.1;      ///< soft
  double sum = 0.1;         ///< bounds what the rows press with together
  double bound = 60.0;      ///< largest |nu| [N] or [N m]
  double demand = 3.0;      ///< largest |b| [m/s^2] or [rad/s^2]
};
/// Eight rows of every kind at most, on three levels.
inline constexpr RowOptions everything{.count = 8, .levels = 3};
std::vector<solver::Row> random_rows(const solver::Model& model, const RowOptions& options, Random& random);

}  // namespace zwang::oracle
