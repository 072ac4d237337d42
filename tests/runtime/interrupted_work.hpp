/// A task that a signal interrupts, and the conditions on that signal.
#pragma once

#include "scheduler_bench.hpp"

namespace zwang::runtime::test {

using lang::SignalType;

inline const std::vector<AxisStatements> forward = {drive("go.x", Axis::x, Quantity::velocity, 0.1)};
inline const std::vector<AxisStatements> standing = {drive("go.x", Axis::x, Quantity::velocity, 0.0)};

inline Nodes heard(int signal) {
  return name(Op::signal, signal);
}
inline Nodes below(int signal, double threshold) {
  return apply(Op::less, heard(signal), number(threshold));
}
inline Nodes above(int signal, double threshold) {
  return apply(Op::greater, heard(signal), number(threshold));
}

/// `work` is interrupted by `pause` while the signal 0 is below 1; `pause` leads back when it is above 2.
inline lang::Program interrupted_work() {
  lang::Task work = task("work", forward), pause = task("pause", standing);
  work.exits = {exit(after(1e6), to_done)};
  pause.exits = {exit(when(above(0, 2.0)), back)};
  lang::Program p = program({work, pause});
  p.signals = {signal("near", SignalType::number, 1e9), signal("extra", SignalType::number, 1e9)};
  p.always.exits = {exit(when(below(0, 1.0)), to_task(1))};
  return p;
}
inline constexpr int work = 0, pause = 1;

}  // namespace zwang::runtime::test
