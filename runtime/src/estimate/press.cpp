#include "estimate/press.hpp"

namespace zwang::runtime {

namespace {

bool presses(const solver::Row& row, const solver::RowSolution& found) {
  const bool is_given =
      row.kind == solver::RowKind::force || (row.kind == solver::RowKind::driver && found.saturated);
  return is_given && found.nu != 0.0;
}

}  // namespace

Press::Press(const solver::Model& model)
    : motions_(model),
      B_(Eigen::VectorXd::Zero(motions_.joint.cols())),
      p_(B_),
      torque_(Eigen::VectorXd::Zero(model.joint_count())) {}

const Eigen::VectorXd& Press::look(const solver::Solver& solver, std::span<const solver::RowSet> sets,
                                   const solver::Solution& solution) noexcept {
  bool any = false;
  p_.setZero();
  std::size_t i = 0;
  for (const solver::RowSet& set : sets) {
    for (const solver::Row& row : *set.rows) {
      const solver::RowSolution& found = solution.rows[i];
      if (presses(row, found)) {
        any = true;
        solver.force_on_motions(static_cast<int>(i), B_);
        p_.head(solution.mobility) += set.share * found.nu * B_.head(solution.mobility);
      }
      ++i;
    }
  }
  torque_.setZero();
  if (!any) return torque_;
  solver.free_motions(motions_);
  for (Eigen::Index j = 0; j < torque_.size(); ++j) {
    const auto T = motions_.joint.row(j).head(motions_.count);
    const double square = T.squaredNorm();
    if (square > 0.0) torque_(j) = T.dot(p_.head(motions_.count)) / square;
  }
  return torque_;
}

}  // namespace zwang::runtime
