/// The measurements of one robot of a scene: of itself and of the objects that it sees.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene_signals.hpp"
#include "velocity_loop.hpp"

namespace zwang::runtime {

class RobotSenses {
 public:
  /// `number`: 0 the first robot, then the scene's. Throws
  /// std::invalid_argument as SceneSignals does.
  RobotSenses(const lang::Program& program, const lang::Scene& scene, int number, const lang::Robot& first,
              std::uint64_t seed);

  /// Before the first sample: where the robot starts.
  void start_at(const Sensed& actual);
  /// As SceneSignals::block.
  void block(const std::vector<bool>& blocked) noexcept { signals_.block(blocked); }
  /// To be called once a step of the simulation. Writes the force that the robot feels into `actual`.
  /// `torque` is that of its motors in the last step.
  void measure(const Truth& truth, const Eigen::VectorXd& torque, Sensed& actual) noexcept;
  /// `actual` as it arrives: with noise, or without the base and with what corrects its reckoning.
  void tell(const Sensed& actual, Sensed& sensed) noexcept;

 private:
  void add_noise(solver::State& state) noexcept;
  /// Through the sensor's low pass.
  void feel(const Truth& truth, const Eigen::VectorXd& torque, Sensed& actual) noexcept;
  void add_felt_noise(Sensed& sample) noexcept;
  /// The state of a drive that is sampled now and then.
  void tell_last_sample(const Sensed& actual, Sensed& sensed) noexcept;
  /// The sample that has arrived by now; of the first one until another has.
  const Sensed& arrived(const Sensed& actual) noexcept;

  lang::StateNoise state_;
  SceneSignals signals_;
  Noise noise_;
  solver::Pose start_;          ///< of the base
  std::vector<Sensed> on_way_;  ///< a ring, of samples that come late; empty where none does
  std::size_t oldest_ = 0, waiting_ = 0;
  lang::Drive drive_;
  std::optional<SampledLine<Sensed>> drive_line_;  ///< of a drive that takes velocities
  Sensed last_sample_;                             ///< that has come over it, with its noise
  int number_;
  solver::Pose sensor_;  ///< of the wrench that is felt, on the base
  solver::Vector3 felt_ = solver::Vector3::Zero();
  Eigen::VectorXd effort_;
  double felt_at_ = 0.0;  ///< [s]
};

}  // namespace zwang::runtime
