/// Keeps measured contact away from rows that would push against it.
#pragma once

#include <optional>
#include <span>

#include "zwang/runtime/event.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/solver.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// A row that knows the force from outside cancels it: pressed with 15 N, it presses 15 N harder, up to its
/// bound. Along an axis whose force a task drives or limits, f_ext is therefore not for the solver. Does not
/// allocate, lock, throw or print after construction.
class WrenchRefusal {
 public:
  explicit WrenchRefusal(const solver::Model& model) : model_(model) {}

  /// Removes from the wrenches on the bodies the part along the rows of `sets` that drive or limit a force.
  /// It is taken from forces along their directions and from moments about their axes. An event when the
  /// removed part begins to exceed `threshold`, and not again before a second without it.
  std::optional<Event> look(std::span<const solver::RowSet> sets, solver::State& state, double time) noexcept;

  static constexpr double threshold = 1.0;  ///< [N] or [N m]
  static constexpr double pause = 1.0;      ///< [s]

 private:
  const solver::Model& model_;
  std::optional<double> last_;  ///< [s] when more than the threshold was refused
};

}  // namespace zwang::runtime
