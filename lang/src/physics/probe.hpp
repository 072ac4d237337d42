/// Asks the robot's model, through the solver, what its axes can do.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "physics/planned_axis.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/solver/base_analysis.hpp"
#include "zwang/solver/popov_vereshchagin.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::lang {

/// An axis alone, at the start pose and over the configurations that it may meet. [kg] or [kg m^2], [N] or
/// [N m]
struct AxisFigures {
  bool is_held = true;        ///< in every configuration the ground leaves nothing of it
  bool is_reachable = false;  ///< in some configuration, at some heading, the motors have a force along it
  /// A distance that the wheels hold from some side: towards it the mass grows without bound.
  bool is_held_from_some_side = false;
  double mass = 0.0;  ///< at the start; there infinite where the ground holds the axis
  double least_mass = 0.0, most_mass = 0.0;
  double force = 0.0;                  ///< largest that the motors make, at the start
  std::vector<double> masses, forces;  ///< of each configuration and direction
};

/// The force of a force driver in one configuration.
struct Pressed {
  double force = 0.0;   ///< that way [N] or [N m]
  double motors = 0.0;  ///< that they make there [N] or [N m]
  double mass = 0.0;    ///< effective [kg] or [kg m^2]
};

/// Everything is computed at rest, in `configurations()`. Whether an axis can be reached at all is also tried
/// at other headings.
///
/// Nobody knows from where the robot comes to an object beside it. So a distance to the object is probed in
/// several directions. They are the base's x, y and both diagonals, and those of least and of most mass. It
/// is also probed where two acceleration ranges bind at once. The masses between `least_mass` and `most_mass`
/// are those of all directions, the forces those of the directions named.
///
/// A file may be hostile, and validating it must end. So every look costs, and past the budget nothing is
/// answered any more.
class Probe {
 public:
  /// `budget` is what may be spent, and what is left of it afterwards. Throws std::invalid_argument on a
  /// model that dynamics cannot use.
  Probe(const Robot& robot, const std::optional<Scene>& scene, double& budget);

  /// nullptr past the budget.
  const AxisFigures* figures(const PlannedAxis& axis);
  /// How many of the rows along the axes are independent, on the ground and in general position.
  int rank(const std::vector<const PlannedAxis*>& axes);
  /// The rank without the ground and the joints: of the bodies' own coordinates.
  int kinematic_rank(const std::vector<const PlannedAxis*>& axes);
  /// The rank on the ground at the start pose alone.
  int rank_at_start(const std::vector<const PlannedAxis*>& axes);
  /// 1 where both axes are one motion, -1 where one is the other turned around, else 0.
  int alignment(const PlannedAxis& a, const PlannedAxis& b);
  /// Between two directions that frames carry, at the start pose and at most in general position, too. [rad]
  struct Angles {
    double at_start = 0.0, most = 0.0;
  };
  Angles angles(const solver::AttachedFrame& a, const solver::Vector3& along_a,
                const solver::AttachedFrame& b, const solver::Vector3& along_b) const;
  /// The coordinate of an axis whose place is known. [m] or [rad]
  double position_at_start(const PlannedAxis& axis) const;
  /// From the base's origin to the frame, in the plane, at the start. [m]
  double reach_at_start(const solver::AttachedFrame& frame) const;
  /// How fast the joints beside the wheels can move the axis together, each at its <limit velocity>, in the
  /// configuration that suits it best. `joint`: the one that adds most; -1: none adds anything.
  struct JointSpeed {
    double most = 0.0;  ///< [m/s] or [rad/s]
    int joint = -1;
  };
  JointSpeed joint_speed(const PlannedAxis& axis) const;
  /// The force of a force driver against something that blocks its axis, after the acceleration ranges among
  /// `limits` took their part. An entry for each configuration and direction in which it can be told.
  std::vector<Pressed> pressed(const PlannedAxis& axis, double force, const std::vector<PlannedAxis>& limits);
  /// `pressed` at the start pose, at any heading of the base to the axis. The directions are the base's x, y
  /// and both diagonals, and those of least and of most mass.
  std::vector<Pressed> pressed_whatever_way(const PlannedAxis& axis, double force,
                                            const std::vector<PlannedAxis>& limits);

  bool is_exhausted() const { return budget_ <= 0.0; }
  int base_mobility() const { return base_mobility_; }
  int mobility() const { return mobility_; }
  const Robot& robot() const { return robot_; }
  /// On a base of two freedoms a frame whose x and y it can both drive, as it is written; empty on others.
  std::string frame_ahead() const;
  /// Whether the motors move the base along its own x and turn it.
  bool turns_and_drives();
  /// The axis in the world, at the start pose; of a feature the direction of its force or moment, 0 where it
  /// has none.
  solver::Vector3 direction(const PlannedAxis& axis) const;
  /// Whether the axis points up or turns the base over: what the ground itself holds.
  bool is_out_of_plane(const PlannedAxis& axis) const;
  /// The difference in height [m] between the two points of a distance while the base moves. 0: an arm or a
  /// signal may change it.
  double kept_height(const PlannedAxis& axis) const;

 private:
  static constexpr int most_rows = 64;
  /// An axis in one configuration, seen in one direction.
  struct Look {
    const solver::State* state;
    solver::AxisConstraint constraint;
    solver::AxisAnalysis analysis;
  };
  struct Looks {
    std::vector<Look> all;
    AxisFigures figures;
  };
  using Key = std::array<double, 42>;
  static Key key_of(const PlannedAxis& axis);
  /// The axis in every configuration; nullptr past the budget.
  const Looks* looks(const PlannedAxis& axis);
  std::vector<Pressed> pressed_in(const std::vector<Look>& looks, bool both_ways, const PlannedAxis& axis,
                                  double force, const std::vector<PlannedAxis>& limits);
  /// False past the budget.
  bool look(const solver::AxisConstraint& constraint, const solver::State& state, std::vector<Look>& all);
  bool look_around(const PlannedAxis& axis, const solver::State& state, std::vector<Look>& all);
  bool look_everywhere(const PlannedAxis& axis, Looks& looks);
  static AxisFigures summary(const PlannedAxis& axis, const std::vector<Look>& all);
  /// nullopt where a feature has no direction: of a bearing, within 5 cm of its target.
  std::optional<solver::Row> row_along(const PlannedAxis& axis, const solver::State& state) const;
  int rank_at(const std::vector<const PlannedAxis*>& axes, const solver::State& state);
  /// Pays for `passes` of the sweeps over the ground and `rows` more rows. False past the budget.
  bool pay(std::size_t rows, double passes);

  const Robot& robot_;
  std::vector<solver::State> states_;   ///< the configurations, the start pose first
  std::vector<solver::State> general_;  ///< any joint angles, any heading
  int base_mobility_ = 0, mobility_ = 0;
  double& budget_;
  std::map<Key, Looks> looks_;
  solver::Solver solver_;
  solver::Solution solution_;
  solver::PopovVereshchagin equalities_;
  solver::ConstrainedMotion motion_;
};

}  // namespace zwang::lang
