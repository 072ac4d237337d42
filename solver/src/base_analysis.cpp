#include "zwang/solver/base_analysis.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/whitened_rows.hpp"
#include "constraint/add_rows.hpp"
#include "input_check.hpp"
#include "sweep/sweeps.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::solver {

namespace {

constexpr double rank_tolerance = 1e-6;  // of singular values, relative to the largest
/// The least share that a motor must have of an axis, where motors do not make every motion. A motor may
/// reach the axis only by turning the base about a centre of mass beside it. Its share is then that offset
/// over the radius of gyration, about 0.3 m. No centre of mass is known to 3 mm, so a smaller share counts as
/// none.
constexpr double least_motor_share = 1e-2;

/// One pass of the sweeps over the ground, the freedoms of base and joints, and one row more.
struct WhitenedRobot {
  WhitenedRobot(const Model& model, const State& state, const Row* row)
      : ground_rows(model),
        ground(ground_rows.row_count()),
        base(model.has_fixed_base() ? 0 : 6),
        sweeps(model, ground + base + model.joint_count(), 1),
        rows(sweeps.robot_rows, sweeps.task_rows, least_shares(model)) {
    outward_kinematics(model, state, Vector6::Zero(), sweeps);
    load_bodies_at_rest(sweeps);
    add_ground_rows(ground_rows, sweeps);
    for (int i = 0; i < base; ++i) {
      sweeps.robot_rows.add_row(0);
      sweeps.robot_rows.last_column() = Vector6::Unit(i);
    }
    for (int j = 0; j < model.joint_count(); ++j) sweeps.robot_rows.add_joint_row(j);
    if (row != nullptr) add_row(*row, model, sweeps);
    const Eigen::VectorXd no_torque = Eigen::VectorXd::Zero(model.joint_count());
    if (!sweep_inward(model, no_torque, sweeps)) {
      throw std::invalid_argument("analysis: an inertia of the model cannot be inverted");
    }
    rows.factorise(sweeps.robot_rows, ground);
    rows.project_task();
  }

  Eigen::VectorXd joint(int j) const { return rows.robot_motion(ground + base + j).transpose(); }
  Eigen::VectorXd base_freedom(int i) const { return rows.robot_motion(ground + i).transpose(); }
  double base_free_square(int i) const { return rows.robot_free_square(ground + i); }
  int last_row() const { return sweeps.task_rows.rows() - 1; }

  Ground ground_rows;
  int ground, base;
  Sweeps sweeps;
  WhitenedRows rows;
};

/// The eigenvalues of a symmetric matrix S, by Jacobi's rotations. A rotation turns the axes p and q by an
/// angle with the tangent t and takes S_pq to 0:
///   t^2 + 2 theta t - 1 = 0,   theta = (S_qq - S_pp) / (2 S_pq)
/// Each rotation takes 2 S_pq^2 from the sum of the squares beside the diagonal. Eigen's solver for matrices
/// of any size takes 14 s to compile, the rest of this file 6 s.
Eigen::VectorXd eigenvalues_of(Eigen::MatrixXd S) {
  constexpr int most_sweeps = 50;  // fewer than ten are needed: the last ones square what is left
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    bool is_diagonal = true;
    for (Eigen::Index p = 0; p < S.rows(); ++p) {
      for (Eigen::Index q = p + 1; q < S.rows(); ++q) {
        const double rounding = 1e-17 * (std::abs(S(p, p)) + std::abs(S(q, q)));
        if (std::abs(S(p, q)) <= rounding) continue;
        is_diagonal = false;
        const double theta = (S(q, q) - S(p, p)) / (2.0 * S(p, q));
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
        const double c = 1.0 / std::hypot(t, 1.0), s = t * c;
        for (Eigen::Index k = 0; k < S.rows(); ++k) {  // S := S R
          const double at_p = S(k, p), at_q = S(k, q);
          S(k, p) = c * at_p - s * at_q;
          S(k, q) = s * at_p + c * at_q;
        }
        for (Eigen::Index k = 0; k < S.rows(); ++k) {  // S := R' S
          const double at_p = S(p, k), at_q = S(q, k);
          S(p, k) = c * at_p - s * at_q;
          S(q, k) = s * at_p + c * at_q;
        }
      }
    }
    if (is_diagonal) break;
  }
  return S.diagonal();
}

/// sigma_i^2, the eigenvalues of A'A or AA', whichever is smaller. They are right to 1e-14 of the largest
/// one.
Eigen::VectorXd squared_singular_values(const Eigen::MatrixXd& A) {
  return eigenvalues_of(A.rows() < A.cols() ? A.lazyProduct(A.transpose()).eval()
                                            : A.transpose().lazyProduct(A).eval());
}

int rank_of(const Eigen::MatrixXd& columns) {
  if (columns.size() == 0) return 0;
  const Eigen::VectorXd squares = squared_singular_values(columns);
  const double least = rank_tolerance * rank_tolerance * squares.maxCoeff();
  return static_cast<int>((squares.array() > std::max(least, 0.0)).count());
}

/// Independent planar motions of the base; one counts where the ground leaves more than the smallest share of
/// it.
int base_mobility(const WhitenedRobot& robot) {
  Eigen::MatrixXd planar(robot.rows.mobility(), 3);
  for (int i = 0; i < 3; ++i) {
    const int freedom = 2 + i;  // rz, x and y of the six
    planar.col(i) = robot.base_freedom(freedom) / std::sqrt(robot.base_free_square(freedom));
  }
  if (planar.size() == 0) return 0;
  return static_cast<int>((squared_singular_values(planar).array() > robot.rows.least_share()).count());
}

