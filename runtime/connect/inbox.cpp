#include "inbox.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ctime>

namespace zwang::connect {

namespace {

using lang::MessageType;
using runtime::SignalSample;

constexpr double least_rotation = 0.5;  // the norm of a quaternion that was filled in

template <typename Numbers>
bool are_finite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

/// nullopt for a rotation that is none.
std::optional<solver::Pose> pose_of(const PoseFields& f) {
  Eigen::Quaterniond rotation(f[6], f[3], f[4], f[5]);
  if (!are_finite(f) || !(rotation.norm() > least_rotation)) return std::nullopt;
  solver::Pose pose;
  pose.position = {f[0], f[1], f[2]};
  pose.rotation = rotation.normalized().toRotationMatrix();
  return pose;
}

/// The signal's sample of a payload; nullopt for a bad one. `arrival` is the stamp of messages without one.
std::optional<SignalSample> sample_of(const lang::SignalSource& source, std::span<const std::uint8_t> payload,
                                      double arrival) {
  SignalSample sample;
  sample.valid = true;
  sample.stamp = arrival;
  if (source.type == MessageType::boolean) {
    const auto message = decode<Bool>(payload);
    if (!message) return std::nullopt;
    sample.type = lang::SignalType::boolean;
    sample.boolean = message->data;
  } else if (source.type == MessageType::float64) {
    const auto message = decode<Float64>(payload);
    if (!message || !std::isfinite(message->data)) return std::nullopt;
    sample.type = lang::SignalType::number;
    sample.number = message->data;
  } else if (source.type == MessageType::laser_scan) {
    const auto message = decode<LaserScan>(payload);
    if (!message) return std::nullopt;
    const auto nearest = message->nearest((*source.nearest)[0], (*source.nearest)[1]);
    sample.type = lang::SignalType::number;
    sample.stamp = message->header.stamp();
    sample.valid = nearest.has_value();
    sample.number = nearest.value_or(0.0);
  } else if (source.type == MessageType::pose_stamped) {
    const auto message = decode<PoseStamped>(payload);
    const auto pose = message ? pose_of(message->pose) : std::nullopt;
    if (!pose) return std::nullopt;
    sample.type = lang::SignalType::pose;
    sample.stamp = message->header.stamp();
    sample.pose = *pose;
  } else {
    const auto message = decode<WrenchStamped>(payload);
    if (!message || !are_finite(message->wrench)) return std::nullopt;
    const SixFields& w = message->wrench;
    sample.type = lang::SignalType::wrench;
    sample.stamp = message->header.stamp();
    sample.wrench.linear = {w[0], w[1], w[2]};
    sample.wrench.angular = {w[3], w[4], w[5]};
  }
  return sample;
}

void count(TopicCounts& counts, double arrival, double stamp) {
  if (counts.received++ == 0) counts.first_arrival = arrival;
  counts.last_arrival = arrival;
  counts.age_sum = counts.age_sum + (arrival - stamp);
  counts.most_age = std::max(counts.most_age.load(), arrival - stamp);
}

bool is_obeyed(const Payload& payload, double arrival, TopicCounts& counts) {
  if (counts.publisher.admits(payload.sender, arrival)) return true;
  ++counts.others;
  return false;
}

/// Messages may hold a part of the joints each: the last of each joint is kept.
class JointsMerger {
 public:
  JointsMerger(const lang::JointsSource& source, const solver::Model& model) : model_(model) {
    const int n = model.joint_count();
    for (int j = 0; j < n; ++j) index_[source.name_of(model.joint(j).name)] = j;
    is_told_.assign(static_cast<std::size_t>(n), false);
    publishers_.resize(static_cast<std::size_t>(n));
    q_ = qd_ = Eigen::VectorXd::Zero(n);
  }

  /// Whether it comes from the publisher that has told of these joints before.
  bool admits(const JointState& message, const Sender& sender, double arrival) {
    return std::all_of(message.names.begin(), message.names.end(), [&](const std::string& name) {
      const auto joint = index_.find(name);
      return joint == index_.end() ||
             publishers_[static_cast<std::size_t>(joint->second)].admits(sender, arrival);
    });
  }

