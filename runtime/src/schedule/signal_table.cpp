#include "schedule/signal_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimate/rotation.hpp"
#include "schedule/guards.hpp"

namespace zwang::runtime {

namespace {

constexpr double longest_memory = 10.0;  // [s] of the pose that a pose signal is seen from

/// The oldest that a sample of the signal can be and still count.
double oldest(const lang::Signal& signal, const lang::Program& program) {
  double age = signal.stale_after.constant;
  if (signal.stale_after.parameter >= 0) {
    const lang::Parameter& p = program.parameters[static_cast<std::size_t>(signal.stale_after.parameter)];
    age = p.range ? p.range->high : longest_memory;
  }
  return std::clamp(age, 0.0, longest_memory);
}

/// The pose on the way from `a` to `b`: straight, and turning at a constant rate.
solver::Pose between(const solver::Pose& a, const solver::Pose& b, double part) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(a.rotation).slerp(part, Eigen::Quaterniond(b.rotation));
  return {turn.toRotationMatrix(), a.position + part * (b.position - a.position)};
}

}  // namespace

double part_of(const solver::ForceVector& wrench, lang::WrenchPart part) noexcept {
  switch (part) {
    case lang::WrenchPart::x:
    case lang::WrenchPart::y:
    case lang::WrenchPart::z:
      return wrench.linear(static_cast<int>(part));
    case lang::WrenchPart::rx:
    case lang::WrenchPart::ry:
    case lang::WrenchPart::rz:
      return wrench.angular(static_cast<int>(part) - 3);
    case lang::WrenchPart::plane:
      break;
  }
  return wrench.linear.head<2>().norm();
}

bool is_sound(const SignalSample& sample, lang::SignalType type) noexcept {
  if (sample.type && *sample.type != type) return false;
  switch (type) {
    case lang::SignalType::boolean:
      return true;
    case lang::SignalType::number:
      return std::isfinite(sample.number);
    case lang::SignalType::pose:
      return is_rotation(sample.pose.rotation) && sample.pose.position.allFinite() &&
             (!sample.twist || (sample.twist->angular.allFinite() && sample.twist->linear.allFinite()));
    case lang::SignalType::wrench:
      return sample.wrench.angular.allFinite() && sample.wrench.linear.allFinite();
  }
  return false;
}

SignalTable::SignalTable(const lang::Program& program, double period) : period_(period) {
  for (const lang::Signal& signal : program.signals) {
    Entry entry;
    entry.declared = signal;
    entry.line = PoseLine(signal.twist_window);
    if (signal.type == lang::SignalType::pose) {
      entry.past.resize(static_cast<std::size_t>(oldest(signal, program) / period) + 2);
    }
    entries_.push_back(std::move(entry));
  }
}

double SignalTable::value(int signal) const noexcept {
  if (!known(signal)) return std::numeric_limits<double>::quiet_NaN();
  const Entry& entry = at(signal);
  if (entry.declared.type == lang::SignalType::boolean) return entry.last.boolean ? 1.0 : 0.0;
  return entry.last.number;
}

double SignalTable::part(int signal, lang::WrenchPart part) const noexcept {
  if (!known(signal)) return std::numeric_limits<double>::quiet_NaN();
  return part_of(at(signal).last.wrench, part);
}

void SignalTable::remember(Entry& entry, double time, const solver::Pose& pose) noexcept {
  if (entry.past.empty()) return;
  entry.newest = (entry.newest + 1) % entry.past.size();
  entry.past[entry.newest] = {time, pose};
  entry.past_count = std::min(entry.past_count + 1, entry.past.size());
}

solver::Pose SignalTable::pose_then(const Entry& entry, double time) noexcept {
  const std::size_t size = entry.past.size();
  const Past* after = &entry.past[entry.newest];
  for (std::size_t i = 1; i < entry.past_count && time < after->time; ++i) {
    const Past* before = &entry.past[(entry.newest + size - i) % size];
    if (before->time <= time) {
      return between(before->pose, after->pose, (time - before->time) / (after->time - before->time));
    }
    after = before;
  }
  return after->pose;
}

