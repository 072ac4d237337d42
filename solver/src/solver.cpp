#include "zwang/solver/solver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/bounded_problem.hpp"
#include "base/whitened_rows.hpp"
#include "constraint/add_rows.hpp"
#include "input_check.hpp"
#include "row_axes.hpp"
#include "sweep/sweeps.hpp"

namespace zwang::solver {

namespace {

/// Rows on the base's own freedoms.
int base_freedoms(const Model& model, bool wanted) {
  if (!wanted || model.base_type() == BaseType::fixed) return 0;
  return model.base_type() == BaseType::floating ? 6 : 3;
}

/// A unit force along a freedom of the base: on the ground rz, x, y, else all six.
Vector6 base_freedom(const Model& model, int index) {
  return Vector6::Unit(model.base_type() == BaseType::ground ? index + 2 : index);
}

int set_capacity(const Settings& settings) {
  return settings.set_capacity > 0 ? settings.set_capacity : settings.row_capacity;
}

/// a . Xdd - b of a row that the motion leaves `beyond` b; of a one-sided row only where it violates b.
double residual_of(RowKind kind, double beyond) {
  switch (kind) {
    case RowKind::driver:
      return beyond;
    case RowKind::upper:
      return std::max(beyond, 0.0);
    case RowKind::lower:
      return std::min(beyond, 0.0);
    case RowKind::force:
    case RowKind::sum:
      break;
  }
  return 0.0;
}

}  // namespace

/// The robot's own rows have ids in the order ground, base freedoms, joints; rows of the task along the same
/// axis share one.
struct Solver::Workspace {
  Workspace(const Model& robot, const Settings& options)
      : model(robot),
        settings(options),
        ground_rows(robot),
        ground(ground_rows.row_count()),
        base(base_freedoms(robot, options.base_motion)),
        sweeps(robot, ground + base + robot.joint_count(), options.row_capacity),
        whitened(sweeps.robot_rows, sweeps.task_rows, least_shares(robot)),
        problem(set_capacity(options), robot.joint_count(),
                std::max(1, sweeps.task_rows.dimensions() - sweeps.task_rows.held_dimensions())),
        ground_bias(Eigen::VectorXd::Zero(ground)),
        free_acceleration(Eigen::VectorXd::Zero(options.row_capacity)),
        motion(Eigen::VectorXd::Zero(sweeps.task_rows.dimensions() + 1)),
        p(Eigen::VectorXd::Zero(motion.size())),
        tau(Eigen::VectorXd::Zero(robot.joint_count())),
        tau_ff(Eigen::VectorXd::Zero(robot.joint_count())),
        qdd(Eigen::VectorXd::Zero(robot.joint_count())) {
    const auto capacity = static_cast<std::size_t>(options.row_capacity);
    rows.reserve(capacity);
    row_solutions.reserve(capacity);
    for (std::vector<int>* by_row : {&ids, &twins, &axes, &first_here}) by_row->resize(capacity);
    keys.resize(capacity);
    for (int j = 0; j < robot.joint_count(); ++j) {
      if (robot.joint(j).actuated) motors.push_back(j);
    }
  }

  const BodySweep& body_sweep(int i) const { return sweeps.bodies[static_cast<std::size_t>(i)]; }
  Vector3 gravity(const State& state) const { return state.base_pose.rotation.transpose() * model.gravity(); }
  int first_base_row() const { return ground; }
  int first_joint_row() const { return ground + base; }

  /// They stay while the joints do.
  void add_robot_rows() noexcept {
    if (sweeps.is_articulated) return;
    add_ground_rows(ground_rows, sweeps);
    for (int i = 0; i < base; ++i) {
      sweeps.robot_rows.add_row(0);
      sweeps.robot_rows.last_column() = base_freedom(model, i);
    }
    for (int j = 0; j < model.joint_count(); ++j) sweeps.robot_rows.add_joint_row(j);
  }

  bool fit(std::span<const RowSet> sets) const noexcept {
    std::size_t all = 0;
    for (const RowSet& set : sets) {
      const std::size_t count = set.rows->size();
      if (count > static_cast<std::size_t>(set_capacity(settings))) return false;
      all += count;
    }
    return all <= rows.capacity();
  }

