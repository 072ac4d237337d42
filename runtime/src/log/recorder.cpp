#include "zwang/runtime/recorder.hpp"

#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace zwang::runtime {

namespace {

constexpr auto idle = std::chrono::milliseconds(5);  // between two looks at an empty ring
constexpr int significant_digits = 9;
constexpr std::size_t longest_number = 32;

void append_number(std::string& line, double value) {
  char digits[longest_number];
  // Negative zero would make two equal states differ in the log.
  const auto end = std::to_chars(digits, digits + longest_number, value == 0.0 ? 0.0 : value,
                                 std::chars_format::general, significant_digits);
  line.append(digits, end.ptr);
}

void append_value(std::string& line, const Column& column, double value) {
  if (std::isnan(value)) return;
  if (column.words.empty()) {
    append_number(line, value);
    return;
  }
  const auto index = static_cast<std::size_t>(value);
  if (value >= 0.0 && index < column.words.size()) line += column.words[index];
}

std::string header(const std::vector<Column>& columns) {
  std::string line;
  for (const Column& column : columns) {
    if (!line.empty()) line += ',';
    line += column.name;
    if (!column.unit.empty()) line += " [" + column.unit + "]";
  }
  return line + "\n";
}

}  // namespace

/// A ring with one producer (the control thread) and one consumer (the writer's thread). `head` and `tail`
/// only grow; a slot is theirs modulo the capacity.
struct Recorder::Writer {
  Writer(const std::filesystem::path& path, std::vector<Column> given, std::size_t slots)
      : columns(std::move(given)), capacity(slots), ring(slots * columns.size()) {
    file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) {
      fail(path.string() + ": " + std::strerror(errno));
    } else {
      put(header(columns));
    }
    thread = std::thread([this] { run(); });
  }

  void fail(const std::string& what) {
    const std::lock_guard lock(error_mutex);
    if (error.empty()) error = what;
  }

  bool put(const std::string& text) {
    if (file == nullptr) return false;
    if (std::fwrite(text.data(), 1, text.size(), file) == text.size()) return true;
    give_up();
    return false;
  }

  void flush() {
    if (file != nullptr && std::fflush(file) != 0) give_up();
  }

  void give_up() {
    fail(std::string("the log could not be written: ") + std::strerror(errno));
    std::fclose(file);
    file = nullptr;
  }

  void run() {
    std::string line;
    while (true) {
      const bool last_look = closing.load(std::memory_order_acquire);
      drain(line);
      if (last_look) break;
      std::this_thread::sleep_for(idle);
    }
    if (file != nullptr && std::fclose(file) != 0) {
      fail(std::string("the log could not be closed: ") + std::strerror(errno));
    }
    file = nullptr;
  }

  void drain(std::string& line) {
    const std::uint64_t end = head.load(std::memory_order_acquire);
    std::uint64_t begin = tail.load(std::memory_order_relaxed);
    if (begin == end) return;
    std::uint64_t count = 0;
    for (; begin != end; ++begin) {
      const double* values = &ring[static_cast<std::size_t>(begin % capacity) * columns.size()];
      line.clear();
      for (std::size_t i = 0; i < columns.size(); ++i) {
        if (i > 0) line += ',';
        append_value(line, columns[i], values[i]);
      }
      line += '\n';
      tail.store(begin + 1, std::memory_order_release);
      if (put(line)) ++count;
    }
    flush();
    if (file != nullptr) written.fetch_add(count, std::memory_order_relaxed);
  }

  const std::vector<Column> columns;
  const std::size_t capacity;
  std::vector<double> ring;
  std::atomic<std::uint64_t> head{0};
  std::atomic<std::uint64_t> tail{0};
  std::atomic<std::uint64_t> written{0};
  std::atomic<std::uint64_t> dropped{0};
  std::atomic<bool> closing{false};
  std::FILE* file = nullptr;
  mutable std::mutex error_mutex;  // never taken by the control thread
  std::string error;
  std::thread thread;
};

Recorder::Recorder(const std::filesystem::path& path, std::vector<Column> columns, std::size_t capacity) {
  if (columns.empty() || capacity == 0) throw std::invalid_argument("recorder: no columns, or no room");
  writer_ = std::make_unique<Writer>(path, std::move(columns), capacity);
}

Recorder::~Recorder() {
  close();
}

bool Recorder::record(std::span<const double> values) noexcept {
  Writer& w = *writer_;
  const std::uint64_t head = w.head.load(std::memory_order_relaxed);
  if (values.size() != w.columns.size() || head - w.tail.load(std::memory_order_acquire) >= w.capacity ||
      w.closing.load(std::memory_order_relaxed)) {
    w.dropped.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  double* slot = &w.ring[static_cast<std::size_t>(head % w.capacity) * w.columns.size()];
  std::memcpy(slot, values.data(), values.size_bytes());
  w.head.store(head + 1, std::memory_order_release);
  return true;
}

void Recorder::wait_for_room() const noexcept {
  const Writer& w = *writer_;
  while (w.head.load(std::memory_order_relaxed) - w.tail.load(std::memory_order_acquire) >= w.capacity &&
         !w.closing.load(std::memory_order_relaxed)) {
    std::this_thread::sleep_for(idle);
  }
}

void Recorder::close() noexcept {
  writer_->closing.store(true, std::memory_order_release);
  if (writer_->thread.joinable()) writer_->thread.join();
}

std::size_t Recorder::column_count() const noexcept {
  return writer_->columns.size();
}

RecorderStatus Recorder::status() const {
  RecorderStatus status;
  status.recorded = writer_->head.load();
  status.written = writer_->written.load();
  status.dropped = writer_->dropped.load();
  const std::lock_guard lock(writer_->error_mutex);
  status.error = writer_->error;
  return status;
}

}  // namespace zwang::runtime
