/// MuJoCo as a process-wide library: its handlers, its collision functions, and calls that cannot end the
/// process. A text is compiled here, and its model is asked whether it is the one that was meant.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "contact_spring.hpp"
#include "mjcf.hpp"

struct mjModel_;
struct mjData_;

namespace zwang::runtime {

struct ModelDeleter {
  void operator()(mjModel_* model) const;
};
struct DataDeleter {
  void operator()(mjData_* data) const;
};
using ModelPointer = std::unique_ptr<mjModel_, ModelDeleter>;
using DataPointer = std::unique_ptr<mjData_, DataDeleter>;

/// MuJoCo's numbers as ours: a quaternion w, x, y, z, and three in a row.
Eigen::Matrix3d matrix_of(const double* quaternion);
Eigen::Vector3d vector_of(const double* numbers);

/// Once, before all else. Replaces the handlers of the whole process; the collision functions act as before
/// outside of `guarded`.
void install_handlers();

/// False when MuJoCo raised an error: the data is void.
bool guarded(void (*call)(const mjModel_*, mjData_*), const mjModel_* model, mjData_* data) noexcept;

/// Throws std::invalid_argument when MuJoCo refuses the text.
ModelPointer compile(const std::string& mjcf);

/// Throws std::invalid_argument where MuJoCo's masses and inertias are not those that were written.
void require_as_written(const mjModel_& model, const SimulatedRobot& simulated);

/// Which object, or which part of a robot, a geom belongs to.
struct GeomOwner {
  int object = -1;
  int robot = -1;        ///< 0 the first one, then the scene's
  bool touches = false;  ///< of a robot: its outline or a tip
  bool body = false;     ///< of a robot: the body that never touches the floor while the base stands
  int part = 0;          ///< of a robot: the body of its model, where it touches
  int corner = -1;       ///< of the robot's footprint
  int wheel = -1;

  bool is_floor() const noexcept { return object < 0 && robot < 0; }
};

/// By geom. The corners of the outline are the footprint's.
std::vector<GeomOwner> find_owners(const mjModel_& model, const std::vector<SimulatedRobot>& robots);

/// Gives every contact with an object or between robots the spring that the scene says. Returns them by pair
/// of geoms; those with the floor have none.
std::vector<ContactSpring> set_springs(mjModel_& model, const std::vector<GeomOwner>& owners,
                                       const lang::Scene& scene, const std::vector<SimulatedRobot>& robots);

}  // namespace zwang::runtime
