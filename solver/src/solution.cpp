// The words for what a solution says, and its room.
#include <stdexcept>

#include "zwang/solver/solver.hpp"

namespace zwang::solver {

const char* to_string(Status status) noexcept {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::invalid_input:
      return "invalid input";
    case Status::wrong_size:
      return "wrong size";
    case Status::capacity_exceeded:
      return "capacity exceeded";
    case Status::iteration_limit:
      return "iteration limit";
    case Status::degenerate_model:
      return "degenerate model";
  }
  return "unknown";
}

const char* to_string(RowStatus status) noexcept {
  switch (status) {
    case RowStatus::held:
      return "held";
    case RowStatus::force_limited:
      return "force limited";
    case RowStatus::torque_limited:
      return "torque limited";
    case RowStatus::unreachable:
      return "unreachable";
    case RowStatus::blocked:
      return "blocked";
    case RowStatus::conflict:
      return "conflict";
  }
  return "unknown";
}

Solution::Solution(const Model& model, int row_capacity)
    : tau(Eigen::VectorXd::Zero(model.joint_count())),
      qdd(Eigen::VectorXd::Zero(model.joint_count())),
      acceleration(static_cast<std::size_t>(model.body_count())) {
  if (row_capacity < 1) throw std::invalid_argument("solution: row_capacity must be at least 1");
  rows.reserve(static_cast<std::size_t>(row_capacity));
}

FreeMotions::FreeMotions(const Model& model)
    : joint(Eigen::MatrixXd::Zero(model.joint_count(), model.joint_count() + 6)),
      base(Eigen::MatrixXd::Zero(3, model.joint_count() + 6)) {}

}  // namespace zwang::solver
