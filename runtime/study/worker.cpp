#include "study/worker.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

namespace zwang::study {

namespace {

/// False where the other end is closed.
bool read_all_of(int file, void* bytes, std::size_t size) {
  auto* at = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t got = ::read(file, at, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool write_all_of(int file, const void* bytes, std::size_t size) {
  const auto* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t put = ::write(file, at, size);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    at += put;
    size -= static_cast<std::size_t>(put);
  }
  return true;
}

/// A process runs cell for cell, until it is killed or its reader has ended.
[[noreturn]] void serve(int questions, int answers, const WorkCalls& calls) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGINT, SIG_IGN);  // of a terminal, which asks all processes: the first one ends the others
  std::signal(SIGTERM, SIG_DFL);
  std::uint64_t cell = 0;
  while (read_all_of(questions, &cell, sizeof cell)) {
    std::string text;
    try {
      text = to_text(calls.run(cell));
    } catch (const std::exception& error) {
      text = to_text(calls.fail(cell, "error", error.what()));
    }
    const std::uint64_t size = text.size();
    if (!write_all_of(answers, &size, sizeof size) || !write_all_of(answers, text.data(), text.size())) break;
  }
  ::_exit(0);
}

}  // namespace

Worker::Worker(const WorkCalls& calls) : calls_(calls) {
  start();
}

Worker::~Worker() {
  end();
}

std::optional<CellRecord> Worker::outcome(double limit) {
  if (is_free()) return std::nullopt;
  pollfd file{answers_, POLLIN, 0};
  if (::poll(&file, 1, 0) > 0) return answer();
  const double busy_for = std::chrono::duration<double>(Clock::now() - begin_).count();
  if (busy_for > limit) {
    std::array<char, 32> seconds{};
    std::snprintf(seconds.data(), seconds.size(), "%g s", limit);
    return give_up("took longer than " + std::string(seconds.data()));
  }
  return std::nullopt;
}

void Worker::ask(std::size_t cell) {
  cell_ = cell;
  begin_ = Clock::now();
  const std::uint64_t number = cell;
  // A process that has died is told by its answers.
  static_cast<void>(write_all_of(questions_, &number, sizeof number));
}

/// The record that has come; of a process that has died, that it has.
CellRecord Worker::answer() {
  const std::size_t cell = *std::exchange(cell_, std::nullopt);
  std::uint64_t size = 0;
  std::string text;
  if (read_all_of(answers_, &size, sizeof size)) {
    text.resize(size);
    if (read_all_of(answers_, text.data(), size)) return record_of(text);
  }
  const int status = end();
  const std::string because = WIFSIGNALED(status) ? ::strsignal(WTERMSIG(status)) : "its process ended";
  start();
  return calls_.fail(cell, "crashed", because);
}

CellRecord Worker::give_up(const std::string& because) {
  const std::size_t cell = *std::exchange(cell_, std::nullopt);
  end();
  start();
  return calls_.fail(cell, "hung", because);
}

void Worker::start() {
  int questions[2], answers[2];
  if (::pipe(questions) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  if (::pipe(answers) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  process_ = ::fork();
  if (process_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (process_ == 0) {
    ::close(questions[1]);
    ::close(answers[0]);
    serve(questions[0], answers[1], calls_);
  }
  ::close(questions[0]);
  ::close(answers[1]);
  questions_ = questions[1];
  answers_ = answers[0];
}

/// How it ended, as waitpid has it.
int Worker::end() {
  int status = 0;
  // A process that has died by itself keeps its own status.
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  ::close(questions_);
  ::close(answers_);
  return status;
}

}  // namespace zwang::study
