// The base has the planar twist V = (v_x, v_y, w) in its own axes, and its wheels the rates w_i = j_i' V.
// With the mass m, the centre of mass c, the inertia J about the origin, and the spins' inertias I_i its
// momentum is
//
//   p = m (v + w x c),   L = J w + m (c x v),   spin_i = I_i w_i,
//
// and along the motions B that no wheel holds
//
//   B' [ dp/dt + w x p ; dL/dt + v x p ]  +  sum_i B' j_i I_i dw_i/dt
//       = sum_i B' j_i ( k_i tau_i - c_i sign(w_i) - d_i w_i ).
//
// Each line is weighed over a window of 0.2 s by a trapezoid f(t) with ramps of 60 ms:
//
//   int f dp/dt dt = - int df/dt p dt,
//
// so no rate needs a derivative: impulses of torques stand beside differences of mean momenta and of angles.
// The lines are linear in each motor's torque factor k_i, dry friction c_i and viscous friction d_i. They are
// linear in J, and in m where it is asked for.
//
// Rates are differences of positions: drivers often hand on rates behind a low pass. Samples may come late as
// a whole, by l. Then the torques that belong to them were told by l before. Of all l up to 60 ms the one
// counts with the least  sum (y_X - x b)(y_Z - z b)  of the lines below.
//
// Measured positions are noisy, and a column that has noise is estimated too small by least squares: m and J
// stand before such columns. So the means are taken twice, of every other sample, X and Z. Their noise is not
// correlated, and so it is in no product of both:
// (instrumental_variables.hpp).
//
// A mass scales all of b but itself, so it is known, or a known load makes it so. A window in which a wheel
// hardly turns, or a caster swings, is left out: their forces are not those of sliding friction.
#include "zwang/runtime/identification.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/instrumental_variables.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::runtime {

namespace {

constexpr double window = 0.2;        // [s]
constexpr double ramp = 0.06;         // [s]
constexpr double longest_gap = 0.05;  // [s] between records
constexpr double least_rate = 0.3;    // [rad/s] of a wheel whose dry friction slides
constexpr double aside = 0.01;        // [s] before and behind, where positions give a rate
constexpr double lag_step = 1e-3;     // [s]
constexpr double first_lag = -0.012;  // [s] of logs at 50 Hz: a record has the torque of its begin
constexpr int lags = 73;              // up to 60 ms
constexpr double most_swing = 0.3;    // [rad/s] of a caster
constexpr std::size_t fewest_windows = 20;
constexpr double most_condition = 1e5;  // of unit columns: an inverse of A keeps six of sixteen digits
constexpr double most_factor_error = 0.1;

Eigen::Vector3d velocity_row(const Eigen::Vector3d& direction, const Eigen::Vector3d& at) {
  return {direction.x(), direction.y(), at.x() * direction.y() - at.y() * direction.x()};
}

/// Appends unit vectors until `basis`, which is orthonormal, spans `more`, too.
void extend(std::vector<Eigen::Vector3d>& basis, const std::vector<Eigen::Vector3d>& more) {
  constexpr double least = 1e-6;  // of a vector's length: what is left of it else is rounding
  for (const Eigen::Vector3d& vector : more) {
    Eigen::Vector3d left = vector;
    for (const Eigen::Vector3d& unit : basis) left -= unit.dot(left) * unit;
    if (left.norm() > least * vector.norm()) basis.push_back(left.normalized());
  }
}

}  // namespace

DriveIdentification::DriveIdentification(const lang::Robot& robot, std::optional<double> mass) : mass_(mass) {
  if (robot.drive.takes_velocity)
    throw NotIdentified("`" + robot.name + "` takes velocities: nobody knows the torques of its motors");
  find_wheels(robot);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  const Eigen::VectorXd q = lang::start_state(robot).q;
  double total = 0.0;
  for (int b = 0; b < robot.model.body_count(); ++b) {
    const solver::RigidInertia& inertia = robot.model.bodies()[static_cast<std::size_t>(b)].inertia;
    const solver::Pose pose = lang::pose_in_base(robot.model, b, q);
    moment += inertia.mass * pose.position + pose.rotation * inertia.first_moment;
    total += inertia.mass;
  }
  centre_ = moment.head<2>() / total;
}

