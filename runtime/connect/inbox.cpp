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

// The signal's sample of a message; nullopt for numbers that cannot be. `arrival` is the stamp of messages
// without one.
std::optional<SignalSample> sample_of(const Bool& message, const lang::SignalSource&, double arrival) {
  SignalSample sample;
  sample.type = lang::SignalType::boolean;
  sample.stamp = arrival;
  sample.valid = true;
  sample.boolean = message.data;
  return sample;
}

std::optional<SignalSample> sample_of(const Float64& message, const lang::SignalSource&, double arrival) {
  if (!std::isfinite(message.data)) return std::nullopt;
  SignalSample sample;
  sample.type = lang::SignalType::number;
  sample.stamp = arrival;
  sample.valid = true;
  sample.number = message.data;
  return sample;
}

std::optional<SignalSample> sample_of(const LaserScan& message, const lang::SignalSource& source, double) {
  const auto nearest = message.nearest((*source.nearest)[0], (*source.nearest)[1]);
  SignalSample sample;
  sample.type = lang::SignalType::number;
  sample.stamp = message.header.stamp();
  sample.valid = nearest.has_value();
  sample.number = nearest.value_or(0.0);
  return sample;
}

std::optional<SignalSample> sample_of(const PoseStamped& message, const lang::SignalSource&, double) {
  const auto pose = pose_of(message.pose);
  if (!pose) return std::nullopt;
  SignalSample sample;
  sample.type = lang::SignalType::pose;
  sample.stamp = message.header.stamp();
  sample.valid = true;
  sample.pose = *pose;
  return sample;
}

std::optional<SignalSample> sample_of(const WrenchStamped& message, const lang::SignalSource&, double) {
  const SixFields& w = message.wrench;
  if (!are_finite(w)) return std::nullopt;
  SignalSample sample;
  sample.type = lang::SignalType::wrench;
  sample.stamp = message.header.stamp();
  sample.valid = true;
  sample.wrench.linear = {w[0], w[1], w[2]};
  sample.wrench.angular = {w[3], w[4], w[5]};
  return sample;
}

void count(TopicCounts& counts, double arrival, double stamp) {
  if (counts.received++ == 0) counts.first_arrival = arrival;
  counts.last_arrival = arrival;
  counts.age_sum = counts.age_sum + (arrival - stamp);
  counts.most_age = std::max(counts.most_age.load(), arrival - stamp);
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
  explicit SignalBox(const lang::SignalSource& from) : source(from) {}

  const lang::SignalSource& source;
  Mailbox<SignalSample> mail;
  // Of the control thread.
  std::optional<std::size_t> index;  ///< in Program::signals; none: the program does not read it
  bool is_told = false;              ///< a value has come
  bool is_due = false;               ///< the snapshot has not got the newest one
};

std::optional<std::size_t> index_of(const std::string& signal, const lang::Program& program) {
  for (std::size_t i = 0; i < program.signals.size(); ++i) {
    if (program.signals[i].name == signal) return i;
  }
  return std::nullopt;
}

}  // namespace

struct Inbox::Parts {
  const lang::Connection& connection;
  const lang::Program* program;
  JointsMerger merger;
  Mailbox<JointsSample> joints;
  Mailbox<BaseSample> base;
  Mailbox<runtime::MeasuredPose> fix;
  std::vector<std::unique_ptr<SignalBox>> signals;
  std::vector<std::unique_ptr<TopicCounts>> counts;
  sem_t arrivals{};
  bool has_joints = false, has_base = false, has_fix = false, trusts_base = true;

  Parts(const lang::Connection& c, const lang::Program& p)
      : connection(c),
        program(&p),
        merger(c.joints, p.robot.model),
        joints(JointsSample{0.0, 0.0, merger.q(), merger.qd()}) {
    sem_init(&arrivals, 0, 0);
  }
  ~Parts() { sem_destroy(&arrivals); }

  /// Listens to a topic. `admits` says whether the publisher of a message is obeyed. `take` keeps the message
  /// and gives its stamp [s], or nullopt for numbers that cannot be. Both are told the time of arrival [s].
  template <typename Message, typename Admits, typename Take>
  void listen(Participant& participant, const lang::Topic& topic, MessageType type, Admits admits,
              Take take) {
    TopicCounts& of = *counts.emplace_back(std::make_unique<TopicCounts>());
    of.topic = topic.name;
    of.type = lang::to_string(type);
    participant.subscribe(topic.name, of.type, [&of, admits, take](const Payload& payload) {
      const double arrival = now();
      const std::optional<Message> message = decode<Message>(payload.bytes);
      if (!admits(of, message, payload.sender, arrival)) {
        ++of.others;
        return;
      }
      const std::optional<double> stamp = message ? take(*message, arrival) : std::nullopt;
      stamp ? count(of, arrival, *stamp) : void(++of.bad);
    });
  }