/// Columns T_j of the actuated joints, each of length 1: a rank should not depend on gears.
Eigen::MatrixXd motor_directions(const Model& model, const WhitenedRobot& robot) {
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(robot.rows.mobility(), model.joint_count());
  int motors = 0;
  for (int j = 0; j < model.joint_count(); ++j) {
    if (!model.joint(j).actuated) continue;
    const Eigen::VectorXd column = robot.joint(j);
    if (column.norm() > 0.0) T.col(motors) = column / column.norm();
    ++motors;
  }
  return T.leftCols(motors);
}

Row row_along(const Model& model, const State& state, const AxisConstraint& constraint) {
  AxisConstraint measured;
  measured.move = constraint.move;
  measured.in = constraint.in;
  measured.measure = constraint.measure;
  measured.axis = constraint.axis;
  measured.other_axis = constraint.other_axis;
  measured.coefficients = constraint.coefficients;
  measured.driver = Driver{.quantity = Quantity::force, .target = 1.0};
  ConstraintSet set(1, 1);
  if (!set.add(measured) || !set.fill(model, state) || set.rows().empty())
    throw std::invalid_argument("analysis: no row for this axis");
  return set.rows().front();
}

/// A force row that asks for more than the motors can make: phi f is what they can.
double largest_force(const Model& model, const State& state, Row row, double effective_mass) {
  double most = 0.0;
  for (int j = 0; j < model.joint_count(); ++j) {
    const Joint& joint = model.joint(j);
    if (joint.actuated && std::isfinite(joint.max_effort)) most += joint.max_effort;
  }
  Solver solver(model, {.row_capacity = 1});
  Solution solution(model, 1);
  // Doubled until the motors give out: what they make no longer follows the wish.
  for (row.force = std::max(1.0, most); row.force < 1e9 * std::max(1.0, effective_mass); row.force *= 2.0) {
    const Status status = solver.solve(state, {row}, solution);
    if (status != Status::ok && status != Status::iteration_limit) return 0.0;
    if (solution.rows[0].phi < 1.0 - 1e-9) return solution.rows[0].nu;
  }
  return infinity;
}

State at_rest(const State& state) {
  State rest = state;
  rest.qd.setZero();
  rest.tau_ff.setZero();
  rest.base_twist = {};
  for (ForceVector& f : rest.f_ext) f = {};
  return rest;
}

}  // namespace

AxisAnalysis analyse_axis(const Model& model, const State& state, const AxisConstraint& constraint) {
  if (!fits(state, model) || !is_finite(state))
    throw std::invalid_argument("analysis: the state does not fit the model");
  const State rest = at_rest(state);
  const Row row = row_along(model, rest, constraint);
  const WhitenedRobot robot(model, rest, &row);
  const Eigen::VectorXd B = robot.rows.motion(robot.last_row()).transpose();
  AxisAnalysis result;
  result.kappa = robot.rows.free_share(robot.last_row());
  const bool is_held = result.kappa <= robot.rows.least_share();
  result.effective_mass = is_held ? infinity : 1.0 / B.squaredNorm();
  if (is_held) return result;
  const Eigen::MatrixXd motors = motor_directions(model, robot);
  const Eigen::VectorXd along = motors.transpose() * B;
  const double least = rank_of(motors) == robot.rows.mobility() ? rank_tolerance : least_motor_share;
  result.reachable = along.size() > 0 && along.lpNorm<Eigen::Infinity>() > least * B.norm();
  if (result.reachable) result.largest_force = largest_force(model, rest, row, result.effective_mass);
  return result;
}

AxisAnalysis analyse_axis(const Model& model, const State& state, const AttachedFrame& move,
                          const AttachedFrame& in, Axis axis) {
  AxisConstraint constraint;
  constraint.move = move;
  constraint.in = in;
  constraint.axis = axis;
  return analyse_axis(model, state, constraint);
}

BaseAnalysis analyse_base(const Model& model, const State& state) {
  if (!fits(state, model) || !is_finite(state))
    throw std::invalid_argument("analysis: the state does not fit the model");
  const State rest = at_rest(state);
  const WhitenedRobot robot(model, rest, nullptr);
  BaseAnalysis result;
  result.mobility = robot.rows.mobility();
  const Eigen::MatrixXd motors = motor_directions(model, robot);
  result.motor_rank = rank_of(motors);
  result.exact = result.motor_rank == result.mobility;
  result.internal_forces = static_cast<int>(motors.cols()) - result.motor_rank;
  result.redundant_ground_rows = robot.ground - robot.rows.ground_rank();

  if (!model.has_fixed_base()) {
    result.base_mobility = base_mobility(robot);
    const AttachedFrame own{0, {}};
    const std::array axes{Axis::x, Axis::y, Axis::rz};
    for (std::size_t k = 0; k < axes.size(); ++k)
      result.axes[k] = analyse_axis(model, rest, own, own, axes[k]);
  }
  const bool rollers = std::any_of(model.wheels().begin(), model.wheels().end(),
                                   [](const Wheel& wheel) { return wheel.roller_angle.has_value(); });
  result.mirrored_rollers = rollers && model.wheels().size() >= 4 && !result.exact;
  result.locked = !model.has_fixed_base() && !model.wheels().empty() && result.base_mobility == 0;
  return result;
}

}  // namespace zwang::solver
