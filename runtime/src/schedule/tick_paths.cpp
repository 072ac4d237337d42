// Steps 5 and 7 of the tick: where the frames of groups along a path are.
#include "schedule/parts.hpp"

namespace zwang::runtime {

namespace {

/// One follower serves all groups that lead the same frame along the same path.
bool leads_along(const PathFollower& follower, const lang::Group& group) {
  return group.path >= 0 && follower.follows(group.path, group.move);
}

}  // namespace

void Scheduler::Parts::list_followers() {
  for (const lang::Task& t : tasks.tasks) {
    for (const lang::Group& g : t.groups) {
      if (g.path < 0 || follower_of(g) != nullptr) continue;
      followers.emplace_back(paths[static_cast<std::size_t>(g.path)], g.path, g.move);
    }
  }
}

const PathFollower* Scheduler::Parts::follower_of(const lang::Group& group) const noexcept {
  for (const PathFollower& follower : followers) {
    if (leads_along(follower, group)) return &follower;
  }
  return nullptr;
}

bool Scheduler::Parts::is_off_path(const lang::Group& group) const noexcept {
  const PathFollower* follower = follower_of(group);
  return follower != nullptr && !follower->is_known();
}

/// On entry a frame may be anywhere along the path. If another task has led it along the path, or an
/// interruption has held it up, it goes on from its place.
void Scheduler::Parts::follow_paths(int owner, bool enters) noexcept {
  for (const lang::Group& g : tasks[owner].groups) {
    if (g.path < 0 || !is_known(g.in) || !is_known(g.move)) continue;
    for (PathFollower& follower : followers) {
      if (!leads_along(follower, g)) continue;
      const solver::Vector3 point = frames.pose(g.in).inverse() * frames.pose(g.move).position;
      const bool was_set = follower.settings != frames.settings_of(g.in);
      const bool is_led =
          follower.followed_at >= 0.0 && now - follower.followed_at <= clock_rounding * period;
      const bool is_new = follower.followed_at < 0.0 || was_set || (enters && !is_led);
      is_new ? follower.search(point) : follower.follow(point);
      follower.start_of_piece = carried(frames.attached(g.in), follower.piece().pose);
      follower.settings = frames.settings_of(g.in);
      follower.followed_at = now;
    }
  }
}

/// The piece that the group's frame is at.
void Scheduler::Parts::measure_along(const lang::Group& group, solver::AxisConstraint& c) const noexcept {
  const PathFollower* follower = follower_of(group);
  if (follower == nullptr) return;
  c.measure = solver::Measure::path;
  c.in = follower->start_of_piece;
  c.curvature = follower->piece().curvature;
  c.arc_length = follower->arc_length();
}

}  // namespace zwang::runtime
