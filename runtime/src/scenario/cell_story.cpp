#include "scenario/cell_story.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

constexpr std::size_t most_told = 40;  // transitions, events
constexpr double least_limit = 1e-9;   // of any unit: below it a limit is 0

double share_left(const LimitReport& limit) {
  return limit.margin / std::max(std::abs(limit.limit), least_limit);
}

std::string name_of(const Scheduler& scheduler, int task) {
  return task < 0 ? "" : scheduler.tasks()[static_cast<std::size_t>(task)].name;
}

}  // namespace

void PathWatch::look(const Truth& truth) {
  last_ = {truth.x, truth.y, truth.yaw};
  if (since_++ % ticks_a_point_ != 0) return;
  points_.push_back(last_);
  if (points_.size() < most_points) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize((points_.size() + 1) / 2);
  ticks_a_point_ *= 2;
  since_ = 1;
}

std::vector<std::array<double, 3>> PathWatch::path() const {
  std::vector<std::array<double, 3>> path = points_;
  if (!path.empty()) path.push_back(last_);
  return path;
}

CellStory story_of(const Runner& runner, const PathWatch& watch) {
  CellStory story;
  const Scheduler& scheduler = runner.scheduler();
  for (const Transition& t : runner.transitions()) {
    if (story.transitions.size() >= most_told) break;
    story.transitions.push_back(
        {t.time, name_of(scheduler, t.from), name_of(scheduler, t.to), scheduler.why_with_note(t)});
  }
  for (const Event& e : runner.events()) {
    if (story.events.size() >= most_told) break;
    story.events.push_back({e.time, to_string(e.code), runner.event_signal(e)});
  }
  story.transition_count = runner.transition_count();
  story.event_count = runner.event_count();
  story.limits = runner.limits();
  std::ranges::stable_sort(story.limits, [](const LimitReport& a, const LimitReport& b) {
    if (a.is_broken() != b.is_broken()) return a.is_broken();
    return share_left(a) < share_left(b);
  });
  story.path = watch.path();
  return story;
}

}  // namespace zwang::runtime