  /// False: the message is no good, and nothing is taken.
  bool take(const JointState& message) {
    const std::size_t n = message.names.size();
    const bool fits = message.positions.size() == n && message.velocities.size() == n;
    if (!fits || !are_finite(message.positions) || !are_finite(message.velocities)) return false;
    for (std::size_t i = 0; i < n; ++i) {
      const auto joint = index_.find(message.names[i]);
      if (joint == index_.end()) continue;
      is_told_[static_cast<std::size_t>(joint->second)] = true;
      q_(joint->second) = message.positions[i];
      qd_(joint->second) = message.velocities[i];
    }
    return true;
  }
  bool is_whole() const {
    for (int j = 0; j < model_.joint_count(); ++j) {
      if (model_.joint(j).actuated && !is_told_[static_cast<std::size_t>(j)]) return false;
    }
    return true;
  }
  const Eigen::VectorXd& q() const { return q_; }
  const Eigen::VectorXd& qd() const { return qd_; }

 private:
  const solver::Model& model_;
  std::map<std::string, int> index_;
  std::vector<bool> is_told_;
  std::vector<OnePublisher> publishers_;  // of each joint
  Eigen::VectorXd q_, qd_;
};

struct SignalBox {
  std::size_t index = 0;  ///< in Program::signals
  Mailbox<SignalSample> mail;
};

}  // namespace

struct Inbox::Parts {
  const lang::Connection& connection;
  const lang::Program& program;
  JointsMerger merger;
  Mailbox<JointsSample> joints;
  Mailbox<BaseSample> base;
  Mailbox<runtime::MeasuredPose> fix;
  std::vector<std::unique_ptr<SignalBox>> signals;
  std::vector<std::unique_ptr<TopicCounts>> counts;
  sem_t arrivals{};
  bool has_joints = false, has_base = false, has_fix = false;

  Parts(const lang::Connection& c, const lang::Program& p)
      : connection(c),
        program(p),
        merger(c.joints, p.robot.model),
        joints(JointsSample{0.0, 0.0, merger.q(), merger.qd()}) {
    sem_init(&arrivals, 0, 0);
  }
  ~Parts() { sem_destroy(&arrivals); }

  TopicCounts& add_counts(const lang::Topic& topic, MessageType type) {
    counts.push_back(std::make_unique<TopicCounts>());
    counts.back()->topic = topic.name;
    counts.back()->type = lang::to_string(type);
    return *counts.back();
  }

  void subscribe_joints(Participant& participant) {
    TopicCounts& of = add_counts(connection.joints.topic, MessageType::joint_state);
    participant.subscribe(of.topic, MessageType::joint_state, [this, &of](const Payload& payload) {
      const double arrival = now();
      const auto message = decode<JointState>(payload.bytes);
      if (message && !merger.admits(*message, payload.sender, arrival)) {
        ++of.others;
        return;
      }
      if (!message || !merger.take(*message)) {
        ++of.bad;
        return;
      }
      count(of, arrival, message->header.stamp());
      if (!merger.is_whole()) return;
      JointsSample& draft = joints.draft();
      draft.stamp = message->header.stamp();
      draft.arrival = arrival;
      draft.q = merger.q();
      draft.qd = merger.qd();
      joints.put();
      sem_post(&arrivals);
    });
  }

  void subscribe_base(Participant& participant) {
    TopicCounts& of = add_counts(*connection.base, MessageType::odometry);
    participant.subscribe(of.topic, MessageType::odometry, [this, &of](const Payload& payload) {
      const double arrival = now();
      if (!is_obeyed(payload, arrival, of)) return;
      const auto message = decode<Odometry>(payload.bytes);
      const auto pose = message ? pose_of(message->pose) : std::nullopt;
      if (!pose || !are_finite(message->twist)) {
        ++of.bad;
        return;
      }
      const SixFields& t = message->twist;
      count(of, arrival, message->header.stamp());
      BaseSample& draft = base.draft();
      draft.stamp = message->header.stamp();
      draft.arrival = arrival;
      draft.pose = *pose;
      draft.twist.linear = {t[0], t[1], t[2]};
      draft.twist.angular = {t[3], t[4], t[5]};
      base.put();
    });
  }

  void subscribe_fix(Participant& participant) {
    TopicCounts& of = add_counts(*connection.fix, MessageType::pose_with_covariance_stamped);
    participant.subscribe(of.topic, MessageType::pose_with_covariance_stamped,
                          [this, &of](const Payload& payload) {
                            if (!is_obeyed(payload, now(), of)) return;
                            const auto message = decode<PoseWithCovarianceStamped>(payload.bytes);
                            const auto pose = message ? pose_of(message->pose) : std::nullopt;
                            if (!pose) {
                              ++of.bad;
                              return;
                            }
                            count(of, now(), message->header.stamp());
                            fix.draft() = {message->header.stamp(), *pose};
                            fix.put();
                          });
  }

