/// The one loop in which a task runs on the simulated robot.
#pragma once

#include "zwang/export.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {

/// The part of the host in the loop: it makes the ticks, and observes.
class ZWANG_EXPORT SimulatedRunHost {
 public:
  virtual ~SimulatedRunHost() = default;
  /// Called before each step of the simulation. False ends the run.
  virtual bool goes_on() { return true; }
  /// Called when a tick is due: steps the runner. False ends the run.
  virtual bool tick(const Sensed& sensed) = 0;
  /// Called in each step, after the tick and before the plant moves.
  virtual void look_before_step() {}
  /// Called in each step, after the plant moved.
  virtual void look_after_step(const Sensed& /*sensed*/) {}
};

/// Steps the plant under the runner until the run ends. It ends when the task is over, the plant fails, the
/// base falls, `time_limit` [s] is reached, or the host ends it. If the task is over, a base that leans comes
/// down again. Returns the plant's last status; `sensed` is the last sample that arrived.
ZWANG_EXPORT PlantStatus run_simulated(ScenePlant& plant, Runner& runner, Sensed& sensed, double time_limit,
                                       SimulatedRunHost& host);

}  // namespace zwang::runtime
