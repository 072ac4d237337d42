/// The hands of a scene: who presses where, and when.
#pragma once

#include <span>
#include <vector>

#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::runtime {

class SceneHands {
 public:
  /// `first` is the first robot's model. The programs of the scene's robots are loaded.
  SceneHands(const lang::Scene& scene, const solver::Model& first);

  /// The number of hands, over the whole run.
  std::size_t size() const noexcept { return hands_.size(); }
  /// The hands that press at `time` [s]; until the next call.
  std::span<const BodyPush> at(double time) noexcept;

 private:
  struct Hand {
    double begin, end;  ///< [s]
    BodyPush push;
  };
  std::vector<Hand> hands_;
  std::vector<BodyPush> pressing_;
};

}  // namespace zwang::runtime
