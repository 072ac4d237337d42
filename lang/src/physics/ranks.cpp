// How many of some axes are independent, and which two are one motion.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "physics/probe.hpp"

namespace zwang::lang {

/// That of [ground; rows], less that of the ground alone. A feature without a direction in this state has no
/// row: it counts as independent.
int Probe::rank_at(const std::vector<const PlannedAxis*>& axes, const solver::State& state) {
  std::vector<solver::AccelerationRow> rows;
  if (equalities_.solve(state, rows, motion_) != solver::Status::ok) return 0;
  const int ground = motion_.rank;
  for (const PlannedAxis* axis : axes) {
    const std::optional<solver::Row> row = row_along(*axis, state);
    if (row) rows.push_back({row->body, row->a, row->reference_body, row->a_reference, 0.0});
  }
  if (equalities_.solve(state, rows, motion_) != solver::Status::ok) return 0;
  const auto without_row = static_cast<int>(axes.size() - rows.size());
  return motion_.rank - ground + without_row;
}

int Probe::rank(const std::vector<const PlannedAxis*>& axes) {
  const bool is_asked = axes.size() <= static_cast<std::size_t>(most_rows) &&
                        pay(axes.size(), 2.0 * static_cast<double>(general_.size()));
  if (!is_asked) return static_cast<int>(axes.size());
  int rank = 0;
  for (std::size_t i = 0; i < general_.size() && rank < static_cast<int>(axes.size()); ++i) {
    rank = std::max(rank, rank_at(axes, general_[i]));
  }
  return rank;
}

int Probe::rank_at_start(const std::vector<const PlannedAxis*>& axes) {
  const bool is_asked = axes.size() <= static_cast<std::size_t>(most_rows) && pay(axes.size(), 2.0);
  return is_asked ? rank_at(axes, states_[0]) : static_cast<int>(axes.size());
}

int Probe::alignment(const PlannedAxis& a, const PlannedAxis& b) {
  const bool is_known = a.is_placed && b.is_placed && !a.is_set && !b.is_set;
  const bool is_named_alike = a.in_name == b.in_name && a.move_name == b.move_name;
  if (a.move.body != b.move.body || (!is_known && !is_named_alike) || !pay(2, 0.1)) return 0;
  // A base on the ground moves in the plane: what a row demands of it otherwise the ground meets.
  const bool is_on_ground = robot_.model.base_type() == solver::BaseType::ground;
  const auto is_close = [&](int body, const solver::ForceVector& m, const solver::ForceVector& n,
                            double sign) {
    solver::Vector3 angular = m.angular - sign * n.angular, linear = m.linear - sign * n.linear;
    if (body == 0 && is_on_ground) {
      angular.head<2>().setZero();
      linear.z() = 0.0;
    }
    return angular.norm() + linear.norm() < 1e-9;
  };
  int sign = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::optional<solver::Row> row = row_along(a, general_[i]), other = row_along(b, general_[i]);
    if (!row || !other || row->body != other->body || row->reference_body != other->reference_body) return 0;
    const auto is_alike = [&](double s) {
      return is_close(row->body, row->a, other->a, s) &&
             (row->reference_body < 0 ||
              is_close(row->reference_body, row->a_reference, other->a_reference, s));
    };
    const int found = is_alike(1.0) ? 1 : is_alike(-1.0) ? -1 : 0;
    if (found == 0 || (i > 0 && found != sign)) return 0;
    sign = found;
  }
  return sign;
}

int Probe::kinematic_rank(const std::vector<const PlannedAxis*>& axes) {
  const auto count = static_cast<double>(axes.size());
  budget_ -= 12.0 * robot_.model.body_count() * count * count;
  if (is_exhausted()) return static_cast<int>(axes.size());
  const solver::State& state = general_[0];
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(6 * robot_.model.body_count(), static_cast<int>(axes.size()));
  int without_row = 0;  // they count as independent
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::optional<solver::Row> row = row_along(*axes[i], state);
    const auto column = static_cast<int>(i);
    without_row += row ? 0 : 1;
    if (!row) continue;
    rows.block<3, 1>(6 * row->body, column) = row->a.angular;
    rows.block<3, 1>(6 * row->body + 3, column) = row->a.linear;
    if (row->reference_body < 0) continue;
    rows.block<3, 1>(6 * row->reference_body, column) = -row->a_reference.angular;
    rows.block<3, 1>(6 * row->reference_body + 3, column) = -row->a_reference.linear;
  }
  if (robot_.model.base_type() == solver::BaseType::ground) {
    // Of the base only rz, x and y are coordinates.
    rows.topRows<2>().setZero();
    rows.row(5).setZero();
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
  qr.setThreshold(1e-9);
  return static_cast<int>(qr.rank()) + without_row;
}

Probe::Angles Probe::angles(const solver::AttachedFrame& a, const solver::Vector3& along_a,
                            const solver::AttachedFrame& b, const solver::Vector3& along_b) const {
  const auto angle_in = [&](const solver::State& state) {
    const auto in_world = [&](const solver::AttachedFrame& frame, const solver::Vector3& along) {
      return solver::Vector3(solver::motion_of(frame, robot_.model, state).pose.rotation * along);
    };
    const solver::Vector3 u = in_world(a, along_a), v = in_world(b, along_b);
    return std::atan2(u.cross(v).norm(), u.dot(v));
  };
  Angles result{angle_in(states_[0]), 0.0};
  result.most = result.at_start;
  for (const solver::State& state : general_) result.most = std::max(result.most, angle_in(state));
  return result;
}

}  // namespace zwang::lang
