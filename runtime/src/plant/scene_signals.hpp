/// The signals of one robot of a scene, measured as badly as it says: noise, delay, rate and dropouts, all
/// from one seed.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

/// Normal numbers, the same on every machine (the standard library's are not).
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}
  double uniform() noexcept;  ///< in [0, 1)
  double normal() noexcept;   ///< mean 0, standard deviation 1

 private:
  std::mt19937_64 engine_;
};

class SceneSignals {
 public:
  /// Of a robot under `program`, in the scene by its `number`, 0 the first one; `footprints` are those of all
  /// robots, the first one's first. Scene signals that the program does not declare are left out. Throws
  /// std::invalid_argument on a source that cannot give the declared type.
  SceneSignals(const lang::Program& program, const lang::Scene& scene,
               const std::vector<lang::SceneSignal>& signals,
               std::vector<std::vector<solver::Vector3>> footprints, std::uint64_t seed, int number);

  /// From now on the base's own pose in the world is measured, too.
  void measure_base(const lang::SceneSignal& fix, std::uint64_t seed);

  /// By the program's signals: nothing is measured of those that are blocked.
  void block(const std::vector<bool>& blocked) noexcept;
  /// Measures what is due at `truth.time`; `state` is the seeing robot's true one.
  void measure(const Truth& truth, const solver::State& state) noexcept;
  /// The samples that have arrived by `time`.
  void report(double time, std::vector<SignalSample>& samples) const noexcept;
  /// The last pose of the base that arrived.
  std::optional<MeasuredPose> base_fix(double time) const noexcept;

 private:
  struct Source {
    lang::SceneSignal signal;
    int index = 0;             ///< of the program's signal
    std::size_t in_scene = 0;  ///< of the robot's signals in the scene
    lang::SignalType type = lang::SignalType::boolean;
    solver::AttachedFrame in;                   ///< of a pose or a wrench
    solver::AttachedFrame sensor;               ///< of a wrench
    std::optional<solver::AttachedFrame> hook;  ///< of a pose: what latches in the object
    std::vector<SignalSample> on_way;           ///< a ring of the last measurements
    std::size_t next = 0;
    double last_measured = -1.0;
    bool is_blocked = false;
    Noise noise{0};
  };
  struct PlanarPose {
    double x = 0.0, y = 0.0, yaw = 0.0;
  };
  SignalSample measured(Source& source, const Truth& truth, const solver::State& state) const noexcept;
  void measure(Source& source, const Truth& truth, const solver::State& state) noexcept;
  /// The youngest that has arrived.
  static const SignalSample* arrived(const Source& source, double time) noexcept;
  /// The pose of the object or robot with this number.
  PlanarPose pose_of(const Truth& truth, int number) const noexcept;
  /// The same, or the pose of its dock: there x points from the socket at the origin.
  PlanarPose seen_pose(const Truth& truth, int number) const noexcept;
  /// [N] that the first robot presses on it with.
  double force(const Truth& truth, int number) const noexcept;
  bool is_latched(const Truth& truth, int number) const noexcept;
  double distance(const Truth& truth, int number, const solver::State& state) const noexcept;

  /// Of a sensor, seen from the signal's frame.
  solver::ForceVector wrench(Source& source, const Truth& truth, const solver::State& state) const noexcept;
  solver::Pose pose(Source& source, const Truth& truth, const solver::State& state) const noexcept;

  solver::Model model_;
  std::size_t number_;  ///< of the seeing robot
  lang::Scene scene_;
  std::vector<std::vector<solver::Vector3>> footprints_;  ///< convex
  std::vector<std::vector<solver::Vector3>> leaning_;     ///< by object: its outline, if it leans
  std::vector<Source> sources_;
  std::optional<Source> base_;  ///< of `measure_base`
};

}  // namespace zwang::runtime
