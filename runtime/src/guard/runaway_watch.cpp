#include "guard/runaway_watch.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

using solver::AxisConstraint;

bool is_turn(const AxisConstraint& c) noexcept {
  return c.measure == solver::Measure::angle ||
         (c.measure == solver::Measure::axis && c.axis >= solver::Axis::rx);
}

/// How far a velocity lies outside of [low, high].
double outside(double velocity, double low, double high) noexcept {
  return std::max(low - velocity, velocity - high);
}

/// By how much the velocity is more than the constraint drives or allows, less the margin.
double excess(const AxisConstraint& c, double velocity) noexcept {
  double low = -solver::infinity, high = solver::infinity;
  if (c.velocity) {
    low = c.velocity->low;
    high = c.velocity->high;
  }
  if (c.driver && c.driver->quantity == solver::Quantity::velocity) {
    low = std::max(low, std::min(c.driver->target, 0.0));
    high = std::min(high, std::max(c.driver->target, 0.0));
  }
  const double bound = velocity < 0.0 ? low : high;
  if (std::isinf(bound)) return -solver::infinity;
  const double margin = is_turn(c) ? RunawayWatch::turn_margin : RunawayWatch::margin;
  return outside(velocity, low, high) - std::max(margin, RunawayWatch::share * std::abs(bound));
}

}  // namespace

RunawayWatch::RunawayWatch(int joints, double period)
    : period_(period),
      part_(1.0 - std::exp(-period / quick)),
      ticks_between_looks_(std::max(1, static_cast<int>(std::lround(look_every / period)))),
      rates_(Eigen::VectorXd::Zero(joints)),
      work_(rates_) {}

void RunawayWatch::reset() noexcept {
  is_exceeded_ = false;
  rising_ = 0;
}

bool RunawayWatch::follow(const Eigen::VectorXd& sent, const Eigen::VectorXd& qd) noexcept {
  rates_ += part_ * (qd - rates_);
  work_ += period_ * sent.cwiseProduct(qd);
  if (++ticks_ < ticks_between_looks_) return false;
  ticks_ = 0;
  return true;
}

bool RunawayWatch::is_exceeded(const solver::ConstraintSet& set) noexcept {
  const std::vector<AxisConstraint>& all = set.constraints();
  for (std::size_t i = 0; i < all.size() && i < set.coordinates().size(); ++i) {
    if (all[i].alpha < 1.0 || all[i].progress < 1.0) continue;  // not in force yet, or no more
    if (excess(all[i], set.coordinates()[i].velocity) > 0.0) return true;
  }
  return false;
}

std::optional<Event> RunawayWatch::look(const solver::ConstraintSet& set, double kinetic_energy) noexcept {
  const bool exceeds = is_exceeded(set);
  if (exceeds && !is_exceeded_) {
    largest_before_ = *std::max_element(energies_.begin(), energies_.end());
    work_.setZero();
  }
  const bool grows = kinetic_energy > growth * last_energy_ && kinetic_energy > largest_before_;
  rising_ = exceeds && is_exceeded_ && grows && work_.sum() < 0.0 ? rising_ + 1 : 0;
  is_exceeded_ = exceeds;
  last_energy_ = kinetic_energy;
  energies_[looks_++ % energies_.size()] = kinetic_energy;
  if (rising_ < dwell) return std::nullopt;
  Eigen::Index hardest = 0;
  work_.minCoeff(&hardest);
  const int joint = static_cast<int>(hardest);
  return Event{EventCode::runaway, 0.0, event_signal::of_joint(joint, event_signal::qd), rates_(hardest)};
}

}  // namespace zwang::runtime
