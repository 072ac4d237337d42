#include "zwang/runtime/watchdog.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace zwang::runtime {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int looks_per_limit = 20;

std::int64_t now() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

std::int64_t nanoseconds(double seconds) {
  if (!(seconds > 0.0)) throw std::invalid_argument("watchdog: the limit is not positive");
  constexpr double longest = 1e9;  // [s], thirty years
  return static_cast<std::int64_t>(std::min(seconds, longest) * 1e9);
}

}  // namespace

struct Watchdog::Parts {
  Parts(double seconds, std::function<void()> callback)
      : limit(nanoseconds(seconds)), on_expiry(std::move(callback)) {
    thread = std::thread([this] { watch(); });
  }

  ~Parts() {
    {
      const std::lock_guard lock(mutex);
      is_over = true;
    }
    wake.notify_one();
    thread.join();
  }

  void watch() {
    std::unique_lock lock(mutex);
    const std::chrono::nanoseconds pause(limit / looks_per_limit + 1);
    while (!wake.wait_for(lock, pause, [this] { return is_over; })) {
      const bool in_time = now() - fed.load(std::memory_order_relaxed) <= limit;
      if (in_time && !expired.load()) continue;
      expired.store(true);
      try {
        if (on_expiry) on_expiry();
      } catch (...) {  // the host's mistake must not end the process
      }
      return;
    }
  }

  std::int64_t limit;  ///< [ns]
  std::function<void()> on_expiry;
  std::atomic<std::int64_t> fed{now()};
  std::atomic<bool> expired{false};
  std::mutex mutex;
  std::condition_variable wake;
  bool is_over = false;
  std::thread thread;
};

Watchdog::Watchdog(double limit, std::function<void()> on_expiry)
    : parts_(std::make_unique<Parts>(limit, std::move(on_expiry))) {}
Watchdog::~Watchdog() = default;

void Watchdog::feed() noexcept {
  const std::int64_t time = now();
  const std::int64_t before = parts_->fed.exchange(time, std::memory_order_relaxed);
  if (time - before > parts_->limit) parts_->expired.store(true);
}

bool Watchdog::expired() const noexcept {
  return parts_->expired.load();
}

}  // namespace zwang::runtime
