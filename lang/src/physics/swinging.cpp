// W648: a spring that still swings when its task's time is over.
//
//   Lambda dds = -k s - D ds          Lambda the effective mass
//
// If D^2 < 4 k Lambda, the axis swings with w = sqrt(k/Lambda - (D/(2 Lambda))^2), and a swing of 1 is one of
//
//   exp(-D t / (2 Lambda))
//
// after the time t. It is told where half of it is left at the timeout. A half swing, pi/w, has to fit into
// that time: a shorter task ends while the spring still pulls one way.
#include <cmath>
#include <numbers>

#include "check/parameter_values.hpp"
#include "diagnostic/wordings_forces.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double most_left = 0.5;  ///< of the swing at the timeout

}  // namespace

void ask_swinging(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  if (!plan.task->timeout || plan.task->timeout->is_never) return;
  const std::optional<double> time = known_value(context, plan.task->timeout->after, dimension::time);
  if (!time) return;
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis.is_spring || !axis.stiffness || !axis.damping || !(*axis.damping > 0.0)) continue;
    const AxisFigures* figures = probe.figures(axis);
    if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
    const double k = *axis.stiffness, D = *axis.damping, Lambda = figures->mass;
    const double decay = D / (2.0 * Lambda);  // [1/s]
    const double w_squared = k / Lambda - decay * decay;
    if (!(w_squared > 0.0) || std::numbers::pi > std::sqrt(w_squared) * *time) continue;
    const double left = std::exp(-decay * *time);
    if (left <= most_left) continue;
    remarks.add(wording::swings_on(axis.damping_span, axis.path, axis.turns(),
                                   {Lambda, left, *time, 2.0 * std::sqrt(k * Lambda)}));
  }
}

}  // namespace zwang::lang
