/// The axes of a task, as numbers that the model can be asked about.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "check/context.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

/// One axis or feature that is in force in a task: of the task, of `always`, or a limit of the robot file.
/// SI.
struct PlannedAxis {
  std::string path;                ///< "go.x", "always.manners.x", "near", "limits.x"
  const AxisText* text = nullptr;  ///< nullptr: a limit of the robot file
  std::string group;               ///< name of its group; empty under `always`
  std::string move_name;           ///< of the moved frame
  std::string in_name;             ///< of the frame whose axes they are; empty for a feature
  solver::AttachedFrame move, in;
  bool in_world = false;  ///< `in` stands in the world: how it lies to the base changes while the base moves
  solver::Measure measure = solver::Measure::axis;
  solver::Axis axis = solver::Axis::x;        ///< of an angle: the one of `move`; of other features any alike
  solver::Axis other_axis = solver::Axis::x;  ///< of an angle: the one of `in`
  std::array<double, 6> coefficients{};       ///< of a direction
  bool is_placed = true;    ///< false: a frame hangs on a signal, so nobody knows yet where it is
  bool is_on_path = false;  ///< it turns with a path, at whose start it stands here
  bool is_set = false;      ///< a `set` of the file puts one of its frames elsewhere
  std::optional<solver::Quantity> driver;
  std::optional<double> target;  ///< at the start; none: `here`, or a signal's
  std::optional<double>
      farthest_target;  ///< of all values that its parameter may take, the one farthest from 0
  std::array<std::optional<solver::Range>, 4> ranges;  ///< by solver::Quantity, at the start
  std::array<Span, 4> spans;                           ///< of the statements' values
  double time_constant = 0.5;                          ///< [s]
  Span time_constant_span;  ///< where it may be written: its value, else the axis's key
  /// Of a distance to something beside the robot: angles from the base's x of directions in which two of its
  /// acceleration ranges bind at once. Their number is `corner_count`. [rad]
  std::array<double, 4> corners{};
  std::size_t corner_count = 0;
  int level = 1;
  bool is_norm = false;                      ///< x or y of what `plane` bounds
  bool is_soft = false;                      ///< has a weight
  bool is_spring = false;                    ///< has stiffness and damping: pushes, and holds no motion
  std::optional<double> stiffness, damping;  ///< of a spring, at the start
  Span stiffness_span, damping_span;
  bool is_yield = false;             ///< gives way to a force; its driver is an acceleration
  std::optional<double> yield_mass;  ///< M at the start
  Span yield_mass_span;
  std::optional<double> dead_band;  ///< of a yield, at the start
  Span dead_band_span;
  std::optional<double> build_up;  ///< [s] at the start
  Span build_up_span;

  const std::optional<solver::Range>& operator[](solver::Quantity q) const {
    return ranges[static_cast<std::size_t>(q)];
  }
  const Span& span(solver::Quantity q) const { return spans[static_cast<std::size_t>(q)]; }
  const Span& driver_span() const { return span(*driver); }
  bool drives_motion() const { return driver && *driver != solver::Quantity::force && !is_spring; }
  bool stands_still() const { return driver == solver::Quantity::velocity && target == 0.0; }
  bool turns() const {
    return measure == solver::Measure::angle || measure == solver::Measure::bearing || is_rotation(axis);
  }
  bool is_feature() const { return measure != solver::Measure::axis; }
  /// A way of the base along axes that do not turn with it: nobody knows how it will head to them by then.
  bool is_headed_anyhow() const {
    return (in_world || !is_placed) && move.body == 0 && !turns() &&
           (measure == solver::Measure::axis || measure == solver::Measure::direction);
  }
  /// A distance to something beside the robot: nobody knows from where the robot will come.
  bool is_open() const { return measure == solver::Measure::distance && in_world; }
};

/// `speed`, and `velocity` of `plane`: what bounds the planar velocity of a frame.
struct PlannedSpeed {
  std::string path;   ///< "always.manners.speed"
  int body = 0;       ///< that carries the frame
  double most = 0.0;  ///< [m/s]
  Span span;          ///< of the range
};

/// `acceleration` or `force` of `plane`.
struct PlannedNorm {
  std::string path;  ///< "always.calm.plane"
  solver::AttachedFrame move;
  double most = 0.0;  ///< [m/s^2] or [N]
  Span span;          ///< of the range
};

struct PlannedTask {
  const TaskText* task = nullptr;
  std::vector<PlannedAxis> axes;  ///< of `always`, of the task, then the robot file's limits
  std::vector<PlannedAxis> free;  ///< of them what is written as `free`
  std::vector<PlannedSpeed> speeds;
  std::vector<PlannedNorm> norms, force_norms;

  /// How fast the axis may go at most, by its own range and by what bounds the planar speed of what it moves.
  /// Infinite where nothing does. [m/s] or [rad/s]
  double speed_limit(const PlannedAxis& axis) const;
};

struct Place {
  solver::AttachedFrame frame{-1, {}};
  bool is_known = true;  ///< false: it hangs on a signal
  bool is_set = false;   ///< a `set` of the file puts it elsewhere
};

/// Where a frame is fixed: the parents stand before it in the table, so the chain ends.
Place place_of(const CheckContext& context, int index);

/// What the feature measures, without a statement; nullopt where it cannot be read.
std::optional<PlannedAxis> plan_feature(const CheckContext& context, int index);
/// The readable axes of the task. An axis with an error has its diagnostic and is left out.
PlannedTask plan_task(const CheckContext& context, const TaskText& task);
/// The readable axes of `always`, which are in force in every task.
PlannedTask plan_always(const CheckContext& context);

}  // namespace zwang::lang
