#include "run_json.hpp"

#include <algorithm>

#include "output.hpp"

namespace zwang::cli {

using nlohmann::ordered_json;
using runtime::LimitReport;
using runtime::Transition;

std::string task_name(const runtime::Scheduler& scheduler, int task) {
  return task < 0 ? "-" : scheduler.tasks()[static_cast<std::size_t>(task)].name;
}

std::vector<std::string> also_true(const runtime::Scheduler& scheduler, const Transition& t) {
  std::vector<std::string> all;
  const auto add = [&](int owner, std::uint64_t bits) {
    const std::vector<lang::Exit>& exits = scheduler.tasks()[static_cast<std::size_t>(owner)].exits;
    for (std::size_t i = 0; i < exits.size() && i < 64; ++i) {
      if ((bits >> i & 1U) != 0U) all.push_back(exits[i].when.text);
    }
  };
  add(scheduler.always_task(), t.also_always);
  if (t.also_timeout) all.push_back("timeout");
  if (t.from >= 0) add(t.from, t.also_true);
  return all;
}

std::vector<LimitReport> broken_first(std::vector<LimitReport> limits) {
  std::stable_partition(limits.begin(), limits.end(), [](const LimitReport& l) { return l.is_broken(); });
  return limits;
}

ordered_json json_transitions(const runtime::Runner& runner, const lang::Diagnostics& diagnostics) {
  const runtime::Scheduler& scheduler = runner.scheduler();
  ordered_json all = ordered_json::array();
  for (const Transition& t : runner.transitions()) {
    std::string why = scheduler.why_with_note(t);
    const std::string where = place(diagnostics, scheduler.where(t));
    if (!where.empty()) why += " (" + where + ")";
    ordered_json one = {
        {"time", t.time}, {"from", nullptr}, {"to", task_name(scheduler, t.to)}, {"why", why}};
    if (t.from >= 0) one["from"] = task_name(scheduler, t.from);
    one["also_true"] = also_true(scheduler, t);
    all.push_back(one);
  }
  return all;
}

ordered_json json_limits(const runtime::Runner& runner, const lang::Diagnostics& diagnostics) {
  ordered_json limits = ordered_json::array();
  for (const LimitReport& l : broken_first(runner.limits())) {
    limits.push_back({{"row", l.row},
                      {"line", l.span.exists() ? ordered_json(l.span.begin.line) : ordered_json(nullptr)},
                      {"limit", l.limit},
                      {"worst", l.worst},
                      {"margin", l.margin},
                      {"broken", l.is_broken()},
                      {"unit", l.unit},
                      {"where", place(diagnostics, l.span)}});
  }
  return limits;
}

ordered_json json_events(const runtime::Runner& runner) {
  ordered_json all = ordered_json::array();
  for (const runtime::Event& e : runner.events()) {
    all.push_back({{"time", e.time},
                   {"code", to_string(e.code)},
                   {"signal", runner.event_signal(e)},
                   {"value", finite_or_null(e.value)}});
  }
  return all;
}

}  // namespace zwang::cli
