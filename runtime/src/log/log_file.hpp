/// A file that is appended to and read back, and words for what goes wrong with it.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

namespace zwang::runtime {

class LogFile {
 public:
  explicit LogFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~LogFile() { close(); }
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// Each returns what went wrong, or nothing. A link is not followed, a pipe not filled, and a file that
  /// another run writes is left to it.
  std::string open() {
    const int descriptor =
        ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (descriptor < 0)
      return path_.string() + ": " + (errno == ELOOP ? "is a symbolic link" : std::strerror(errno));
    std::string refused = refusal(descriptor);
    if (refused.empty()) file_ = ::fdopen(descriptor, "wb+");
    if (refused.empty() && file_ == nullptr) refused = std::strerror(errno);
    if (file_ == nullptr) ::close(descriptor);
    return refused.empty() ? "" : path_.string() + ": " + refused;
  }
  std::string append(std::string_view bytes) {
    size_ += bytes.size();
    return std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size() ? "" : failed("written");
  }
  /// The bytes that were appended and flushed; fewer at the end, and where they cannot be read.
  std::string read_at(std::size_t offset, std::size_t bytes) const {
    std::string read(bytes, '\0');
    const ssize_t count = ::pread(::fileno(file_), read.data(), bytes, static_cast<off_t>(offset));
    read.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return read;
  }
  std::string flush() { return std::fflush(file_) == 0 ? "" : failed("written"); }
  std::string close() {
    if (file_ == nullptr) return "";
    const bool is_there = has_a_name();
    const bool closed = std::fclose(file_) == 0;
    file_ = nullptr;
    if (!closed) return failed("closed");
    return is_there ? "" : "the log is gone: " + path_.string() + " was removed while it was written";
  }

  bool is_open() const { return file_ != nullptr; }
  std::size_t size() const { return size_; }  ///< [bytes] appended so far

 private:
  /// Takes a lock, which closing lets go, and then empties the file.
  static std::string refusal(int descriptor) {
    struct stat facts = {};
    if (::fstat(descriptor, &facts) != 0) return std::strerror(errno);
    if (S_ISFIFO(facts.st_mode)) return "is a pipe";
    if (!S_ISREG(facts.st_mode)) return "";
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
      return errno == EWOULDBLOCK ? "another run writes this log" : std::strerror(errno);
    if (!is_log(descriptor)) return "is no log, and would be lost";
    return ::ftruncate(descriptor, 0) == 0 ? "" : std::strerror(errno);
  }
  /// An empty file, MCAP, or CSV whose first column is the time.
  static bool is_log(int descriptor) {
    std::array<char, 5> begin{};
    const ssize_t size = ::pread(descriptor, begin.data(), begin.size(), 0);
    const std::string_view text(begin.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
    return text.empty() || text == "\x89MCAP" || text.starts_with("time");
  }
  /// A file without a name takes what is written, and is gone when it is closed.
  bool has_a_name() const {
    struct stat facts = {};
    return ::fstat(::fileno(file_), &facts) == 0 && facts.st_nlink > 0;
  }
  std::string failed(const char* what) const {
    return std::string("the log could not be ") + what + ": " + path_.string() + ": " + std::strerror(errno);
  }

  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace zwang::runtime
