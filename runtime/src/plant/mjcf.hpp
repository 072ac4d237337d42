/// The simulation as text: MuJoCo's XML, written from our own model. Nothing here knows the simulator.
///
/// Names:
///   body_<i>, joint_<j>, motor_<j>    after the model's numbers
///   wheel_<w>                         with rollers wheel_<w>_<i>, on bodies and joints roller_<w>_<i>
///   floor
///   bumper_<c>                        corners of the robot's outline
///   bumper_prism, skid_<c>            of the robot's outline
///   hull                              the part that lies on the floor once the base has fallen
///   tip_<t>                           of its arms
///   object_<k>                        body of the scene, with geoms object_<k>_face and object_<k>_edge_<c>; for arms
///                                     object_<k>_solid
///   dock_<k>                          equality; those of robots are counted on after the objects'
/// All names of the scene's robots start with `partner_<r>_`, r from 1.
///
/// Robot and objects meet in one plane, at the height of the bumper: corners of the one against faces of the
/// other, each pair one contact point. The tip of an arm meets objects as they are. A corner is a sphere of
/// 1 um tangent to both of its sides. Robots meet each other in the same way. Movable objects slide in the
/// plane, on joints `object_<k>_x`, `_y`, `_turn`: their friction is in floor_friction.hpp.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "rollers.hpp"
#include "rolling_spheres.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::runtime {

/// The data from which the text is written, worked out once.
struct SimulatedRobot {
  lang::Robot robot;
  std::string prefix;  ///< of all names of its parts
  SphereBase spheres;
  std::vector<RollerWheel> rollers;      ///< by wheel, where they are built as they are; else empty
  double ground = 0.0;                   ///< [m] height of the ground in the base frame
  std::vector<double> wheel_lift;        ///< [m] each wheel's move upwards that makes the base stand level
  std::vector<solver::Vector3> outline;  ///< convex hull of the footprint, counter-clockwise
  std::vector<solver::Frame> tips;       ///< of arms: where they touch objects; four of a pad
  std::vector<solver::Vector3> skids;    ///< points under the base; empty when the wheels carry it
  double top = 0.0;                      ///< [m] height of the body above the ground

  std::string named(const char* part, std::size_t number) const {
    return prefix + part + '_' + std::to_string(number);
  }
};

/// `number` 0 is the first robot, then come the scene's. Throws std::invalid_argument when the robot cannot
/// be simulated.
SimulatedRobot prepare_robot(const lang::Robot& robot, bool real_rollers = false, int number = 0);

/// The frame that latches in the dock of `owner`. Throws std::invalid_argument when the robot has none.
const solver::Frame& hook_of(const solver::Model& model, const lang::Dock& dock, const std::string& owner);

inline constexpr double contact_half_height = 1.0;  ///< [m] of the upright faces that meet

/// The text of one robot: meshes, its tree of bodies, its contacts with the floor, its motors.
struct RobotText {
  std::string assets, body, contacts, motors;
};
RobotText write_robot(const SimulatedRobot& simulated, double floor_friction);

/// The first robot, then the scene's in its order.
std::string write_mjcf(const std::vector<SimulatedRobot>& robots, const lang::Scene& scene, double period);

/// How an object's springs are described in the text; the plant puts in the stiffness afterwards.
inline constexpr double spring_impedance = 0.001;

}  // namespace zwang::runtime
