#include "schedule/frame_table.hpp"

#include <stdexcept>

namespace zwang::runtime {

FrameTable::FrameTable(const std::vector<lang::FrameDeclaration>& declarations, const solver::Model& model) {
  for (const lang::FrameDeclaration& d : declarations) {
    const int limit = d.parent == lang::FrameParent::body    ? model.body_count()
                      : d.parent == lang::FrameParent::frame ? static_cast<int>(entries_.size())
                                                             : 0;
    const bool known =
        d.parent == lang::FrameParent::world || (d.parent_index >= 0 && d.parent_index < limit);
    if (!known) throw std::invalid_argument("scheduler: the parent of frame `" + d.name + "` is unknown");
    entries_.push_back({d.parent, d.parent_index, d.pose, {}, {}});
    attach(entries_.back());
  }
}

void FrameTable::attach(Entry& entry) const noexcept {
  switch (entry.parent) {
    case lang::FrameParent::signal:  // refused by the constructor until the runtime reads signals
    case lang::FrameParent::world:
      entry.attached = {-1, entry.pose_in_parent};
      break;
    case lang::FrameParent::body:
      entry.attached = {entry.parent_index, entry.pose_in_parent};
      break;
    case lang::FrameParent::frame: {
      const solver::AttachedFrame& parent = attached(entry.parent_index);
      entry.attached = {parent.body, parent.pose * entry.pose_in_parent};
      break;
    }
  }
}

void FrameTable::update(const solver::Model& model, const solver::State& state) noexcept {
  for (Entry& entry : entries_) {
    entry.motion = solver::motion_of(entry.attached, model, state);
    entry.path += (entry.motion.pose.position - entry.path_end).norm();
    entry.path_end = entry.motion.pose.position;
  }
}

void FrameTable::set(int frame, int source, const solver::Model& model, const solver::State& state) noexcept {
  Entry& target = entries_[static_cast<std::size_t>(frame)];
  solver::Pose parent_pose;
  if (target.parent == lang::FrameParent::body) {
    parent_pose = solver::motion_of({target.parent_index, {}}, model, state).pose;
  } else if (target.parent == lang::FrameParent::frame) {
    parent_pose = pose(target.parent_index);
  }
  target.pose_in_parent = parent_pose.inverse() * pose(source);
  for (std::size_t i = static_cast<std::size_t>(frame); i < entries_.size(); ++i) {
    attach(entries_[i]);
    entries_[i].motion = solver::motion_of(entries_[i].attached, model, state);
    entries_[i].path_end = entries_[i].motion.pose.position;
  }
}

void FrameTable::start_paths() noexcept {
  for (Entry& entry : entries_) {
    entry.path = 0.0;
    entry.path_end = entry.motion.pose.position;
  }
}

}  // namespace zwang::runtime
