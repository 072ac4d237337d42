/// Which joints press, and how hard.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "zwang/solver/constraint.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// The press of the rows whose force nu is given and whose motion follows: force rows, and drivers at their
/// bounds. They are the generalised force
///   p = sum B_i nu_i
/// on the robot's free motions (solver::FreeMotions). p turns joint j as the torque T_j . p / |T_j|^2 of its
/// motor alone would. Where all rows hold their targets, p is 0. Does not allocate, lock, throw or print
/// after construction.
class Press {
 public:
  explicit Press(const solver::Model& model);

  /// By joint [N m] or [N]: of what `solver` has just found for the rows of `sets`.
  const Eigen::VectorXd& look(const solver::Solver& solver, std::span<const solver::RowSet> sets,
                              const solver::Solution& solution) noexcept;

 private:
  solver::FreeMotions motions_;
  Eigen::VectorXd B_, p_, torque_;
};

}  // namespace zwang::runtime
