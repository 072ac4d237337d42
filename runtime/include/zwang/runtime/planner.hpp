/// The rows of each task as the solver will get them at the start pose, and what the robot can make of them.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/plant.hpp"
#include "zwang/solver/base_analysis.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::runtime {

/// One row of a task as the solver gets it.
struct PlannedRow {
  solver::Row row;
  std::string name;                ///< "contact.x"
  lang::Span span;                 ///< of the statement; none: it has no text
  std::optional<double> weight;    ///< [kg] or [kg m^2]
  std::optional<double> fraction;  ///< of b that a soft row meets
  bool turns = false;              ///< measured in rad rather than in m
};

/// The smallest and the largest over the configurations; values that are not finite do not count.
struct Spread {
  double least = solver::infinity, most = -solver::infinity;
  void add(double value) {
    if (!std::isfinite(value)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool exists() const { return least <= most; }
  bool is_one_number() const { return most - least <= 1e-3 * std::abs(most); }
};

/// The mass and the forces of the robot along one axis.
struct PlannedAxis {
  std::string name;
  bool turns = false;              ///< measured in rad rather than in m
  solver::AxisAnalysis analysis;   ///< at the start pose
  Spread mass, force;              ///< [kg], [N] or [kg m^2], [N m], where the joints let it move
  bool is_sometimes_held = false;  ///< in one of the configurations the ground holds it
};

/// A statement that has no row at the start pose.
struct DormantRow {
  std::string name, why;
  lang::Span span;
};

/// The rows and axes of one task.
struct TaskPlan {
  std::string task;
  std::string refused;  ///< why there are no rows; empty otherwise
  std::vector<PlannedRow> rows;
  std::vector<DormantRow> dormant;
  std::vector<std::string> unknown_signals;  ///< that frames or drivers of the task hang on
  std::vector<PlannedAxis> axes;
  int equality_rows = 0;
  int rank = 0;  ///< of the equality rows, on the ground
  std::vector<lang::Diagnostic> notes;
};

/// The configurations over which the spreads are taken.
struct Configurations {
  std::size_t count = 1;
  std::string words;
};

/// Looks at a program's tasks at the start pose and over `lang::configurations`. Program and diagnostics must
/// outlive it.
class ZWANG_EXPORT Planner {
 public:
  /// `diagnostics`: those of loading the program, whose physical ones each plan repeats.
  Planner(const lang::Program& program, const lang::Diagnostics& diagnostics);

  Configurations configurations() const;
  /// `task`: an index into Program::tasks.
  TaskPlan plan(int task) const;
  /// The same in the state of a snapshot and with its signals: the rows of a task that is entered there. `at`
  /// is laid out for the program. The spreads are of this state alone.
  TaskPlan plan(int task, const Sensed& at) const;

 private:
  const lang::Program& program_;
  const lang::Diagnostics& diagnostics_;
  std::vector<solver::State> states_;  ///< the start pose first
};

}  // namespace zwang::runtime
