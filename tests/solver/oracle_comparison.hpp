/// The solver beside the oracle on one problem.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "oracle/lexicographic.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::oracle {

/// Largest differences, relative to one plus the largest entry of the kind.
struct Difference {
  double tau = 0.0;
  double qdd = 0.0;
  double bodies = 0.0;  ///< spatial accelerations
  double phi = 0.0;
  double nu = 0.0;        ///< where the optimal one is unique
  double shortest = 0.0;  ///< where it is not: the minimum-norm one
  double residual = 0.0;
  bool same_mobility = true;

  double worst() const { return std::max({tau, qdd, bodies, phi, nu, shortest, residual}); }
};

inline Difference difference(const solver::Model& model, const std::vector<solver::Row>& rows,
                             const solver::Solution& got, const OracleSolution& want) {
  const auto real = [](Real x) { return static_cast<double>(x); };
  const auto far = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    if (a.size() == 0) return 0.0;
    const double worst = (a - b).cwiseAbs().maxCoeff() / (1.0 + b.cwiseAbs().maxCoeff());
    return std::isfinite(worst) ? worst : std::numeric_limits<double>::infinity();
  };
  Difference d;
  const Eigen::Index joints = model.joint_count();
  d.tau = far(got.tau, want.tau.cast<double>());
  d.qdd = far(got.qdd, want.vdot.tail(joints).cast<double>());
  for (std::size_t k = model.has_fixed_base() ? 1 : 0; k < want.spatial_acceleration.size(); ++k) {
    d.bodies =
        std::max(d.bodies, far(got.acceleration[k].vector(), want.spatial_acceleration[k].cast<double>()));
  }
  int lowest = 0;
  for (const solver::Row& row : rows) lowest = std::max(lowest, row.level);
  double largest_nu = 0.0;
  double largest_residual = 0.0;
  for (const OracleRow& row : want.rows) {
    largest_nu = std::max(largest_nu, std::abs(real(row.nu)));
    largest_residual = std::max(largest_residual, std::abs(real(row.residual)));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const OracleRow& w = want.rows[i];
    const solver::RowSolution& g = got.rows[i];
    if (rows[i].kind == solver::RowKind::sum) {
      d.nu = std::max(d.nu, std::abs(g.nu - real(w.nu)) / (1.0 + largest_nu));
      continue;
    }
    if (rows[i].kind == solver::RowKind::force) {
      d.phi = std::max(d.phi, std::abs(g.phi - real(w.phi)));
      d.nu = std::max(d.nu, std::abs(g.nu - real(w.nu)) / (1.0 + largest_nu));
      continue;
    }
    // A one-sided row's force is that of the last level it was posed at; the oracle tells that of its own.
    const bool posed_again = rows[i].kind != solver::RowKind::driver && rows[i].level < lowest;
    double ignored = 0.0;
    double& nu = posed_again ? ignored : w.unique ? d.nu : d.shortest;
    nu = std::max(nu, std::abs(g.nu - real(w.nu)) / (1.0 + largest_nu));
    double residual = real(w.residual);
    if (rows[i].kind == solver::RowKind::upper) residual = std::max(residual, 0.0);
    if (rows[i].kind == solver::RowKind::lower) residual = std::min(residual, 0.0);
    d.residual = std::max(d.residual, std::abs(g.residual - residual) / (1.0 + largest_residual));
  }
  d.same_mobility = got.mobility == want.mobility;
  return d;
}

}  // namespace zwang::oracle
