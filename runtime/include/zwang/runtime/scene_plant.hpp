/// The simulated plant as a scene has it: what is measured, and what goes wrong.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/runtime/hand.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

/// The steps of a simulation between the ticks of a controller.
class ZWANG_EXPORT SimulationSteps {
 public:
  /// Of 1 ms or less each: stiff contacts could not be followed by longer ones.
  explicit SimulationSteps(double control_period) noexcept;
  /// Of `step` [s] each: as many as come nearest to the control period.
  SimulationSteps(double control_period, double step) noexcept;

  int per_tick() const noexcept { return per_tick_; }
  double period() const noexcept { return period_; }  ///< [s] of a step
  /// Once before each step: whether a tick is due. Before the first one it is.
  bool tick_is_due() noexcept;

 private:
  int per_tick_;
  double period_;
  int until_tick_ = 0;
};

/// Options of a run beside the scene.
struct ScenePlantOptions {
  MujocoPlantOptions simulation;
  std::uint64_t seed = 0;           ///< of all noise and dropouts
  std::vector<lang::Fault> faults;  ///< beside the scene's own
  lang::RobotDeviation deviation;   ///< of the first robot
};

/// Another robot of the scene, under a runner of its own.
struct ZWANG_EXPORT ScenePartner {
  ScenePartner(const lang::SceneRobot& robot, const RunnerSettings& settings);
  std::string name;
  std::shared_ptr<const lang::Program> program;
  Runner runner;           ///< a recorder made with its columns may be attached before the first step
  Eigen::VectorXd torque;  ///< that it commanded last
};

/// Of a log's columns behind the runner's own: where the plant has the base, how it leans, speeds up and
/// pushes.
ZWANG_EXPORT std::vector<Column> base_truth_columns();
using BaseTruthValues = std::array<double, 8>;
/// In the order of the columns. `x`, `y` [m] and `yaw` [rad] are those of the base in the world.
ZWANG_EXPORT BaseTruthValues base_truth_values(double x, double y, double yaw,
                                               const BaseTruth& base) noexcept;
/// The columns of the base, then the force on each object and other robot of the scene, and the places of the
/// movable ones.
ZWANG_EXPORT std::vector<Column> truth_columns(const lang::Scene& scene);
/// The values of these columns, in their order.
ZWANG_EXPORT void put_truth(const Truth& truth, const lang::Scene& scene, std::span<double> values);

/// A MujocoPlant whose samples carry the scene's signals and noise, and on which its faults are injected. The
/// scene's other robots are stepped with it, each on its own samples and with its own runner. `apply` first
/// takes their ticks at the same instant, then makes one step of the world. A robot whose control period is
/// longer than that takes its tick every so many steps; the first one's ticks are the caller's.
class ZWANG_EXPORT ScenePlant : public Plant {
 public:
  /// Throws std::invalid_argument when the program has no scene, or robot, scene and faults do not go
  /// together.
  explicit ScenePlant(const lang::Program& program, const ScenePlantOptions& options = {});
  ~ScenePlant() override;

  /// `unreachable`, and `sensed` untouched, when a sample is lost.
  PlantStatus sense(Sensed& sensed) noexcept override;
  /// `unreachable` where the robot's drive takes velocities: that needs `follow`.
  PlantStatus apply(const Eigen::VectorXd& tau) noexcept override;
  /// A drive that takes velocities hands the command on at its rate, half of its delay late, to a PI loop at
  /// each wheel. Its samples are as seldom and as late: Sensed::measured_at.
  PlantStatus follow(const Command& command) noexcept override;
  /// On the first robot, from the next step on, until another one; finite.
  void set_push(const Push& push) noexcept;
  /// A hand's actions from the next step on, its push included. A blocked signal is measured as `lost` in a
  /// script. A fault acts as one of the scene and goes before it. An object that is sent somewhere goes there
  /// straight and evenly, through any obstacle. An object with a mass is let go when it arrives. `hand` has
  /// as many signals and faults as `idle_hand` of the program.
  void set_hand(const Hand& hand);
  /// At the end of a run: a base that still leans stands up or falls, without torque, within 1 s.
  void end_lean() noexcept;
  const Truth& truth() const noexcept;
  /// Without noise or faults.
  const solver::State& true_state() const noexcept;
  /// The first robot has entered a task of the program: faults may count from it.
  void note_entry(int task, double time) noexcept;
  /// [s] when the first of the options' faults begins; infinite while nobody knows.
  double onset() const noexcept;
  /// Of the first robot and the world, the scene's first. `at` is infinite of one that counts from a time
  /// that has not come; those of the options have no span.
  std::vector<lang::Fault> faults() const;
  /// In the scene's order.
  std::vector<ScenePartner>& partners() noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace zwang::runtime
