#include "physics/probe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnostic/wordings_physics.hpp"
#include "zwang/lang/configurations.hpp"
#include "zwang/lang/wheel_level.hpp"
#include "zwang/solver/base_analysis.hpp"
#include "zwang/solver/joint_loads.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::lang {

namespace {

/// A force driver along the axis, and nothing else.
solver::AxisConstraint constraint_of(const PlannedAxis& axis, double force) {
  solver::AxisConstraint constraint;
  constraint.move = axis.move;
  constraint.in = axis.in;
  constraint.measure = axis.measure;
  constraint.axis = axis.axis;
  constraint.other_axis = axis.other_axis;
  constraint.coefficients = axis.coefficients;
  constraint.level = axis.level;
  constraint.driver = solver::Driver{.quantity = solver::Quantity::force, .target = force};
  return constraint;
}

/// The same along a direction in the plane that makes this angle with the world's x.
solver::AxisConstraint in_plane(solver::AxisConstraint constraint, double angle) {
  constraint.measure = solver::Measure::direction;
  constraint.in = {-1, {}};
  constraint.coefficients = {std::cos(angle), std::sin(angle), 0.0, 0.0, 0.0, 0.0};
  return constraint;
}

/// Two points that coincide, and two axes that are parallel, have no direction between them; nor has what
/// stands on the axis of who looks.
bool has_direction(const solver::AxisConstraint& constraint, const solver::Model& model,
                   const solver::State& state) {
  if (constraint.measure == solver::Measure::bearing) {
    const solver::Pose eye = solver::motion_of(constraint.move, model, state).pose;
    const solver::Vector3 seen = solver::motion_of(constraint.in, model, state).pose.position;
    return (eye.rotation.transpose() * (seen - eye.position)).head<2>().norm() >= solver::nearest_bearing;
  }
  const double s = solver::coordinate_of(constraint, model, state).position;
  if (constraint.measure == solver::Measure::distance) return s > 1e-6;
  return constraint.measure != solver::Measure::angle || std::sin(s) > 1e-6;
}

double along(const solver::Row& row, const solver::Solution& solution) {
  const auto of = [&](int body) -> const solver::MotionVector& {
    return solution.acceleration[static_cast<std::size_t>(body)];
  };
  double value = solver::dot(row.a, of(row.body));
  if (row.reference_body >= 0) value -= solver::dot(row.a_reference, of(row.reference_body));
  return value;
}

}  // namespace

Probe::Probe(const Robot& robot, const std::optional<Scene>& scene, double& budget)
    : robot_(robot),
      states_(configurations(robot, scene)),
      general_(general_states(robot.model)),
      budget_(budget),
      solver_(robot.model, {.row_capacity = most_rows}),
      solution_(robot.model, most_rows),
      equalities_(robot.model, {.row_capacity = most_rows}),
      motion_(robot.model, most_rows) {
  const solver::Model& model = robot.model;
  solver::JointLoads arm(model);
  for (solver::State& state : states_) arm.bear(state);  // as the runtime does
  for (const solver::State& state : states_) {
    if (!pay(1, 10.0)) break;
    const solver::BaseAnalysis base = solver::analyse_base(model, state);
    base_mobility_ = std::max(base_mobility_, base.base_mobility);
    mobility_ = std::max(mobility_, base.mobility);
  }
}

std::string Probe::frame_ahead() const {
  // A base that steers has another freedom once it has steered, and at any moment one arc to go along.
  if (base_mobility_ != 2 || solver::analyse_base(robot_.model, states_[0]).base_mobility != 2) return "";
  // A turn moves a point sideways by its distance from the axle.
  const auto wheels = robot_.model.wheels();
  const auto stiff = std::find_if(wheels.begin(), wheels.end(), [&](const solver::Wheel& wheel) {
    return robot_.model.bodies()[static_cast<std::size_t>(wheel.body)].parent == 0 && wheel.holds_sideways;
  });
  if (stiff == wheels.end()) return "";
  const solver::Pose pose = pose_in_base(robot_.model, stiff->body);
  const solver::Vector3 axis = pose.rotation * robot_.model.joint(stiff->body - 1).axis;
  double yaw = std::atan2(-axis.x(), axis.y());
  constexpr double right = std::numbers::pi / 2.0, rounding = 1e-3;
  if (yaw > right + rounding) yaw -= std::numbers::pi;
  if (yaw < -right + rounding) yaw += std::numbers::pi;
  const solver::Vector3 forward(std::cos(yaw), std::sin(yaw), 0.0);
  const double axle = forward.dot(pose.position);
  double ahead = 0.0;
  for (const solver::Vector3& corner : robot_.footprint) ahead = std::max(ahead, forward.dot(corner));
  if (ahead < axle + 0.05) ahead = axle + 0.3;
  const auto metres = [](double value) {
    return wording::figure(std::abs(value) < rounding ? 0.0 : std::round(value * 1e3) / 1e3, "m");
  };
  const std::string turned =
      std::abs(yaw) < rounding
          ? ""
          : ", yaw: " + wording::figure(std::round(yaw * 180.0 / std::numbers::pi), "deg");
  return "`nose: {parent: " + robot_.base_frame + ", at: [" + metres(ahead * forward.x()) + ", " +
         metres(ahead * forward.y()) + "]" + turned + "}`";
}

