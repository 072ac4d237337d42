/// The plant's true values, by the names in conditions.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scenario/steady_force.hpp"
#include "schedule/frame_table.hpp"
#include "schedule/region_fence.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::runtime {

class TrueFacts {
 public:
  explicit TrueFacts(const lang::Program& program);

  /// Before the run: frames are followed that a condition asks of, as there are many.
  void follow(const lang::Condition& condition);
  /// `torque_share`: of its limit, of the motor that is nearest to it.
  void update(const Truth& truth, const solver::State& state, double torque_share) noexcept;
  /// Of another robot of the scene.
  void update_partner(std::size_t number, const Truth& truth, double torque_share) noexcept;
  void note_partner_stop(std::size_t number, double time) noexcept;
  /// Where the robot has itself in a tick, and where it is.
  void note_pose(const solver::State& estimated, const solver::State& state) noexcept;
  /// When the protective stop latched, and when slip was first reported [s].
  void note_stop(double time) noexcept;
  void note_slip(double time) noexcept;
  /// When `done` was reached, and when the first fault of the scenario begins or began [s].
  void note_done(double time) noexcept { values_[lang::run_done] = time; }
  void note_fault(double onset) noexcept { onset_ = onset; }
  /// The torques that a tick gives, of which `is_switch` says that it went from one task to another.
  void note_torque(const Eigen::VectorXd& tau, bool is_switch) noexcept;
  /// The values of the task file's outputs.
  void note_outputs(std::span<const double> outputs) noexcept;
  /// `task` is one of the program's; `back` is no entry.
  void note_entry(int task, double time) noexcept;
  /// NaN for an unknown value: an object that was never touched, a frame that depends on a signal.
  double look_up(const lang::ExpressionNode& node) const noexcept;
  double quantity(int index) const noexcept { return values_[static_cast<std::size_t>(index)]; }

 private:
  struct TaskEntries {
    int count = 0;
    double last = 0.0;  ///< [s]
  };
  double* of_partner(std::size_t number) noexcept;
  void put_object(std::size_t object, const Truth& truth, double* values) noexcept;
  void put_travels_and_wrenches(const Truth& truth) noexcept;
  void look_at_fault(const Truth& truth) noexcept;
  void look_at_regions() noexcept;

  const lang::Program& program_;
  FrameTable frames_;
  std::vector<RegionFence> regions_;  ///< about the footprint
  std::vector<SteadyForce> steady_;   ///< of each object, then of each robot of the scene
  std::optional<Eigen::VectorXd> last_torque_;
  bool was_switch_ = false;           ///< in the tick that it is of
  std::vector<double> values_;        ///< in the order of lang::truth_names
  std::vector<TaskEntries> entries_;  ///< of each of the program's tasks
  double time_ = 0.0;
  double onset_;              ///< [s] of the first fault
  double x_ = 0.0, y_ = 0.0;  ///< [m] the base's place up to then
};

}  // namespace zwang::runtime
