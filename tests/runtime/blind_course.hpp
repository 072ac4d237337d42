/// A base whose encoders fail under way.
#pragma once

#include <cmath>
#include <functional>

#include "robots.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime::test {

inline constexpr double acceleration = 1.0;  // [m/s^2] at the start: 0.5 m/s within 0.5 s

inline lang::Program sets_out(double speed) {
  return program({task("go", {drive("go.x", Axis::x, Quantity::velocity, speed),
                              drive("go.y", Axis::y, Quantity::velocity, 0.0),
                              drive("go.rz", Axis::rz, Quantity::velocity, 0.0)})});
}

/// Encoders that stay where they were, but for what is less than any step.
class Failing {
 public:
  void spoil(Sensed& sensed) {
    if (!has_failed_) q_ = sensed.state.q;
    has_failed_ = true;
    sensed.state.q = q_.array() + 1e-10 * (++count_ % 2);
    sensed.state.qd.setZero();
  }

 private:
  Eigen::VectorXd q_;
  bool has_failed_ = false;
  int count_ = 0;
};

struct Course {
  double fastest = 0.0;  ///< [m/s]
  double at_end = 0.0;   ///< [m/s]
  EventCode reason = EventCode::none;
  int probed = 0;
  double stopped_at = 0.0;  ///< [s]
};

/// `before` a step of the runner, with what it is told; `after` a step of the base.
Course go(
    const lang::Program& program_, double seconds, PlanarBase base,
    const std::function<void(PlanarBase&, Sensed&)>& before,
    const std::function<void(PlanarBase&)>& after = [](PlanarBase&) {}) {
  Runner runner(program_);
  Sensed sensed(program_.robot.model, program_.signals.size());
  Course course;
  while (base.time < seconds) {
    base.sense(sensed);
    sensed.base_measured = false;
    before(base, sensed);
    base.step(runner.step(sensed));
    after(base);
    course.fastest = std::max(course.fastest, std::abs(base.V.x()));
  }
  course.at_end = std::abs(base.V.x());
  course.reason = runner.guard().reason();
  course.stopped_at = runner.guard().stop_event().time;
  for (const Event& event : runner.events()) course.probed += event.code == EventCode::probed ? 1 : 0;
  return course;
}

/// The world takes what the base has more than V in this step, of its wheels, too.
inline void hold(PlanarBase& base, const Eigen::Vector3d& V) {
  base.wheels -= period * base.jacobian() * (base.V - V);
  base.V = V;
}

inline constexpr double press = 20.0;  // [N]
inline constexpr double never = 1e9;   // [s]

inline lang::Program presses() {
  lang::Program program_ = program({task("press", {drive("press.x", Axis::x, Quantity::force, press),
                                                   drive("press.y", Axis::y, Quantity::velocity, 0.0),
                                                   drive("press.rz", Axis::rz, Quantity::velocity, 0.0)})});
  program_.tasks.front().timeout = lang::Timeout{{.constant = 4.0}, to_failed, {}};
  return program_;
}

}  // namespace zwang::runtime::test