  void subscribe_signal(const lang::SignalSource& source, std::size_t index, Participant& participant) {
    TopicCounts& of = add_counts(source.topic, source.type);
    signals.push_back(std::make_unique<SignalBox>());
    SignalBox& box = *signals.back();
    box.index = index;
    participant.subscribe(of.topic, source.type, [&of, &box, &source](const Payload& payload) {
      const double arrival = now();
      if (!is_obeyed(payload, arrival, of)) return;
      const auto sample = sample_of(source, payload.bytes, arrival);
      if (!sample) {
        ++of.bad;
        return;
      }
      count(of, arrival, sample->stamp);
      box.mail.draft() = *sample;
      box.mail.put();
    });
  }

  /// The base goes on along its circle from its own stamp to that of the joints.
  void put_base(const BaseSample& from, double stamp, solver::State& state) const {
    const double age = std::clamp(stamp - from.stamp, 0.0, connection.joints.stale_after);
    const double turn = age * from.twist.angular.z();
    const auto about_z = [](double angle) { return Eigen::AngleAxisd(angle, solver::Vector3::UnitZ()); };
    state.base_pose.position =
        from.pose.position + from.pose.rotation * (about_z(0.5 * turn) * (age * from.twist.linear));
    state.base_pose.rotation = from.pose.rotation * about_z(turn);
    state.base_twist = from.twist;
  }
};

Inbox::Inbox(const lang::Connection& connection, const lang::Program& program)
    : parts_(std::make_unique<Parts>(connection, program)) {
  now();  // its clock starts here, not on a thread of DDS
}
Inbox::~Inbox() = default;

void Inbox::subscribe(Participant& participant) {
  Parts& p = *parts_;
  p.subscribe_joints(participant);
  if (p.connection.base) p.subscribe_base(participant);
  if (p.connection.fix) p.subscribe_fix(participant);
  for (const lang::SignalSource& source : p.connection.signals) {
    for (std::size_t i = 0; i < p.program.signals.size(); ++i) {
      if (p.program.signals[i].name == source.name) p.subscribe_signal(source, i, participant);
    }
  }
}

bool Inbox::wait_for_joints(double until) noexcept {
  const double left = std::max(0.0, until - now());
  timespec at{};
  clock_gettime(CLOCK_MONOTONIC, &at);
  const auto nanoseconds = static_cast<long>(std::fmod(left, 1.0) * 1e9) + at.tv_nsec;
  at.tv_sec += static_cast<time_t>(left) + nanoseconds / 1'000'000'000;
  at.tv_nsec = nanoseconds % 1'000'000'000;
  if (sem_clockwait(&parts_->arrivals, CLOCK_MONOTONIC, &at) != 0) return false;
  // The mailbox holds the latest: those before it are not caught up with.
  while (sem_trywait(&parts_->arrivals) == 0) continue;
  return true;
}

void Inbox::fill(runtime::Sensed& sensed) noexcept {
  Parts& p = *parts_;
  p.has_joints = p.joints.take() || p.has_joints;
  p.has_base = p.base.take() || p.has_base;
  const JointsSample& joints = p.joints.value();
  sensed.state.q = joints.q;
  sensed.state.qd = joints.qd;
  sensed.base_measured = p.connection.base.has_value() && p.has_base;
  if (sensed.base_measured) p.put_base(p.base.value(), joints.stamp, sensed.state);
  if (p.fix.take()) sensed.base_fix = p.fix.value();
  for (const auto& box : p.signals) {
    if (box->mail.take()) sensed.signals[box->index] = box->mail.value();
  }
}

const JointsSample& Inbox::joints() const noexcept {
  return parts_->joints.value();
}
bool Inbox::has_joints() const noexcept {
  return parts_->has_joints;
}
bool Inbox::has_base() const noexcept {
  return parts_->has_base || !parts_->connection.base;
}
double Inbox::last_arrival() const noexcept {
  return parts_->counts.front()->last_arrival;
}
const std::vector<std::unique_ptr<TopicCounts>>& Inbox::counts() const noexcept {
  return parts_->counts;
}

}  // namespace zwang::connect
