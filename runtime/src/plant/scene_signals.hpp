/// The signals of a scene, measured as badly as it says: noise, delay, rate and dropouts, all from one seed.
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
  /// Scene signals that the program does not declare are left out. Throws std::invalid_argument on a source
  /// that cannot give the declared type.
  SceneSignals(const lang::Program& program, std::uint64_t seed);

  /// Measures what is due at `truth.time`; `state` is the true one.
  void measure(const Truth& truth, const solver::State& state) noexcept;
  /// What has arrived by then.
  void report(double time, std::vector<SignalSample>& samples) const noexcept;

 private:
  struct Source {
    lang::SceneSignal signal;
    int index = 0;  ///< of the program's signal
    lang::SignalType type = lang::SignalType::boolean;
    solver::AttachedFrame in;                   ///< of a pose
    std::optional<solver::AttachedFrame> hook;  ///< of a pose: what latches in the object
    std::vector<SignalSample> on_way;           ///< a ring of the last measurements
    std::size_t next = 0;
    double last_measured = -1.0;
    Noise noise{0};
  };
  SignalSample measured(Source& source, const Truth& truth, const solver::State& state) const noexcept;
  struct PlanarPose {
    double x = 0.0, y = 0.0, yaw = 0.0;
  };
  /// Of the object, or of its dock: there x points from the socket at the object's origin.
  PlanarPose seen_pose(const ObjectTruth& object, std::size_t number) const noexcept;
  double distance(const ObjectTruth& object, std::size_t number, const Truth& truth) const noexcept;

  solver::Model model_;
  std::vector<lang::SceneObject> objects_;
  std::vector<Source> sources_;
};

}  // namespace zwang::runtime
