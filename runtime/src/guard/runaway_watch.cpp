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
  double lightness;    ///< [1/kg] of a robot that a person pushes; 0: no push
};
constexpr Margin near_margin{RunawayWatch::margin, RunawayWatch::turn_margin, RunawayWatch::share, 0.0};

double margin_at(const AxisConstraint& c, double bound, const Margin& margin) noexcept {
  return std::max(c.is_angle() ? margin.turn : margin.speed, margin.share * std::abs(bound));
}

/// The velocity by which a driver gives way to a push, m (s - v)/T < F, with no more than its force F.
double given_way(const AxisConstraint& c, double velocity, const Margin& margin) noexcept {
  const double force = velocity < 0.0 ? c.driver->force.high : -c.driver->force.low;
  if (c.is_angle() || !std::isfinite(force)) return 0.0;
  return margin.lightness * force * c.driver->time_constant;
}

/// How many margins the velocity is beyond what the constraint drives or allows.
double excess(const AxisConstraint& c, double velocity, const Margin& margin) noexcept {
  double most = -solver::infinity;
  const auto compare = [&](double low, double high, double given) {
    const double bound = velocity < 0.0 ? low : high;
    if (std::isinf(bound)) return;
    most = std::max(most, outside(velocity, low, high) / std::max(given, margin_at(c, bound, margin)));
  };
  if (c.velocity && c.measure != solver::Measure::turn) compare(c.velocity->low, c.velocity->high, 0.0);
  if (c.driver && c.driver->quantity == solver::Quantity::velocity) {
    const double target = c.driver->target;
    compare(std::min(target, 0.0), std::max(target, 0.0), given_way(c, velocity, margin));
  }
  return most;
}

/// Whether the constraint is about the base's motion. A person may lead the tool of an arm by hand, and the
/// base does not run away then. An arm is bounded by JointLimits.
bool is_of_base(const AxisConstraint& c) noexcept {
  constexpr int base = 0;
  return c.move.body <= base && c.in.body <= base;
}

/// While a switch blends, a range that is not new is in force in every set; a driver is in force in one.
bool is_wholly_in_force(const AxisConstraint& c, bool blends) noexcept {
  return !blends || (!c.driver && c.velocity_horizon <= solver::limit_horizon);
}

/// Whether a row asks for accelerations of the base: it yields to a hand. A hand has as much work for one
/// motor as that motor would give if it were reversed, if the others hold less.
bool yields(const solver::ConstraintSet& set) noexcept {
  return std::ranges::any_of(set.constraints(), [](const AxisConstraint& c) {
    return is_of_base(c) && c.driver && c.driver->quantity == solver::Quantity::acceleration;
  });
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

RunawayWatch::RunawayWatch(int joints, double mass, double period)
    : mass_(mass),
      period_(period),
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
  const bool is_led = is_pushed || yields(set);
  const Margin far_margin{far, turn_far, share_far, is_led ? 1.0 / mass_ : 0.0};
  const bool is_far = kinetic_energy > std::max(last_energy_, largest_before_) &&
                      largest_excess(set, far_margin, blends) > 1.0;
  if (!is_far) far_.forget(kinetic_energy, contact.now());
  far_.follow(is_far);
  is_exceeded_ = exceeds;
  last_energy_ = kinetic_energy;
  energies_[looks_++ % energies_.size()] = kinetic_energy;
  const auto is_at_work = [&](const Driver& driver) {
    return !is_led && driver.rising >= dwell && driver.may_be_a_motor(kinetic_energy) &&
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
