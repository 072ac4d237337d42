#include "control.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>

#include "message.hpp"

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
    case Phase::ended:
      break;
  }
  return "ended";
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string json = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      json += {'\\', c};
    } else if (byte < 0x20) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04x", byte);
      json += escaped;
    } else {
      json += c;
    }
  }
  return json + "\"";
}

Control::Control(const lang::Connection& connection, const lang::Program& program, Participant& participant,
                 std::function<bool()> is_alive)
    : connection_(connection),
      program_(program),
      participant_(participant),
      is_alive_(std::move(is_alive)),
      writer_(participant.advertise_last(connection.name + "/state", "std_msgs/String")) {
  participant.serve_trigger(connection.name + "/start", [this] { return start(); });
  participant.serve_trigger(connection.name + "/stop", [this] { return stop(); });
  thread_ = std::thread([this] { tell_changes(); });
}

Control::~Control() {
  participant_.stop_serving();
  is_over_ = true;
  thread_.join();
}

TriggerReply Control::start() {
  if (!connection_.waits_for_start)
    return {false, "the task begins at once: the connection file has no `start: wait`"};
  const Phase phase = phase_;
  if (phase == Phase::running) return {false, "the task runs already"};
  if (phase == Phase::ended) return {false, "the task is over"};
  if (phase == Phase::waiting || !is_alive_()) return {false, "no samples come from the robot"};
  wants_start_ = true;
  return {true, "the task begins"};
}

TriggerReply Control::stop() {
  wants_stop_ = true;
  return {true, phase_ == Phase::running ? "it brakes, and the run ends" : "nothing moves"};
}

std::string Control::state() const {
  const std::lock_guard lock(mutex_);
  const int task = task_;
  const Phase phase = phase_;
  const std::string word = phase == Phase::ended && !outcome_.empty() ? outcome_ : word_of(phase);
  char elapsed[32];
  std::snprintf(elapsed, sizeof elapsed, "%.1f", elapsed_.load());
  const bool has_task = task >= 0 && static_cast<std::size_t>(task) < program_.tasks.size();
  return "{\"state\": " + quoted(word) +
         ", \"task\": " + (has_task ? quoted(program_.tasks[static_cast<std::size_t>(task)].name) : "null") +
         ", \"elapsed\": " + elapsed + ", \"reason\": " + quoted(reason_) + "}";
}

void Control::end(const std::string& outcome, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  outcome_ = outcome;
  reason_ = reason;
  phase_ = Phase::ended;
}

/// The state goes out when the phase or the task is another one, and once a second.
void Control::tell_changes() {
  Bytes bytes;
  Phase last_phase = Phase::ended;
  int last_task = -2, since = at_least_every;
  for (bool is_last = false; !is_last; std::this_thread::sleep_for(tell_every)) {
    is_last = is_over_;
    const Phase phase = phase_;
    const int task = task_;
    if (phase == last_phase && task == last_task && ++since < at_least_every && !is_last) continue;
    last_phase = phase, last_task = task, since = 0;
    encode(String{state()}, bytes);
    writer_->write(bytes);
  }
}

}  // namespace zwang::connect
