/// Which hook holds the base, as signals of the task file say it.
#pragma once

#include <string>
#include <vector>

#include "guard/blind_budget.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

/// A hook whose play is below a step of the encoders does not answer a look; neither do dead encoders. A
/// sensor of its own tells them apart: a signal that `holds` a frame of the base. The signal counts from its
/// rising edge, which came while encoders were alive, until it is false or stale. A partner that rolls along
/// holds nothing, so the signal does not excuse a task that asks for motion. Does not allocate, lock, throw
/// or print after construction.
class HookLatch {
 public:
  explicit HookLatch(const lang::Program& program);

  /// Every good sample, before the budget looks at it. Its signals are those of the program, in its order.
  /// `is_to_move`: the task asks for motion.
  void look(const Sensed& sample, const std::vector<double>& parameters, bool is_to_move,
            BlindBudget& budget) noexcept;
  /// At a swap of programs: what the signals of the same names have said so far.
  void take_over(const HookLatch& before) noexcept;

 private:
  struct Latch {
    std::string name;
    std::size_t signal = 0;
    lang::Value stale_after;
    double x = 0.0, y = 0.0;  ///< [m] of the frame that is held, in the base
    double stamp = 0.0;       ///< [s] of the last valid sample
    bool is_known = false;
    bool is_closed = false;  ///< it said
    bool was_open = false;   ///< since it was last taken for closed
    bool holds = false;
  };
  static bool is_new(const Latch& latch, const SignalSample& said, double now) noexcept;

  std::vector<Latch> latches_;
};

}  // namespace zwang::runtime
