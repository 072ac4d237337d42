// The reports of a run: its log, its limits, and the answers to a host.
#include <algorithm>

#include "run/runner_parts.hpp"

namespace zwang::runtime {

const char* to_string(RunState state) noexcept {
  switch (state) {
    case RunState::running:
      return "running";
    case RunState::done:
      return "done";
    case RunState::failed:
      return "failed";
    case RunState::stopped:
      return "stopped";
  }
  return "?";
}

void Runner::Parts::follow_limits() noexcept {
  limits.update(statements, scheduler.constraints(), scheduler.in_force(), solution, tau, blends());
}

void Runner::Parts::record(const Sensed& sensed, bool good, bool solved,
                           std::span<const double> extra) noexcept {
  // Behind a clock that stood a good sample may come before the time at which a refused one was due.
  logged = std::max(logged, good ? guard.time() : guard.refusal().time);
  const Shortfall shortfall = find_shortfall();
  const Tick tick{logged,       sensed, given_parameters, good ? estimated : sensed,
                  scheduler,    solved, solution,         solver_status,
                  guard_status, tau,    command,          extra,
                  shortfall,    event,  force_on_base(),  slip.speed()};
  recorder->record(layout.fill(statements, tick));
}

Shortfall Runner::Parts::find_shortfall() const noexcept {
  if (!is_solution_of_rows) return {};
  return runtime::find_shortfall(statements, scheduler.constraints(), scheduler.in_force(), solver, solution);
}

std::map<std::string, std::string> Runner::facts() const {
  RunFacts facts = parts_->facts;
  for (std::size_t i = 0; i < parts_->parameter_names.size(); ++i)
    facts["params." + parts_->parameter_names[i]] = exactly(parts_->scheduler.parameters()[i]);
  return facts;
}

RunState Runner::state() const noexcept {
  if (parts_->guard.stopped()) return RunState::stopped;
  switch (parts_->scheduler.outcome()) {
    case Outcome::done:
      return RunState::done;
    case Outcome::failed:
      return RunState::failed;
    case Outcome::none:
      break;
  }
  return RunState::running;
}

bool Runner::finished() const noexcept {
  if (parts_->guard.stopped()) return parts_->is_past_stop;
  return parts_->scheduler.phase() == Phase::finished;
}

bool Runner::may_still_move() const noexcept {
  if (parts_->guard.stopped()) return parts_->is_rest_doubted;
  return finished() && parts_->is_end_doubted;
}

std::string Runner::because() const {
  std::string words;
  if (parts_->guard.stopped()) words = describe(parts_->guard.reason());
  if (parts_->guard.motor_obeyed()) words += std::string("; ") + describe(EventCode::motor_obeyed);
  if (may_still_move()) words += (words.empty() ? "" : "; ") + std::string(unseen_rest);
  return words;
}

std::vector<Column> Runner::columns() const {
  return parts_->layout.columns();
}

void Runner::record_to(Recorder* recorder) noexcept {
  parts_->recorder = recorder;
}

const Command& Runner::command() const noexcept {
  return parts_->command;
}

std::span<const double> Runner::outputs() const noexcept {
  return parts_->command.outputs;
}

double Runner::period() const noexcept {
  return parts_->period;
}

const Scheduler& Runner::scheduler() const noexcept {
  return parts_->scheduler;
}

const SafetyGuard& Runner::guard() const noexcept {
  return parts_->guard;
}

SafetyGuard& Runner::guard() noexcept {
  return parts_->guard;
}

const solver::Solution& Runner::solution() const noexcept {
  return parts_->solution;
}

GuardStatus Runner::guard_status() const noexcept {
  return parts_->guard_status;
}

solver::Status Runner::solver_status() const noexcept {
  return parts_->solver_status;
}

const std::vector<Transition>& Runner::transitions() const noexcept {
  return parts_->transitions;
}

std::uint64_t Runner::transition_count() const noexcept {
  return parts_->transition_count;
}

const std::vector<Event>& Runner::events() const noexcept {
  return parts_->events;
}

std::uint64_t Runner::event_count() const noexcept {
  return parts_->event_count;
}

std::string Runner::event_signal(const Event& event) const {
  const auto i = static_cast<std::size_t>(event.signal);
  return event.signal >= 0 && i < parts_->signal_words.size() ? parts_->signal_words[i] : std::string();
}

solver::Vector3 Runner::estimated_force() const noexcept {
  return parts_->force_on_base();
}

const solver::State& Runner::estimated_state() const noexcept {
  return parts_->estimated.state;
}

void Runner::tell(EventCode code, int signal, double value) noexcept {
  if (!latches_the_stop(code)) parts_->told_by_host = {code, 0.0, signal, value};
}

bool Runner::set_parameter(std::string_view name, double value) noexcept {
  for (std::size_t i = 0; i < parts_->parameter_names.size(); ++i) {
    if (parts_->parameter_names[i] == name)
      return parts_->scheduler.set_parameter(static_cast<int>(i), value);
  }
  return false;
}

std::vector<LimitReport> Runner::limits() const {
  return parts_->limits.reports();
}

std::optional<LimitReport> Runner::limit_now() const {
  return parts_->limits.now();
}

std::optional<ShortfallReport> Runner::shortfall() const {
  const Shortfall s = parts_->find_shortfall();
  if (s.missed < 0) return std::nullopt;
  const auto name = [&](int statement, const Origin& origin) {
    const std::string part = parts_->scheduler.part_name(origin);
    const std::string& whole = parts_->statements.all()[static_cast<std::size_t>(statement)].name;
    return part.empty() ? whole : whole + "." + part;
  };
  ShortfallReport report;
  report.row = name(s.missed, s.origin);
  report.residual = s.residual;
  const Statement& missed = parts_->statements.all()[static_cast<std::size_t>(s.missed)];
  report.unit = unit_of(missed.says.axis, solver::Quantity::acceleration);
  for (int i = 0; i < s.count; ++i) {
    const Shortfall::Holder& by = s.held_by[static_cast<std::size_t>(i)];
    report.held_back_by.push_back(name(by.statement, by.origin));
  }
  return report;
}

namespace {

/// [m] that wheels slid while the guard saw it. Less is a jolt at a contact, and keeps no base from its way.
constexpr double told_slide = 0.01;

/// The frame and the region of a limit's row, where it is a region's.
std::string kept_by(const std::optional<LimitReport>& limit, const StatementTable& statements) {
  if (!limit) return {};
  const auto row = std::ranges::find_if(
      statements.all(), [&](const Statement& s) { return s.inside && s.name + ".left" == limit->row; });
  return row == statements.all().end() ? "" : "`" + row->frame + "` inside `" + row->region + "`";
}

/// Of a row that was left the first event is enough; of another kind of events, too.
bool is_told_already(const std::vector<Event>& kinds, const Event& event) {
  return std::ranges::any_of(kinds, [&](const Event& one) {
    return one.code == event.code && (event.code != EventCode::outside || one.signal == event.signal);
  });
}

}  // namespace

std::optional<Why> Runner::why() const {
  if (state() == RunState::done) return std::nullopt;
  const Parts& p = *parts_;
  const bool goes_on_for_ever = state() == RunState::running && !p.turning_point.leads_to_done();
  const bool is_decided = !p.guard.stopped() && p.turning_point.found() && !goes_on_for_ever;
  EndOfRun end{.scheduler = p.scheduler,
               .turning_point = p.turning_point,
               .is_decided = is_decided,
               .file = p.facts.at("task"),
               .time = p.guard.time(),
               .limit = p.limits.report_of(is_decided ? p.turning_point.limit() : p.limits.tightest()),
               .limit_keeps = {},
               .stop = {},
               .refused = {},
               .met = {},
               .told = {}};
  end.limit_keeps = kept_by(end.limit, p.statements);
  if (p.guard.stopped()) end.stop = describe_stop();
  const double until = is_decided ? p.turning_point.found()->time : end.time;
  const int first = event_signal::measured(p.model.joint_count(), 0);
  const int first_row = first + static_cast<int>(p.signals.size());
  std::vector<Event> kinds;
  // A robot's clock may count from 1970 on.
  const double began = p.transitions.empty() ? 0.0 : p.transitions.front().time;
  for (const Event& told : p.events) {
    if (told.code == EventCode::signal_refused && told.signal >= first) {
      end.refused.push_back({p.signals[static_cast<std::size_t>(told.signal - first)].name, told.value});
    } else if (told.code == EventCode::motor_obeyed) {
      continue;  // describe_stop says it
    } else if (!latches_the_stop(told.code) && !is_told_already(kinds, told) && told.time <= until) {
      kinds.push_back(told);
      const std::string at = with_unit(told.time - began, "s");
      if (told.code == EventCode::outside && told.signal >= first_row) {
        const bool at_start = !p.transitions.empty() && told.time <= began;
        Event in_run = told;
        in_run.time -= began;
        end.met.push_back(
            words_of_excursion(p.statements.all()[static_cast<std::size_t>(told.signal - first_row)], in_run,
                               at_start, p.limits.reports()));
      } else if (told.code == EventCode::slip && p.slip.way() > told_slide) {
        end.met.push_back("wheels slid over the floor by " + with_unit(p.slip.way(), "m") + " in all, from " +
                          at + " on");
      } else {
        end.told.push_back("the guard told at " + at + ": " + describe(told.code));
      }
    }
  }
  return why_of(end);
}

/// The stop, with the signal that showed it and that signal's value.
std::string Runner::describe_stop() const {
  const Event& stop = parts_->guard.stop_event();
  const std::string signal = event_signal(stop);
  return std::string(describe(stop.code)) + (signal.empty() ? "" : " (`" + signal + "`)") +
         (parts_->guard.motor_obeyed() ? std::string("; ") + describe(EventCode::motor_obeyed) : "");
}

}  // namespace zwang::runtime