bool Probe::turns_and_drives() {
  PlannedAxis own;
  own.move = own.in = {0, {}};
  const AxisFigures* ahead = figures(own);
  own.axis = solver::Axis::rz;
  const AxisFigures* turning = figures(own);
  return ahead != nullptr && turning != nullptr && ahead->is_reachable && turning->is_reachable;
}

solver::Vector3 Probe::direction(const PlannedAxis& axis) const {
  if (!axis.is_feature()) {
    const solver::Pose in = solver::motion_of(axis.in, robot_.model, states_[0]).pose;
    return in.rotation.col(static_cast<int>(axis.axis) % 3);
  }
  const std::optional<solver::Row> row = row_along(axis, states_[0]);
  if (!row) return solver::Vector3::Zero();
  const solver::Pose body = solver::motion_of({row->body, {}}, robot_.model, states_[0]).pose;
  const solver::Vector3 along = body.rotation * (axis.turns() ? row->a.angular : row->a.linear);
  return along.norm() > 0.0 ? solver::Vector3(along.normalized()) : along;
}

bool Probe::is_out_of_plane(const PlannedAxis& axis) const {
  const bool is_on_base = axis.move.body == 0 && robot_.model.base_type() == solver::BaseType::ground;
  const double up = std::abs(direction(axis).z());
  return is_on_base && (axis.turns() ? up < 1e-6 : up > 1.0 - 1e-6);
}

double Probe::kept_height(const PlannedAxis& axis) const {
  const bool is_on_base = axis.move.body == 0 && robot_.model.base_type() == solver::BaseType::ground;
  if (!is_on_base || !axis.in_world || !axis.is_placed) return 0.0;
  const auto height = [&](const solver::AttachedFrame& frame) {
    return solver::motion_of(frame, robot_.model, states_[0]).pose.position.z();
  };
  return std::abs(height(axis.move) - height(axis.in));
}

/// A row along the axis depends on where the axes point and, unless it turns, on the point that moves. A
/// distance and a bearing depend on both points.
Probe::Key Probe::key_of(const PlannedAxis& axis) {
  Key key{};
  std::size_t n = 0;
  const auto put = [&](const auto& numbers) {
    for (const double number : numbers) key[n++] = std::round(number * 1e9) * 1e-9 + 0.0;
  };
  const bool is_bearing = axis.measure == solver::Measure::bearing;
  const bool is_between_points = is_bearing || axis.measure == solver::Measure::distance;
  const solver::Vector3 nowhere = solver::Vector3::Zero();
  put(axis.move.pose.rotation.reshaped());
  put(axis.turns() && !is_bearing ? nowhere : axis.move.pose.position);
  put(axis.in.pose.rotation.reshaped());
  put(is_between_points ? axis.in.pose.position : nowhere);
  put(axis.coefficients);
  put(axis.corners);
  put(std::array{double(axis.move.body), double(axis.in.body), double(axis.is_placed), double(axis.measure),
                 double(axis.axis), double(axis.other_axis)});
  return key;
}

std::optional<solver::Row> Probe::row_along(const PlannedAxis& axis, const solver::State& state) const {
  solver::ConstraintSet set(1, 1);
  const bool has_one =
      set.add(constraint_of(axis, 1.0)) && set.fill(robot_.model, state) && !set.rows().empty();
  return has_one ? std::optional(set.rows().front()) : std::nullopt;
}

bool Probe::pay(std::size_t rows, double passes) {
  const solver::Model& model = robot_.model;
  // The sweeps carry n columns over the bodies; what they leave is factorised.
  const auto n = static_cast<double>(9 + 2 * model.wheels().size() +
                                     static_cast<std::size_t>(model.joint_count()) + rows);
  budget_ -= passes * (n * n * n + 60.0 * n * static_cast<double>(model.body_count()));
  return budget_ > 0.0;
}

