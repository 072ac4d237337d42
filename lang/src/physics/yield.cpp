// W618, E417: a driver that yields, dds = (F~ - D ds)/M, rings when something stiff holds it.
//
// It presses with nu = Lambda (F~ - D ds)/M - F, Lambda the effective mass. F is known t_f late: by 20 ms
// where it is estimated, else by the signal's delay and period. Held by a spring k,
//
//   Lambda dds = -k s + nu,     t_f dF~ = -k s - F~
//
// is a polynomial of the third degree. By Routh's criterion it decays for any k if M + t_f D >= Lambda, else
// while
//
//   k < D (M + t_f D) Lambda / (t_f M (Lambda - M - t_f D))
//
// A hand is as stiff as a few kN/m, a clamp as a hundred.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_forces.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double estimate_lag = 0.02;   // [s] of the contact force that is estimated
constexpr double stiff_hand = 20e3;     // [N/m]
constexpr double softest_holder = 1e3;  // [N/m]

double lag_of_signal(const CheckContext& context, const std::optional<Scene>& scene, int signal) {
  if (!scene) return 0.0;
  const std::string& name = context.symbols.signals[static_cast<std::size_t>(signal)].signal.name;
  const auto found = std::find_if(scene->signals.begin(), scene->signals.end(),
                                  [&](const SceneSignal& given) { return given.name == name; });
  return found == scene->signals.end() ? 0.0 : found->delay + found->period;
}

/// How late the force is known. [s] 0: it is no measurement.
double lag_of(const CheckContext& context, const std::optional<Scene>& scene, const Condition& force,
              double dt) {
  double lag = 0.0;
  for (const ExpressionNode& node : force.nodes) {
    const bool is_estimated = node.op == Op::estimated_force || node.op == Op::estimated_wrench;
    if (is_estimated) lag = std::max(lag, estimate_lag);
    if (node.op == Op::signal) lag = std::max({lag, dt, lag_of_signal(context, scene, node.index)});
  }
  return lag;
}

}  // namespace

void ask_yields(const CheckContext& context, const PlannedTask& plan, const std::optional<Scene>& scene,
                Probe& probe, Remarks& remarks) {
  // A drive that takes velocities moves the virtual robot, which no hand holds.
  if (context.robot->drive.takes_velocity || context.yields == nullptr) return;
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis.is_yield || axis.turns() || !axis.yield_mass || !axis.damping) continue;
    const auto force = context.yields->find(axis.text);
    const AxisFigures* figures = force != context.yields->end() ? probe.figures(axis) : nullptr;
    if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
    const double lag = lag_of(context, scene, force->second, probe.robot().control_period);
    const double M = *axis.yield_mass, D = *axis.damping, Lambda = figures->mass;
    const double short_of = Lambda - M - lag * D;
    if (!(lag > 0.0) || !(M > 0.0) || !(D > 0.0) || !(short_of > 0.0)) continue;
    const double stiffest = D * (M + lag * D) * Lambda / (lag * M * short_of);
    if (stiffest >= stiff_hand) continue;
    remarks.add(wording::rings_when_held(axis.yield_mass_span, axis.path,
                                         {stiffest, Lambda, lag, Lambda - lag * D},
                                         stiffest < softest_holder));
  }
}

}  // namespace zwang::lang
