/// The true motion of one base: how it leans, speeds up, pushes, slips and falls.
#pragma once

#include "contact_reader.hpp"
#include "floor_slip.hpp"
#include "moving_robot.hpp"
#include "quiet_means.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::runtime {

/// Does not allocate, lock, throw or print after construction.
class BaseWatch {
 public:
  BaseWatch(const MovingRobot& robot, double period);

  /// Roll and pitch.
  static void read_lean(const MovingRobot& robot, const mjModel_& m, const mjData_& d,
                        BaseTruth& truth) noexcept;
  /// Acceleration, push and slip of the step from `before` to `now` [s], after all contacts were added up.
  void read_motion(const MovingRobot& robot, const mjModel_& m, const mjData_& d,
                   const RobotContacts& contacts, double before, double now, BaseTruth& truth) noexcept;
  /// Whether it has fallen by `now`. [s]
  static void look_for_fall(const MovingRobot& robot, const mjModel_& m, const mjData_& d,
                            const RobotContacts& contacts, double now, BaseTruth& truth) noexcept;

 private:
  QuietMeans means_;
  FloorSlip slip_;
  solver::State state_;  ///< room to read it
};

}  // namespace zwang::runtime
