/// The bounds of a number that a condition measures, known before anything runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/endings.hpp"
#include "physics/confined.hpp"
#include "physics/driven_way.hpp"
#include "physics/known.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

/// Of the plan's task, or of `always`.
class KnownNumbers {
 public:
  KnownNumbers(const CheckContext& context, const PlannedTask& plan, const AllTasks& all, Probe& probe);

  /// `latest`: when the task ends at the latest. `until`: when the case that is looked at does. [s] since the
  /// task was entered
  void set_time(const Ending& latest, double until);
  Known of(const ExpressionNode& node);
  /// Whether the start, or what a task before drives, brings the number to what is demanded.
  bool is_entered_with(const ExpressionNode& node, const Bounds& demanded, const Known& known);

 private:
  /// The tasks from which a way leads to this one. Asked once.
  const std::vector<const PlannedTask*>& before();
  Known known_speed(const ExpressionNode& node);
  Known known_way(const ExpressionNode& node);
  Known known_turn(const ExpressionNode& node);
  /// By the way to the drivers' places, where that is shorter.
  void limit_to(Known& known, const std::optional<DrivenWay>& way) const;
  Known known_since(const ExpressionNode& node) const;
  /// No way leads from it to the task whose exits are looked at.
  bool is_yet_to_come(const std::string& task) const;
  Known known_entries(const ExpressionNode& node) const;
  SpeedLimit limit_of(const ExpressionNode& node);
  Known known_coordinate(const ExpressionNode& node);
  const PlannedAxis* feature_axis(const ExpressionNode& node) const;
  Known known_feature(const ExpressionNode& node);
  Known known_beside_regions(const PlannedAxis& axis) const;
  /// The range of the quantity; nullopt where a `set` of the file may widen it.
  std::optional<solver::Range> range_of(const PlannedAxis& axis, solver::Quantity quantity) const;
  Known known_position(const PlannedAxis& axis);
  /// A driver of position goes from where it starts to its target; a tenth and 2 cm are left for overshoot.
  Known towards_target(const PlannedAxis& axis, double from, Known known) const;
  Known known_velocity(const PlannedAxis& axis);
  Known known_force(const PlannedAxis& axis) const;

  const CheckContext& context_;
  const PlannedTask& plan_;
  Probe& probe_;
  const AllTasks& all_;
  bool is_start_;  ///< a run begins with it
  bool is_first_;  ///< and never comes to it again
  std::vector<Confinement> regions_;
  std::optional<std::vector<const PlannedTask*>> before_;
  Ending latest_;
  double until_ = solver::infinity;  ///< [s]
};

}  // namespace zwang::lang