  /// The rows of all sets, one after the other, and which of them share an axis. Not ok where one is not what
  /// a row has to be.
  Status take_rows(std::span<const RowSet> sets) noexcept {
    axis_count = 0;
    rows.clear();
    for (const RowSet& set : sets) {
      const Row* before = nullptr;
      for (const Row& row : *set.rows) {
        if (!has_valid_numbers(row)) return Status::invalid_input;
        const std::size_t i = rows.size();
        rows.push_back(&row);
        if (before != nullptr && is_of_same_constraint(row, *before)) {  // as the other end of a range is
          twins[i] = twins[i - 1] < 0 ? static_cast<int>(i) - 1 : twins[i - 1];
        } else if (const Status status = find_axis(i); status != Status::ok) {
          return status;
        }
        before = &row;
      }
    }
    return Status::ok;
  }

  Status find_axis(std::size_t i) noexcept {
    const Row& row = *rows[i];
    if (!is_body(row.body, model) || (row.reference_body != -1 && !is_body(row.reference_body, model)))
      return Status::wrong_size;
    const double key = key_of(row);
    twins[i] = twin_of(row, key);
    if (twins[i] >= 0) return Status::ok;
    if (!has_finite_axis(row)) return Status::invalid_input;
    first_here[i] = -1;
    keys[axis_count] = key;
    axes[axis_count++] = static_cast<int>(i);
    return Status::ok;
  }

  void add_task_rows() noexcept {
    sweeps.task_rows.clear();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const int twin = twins[i];
      ids[i] = twin < 0 ? add_row(*rows[i], model, sweeps) : ids[static_cast<std::size_t>(twin)];
    }
  }

  /// The first row that acts along the same axis, as ranges of several tasks do; -1 for none. Mostly it is
  /// along the last one.
  int twin_of(const Row& row, double key) const noexcept {
    for (std::size_t k = axis_count; k-- > 0;) {
      if (keys[k] == key && has_same_axis(row, *rows[static_cast<std::size_t>(axes[k])])) return axes[k];
    }
    return -1;
  }

  /// Feed-forward torque acts as far as the motor can make it.
  void clamp_feed_forward(const State& state) noexcept {
    tau_ff = state.tau_ff;
    for (const int j : motors) {
      tau_ff(j) = std::clamp(tau_ff(j), -model.joint(j).max_effort, model.joint(j).max_effort);
    }
  }

  /// Phase 2, and the ground and the motors, which stay while the joints do.
  bool sweep_and_factorise() noexcept {
    const bool robot_stays = sweeps.is_articulated;
    if (!sweep_inward(model, tau_ff, sweeps)) return false;
    if (robot_stays) return true;
    ++factorisation;
    whitened.factorise(sweeps.robot_rows, ground);
    problem.clear_motors(whitened.mobility());
    for (const int j : motors) problem.add_motor(whitened.robot_B(first_joint_row() + j));
    problem.factorise_motors();
    return true;
  }

  /// Sweeps and factorises the robot at rest, without rows of a task.
  bool sweep_at_rest() noexcept {
    load_bodies_at_rest(sweeps);
    sweeps.task_rows.clear();
    tau_ff.setZero();
    return sweep_and_factorise();
  }

  /// The task's rows and the free motion under what the ground holds.
  void hold_ground() noexcept {
    sweeps.task_rows.find_drift(sweeps.bodies);
    whitened.project_task();
    whitened.hold_ground(sweeps.free_motion, ground_bias);
  }

