/// A scheduler that a test runs by hand.
#pragma once

#include <gtest/gtest.h>

#include "robots.hpp"
#include "zwang/runtime/scheduler.hpp"

namespace zwang::runtime::test {

inline const std::vector<AxisStatements> ahead = {drive("go.x", Axis::x, Quantity::velocity, 0.1)};

/// Runs a scheduler by hand: the base stands still unless a test moves it, and the solver's results are made
/// up.
struct Bench {
  explicit Bench(lang::Program p)
      : program(std::move(p)),
        scheduler(program, period),
        sensed(program.robot.model, program.signals.size()) {}

  void tick() {
    scheduler.tick(sensed);
    if (scheduler.transition()) transitions.push_back(*scheduler.transition());
    ASSERT_TRUE(scheduler.constraints().fill(program.robot.model, sensed.state));
    solver::Solution solution(program.robot.model, scheduler.row_capacity());
    solution.rows.assign(scheduler.constraints().rows().size(), answer);
    scheduler.observe(solution);
    ++ticks;
    sensed.time = ticks * period;
  }
  /// Ticks until the scheduler switches; -1 when it does not within `most`.
  int ticks_to_switch(int most) {
    for (int i = 1; i <= most; ++i) {
      tick();
      if (scheduler.transition()) return i;
    }
    return -1;
  }
  const solver::AxisConstraint& constraint(int i) {
    return scheduler.constraints().constraints()[static_cast<std::size_t>(i)];
  }
  void ticks_more(int n) {
    for (int i = 0; i < n; ++i) tick();
  }
  /// The value of a signal, measured now.
  void hear(int signal, double value) {
    SignalSample& sample = sensed.signals[static_cast<std::size_t>(signal)];
    sample.valid = true;
    sample.stamp = sensed.time;
    sample.number = value;
    sample.boolean = value != 0.0;
  }
  int count() { return static_cast<int>(scheduler.constraints().constraints().size()); }

  lang::Program program;
  Scheduler scheduler;
  Sensed sensed;
  solver::RowSolution answer;
  std::vector<Transition> transitions;
  int ticks = 0;
};

inline lang::Signal signal(const std::string& name, lang::SignalType type, double stale_after) {
  lang::Signal s;
  s.name = name;
  s.type = type;
  s.stale_after.constant = stale_after;
  return s;
}
inline constexpr lang::Target back{lang::TargetKind::back, -1};

}  // namespace zwang::runtime::test
