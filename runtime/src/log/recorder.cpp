#include "zwang/runtime/recorder.hpp"

#include <atomic>
#include <chrono>
#include <cstring>
#include <ctime>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

namespace zwang::runtime {

namespace {

constexpr auto idle = std::chrono::milliseconds(10);  // between two looks at an empty ring

/// The complaint of a sink, thrown or returned.
template <typename Call>
std::string complaint(const Call& call) {
  try {
    return call();
  } catch (const std::exception& e) {
    return std::string("a log sink failed: ") + e.what();
  } catch (...) {
    return "a log sink failed";
  }
}

}  // namespace

std::string LogSink::skip(std::uint64_t) {
  return "";
}

std::string LogSink::conclude(const std::map<std::string, std::string>&) {
  return "";
}

/// A ring with one producer (the control thread) and one consumer (the writer's thread). `head` and `tail`
/// only grow; a slot is theirs modulo the capacity.
struct Recorder::Writer {
  struct Output {
    std::unique_ptr<LogSink> sink;
    bool failed = false;
  };

  Writer(std::vector<std::unique_ptr<LogSink>> given_sinks, std::vector<Column> given, std::size_t slots)
      : columns(std::move(given)), capacity(slots), ring(slots * columns.size()), dropped_before(slots) {
    for (std::unique_ptr<LogSink>& sink : given_sinks) outputs.push_back({std::move(sink)});
    each([this](LogSink& sink) { return sink.open(columns); });
    thread = std::thread([this] { run(); });
  }

  /// Whether every sink did what was asked.
  template <typename Call>
  bool each(const Call& call) {
    bool good = true;
    for (Output& output : outputs) {
      if (!output.failed) {
        const std::string said = complaint([&] { return call(*output.sink); });
        if (!said.empty()) fail(output, said);
      }
      good = good && !output.failed;
    }
    return good;
  }

  void fail(Output& output, const std::string& what) {
    output.failed = true;
    const std::lock_guard lock(error_mutex);
    if (error.empty()) error = what;
  }

  void run() {
    while (true) {
      const bool last_look = closing.load(std::memory_order_acquire);
      drain();
      if (last_look) break;
      std::this_thread::sleep_for(idle);
    }
    tell_dropped(dropped.load(std::memory_order_relaxed));
    if (!conclusion.empty()) each([this](LogSink& sink) { return sink.conclude(conclusion); });
    // A sink that failed has a file to close all the same.
    for (Output& output : outputs) {
      const std::string said = complaint([&] { return output.sink->close(); });
      if (!said.empty()) fail(output, said);
    }
    timespec taken{};
    if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &taken) == 0)
      processor_time = static_cast<double>(taken.tv_sec) + 1e-9 * static_cast<double>(taken.tv_nsec);
  }

  void drain() {
    const std::uint64_t end = head.load(std::memory_order_acquire);
    std::uint64_t begin = tail.load(std::memory_order_relaxed);
    if (begin == end) {
      // A sink that holds records back learns here that no more are on their way.
      each([](LogSink& sink) { return sink.flush(); });
      return;
    }
    std::uint64_t count = 0;
    for (; begin != end; ++begin) {
      const auto slot = static_cast<std::size_t>(begin % capacity);
      const std::span<const double> values(&ring[slot * columns.size()], columns.size());
      tell_dropped(dropped_before[slot]);
      if (each([&](LogSink& sink) { return sink.write(values); })) ++count;
      tail.store(begin + 1, std::memory_order_release);
    }
    if (each([](LogSink& sink) { return sink.flush(); })) written.fetch_add(count, std::memory_order_relaxed);
  }

  void tell_dropped(std::uint64_t so_far) {
    const std::uint64_t records = so_far - told_dropped;
    if (records > 0) each([records](LogSink& sink) { return sink.skip(records); });
    told_dropped = so_far;
  }

  const std::vector<Column> columns;
  const std::size_t capacity;
  std::vector<double> ring;
  std::vector<std::uint64_t> dropped_before;      // each record of the ring
  std::uint64_t told_dropped = 0;                 // the writer's thread's own
  std::map<std::string, std::string> conclusion;  // given before `closing`
  std::vector<Output> outputs;                    // the writer's thread's own
  std::atomic<std::uint64_t> head{0};
  std::atomic<std::uint64_t> tail{0};
  std::atomic<std::uint64_t> written{0};
  std::atomic<std::uint64_t> dropped{0};
  std::atomic<double> processor_time{0.0};
  std::atomic<bool> closing{false};
  mutable std::mutex error_mutex;  // never taken by the control thread
  std::string error;
  std::thread thread;
};

namespace {

std::vector<std::unique_ptr<LogSink>> only(std::unique_ptr<LogSink> sink) {
  std::vector<std::unique_ptr<LogSink>> sinks;
  sinks.push_back(std::move(sink));
  return sinks;
}

}  // namespace

Recorder::Recorder(std::vector<std::unique_ptr<LogSink>> sinks, std::vector<Column> columns,
                   std::size_t capacity) {
  if (columns.empty() || capacity == 0) throw std::invalid_argument("recorder: no columns, or no room");
  if (sinks.empty()) throw std::invalid_argument("recorder: nowhere to write");
  for (const std::unique_ptr<LogSink>& sink : sinks) {
    if (!sink) throw std::invalid_argument("recorder: a sink is null");
  }
  writer_ = std::make_unique<Writer>(std::move(sinks), std::move(columns), capacity);
}

Recorder::Recorder(const std::filesystem::path& path, std::vector<Column> columns, std::size_t capacity)
    : Recorder(only(csv_sink(path)), std::move(columns), capacity) {}

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
  const auto slot = static_cast<std::size_t>(head % w.capacity);
  std::memcpy(&w.ring[slot * w.columns.size()], values.data(), values.size_bytes());
  w.dropped_before[slot] = w.dropped.load(std::memory_order_relaxed);
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

void Recorder::conclude(std::map<std::string, std::string> facts) {
  if (!writer_->closing.load(std::memory_order_relaxed)) writer_->conclusion = std::move(facts);
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
  status.processor_time = writer_->processor_time.load();
  const std::lock_guard lock(writer_->error_mutex);
  status.error = writer_->error;
  return status;
}

}  // namespace zwang::runtime
