#include "physics/probe.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "diagnostic/wordings_physics.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::lang {

namespace {

constexpr std::size_t most_configurations = 4;  // besides the start pose
constexpr std::size_t most_axes = 400;
constexpr int most_rows = 64;

/// In [0, 1), the same on every machine: the standard fixes the generator, not its distributions.
double uniform(std::mt19937& generator) {
  return static_cast<double>(generator()) / 4294967296.0;
}

bool is_wheel(const solver::Model& model, int joint) {
  return std::any_of(model.wheels().begin(), model.wheels().end(),
                     [&](const solver::Wheel& wheel) { return wheel.body == joint + 1; });
}

/// Joints anywhere within their limits (half a turn where they have none), any heading.
solver::State general_state(const solver::Model& model, std::mt19937& generator) {
  solver::State state(model);
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    const double low = std::isfinite(joint.lower) ? joint.lower : -std::numbers::pi;
    const double high = std::isfinite(joint.upper) ? joint.upper : std::numbers::pi;
    state.q(j) = low + (high - low) * uniform(generator);
  }
  if (!model.has_fixed_base()) {
    const double yaw = std::numbers::pi * (2.0 * uniform(generator) - 1.0);
    state.base_pose.rotation = solver::rotation_from_rpy(0.0, 0.0, yaw);
  }
  return state;
}

/// A force driver along the axis, and nothing else.
solver::AxisConstraint constraint_of(const PlannedAxis& axis, double force) {
  solver::AxisConstraint constraint;
  constraint.move = axis.move;
  constraint.in = axis.in;
  constraint.axis = axis.axis;
  constraint.level = axis.level;
  constraint.driver = solver::Driver{.quantity = solver::Quantity::force, .target = force};
  return constraint;
}

/// The motors have a force along the axis and make it alone: what only moves along with a turn is not pushed.
bool is_pushed(const solver::AxisAnalysis& axis) {
  return axis.reachable && axis.largest_force > 0.0;
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

Probe::Probe(const Robot& robot, const std::optional<Scene>& scene)
    : robot_(robot),
      solver_(robot.model, {.row_capacity = most_rows}),
      solution_(robot.model, most_rows),
      equalities_(robot.model, {.row_capacity = most_rows}),
      motion_(robot.model, most_rows) {
  const solver::Model& model = robot.model;
  bool has_free_joints = false;
  for (int j = 0; j < model.joint_count(); ++j) has_free_joints = has_free_joints || !is_wheel(model, j);
  states_.push_back(start_state(robot, scene));
  std::mt19937 generator(20211);
  while (general_.size() < most_configurations) general_.push_back(general_state(model, generator));
  for (std::size_t i = 0; has_free_joints && i < general_.size(); ++i) {
    states_.push_back(general_[i]);
    states_.back().base_pose = states_.front().base_pose;
  }
  for (const solver::State& state : states_) {
    const solver::BaseAnalysis base = solver::analyse_base(model, state);
    base_mobility_ = std::max(base_mobility_, base.base_mobility);
    mobility_ = std::max(mobility_, base.mobility);
  }
}

std::string Probe::frame_ahead() const {
  if (base_mobility_ != 2) return "";
  double ahead = 0.0;
  for (const solver::Vector3& corner : robot_.footprint) ahead = std::max(ahead, corner.x());
  const std::string at = wording::figure(ahead > 0.05 ? ahead : 0.3, "m");
  return "`nose: {parent: " + robot_.base_frame + ", at: [" + at + ", 0 m]}`";
}

solver::Vector3 Probe::direction(const PlannedAxis& axis) const {
  const solver::Pose in = solver::motion_of(axis.in, robot_.model, states_[0]).pose;
  return in.rotation.col(static_cast<int>(axis.axis) % 3);
}

bool Probe::is_out_of_plane(const PlannedAxis& axis) const {
  const bool is_on_base = axis.move.body == 0 && robot_.model.base_type() == solver::BaseType::ground;
  const double up = std::abs(direction(axis).z());
  return is_on_base && (axis.turns() ? up < 1e-6 : up > 1.0 - 1e-6);
}

/// A row along the axis depends on the point that moves (unless it turns) and on where the axes point.
Probe::Key Probe::key_of(const PlannedAxis& axis) {
  Key key{};
  std::size_t n = 0;
  const auto put = [&](const auto& numbers) {
    for (const double number : numbers.reshaped()) key[n++] = std::round(number * 1e9) * 1e-9 + 0.0;
  };
  put(axis.move.pose.rotation);
  put(axis.turns() ? solver::Vector3::Zero().eval() : axis.move.pose.position);
  put(axis.in.pose.rotation);
  key[n++] = axis.move.body;
  key[n++] = axis.in.body;
  key[n++] = static_cast<double>(axis.axis);
  return key;
}

solver::Row Probe::row_along(const PlannedAxis& axis, const solver::State& state) {
  solver::ConstraintSet set(1, 1);
  set.add(constraint_of(axis, 1.0));
  set.fill(robot_.model, state);
  return set.rows().at(0);
}

const AxisFigures* Probe::figures(const PlannedAxis& axis) {
  const auto [entry, is_new] = figures_.try_emplace(key_of(axis));
  AxisFigures& result = entry->second;
  if (!is_new) return &result;
  if (figures_.size() > most_axes) {
    figures_.erase(entry);
    return nullptr;
  }
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const solver::AxisAnalysis one =
        solver::analyse_axis(robot_.model, states_[i], axis.move, axis.in, axis.axis);
    if (i == 0) {
      result.mass = result.least_mass = result.most_mass = one.effective_mass;
      result.force = result.least_force = result.most_force = one.largest_force;
    }
    result.is_reachable = result.is_reachable || is_pushed(one);
    result.masses.push_back(one.effective_mass);
    result.forces.push_back(one.largest_force);
    if (!std::isfinite(one.effective_mass)) continue;
    result.is_held = false;
    const bool is_first = !std::isfinite(result.most_mass);
    result.least_mass = std::min(result.least_mass, one.effective_mass);
    result.most_mass = is_first ? one.effective_mass : std::max(result.most_mass, one.effective_mass);
    result.least_force = is_first ? one.largest_force : std::min(result.least_force, one.largest_force);
    result.most_force = std::max(result.most_force, one.largest_force);
  }
  for (std::size_t i = 0; axis.in_world && !result.is_reachable && i < general_.size(); ++i) {
    const solver::AxisAnalysis one =
        solver::analyse_axis(robot_.model, general_[i], axis.move, axis.in, axis.axis);
    result.is_reachable = is_pushed(one);
    result.is_held = result.is_held && !std::isfinite(one.effective_mass);
  }
  return &result;
}

