// N616: a position driver towards a pose signal that is taken to stand between two samples. It drives in axes
// on the signal, or a distance or a bearing to it. A target that goes on at v is trailed by 2 T v. The driver
// is critically damped, and its two damping terms count against frames that stand.
#include <cmath>

#include "diagnostic/wordings_forces.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

/// The pose signal, without a twist, that the frame hangs on.
const Signal* standing_signal(const CheckContext& context, int frame) {
  const int signal = context.symbols.signal_of(frame);
  if (signal < 0) return nullptr;
  const Signal& declared = context.symbols.signals[static_cast<std::size_t>(signal)].signal;
  return declared.twist == SignalTwist::none ? &declared : nullptr;
}

/// The signal of the frame whose axes they are; of a feature that of either of its frames.
const Signal* trailed_signal(const CheckContext& context, const PlannedAxis& axis) {
  if (!axis.is_feature()) {
    const std::optional<int> in = context.symbols.find_frame(axis.in_name);
    return in ? standing_signal(context, *in) : nullptr;
  }
  const std::optional<int> index = context.symbols.find_feature(axis.move_name);
  if (!index) return nullptr;
  const Feature& feature = context.symbols.features[static_cast<std::size_t>(*index)].feature;
  const Signal* first = standing_signal(context, feature.first);
  return first != nullptr ? first : standing_signal(context, feature.second);
}

/// A target shifts; whether it turns, too, nobody knows.
bool may_trail(const PlannedAxis& axis) {
  const bool follows_shifts = !axis.turns() || axis.measure == solver::Measure::bearing;
  return axis.driver == solver::Quantity::position && !axis.is_spring && follows_shifts &&
         axis.text != nullptr;
}

}  // namespace

void ask_trailing(const CheckContext& context, const PlannedTask& plan, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    const Signal* signal = may_trail(axis) ? trailed_signal(context, axis) : nullptr;
    const double v = signal != nullptr ? plan.speed_limit(axis) : 0.0;
    if (signal == nullptr || !std::isfinite(v) || !(v > 0.0)) continue;
    // The driver needs a margin to catch up: half of its speed.
    const double target = 0.5 * v;
    remarks.add(wording::trails_its_target(
        axis.driver_span(), axis.path,
        {target, 2.0 * axis.time_constant * target, axis.turns(), signal->name}, signal->span));
  }
}

}  // namespace zwang::lang
