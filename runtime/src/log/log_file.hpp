/// A file that is only ever appended to, and words for what goes wrong with it.
#pragma once

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
    file_ = std::fopen(path_.c_str(), "wb");
    return file_ == nullptr ? path_.string() + ": " + std::strerror(errno) : "";
  }
  std::string append(std::string_view bytes) {
    size_ += bytes.size();
    return std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size() ? "" : failed("written");
  }
  std::string flush() { return std::fflush(file_) == 0 ? "" : failed("written"); }
  std::string close() {
    if (file_ == nullptr) return "";
    const bool closed = std::fclose(file_) == 0;
    file_ = nullptr;
    return closed ? "" : failed("closed");
  }

  bool is_open() const { return file_ != nullptr; }
  std::size_t size() const { return size_; }  ///< [bytes] appended so far

 private:
  std::string failed(const char* what) const {
    return std::string("the log could not be ") + what + ": " + path_.string() + ": " + std::strerror(errno);
  }

  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace zwang::runtime