void DriveIdentification::find_wheels(const lang::Robot& robot) {
  const solver::Model& model = robot.model;
  std::vector<Eigen::Vector3d> held;  // rows: 0 = row . V
  for (const solver::Wheel& wheel : model.wheels()) {
    const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
    const solver::Joint& joint = model.joint(wheel.body - 1);
    const Eigen::Vector3d& spin_axis = joint.axis;
    const double spin = spin_axis.dot(body.inertia.rotational * spin_axis) + joint.rotor_inertia;
    if (body.parent > 0) {
      if (joint.actuated || model.joint(body.parent - 1).actuated)
        throw NotIdentified("`" + joint.name +
                            "` is steered: only motors of wheels that are fixed to the base "
                            "are identified");
      swivels_.push_back(body.parent - 1);
      caster_mass_ += spin / (wheel.radius * wheel.radius);
      continue;
    }
    const solver::Pose pose = lang::pose_in_base(model, wheel.body);
    Eigen::Vector3d a = pose.rotation * joint.axis;
    a.z() = 0.0;
    a.normalize();
    const Eigen::Vector3d e = a.cross(Eigen::Vector3d::UnitZ());
    if (!wheel.roller_angle && !wheel.holds_sideways)
      throw NotIdentified("`" + joint.name +
                          "` slides sideways as the base turns: the floor's friction would "
                          "count among its motor's");
    Wheel found{wheel.body - 1, joint.name, joint.actuated, spin, {}};
    if (wheel.roller_angle) {
      const Eigen::Vector3d u = Eigen::AngleAxisd(*wheel.roller_angle, Eigen::Vector3d::UnitZ()) * a;
      found.rates = velocity_row(u, pose.position) / (wheel.radius * u.dot(e));
    } else {
      found.rates = velocity_row(e, pose.position) / wheel.radius;
      held.push_back(velocity_row(a, pose.position));
    }
    length_ = std::max(length_, pose.position.head<2>().norm());
    if (joint.actuated) motors_.push_back(wheels_.size());
    wheels_.push_back(found);
  }
  if (motors_.empty())
    throw NotIdentified("`" + robot.name + "` has no motor on a wheel that is fixed to the base");
  permit(held);
}

/// With the permitted motions as columns of B, and rows a_i = j_i' B B': V = (A'A + I - B B')^-1 A' w.
void DriveIdentification::permit(const std::vector<Eigen::Vector3d>& held) {
  std::vector<Eigen::Vector3d> basis;
  extend(basis, held);
  const auto count = static_cast<std::ptrdiff_t>(basis.size());
  extend(basis, {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()});
  permitted_.assign(basis.begin() + count, basis.end());
  if (permitted_.empty()) throw NotIdentified("the wheels that are fixed to the base hold it in place");
  Eigen::Matrix3d onto = Eigen::Matrix3d::Zero();  // B B'
  for (const Eigen::Vector3d& motion : permitted_) onto += motion * motion.transpose();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Identity() - onto;
  for (Wheel& wheel : wheels_) {
    const Eigen::Vector3d row = onto * wheel.rates;
    squares += row * row.transpose();
  }
  // A product of ones, of 1/r^2 and of squares of levers by r; 0 where a motion turns no wheel.
  constexpr double least = 1e-6;
  if (!(squares.determinant() > least))
    throw NotIdentified("the wheels that are fixed to the base do not show how it moves");
  const Eigen::Matrix3d inverse = squares.inverse();
  for (Wheel& wheel : wheels_) wheel.twist = inverse * (onto * wheel.rates);
}

void DriveIdentification::begin_run(double added_load) {
  samples_.clear();
  pushed_at_.clear();
  pushed_.clear();
  added_load_ = added_load;
}

