#include "run/limit_table.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

using solver::Quantity;

// A limit counts as met when less than this share of its range is left.
constexpr double at_limit_share = 0.01;

constexpr double one_sided_range = 1.0;  // [m], [m/s], ...: of a limit that has no other side

constexpr std::array quantities = {Quantity::position, Quantity::velocity, Quantity::acceleration,
                                   Quantity::force};
constexpr std::array words = {"position", "velocity", "acceleration", "force"};

bool limits(const lang::AxisStatements& says, Quantity quantity) {
  switch (quantity) {
    case Quantity::position:
      return says.position.has_value();
    case Quantity::velocity:
      return says.velocity.has_value();
    case Quantity::acceleration:
      return says.acceleration.has_value();
    case Quantity::force:
      break;
  }
  return says.force.has_value() || says.driver == Quantity::force;
}

/// The acceleration along a row's axis that the solution brings about.
double acceleration_of(const solver::Row& row, const solver::Solution& solution, double bias) {
  double a = dot(row.a, solution.acceleration[static_cast<std::size_t>(row.body)]) + bias;
  if (row.reference_body >= 0) {
    a -= dot(row.a_reference, solution.acceleration[static_cast<std::size_t>(row.reference_body)]);
  }
  return a;
}

}  // namespace

LimitTable::LimitTable(const StatementTable& statements, const lang::Robot& robot) {
  for (const Statement& s : statements.all()) {
    Indices indices;
    indices.fill(-1);
    for (const Quantity quantity : quantities) {
      const auto q = static_cast<std::size_t>(quantity);
      if (!limits(s.says, quantity)) continue;
      indices[q] = static_cast<int>(limits_.size());
      Limit limit;
      limit.report.row = s.name + "." + words[q];
      limit.report.unit = unit_of(s.says.axis, quantity);
      limit.report.span = s.says.statement_spans[q].exists() ? s.says.statement_spans[q] : s.says.span;
      limits_.push_back(limit);
    }
    of_statement_.push_back(indices);
  }
  first_torque_ = limits_.size();
  for (int j = 0; j < robot.model.joint_count(); ++j) {
    const solver::Joint& joint = robot.model.joint(j);
    Limit limit;
    limit.report.row = joint.name + ".torque";
    limit.report.limit = joint.actuated ? joint.max_effort : 0.0;
    limit.report.unit = joint.type == solver::JointType::prismatic ? "N" : "N m";
    if (static_cast<std::size_t>(j) < robot.joint_spans.size()) {
      limit.report.span = robot.joint_spans[static_cast<std::size_t>(j)];
    }
    limits_.push_back(limit);
  }
}

void LimitTable::compare(int index, double value, double low, double high, bool wanted) noexcept {
  if (index < 0) return;
  Limit& limit = limits_[static_cast<std::size_t>(index)];
  const bool upper = high - value <= value - low;
  const double margin = upper ? high - value : value - low;
  if (!std::isfinite(margin)) return;
  if (!limit.seen || margin < limit.report.margin) {
    limit.report.limit = upper ? high : low;
    limit.report.worst = value;
    limit.report.margin = margin;
    limit.seen = true;
  }
  const double range = std::isfinite(high - low) ? high - low : one_sided_range;
  if (!wanted && margin > 2.0 * at_limit_share * range) return;  // far from it, as most are
  // A force driver is meant to be at its force: it shows only when nothing else is at its limit.
  const double share = std::max(margin / range, wanted ? 0.99 * at_limit_share : 0.0);
  if (share < at_limit_share && (tightest_ < 0 || share < tightest_share_)) {
    tightest_ = index;
    tightest_share_ = share;
    tightest_value_ = value;
    tightest_margin_ = margin;
    tightest_limit_ = upper ? high : low;
  }
}

void LimitTable::update(const StatementTable& statements, const solver::ConstraintSet& set,
                        const std::vector<InForce>& in_force, const solver::Solution& solution,
                        const Eigen::VectorXd& tau) noexcept {
  tightest_ = -1;
  const std::vector<solver::AxisConstraint>& constraints = set.constraints();
  const std::size_t rows = std::min(set.rows().size(), solution.rows.size());
  const std::size_t known = in_force.size();
  int last = -1;  // the rows of a constraint stand together
  for (std::size_t r = 0; r < rows; ++r) {
    const solver::Row& row = set.rows()[r];
    const auto i = static_cast<std::size_t>(row.constraint);
    const bool is_end_of_range = row.kind == solver::RowKind::upper || row.kind == solver::RowKind::lower;
    if (row.constraint == last && is_end_of_range) continue;  // its range is compared by now
    if (i >= known || !in_force[i].active) continue;
    const solver::AxisConstraint& c = constraints[i];
    if (c.alpha < 1.0 || c.progress < 1.0) continue;
    const Indices& of = of_statement_[static_cast<std::size_t>(statements.id(in_force[i].origin))];
    const solver::Coordinate& s = set.coordinates()[i];
    if (row.constraint != last) {
      last = row.constraint;
      if (c.position) compare(of[0], s.position, c.position->low, c.position->high);
      if (c.velocity) compare(of[1], s.velocity, c.velocity->low, c.velocity->high);
      if (c.acceleration) {
        compare(of[2], acceleration_of(row, solution, s.acceleration_bias), c.acceleration->low,
                c.acceleration->high);
      }
    }
    if (row.kind == solver::RowKind::driver) {
      compare(of[3], solution.rows[r].nu, c.driver->force.low, c.driver->force.high);
    } else if (row.kind == solver::RowKind::sum) {
      compare(of[3], solution.rows[r].nu, c.force->low, c.force->high);
    } else if (row.kind == solver::RowKind::force) {
      const double f = std::abs(row.force);  // of a spring what it asks for now
      compare(of[3], solution.rows[r].nu, -f, f, true);
    }
  }
  for (Eigen::Index j = 0; j < tau.size(); ++j) {
    const std::size_t index = first_torque_ + static_cast<std::size_t>(j);
    const double limit = limits_[index].report.limit;
    if (limit > 0.0) compare(static_cast<int>(index), std::abs(tau(j)), -limit, limit);
  }
}

std::vector<LimitReport> LimitTable::reports() const {
  std::vector<LimitReport> reports;
  for (const Limit& limit : limits_) {
    if (limit.seen) reports.push_back(limit.report);
  }
  return reports;
}

std::optional<LimitReport> LimitTable::now() const {
  if (tightest_ < 0) return std::nullopt;
  LimitReport report = limits_[static_cast<std::size_t>(tightest_)].report;
  report.worst = tightest_value_;
  report.limit = tightest_limit_;
  report.margin = tightest_margin_;
  return report;
}

}  // namespace zwang::runtime