bool SignalTable::is_new(const Entry& entry, const SignalSample& sample, double latest) noexcept {
  if (!sample.valid || !(sample.stamp <= latest)) return false;
  return !entry.received || sample.stamp > entry.last.stamp;
}

/// A pose signal becomes a pose in the world at its stamp, and stays there until the next sample.
void SignalTable::take(int index, const SignalSample& sample, FrameTable& frames) noexcept {
  Entry& entry = entries_[static_cast<std::size_t>(index)];
  entry.last = sample;
  entry.received = true;
  if (entry.declared.type != lang::SignalType::pose) return;
  const solver::Pose seen_from = pose_then(entry, sample.stamp);
  if (entry.declared.twist != lang::SignalTwist::none) return take_course(entry, seen_from);
  solver::AttachedFrame seen{-1, seen_from * sample.pose, {}};
  if (sample.twist) {
    // From the axes it is seen in to its own, both at its origin.
    const solver::Matrix3 R = sample.pose.rotation.transpose();
    seen.twist = {R * sample.twist->angular, R * sample.twist->linear};
  }
  frames.feed(index, seen);
}

/// How what is seen moves in the world at the sample's stamp.
void SignalTable::take_course(Entry& entry, const solver::Pose& seen_from) noexcept {
  const SignalSample& sample = entry.last;
  const solver::Pose seen = seen_from * sample.pose;
  if (entry.declared.twist == lang::SignalTwist::fitted) {
    entry.line.add(sample.stamp, seen);
    entry.course = entry.line.at_newest();
  } else {
    const solver::MotionVector twist = sample.twist.value_or(solver::MotionVector{});
    entry.course = {seen, seen_from.rotation * twist.angular, seen_from.rotation * twist.linear};
  }
  entry.moves = false;  // the sample is a jump
}

/// The frame of a pose signal with a twist: while the signal is known it goes on, else it stands.
void SignalTable::go_on(int index, double time, FrameTable& frames) noexcept {
  Entry& entry = entries_[static_cast<std::size_t>(index)];
  const bool is_jump = !entry.moves;
  if (entry.stale) {
    if (is_jump) return;
    entry.moves = false;
    entry.line.clear();
    entry.course.pose = carried_on(entry.course, time - entry.last.stamp).pose;
    entry.course.angular.setZero();
    entry.course.linear.setZero();
    frames.feed(index, {-1, entry.course.pose, {}});
    return;
  }
  const solver::FrameMotion now = carried_on(entry.course, time - entry.last.stamp);
  const solver::AttachedFrame seen{-1, now.pose, now.own_twist()};
  entry.moves = true;
  if (is_jump) {
    frames.feed(index, seen);
  } else {
    frames.carry_on(index, seen);
  }
}

void SignalTable::update(const Sensed& sensed, const std::vector<double>& parameters,
                         FrameTable& frames) noexcept {
  if (!started_) start_ = sensed.time;
  const double latest = sensed.time + clock_rounding * period_;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    const bool is_pose = entry.declared.type == lang::SignalType::pose;
    const int seen_by = is_pose ? frames.signal_of(entry.declared.in) : -1;
    // From a frame that is nowhere itself, nothing is seen.
    const bool sees = seen_by < 0 || known(seen_by);
    if (is_pose && sees) remember(entry, sensed.time, frames.pose(entry.declared.in));
    // Until the first sample the signal's frame is where it is seen from.
    if (is_pose && !started_) frames.feed(static_cast<int>(i), {-1, frames.pose(entry.declared.in), {}});
    if (i < sensed.signals.size()) {
      const SignalSample& sample = sensed.signals[i];
      if (sees && is_new(entry, sample, latest) && is_sound(sample, entry.declared.type)) {
        take(static_cast<int>(i), sample, frames);
      }
    }
    entry.age = sensed.time - (entry.received ? entry.last.stamp : start_);
    entry.stale = entry.age > entry.declared.stale_after.evaluate(parameters) + clock_rounding * period_;
    const bool has_course = entry.declared.twist != lang::SignalTwist::none && entry.received;
    if (is_pose && has_course) go_on(static_cast<int>(i), sensed.time, frames);
  }
  started_ = true;
}

}  // namespace zwang::runtime
