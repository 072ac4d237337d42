#include "zwang/solver/popov_vereshchagin.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/pivoted_cholesky.hpp"
#include "base/whitened_rows.hpp"
#include "constraint/add_rows.hpp"
#include "input_check.hpp"
#include "linear/pairs.hpp"
#include "sweep/sweeps.hpp"

namespace zwang::solver {

ConstrainedMotion::ConstrainedMotion(const Model& model, int row_capacity)
    : qdd(Eigen::VectorXd::Zero(model.joint_count())),
      acceleration(static_cast<std::size_t>(model.body_count())),
      tau_control(Eigen::VectorXd::Zero(model.joint_count())),
      constraint_torque(Eigen::VectorXd::Zero(model.joint_count())) {
  if (row_capacity < 1) throw std::invalid_argument("constrained motion: row_capacity must be at least 1");
  nu.setZero(row_capacity);
  residual.setZero(row_capacity);
}

namespace {

bool fits(const ConstrainedMotion& result, const Model& model) {
  return result.qdd.size() == model.joint_count() && result.tau_control.size() == model.joint_count() &&
         result.constraint_torque.size() == model.joint_count() &&
         result.acceleration.size() == static_cast<std::size_t>(model.body_count());
}

}  // namespace

/// Lines of W of an arm of up to seven joints, with the zeros behind them.
constexpr int short_line = spaced(7);

struct PopovVereshchagin::Workspace {
  Workspace(const Model& robot, const Settings& options)
      : model(robot),
        settings(options),
        ground_rows(robot),
        ground(ground_rows.row_count()),
        sweeps(robot, ground, options.row_capacity),
        whitened(sweeps.robot_rows, sweeps.task_rows, least_shares(robot)),
        given(options.row_capacity),
        ground_bias(Eigen::VectorXd::Zero(ground)),
        wanted(Eigen::VectorXd::Zero(options.row_capacity)),
        nu(Eigen::VectorXd::Zero(options.row_capacity)),
        p(Eigen::VectorXd::Zero(sweeps.task_rows.dimensions() + 1)),
        motion(Eigen::VectorXd::Zero(sweeps.task_rows.dimensions() + 1)),
        qdd(Eigen::VectorXd::Zero(robot.joint_count())),
        wrenches(static_cast<std::size_t>(robot.body_count()), Vector6::Zero()) {}

  void add_rows(const std::vector<AccelerationRow>& rows) noexcept {
    if (!sweeps.is_articulated) add_ground_rows(ground_rows, sweeps);
    find_ground_bias(ground_rows, sweeps, ground_bias);
    sweeps.task_rows.clear();
    for (const AccelerationRow& row : rows) wanted(add_row(row, model, sweeps)) = row.b;
  }

  /// nu = L^-1 (b - g), line 21: the ground's rows are held, the given ones then met as well as that leaves.
  /// The rank is that of L, damped or not.
  void solve_base() noexcept {
    const int m = sweeps.task_rows.rows();
    whitened.hold_ground(sweeps.free_motion, ground_bias);
    for (int i = 0; i < m; ++i) wanted(i) -= whitened.acceleration(i);
    factorise_given(0.0);
    rank = sweeps.task_rows.held_dimensions() + whitened.ground_rank() + given.rank();
    if (settings.damping > 0.0) factorise_given(settings.damping * settings.damping);
    given.solve(wanted.data(), nu.data());
    whitened.add_up(nu.data(), p.data());
    whitened.motion(p.data(), motion);
  }

  /// B B'
  template <class Product>
  void form_L(Product product) noexcept {
    const int count = sweeps.task_rows.rows();
    for (int i = 0; i < count; ++i) {
      const double* const B = whitened.B(i);
      double* const line = &given.L(i, 0);
      for (int k = 0; k <= i; ++k) line[k] = product(B, whitened.B(k));
    }
  }

  /// L of the given rows where the ground is held.
  void factorise_given(double damping) noexcept {
    const bool is_held = whitened.mobility() < sweeps.task_rows.dimensions();
    given.resize(sweeps.task_rows.rows());
    if (ground == 0 && sweeps.task_rows.W.cols() == short_line) {
      form_L([](const double* one, const double* other) { return dot<short_line>(one, other); });
    } else {
      const int r = (whitened.mobility() + 1) & ~1;  // lines have a 0 to spare
      form_L([r](const double* one, const double* other) { return dot(r, one, other); });
    }
    for (int i = 0; i < sweeps.task_rows.rows(); ++i) {
      given.size(i) = (is_held ? whitened.free_square(i) : given.L(i, i)) + damping;
      given.L(i, i) += damping;
    }
    given.factorise(LeastShares{}.of_ground);
  }

  /// J'A nu: every row's wrench carried rigidly inward to each joint. In the base's coordinates that is a
  /// sum.
  void carry_wrenches(ConstrainedMotion& result) noexcept {
    for (Vector6& wrench : wrenches) wrench.setZero();
    sweeps.task_rows.add_wrenches(nu, wrenches);
    Vector6 carried = Vector6::Zero();  // of the body before, to the next one where that is its parent
    for (std::size_t i = wrenches.size() - 1; i > 0; --i) {
      carried += wrenches[i];
      result.tau_control(static_cast<Eigen::Index>(i) - 1) += sweeps.bodies[i].S.dot(carried);
      const auto parent = static_cast<std::size_t>(model.bodies()[i].parent);
      if (parent + 1 == i) continue;
      wrenches[parent] += carried;
      carried.setZero();
    }
    carried += wrenches.front();
    result.base_wrench = {carried.head<3>(), carried.tail<3>()};
  }