/// That of [ground; rows], less that of the ground alone.
int Probe::rank_at(const std::vector<const PlannedAxis*>& axes, const solver::State& state) {
  std::vector<solver::AccelerationRow> rows;
  if (equalities_.solve(state, rows, motion_) != solver::Status::ok) return 0;
  const int ground = motion_.rank;
  for (const PlannedAxis* axis : axes) {
    const solver::Row row = row_along(*axis, state);
    rows.push_back({row.body, row.a, row.reference_body, row.a_reference, 0.0});
  }
  if (equalities_.solve(state, rows, motion_) != solver::Status::ok) return 0;
  return motion_.rank - ground;
}

int Probe::rank(const std::vector<const PlannedAxis*>& axes) {
  if (axes.size() > static_cast<std::size_t>(most_rows)) return static_cast<int>(axes.size());
  int rank = 0;
  for (std::size_t i = 0; i < general_.size() && rank < static_cast<int>(axes.size()); ++i) {
    rank = std::max(rank, rank_at(axes, general_[i]));
  }
  return rank;
}

int Probe::kinematic_rank(const std::vector<const PlannedAxis*>& axes) {
  const solver::State& state = general_[0];
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(6 * robot_.model.body_count(), static_cast<int>(axes.size()));
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const solver::Row row = row_along(*axes[i], state);
    const auto column = static_cast<int>(i);
    rows.block<3, 1>(6 * row.body, column) = row.a.angular;
    rows.block<3, 1>(6 * row.body + 3, column) = row.a.linear;
    if (row.reference_body < 0) continue;
    rows.block<3, 1>(6 * row.reference_body, column) = -row.a_reference.angular;
    rows.block<3, 1>(6 * row.reference_body + 3, column) = -row.a_reference.linear;
  }
  if (robot_.model.base_type() == solver::BaseType::ground) {
    // Of the base only rz, x and y are coordinates.
    rows.topRows<2>().setZero();
    rows.row(5).setZero();
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
  qr.setThreshold(1e-9);
  return static_cast<int>(qr.rank());
}

/// The robot does what the rows say, as if nothing were in its way. Blocked, it meets the force that takes
/// the acceleration along the axis away again: effective mass times that acceleration.
std::vector<double> Probe::pressed(const PlannedAxis& axis, double force,
                                   const std::vector<PlannedAxis>& limits) {
  const AxisFigures* figures = this->figures(axis);
  if (figures == nullptr) return {};
  const auto room = static_cast<int>(limits.size()) + 1;
  solver::ConstraintSet set(room, 2 * room);
  set.add(constraint_of(axis, force));
  for (const PlannedAxis& limit : limits) {
    if (!limit[solver::Quantity::acceleration]) continue;
    solver::AxisConstraint constraint = constraint_of(limit, 0.0);
    constraint.driver.reset();
    constraint.acceleration = limit[solver::Quantity::acceleration];
    set.add(constraint);
  }
  std::vector<double> result;
  for (std::size_t i = 0; i < figures->masses.size(); ++i) {
    const bool is_solved = set.fill(robot_.model, states_[i]) &&
                           set.rows().size() <= static_cast<std::size_t>(most_rows) &&
                           solver_.solve(states_[i], set.rows(), solution_) == solver::Status::ok;
    const double mass = figures->masses[i];
    if (is_solved && std::isfinite(mass)) result.push_back(mass * along(set.rows()[0], solution_));
  }
  return result;
}

}  // namespace zwang::lang
