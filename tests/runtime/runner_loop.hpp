/// A runner in a loop with a base that moves as it is told.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "robots.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime::test {

/// Accelerates to a limit, then pushes, then is done.
inline lang::Program errand() {
  lang::Task go = task(
      "go", {drive("go.x", Axis::x, Quantity::velocity, 0.5), drive("go.y", Axis::y, Quantity::velocity, 0.0),
             drive("go.rz", Axis::rz, Quantity::velocity, 0.0)});
  go.groups[0].axes[0].velocity = between(-0.1, 0.2);
  go.groups[0].axes[0].acceleration = between(-0.5, 0.5);
  go.groups[0].axes[0].time_constant.constant = 0.05;
  go.blend.constant = 0.1;
  go.exits = {
      exit(when(apply(Op::greater, call("moved", base_link), number(0.2)), "moved(base_link) > 20 cm"),
           to_task(1), 0.01)};
  lang::Task push = task("push", {drive("go.x", Axis::x, Quantity::force, 10.0),
                                  drive("go.y", Axis::y, Quantity::velocity, 0.0)});
  push.groups[0].axes[0].velocity = between(-0.3, 0.3);
  push.exits = {exit(after(0.5), to_done)};
  push.blend.constant = 0.1;
  lang::Program p = program({go, push});
  p.robot.limits = {{Axis::rz, Quantity::velocity, {-1, 1}, {}}};
  return p;
}

struct Loop {
  explicit Loop(const lang::Program& p, const RunnerSettings& settings = {})
      : runner(p, settings), sensed(p.robot.model) {}
  void tick() {
    base.sense(sensed);
    base.step(runner.step(sensed));
  }
  void run(double longest = 20.0) {
    while (!runner.finished() && base.time < longest) tick();
  }
  const LimitReport& limit(const std::string& row) {
    limits = runner.limits();
    for (const LimitReport& l : limits) {
      if (l.row == row) return l;
    }
    ADD_FAILURE() << "no limit " << row;
    return limits.at(0);
  }
  Runner runner;
  Sensed sensed;
  PlanarBase base;
  std::vector<LimitReport> limits;
};

}  // namespace zwang::runtime::test
