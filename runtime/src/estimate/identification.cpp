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
// Integrated over windows of 0.1 s, no rate needs a derivative: impulses of torques stand beside differences
// of momenta and of angles. The lines are linear in each motor's torque factor k_i, dry friction c_i and
// viscous friction d_i. They are linear in J, and in m where it is asked for:
//
//   y = X b,   b = (X'X)^-1 X'y,   error of b_n = sqrt( |y - X b|^2 / (lines - columns) (X'X)^-1_nn ).
//
// A mass scales all of b but itself, so it is known, or a known load makes it so. A window in which a wheel
// hardly turns, or a caster swings, is left out: their forces are not those of sliding friction.
#include "zwang/runtime/identification.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "zwang/lang/wheel_level.hpp"

namespace zwang::runtime {

namespace {

constexpr double window = 0.1;        // [s]
constexpr double longest_gap = 0.05;  // [s] between records
constexpr double least_rate = 0.3;    // [rad/s] of a wheel whose dry friction slides
constexpr double most_swing = 0.3;    // [rad/s] of a caster
constexpr std::size_t fewest_windows = 20;
constexpr double most_condition = 1e5;  // of the columns at unit length
constexpr double most_factor_error = 0.1;

Eigen::Vector3d velocity_row(const Eigen::Vector3d& direction, const Eigen::Vector3d& at) {
  return {direction.x(), direction.y(), at.x() * direction.y() - at.y() * direction.x()};
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
  Eigen::MatrixXd holds =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(std::max<std::size_t>(held.size(), 1)), 3);
  for (std::size_t i = 0; i < held.size(); ++i) holds.row(static_cast<Eigen::Index>(i)) = held[i];
  const Eigen::FullPivLU<Eigen::MatrixXd> lu = Eigen::FullPivLU<Eigen::MatrixXd>(holds).setThreshold(1e-6);
  permitted_ = lu.kernel();
  const auto count = static_cast<Eigen::Index>(wheels_.size());
  Eigen::MatrixXd rates(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) rates.row(i) = wheels_[static_cast<std::size_t>(i)].rates;
  const Eigen::MatrixXd reduced = rates * permitted_;
  twist_of_ = permitted_ * reduced.completeOrthogonalDecomposition().pseudoInverse();
}

void DriveIdentification::begin_run(double added_load) {
  first_.reset();
  last_.reset();
  added_load_ = added_load;
}

DriveIdentification::Sample DriveIdentification::sample_of(double time, const Eigen::VectorXd& qd) const {
  Sample sample{time, Eigen::VectorXd(static_cast<Eigen::Index>(wheels_.size())), {}};
  for (std::size_t i = 0; i < wheels_.size(); ++i)
    sample.rates(static_cast<Eigen::Index>(i)) = qd(wheels_[i].joint);
  sample.twist = twist_of_ * sample.rates;
  return sample;
}

void DriveIdentification::add(double time, const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                              const Eigen::VectorXd& tau) {
  const Sample now = sample_of(time, qd);
  if (last_ && time - last_->time <= longest_gap) {
    const double step = time - last_->time;
    impulse_ += step * last_tau_;
    const Eigen::Vector3d mean = 0.5 * (last_->twist + now.twist), p = momentum_per_mass(mean);
    turned_ +=
        step * Eigen::Vector3d(-mean.z() * p.y(), mean.z() * p.x(), mean.x() * p.y() - mean.y() * p.x());
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      is_clean_ = is_clean_ && std::abs(now.rates(k)) >= least_rate && now.rates(k) * first_->rates(k) > 0.0;
    }
    for (const int swivel : swivels_) is_clean_ = is_clean_ && std::abs(qd(swivel)) <= most_swing;
    if (time - first_->time >= window - 1e-9) {
      if (is_clean_) end_window(now, q);
      first_.reset();
    }
  } else {
    first_.reset();
  }
  if (!first_) {
    first_ = now;
    first_q_ = q;
    impulse_ = Eigen::VectorXd::Zero(tau.size());
    turned_.setZero();
    is_clean_ = (now.rates.array().abs() >= least_rate).all();
  }
  last_ = now;
  last_tau_ = tau;
}

