/// The facts that a report shows of a run whose log is not kept.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/runtime/scenario_run.hpp"

namespace zwang::runtime {

/// The way of the base in few points of equal distance in time, however long the run is.
class PathWatch {
 public:
  void look(const Truth& truth);
  std::vector<std::array<double, 3>> path() const;  ///< where it was last, too

  static constexpr std::size_t most_points = 96;

 private:
  std::vector<std::array<double, 3>> points_;
  std::array<double, 3> last_{};
  std::size_t ticks_a_point_ = 1, since_ = 0;
};

/// After the run.
CellStory story_of(const Runner& runner, const PathWatch& watch);

}  // namespace zwang::runtime
