#include "task_run.hpp"

#include <cmath>
#include <cstdio>

#include "../cli/run_json.hpp"
#include "drive_loop.hpp"
#include "observe.hpp"
#include "zwang/runtime/log_channels.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/with_unit.hpp"

namespace zwang::connect {

namespace {

constexpr std::uint64_t most_events = 20;  // that are printed

/// Why it is not `done`; empty where it is.
std::string reason_of(const runtime::Runner& runner) {
  const auto why = runner.why();
  const std::string because = runner.because();
  if (!why) return because;
  return because.empty() || runner.guard().stopped() ? why->sentence : why->sentence + "; " + because;
}

/// `done after 2.59 s`, and why it is not done.
std::string verdict_of(const runtime::Runner& runner, const DriveReport& report) {
  const std::string reason = reason_of(runner);
  char text[48];
  std::snprintf(text, sizeof text, "%s after %.2f s", runtime::to_string(runner.state()), report.elapsed);
  return text + (reason.empty() ? "" : ": " + reason);
}

void print_report(const runtime::Runner& runner, const DriveReport& report, const Inbox& inbox) {
  std::printf("%s\n", verdict_of(runner, report).c_str());
  const auto since_start = [&](double time) {
    return time > 0.5 * report.first_sample ? time - report.first_sample : time;
  };
  for (const runtime::Transition& t : runner.transitions())
    std::printf("  %8.2f s -> %s\n", since_start(t.time),
                runner.scheduler().tasks()[static_cast<std::size_t>(t.to)].name.c_str());
  std::uint64_t lost = 0, others = 0;
  for (const runtime::Event& e : runner.events()) {
    if (e.code == runtime::EventCode::sample_lost) {
      ++lost;
    } else if (++others <= most_events) {
      std::printf("  %8.2f s %s %s %g\n", since_start(e.time), runtime::to_string(e.code),
                  runner.event_signal(e).c_str(), e.value);
    }
  }
  if (lost > 0) std::printf("  %llu ticks without a new sample\n", static_cast<unsigned long long>(lost));
  if (others > most_events)
    std::printf("  .. and %llu events more\n", static_cast<unsigned long long>(others - most_events));
  if (report.silence) std::printf("stopped %.1f ms after the last sample\n", 1e3 * *report.silence);
  const Lateness& l = report.lateness;
  std::printf(
      "ticks %llu: late by median %.2f, p99 %.2f, p99.9 %.2f, most %.2f ms; skipped %llu, without a new "
      "sample %llu, unsent %llu\n",
      static_cast<unsigned long long>(l.ticks()), 1e3 * l.quantile(0.5), 1e3 * l.quantile(0.99),
      1e3 * l.quantile(0.999), 1e3 * l.most(), static_cast<unsigned long long>(report.skipped),
      static_cast<unsigned long long>(report.without_new), static_cast<unsigned long long>(report.unsent));
  print_topics(inbox);
  std::fflush(stdout);
}

std::unique_ptr<runtime::Recorder> recorder_for(const LogOrder& log,
                                                const std::optional<std::string>& named_robot,
                                                runtime::Runner& runner, const lang::Program& program,
                                                const lang::Diagnostics& diagnostics) {
  if (!log.file) return nullptr;
  runtime::LogContext context;
  context.sources = diagnostics.sources();
  context.facts = runner.facts();
  if (named_robot) context.facts["robot"] = *named_robot;
  if (log.rate) context.facts[runtime::log_rate_fact] = runtime::exactly(*log.rate);
  std::vector<std::unique_ptr<runtime::LogSink>> sinks;
  sinks.push_back(runtime::program_log(*log.file, log.rotation, context, program));
  if (log.rate) sinks.back() = runtime::thinned_sink(std::move(sinks.back()), *log.rate);
  auto recorder = std::make_unique<runtime::Recorder>(std::move(sinks), runner.columns());
  runner.record_to(recorder.get());
  return recorder;
}

/// As at the end of a log of `zwang run`, without the truth that only a simulation has.
std::map<std::string, std::string> conclusion_of(const runtime::Runner& runner, const DriveReport& report,
                                                 const lang::Diagnostics& diagnostics) {
  const std::string outcome = runtime::to_string(runner.state()), verdict = verdict_of(runner, report);
  nlohmann::ordered_json whole = {{"outcome", outcome},
                                  {"verdict", verdict},
                                  {"elapsed", report.elapsed},
                                  {"transitions", cli::json_transitions(runner, diagnostics)},
                                  {"events", cli::json_events(runner)},
                                  {"limits", cli::json_limits(runner, diagnostics)}};
  if (const std::string because = runner.because(); !because.empty()) whole["because"] = because;
  if (const auto why = runner.why()) whole["why"] = cli::json_of(*why);
  return {{"outcome", outcome}, {"verdict", verdict}, {"report", cli::text_of(whole)}};
}

void tell_incomplete(const runtime::RecorderStatus& log) {
  if (log.complete()) return;
  const std::string why =
      log.error.empty() ? std::to_string(log.dropped) + " records were dropped" : log.error;
  std::fprintf(stderr, "zwang drive: the log is incomplete: %s\n", why.c_str());
}

GoalOutcome outcome_of(const runtime::Runner& runner, const Control& control) {
  const bool is_requested = runner.guard().reason() == runtime::EventCode::requested;
  switch (runner.state()) {
    case runtime::RunState::done:
      return GoalOutcome::done;
    case runtime::RunState::stopped:
      return is_requested && control.wants_cancel() ? GoalOutcome::canceled : GoalOutcome::stopped;
    default:
      return GoalOutcome::failed;
  }
}

}  // namespace

std::string clock_trouble(const lang::Connection& connection, const lang::Program& program,
                          const Inbox& inbox) {
  char text[160];
  const double period = program.robot.control_period, longest = runtime::lost_ticks(period) * period;
  if (connection.clock && inbox.clock().step() > longest + 0.5 * period) {
    std::snprintf(
        text, sizeof text,
        " tells the time every %.3g s, and a robot that ticks every %.3g s is stopped after %.3g s: "
        "have the simulator tell it more often",
        inbox.clock().step(), period, longest);
    return connection.clock->name + text;
  }
  const double age = inbox.clock().time_at(inbox.joints().arrival) - inbox.joints().stamp;
  if (std::abs(age) <= connection.joints.stale_after) return "";
  std::snprintf(text, sizeof text, " is stamped %.3f s before it comes", age);
  return connection.joints.topic.name + text +
         (connection.clock
              ? ", by " + connection.clock->name + ", more than stale_after: one clock must stamp them"
              : ", more than stale_after: set both clocks (chrony), have the driver stamp its "
                "samples, or name a simulation's clock: `clock: {ros: /clock}`");
}

std::optional<std::string> numbered(const std::optional<std::string>& log, int number) {
  if (!log) return std::nullopt;
  const std::filesystem::path path = *log;
  const std::string name = path.stem().string() + "_" + std::to_string(number) + path.extension().string();
  return (path.parent_path() / name).string();
}

RunTaskResult run_task(const Robot& robot, const lang::Program& program, const lang::Diagnostics& diagnostics,
                       const LogOrder& log) {
  runtime::Runner runner(program);
  const auto recorder = recorder_for(log, robot.named_robot, runner, program, diagnostics);
  robot.control.enter(Phase::running);
  std::printf("the robot is there: the task begins\n");
  std::fflush(stdout);
  DriveReport report;
  drive(robot.connection, program, robot.inbox, robot.outbox, robot.control, runner, report);
  if (recorder) {
    recorder->conclude(conclusion_of(runner, report, diagnostics));
    recorder->close();
  }
  RunTaskResult result{outcome_of(runner, robot.control), reason_of(runner)};
  if (result.outcome == GoalOutcome::canceled) result.reason = "cancelled by its client; the base has braked";
  robot.control.end(runtime::to_string(runner.state()), result.reason);
  print_report(runner, report, robot.inbox);
  if (recorder) tell_incomplete(recorder->status());
  return result;
}

}  // namespace zwang::connect