Eigen::Vector3d DriveIdentification::momentum_per_mass(const Eigen::Vector3d& twist) const {
  return {twist.x() - twist.z() * centre_.y(), twist.y() + twist.z() * centre_.x(),
          centre_.x() * twist.y() - centre_.y() * twist.x()};
}

/// k, c and d of each motor, J, and m where it is asked for.
Eigen::Index DriveIdentification::columns() const {
  return 3 * static_cast<Eigen::Index>(motors_.size()) + 1 + (mass_ ? 0 : 1);
}

void DriveIdentification::end_window(const Sample& last, const Eigen::VectorXd& q) {
  const Eigen::Vector3d change = momentum_per_mass(last.twist) - momentum_per_mass(first_->twist) + turned_;
  const Eigen::Vector3d twist_change = last.twist - first_->twist;
  const double known_mass = added_load_ + mass_.value_or(0.0);
  Eigen::Vector3d known = known_mass * change;
  known.head<2>() += caster_mass_ * twist_change.head<2>();
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    known += wheels_[i].rates * wheels_[i].inertia * (last.rates(k) - first_->rates(k));
  }
  const double seconds = last.time - first_->time;
  for (Eigen::Index n = 0; n < permitted_.cols(); ++n) {
    const Eigen::Vector3d along = permitted_.col(n);
    // A line about the vertical has moments: as forces at an arm it counts as much as the others.
    const double scale = 1.0 / std::hypot(along.head<2>().norm(), along.z() * length_);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(columns());
    for (std::size_t m = 0; m < motors_.size(); ++m) {
      const Wheel& wheel = wheels_[motors_[m]];
      const double lever = along.dot(wheel.rates);
      const auto at = 3 * static_cast<Eigen::Index>(m);
      row(at) = lever * impulse_(wheel.joint);
      row(at + 1) = -lever * std::copysign(seconds, last.rates(static_cast<Eigen::Index>(motors_[m])));
      row(at + 2) = -lever * (q(wheel.joint) - first_q_(wheel.joint));
    }
    row(3 * static_cast<Eigen::Index>(motors_.size())) = -along.z() * twist_change.z();
    if (!mass_) row(columns() - 1) = -along.dot(change);
    rows_.push_back(scale * row);
    right_.push_back(scale * along.dot(known));
  }
}

Identification DriveIdentification::solve() const {
  const std::size_t windows = rows_.size() / static_cast<std::size_t>(permitted_.cols());
  if (windows < fewest_windows)
    throw NotIdentified("too little motion: " + std::to_string(windows) +
                        " windows of 0.1 s in which all wheels "
                        "turn, of " +
                        std::to_string(fewest_windows) + " that are needed");
  const auto lines = static_cast<Eigen::Index>(rows_.size());
  Eigen::MatrixXd x(lines, columns());
  Eigen::VectorXd y(lines);
  for (Eigen::Index i = 0; i < lines; ++i) {
    x.row(i) = rows_[static_cast<std::size_t>(i)];
    y(i) = right_[static_cast<std::size_t>(i)];
  }
  const Eigen::VectorXd norms = x.colwise().norm();
  if (norms.minCoeff() <= 0.0)
    throw NotIdentified("too little motion: the base never turned, or a motor never pushed");
  const Eigen::MatrixXd unit = x * norms.cwiseInverse().asDiagonal();
  // unit' unit = V S^2 V', the normal equations. Up to the most condition they keep six of sixteen digits.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(unit.transpose() * unit);
  const Eigen::VectorXd singular = gram.eigenvalues().cwiseMax(0.0).cwiseSqrt();  // the least comes first
  if (singular(0) * most_condition < singular(singular.size() - 1))
    throw NotIdentified(
        "too little variety: friction, torque and mass cannot be told apart. Drive ahead, back and "
        "turn at unlike speeds, as the task `identify` does");
  const Eigen::MatrixXd v_over_s = gram.eigenvectors() * singular.cwiseInverse().asDiagonal();
  const Eigen::VectorXd scaled = v_over_s * (v_over_s.transpose() * (unit.transpose() * y));
  const double variance =
      (y - unit * scaled).squaredNorm() / std::max<double>(1.0, static_cast<double>(lines - columns()));
  const auto estimate = [&](Eigen::Index n) {
    return Estimate{scaled(n) / norms(n), std::sqrt(variance) * v_over_s.row(n).norm() / norms(n)};
  };
  Identification result;
  result.windows = windows;
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