  /// The `count` rows from `begin` on, those of one set.
  void pose_problem(int begin, int count) noexcept {
    problem.resize(count);
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(begin + i);
      const int axis = twins[at] < 0 ? begin + i : twins[at];
      int& first = first_here[static_cast<std::size_t>(axis)];
      const bool is_of_another_set = first < begin || first >= begin + count;
      if (is_of_another_set) {
        first = begin + i;
        const int id = ids[at];
        const double free = free_acceleration(begin + i) = whitened.acceleration(id);
        problem.set_row(i, *rows[at], rows[at]->b - free, whitened.B(id), whitened.least_square(id));
      } else {
        const double free = free_acceleration(begin + i) = free_acceleration(first);
        problem.set_twin(i, *rows[at], rows[at]->b - free, first - begin);
      }
    }
  }

  void limit_motors() noexcept {
    int motor = 0;
    for (const int j : motors) {
      const double limit = model.joint(j).max_effort;
      problem.limit_motor(motor++, -limit - tau_ff(j), limit - tau_ff(j));
    }
  }

  /// Every set at full strength, the first one last: `opposing` speaks of it. False when one met the cap.
  bool solve_sets(std::span<const RowSet> sets) noexcept {
    limit_motors();
    p.setZero();
    tau.setZero();
    row_solutions.resize(rows.size());
    iterations = 0;
    bool exact = true;
    auto end = static_cast<int>(rows.size());
    for (std::size_t k = sets.size(); k-- > 0;) {
      const auto count = static_cast<int>(sets[k].rows->size());
      end -= count;
      pose_problem(end, count);
      const std::span solutions(row_solutions.data() + end, static_cast<std::size_t>(count));
      exact = problem.solve(settings.max_iterations, solutions) && exact;
      take_share(sets[k].share);
      iterations += problem.iterations();
    }
    if (sets.size() > 1) find_residuals();
    return exact;
  }

  void take_share(double share) noexcept {
    add_multiple(whitened.mobility(), share, problem.p(), p.data());
    int motor = 0;
    for (const int j : motors) tau(j) += share * problem.tau(motor++);
  }

  /// Of the blended motion.
  void find_residuals() noexcept {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double along = dot(whitened.mobility(), whitened.B(ids[i]), p.data());
      const double beyond = along + free_acceleration(static_cast<Eigen::Index>(i)) - rows[i]->b;
      row_solutions[i].residual = residual_of(rows[i]->kind, beyond);
    }
  }

  Model model;
  Settings settings;
  Ground ground_rows;
  int ground, base;
  Sweeps sweeps;
  WhitenedRows whitened;
  BoundedProblem problem;
  std::vector<int> motors;
  std::vector<const Row*> rows;  ///< of all sets
  std::vector<int> ids, twins;   ///< by row of the task: its id in the sweeps, the first row along its axis
  std::vector<int> first_here;   ///< by first row along an axis: the first one of the set that is posed
  std::vector<int> axes;         ///< the first rows along each axis
  std::vector<double> keys;      ///< of these
  std::size_t axis_count = 0;
  Eigen::VectorXd ground_bias;        ///< by row of the ground
  Eigen::VectorXd free_acceleration;  ///< by row of the task: on the ground, without constraint forces
  Eigen::VectorXd motion;             ///< by dimension of the sweeps
  Eigen::VectorXd p, tau;             ///< of all sets, by their shares
  std::vector<RowSolution> row_solutions;
  int iterations = 0;
  Eigen::VectorXd tau_ff, qdd;
  std::uint64_t factorisation = 0;  ///< of the robot: how often it was done
};

Solver::Solver(const Model& model, const Settings& settings) {
  if (settings.row_capacity < 1) throw std::invalid_argument("solver: row_capacity must be at least 1");
  if (settings.max_iterations < 1) throw std::invalid_argument("solver: max_iterations must be at least 1");
  workspace_ = std::make_unique<Workspace>(model, settings);
}

Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

Status Solver::solve(const State& state, const std::vector<Row>& rows, Solution& solution) noexcept {
  const RowSet all{&rows, 1.0};
  return solve(state, std::span(&all, 1), solution);
}

