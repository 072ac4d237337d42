/// Work from many threads for one.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace zwang::connect {

template <typename Item>
class WorkQueue {
 public:
  /// Drops the item where `most` others wait already, or the queue has ended.
  void put(Item item, std::size_t most) {
    {
      const std::lock_guard lock(mutex_);
      if (is_over_ || items_.size() >= most) return;
      items_.push_back(std::move(item));
    }
    changed_.notify_all();
  }
  /// Waits for an item; nullopt where the queue has ended and nothing is left in it.
  std::optional<Item> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_over_ || !items_.empty(); });
    if (items_.empty()) return std::nullopt;
    std::optional<Item> item(std::move(items_.front()));
    items_.pop_front();
    return item;
  }
  void end() {
    {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> items_;
  bool is_over_ = false;
};

}  // namespace zwang::connect
