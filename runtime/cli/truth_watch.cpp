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

/// The largest force that a row of the active task or of `always` may have along a line. [N]
std::optional<double> allowed_force(const runtime::Scheduler& scheduler) {
  std::optional<double> most;
  const auto take = [&](const lang::Value& value) {
    const double force = std::abs(value.evaluate(scheduler.parameters()));
    if (std::isfinite(force)) most = std::max(most.value_or(0.0), force);
  };
  if (scheduler.task() < 0) return most;
  for (const int task : {scheduler.task(), scheduler.always_task()}) {
    for (const lang::Group& group : scheduler.tasks()[static_cast<std::size_t>(task)].groups) {
      for (const lang::AxisStatements& axis : group.axes) {
        if (axis.axis >= solver::Axis::rx) continue;
        if (axis.driver == solver::Quantity::force) take(axis.target);
        if (!axis.force) continue;
        take(axis.force->low);
        take(axis.force->high);
      }
    }
  }
  return most;
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
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    Watched& w = watched_[i];
    if (truth.objects[i].touched && !w.yaw_at_touch) w.yaw_at_touch = truth.yaw;
    meet(w, truth.objects[i], truth);
    if (truth.objects[i].peak_force > w.peak) {
      w.peak = truth.objects[i].peak_force;
      w.peak_at = truth.time;
      w.peak_in = scheduler.task();
      w.peak_came = w.came;
      w.allowed = allowed_force(scheduler);
    }
    if (!in_task) continue;
    w.pull = truth.objects[i].pull;
    if (w.last_forces.size() < window_) {
      w.last_forces.push_back(truth.objects[i].force);
    } else {
      w.last_forces[looks_ % window_] = truth.objects[i].force;
    }
  }
  if (in_task) ++looks_;
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
