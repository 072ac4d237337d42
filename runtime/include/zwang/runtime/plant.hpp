/// The robot at the other end of the loop: it is sensed, and it takes torques or velocities.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/command.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// The last measurement of a signal of the task file. Only the value of the signal's own type counts.
///
/// The plant may leave a sample here until the next one comes, or for one tick only. A sample with the stamp
/// of its predecessor is the same sample. The runtime keeps the latest valid sample. The signal is invalid
/// once that is older than the task file's `stale_after`. A signal that was never received ages from the
/// start of the run. A sample is ignored if it is not `valid`, is of another type than the signal, or holds a
/// non-finite number or an invalid rotation. It is ignored, too, if it is older than its predecessor, or
/// stamped after the snapshot.
struct SignalSample {
  std::optional<lang::SignalType>
      type;            ///< which value counts; not the signal's own: ignored; none: not told
  bool valid = false;  ///< false: nothing was measured, or nothing to be trusted
  double stamp = 0.0;  ///< [s] when it was measured, by the clock of `Sensed::time`
  bool boolean = false;
  double number = 0.0;  ///< SI, whatever unit the task file gives the signal
  /// Of a pose signal: X_IP, the signal's frame `in` and what is seen from there, both at the stamp.
  solver::Pose pose;
  /// How what is seen moves in the world: at its origin, in the axes of `in`. None: it stands.
  std::optional<solver::MotionVector> twist;
  solver::ForceVector wrench;  ///< in the axes of `in` and about its origin [N m, N]
};

/// The base's past pose from an external sensor: a localisation, a tracker, a mark on the wall.
struct MeasuredPose {
  double stamp = 0.0;  ///< [s] when it was measured, by the clock of `Sensed::time`
  solver::Pose pose;   ///< X_WB; only x, y and yaw count
};

/// One stamped snapshot of everything the controller may know.
struct Sensed {
  explicit Sensed(const solver::Model& model, std::size_t signal_count = 0)
      : state(model), signals(signal_count) {}
  /// For the robot and the signals of the program, whose samples carry their types.
  explicit Sensed(const lang::Program& program) : Sensed(program.robot.model, program.signals.size()) {
    for (std::size_t i = 0; i < signals.size(); ++i) signals[i].type = program.signals[i].type;
  }
  double time = 0.0;  ///< [s] by any clock that goes on evenly; it may count from 1970
  solver::State state;
  /// [s] when the state was measured, by the same clock; none: now. Of a drive that takes velocities: the
  /// same stamp again is the same sample, which the runner carries on to `time`. A torque drive's state is of
  /// now.
  std::optional<double> measured_at;
  /// For a robot that `feels` by a wrench: the wrench on the base when the state was measured. It is in the
  /// axes of the sensor's frame and about its origin. [N m, N]
  std::optional<solver::ForceVector> contact_wrench;
  /// For a robot that `feels` by effort: the motors' torques when the state was measured [N m], one entry a
  /// joint. Empty: not measured.
  Eigen::VectorXd effort;
  /// Whether the state's base pose and twist are measured; if so, say it on every snapshot. Else the runtime
  /// reckons them from the wheels, and the pose in the first snapshot is where it starts. On wheels its roll
  /// and pitch do not count: the floor is level.
  bool base_measured = false;
  /// An occasional measurement that corrects the reckoning. The same stamp again is the same
  /// measurement.
  std::optional<MeasuredPose> base_fix;
  /// Parallel to the signals of the program that the runner was made with, also after a swap of programs,
  /// and sized once. Empty: nothing is measured. Of another size: none is taken, and that is told.
  std::vector<SignalSample> signals;
};

/// The answer of the robot.
enum class PlantStatus {
  ok,
  diverged,    ///< the simulation reset itself, warned or left the finite numbers: the run is void
  unreachable  ///< no sample, or the command did not arrive
};
ZWANG_EXPORT const char* to_string(PlantStatus status) noexcept;

/// Implement this for your own robot. A call of `sense` and one of `apply`, or `follow`, are made once per
/// control period, on one thread, and must not throw.
class ZWANG_EXPORT Plant {
 public:
  virtual ~Plant() = default;
  /// Fills in the snapshot of now. If nothing arrived, leave it as it is and return `unreachable`: the guard
  /// tells by the stamp that no sample came.
  virtual PlantStatus sense(Sensed& sensed) noexcept = 0;
  /// Applies the joint torques [N m] or [N] for one control period, one entry a joint of the model.
  virtual PlantStatus apply(const Eigen::VectorXd& tau) noexcept = 0;
  /// Runner::command. A robot whose drive takes velocities overrides it; any other takes the torques.
  virtual PlantStatus follow(const Command& command) noexcept { return apply(command.torque); }
};

}  // namespace zwang::runtime
