/// One run of a shipped task file, on a base with ideal wheels and exact sensors.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include "robots.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime::test {

inline lang::Program load_shipped(const std::string& name,
                                  const std::map<std::string, std::string>& parameters = {}) {
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  options.parameters = parameters;
  const auto program = lang::load(ZWANG_SOURCE_DIR "/specs/" + name, options, diagnostics);
  for (const lang::Diagnostic& d : diagnostics.all())
    EXPECT_NE(d.severity, lang::Severity::error) << d.message;
  if (!program) throw std::runtime_error(name);
  return *program;
}

/// One run of a task file, with signals and contacts from a script.
struct Case {
  explicit Case(lang::Program p)
      : program(std::move(p)),
        runner(program),
        sensed(program.robot.model, program.signals.size()),
        base(program.robot) {
    if (program.scene) {
      base.pose = {program.scene->start_at[0], program.scene->start_at[1], program.scene->start_yaw};
    }
  }

  /// Runs until the end; `contact` gives the planar force on the base in base axes, `script` sets signals.
  void run(double longest) {
    Eigen::VectorXd last;
    while (!runner.finished() && base.time < longest) {
      base.sense(sensed);
      script();
      const Eigen::VectorXd& tau = runner.step(sensed);
      const Eigen::Vector3d command = base.commanded(tau);
      if (runner.scheduler().transition()) switched = base.time;
      const bool near_switch = base.time > 0.5 && base.time - switched < 0.25;
      if (last.size() > 0 && near_switch) {
        largest_step = std::max(largest_step, (command - last).head<2>().norm());
      }
      last = command;
      base.step(tau, contact());
      look();
    }
  }
  void hear(const std::string& name, const std::function<void(SignalSample&)>& fill) {
    for (std::size_t i = 0; i < program.signals.size(); ++i) {
      if (program.signals[i].name != name) continue;
      sensed.signals[i].valid = true;
      sensed.signals[i].stamp = base.time;
      fill(sensed.signals[i]);
    }
  }
  void hear_number(const std::string& name, double value) {
    hear(name, [&](SignalSample& s) { s.number = value; });
  }
  void hear_boolean(const std::string& name, bool value) {
    hear(name, [&](SignalSample& s) { s.boolean = value; });
  }
  std::string task() const {
    const int now = runner.scheduler().task();
    return now < 0 ? "" : runner.scheduler().tasks()[static_cast<std::size_t>(now)].name;
  }
  /// "drive -> yield -> wait -> done"
  std::string way() const {
    std::string text;
    for (const Transition& t : runner.transitions()) {
      text += (text.empty() ? "" : " -> ") + runner.scheduler().tasks()[static_cast<std::size_t>(t.to)].name;
    }
    return text;
  }

  lang::Program program;
  Runner runner;
  Sensed sensed;
  PlanarBase base;
  std::function<void()> script = [] {};
  std::function<Eigen::Vector3d()> contact = [] { return Eigen::Vector3d(Eigen::Vector3d::Zero()); };
  std::function<void()> look = [] {};
  double switched = 0.0;
  double largest_step = 0.0;  ///< [N] of the commanded force in a tick, while switches blend
};

}  // namespace zwang::runtime::test
