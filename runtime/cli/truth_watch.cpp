#include "truth_watch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace zwang::cli {

namespace {

constexpr double steady_window = 0.5;  // [s]

/// A transient contact may press twice as hard as a quasi-static one, of a body part that it does not hurt:
/// ISO/TS 15066, table A.2. Beyond this factor of what the file allows a peak is a hit.
constexpr double transient_factor = 2.0;

/// A row along a lets |a . F| be at most f, so a push N along n has N <= f / |a . n|. A row that is farther
/// than 60 deg from n says nothing: it would allow more than twice its own force.
constexpr double least_share = 0.5;

/// The most that one row of the base lets it press with along the row. [N]
double bound_of(const solver::Row& row) {
  if (row.kind == solver::RowKind::force) return std::abs(row.force);
  return std::max(std::abs(row.lo), std::abs(row.hi));
}

/// The force that the rows allow along one line.
struct Line {
  Eigen::Vector3d along;
  std::optional<double> by_drivers;  ///< [N] of all drivers together
  double by_sums = solver::infinity;

  double most() const { return std::min(by_drivers.value_or(solver::infinity), by_sums); }
};

std::vector<Line> lines_of(const std::vector<solver::Row>& rows) {
  std::vector<Line> lines;
  for (const solver::Row& row : rows) {
    const Eigen::Vector3d along = row.a.linear;
    if (row.body != 0 || solver::is_limit(row.kind) || along.norm() < least_share) continue;
    const Eigen::Vector3d a = along.normalized();
    constexpr double parallel = 1.0 - 1e-6;  // 0.08 deg
    const auto same = [&](const Line& line) { return std::abs(line.along.dot(a)) > parallel; };
    auto line = std::ranges::find_if(lines, same);
    if (line == lines.end()) line = lines.insert(line, {a});
    if (row.kind == solver::RowKind::sum) {
      line->by_sums = std::min(line->by_sums, bound_of(row));
    } else {
      line->by_drivers = line->by_drivers.value_or(0.0) + bound_of(row);
    }
  }
  return lines;
}

/// The largest force on an object that the rows in force allow, in the direction of the peak. A row of the
/// link that touches counts whatever its direction: the pose of that link is unknown. [N]
std::optional<double> allowed_force(const solver::ConstraintSet& set, const runtime::ObjectTruth& object,
                                    double yaw) {
  const Eigen::Vector3d n = Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()) * object.peak_push.normalized();
  double most = solver::infinity;
  for (const Line& line : lines_of(set.rows())) {
    const double share = std::abs(line.along.dot(n));
    if (share > least_share) most = std::min(most, line.most() / share);
  }
  for (const solver::Row& row : set.rows()) {
    const bool presses = row.kind == solver::RowKind::driver || row.kind == solver::RowKind::force;
    if (presses && row.body != 0 && row.body == object.peak_body) most = std::min(most, bound_of(row));
  }
  return std::isfinite(most) ? std::optional(most) : std::nullopt;
}

}  // namespace

/// Where no row bounds a force, whatever is touched is hit.
bool ObjectReport::is_hit() const {
  return touched && !latched && peak_force > transient_factor * allowed.value_or(0.0);
}

TruthWatch::TruthWatch(const runtime::Truth& truth, const lang::Program& program, double period)
    : watched_(truth.objects.size()),
      period_(period),
      window_(static_cast<std::size_t>(std::max(1.0, std::round(steady_window / period)))) {
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    watched_[i].last_forces.reserve(window_);
    watched_[i].place = {truth.objects[i].x, truth.objects[i].y};
    const bool is_object = program.scene && i < program.scene->objects.size();
    watched_[i].can_be_pushed =
        is_object && program.scene->objects[i].mass && !program.scene->objects[i].guide;
  }
}

/// The faster of the two came to the other. A base that turns is as fast as its point at the object.
void TruthWatch::meet(Watched& w, const runtime::ObjectTruth& object, const runtime::Truth& truth) const {
  const Eigen::Vector2d place(object.x, object.y);
  const bool touches = object.force > 0.0;
  if (touches && !w.touches) {
    const double reach = (place - Eigen::Vector2d(truth.x, truth.y)).norm();
    const double of_base = truth.velocity.head<2>().norm() + std::abs(truth.velocity.z()) * reach;
    w.came = (place - w.place).norm() / period_ > of_base;
  }
  if (object.touched && w.can_be_pushed && !w.place_at_touch) w.place_at_touch = place;
  w.touches = touches;
  w.place = place;
}

void TruthWatch::look(const runtime::Truth& truth, const runtime::Scheduler& scheduler, bool in_task) {
  if (truth.base.hand > 0.0 && !hand_.began) hand_.began = truth.time;
  hand_.most = std::max(hand_.most, truth.base.hand);
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    Watched& w = watched_[i];
    if (truth.objects[i].touched && !w.yaw_at_touch) w.yaw_at_touch = truth.yaw;
    meet(w, truth.objects[i], truth);
    if (truth.objects[i].peak_force > w.peak) {
      w.peak = truth.objects[i].peak_force;
      w.peak_at = truth.time;
      w.peak_in = scheduler.task();
      w.peak_came = w.came;
      w.allowed = allowed_force(scheduler.constraints(), truth.objects[i], truth.yaw);
    }
    if (!in_task) continue;
    w.pull = truth.objects[i].pull;
    if (w.last_forces.size() < window_) {
      w.last_forces.push_back(truth.objects[i].force);
    } else {
      w.last_forces[looks_ % window_] = truth.objects[i].force;
    }
  }
  if (!in_task) return;
  ++looks_;
  last_task_ = scheduler.task();
}

std::vector<ObjectReport> TruthWatch::objects(const runtime::Truth& truth,
                                              const runtime::Scheduler& scheduler) const {
  std::vector<ObjectReport> reports;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const runtime::ObjectTruth& o = truth.objects[i];
    const Watched& w = watched_[i];
    ObjectReport& report = reports.emplace_back();
    report.name = o.name;
    report.touched = o.touched;
    report.yaw_at_touch = w.yaw_at_touch;
    const double sum = std::accumulate(w.last_forces.begin(), w.last_forces.end(), 0.0);
    if (!w.last_forces.empty()) report.steady_force = sum / static_cast<double>(w.last_forces.size());
    report.peak_force = o.peak_force;
    report.peak_at = w.peak_at;
    if (w.peak_in >= 0) report.peak_in = scheduler.tasks()[static_cast<std::size_t>(w.peak_in)].name;
    report.allowed = w.allowed;
    report.came = w.peak_came;
    if (w.place_at_touch) report.pushed_away = (Eigen::Vector2d(o.x, o.y) - *w.place_at_touch).norm();
    if (last_task_ >= 0) report.steady_in = scheduler.tasks()[static_cast<std::size_t>(last_task_)].name;
    report.latched = o.latched;
    report.pull = w.pull;
  }
  return reports;
}

std::vector<AskedForce> asked_forces(const runtime::Scheduler& scheduler) {
  std::vector<AskedForce> asked;
  if (scheduler.task() < 0) return asked;
  const lang::Task& task = scheduler.tasks()[static_cast<std::size_t>(scheduler.task())];
  for (const lang::Group& group : task.groups) {
    for (const lang::AxisStatements& axis : group.axes) {
      if (axis.driver != solver::Quantity::force) continue;
      asked.push_back({task.name + "." + axis.name, axis.target.evaluate(scheduler.parameters()),
                       axis.axis >= solver::Axis::rx ? "N m" : "N"});
    }
  }
  return asked;
}

}  // namespace zwang::cli
