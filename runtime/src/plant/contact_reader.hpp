/// The sums of the contacts of a step: forces on objects, corners and robots, and which contacts are hits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact_spring.hpp"
#include "simulator.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::runtime {

/// Of one robot, in one step.
struct RobotContacts {
  Eigen::Vector2d push = Eigen::Vector2d::Zero();  ///< [N] of all that presses on it, in world axes
  double moment = 0.0;                             ///< [N m] of the same, about the world's z
  double hit_until = -1.0;                         ///< [s] when its last hit is over
  bool lies_on_floor = false;                      ///< its body does
  /// [N m], [N] of the same on each body of its model, in world axes and about the world's origin.
  std::vector<solver::ForceVector> on_body;
};

class ContactReader {
 public:
  ContactReader() = default;
  /// `owners` by geom, `springs` by pair of geoms, `objects` of the scene.
  ContactReader(std::vector<GeomOwner> owners, std::vector<ContactSpring> springs,
                const std::vector<SimulatedRobot>& robots, std::size_t objects);

  const GeomOwner& owner_of(int geom) const { return owners_[static_cast<std::size_t>(geom)]; }
  /// The contacts of the step that was just made are those at its beginning, `before` [s].
  void read(const mjModel_& model, const mjData_& data, double before, Truth& truth) noexcept;
  /// Adds another load on a robot: a force on a body of its model [N] at a point of the world [m], and a
  /// torque [N m].
  void add_push(std::size_t robot, int body, const Eigen::Vector3d& force, const Eigen::Vector3d& at,
                const Eigen::Vector3d& torque = Eigen::Vector3d::Zero()) noexcept;
  /// A hook that catches is a hit.
  void note_catch(std::size_t robot, double time) noexcept;
  const RobotContacts& of_robot(std::size_t robot) const noexcept { return robots_[robot]; }

 private:
  /// How an object presses on the first robot, in one step.
  struct Met {
    Eigen::Vector3d push = Eigen::Vector3d::Zero();  ///< [N] all normal forces, in world axes
    int body = 0;                                    ///< of the robot's model, the last one
  };

  void keep_peaks(Truth& truth) const noexcept;
  int touched_object(int geom1, int geom2) const noexcept;
  const ContactSpring* spring_of(const mjModel_& model, int geom1, int geom2) const noexcept;

  std::vector<GeomOwner> owners_;
  std::vector<ContactSpring> springs_;
  std::vector<RobotContacts> robots_;
  std::vector<Met> met_;  ///< by object, then by other robot
  std::size_t objects_ = 0;
};

}  // namespace zwang::runtime
