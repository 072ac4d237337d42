#include "control.hpp"

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "clock.hpp"
#include "message.hpp"
#include "overrun.hpp"

namespace zwang::connect {

namespace {

constexpr auto tell_every = std::chrono::milliseconds(100);
constexpr int at_least_every = 10;  // of these

const char* word_of(Phase phase) {
  switch (phase) {
    case Phase::waiting:
      return "waiting";
    case Phase::ready:
      return "ready";
    case Phase::running:
      return "running";
    case Phase::latched:
      return "latched";
    case Phase::ended:
      break;
  }
  return "ended";
}

}  // namespace

Control::Control(const lang::Connection& connection, const lang::Program& program, Participant& participant,
                 std::function<bool()> is_alive)
    : connection_(connection),
      participant_(participant),
      is_alive_(std::move(is_alive)),
      writer_(participant.advertise(connection.name + "/state", "std_msgs/String", Late::gets_last)),
      health_writer_(participant.advertise("/diagnostics", "diagnostic_msgs/DiagnosticArray")),
      program_(&program) {
  serve("/start", &Control::start);
  serve("/stop", &Control::stop);
  if (connection.begin != lang::Begin::at_once) serve("/reset", &Control::reset);
  parameters_.serve_for(program);
  for (const ParameterService& service : parameter_services) {
    participant.serve(
        connection.name + "/" + service.name, service.type,
        [this, handle = service.handle](std::span<const std::uint8_t> fields, const Reply& reply) {
          (parameters_.*handle)(fields, reply);
        });
  }
  if (connection.begin == lang::Begin::goals) serve_goals();
  if (connection.publication)
    base_teller_ =
        std::make_unique<BaseTeller>(*connection.publication, program.robot.base_frame, participant);
  thread_ = std::thread([this] { tell_changes(); });
}

Control::~Control() {
  participant_.stop_serving();
  {
    const std::lock_guard lock(changing_);
    is_over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Control::enter(Phase phase) noexcept {
  {
    const std::lock_guard lock(changing_);
    phase_ = phase;
  }
  changed_.notify_one();
}

void Control::serve(const std::string& name, TriggerReply (Control::*answer)()) {
  participant_.serve(connection_.name + name, "std_srvs/srv/Trigger",
                     trigger_handler([this, answer] { return (this->*answer)(); }));
}

void Control::serve_goals() {
  const std::string action = connection_.name + "/run/_action/";
  status_writer_ = participant_.advertise(action + "status", goal_status_type, Late::gets_last);
  feedback_writer_ = participant_.advertise(action + "feedback", run_task_feedback_type);
  goals_ = std::make_unique<RunTaskServer>(
      [this] { return phase_ == Phase::ready && !wants_stop_ && is_alive_(); },
      [this](const Bytes& payload) { status_writer_->write(payload); },
      [this](const Bytes& payload) { feedback_writer_->write(payload); });
  for (const ActionService& service : run_task_services) {
    participant_.serve(
        action + service.name, service.type,
        [this, handle = service.handle](std::span<const std::uint8_t> fields, const Reply& reply) {
          (goals_.get()->*handle)(fields, reply);
        });
  }
}

TriggerReply Control::start() {
  if (connection_.begin == lang::Begin::goals)
    return {false, "tasks begin with goals of the action " + connection_.name + "/run"};
  if (connection_.begin == lang::Begin::at_once)
    return {false, "the task begins at once: the connection file has no `start: wait`"};
  const Phase phase = phase_;
  if (phase == Phase::running) return {false, "the task runs already"};
  if (phase == Phase::ended) return {false, "the task is over"};
  if (phase == Phase::latched)
    return {false, "the protective stop is latched: call " + connection_.name + "/reset first"};
  if (phase == Phase::waiting || !is_alive_()) return {false, "no samples come from the robot"};
  wants_start_ = true;
  return {true, "the task begins"};
}

TriggerReply Control::stop() {
  wants_stop_ = true;
  return {true, phase_ == Phase::running ? "it brakes, and the run ends" : "nothing moves"};
}

TriggerReply Control::reset() {
  Phase phase = Phase::latched;
  const std::string next = connection_.begin == lang::Begin::goals
                               ? "goals are taken again"
                               : connection_.name + "/start begins the task anew";
  if (phase_.compare_exchange_strong(phase, Phase::ready)) {
    changed_.notify_one();
    return {true, next};
  }
  return {phase == Phase::ready, phase == Phase::ready ? "nothing is latched" : "it is not at rest"};
}

void Control::speak_of(const lang::Program& program) {
  parameters_.serve_for(program);
  const std::lock_guard lock(mutex_);
  program_ = &program;
  note(-1, 0.0, -1.0, 0.0);
  outcome_.clear();
  reason_.clear();
}

/// Behind the program's tasks follow those that brake. `mutex_` is held.
std::string Control::task_name() const {
  const int task = task_;
  const auto count = static_cast<int>(program_->tasks.size());
  return task >= 0 && task < count ? program_->tasks[static_cast<std::size_t>(task)].name : "";
}

std::string Control::state() const {
  const std::lock_guard lock(mutex_);
  const Phase phase = phase_;
  const std::string task = task_name();
  nlohmann::ordered_json json;
  json["state"] = phase == Phase::ended && !outcome_.empty() ? outcome_ : word_of(phase);
  json["task"] = nullptr;
  if (!task.empty()) json["task"] = task;
  json["elapsed"] = std::round(10.0 * elapsed_) / 10.0;
  json["reason"] = reason_;
  // A name or a reason may hold any bytes: those that are no UTF-8 are replaced.
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// For `diagnostic_aggregator` and `rqt_robot_monitor`. Silence of the robot is `stale` while a task runs.
/// `skipped`: control cycles since the last report.
DiagnosticArray Control::health(std::uint64_t skipped) const {
  const std::lock_guard lock(mutex_);
  const Phase phase = phase_;
  const bool has_failed = phase == Phase::latched || outcome_ == "stopped" || outcome_ == "failed";
  DiagnosticStatus status;
  status.name = connection_.name.substr(1) + ": task";
  status.hardware = program_->robot.name;
  status.message = phase == Phase::ended && !outcome_.empty() ? outcome_ : word_of(phase);
  if (!reason_.empty()) status.message += ": " + reason_;
  if (has_failed) {
    status.level = DiagnosticStatus::error;
  } else if (phase != Phase::ended && !is_alive_()) {
    status.level = phase == Phase::waiting ? DiagnosticStatus::warn : DiagnosticStatus::stale;
    status.message += "; no samples come from the robot";
  } else if (skipped >= Overrun::many) {
    status.level = DiagnosticStatus::warn;
    status.message += "; this computer is late: " + std::to_string(skipped) + " control cycles were skipped";
  }
  status.values = {{"task", task_name()}, {"elapsed [s]", std::to_string(elapsed_.load())}};
  return {header_at(now()), {status}};
}

void Control::end(const std::string& outcome, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  outcome_ = outcome;
  reason_ = reason;
}

/// The state goes out as soon as the phase is another one, within 0.1 s of another task, and once a second.
/// While a goal is driven, its feedback goes out each time.
void Control::tell_changes() {
  Bytes bytes;
  Phase last_phase = Phase::ended;
  int last_task = -2, since = at_least_every;
  std::uint64_t told_skipped = 0;
  for (bool is_last = false; !is_last;) {
    {
      std::unique_lock lock(changing_);
      changed_.wait_for(lock, tell_every, [&] { return is_over_ || phase_ != last_phase; });
    }
    is_last = is_over_;
    const Phase phase = phase_;
    const int task = task_;
    if (goals_ && phase == Phase::running) {
      RunTaskFeedback feedback{"", elapsed_, progress_, force_};
      {
        const std::lock_guard lock(mutex_);
        feedback.task = task_name();
      }
      goals_->tell(feedback);
    }
    if (phase == last_phase && task == last_task && ++since < at_least_every && !is_last) continue;
    last_phase = phase, last_task = task, since = 0;
    encode(String{state()}, bytes);
    writer_->write(bytes);
    const std::uint64_t skipped = skipped_;
    encode(health(skipped > told_skipped ? skipped - told_skipped : 0), bytes);
    told_skipped = skipped;
    health_writer_->write(bytes);
  }
  std::this_thread::sleep_for(tell_every);  // DDS sends the last word meanwhile
}

}  // namespace zwang::connect
