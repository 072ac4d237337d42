// N616: a position driver in axes on a pose signal that is taken to stand between two samples. A target that
// goes on at v is trailed by 2 T v: the driver is critically damped, and its two damping terms count against
// axes that stand.
#include <cmath>

#include "diagnostic/wordings_forces.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

/// The pose signal, without a twist, that the frame hangs on.
const Signal* standing_signal(const CheckContext& context, const std::string& frame) {
  const std::optional<int> index = context.symbols.find_frame(frame);
  const int signal = index ? context.symbols.signal_of(*index) : -1;
  if (signal < 0) return nullptr;
  const Signal& declared = context.symbols.signals[static_cast<std::size_t>(signal)].signal;
  return declared.twist == SignalTwist::none ? &declared : nullptr;
}

}  // namespace

void ask_trailing(const CheckContext& context, const PlannedTask& plan, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    const bool is_asked =
        axis.driver == solver::Quantity::position && !axis.is_spring && !axis.turns() && axis.text != nullptr;
    const Signal* signal = is_asked ? standing_signal(context, axis.in_name) : nullptr;
    const double v = signal != nullptr ? plan.speed_limit(axis) : 0.0;
    if (signal == nullptr || !std::isfinite(v) || !(v > 0.0)) continue;
    // The driver needs a margin to catch up: half of its speed.
    const double target = 0.5 * v;
    remarks.add(wording::trails_its_target(axis.driver_span(), axis.path, target,
                                           2.0 * axis.time_constant * target, signal->name, signal->span));
  }
}

}  // namespace zwang::lang
