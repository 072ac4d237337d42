#include "schedule/frame_table.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "zwang/lang/condition_function.hpp"

namespace zwang::runtime {

solver::AttachedFrame carried(const solver::AttachedFrame& parent, const solver::Pose& pose) noexcept {
  if (parent.body >= 0) return {parent.body, parent.pose * pose, {}};
  // A frame of a moving frame: the twist at its own origin, in its own axes.
  return {-1, parent.pose * pose, solver::PluckerTransform(pose) * parent.twist};
}

FrameTable::FrameTable(const std::vector<lang::FrameDeclaration>& declarations, const solver::Model& model,
                       std::size_t signal_count)
    : motions_(static_cast<std::size_t>(model.body_count())), signals_(signal_count) {
  for (const lang::FrameDeclaration& d : declarations) {
    const int limit = d.parent == lang::FrameParent::body     ? model.body_count()
                      : d.parent == lang::FrameParent::frame  ? static_cast<int>(entries_.size())
                      : d.parent == lang::FrameParent::signal ? static_cast<int>(signal_count)
                                                              : 0;
    const bool known =
        d.parent == lang::FrameParent::world || (d.parent_index >= 0 && d.parent_index < limit);
    if (!known) throw std::invalid_argument("scheduler: the parent of frame `" + d.name + "` is unknown");
    Entry entry;
    entry.parent = d.parent;
    entry.parent_index = d.parent_index;
    entry.pose_in_parent = d.pose;
    if (d.parent == lang::FrameParent::signal) entry.signal = d.parent_index;
    if (d.parent == lang::FrameParent::frame) entry.signal = signal_of(d.parent_index);
    attach(entry);
    entries_.push_back(entry);
  }
}

void FrameTable::attach(Entry& entry) const noexcept {
  switch (entry.parent) {
    case lang::FrameParent::world:
      entry.attached = {-1, entry.pose_in_parent, {}};
      break;
    case lang::FrameParent::signal:
      entry.attached = carried(signals_[static_cast<std::size_t>(entry.parent_index)], entry.pose_in_parent);
      break;
    case lang::FrameParent::body:
      entry.attached = {entry.parent_index, entry.pose_in_parent, {}};
      break;
    case lang::FrameParent::frame:
      entry.attached = carried(attached(entry.parent_index), entry.pose_in_parent);
      break;
  }
}

void FrameTable::follow(const lang::ExpressionNode& call) {
  const auto is_it = [&](const Followed& f) { return f.frame == call.index && f.function == call.function; };
  if (std::ranges::any_of(followed_, is_it)) return;
  followed_.push_back({call.index, call.function, {}, {}});
}

void FrameTable::update(const solver::Model& model, const solver::State& state, double dt) noexcept {
  motions_.start(model, state);
  dt_ = dt;
  for (Followed& f : followed_) {
    const lang::ConditionFunction& function =
        lang::condition_functions()[static_cast<std::size_t>(f.function)];
    f.before = f.now;
    f.now = motions_.of(attached(f.frame));
    if (function.adds_up) f.sum = function.measure(f.sum, f.before, f.now, dt);
  }
}

double FrameTable::measured(const lang::ExpressionNode& call) const noexcept {
  for (const Followed& f : followed_) {
    if (f.frame != call.index || f.function != call.function) continue;
    const lang::ConditionFunction& function = lang::function_of(call);
    if (function.adds_up) return f.sum;
    // The frame of a pose signal has moved since `update`.
    return function.measure(0.0, f.before, motions_.of(attached(f.frame)), dt_);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

void FrameTable::carry_on(int signal, const solver::AttachedFrame& seen) noexcept {
  signals_[static_cast<std::size_t>(signal)] = seen;
  for (Entry& entry : entries_) {
    if (entry.signal == signal) attach(entry);
  }
}

/// A jump that is no motion adds nothing up.
void FrameTable::feed(int signal, const solver::AttachedFrame& seen) noexcept {
  carry_on(signal, seen);
  for (Followed& f : followed_) {
    if (signal_of(f.frame) == signal) f.now = motions_.of(attached(f.frame));
  }
}

void FrameTable::set(int frame, int source) noexcept {
  Entry& target = entries_[static_cast<std::size_t>(frame)];
  solver::Pose parent_pose;
  if (target.parent == lang::FrameParent::body) {
    parent_pose = motions_.of(target.parent_index).pose;
  } else if (target.parent == lang::FrameParent::frame) {
    parent_pose = pose(target.parent_index);
  } else if (target.parent == lang::FrameParent::signal) {
    parent_pose = signals_[static_cast<std::size_t>(target.parent_index)].pose;
  }
  target.pose_in_parent = parent_pose.inverse() * pose(source);
  ++target.settings;
  for (std::size_t i = static_cast<std::size_t>(frame); i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    if (entry.parent == lang::FrameParent::frame) {
      const int above = settings_of(entry.parent_index);
      if (above != entry.settings_above) ++entry.settings;
      entry.settings_above = above;
    }
    attach(entry);
  }
  for (Followed& f : followed_) {
    if (f.frame >= frame) f.now = motions_.of(attached(f.frame));
  }
}

void FrameTable::start_sums() noexcept {
  for (Followed& f : followed_) f.sum = 0.0;
}

void FrameTable::keep_sums() noexcept {
  for (Followed& f : followed_) f.kept_sum = f.sum;
}

void FrameTable::resume_sums() noexcept {
  for (Followed& f : followed_) f.sum = f.kept_sum;
}

}  // namespace zwang::runtime
