#include "arguments.hpp"

#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

namespace zwang::connect {

namespace {

bool put_first_in_line(const std::filesystem::path& thread, const sched_param& parameters) {
  const pid_t number = static_cast<pid_t>(std::stol(thread.filename().string()));
  return sched_setscheduler(number, SCHED_FIFO, &parameters) == 0 || errno == ESRCH;  // it has ended
}

}  // namespace

void become_punctual(int priority) {
  if (priority == 0) return;
  const sched_param parameters{priority};
  bool is_punctual = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    is_punctual = is_punctual && put_first_in_line(thread.path(), parameters);
  }
  if (is_punctual) return;
  std::cerr
      << "zwang: no real-time priority: that takes CAP_SYS_NICE and CAP_IPC_LOCK, or limits of rtprio and "
         "memlock\n";
}

Arguments parse_arguments(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (!word.starts_with("-")) {
      a.task = word;
      continue;
    }
    if (++i == argc) throw std::invalid_argument(word + " needs a value");
    const std::string value = argv[i];
    if (word == "--over")
      a.connection = value;
    else if (word == "--robot")
      a.options.robot = value;
    else if (word == "--scene")
      a.options.scene = value;
    else if (word == "--log")
      a.log = value;
    else if (word == "--log-rate")
      a.log_rate = std::stod(value);
    else if (word == "--log-rotate" && runtime::read_rotation(value, a.rotation))
      continue;
    else if (word == "--observe")
      a.observe = std::stod(value);
    else if (word == "--wait")
      a.wait = std::stod(value);
    else if (word == "--seed")
      a.seed = std::stoull(value);
    else if (word == "--stuck-odometry")
      a.stuck_odometry = std::stod(value);
    else if (word == "--stamps-ahead")
      a.stamps_ahead = std::stod(value);
    else if (word == "-p" && value.find('=') != std::string::npos)
      a.options.parameters[value.substr(0, value.find('='))] = value.substr(value.find('=') + 1);
    else
      throw std::invalid_argument("unknown option " + word);
  }
  if (a.task.empty() || a.connection.empty())
    throw std::invalid_argument("a task and --over CONNECTION are needed");
  return a;
}

std::optional<Loaded> load(const Arguments& arguments, lang::Diagnostics& diagnostics) {
  auto connection = lang::load_connection(arguments.connection, diagnostics);
  auto program = lang::load(arguments.task, arguments.options, diagnostics);
  const bool is_good = program && connection && lang::check_connection(*connection, *program, diagnostics);
  lang::render_human(diagnostics, std::cerr);
  if (!is_good || diagnostics.has_errors()) return std::nullopt;
  return Loaded{std::move(*program), std::move(*connection)};
}

}  // namespace zwang::connect