bool Probe::look(const solver::AxisConstraint& constraint, const solver::State& state,
                 std::vector<Look>& all) {
  if (!pay(1, 2.0)) return false;
  all.push_back({&state, constraint, solver::analyse_axis(robot_.model, state, constraint)});
  return true;
}

/// Along the direction e in the plane the inverse of the effective mass is e' W e. W is A Mc A' of the
/// point's x and y. Three looks give W, and its eigenvectors point along
///
///   1/2 atan2(2 W_xy, W_xx - W_yy)        and square to that
bool Probe::look_around(const PlannedAxis& axis, const solver::State& state, std::vector<Look>& all) {
  const solver::AxisConstraint constraint = constraint_of(axis, 1.0);
  const double heading = std::atan2(state.base_pose.rotation(1, 0), state.base_pose.rotation(0, 0));
  const auto look_along = [&](double angle) {
    return look(in_plane(constraint, heading + angle), state, all);
  };
  const std::size_t first = all.size();
  for (const double part : {0.0, 0.25, 0.5, 0.75}) {
    if (!look_along(part * std::numbers::pi)) return false;
  }
  const auto inverse_mass = [&](std::size_t i) { return 1.0 / all[first + i].analysis.effective_mass; };
  const double xx = inverse_mass(0), yy = inverse_mass(2);
  const double xy = inverse_mass(1) - 0.5 * (xx + yy);
  if (std::abs(xy) > 1e-6 * (xx + yy)) {
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    if (!look_along(angle) || !look_along(angle + 0.5 * std::numbers::pi)) return false;
  }
  for (std::size_t i = 0; i < axis.corner_count; ++i) {
    if (!look_along(axis.corners[i])) return false;
  }
  return true;
}

bool Probe::look_everywhere(const PlannedAxis& axis, Looks& looks) {
  const solver::AxisConstraint constraint = constraint_of(axis, 1.0);
  // Axes that a signal will turn are looked at as if they lay like the world's.
  const bool hangs_on_place =
      axis.is_open() || axis.measure == solver::Measure::angle || axis.measure == solver::Measure::bearing;
  const bool is_known = axis.is_placed || !hangs_on_place;
  for (const solver::State& state : states_) {
    const bool has_one = is_known && has_direction(constraint, robot_.model, state);
    if (has_one && !look(constraint, state, looks.all)) return false;
    if (axis.is_open() && !look_around(axis, state, looks.all)) return false;
  }
  // Axes that are parallel at the start, or hang on a signal.
  for (std::size_t i = 0; i < general_.size() && looks.all.empty(); ++i) {
    const bool has_one = has_direction(constraint, robot_.model, general_[i]);
    if (has_one && !look(constraint, general_[i], looks.all)) return false;
  }
  looks.figures = summary(axis, looks.all);
  std::vector<Look> elsewhere;
  for (std::size_t i = 0; axis.in_world && !looks.figures.is_reachable && i < general_.size(); ++i) {
    if (!has_direction(constraint, robot_.model, general_[i])) continue;
    if (!look(constraint, general_[i], elsewhere)) return false;
    const solver::AxisAnalysis one = usable(elsewhere.back().analysis);
    looks.figures.is_reachable = one.reachable;
    looks.figures.is_held = looks.figures.is_held && !std::isfinite(one.effective_mass);
  }
  return true;
}

AxisFigures Probe::summary(const PlannedAxis& axis, const std::vector<Look>& all) {
  AxisFigures result;
  for (const Look& look : all) {
    const solver::AxisAnalysis one = usable(look.analysis);
    const bool is_first = result.masses.empty();
    if (is_first) {
      result.mass = result.least_mass = result.most_mass = one.effective_mass;
      result.force = one.largest_force;
    }
    result.is_reachable = result.is_reachable || one.reachable;
    result.masses.push_back(one.effective_mass);
    result.forces.push_back(one.largest_force);
    if (!std::isfinite(one.effective_mass)) {
      result.is_held_from_some_side = axis.is_open();
      continue;
    }
    result.is_held = false;
    result.least_mass = std::min(result.least_mass, one.effective_mass);
    result.most_mass =
        std::isfinite(result.most_mass) ? std::max(result.most_mass, one.effective_mass) : one.effective_mass;
  }
  return result;
}

const Probe::Looks* Probe::looks(const PlannedAxis& axis) {
  const auto [entry, is_new] = looks_.try_emplace(key_of(axis));
  if (!is_new) return &entry->second;
  if (look_everywhere(axis, entry->second)) return &entry->second;
  looks_.erase(entry);
  return nullptr;
}