  /// Listens to a topic that one publisher may fill.
  template <typename Message, typename Take>
  void listen_to_one(Participant& participant, const lang::Topic& topic, MessageType type, Take take) {
    const auto admits = [](TopicCounts& of, const std::optional<Message>&, const Sender& sender,
                           double arrival) { return of.publisher.admits(sender, arrival); };
    listen<Message>(participant, topic, type, admits, take);
  }

  void subscribe_joints(Participant& participant) {
    const auto admits = [this](TopicCounts&, const std::optional<JointState>& message, const Sender& sender,
                               double arrival) {
      return !message || merger.admits(*message, sender, arrival);
    };
    listen<JointState>(
        participant, connection.joints.topic, MessageType::joint_state, admits,
        [this](const JointState& message, double arrival) { return take_joints(message, arrival); });
  }

  std::optional<double> take_joints(const JointState& message, double arrival) {
    if (!merger.take(message)) return std::nullopt;
    const double stamp = message.header.stamp();
    if (!merger.is_whole()) return stamp;
    JointsSample& draft = joints.draft();
    draft.stamp = stamp;
    draft.arrival = arrival;
    draft.q = merger.q();
    draft.qd = merger.qd();
    joints.put();
    sem_post(&arrivals);
    return stamp;
  }

  std::optional<double> take_base(const Odometry& message, double arrival) {
    const auto pose_there = pose_of(message.pose);
    const SixFields& t = message.twist;
    if (!pose_there || !are_finite(t)) return std::nullopt;
    BaseSample& draft = base.draft();
    draft.stamp = message.header.stamp();
    draft.arrival = arrival;
    draft.pose = *pose_there;
    draft.twist.linear = {t[0], t[1], t[2]};
    draft.twist.angular = {t[3], t[4], t[5]};
    base.put();
    return draft.stamp;
  }

  std::optional<double> take_fix(const PoseWithCovarianceStamped& message) {
    const auto pose_there = pose_of(message.pose);
    if (!pose_there) return std::nullopt;
    const double stamp = message.header.stamp();
    fix.draft() = {stamp, *pose_there};
    fix.put();
    return stamp;
  }

  void subscribe_signal(const lang::SignalSource& source, Participant& participant) {
    switch (source.type) {
      case MessageType::boolean:
        return listen_for_signal<Bool>(source, participant);
      case MessageType::float64:
        return listen_for_signal<Float64>(source, participant);
      case MessageType::laser_scan:
        return listen_for_signal<LaserScan>(source, participant);
      case MessageType::pose_stamped:
        return listen_for_signal<PoseStamped>(source, participant);
      default:
        return listen_for_signal<WrenchStamped>(source, participant);
    }
  }

  template <typename Message>
  void listen_for_signal(const lang::SignalSource& source, Participant& participant) {
    SignalBox& box = *signals.emplace_back(std::make_unique<SignalBox>(source));
    listen_to_one<Message>(participant, source.topic, source.type,
                           [&box, &source](const Message& message, double arrival) -> std::optional<double> {
                             const auto sample = sample_of(message, source, arrival);
                             if (!sample) return std::nullopt;
                             box.mail.draft() = *sample;
                             box.mail.put();
                             return sample->stamp;
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
  if (p.connection.base)
    p.listen_to_one<Odometry>(
        participant, *p.connection.base, MessageType::odometry,
        [&p](const Odometry& message, double arrival) { return p.take_base(message, arrival); });
  if (p.connection.fix)
    p.listen_to_one<PoseWithCovarianceStamped>(
        participant, *p.connection.fix, MessageType::pose_with_covariance_stamped,
        [&p](const PoseWithCovarianceStamped& message, double) { return p.take_fix(message); });
  // The task of a goal may read another one than the task before.
  const bool wants_all = p.connection.begin == lang::Begin::goals;
  for (const lang::SignalSource& source : p.connection.signals) {
    if (wants_all || index_of(source.name, *p.program)) p.subscribe_signal(source, participant);
  }
  read_for(*p.program);
}

void Inbox::read_for(const lang::Program& program) {
  Parts& p = *parts_;
  p.program = &program;
  p.trusts_base = true;
  for (const auto& box : p.signals) {
    box->index = index_of(box->source.name, program);
    box->is_due = box->is_told;
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
  sensed.base_measured = p.has_base && p.trusts_base;
  if (sensed.base_measured) p.put_base(p.base.value(), joints.stamp, sensed.state);
  p.has_fix = p.fix.take() || p.has_fix;
  if (p.has_fix) sensed.base_fix = p.fix.value();
  for (const auto& box : p.signals) {
    if (box->mail.take()) box->is_told = box->is_due = true;
    if (!box->is_due || !box->index) continue;
    sensed.signals[*box->index] = box->mail.value();
    box->is_due = false;
  }
}

const JointsSample& Inbox::joints() const noexcept {
  return parts_->joints.value();
}
const BaseSample* Inbox::base() const noexcept {
  return parts_->has_base && parts_->trusts_base ? &parts_->base.value() : nullptr;
}
void Inbox::distrust_base() noexcept {
  parts_->trusts_base = false;
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
