#include "guard/hook_latch.hpp"

#include <algorithm>

namespace zwang::runtime {

namespace {

/// Of a frame that the base carries.
solver::Vector3 position_in_base(const lang::Program& program, int index) {
  solver::Vector3 position = solver::Vector3::Zero();
  for (int i = index; i >= 0;) {
    const lang::FrameDeclaration& frame = program.frames[static_cast<std::size_t>(i)];
    position = frame.pose.position + frame.pose.rotation * position;
    i = frame.parent == lang::FrameParent::frame ? frame.parent_index : -1;
  }
  return position;
}

}  // namespace

HookLatch::HookLatch(const lang::Program& program) {
  for (std::size_t i = 0; i < program.signals.size(); ++i) {
    const lang::Signal& signal = program.signals[i];
    if (signal.holds < 0) continue;
    const solver::Vector3 at = position_in_base(program, signal.holds);
    latches_.push_back(
        {.name = signal.name, .signal = i, .stale_after = signal.stale_after, .x = at.x(), .y = at.y()});
  }
}

bool HookLatch::is_new(const Latch& latch, const SignalSample& said, double now) noexcept {
  return said.valid && said.stamp <= now && (!latch.is_known || said.stamp > latch.stamp);
}

void HookLatch::look(const Sensed& sample, const std::vector<double>& parameters, bool is_to_move,
                     BlindBudget& budget) noexcept {
  const Latch* holding = nullptr;
  for (Latch& latch : latches_) {
    const SignalSample& said = sample.signals[latch.signal];
    if (is_new(latch, said, sample.time)) {
      latch.is_known = true;
      latch.stamp = said.stamp;
      latch.is_closed = said.boolean;
    }
    const bool is_fresh =
        latch.is_known && sample.time - latch.stamp <= latch.stale_after.evaluate(parameters);
    const bool is_closed = is_fresh && latch.is_closed;
    const bool rises = is_closed && latch.was_open;
    latch.holds = is_closed && (latch.holds || (rises && !budget.takes_over()));
    latch.was_open = !is_closed && (is_fresh || latch.was_open);
    if (latch.holds) holding = &latch;
  }
  if (holding != nullptr) {
    budget.tie(holding->x, holding->y, is_to_move);
  } else {
    budget.untie();
  }
}

void HookLatch::take_over(const HookLatch& before) noexcept {
  for (Latch& latch : latches_) {
    for (const Latch& known : before.latches_) {
      if (known.name != latch.name) continue;
      latch.stamp = known.stamp;
      latch.is_known = known.is_known;
      latch.is_closed = known.is_closed;
      latch.was_open = known.was_open;
      latch.holds = known.holds;
    }
  }
}

}  // namespace zwang::runtime
