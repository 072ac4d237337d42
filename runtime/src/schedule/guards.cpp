#include "schedule/guards.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

GuardedExits::GuardedExits(const std::vector<lang::Exit>& given, int owner_task)
    : exits(given), owner(owner_task), compared(comparisons(given)) {
  for (const lang::Exit& exit : exits) decisions.emplace_back(exit.when, numbers);
  for (const Compared& one : compared) {
    const lang::Condition& condition = exits[one.exit].when;
    sides.push_back({numbers.add(condition, one.left), numbers.add(condition, one.right)});
  }
}

Guards::Guards(std::size_t most_exits, std::size_t most_nodes, std::size_t most_compared, double period,
               Unknown unknown)
    : states_(most_exits), values_(most_nodes), course_(most_compared), period_(period), unknown_(unknown) {}

void Guards::restart() noexcept {
  std::fill(states_.begin(), states_.end(), GuardState{});
  course_.restart();
}

void Guards::advance(GuardedExits& guarded, const Facts& facts,
                     const std::vector<double>& parameters) noexcept {
  guarded.numbers.forget();
  for (std::size_t i = 0; i < guarded.exits.size(); ++i) {
    const lang::Exit& exit = guarded.exits[i];
    GuardState& state = states_[i];
    std::optional<double> release;
    if (state.held && exit.release) release = exit.release->evaluate(parameters);
    const Judgement now =
        guarded.decisions[i].decide(guarded.owner, facts, guarded.numbers, values_, release);
    state.at_once = unknown_ == Unknown::fires_when_stale && now.verdict == Verdict::unknown && now.stale;
    const bool holds = now.verdict == Verdict::yes || state.at_once;
    // An unknown condition has not passed the release either.
    state.held = holds || (state.held && now.verdict == Verdict::unknown);
    if (holds && state.true_ticks == 0 && state.times < 1 << 30) ++state.times;
    state.true_ticks = holds ? std::min(state.true_ticks + 1, 1 << 30) : 0;
    state.longest_ticks = std::max(state.longest_ticks, state.true_ticks);
  }
  if (course_.advance()) keep(guarded, facts);
}

/// Of all comparisons, those too that are behind what decided a condition.
void Guards::keep(GuardedExits& guarded, const Facts& facts) noexcept {
  const auto value_of = [&](int number) {
    return guarded.numbers.look_up(number, guarded.owner, facts).value;
  };
  for (std::size_t i = 0; i < guarded.compared.size(); ++i) {
    const auto& [left, right] = guarded.sides[i];
    course_.keep(i, lack_between(value_of(left), value_of(right), guarded.compared[i].wants_less));
  }
}

bool Guards::is_due(const std::vector<lang::Exit>& exits, std::size_t exit,
                    const std::vector<double>& parameters) const noexcept {
  const GuardState& state = states_[exit];
  if (state.at_once) return true;
  if (state.true_ticks == 0) return false;
  const double needed = std::ceil(exits[exit].dwell.evaluate(parameters) / period_ - clock_rounding);
  return state.true_ticks >= std::max(1.0, needed);
}

}  // namespace zwang::runtime
