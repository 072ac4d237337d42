#include "guard/runaway_watch.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/ticks.hpp"

namespace zwang::runtime {

namespace {

using solver::AxisConstraint;

/// How far a velocity lies outside of [low, high].
double outside(double velocity, double low, double high) noexcept {
  return std::max(low - velocity, velocity - high);
}

struct Margin {
  double speed, turn;  ///< [m/s], [rad/s]
  double share;        ///< of the speed that is driven or allowed, where that is more
};
constexpr Margin near_margin{RunawayWatch::margin, RunawayWatch::turn_margin, RunawayWatch::share};
constexpr Margin far_margin{RunawayWatch::far, RunawayWatch::turn_far, RunawayWatch::share_far};

/// How many margins the velocity is beyond what the constraint drives or allows.
double excess(const AxisConstraint& c, double velocity, const Margin& margin) noexcept {
  double low = -solver::infinity, high = solver::infinity;
  if (c.velocity && c.measure != solver::Measure::turn) {
    low = c.velocity->low;
    high = c.velocity->high;
  }
  if (c.driver && c.driver->quantity == solver::Quantity::velocity) {
    low = std::max(low, std::min(c.driver->target, 0.0));
    high = std::min(high, std::max(c.driver->target, 0.0));
  }
  const double bound = velocity < 0.0 ? low : high;
  if (std::isinf(bound)) return -solver::infinity;
  const double least = c.is_angle() ? margin.turn : margin.speed;
  return outside(velocity, low, high) / std::max(least, margin.share * std::abs(bound));
}

/// What says how the base moves. The tool of an arm that is led by hand is no base that runs away: an arm is
/// bounded by JointLimits.
bool is_of_base(const AxisConstraint& c) noexcept {
  constexpr int base = 0;
  return c.move.body <= base && c.in.body <= base;
}

/// While a switch blends, a range that is not new is in force in every set; a driver is in force in one.
bool is_wholly_in_force(const AxisConstraint& c, bool blends) noexcept {
  return !blends || (!c.driver && c.velocity_horizon <= solver::limit_horizon);
}

/// The largest of the base's constraints that are wholly in force.
double largest_excess(const solver::ConstraintSet& set, const Margin& margin, bool blends) noexcept {
  const std::vector<AxisConstraint>& all = set.constraints();
  double largest = 0.0;
  for (std::size_t i = 0; i < all.size() && i < set.coordinates().size(); ++i) {
    if (!is_of_base(all[i]) || !is_wholly_in_force(all[i], blends)) continue;
    largest = std::max(largest, excess(all[i], set.coordinates()[i].velocity, margin));
  }
  return largest;
}

}  // namespace

RunawayWatch::RunawayWatch(int joints, double period)
    : period_(period),
      part_(1.0 - std::exp(-period / quick)),
      ticks_between_looks_(ticks_of(look_every, period)),
      rates_(Eigen::VectorXd::Zero(joints)),
      beyond_{.work = rates_},
      rise_{.work = rates_},
      steady_{.work = rates_},
      far_{.work = rates_},
      steady_force_(Eigen::VectorXd::Zero(joints + 6)) {}

void RunawayWatch::reset() noexcept {
  is_exceeded_ = false;
  far_.forget(last_energy_, {});
  beyond_.forget(last_energy_, {});
  rise_.forget(last_energy_, {});
  steady_.forget(last_energy_, {});
  force_size_ = 0;
}

bool RunawayWatch::follow(const Eigen::VectorXd& sent, const Eigen::VectorXd& qd) noexcept {
  if (!has_rates_) rates_ = qd;
  has_rates_ = true;
  rates_ += part_ * (qd - rates_);
  beyond_.work += period_ * sent.cwiseProduct(qd);
  rise_.work += period_ * sent.cwiseProduct(qd);
  steady_.work += period_ * sent.cwiseProduct(qd);
  far_.work += period_ * sent.cwiseProduct(qd);
  if (++ticks_ < ticks_between_looks_) return false;
  ticks_ = 0;
  return true;
}

/// Whether the force is still what it was; if not, from now on it is to be this one.
bool RunawayWatch::keeps(Force force) noexcept {
  auto steady = steady_force_.head(force.size());
  const bool is_same = force.size() == force_size_ &&
                       (force - steady).squaredNorm() < steadily * steadily * force.squaredNorm();
  if (!is_same) steady = force;
  force_size_ = force.size();
  return is_same;
}

std::optional<Event> RunawayWatch::look(const solver::ConstraintSet& set, double kinetic_energy, Force force,
                                        const ContactDepth& contact, bool is_pushed, bool blends) noexcept {
  const double margins = largest_excess(set, near_margin, blends);
  const bool exceeds = margins > 1.0;
  if (exceeds && !is_exceeded_) {
    largest_before_ = *std::max_element(energies_.begin(), energies_.end());
    beyond_.forget(kinetic_energy, contact.now());
  }
  const bool grows = kinetic_energy > growth * last_energy_;
  beyond_.follow(exceeds && is_exceeded_ && grows && kinetic_energy > largest_before_);
  if (beyond_.rising == 0) rise_.forget(kinetic_energy, contact.now());
  if (keeps(force) && grows) {
    steady_.follow(true);
  } else {
    steady_.forget(kinetic_energy, contact.now());
  }
  const bool is_far = kinetic_energy > std::max(last_energy_, largest_before_) &&
                      largest_excess(set, far_margin, blends) > 1.0;
  if (!is_far) far_.forget(kinetic_energy, contact.now());
  far_.follow(is_far);
  is_exceeded_ = exceeds;
  last_energy_ = kinetic_energy;
  energies_[looks_++ % energies_.size()] = kinetic_energy;
  const auto is_at_work = [&](const Driver& driver) {
    return !is_pushed && driver.rising >= dwell && driver.may_be_a_motor(kinetic_energy) &&
           contact.is_no_spring(driver.contact);
  };
  const bool is_driven = margins > driven && is_at_work(steady_);
  const bool is_beyond = is_at_work(beyond_) && rise_.may_be_a_motor(kinetic_energy);
  if (!is_driven && !is_beyond && far_.rising < dwell) return std::nullopt;
  Eigen::Index hardest = 0;
  (is_driven ? steady_ : beyond_).work.minCoeff(&hardest);
  const int joint = static_cast<int>(hardest);
  return Event{EventCode::runaway, 0.0, event_signal::of_joint(joint, event_signal::qd), rates_(hardest)};
}

}  // namespace zwang::runtime