const AxisFigures* Probe::figures(const PlannedAxis& axis) {
  const Looks* looks = this->looks(axis);
  return looks != nullptr ? &looks->figures : nullptr;
}

double Probe::position_at_start(const PlannedAxis& axis) const {
  return solver::coordinate_of(constraint_of(axis, 0.0), robot_.model, states_[0]).position;
}

double Probe::reach_at_start(const solver::AttachedFrame& frame) const {
  const solver::Pose pose = solver::motion_of(frame, robot_.model, states_[0]).pose;
  return (pose.position - states_[0].base_pose.position).head<2>().norm();
}

Probe::JointSpeed Probe::joint_speed(const PlannedAxis& axis) const {
  const solver::AxisConstraint constraint = constraint_of(axis, 0.0);
  JointSpeed best;
  for (solver::State state : states_) {
    double sum = 0.0, largest = 0.0;
    int joint = -1;
    for (int j = 0; j < robot_.model.joint_count(); ++j) {
      if (solver::carries_wheel(robot_.model, j + 1)) continue;
      state.qd.setZero();
      state.qd(j) = 1.0;
      const double lever = std::abs(solver::coordinate_of(constraint, robot_.model, state).velocity);
      if (lever < 1e-9) continue;
      const double share = lever * robot_.model.joint(j).max_velocity;
      sum += share;
      if (share > largest) joint = j;
      largest = std::max(largest, share);
    }
    if (sum > best.most) best = {sum, joint};
  }
  return best;
}

/// The robot does what the rows say, as if nothing were in its way. Blocked, it meets the force that takes
/// the acceleration along the axis away again: effective mass times that acceleration.
std::vector<Pressed> Probe::pressed_in(const std::vector<Look>& looks, bool both_ways,
                                       const PlannedAxis& axis, double force,
                                       const std::vector<PlannedAxis>& limits) {
  const auto room = static_cast<int>(limits.size()) + 1;
  // A robot that feels is led by one that is so much heavier, and presses with all that limits leave of it.
  const double led = robot_.drive.mass_factor;
  solver::ConstraintSet set(room, 2 * room);
  set.add(constraint_of(axis, force / led));
  for (const PlannedAxis& limit : limits) {
    // The axis's own range goes with the direction that it is looked at in.
    if (!limit[solver::Quantity::acceleration] || &limit == &axis) continue;
    solver::AxisConstraint constraint = constraint_of(limit, 0.0);
    constraint.driver.reset();
    constraint.acceleration = limit[solver::Quantity::acceleration];
    set.add(constraint);
  }
  std::vector<Pressed> result;
  for (const Look& look : looks) {
    const solver::AxisAnalysis one = usable(look.analysis);
    if (!std::isfinite(one.effective_mass)) continue;
    // Ranges need not be symmetric: what lies ahead may as well lie behind.
    for (const double side : both_ways ? std::vector{1.0, -1.0} : std::vector{1.0}) {
      solver::AxisConstraint& pushing = set[0];
      pushing = look.constraint;
      pushing.level = axis.level;
      pushing.driver->target = force / led;
      pushing.acceleration = axis[solver::Quantity::acceleration];
      if (side < 0.0) {
        if (pushing.measure != solver::Measure::direction) continue;
        for (double& coefficient : pushing.coefficients) coefficient = -coefficient;
      }
      const solver::State& state = *look.state;
      const bool is_solved =
          set.fill(robot_.model, state) && set.rows().size() <= static_cast<std::size_t>(most_rows) &&
          pay(set.rows().size(), 10.0) && solver_.solve(state, set.rows(), solution_) == solver::Status::ok;
      if (is_solved)
        result.push_back({std::copysign(led * one.effective_mass, force) * along(set.rows()[0], solution_),
                          one.largest_force, led * one.effective_mass});
    }
  }
  return result;
}

std::vector<Pressed> Probe::pressed(const PlannedAxis& axis, double force,
                                    const std::vector<PlannedAxis>& limits) {
  const Looks* looks = this->looks(axis);
  return looks != nullptr ? pressed_in(looks->all, axis.is_open(), axis, force, limits)
                          : std::vector<Pressed>();
}

std::vector<Pressed> Probe::pressed_whatever_way(const PlannedAxis& axis, double force,
                                                 const std::vector<PlannedAxis>& limits) {
  std::vector<Look> looks;
  return look_around(axis, states_[0], looks) ? pressed_in(looks, true, axis, force, limits)
                                              : std::vector<Pressed>();
}

}  // namespace zwang::lang
