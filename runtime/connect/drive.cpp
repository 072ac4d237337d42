// The program behind `zwang drive`: a task on a robot that speaks ROS 2.
#include <chrono>
#include <cstdio>
#include <exception>
#include <thread>

#include "../cli/interruption.hpp"
#include "arguments.hpp"
#include "drive_loop.hpp"
#include "observe.hpp"
#include "zwang/runtime/log_channels.hpp"
#include "zwang/runtime/log_parts.hpp"
#include "zwang/runtime/recorder.hpp"

namespace {

using namespace zwang;
using namespace zwang::connect;

constexpr std::uint64_t most_events = 20;  // that are printed

void pause() {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

/// Until samples come and somebody listens. Says what is missing where it gives up.
bool wait_for_robot(const lang::Connection& connection, Inbox& inbox, const Outbox& outbox, double most,
                    runtime::Sensed& sensed) {
  const double until = now() + most;
  const auto is_there = [&] { return inbox.has_joints() && inbox.has_base() && outbox.readers() > 0; };
  for (; !is_there() && now() < until && !cli::is_interrupted(); pause()) inbox.fill(sensed);
  if (is_there()) return true;
  const char* missing = !inbox.has_joints() ? "no sample of every motor's joint on "
                        : !inbox.has_base() ? "no odometry on "
                                            : "nobody listens to ";
  const std::string& topic = !inbox.has_joints() ? connection.joints.topic.name
                             : !inbox.has_base() ? connection.base->name
                                                 : connection.command.topic.name;
  std::fprintf(stderr, "zwang drive: %s%s in domain %d within %g s; nothing was sent\n", missing,
               topic.c_str(), connection.domain, most);
  return false;
}

/// Until the service `start` is called. False: somebody ended it before.
bool wait_for_start(const lang::Connection& connection, Inbox& inbox, Control& control,
                    runtime::Sensed& sensed) {
  control.enter(Phase::ready);
  if (!connection.waits_for_start) return true;
  std::printf("the robot is there: waiting for the service %s/start\n", connection.name.c_str());
  std::fflush(stdout);
  for (; !control.wants_start(); pause()) {
    inbox.fill(sensed);
    if (cli::is_interrupted() || control.wants_stop()) return false;
  }
  inbox.fill(sensed);
  return true;
}

/// Stamps of another clock would make every sample old, or of the future.
bool clocks_agree(const lang::Connection& connection, const Inbox& inbox) {
  const double age = inbox.joints().arrival - inbox.joints().stamp;
  if (std::abs(age) <= connection.joints.stale_after) return true;
  std::fprintf(stderr,
               "zwang drive: %s is stamped %.3f s before it comes, more than stale_after: set both clocks "
               "(chrony), or have the driver stamp its samples; nothing was sent\n",
               connection.joints.topic.name.c_str(), age);
  return false;
}

void print_report(const runtime::Runner& runner, const DriveReport& report, const Inbox& inbox) {
  std::printf("%s after %.2f s", runtime::to_string(runner.state()), report.elapsed);
  if (const std::string because = runner.because(); !because.empty()) std::printf(": %s", because.c_str());
  std::printf("\n");
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

std::unique_ptr<runtime::LogSink> log_sink(const Arguments& arguments, const runtime::LogContext& context,
                                           const lang::Program& program) {
  const auto make = [program, context](const std::filesystem::path& path,
                                       const std::map<std::string, std::string>& facts) {
    runtime::LogContext of_part = context;
    of_part.facts.insert(facts.begin(), facts.end());
    return runtime::mcap_sink(path, std::move(of_part), runtime::scene_channels(program));
  };
  const std::filesystem::path path = *arguments.log;
  auto sink = arguments.rotation.is_asked()
                  ? runtime::rotating_sink(path.parent_path(), path.stem().string(), arguments.rotation, make)
                  : make(path, {});
  return arguments.log_rate ? runtime::thinned_sink(std::move(sink), *arguments.log_rate) : std::move(sink);
}

std::unique_ptr<runtime::Recorder> recorder_for(const Arguments& arguments, runtime::Runner& runner,
                                                const lang::Program& program,
                                                const lang::Diagnostics& diagnostics) {
  if (!arguments.log) return nullptr;
  runtime::LogContext context;
  context.sources = diagnostics.sources();
  context.facts = runner.facts();
  if (arguments.options.robot) context.facts["robot"] = arguments.options.robot->string();
  if (arguments.log_rate) context.facts[runtime::log_rate_fact] = std::to_string(*arguments.log_rate);
  std::vector<std::unique_ptr<runtime::LogSink>> sinks;
  sinks.push_back(log_sink(arguments, context, program));
  auto recorder = std::make_unique<runtime::Recorder>(std::move(sinks), runner.columns());
  runner.record_to(recorder.get());
  return recorder;
}

void tell_incomplete(const runtime::RecorderStatus& log) {
  if (log.complete()) return;
  const std::string why =
      log.error.empty() ? std::to_string(log.dropped) + " records were dropped" : log.error;
  std::fprintf(stderr, "zwang drive: the log is incomplete: %s\n", why.c_str());
}

int drive(const Arguments& arguments) {
  lang::Diagnostics diagnostics;
  const std::optional<Loaded> loaded = load(arguments, diagnostics);
  if (!loaded) return exit_bad;
  const lang::Connection& connection = loaded->connection;
  cli::catch_interruption();
  become_punctual(connection.priority);
  Inbox inbox(connection, loaded->program);
  Participant participant(connection.domain, connection.reach, "zwang");
  inbox.subscribe(participant);
  if (arguments.observe) return observe(connection, loaded->program, inbox, *arguments.observe);

  Outbox outbox(connection, loaded->program, participant);
  runtime::Sensed sensed(loaded->program);
  Control control(connection, loaded->program, participant,
                  [&] { return now() - inbox.last_arrival() < connection.joints.stale_after; });
  const bool is_ready = wait_for_robot(connection, inbox, outbox, arguments.wait, sensed) &&
                        wait_for_start(connection, inbox, control, sensed) && clocks_agree(connection, inbox);
  if (!is_ready) return exit_impossible;
  runtime::Runner runner(loaded->program);
  const auto recorder = recorder_for(arguments, runner, loaded->program, diagnostics);
  control.enter(Phase::running);
  std::printf("the robot is there: the task begins\n");
  std::fflush(stdout);
  DriveReport report;
  drive(connection, loaded->program, inbox, outbox, control, runner, report);
  control.end(runtime::to_string(runner.state()), runner.because());
  if (recorder) recorder->close();
  print_report(runner, report, inbox);
  if (recorder) tell_incomplete(recorder->status());
  if (participant.foreign() > 0)
    std::printf("%llu messages of other machines were not taken\n",
                static_cast<unsigned long long>(participant.foreign()));
  return runner.state() == runtime::RunState::done ? exit_good : exit_bad;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return drive(parse_arguments(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "zwang drive: %s\n", error.what());
    return exit_impossible;
  }
}
