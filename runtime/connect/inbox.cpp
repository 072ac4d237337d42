#include "inbox.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ctime>

#include "joints_merger.hpp"
#include "signal_sample.hpp"
#include "transforms.hpp"

namespace zwang::connect {

namespace {

using lang::MessageType;
using runtime::SignalSample;

void count(TopicCounts& counts, double arrival, double age) {
  if (counts.received++ == 0) counts.first_arrival = arrival;
  counts.last_arrival = arrival;
  counts.age_sum = counts.age_sum + age;
  counts.most_age = std::max(counts.most_age.load(), age);
}

struct WrenchSample {
  double stamp = 0.0;  ///< [s]
  solver::ForceVector wrench;
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
  Mailbox<WrenchSample> wrench;
  std::optional<TransformChain> transforms;  ///< that give the fix
  std::mutex fix_mutex;                      ///< of the threads of DDS: /tf and /tf_static have one each
  std::vector<std::unique_ptr<SignalBox>> signals;
  std::vector<std::unique_ptr<TopicCounts>> counts;
  RobotClock clock;
  std::atomic<double> last_stamp{0.0};  ///< [s] of the joints
  sem_t arrivals{};
  bool has_joints = false, has_base = false, has_fix = false, has_wrench = false, trusts_base = true;

  Parts(const lang::Connection& c, const lang::Program& p)
      : connection(c),
        program(&p),
        merger(c.joints, p.robot),
        joints(JointsSample{0.0, 0.0, merger.q(), merger.qd(), merger.effort()}),
        clock(c.clock.has_value(), c.joints.stale_after) {
    sem_init(&arrivals, 0, 0);
    if (c.fix_frames) transforms.emplace(c.fix_frames->parent, c.fix_frames->child);
  }
  ~Parts() { sem_destroy(&arrivals); }

  bool feels_by_effort() const { return program->robot.drive.feels.by == lang::Feels::By::effort; }