  Status solve(const State& state, const std::vector<AccelerationRow>& rows, const Vector6& base_acceleration,
               const Vector3& gravity, ConstrainedMotion& result) noexcept;

  Model model;
  Settings settings;
  Ground ground_rows;
  int ground;
  int rank = 0;
  Sweeps sweeps;
  WhitenedRows whitened;
  PivotedCholesky given;
  Eigen::VectorXd ground_bias;  ///< by row of the ground
  Eigen::VectorXd wanted, nu;   ///< by given row: b less what comes anyway, and the multipliers
  Eigen::VectorXd p;            ///< force of the given rows on the motions that the ground leaves
  Eigen::VectorXd motion;       ///< by dimension of the sweeps
  Eigen::VectorXd qdd;
  std::vector<Vector6, Eigen::aligned_allocator<Vector6>> wrenches;
};

Status PopovVereshchagin::Workspace::solve(const State& state, const std::vector<AccelerationRow>& rows,
                                           const Vector6& base_acceleration, const Vector3& gravity,
                                           ConstrainedMotion& result) noexcept {
  if (!fits(state, model) || !fits(result, model)) return Status::wrong_size;
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (count > settings.row_capacity || count > result.nu.size() || count > result.residual.size()) {
    return Status::capacity_exceeded;
  }
  if (!is_finite(state) || !base_acceleration.allFinite()) return Status::invalid_input;
  for (const AccelerationRow& row : rows) {
    if (!is_body(row.body, model) || (row.reference_body != -1 && !is_body(row.reference_body, model))) {
      return Status::wrong_size;
    }
    if (!has_finite_axis(row) || !std::isfinite(row.b)) return Status::invalid_input;
  }

  outward_kinematics(model, state, base_acceleration, sweeps);
  load_bodies(model, state, gravity, sweeps);
  add_rows(rows);
  const bool ground_stays = sweeps.is_articulated;
  if (!sweep_inward(model, state.tau_ff, sweeps)) return Status::degenerate_model;
  if (!ground_stays) whitened.factorise(sweeps.robot_rows, ground);
  sweeps.task_rows.find_drift(sweeps.bodies);
  whitened.project_task();
  solve_base();
  outward_accelerations(model, motion, sweeps, qdd);
  const int row_count = static_cast<int>(count);
  if (finite_sum(qdd) + finite_sum(nu.data(), rows.size()) != 0.0) return Status::degenerate_model;

  copy(model.joint_count(), qdd.data(), result.qdd.data());
  copy(row_count, nu.data(), result.nu.data());
  result.rank = rank;
  const std::size_t bodies = sweeps.bodies.size();
  for (std::size_t i = 0; i < bodies; ++i) {
    need_axes(model, i, sweeps);
    sweeps.bodies[i].from_base(sweeps.bodies[i].a, result.acceleration[i]);
  }
  for (int i = 0; i < row_count; ++i) {
    const AccelerationRow& row = rows[static_cast<std::size_t>(i)];
    double acceleration = dot(row.a, result.acceleration[static_cast<std::size_t>(row.body)]);
    if (row.reference_body >= 0) {
      acceleration -= dot(row.a_reference, result.acceleration[static_cast<std::size_t>(row.reference_body)]);
    }
    result.residual(i) = acceleration - row.b;
  }
  for (std::size_t i = 1; i < bodies; ++i) {
    const int k = sweeps.task_rows.dimension_of(i);
    result.constraint_torque(static_cast<Eigen::Index>(i) - 1) =
        sweeps.bodies[i].root_D * (motion(k) - sweeps.free_motion(k));
  }
  copy(model.joint_count(), state.tau_ff.data(), result.tau_control.data());
  carry_wrenches(result);
  return Status::ok;
}

PopovVereshchagin::PopovVereshchagin(const Model& model, const Settings& settings) {
  if (settings.row_capacity < 1) throw std::invalid_argument("solver: row_capacity must be at least 1");
  if (!(settings.damping >= 0.0) || !std::isfinite(settings.damping)) {
    throw std::invalid_argument("solver: damping must be a number of at least 0");
  }
  workspace_ = std::make_unique<Workspace>(model, settings);
}

PopovVereshchagin::~PopovVereshchagin() = default;
PopovVereshchagin::PopovVereshchagin(PopovVereshchagin&&) noexcept = default;
PopovVereshchagin& PopovVereshchagin::operator=(PopovVereshchagin&&) noexcept = default;

Status PopovVereshchagin::solve(const State& state, const std::vector<AccelerationRow>& rows,
                                ConstrainedMotion& result) noexcept {
  const Vector3 gravity = state.base_pose.rotation.transpose() * workspace_->model.gravity();
  return workspace_->solve(state, rows, Vector6::Zero(), gravity, result);
}

Status PopovVereshchagin::solve(const State& state, const std::vector<AccelerationRow>& rows,
                                const MotionVector& base_acceleration, ConstrainedMotion& result) noexcept {
  if (!workspace_->model.has_fixed_base()) return Status::invalid_input;
  return workspace_->solve(state, rows, base_acceleration.vector(), Vector3::Zero(), result);
}

}  // namespace zwang::solver
