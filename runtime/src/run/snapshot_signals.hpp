/// Where a snapshot has the signals of a program.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

/// The host fills its snapshots by the signals of the program that its runner was made with. A program that
/// is swapped in finds its own among them by name, type and frame, in whatever order. Does not allocate,
/// lock, throw or print after construction.
class SnapshotSignals {
 public:
  explicit SnapshotSignals(const lang::Program& program);

  /// Of each signal of the program: its index in `Sensed::signals`.
  const std::vector<std::size_t>& places() const noexcept { return places_; }
  std::size_t size() const noexcept { return measured_.size(); }  ///< of `Sensed::signals`

  /// Whether all signals of this program are among those that `before` measures.
  SwapResult match(const SnapshotSignals& before) const noexcept;
  /// From now on the snapshots are those of `before`, which `match` accepted.
  void go_on_from(SnapshotSignals& before) noexcept;

 private:
  struct Signal {
    std::string name, frame;
    lang::SignalType type;
  };
  static const Signal* find(const std::vector<Signal>& signals, const std::string& name) noexcept;

  std::vector<Signal> own_;
  std::vector<Signal> measured_;
  std::vector<std::size_t> places_;
};

}  // namespace zwang::runtime