Status Solver::solve(const State& state, std::span<const RowSet> sets, Solution& solution) noexcept {
  Workspace& w = *workspace_;
  if (!fits(state, w.model)) return Status::wrong_size;
  if (solution.tau.size() != w.model.joint_count() || solution.qdd.size() != w.model.joint_count() ||
      solution.acceleration.size() != static_cast<std::size_t>(w.model.body_count())) {
    return Status::wrong_size;
  }
  if (!w.fit(sets)) return Status::capacity_exceeded;
  if (!is_finite(state)) return Status::invalid_input;
  if (const Status status = w.take_rows(sets); status != Status::ok) return status;
  if (w.rows.size() > solution.rows.capacity()) return Status::capacity_exceeded;

  w.clamp_feed_forward(state);
  outward_kinematics(w.model, state, Vector6::Zero(), w.sweeps);
  load_bodies(w.model, state, w.gravity(state), w.sweeps);
  w.add_robot_rows();
  find_ground_bias(w.ground_rows, w.sweeps, w.ground_bias);
  w.add_task_rows();
  if (!w.sweep_and_factorise()) return Status::degenerate_model;
  w.hold_ground();
  const bool exact = w.solve_sets(sets);
  w.whitened.motion(w.p.data(), w.motion);
  outward_accelerations(w.model, w.motion, w.sweeps, w.qdd);
  if (finite_sum(w.qdd) + finite_sum(w.motion) != 0.0) return Status::degenerate_model;

  solution.qdd = w.qdd;
  for (std::size_t i = 0; i < w.sweeps.bodies.size(); ++i) {
    if (!w.settings.every_acceleration && i > 0 && !w.sweeps.task_rows.act_beyond(i)) continue;
    need_axes(w.model, i, w.sweeps);
    w.sweeps.bodies[i].from_base(w.sweeps.bodies[i].a, solution.acceleration[i]);
  }
  solution.tau.setZero();
  for (const int j : w.motors) {
    const double limit = w.model.joint(j).max_effort;  // not even by a rounding beyond
    solution.tau(j) = std::clamp(w.tau_ff(j) + w.tau(j), -limit, limit);
  }
  solution.rows = w.row_solutions;
  solution.mobility = w.whitened.mobility();
  solution.iterations = w.iterations;
  return exact ? Status::ok : Status::iteration_limit;
}

int Solver::opposing(int row, std::span<int> out) const noexcept {
  return workspace_->problem.opposing(row, out);
}

bool Solver::free_motions(FreeMotions& out) const noexcept {
  const Workspace& w = *workspace_;
  if (out.factorisation == w.factorisation) return false;
  out.factorisation = w.factorisation;
  out.count = w.whitened.mobility();
  for (int j = 0; j < w.model.joint_count(); ++j) {
    out.joint.row(j).head(out.count) = w.whitened.robot_motion(w.first_joint_row() + j);
  }
  // From the order rz, x, y on the ground, or rx, ry, rz, x, y, z.
  const bool on_ground = w.model.base_type() == BaseType::ground;
  const int first_linear = on_ground ? 1 : 3, turn = on_ground ? 0 : 2;
  if (w.base < 3) return true;
  out.base.row(0).head(out.count) = w.whitened.robot_motion(w.first_base_row() + first_linear);
  out.base.row(1).head(out.count) = w.whitened.robot_motion(w.first_base_row() + first_linear + 1);
  out.base.row(2).head(out.count) = w.whitened.robot_motion(w.first_base_row() + turn);
  return true;
}

void Solver::force_on_motions(int row, Eigen::VectorXd& p) const noexcept {
  const Workspace& w = *workspace_;
  const int id = w.ids[static_cast<std::size_t>(row)];
  auto B = p.head(w.whitened.mobility());
  B = w.whitened.motion(id);
  if (B.squaredNorm() < w.whitened.least_square(id)) B.setZero();
}

Status Solver::project_velocity(State& state) noexcept {
  Workspace& w = *workspace_;
  if (!fits(state, w.model)) return Status::wrong_size;
  if (!is_finite(state)) return Status::invalid_input;
  if (w.ground == 0 && w.sweeps.task_rows.held_dimensions() == 0) return Status::ok;
  // dv = -M^-1 Jp' (Jp M^-1 Jp')^+ Jp v: the answer of the robot at rest to the multipliers that take Jp v
  // away.
  outward_kinematics(w.model, state, Vector6::Zero(), w.sweeps);
  w.add_robot_rows();
  find_ground_slip(w.ground_rows, w.sweeps, w.ground_bias);
  const Vector6 twist = w.body_sweep(0).v;
  if (!w.sweeps.is_articulated && !w.sweep_at_rest()) return Status::degenerate_model;
  w.whitened.hold_ground_at_rest(w.ground_bias, held_base_force(w.sweeps, -twist));
  w.whitened.motion(nullptr, w.motion);
  outward_accelerations(w.model, w.motion, w.sweeps, w.qdd);
  if (!w.qdd.allFinite()) return Status::degenerate_model;
  state.qd += w.qdd;
  if (w.model.has_fixed_base()) return Status::ok;
  const Vector6& change = w.body_sweep(0).da;
  state.base_twist += {change.head<3>(), change.tail<3>()};
  return Status::ok;
}

}  // namespace zwang::solver
