#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "log/log_files.hpp"
#include "zwang/runtime/log_parts.hpp"

namespace zwang::runtime {

namespace fs = std::filesystem;

namespace {

using MakeSink = std::function<std::unique_ptr<LogSink>(const fs::path& path,
                                                        const std::map<std::string, std::string>& facts)>;

class RotatingSink : public LogSink {
 public:
  RotatingSink(fs::path folder, std::string stem, const LogRotation& rotation, MakeSink make)
      : folder_(folder.empty() ? fs::path(".") : std::move(folder)),
        stem_(std::move(stem)),
        rotation_(rotation),
        make_(std::move(make)) {}

  std::string open(const std::vector<Column>& columns) override {
    columns_ = columns;
    const std::string error = open_part();
    if (!error.empty()) return error;
    for (const fs::path& old : log_parts(folder_, stem_)) {
      std::error_code ignored;
      if (part_of(old.filename().string(), stem_) != 0) fs::remove(old, ignored);
    }
    return "";
  }

  std::string write(std::span<const double> values) override {
    const double time = values.front();
    if (has_records_ && is_over(time)) {
      std::string error = part_->close();
      if (!error.empty()) return error;
      closed_bytes_ += part_->size();
      ++number_;
      error = open_part();
      if (!error.empty()) return error;
    }
    if (!std::exchange(has_records_, true)) begin_ = time;
    return part_->write(values);
  }

  std::string skip(std::uint64_t records) override { return part_->skip(records); }
  std::string conclude(const std::map<std::string, std::string>& facts) override {
    return part_->conclude(facts);
  }
  std::string flush() override { return part_->flush(); }
  std::string close() override { return part_ ? part_->close() : ""; }
  std::uint64_t size() const override { return closed_bytes_ + (part_ ? part_->size() : 0); }

 private:
  std::string open_part() {
    std::map<std::string, std::string> facts{{part_fact, std::to_string(number_)}};
    if (number_ > 0) facts[continues_fact] = part_name(stem_, number_ - 1);
    part_ = make_(folder_ / part_name(stem_, number_), facts);
    has_records_ = false;
    return part_->open(columns_);
  }

  /// A clock that jumps back begins a new span.
  bool is_over(double time) {
    constexpr double rounding = 1e-9;  // [s]
    if (time < begin_) begin_ = time;
    return (rotation_.seconds && time - begin_ >= *rotation_.seconds - rounding) ||
           (rotation_.bytes && part_->size() >= *rotation_.bytes);
  }

  fs::path folder_;
  std::string stem_;
  LogRotation rotation_;
  MakeSink make_;
  std::vector<Column> columns_;
  std::unique_ptr<LogSink> part_;
  std::size_t number_ = 0;
  std::uint64_t closed_bytes_ = 0;
  bool has_records_ = false;  ///< of the present file
  double begin_ = 0.0;        ///< [s] of the present file
};

struct RotationUnit {
  std::string_view name;
  double factor;
  bool is_time;
};
constexpr RotationUnit rotation_units[] = {{"kB", 1e3, false},     {"MB", 1e6, false},    {"GB", 1e9, false},
                                           {"MiB", 0x1p20, false}, {"s", 1.0, true},      {"h", 3600.0, true},
                                           {"min", 60.0, true},    {"GiB", 0x1p30, false}};
constexpr double fewest_bytes = 1e6, shortest = 1.0, most = 1e15;

/// `LogFile` refuses links and pipes.
enum class Kind { file, written, other };

/// A run keeps a lock on the log that it writes.
Kind kind_of(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return Kind::other;
  struct stat facts = {};
  const bool is_file = ::fstat(descriptor, &facts) == 0 && S_ISREG(facts.st_mode);
  const bool is_written = is_file && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return is_written ? Kind::written : is_file ? Kind::file : Kind::other;
}

}  // namespace

bool read_rotation(std::string_view text, LogRotation& rotation) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const RotationUnit& one : rotation_units) {
    if (unit != one.name) continue;
    const double value = number * one.factor;
    if (!(value >= (one.is_time ? shortest : fewest_bytes)) || value > most) return false;
    if (one.is_time) rotation.seconds = value;
    if (!one.is_time) rotation.bytes = static_cast<std::uint64_t>(value);
    return true;
  }
  return false;
}

std::unique_ptr<LogSink> rotating_sink(const fs::path& folder, const std::string& stem,
                                       const LogRotation& rotation, MakeSink make) {
  return std::make_unique<RotatingSink>(folder, stem, rotation, std::move(make));
}

std::string remove_log(const fs::path& folder, const std::string& stem) {
  std::vector<fs::path> files = log_parts(folder, stem);
  files.push_back(folder / (stem + ".mcap"));
  files.push_back(folder / (stem + ".csv"));
  // The parts of a run that still writes have no lock but the last one.
  for (const fs::path& file : files) {
    if (kind_of(file) == Kind::written) return file.string() + ": another run writes this log";
  }
  for (const fs::path& file : files) {
    std::error_code error;
    if (kind_of(file) == Kind::file) fs::remove(file, error);
    if (error) return file.string() + ": " + error.message();
  }
  return "";
}

}  // namespace zwang::runtime