  /// Listens to a topic. `admits` says whether the publisher of a message is obeyed. `take` keeps the message
  /// and gives its stamp [s], or nullopt for numbers that cannot be. Both are told the time of arrival [s].
  template <typename Message, typename Admits, typename Take>
  void listen(Participant& participant, const lang::Topic& topic, MessageType type, Admits admits,
              Take take) {
    TopicCounts& of = *counts.emplace_back(std::make_unique<TopicCounts>());
    of.topic = topic.name;
    of.type = lang::to_string(type);
    participant.subscribe(topic.name, of.type, [this, &of, admits, take](const Payload& payload) {
      const double arrival = now();
      const std::optional<Message> message = decode<Message>(payload.bytes);
      if (!admits(of, message, payload.sender, arrival)) {
        ++of.others;
        return;
      }
      const std::optional<double> stamp = message ? take(*message, arrival) : std::nullopt;
      stamp ? count(of, arrival, clock.time_at(arrival) - *stamp) : void(++of.bad);
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
    last_stamp = stamp;
    JointsSample& draft = joints.draft();
    draft.stamp = stamp;
    draft.arrival = arrival;
    draft.q = merger.q();
    draft.qd = merger.qd();
    draft.effort = merger.effort();
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

  std::optional<double> take_wrench(const WrenchStamped& message) {
    if (!are_finite(message.wrench)) return std::nullopt;
    const double stamp = message.header.stamp();
    wrench.draft() = {stamp, wrench_of(message.wrench)};
    wrench.put();
    return stamp;
  }

  void subscribe_transforms(Participant& participant, const std::string& topic, bool is_static) {
    TopicCounts& of = *counts.emplace_back(std::make_unique<TopicCounts>());
    of.topic = topic;
    of.type = lang::to_string(MessageType::tf_message);
    of.may_be_silent = is_static;
    participant.subscribe(
        topic, of.type,
        [this, &of, is_static](const Payload& payload) { take_transforms(of, payload, is_static); },
        is_static ? Late::gets_last : Late::gets_nothing);
  }

  /// A message may hold frames of the whole robot: one that is bad or of another publisher spoils no other.
  void take_transforms(TopicCounts& of, const Payload& payload, bool is_static) {
    using Verdict = TransformChain::Verdict;
    const double arrival = now();
    const auto message = decode<TransformsMessage>(payload.bytes);
    if (!message) {
      ++of.bad;
      return;
    }
    for (const TransformStamped& transform : message->transforms) {
      const Verdict verdict = transforms->take(transform, is_static, payload.sender, arrival);
      if (verdict == Verdict::bad) ++of.bad;
      if (verdict == Verdict::of_another) ++of.others;
      if (verdict == Verdict::taken)
        count(of, arrival, is_static ? 0.0 : clock.time_at(arrival) - transform.header.stamp());
    }
    const std::lock_guard lock(fix_mutex);
    if (const auto found = transforms->find()) {
      fix.draft() = {found->stamp, found->pose};
      fix.put();
    }
  }

  void subscribe_clock(Participant& participant) {
    listen_to_one<ClockMessage>(participant, *connection.clock, MessageType::clock,
                                [this](const ClockMessage& message, double arrival) -> std::optional<double> {
                                  clock.tell(message.time(), arrival);
                                  return message.time();
                                });
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
    listen_to_one<Message>(
        participant, source.topic, source.type,
        [this, &box, &source](const Message& message, double arrival) -> std::optional<double> {
          const auto sample = sample_of(message, source, clock.time_at(arrival));
          if (!sample) return std::nullopt;
          box.mail.draft() = *sample;
          box.mail.put();
          return sample->stamp;
        });
  }

  /// Puts the contact force. A wrench older than the joints' `stale_after` counts as not measured.
  void put_feeling(const JointsSample& from, runtime::Sensed& sensed) {
    if (feels_by_effort()) sensed.effort = from.effort;
    has_wrench = wrench.take() || has_wrench;
    const bool is_young = has_wrench && from.stamp - wrench.value().stamp <= connection.joints.stale_after;
    sensed.contact_wrench = is_young ? std::optional(wrench.value().wrench) : std::nullopt;
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
  if (p.connection.clock) p.subscribe_clock(participant);
  if (p.connection.base)
    p.listen_to_one<Odometry>(
        participant, *p.connection.base, MessageType::odometry,
        [&p](const Odometry& message, double arrival) { return p.take_base(message, arrival); });
  if (p.connection.fix)
    p.listen_to_one<PoseWithCovarianceStamped>(
        participant, *p.connection.fix, MessageType::pose_with_covariance_stamped,
        [&p](const PoseWithCovarianceStamped& message, double) { return p.take_fix(message); });
  if (p.connection.wrench)
    p.listen_to_one<WrenchStamped>(
        participant, *p.connection.wrench, MessageType::wrench_stamped,
        [&p](const WrenchStamped& message, double) { return p.take_wrench(message); });
  if (p.transforms) {
    p.subscribe_transforms(participant, "/tf", false);
    p.subscribe_transforms(participant, "/tf_static", true);
  }
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
  p.put_feeling(joints, sensed);
  for (const auto& box : p.signals) {
    if (box->mail.take()) box->is_told = box->is_due = true;
    if (!box->is_due || !box->index) continue;
    sensed.signals[*box->index] = box->mail.value();
    box->is_due = false;
  }
}

const RobotClock& Inbox::clock() const noexcept {
  return parts_->clock;
}
double Inbox::silence() const noexcept {
  return parts_->clock.silence(now(), last_arrival(), parts_->last_stamp);
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
bool Inbox::has_wrench() const noexcept {
  return parts_->has_wrench || !parts_->connection.wrench;
}
bool Inbox::has_signals() const noexcept {
  return std::all_of(parts_->signals.begin(), parts_->signals.end(),
                     [](const auto& box) { return box->is_told || !box->index; });
}
double Inbox::last_arrival() const noexcept {
  return parts_->counts.front()->last_arrival;
}
const std::vector<std::unique_ptr<TopicCounts>>& Inbox::counts() const noexcept {
  return parts_->counts;
}

}  // namespace zwang::connect