void DriveIdentification::add(double time, const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                              const Eigen::VectorXd& tau) {
  if (!samples_.empty() && !(time > samples_.back().time)) return;
  const auto count = static_cast<Eigen::Index>(wheels_.size());
  Sample now{time, Eigen::VectorXd(count), Eigen::VectorXd(count), {}, q, tau};
  for (std::size_t i = 0; i < wheels_.size(); ++i)
    now.measured(static_cast<Eigen::Index>(i)) = qd(wheels_[i].joint);
  if (!samples_.empty() && time - samples_.back().time > longest_gap) begin_run(added_load_);
  const double since = samples_.empty() ? 0.0 : time - samples_.back().time;
  pushed_.push_back(samples_.empty() ? Eigen::VectorXd::Zero(tau.size())
                                     : Eigen::VectorXd(pushed_.back() + since * samples_.back().tau));
  pushed_at_.push_back(time);
  if (samples_.empty()) is_clean_ = true;
  samples_.push_back(std::move(now));
  const Eigen::VectorXd& rates = samples_.back().measured;
  is_clean_ = is_clean_ && (rates.array().abs() >= least_rate).all() &&
              (rates.array() * samples_.front().measured.array() > 0.0).all();
  for (const int swivel : swivels_) is_clean_ = is_clean_ && std::abs(qd(swivel)) <= most_swing;
  if (time - samples_.front().time < window - 1e-9) return;
  if (is_clean_ && rolls_on_at_the_ends() && samples_.front().time - pushed_at_.front() >= lags * lag_step)
    end_window();
  samples_.erase(samples_.begin(), samples_.end() - 1);
  const auto old = std::ranges::lower_bound(pushed_at_, time - lags * lag_step - longest_gap);
  pushed_.erase(pushed_.begin(), pushed_.begin() + (old - pushed_at_.begin()));
  pushed_at_.erase(pushed_at_.begin(), old);
  is_clean_ = (samples_.front().measured.array().abs() >= least_rate).all();
}

Eigen::Vector3d DriveIdentification::momentum_per_mass(const Eigen::Vector3d& twist) const {
  return {twist.x() - twist.z() * centre_.y(), twist.y() + twist.z() * centre_.x(),
          centre_.x() * twist.y() - centre_.y() * twist.x()};
}

/// k, c and d of each motor, J, and m where it is asked for.
Eigen::Index DriveIdentification::columns() const {
  return 3 * static_cast<Eigen::Index>(motors_.size()) + 1 + (mass_ ? 0 : 1);
}

/// f of each interval, at its middle.
std::vector<double> DriveIdentification::trapezoid() const {
  std::vector<double> f;
  const double begin = samples_.front().time + aside, end = samples_.back().time - aside;
  for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
    const double middle = 0.5 * (samples_[i].time + samples_[i + 1].time);
    f.push_back(std::clamp(std::min(middle - begin, end - middle) / ramp, 0.0, 1.0));
  }
  return f;
}

/// sum f_i (p_(i+1) - p_i) = sum w_i p_i, of the samples of one parity. They stand for all: on each ramp
/// their weights are as much in sum.
Eigen::VectorXd DriveIdentification::weights(const std::vector<double>& f, std::size_t parity) const {
  const auto count = static_cast<Eigen::Index>(samples_.size());
  Eigen::VectorXd all(count), some = Eigen::VectorXd::Zero(count);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    all(k) = (i > 0 ? f[i - 1] : 0.0) - (i < f.size() ? f[i] : 0.0);
    if (i % 2 == parity) some(k) = all(k);
  }
  const double falls = some.cwiseMin(0.0).sum(), rises = some.cwiseMax(0.0).sum();
  if (falls == 0.0 || rises == 0.0) return all;
  return all.cwiseMin(0.0).sum() / falls * some.cwiseMin(0.0) +
         all.cwiseMax(0.0).sum() / rises * some.cwiseMax(0.0);
}

/// A rate behind a low pass has the old sign for a while after a wheel turned back.
bool DriveIdentification::rolls_on_at_the_ends() const {
  const Sample &first = samples_.front(), &last = samples_.back();
  const auto later = [&](double time) {
    return std::ranges::find_if(samples_, [&](const Sample& sample) { return sample.time >= time; });
  };
  const Sample &begun = *later(first.time + ramp), &near = *later(last.time - ramp);
  return std::ranges::all_of(wheels_, [&](const Wheel& wheel) {
    const double way = (last.q - first.q)(wheel.joint), least = least_rate * ramp;
    const double sign = std::copysign(1.0, way);
    return sign * (begun.q - first.q)(wheel.joint) >= least && sign * (last.q - near.q)(wheel.joint) >= least;
  });
}

