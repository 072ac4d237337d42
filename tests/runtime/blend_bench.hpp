/// Two tasks that switch by the clock, on a base that stands still.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "robots.hpp"
#include "zwang/runtime/scheduler.hpp"

namespace zwang::runtime::test {

using Constraints = std::vector<solver::AxisConstraint>;

/// A base that stands still, under tasks that switch by the clock.
struct Standing {
  explicit Standing(lang::Program p)
      : program(std::move(p)), scheduler(program, period), sensed(program.robot.model) {}
  const Constraints& tick() {
    sensed.time = ticks++ * period;
    scheduler.tick(sensed);
    return scheduler.constraints().constraints();
  }
  const Constraints& run_to(double time) {
    while (ticks * period < time + 0.5 * period) tick();
    return scheduler.constraints().constraints();
  }
  const Constraints& set(int i) { return scheduler.constraints(i).constraints(); }
  const InForce& in_force(int set, std::size_t i) { return scheduler.in_force(set).at(i); }
  /// The shares of all sets that have a constraint of which `is_it` is true.
  template <typename IsIt>
  double share_of(IsIt is_it) {
    double share = 0.0;
    for (int i = 0; i < scheduler.set_count(); ++i) {
      if (std::ranges::any_of(set(i), is_it)) share += scheduler.share(i);
    }
    return share;
  }
  lang::Program program;
  Scheduler scheduler;
  Sensed sensed;
  int ticks = 0;
};

inline lang::Program switching_tasks(lang::Task a, lang::Task b, double blend, double time = 1.0) {
  a.exits = {exit(after(time), to_task(1))};
  b.blend.constant = blend;
  return program({std::move(a), std::move(b)});
}

}  // namespace zwang::runtime::test
