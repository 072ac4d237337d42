#include "study/sole_writer.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace zwang::study {

namespace {

using Clock = std::chrono::steady_clock;

/// Workers of a sweep that was killed hold the file until they have ended, too.
constexpr auto time_to_end = std::chrono::seconds(2);

bool is_at(int file, const std::string& path) {
  struct stat held = {};
  struct stat there = {};
  return ::fstat(file, &held) == 0 && ::stat(path.c_str(), &there) == 0 && held.st_dev == there.st_dev &&
         held.st_ino == there.st_ino;
}

}  // namespace

SoleWriter::SoleWriter(const std::string& path) : path_(path) {
  take();
}

SoleWriter::~SoleWriter() {
  ::close(file_);
}

void SoleWriter::take() {
  for (const auto end = Clock::now() + time_to_end;;) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) throw std::runtime_error(path_ + ": cannot be written: " + std::strerror(errno));
    const bool is_taken = ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    // Its holder may have deleted it meanwhile.
    if (!is_taken && is_at(file_, path_)) return;
    ::close(file_);
    if (Clock::now() > end)
      throw std::runtime_error(
          path_ + ": another `zwang sweep` writes it; wait for its end, or name another file with --out");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void SoleWriter::begin_anew() {
  for (const char* end : {"", "-wal", "-shm"}) std::filesystem::remove(path_ + end);
  const int deleted = file_;
  take();
  ::close(deleted);
}

}  // namespace zwang::study
