#include "run/limit_table.hpp"

#include <algorithm>
#include <cmath>

#include "schedule/acceleration_of.hpp"
#include "schedule/plane_norm.hpp"

namespace zwang::runtime {

namespace {

using solver::Quantity;

// A limit counts as met when less than this share of its range is left.
constexpr double at_limit_share = 0.01;
constexpr double far_share = 2.0 * at_limit_share;

constexpr double one_sided_range = 1.0;  // [m], [m/s], ...: of a limit that has no other side

constexpr std::array quantities = {Quantity::position, Quantity::velocity, Quantity::acceleration,
                                   Quantity::force};
/// The column of the log that has what is limited.
const char* column_of(const Statement& s, Quantity quantity) {
  switch (quantity) {
    case Quantity::position:
      return s.inside ? "left" : "position";
    case Quantity::velocity:
      return "velocity";
    case Quantity::acceleration:
      return "acceleration";
    case Quantity::force:
      break;
  }
  return s.says.driver ? "nu" : "sum";
}

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

}  // namespace

bool LimitReport::is_broken() const {
  constexpr double share = 1e-3;
  constexpr double least = 1e-6;  // of a limit of 0; SI
  return margin < -std::max(share * std::abs(limit), least);
}

LimitTable::LimitTable(const StatementTable& statements, const lang::Robot& robot) {
  for (const Statement& s : statements.all()) {
    Indices indices;
    indices.fill(-1);
    for (const Quantity quantity : quantities) {
      const auto q = static_cast<std::size_t>(quantity);
      if (!limits(s.says, quantity)) continue;
      indices[q] = static_cast<int>(limits_.size());
      LimitReport& limit = limits_.emplace_back();
      limit.row = s.name + "." + column_of(s, quantity);
      limit.unit = unit_of(s.says.axis, quantity);
      limit.span = s.says.statement_spans[q].exists() ? s.says.statement_spans[q] : s.says.span;
    }
    of_statement_.push_back(indices);
  }
  first_torque_ = limits_.size();
  for (int j = 0; j < robot.model.joint_count(); ++j) {
    const solver::Joint& joint = robot.model.joint(j);
    torque_.push_back(joint.actuated ? joint.max_effort : 0.0);
    LimitReport& limit = limits_.emplace_back();
    limit.row = joint.name + ".tau";
    limit.unit = joint.type == solver::JointType::prismatic ? "N" : "N m";
    if (static_cast<std::size_t>(j) < robot.joint_spans.size()) {
      limit.span = robot.joint_spans[static_cast<std::size_t>(j)];
    }
  }
  nearest_.resize(limits_.size());
}

/// Mostly a value is far from its limit, and was nearer before.
inline void LimitTable::compare(int index, double value, double low, double high, Kind kind) noexcept {
  if (index < 0) return;
  const double to_high = high - value, to_low = value - low;
  const double margin = std::min(to_high, to_low);
  const bool is_far = margin > far_share * (to_high + to_low);
  if (is_far && margin >= nearest_[static_cast<std::size_t>(index)].margin) return;
  take(index, {to_high <= to_low ? high : low, value, margin}, high - low, 0.0, kind);
}

void LimitTable::take(int index, const Nearest& now, double range, double least_share, Kind kind) noexcept {
  if (!std::isfinite(now.margin)) return;
  Nearest& nearest = nearest_[static_cast<std::size_t>(index)];
  if (now.margin < nearest.margin) nearest = now;
  const double whole = std::isfinite(range) ? range : one_sided_range;
  const double share = std::max(now.margin / whole, least_share);
  if (share >= at_limit_share) return;
  // A driver at its force range pushes against something. A place that is at its limit tells what.
  const bool was_push = tightest_ >= 0 && tightest_kind_ == Kind::push;
  const bool was_place = tightest_ >= 0 && tightest_kind_ == Kind::place;
  if (kind == Kind::push && was_place) return;
  const bool tells_more = kind == Kind::place && was_push;
  if (tightest_ >= 0 && !tells_more && share >= tightest_share_) return;
  tightest_ = index;
  tightest_kind_ = kind;
  tightest_share_ = share;
  tightest_now_ = now;
}

void LimitTable::compare_motion(const Indices& of, const solver::AxisConstraint& c,
                                const solver::Coordinate& now) noexcept {
  if (c.measure == solver::Measure::turn) return;
  if (c.position) compare(of[0], now.position, c.position->low, c.position->high, Kind::place);
  if (c.velocity) compare(of[1], now.velocity, c.velocity->low, c.velocity->high);
}

void LimitTable::compare_acceleration(const Indices& of, const solver::AxisConstraint& c,
                                      const solver::Coordinate& now, const solver::Row& row,
                                      const solver::Solution& solution) noexcept {
  if (c.measure == solver::Measure::turn) {
    if (c.velocity) compare(of[2], now.velocity, c.velocity->low, c.velocity->high);
    return;
  }
  if (!c.acceleration) return;
  // The norm in a plane is no more than the most along its sides, by the apothem of their polygon.
  const double share = c.measure == solver::Measure::side ? PlaneNorm::apothem : 1.0;
  compare(of[2], acceleration_of(row, solution, now.acceleration_bias) / share, c.acceleration->low / share,
          c.acceleration->high / share);
}

void LimitTable::compare_force(const Indices& of, const solver::AxisConstraint& c, const solver::Row& row,
                               double nu) noexcept {
  switch (row.kind) {
    case solver::RowKind::driver:
      return compare(of[3], nu, c.driver->force.low, c.driver->force.high, Kind::push);
    case solver::RowKind::sum:
      return compare(of[3], nu, c.force->low, c.force->high);
    case solver::RowKind::force: {
      // It is meant to be at its force: that shows only when nothing else is at its limit.
      const double f = std::abs(row.force);  // of a spring what it asks for now
      return take(of[3], {nu < 0.0 ? -f : f, nu, f - std::abs(nu)}, 2.0 * f, 0.99 * at_limit_share,
                  Kind::push);
    }
    case solver::RowKind::upper:
    case solver::RowKind::lower:
      return;
  }
}

void LimitTable::update(const StatementTable& statements, const solver::ConstraintSet& set,
                        const std::vector<InForce>& in_force, const solver::Solution& solution,
                        const Eigen::VectorXd& tau, bool blends) noexcept {
  tightest_ = -1;
  compare_rows(statements, set, in_force, solution, blends);
  for (std::size_t j = 0; j < torque_.size(); ++j) {
    const double limit = torque_[j];
    const int index = static_cast<int>(first_torque_ + j);
    if (limit > 0.0) compare(index, std::abs(tau(static_cast<Eigen::Index>(j))), -limit, limit);
  }
}

void LimitTable::compare_rows(const StatementTable& statements, const solver::ConstraintSet& set,
                              const std::vector<InForce>& in_force, const solver::Solution& solution,
                              bool blends) noexcept {
  const std::vector<solver::Row>& rows = set.rows();
  const std::size_t count = std::min(rows.size(), solution.rows.size());
  std::size_t r = 0;
  while (r < count) {
    const std::size_t first = r;  // the rows of a constraint stand together
    const int constraint = rows[first].constraint;
    while (r < count && rows[r].constraint == constraint) ++r;
    const auto i = static_cast<std::size_t>(constraint);
    if (i >= in_force.size()) continue;
    const solver::AxisConstraint& c = set.constraints()[i];
    // While a switch blends, an acceleration range that is not new holds in every set; another is on its way.
    // Place and speed count from the first tick on: a blend does not hide what they were.
    const bool is_new = std::max(c.position_horizon, c.velocity_horizon) > solver::limit_horizon;
    const bool has_effect = !blends || !(c.driver || is_new);
    const Indices& of = of_statement_[static_cast<std::size_t>(statements.id(in_force[i].origin))];
    compare_motion(of, c, set.coordinates()[i]);
    if (has_effect) compare_acceleration(of, c, set.coordinates()[i], rows[first], solution);
    for (std::size_t k = first; k < r && of[3] >= 0 && !blends; ++k) {
      compare_force(of, c, rows[k], solution.rows[k].nu);
    }
  }
}

LimitReport LimitTable::report_of(std::size_t index, const Nearest& nearest) const {
  LimitReport report = limits_[index];
  report.limit = nearest.limit;
  report.worst = nearest.worst;
  report.margin = nearest.margin;
  return report;
}

std::vector<LimitReport> LimitTable::reports() const {
  std::vector<LimitReport> reports;
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    if (std::isfinite(nearest_[i].margin)) reports.push_back(report_of(i, nearest_[i]));
  }
  return reports;
}

std::optional<LimitReport> LimitTable::report_of(const Tightest& tightest) const {
  if (tightest.limit < 0) return std::nullopt;
  return report_of(static_cast<std::size_t>(tightest.limit), tightest.now);
}

}  // namespace zwang::runtime
