/// Seeded robots, states and rows for the tests of laws.
#pragma once

#include <limits>
#include <stdexcept>
#include <vector>

#include "oracle/dense_dynamics.hpp"
#include "oracle/random_problem.hpp"
#include "zwang/solver/popov_vereshchagin.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::oracle {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

struct LawProblem {
  LawProblem(Robot robot, std::uint64_t seed, double effort = no_limit)
      : random(seed * 104729u + static_cast<std::uint64_t>(robot)),
        model(random_model(robot, random, effort)),
        state(random_state(model, random)) {
    // Only motion that the ground allows is motion of this robot.
    solver::Solver projector(model);
    if (projector.project_velocity(state) != solver::Status::ok) throw std::runtime_error("projection");
  }
  std::vector<solver::Row> rows(const RowOptions& options) { return random_rows(model, options, random); }

  Random random;
  solver::Model model;
  solver::State state;
};

inline std::vector<solver::AccelerationRow> acceleration_rows(const std::vector<solver::Row>& rows) {
  std::vector<solver::AccelerationRow> out;
  for (const solver::Row& row : rows) {
    out.push_back({row.body, row.a, row.reference_body, row.a_reference, row.b});
  }
  return out;
}

/// The oracle's generalised acceleration: the base's, none on a fixed base, then the joints'.
inline Vector generalised(const solver::Model& model, const std::vector<solver::MotionVector>& acceleration,
                          const Eigen::VectorXd& qdd) {
  const Eigen::Index base = model.has_fixed_base() ? 0 : 6;
  Vector x(base + qdd.size());
  if (base > 0) x.head(6) = acceleration.front().vector().cast<Real>();
  x.tail(qdd.size()) = qdd.cast<Real>();
  return x;
}

/// Largest difference, relative to one plus the largest entry.
inline double relative_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  if (a.size() == 0) return 0.0;
  return (a - b).cwiseAbs().maxCoeff() / (1.0 + b.cwiseAbs().maxCoeff());
}

}  // namespace zwang::oracle