/// From samples on both sides, of the other parity: their noise is in X or in Z. Steps of encoders that
/// follow each other are alike, and 20 ms have unlike ones.
void DriveIdentification::take_rates() {
  const std::size_t last = samples_.size() - 1;
  const double period = (samples_[last].time - samples_[0].time) / static_cast<double>(last);
  const auto steps = static_cast<std::size_t>(aside / period);
  const std::size_t most = steps < 3 ? 1 : steps - (steps + 1) % 2;
  for (std::size_t i = 0; i <= last; ++i) {
    const Sample &before = samples_[i - std::min(i, most)], &after = samples_[std::min(i + most, last)];
    for (std::size_t w = 0; w < wheels_.size(); ++w)
      samples_[i].rates(static_cast<Eigen::Index>(w)) =
          (after.q - before.q)(wheels_[w].joint) / (after.time - before.time);
    samples_[i].twist = Eigen::Vector3d::Zero();
    for (std::size_t w = 0; w < wheels_.size(); ++w)
      samples_[i].twist += wheels_[w].twist * samples_[i].rates(static_cast<Eigen::Index>(w));
  }
}

Eigen::VectorXd DriveIdentification::impulse_until(double time) const {
  const auto next = std::ranges::upper_bound(pushed_at_, time) - pushed_at_.begin();
  const auto b = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(next, 1, static_cast<std::ptrdiff_t>(pushed_at_.size()) - 1));
  const double part = (time - pushed_at_[b - 1]) / (pushed_at_[b] - pushed_at_[b - 1]);
  return pushed_[b - 1] + part * (pushed_[b] - pushed_[b - 1]);
}

/// int f tau(t - lag) dt of all joints, for each lag.
Eigen::MatrixXd DriveIdentification::impulses(const std::vector<double>& f) const {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(samples_.front().tau.size(), lags);
  for (Eigen::Index lag = 0; lag < lags; ++lag) {
    const double late = first_lag + static_cast<double>(lag) * lag_step;
    Eigen::VectorXd before = impulse_until(samples_.front().time - late);
    for (std::size_t i = 0; i < f.size(); ++i) {
      const Eigen::VectorXd after = impulse_until(samples_[i + 1].time - late);
      sums.col(lag) += f[i] * (after - before);
      before = after;
    }
  }
  return sums;
}

void DriveIdentification::end_window() {
  take_rates();
  const std::vector<double> f = trapezoid();
  Window sums{impulses(f), Eigen::VectorXd::Zero(samples_.front().q.size()), Eigen::Vector3d::Zero(), 0.0};
  for (std::size_t i = 0; i < f.size(); ++i) {
    const Sample &a = samples_[i], &b = samples_[i + 1];
    const double step = f[i] * (b.time - a.time);
    sums.seconds += step;
    sums.angle += f[i] * (b.q - a.q);
    const Eigen::Vector3d mean = 0.5 * (a.twist + b.twist), p = momentum_per_mass(mean);
    sums.turned +=
        step * Eigen::Vector3d(-mean.z() * p.y(), mean.z() * p.x(), mean.x() * p.y() - mean.y() * p.x());
  }
  add_lines(sums, weights(f, 0), even_);
  add_lines(sums, weights(f, 1), odd_);
}

void DriveIdentification::add_lines(const Window& sums, const Eigen::VectorXd& weights, Lines& lines) const {
  Eigen::Vector3d twist_change = Eigen::Vector3d::Zero();
  Eigen::VectorXd rate_change = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(wheels_.size()));
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const double weight = weights(static_cast<Eigen::Index>(i));
    twist_change += weight * samples_[i].twist;
    rate_change += weight * samples_[i].rates;
  }
  const Eigen::Vector3d change = momentum_per_mass(twist_change) + sums.turned;
  Eigen::Vector3d known = (added_load_ + mass_.value_or(0.0)) * change;
  known.head<2>() += caster_mass_ * twist_change.head<2>();
  for (std::size_t i = 0; i < wheels_.size(); ++i)
    known += wheels_[i].rates * wheels_[i].inertia * rate_change(static_cast<Eigen::Index>(i));
  for (const Eigen::Vector3d& along : permitted_) {
    // A line about the vertical has moments: as forces at an arm it counts as much as the others.
    const double scale = 1.0 / std::hypot(along.head<2>().norm(), along.z() * length_);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(columns());
    Eigen::MatrixXd impulses(static_cast<Eigen::Index>(motors_.size()), lags);
    for (std::size_t m = 0; m < motors_.size(); ++m) {
      const Wheel& wheel = wheels_[motors_[m]];
      const double lever = along.dot(wheel.rates);
      const auto at = 3 * static_cast<Eigen::Index>(m);
      impulses.row(static_cast<Eigen::Index>(m)) = scale * lever * sums.impulse.row(wheel.joint);
      row(at + 1) = -lever * std::copysign(sums.seconds, sums.angle(wheel.joint));
      row(at + 2) = -lever * sums.angle(wheel.joint);
    }
    lines.impulses.push_back(impulses);
    row(3 * static_cast<Eigen::Index>(motors_.size())) = -along.z() * twist_change.z();
    if (!mass_) row(columns() - 1) = -along.dot(change);
    lines.left.push_back(scale * row);
    lines.right.push_back(scale * along.dot(known));
  }
}

