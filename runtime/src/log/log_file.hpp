/// A file that is appended to and read back, and words for what goes wrong with it.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

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

  /// Each returns what went wrong, or nothing.
  std::string open() {
    file_ = std::fopen(path_.c_str(), "wb+");
    return file_ == nullptr ? path_.string() + ": " + std::strerror(errno) : "";
  }
  std::string append(std::string_view bytes) {
    size_ += bytes.size();
    return std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size() ? "" : failed("written");
  }
  /// What was appended and flushed; fewer bytes at the end, and where it cannot be read.
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