/// Between two lags the impulse is linear.
TwinLines DriveIdentification::lines_at(double lag) const {
  const double place = (lag - first_lag) / lag_step;
  const auto a = static_cast<Eigen::Index>(std::min<double>(place, lags - 2));
  const double part = place - static_cast<double>(a);
  const auto rows_of = [&](const Lines& lines) {
    std::vector<Eigen::VectorXd> rows = lines.left;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Eigen::MatrixXd& impulses = lines.impulses[k];
      for (Eigen::Index m = 0; m < impulses.rows(); ++m)
        rows[k](3 * m) = (1.0 - part) * impulses(m, a) + part * impulses(m, a + 1);
    }
    return rows;
  };
  return {rows_of(even_), rows_of(odd_), even_.right, odd_.right};
}

/// The vertex of the parabola through the least misfit and its neighbours.
double DriveIdentification::find_lag() const {
  std::vector<double> misfit;
  for (int lag = 0; lag < lags; ++lag)
    misfit.push_back(InstrumentalVariables(lines_at(first_lag + lag * lag_step)).misfit());
  const auto best = static_cast<std::size_t>(std::ranges::min_element(misfit) - misfit.begin());
  if (best == 0) return first_lag;
  if (best + 1 == misfit.size())
    throw NotIdentified("the samples come more than 60 ms after the torques that they are logged with");
  const double left = misfit[best - 1] - misfit[best], right = misfit[best + 1] - misfit[best];
  return first_lag + (static_cast<double>(best) + 0.5 * (left - right) / (left + right)) * lag_step;
}

Identification DriveIdentification::solve() const {
  const std::size_t windows = even_.left.size() / permitted_.size();
  if (windows < fewest_windows)
    throw NotIdentified("too little motion: " + std::to_string(windows) +
                        " windows of 0.2 s in which all wheels "
                        "turn, of " +
                        std::to_string(fewest_windows) + " that are needed");
  const double lag = find_lag();
  const InstrumentalVariables found(lines_at(lag));
  if (found.lacks_a_column())
    throw NotIdentified("too little motion: the base never turned, or a motor never pushed");
  if (!(found.condition() < most_condition * most_condition))
    throw NotIdentified(
        "too little variety: friction, torque and mass cannot be told apart. Drive ahead, back and "
        "turn at unlike speeds, as the task `identify` does");
  const auto estimate = [&](Eigen::Index n) { return Estimate{found.values()(n), found.errors()(n)}; };
  Identification result;
  result.windows = windows;
  result.lag = lag;
  for (std::size_t m = 0; m < motors_.size(); ++m) {
    const auto at = 3 * static_cast<Eigen::Index>(m);
    result.motors.push_back({wheels_[motors_[m]].name, estimate(at), estimate(at + 1), estimate(at + 2)});
    const IdentifiedMotor& motor = result.motors.back();
    if (!(motor.torque_factor.error < most_factor_error * std::abs(motor.torque_factor.value)))
      throw NotIdentified("too little variety: the torque of `" + motor.joint + "` is known no better than " +
                          std::to_string(std::lround(100.0 * motor.torque_factor.error)) + " %");
  }
  result.inertia = estimate(3 * static_cast<Eigen::Index>(motors_.size()));
  result.mass = mass_ ? Estimate{*mass_, 0.0} : estimate(columns() - 1);
  return result;
}

}  // namespace zwang::runtime
